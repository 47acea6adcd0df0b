// SPDX-License-Identifier: GPL-3.0-or-later
// Prescribed motions: <rotation>, <translation>, <displacement>.
#include "deck/deck_node.h"

#include <math.h>

static void read_axis(struct deck *deck, const struct deck_node *node, double axis[3])
{
    if (deck->model->dim < 3) {
        axis[2] = 1.0;
        if (deck_has(node, "axis"))
            deck_error(deck, node, "axis", "is for 3-D decks; in the plane everything turns about z");
        if (deck->model->dim == 1)
            deck_error(deck, node, NULL, "nothing can turn in a 1-D deck");
        return;
    }
    size_t before = deck->n_problems;
    if (!deck_vector(deck, node, "axis", axis)) {
        deck_error(deck, node, NULL,
                   "attribute \"axis\" is missing: a rotation in space needs its direction");
        return;
    }
    double length = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    if (length > 0.0)
        for (int d = 0; d < 3; d++)
            axis[d] /= length;
    else if (deck->n_problems == before)
        deck_error(deck, node, "axis", "the axis must not be zero");
}

void deck_read_motion(struct deck *deck, const struct deck_node *node, struct motion *motion)
{
    const struct deck_node *rotation = deck_child(node, SCHEMA_ROTATION);
    const struct deck_node *translation = deck_child(node, SCHEMA_TRANSLATION);
    const struct deck_node *displacement = deck_child(node, SCHEMA_DISPLACEMENT);
    if (displacement && (rotation || translation)) {
        deck_error(deck, displacement, NULL,
                   "cannot be combined with <%s>: write the whole motion as a displacement",
                   rotation ? "rotation" : "translation");
        return;
    }
    motion->axis[2] = 1.0;
    motion->kind = displacement ? MOTION_FIELD : rotation || translation ? MOTION_RIGID : MOTION_NONE;
    if (rotation) {
        deck_vector(deck, rotation, "centre", motion->centre);
        read_axis(deck, rotation, motion->axis);
        motion->angle = deck_expression(deck, rotation, "angle");
        motion->angular_velocity = deck_expression(deck, rotation, "velocity");
        motion->angular_acceleration = deck_expression(deck, rotation, "acceleration");
    }
    const struct deck_node *path = displacement ? displacement : translation;
    if (path) {
        deck_expressions(deck, path, "value", motion->displacement);
        deck_expressions(deck, path, "velocity", motion->velocity);
        deck_expressions(deck, path, "acceleration", motion->acceleration);
    }
}

// SPDX-License-Identifier: GPL-3.0-or-later
// <rigid> of a mesh.
#include "deck/deck_node.h"

#include "base/memory.h"

#include <math.h>

static const char *const directions[] = {"x", "y", "z", "rotation-x", "rotation-y", "rotation-z"};

/** Mass or density: of its own, or of the mesh's material. */
static void read_mass(struct deck *deck, const struct deck_node *mesh, const struct deck_node *node,
                      struct model_mesh *definition)
{
    struct model_rigid *rigid = &definition->rigid;
    const struct model *model = deck->model;
    const bool density = deck_has(node, "density"), material = deck_has(mesh, "material");
    rigid->has_mass = deck_has(node, "mass");
    if (rigid->has_mass)
        rigid->mass = deck_real(deck, node, "mass");
    if (density)
        rigid->density = deck_real(deck, node, "density");
    else if (definition->material >= 0)
        rigid->density = model->solid_materials[definition->material].density;
    if (density && (rigid->has_mass || material))
        deck_error(deck, node, "density", "the body has a %s already; leave out one of them",
                   rigid->has_mass ? "mass" : "material with a density");
    if (!density && !rigid->has_mass && !material)
        deck_error(deck, node, NULL, "needs a density, a mass, or a material of the mesh");
}

static void read_inertia(struct deck *deck, const struct deck_node *node, struct model_rigid *rigid)
{
    rigid->has_centre = deck_vector(deck, node, "centre", rigid->centre);
    rigid->has_inertia = deck_inertia(deck, node, "inertia", rigid->inertia);
    if (rigid->has_centre && !rigid->has_inertia)
        deck_error(
            deck, node, "centre",
            "a centre of mass that is not that of the volume needs an inertia: that of the volume does not "
            "belong to it");
}

/** What is held, and how the rest moves at the start. */
static void read_motion(struct deck *deck, const struct deck_node *node, struct model_rigid *rigid)
{
    const bool plane = deck->model->dim == 2;
    deck_choices(deck, node, "fixed", rigid->fixed);
    deck_vector(deck, node, "velocity", rigid->velocity);
    deck_turn(deck, node, "angular-velocity", rigid->angular_velocity);
    for (int k = 0; k < 6; k++) {
        const double *start = k < 3 ? rigid->velocity : rigid->angular_velocity;
        if (rigid->fixed[k] && plane && k >= 2 && k < 5)
            deck_error(deck, node, "fixed", "a 2-D deck has no direction %s; those out of the plane are held",
                       directions[k]);
        else if (rigid->fixed[k] && fabs(start[k % 3]) > 0.0)
            deck_error(deck, node, k < 3 ? "velocity" : "angular-velocity",
                       "%s is fixed: the body cannot start with %.9g there", directions[k], start[k % 3]);
    }
}

/** What deformable meshes have and rigid bodies do not; the defaults, which `skerry show` writes, say
 * nothing. */
static void refuse_others(struct deck *deck, const struct deck_node *mesh,
                          const struct model_mesh *definition)
{
    static const char *const names[] = {"formulation", "rho-infinity", "newton-tolerance"};
    const bool chosen[] = {definition->formulation != SOLID_EAS, fabs(definition->rho_infinity - 0.8) > 0.0,
                           fabs(definition->newton_tolerance - 1e-8) > 0.0};
    const struct deck_node *support = deck_child(mesh, SCHEMA_SUPPORT),
                           *initial = deck_child(mesh, SCHEMA_INITIAL);
    for (size_t k = 0; k < sizeof names / sizeof *names; k++)
        if (deck_has(mesh, names[k]) && chosen[k])
            deck_error(deck, mesh, names[k], "%s has no meaning for a rigid body; leave it out", names[k]);
    if (support)
        deck_error(
            deck, support, NULL,
            "a rigid body has no supports: hold it by <rigid fixed=\"x y ...\">; what moves as prescribed "
            "needs no mesh, but a <surface> with a motion");
    if (initial)
        deck_error(deck, initial, NULL,
                   "a rigid body starts with velocity and angular-velocity of <rigid>, where its mesh is");
}

void deck_read_rigid(struct deck *deck, const struct deck_node *mesh, struct model_mesh *definition)
{
    const struct deck_node *node = deck_child(mesh, SCHEMA_RIGID);
    if (!node) {
        if (!deck_has(mesh, "material"))
            deck_error(
                deck, mesh, NULL,
                "attribute \"material\" is missing: a <solid> of <materials>; only rigid bodies do without");
        return;
    }
    definition->rigid.present = true;
    definition->rigid.where = node->where;
    read_mass(deck, mesh, node, definition);
    read_inertia(deck, node, &definition->rigid);
    read_motion(deck, node, &definition->rigid);
    refuse_others(deck, mesh, definition);
}

// SPDX-License-Identifier: GPL-3.0-or-later
// Section <boundaries>.
#include "deck/deck_node.h"

#include "base/error.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

/** Sliding particles need all facets in reach in one list; no surface may have two walls. */
static void check_shared_surfaces(struct deck *deck, const struct deck_node *node,
                                  const struct model_wall *wall)
{
    const struct model *model = deck->model;
    for (const struct model_wall *other = model->walls; other < wall; other++)
        for (size_t i = 0; i < other->n_surfaces; i++)
            for (size_t k = 0; k < wall->n_surfaces; k++)
                if (other->surfaces[i] == wall->surfaces[k])
                    deck_error(deck, node, "surfaces", "surface \"%s\" belongs to wall \"%s\" already",
                               model->surfaces[wall->surfaces[k]].name, other->name);
}

static int read_wall(struct deck *deck, const struct deck_node *node, struct model_wall *wall)
{
    const struct model *model = deck->model;
    struct deck_node *region = deck_child(node, SCHEMA_REGION);
    wall->where = node->where;
    wall->name = deck_word(deck, node, "name");
    wall->treatment = deck_word(deck, node, "treatment");
    wall->corners = deck_choice(deck, node, "corners") == 1 ? CORNERS_PAPER : CORNERS_SHARES;
    wall->pressure_gradient = deck_yes(deck, node, "pressure-gradient");
    if (deck_has(node, "surfaces"))
        wall->n_surfaces = deck_references(deck, node, "surfaces", "surface", model->surfaces,
                                           model->n_surfaces, sizeof *model->surfaces, &wall->surfaces);
    check_shared_surfaces(deck, node, wall);
    deck_read_motion(deck, node, &wall->motion);
    wall->has_region = region != NULL;
    const bool sliding = deck_choice(deck, node, "treatment") == 1;
    if (!deck_has(node, "surfaces") && !region)
        deck_error(deck, node, NULL, "needs the attribute \"surfaces\"%s",
                   sliding ? "" : " or a <region> of particles");
    else if (deck_has(node, "surfaces") && region)
        deck_error(deck, region, NULL,
                   "stands beside the attribute \"surfaces\"; a wall is one or the other");
    else if (region && sliding)
        deck_error(deck, region, NULL,
                   "sliding particles slide on surfaces; a region is for treatment=\"fixed-particles\"");
    if (region && deck_has(region, "velocity"))
        deck_error(deck, region, "velocity",
                   "velocity is an initial velocity of fluid; a wall moves by a <rotation>, <translation> or "
                   "<displacement> inside <wall>");
    if (!region && wall->motion.kind != MOTION_NONE)
        deck_error(deck, node, NULL, "its motion belongs to its <surface>s");
    if (!sliding && wall->corners == CORNERS_PAPER)
        deck_error(deck, node, "corners", "corners=\"paper\" is for treatment=\"sliding-particles\" only");
    if (!sliding && !wall->pressure_gradient)
        deck_error(deck, node, "pressure-gradient",
                   "pressure-gradient=\"no\" is for treatment=\"sliding-particles\" only");
    return region ? deck_read_region(deck, region, &wall->region) : deck->status;
}

/** A corner of the opening; default: that of the domain. */
static void read_corner(struct deck *deck, struct deck_node *node, const char *name, const double domain[3],
                        double corner[3])
{
    if (deck_vector(deck, node, name, corner))
        return;
    memcpy(corner, domain, 3 * sizeof *corner);
    char text[128] = "";
    for (int d = 0, used = 0; d < deck->model->dim; d++)
        used += snprintf(text + used, sizeof text - (size_t)used, "%s%.17g", d ? " " : "", domain[d]);
    deck_fill(deck, node, name, "%s", text);
}

static void check_opening(struct deck *deck, const struct deck_node *node, const struct model_open *open)
{
    const struct model_domain *domain = &deck->model->domain;
    if (!domain->where.line) // that it is missing has been noted
        return;
    if (open->axis >= deck->model->dim)
        deck_error(deck, node, "axis", "a %d-D deck has no direction %c", deck->model->dim,
                   "xyz"[open->axis]);
    else if (domain->periodic[open->axis])
        deck_error(deck, node, "axis",
                   "the domain is periodic in direction %c: nothing flows in or out there",
                   "xyz"[open->axis]);
    else if (open->at <= domain->lower[open->axis] || open->at >= domain->upper[open->axis])
        deck_error(deck, node, "at",
                   "the plane %c = %.9g is not inside the domain, which must leave room for the zone "
                   "beyond it (from %.9g to %.9g)",
                   "xyz"[open->axis], open -> at, domain -> lower[open->axis], domain -> upper[open->axis]);
    for (int d = 0; d < deck->model->dim; d++)
        if (d != open->axis && !(open->lower[d] < open->upper[d]))
            deck_error(deck, node, "upper",
                       "upper corner %.9g is not above lower corner %.9g in direction %c", open->upper[d],
                       open->lower[d], "xyz"[d]);
}

static void read_opening(struct deck *deck, struct deck_node *node, struct model_open *open)
{
    size_t before = deck->n_problems;
    open->where = node->where;
    open->name = deck_word(deck, node, "name");
    open->kind = node->id == SCHEMA_INFLOW ? OPEN_INFLOW : OPEN_OUTFLOW;
    open->axis = deck_choice(deck, node, "axis");
    open->into = deck_choice(deck, node, "into") == 0 ? 1 : -1;
    open->at = deck_real(deck, node, "at");
    read_corner(deck, node, "lower", deck->model->domain.lower, open->lower);
    read_corner(deck, node, "upper", deck->model->domain.upper, open->upper);
    if (deck->n_problems == before)
        check_opening(deck, node, open);
    if (open->kind == OPEN_INFLOW) {
        deck_expressions(deck, node, "velocity", open->velocity);
    } else {
        open->pressure = deck_expression(deck, node, "pressure");
        open->velocity_rule = deck_choice(deck, node, "velocity") == 1 ? OPEN_MOMENTUM : OPEN_CHARACTERISTIC;
    }
}

int deck_read_boundaries(struct deck *deck)
{
    const struct deck_node *section = deck_child(deck->root, SCHEMA_BOUNDARIES);
    struct model *model = deck->model;
    const size_t n_openings = deck_count(section, SCHEMA_INFLOW) + deck_count(section, SCHEMA_OUTFLOW);
    CHECK_MEMORY(model->walls = memory_create(deck_count(section, SCHEMA_WALL), sizeof *model->walls));
    CHECK_MEMORY(model->openings = memory_create(n_openings, sizeof *model->openings));
    for (struct deck_node *node = section ? section->children : NULL; node; node = node->next) {
        if (!model->fluid.present) {
            deck_error(deck, node, NULL, "there is no <fluid> that could end here");
            return deck->status;
        }
        if (node->id == SCHEMA_WALL)
            CALL(read_wall(deck, node, &model->walls[model->n_walls++]));
        else
            read_opening(deck, node, &model->openings[model->n_openings++]);
    }
    return deck->status;
}

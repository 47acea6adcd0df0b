// SPDX-License-Identifier: GPL-3.0-or-later
// Section <surfaces>.
#include "deck/deck_node.h"

#include "base/error.h"
#include "base/memory.h"
#include "model/surface_build.h"

#include <math.h>
#include <string.h>

static const double full_turn = 6.283185307179586477;

static void read_skin(struct deck *deck, const struct deck_node *node, struct surface_part *part)
{
    const struct model *model = deck->model;
    part->mesh =
        deck_reference(deck, node, "mesh", "mesh", model->meshes, model->n_meshes, sizeof *model->meshes);
    if (part->mesh < 0)
        return;
    const struct mesh *mesh = &model->meshes[part->mesh].mesh;
    if (deck_has(node, "exclude"))
        part->n_excluded = deck_references(deck, node, "exclude", "node set", mesh->sets, mesh->n_sets,
                                           sizeof *mesh->sets, &part->excluded);
}

/** A chain of n points; @p backwards: segments go from the later to the earlier point. */
static void chain(struct deck *deck, struct facets *facets, size_t n, bool closed, bool backwards)
{
    facets->dim = 2;
    facets->n_points = n;
    facets->n_facets = closed ? n : n - 1;
    facets->nodes = deck_memory(deck, facets->n_facets, sizeof *facets->nodes);
    if (!facets->nodes)
        facets->n_facets = 0;
    for (size_t f = 0; f < facets->n_facets; f++) {
        const int32_t first = (int32_t)f, second = (int32_t)((f + 1) % n);
        const int32_t nodes[4] = {backwards ? second : first, backwards ? first : second, -1, -1};
        memcpy(facets->nodes[f], nodes, sizeof nodes);
    }
}

static void read_arc(struct deck *deck, const struct deck_node *node, struct facets *facets)
{
    double centre[3];
    size_t before = deck->n_problems;
    deck_need_dim(deck, node, 2, deck->model->dim == 1 ? "<plane>" : "<facets>");
    deck_vector(deck, node, "centre", centre);
    const double radius = deck_real(deck, node, "radius"), from = deck_real(deck, node, "from"),
                 to = deck_real(deck, node, "to");
    const int segments = deck_integer(deck, node, "segments");
    if (deck->n_problems == before && !(to > from && to - from <= full_turn * (1.0 + 1e-12)))
        deck_error(deck, node, "to", "the arc from %.9g to %.9g rad must go forward, by at most a full turn",
                   from, to);
    const bool closed = to - from >= full_turn * (1.0 - 1e-12);
    if (deck->n_problems == before && closed && segments < 3)
        deck_error(deck, node, "segments", "a full circle needs at least 3 segments");
    if (deck->n_problems > before)
        return;
    const size_t n = (size_t)segments + (closed ? 0 : 1);
    facets->points = deck_memory(deck, n, sizeof *facets->points);
    if (!facets->points)
        return;
    for (size_t i = 0; i < n; i++) {
        double angle = from + (to - from) * (double)i / segments;
        facets->points[i][0] = centre[0] + radius * cos(angle);
        facets->points[i][1] = centre[1] + radius * sin(angle);
    }
    chain(deck, facets, n, closed, deck_choice(deck, node, "fluid") == 1);
}

static void read_segments(struct deck *deck, const struct deck_node *node, struct facets *facets)
{
    size_t before = deck->n_problems;
    deck_need_dim(deck, node, 2, deck->model->dim == 1 ? "<plane>" : "<facets>");
    size_t n = deck_points(deck, node, "points", &facets->points);
    const bool closed = deck_yes(deck, node, "closed");
    if (n < (closed ? 3 : 2))
        deck_error(deck, node, "points", "has %zu points; %s needs at least %d", n,
                   closed ? "a closed chain" : "a chain", closed ? 3 : 2);
    for (size_t i = 0; deck->n_problems == before && i + 1 < n + closed; i++)
        if (memcmp(facets->points[i], facets->points[(i + 1) % n], sizeof *facets->points) == 0)
            deck_error(deck, node, "points", "points %zu and %zu are the same", i + 1, (i + 1) % n + 1);
    if (deck->n_problems == before && !deck->status)
        chain(deck, facets, n, closed, deck_choice(deck, node, "fluid") == 0);
}

static void read_unit_vector(struct deck *deck, const struct deck_node *node, const char *name,
                             double vector[3])
{
    size_t before = deck->n_problems;
    deck_vector(deck, node, name, vector);
    double length = sqrt(vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2]);
    if (length > 0.0)
        for (int d = 0; d < 3; d++)
            vector[d] /= length;
    else if (deck->n_problems == before)
        deck_error(deck, node, name, "the direction must not be zero");
}

static void read_analytic(struct deck *deck, const struct deck_node *node, struct model_surface *surface)
{
    if (node->id == SCHEMA_PLANE) {
        surface->kind = SURFACE_PLANE;
        deck_vector(deck, node, "point", surface->centre);
        read_unit_vector(deck, node, "normal", surface->axis);
        return;
    }
    size_t before = deck->n_problems;
    if (node->id == SCHEMA_CIRCLE)
        deck_need_dim(deck, node, 2, deck->model->dim == 1 ? "<plane>" : "<cylinder> or <sphere>");
    else
        deck_need_dim(deck, node, 3, deck->model->dim == 1 ? "<plane>" : "<circle>");
    if (deck->n_problems > before)
        return;
    surface->kind = node->id == SCHEMA_SPHERE ? SURFACE_SPHERE : SURFACE_CYLINDER;
    surface->axis[2] = 1.0;
    if (node->id == SCHEMA_CYLINDER_SURFACE)
        read_unit_vector(deck, node, "axis", surface->axis);
    deck_vector(deck, node, "centre", surface->centre);
    surface->radius = deck_real(deck, node, "radius");
    surface->fluid_inside = deck_choice(deck, node, "fluid") == 1;
}

static bool is_motion(const struct deck_node *node)
{
    return node->id == SCHEMA_ROTATION || node->id == SCHEMA_TRANSLATION || node->id == SCHEMA_DISPLACEMENT;
}

static bool is_analytic(const struct deck_node *node)
{
    return node->id == SCHEMA_PLANE || node->id == SCHEMA_CIRCLE || node->id == SCHEMA_CYLINDER_SURFACE ||
           node->id == SCHEMA_SPHERE;
}

static void read_part(struct deck *deck, const struct deck_node *node, struct model_surface *surface)
{
    struct surface_part *part = &surface->parts[surface->n_parts++];
    part->mesh = -1;
    if (node->id == SCHEMA_SKIN)
        read_skin(deck, node, part);
    else if (node->id == SCHEMA_ARC)
        read_arc(deck, node, &part->facets);
    else if (node->id == SCHEMA_SEGMENTS)
        read_segments(deck, node, &part->facets);
    else
        deck_read_facets(deck, node, &part->facets);
}

static int read_surface(struct deck *deck, const struct deck_node *node, struct model_surface *surface)
{
    size_t n_parts = 0, n_analytic = 0, before = deck->n_problems;
    surface->where = node->where;
    surface->name = deck_word(deck, node, "name");
    for (const struct deck_node *child = node->children; child; child = child->next) {
        n_analytic += is_analytic(child);
        n_parts += !is_analytic(child) && !is_motion(child);
    }
    if (n_analytic + n_parts == 0)
        deck_error(deck, node, NULL,
                   "is empty: it needs facets (skin, arc, segments, facets) or a plane, circle, "
                   "cylinder or sphere");
    else if (n_analytic > 1 || (n_analytic && n_parts))
        deck_error(deck, node, NULL,
                   "takes either facets or one plane, circle, cylinder or sphere; make several surfaces");
    deck_read_motion(deck, node, &surface->motion);
    surface->kind = SURFACE_FACETS;
    CHECK_MEMORY(surface->parts = memory_create(n_parts, sizeof *surface->parts));
    for (const struct deck_node *child = node->children; child; child = child->next) {
        if (is_analytic(child))
            read_analytic(deck, child, surface);
        else if (!is_motion(child))
            read_part(deck, child, surface);
    }
    if (deck->n_problems == before && !deck->status && surface->kind == SURFACE_FACETS) {
        bool usable = true; // a mesh with mistakes has no skin
        for (size_t p = 0; p < surface->n_parts; p++)
            usable = usable && (surface->parts[p].mesh < 0 ||
                                deck->model->meshes[surface->parts[p].mesh].mesh.connectivity);
        if (usable)
            deck->status = surface_build(deck->model, surface);
    }
    return deck->status;
}

int deck_read_surfaces(struct deck *deck)
{
    const struct deck_node *section = deck_child(deck->root, SCHEMA_SURFACES);
    struct model *model = deck->model;
    const size_t n = deck_count(section, SCHEMA_SURFACE);
    CHECK_MEMORY(model->surfaces = memory_create(n, sizeof *model->surfaces));
    CHECK_MEMORY(deck->surface_used = memory_create(n, sizeof *deck->surface_used));
    for (const struct deck_node *node = deck_child(section, SCHEMA_SURFACE); node; node = deck_next(node))
        CALL(read_surface(deck, node, &model->surfaces[model->n_surfaces++]));
    return deck->status;
}

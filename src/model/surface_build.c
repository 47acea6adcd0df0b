// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/surface_build.h"

#include "base/error.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double tolerance_between_parts = 1e-4; // of the bounding box's diagonal
static const double tolerance_within_part = 1e-9;

/** A point of a part before merging. */
struct candidate {
    double x[3];
    int32_t part, mesh, node;
    int32_t built; // number of the built point, or -1
    uint32_t rank; // mesh points first, then in order of the parts
};

/** All points and facets of the parts; facets refer to candidates. */
struct gathering {
    size_t n_candidates, n_facets;
    struct candidate *candidates;
    int32_t (*facets)[4];
    int32_t (*sides)[SIDE_MAX_NODES]; // NULL while no facet is a piece of a curved side
    size_t candidate_capacity, facet_capacity;
    struct candidate **by_x; // candidates in ascending order of x
};

/** A part whose points are gathered. */
struct gathered_part {
    const struct facets *facets;
    int32_t part, mesh;
    int32_t *number; // per point: its candidate plus one, 0: not met yet
};

static int candidate_compare(const void *left, const void *right)
{
    const struct candidate *a = *(struct candidate *const *)left, *b = *(struct candidate *const *)right;
    if (a->x[0] != b->x[0])
        return a->x[0] < b->x[0] ? -1 : 1;
    return a->rank < b->rank ? -1 : a->rank > b->rank;
}

/** Candidate of a point, which is appended when it is met first; -1: no point. */
static int32_t gathering_number(struct gathering *gathering, const struct gathered_part *part, int32_t node)
{
    if (node < 0)
        return -1;
    if (!part->number[node]) {
        struct candidate *candidate = &gathering->candidates[gathering->n_candidates++];
        memcpy(candidate->x, part->facets->points[node], sizeof candidate->x);
        candidate->part = part->part;
        candidate->mesh = part->mesh;
        candidate->node = part->mesh >= 0 ? node : -1;
        candidate->built = -1;
        part->number[node] = (int32_t)gathering->n_candidates;
    }
    return part->number[node] - 1;
}

/** Room for the points and facets of one part. */
static int gathering_reserve(struct gathering *gathering, const struct facets *facets, bool curved)
{
    size_t side_capacity = gathering->sides ? gathering->facet_capacity : 0;
    CALL(memory_grow((void **)&gathering->candidates, &gathering->candidate_capacity,
                     gathering->n_candidates + facets->n_points, sizeof *gathering->candidates));
    CALL(memory_grow((void **)&gathering->facets, &gathering->facet_capacity,
                     gathering->n_facets + facets->n_facets, sizeof *gathering->facets));
    if (!curved)
        return 0;
    CALL(memory_grow((void **)&gathering->sides, &side_capacity, gathering->facet_capacity,
                     sizeof *gathering->sides));
    return 0;
}

/** Append the facets of one part and the points they use. */
static int gathering_add(struct gathering *gathering, const struct facets *facets, int32_t part, int32_t mesh,
                         bool curved)
{
    const struct gathered_part gathered = {facets, part, mesh,
                                           memory_create(facets->n_points, sizeof *gathered.number)};
    CHECK_MEMORY(gathered.number);
    const int status = gathering_reserve(gathering, facets, curved);
    for (size_t f = 0; !status && f < facets->n_facets; f++) {
        const size_t at = gathering->n_facets++;
        for (int k = 0; k < 4; k++)
            gathering->facets[at][k] = gathering_number(gathering, &gathered, facets->nodes[f][k]);
        for (int k = 0; curved && k < SIDE_MAX_NODES; k++)
            gathering->sides[at][k] =
                facets->sides ? gathering_number(gathering, &gathered, facets->sides[f][k]) : -1;
    }
    memory_free(gathered.number);
    return status;
}

/** Whether some part is the skin of a mesh with curved sides. */
static bool has_curved_sides(const struct model *model, const struct model_surface *surface)
{
    for (size_t p = 0; p < surface->n_parts; p++)
        if (surface->parts[p].mesh >= 0 &&
            element_is_quadratic(model->meshes[surface->parts[p].mesh].mesh.type))
            return true;
    return false;
}

static int gathering_fill(struct gathering *gathering, const struct model *model,
                          const struct model_surface *surface)
{
    const bool curved = has_curved_sides(model, surface);
    for (size_t p = 0; p < surface->n_parts; p++) {
        const struct surface_part *part = &surface->parts[p];
        struct facets skin = {0};
        if (part->mesh >= 0) {
            const struct mesh *mesh = &model->meshes[part->mesh].mesh;
            CALL(mesh_skin(mesh, part->excluded, part->n_excluded, &skin));
        }
        const struct facets *facets = part->mesh >= 0 ? &skin : &part->facets;
        int status =
            facets->n_facets
                ? gathering_add(gathering, facets, (int32_t)p, part->mesh, curved)
                : error_report(STATUS_DECK, "%s:%d:%d: <surface name=\"%s\">: part %zu has no facets",
                               model->path, surface->where.line, surface->where.column, surface->name, p + 1);
        facets_reset(&skin);
        CALL(status);
    }
    return 0;
}

static double gathering_diagonal(const struct gathering *gathering)
{
    double square = 0.0;
    for (int d = 0; d < 3; d++) {
        double lower = INFINITY, upper = -INFINITY;
        for (size_t i = 0; i < gathering->n_candidates; i++) {
            lower = fmin(lower, gathering->candidates[i].x[d]);
            upper = fmax(upper, gathering->candidates[i].x[d]);
        }
        square += gathering->n_candidates ? (upper - lower) * (upper - lower) : 0.0;
    }
    return sqrt(square);
}

/** The built point that @p candidate falls together with (the nearest), or -1. */
static int32_t gathering_partner(const struct gathering *gathering, const struct candidate *candidate,
                                 double diagonal)
{
    const double reach = tolerance_between_parts * diagonal;
    size_t low = 0, high = gathering->n_candidates;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (gathering->by_x[middle]->x[0] < candidate->x[0] - reach)
            low = middle + 1;
        else
            high = middle;
    }
    int32_t partner = -1;
    double nearest = INFINITY;
    for (; low < gathering->n_candidates && gathering->by_x[low]->x[0] <= candidate->x[0] + reach; low++) {
        const struct candidate *other = gathering->by_x[low];
        bool same_part = other->part == candidate->part;
        if (other == candidate || other->built < 0 || (same_part && candidate->mesh >= 0))
            continue;
        double distance = sqrt(pow(other->x[0] - candidate->x[0], 2) + pow(other->x[1] - candidate->x[1], 2) +
                               pow(other->x[2] - candidate->x[2], 2));
        if (distance <= (same_part ? tolerance_within_part * diagonal : reach) && distance < nearest) {
            nearest = distance;
            partner = other->built;
        }
    }
    return partner;
}

/** Number the built points: mesh points first, so that others join them. */
static int gathering_merge(struct gathering *gathering, struct model_surface *surface)
{
    const size_t n = gathering->n_candidates;
    struct facets *built = &surface->built;
    gathering->by_x = memory_create(n, sizeof *gathering->by_x);
    CHECK_MEMORY(gathering->by_x);
    CHECK_MEMORY(built->points = memory_create(n, sizeof *built->points));
    CHECK_MEMORY(surface->built_mesh = memory_create(n, sizeof *surface->built_mesh));
    CHECK_MEMORY(surface->built_node = memory_create(n, sizeof *surface->built_node));
    for (size_t i = 0; i < n; i++) {
        gathering->candidates[i].rank = (uint32_t)i;
        gathering->by_x[i] = &gathering->candidates[i];
    }
    if (n)
        qsort(gathering->by_x, n, sizeof *gathering->by_x, candidate_compare);
    const double diagonal = gathering_diagonal(gathering);
    for (int pass = 0; pass < 2; pass++)
        for (size_t i = 0; i < n; i++) {
            struct candidate *candidate = &gathering->candidates[i];
            if ((candidate->mesh < 0) != pass)
                continue;
            int32_t point = gathering_partner(gathering, candidate, diagonal);
            if (point < 0) {
                point = (int32_t)built->n_points++;
                memcpy(built->points[point], candidate->x, sizeof candidate->x);
                surface->built_mesh[point] = candidate->mesh;
                surface->built_node[point] = candidate->node;
            }
            candidate->built = point;
        }
    return 0;
}

/** The curved side of facet @p f in built points; a facet that has lost a corner stands for itself. */
static void gathering_side(const struct gathering *gathering, size_t f, bool whole, int32_t *side)
{
    for (int k = 0; k < SIDE_MAX_NODES; k++) {
        const int32_t candidate = gathering->sides[f][k];
        side[k] = whole && candidate >= 0 ? gathering->candidates[candidate].built : -1;
    }
}

/** Facets of built points; corners that fell together are dropped. */
static int gathering_connect(const struct gathering *gathering, int dim, struct facets *built)
{
    CHECK_MEMORY(built->nodes = memory_create(gathering->n_facets, sizeof *built->nodes));
    if (gathering->sides)
        CHECK_MEMORY(built->sides = memory_create(gathering->n_facets, sizeof *built->sides));
    for (size_t f = 0; f < gathering->n_facets; f++) {
        int32_t kept[4] = {-1, -1, -1, -1};
        int n = 0, corners = 0;
        for (; corners < 4 && gathering->facets[f][corners] >= 0; corners++) {
            int32_t point = gathering->candidates[gathering->facets[f][corners]].built;
            if ((n == 0 || kept[n - 1] != point) && (n < 2 || kept[0] != point))
                kept[n++] = point;
        }
        if (n < dim)
            continue;
        if (built->sides)
            gathering_side(gathering, f, n == corners, built->sides[built->n_facets]);
        memcpy(built->nodes[built->n_facets++], kept, sizeof kept);
    }
    return 0;
}

int surface_build(const struct model *model, struct model_surface *surface)
{
    surface_build_reset(surface);
    surface->built.dim = model->dim;
    if (surface->kind != SURFACE_FACETS)
        return 0;
    struct gathering gathering = {0};
    int status = gathering_fill(&gathering, model, surface);
    if (!status)
        status = gathering_merge(&gathering, surface);
    if (!status)
        status = gathering_connect(&gathering, model->dim, &surface->built);
    memory_free(gathering.candidates);
    memory_free(gathering.facets);
    memory_free(gathering.sides);
    memory_free(gathering.by_x);
    if (status)
        surface_build_reset(surface);
    return status;
}

void surface_build_reset(struct model_surface *surface)
{
    facets_reset(&surface->built);
    memory_free(surface->built_mesh);
    memory_free(surface->built_node);
    surface->built_mesh = surface->built_node = NULL;
}

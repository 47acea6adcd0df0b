// SPDX-License-Identifier: GPL-3.0-or-later
#include "wall/wall_places.h"

#include "base/error.h"
#include "base/memory.h"
#include "model/mesh_search.h"

#include <math.h>
#include <string.h>

/** How far before a surface a lattice point may lie and still belong to the wall (of dx): the fluid keeps as
 * far away. */
#define SURFACE_MARGIN 0.02
/** The same for the elements behind straight facets that stand for curved sides. */
#define CURVED_MARGIN 0.25

/** What is asked of each lattice point. */
struct filling {
    const struct model *model;
    const struct model_wall *wall;
    double spacing, support;
    double *distance;          /**< per surface: of the point at hand */
    struct facets *prescribed; /**< per surface: facets that are not the skin of a mesh (parts of built) */
    double (*lower)[3], (*upper)[3]; /**< per surface: box that holds everything within reach of it */
    struct mesh_search
        *searches; /**< per mesh of the model; without a mesh where the wall has nothing of it */
};

bool wall_places_has_mesh(const struct model_surface *surface, int mesh)
{
    for (size_t k = 0; k < surface->n_parts; ++k)
        if (surface->kind == SURFACE_FACETS && surface->parts[k].mesh == mesh)
            return true;
    return false;
}

static const struct model_surface *surface_of(const struct filling *filling, size_t s)
{
    return &filling->model->surfaces[filling->wall->surfaces[s]];
}

static bool has_skin(const struct model_surface *surface)
{
    for (size_t k = 0; k < surface->n_parts; ++k)
        if (surface->kind == SURFACE_FACETS && surface->parts[k].mesh >= 0)
            return true;
    return false;
}

/** Signed distance to a surface in the reference configuration, positive in the fluid. */
static double surface_distance(const struct model_surface *surface, int dim, const double x[3])
{
    double d[3], along = 0.0, r2 = 0.0;
    if (surface->kind == SURFACE_FACETS)
        return facets_distance(&surface->built, x);
    for (int k = 0; k < 3; ++k) {
        d[k] = k < dim ? x[k] - surface->centre[k] : 0.0;
        along += d[k] * surface->axis[k];
        r2 += d[k] * d[k];
    }
    if (surface->kind == SURFACE_PLANE)
        return along;
    double r = sqrt(fmax(0.0, surface->kind == SURFACE_CYLINDER && dim == 3 ? r2 - along * along : r2));
    return surface->fluid_inside ? surface->radius - r : r - surface->radius;
}

/** The facets of a surface that some prescribed point belongs to. */
static int prescribed_init(const struct model_surface *surface, struct facets *facets)
{
    const struct facets *built = &surface->built;
    *facets = (struct facets){.dim = built->dim, .n_points = built->n_points, .points = built->points};
    CHECK_MEMORY(facets->nodes = memory_create(built->n_facets, sizeof *facets->nodes));
    for (size_t f = 0; f < built->n_facets; ++f) {
        bool moved = true;
        for (int k = 0; k < 4 && built->nodes[f][k] >= 0; ++k)
            moved = moved && surface->built_mesh[built->nodes[f][k]] >= 0;
        if (!moved)
            memcpy(facets->nodes[facets->n_facets++], built->nodes[f], sizeof *facets->nodes);
    }
    return 0;
}

static void box_fill(struct filling *filling, size_t s)
{
    const struct model_surface *surface = surface_of(filling, s);
    const bool facets = surface->kind == SURFACE_FACETS;
    for (int d = 0; d < 3; ++d) {
        double low = INFINITY, high = -INFINITY;
        for (size_t i = 0; facets && i < surface->built.n_points; ++i) {
            low = fmin(low, surface->built.points[i][d]);
            high = fmax(high, surface->built.points[i][d]);
        }
        filling->lower[s][d] = facets ? low - 1.01 * filling->support : -INFINITY;
        filling->upper[s][d] = facets ? high + 1.01 * filling->support : INFINITY;
    }
}

static int filling_init(struct filling *filling)
{
    const size_t n = filling->wall->n_surfaces;
    CHECK_MEMORY(filling->distance = memory_create(n, sizeof *filling->distance));
    CHECK_MEMORY(filling->prescribed = memory_create(n, sizeof *filling->prescribed));
    CHECK_MEMORY(filling->lower = memory_create(n, sizeof *filling->lower));
    CHECK_MEMORY(filling->upper = memory_create(n, sizeof *filling->upper));
    CHECK_MEMORY(filling->searches = memory_create(filling->model->n_meshes, sizeof *filling->searches));
    for (size_t s = 0; s < n; ++s) {
        const struct model_surface *surface = surface_of(filling, s);
        box_fill(filling, s);
        if (has_skin(surface))
            CALL(prescribed_init(surface, &filling->prescribed[s]));
        for (size_t m = 0; m < filling->model->n_meshes; ++m) {
            const struct mesh *mesh = &filling->model->meshes[m].mesh;
            const double margin = element_is_quadratic(mesh->type) ? CURVED_MARGIN : SURFACE_MARGIN;
            if (wall_places_has_mesh(surface, (int)m) && !filling->searches[m].mesh)
                CALL(mesh_search_init(&filling->searches[m], mesh, margin * filling->spacing));
        }
    }
    return 0;
}

static void filling_reset(struct filling *filling)
{
    for (size_t s = 0; filling->prescribed && s < filling->wall->n_surfaces; ++s)
        memory_free(filling->prescribed[s].nodes);
    for (size_t m = 0; filling->searches && m < filling->model->n_meshes; ++m)
        mesh_search_reset(&filling->searches[m]);
    memory_free(filling->distance);
    memory_free(filling->prescribed);
    memory_free(filling->lower);
    memory_free(filling->upper);
    memory_free(filling->searches);
}

static bool within_reach(const struct filling *filling, const double X[3])
{
    for (size_t s = 0; s < filling->wall->n_surfaces; ++s) {
        bool within = true;
        for (int d = 0; d < filling->model->dim; ++d)
            within = within && X[d] >= filling->lower[s][d] && X[d] <= filling->upper[s][d];
        if (within)
            return true;
    }
    return false;
}

/** Whether a point whose signed distance from the wall is @p distance is a wall particle's. */
static bool behind(const struct filling *filling, double distance)
{
    return distance <= SURFACE_MARGIN * filling->spacing && distance >= -filling->support;
}

/** Make place @p k a material point of a mesh, that of the nearest surface which has it; or return false. */
static bool place_in_mesh(const struct filling *filling, struct wall_places *places, size_t k)
{
    for (size_t m = 0; m < filling->model->n_meshes; ++m) {
        size_t element;
        double nearest = INFINITY;
        if (!filling->searches[m].mesh ||
            !mesh_search_find(&filling->searches[m], places->X[k], &element, places->xi[k]))
            continue;
        for (size_t s = 0; s < filling->wall->n_surfaces; ++s)
            if (wall_places_has_mesh(surface_of(filling, s), (int)m) &&
                fabs(filling->distance[s]) < nearest) {
                nearest = fabs(filling->distance[s]);
                places->surface[k] = (int32_t)s;
            }
        places->mesh[k] = (int32_t)m;
        places->element[k] = (uint32_t)element;
        return true;
    }
    return false;
}

/** Make place @p k one behind what is not skin, if it is one. */
static bool place_prescribed(const struct filling *filling, struct wall_places *places, size_t k)
{
    double deepest = INFINITY;
    for (size_t s = 0; s < filling->wall->n_surfaces; ++s) {
        const struct facets *facets = &filling->prescribed[s];
        double d = filling->distance[s];
        if (has_skin(surface_of(filling, s)))
            d = facets->n_facets ? facets_distance(facets, places->X[k]) : INFINITY;
        if (d < deepest) {
            deepest = d;
            places->surface[k] = (int32_t)s;
        }
    }
    places->mesh[k] = -1;
    return behind(filling, deepest);
}

/** Whether the wall has a particle at place @p k; fills what moves it. */
static bool place_take(const struct filling *filling, struct wall_places *places, size_t k)
{
    double deepest = INFINITY;
    if (!within_reach(filling, places->X[k]))
        return false;
    for (size_t s = 0; s < filling->wall->n_surfaces; ++s) {
        filling->distance[s] = surface_distance(surface_of(filling, s), filling->model->dim, places->X[k]);
        deepest = fmin(deepest, filling->distance[s]);
    }
    return behind(filling, deepest) &&
           (place_in_mesh(filling, places, k) || place_prescribed(filling, places, k));
}

/** Room for @p n places; @p capacity: of each array, 0 at first. */
static int places_reserve(struct wall_places *places, size_t capacity[5], size_t n)
{
    CALL(memory_grow((void **)&places->X, &capacity[0], n, sizeof *places->X));
    CALL(memory_grow((void **)&places->surface, &capacity[1], n, sizeof *places->surface));
    CALL(memory_grow((void **)&places->mesh, &capacity[2], n, sizeof *places->mesh));
    CALL(memory_grow((void **)&places->element, &capacity[3], n, sizeof *places->element));
    return memory_grow((void **)&places->xi, &capacity[4], n, sizeof *places->xi);
}

/** Of the @p n points of a lattice what belongs to the wall. */
static int places_filter(const struct filling *filling, size_t n, const double (*lattice)[3],
                         struct wall_places *places)
{
    size_t capacity[5] = {0};
    for (size_t i = 0; i < n; ++i) {
        CALL(places_reserve(places, capacity, places->n + 1));
        memcpy(places->X[places->n], lattice[i], sizeof *places->X);
        places->n += place_take(filling, places, places->n);
    }
    return 0;
}

/** What lies behind the surfaces, on the lattice of the fluid. */
static int places_behind(const struct filling *filling, struct wall_places *places)
{
    const struct model *model = filling->model;
    const struct model_region *region = &model->fluid.regions[0];
    double lower[3] = {0}, upper[3], (*lattice)[3];
    shape_bounds(&region->shape, model->dim, lower, upper);
    const double *origin = region->has_origin ? region->origin
                           : region->n_points ? model->domain.lower
                                              : lower;
    struct shape domain = {.kind = SHAPE_BOX};
    size_t n;
    memcpy(domain.a, model->domain.lower, sizeof domain.a);
    memcpy(domain.b, model->domain.upper, sizeof domain.b);
    CALL(geometry_fill(&domain, model->dim, filling->spacing, origin, 0.0, &lattice, &n));
    const int status = places_filter(filling, n, (const double(*)[3])lattice, places);
    memory_free(lattice);
    return status;
}

/** The particles of the deck's region. */
static int places_given(const struct filling *filling, struct wall_places *places)
{
    const struct model_region *region = &filling->wall->region;
    const int dim = filling->model->dim;
    double lower[3] = {0}, upper[3], (*points)[3] = region->points;
    size_t capacity[5] = {0}, n = region->n_points;
    if (!region->n_points) {
        shape_bounds(&region->shape, dim, lower, upper);
        CALL(geometry_fill(&region->shape, dim, filling->spacing, region->has_origin ? region->origin : lower,
                           0.0, &points, &n));
    }
    const int status = places_reserve(places, capacity, n);
    for (size_t k = 0; k < n && !status; ++k) {
        memcpy(places->X[k], points[k], sizeof *places->X);
        places->surface[k] = places->mesh[k] = -1;
    }
    places->n = n;
    if (!region->n_points)
        memory_free(points);
    return status;
}

int wall_places_init(struct wall_places *places, const struct model *model, const struct model_wall *wall,
                     double spacing, double support)
{
    struct filling filling = {.model = model, .wall = wall, .spacing = spacing, .support = support};
    *places = (struct wall_places){0};
    if (wall->has_region)
        return places_given(&filling, places);
    int status = filling_init(&filling);
    if (!status)
        status = places_behind(&filling, places);
    filling_reset(&filling);
    return status;
}

void wall_places_reset(struct wall_places *places)
{
    memory_free(places->X);
    memory_free(places->surface);
    memory_free(places->mesh);
    memory_free(places->element);
    memory_free(places->xi);
    *places = (struct wall_places){0};
}

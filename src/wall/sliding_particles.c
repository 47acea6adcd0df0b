// SPDX-License-Identifier: GPL-3.0-or-later
// Sliding boundary particles (Fuchs et al. 2021, section 3.3): each fluid particle near a wall carries blocks
// of virtual particles that slide along the wall with it. Facet surfaces take facet shares (facet_shares.h)
// by default, so that blocks of neighbouring facets add up to one wall at corners of any angle;
// corners="paper" keeps the published rule for contact points. This file: the object, and the search for near
// particles.
#include "wall/sliding_particles.h"

#include "base/error.h"
#include "base/log.h"
#include "base/memory.h"
#include "model/surface_rims.h"
#include "wall/wall_list.h"

#include <omp.h>
#include <string.h>

/** Corners of a plane quad, edges that meet, and points that are one, in lattice spacings and support radii.
 */
#define FLAT_PART 0.02
#define JOINT_PART 0.02
#define SNAP_PART 1e-7

enum { SHIFT_CODES = 3 };

/** Whether a rotation turns the direction @p axis. */
static bool turns(const struct motion *motion, const double axis[3])
{
    if (motion->kind != MOTION_RIGID || !motion->angle || expression_is_steady(motion->angle))
        return false;
    double c = 0.0, n = 0.0;
    for (int k = 0; k < 3; ++k) {
        c += axis[k] * motion->axis[k];
        n += axis[k] * axis[k];
    }
    return c * c < (1.0 - 1e-12) * n;
}

static int check_surface(const struct model *model, const struct model_wall *wall, int index)
{
    const struct model_surface *surface = &model->surfaces[index];
    const int line = wall->where.line, column = wall->where.column;
    bool facets = surface->kind == SURFACE_FACETS;
    CHECK(model->dim > 1 || surface->kind == SURFACE_PLANE, STATUS_DECK,
          "%s:%d:%d: error: <wall name=\"%s\">: in 1-D sliding particles need planes, but surface \"%s\" is "
          "none",
          model->path, line, column, wall->name, surface->name);
    CHECK(facets || surface->motion.kind != MOTION_FIELD, STATUS_DECK,
          "%s:%d:%d: error: <wall name=\"%s\">: surface \"%s\" is analytic and would be deformed by its "
          "motion; "
          "give it as facets, or a rotation and translation",
          model->path, line, column, wall->name, surface->name);
    bool tilts = surface->kind == SURFACE_PLANE || (surface->kind == SURFACE_CYLINDER && model->dim == 3);
    CHECK(!tilts || !turns(&surface->motion, surface->axis), STATUS_DECK,
          "%s:%d:%d: error: <wall name=\"%s\">: the rotation tilts surface \"%s\"; give it as facets",
          model->path, line, column, wall->name, surface->name);
    for (size_t w = 0; w < model->n_walls; ++w)
        for (size_t s = 0; s < model->walls[w].n_surfaces; ++s)
            CHECK(&model->walls[w] == wall || model->walls[w].surfaces[s] != index, STATUS_DECK,
                  "%s:%d:%d: error: <wall name=\"%s\">: surface \"%s\" belongs to wall \"%s\" already",
                  model->path, line, column, wall->name, surface->name, model->walls[w].name);
    return 0;
}

static double facet_size(const struct facets *facets, size_t f)
{
    const int32_t *nodes = facets->nodes[f];
    const int last = nodes[3] >= 0 ? 3 : 2;
    const double *o = facets->points[nodes[0]];
    double normal[3] = {0.0, 0.0, 0.0};
    for (int c = 1; c < last; ++c) {
        const double *a = facets->points[nodes[c]], *b = facets->points[nodes[c + 1]];
        normal[0] += (a[1] - o[1]) * (b[2] - o[2]) - (a[2] - o[2]) * (b[1] - o[1]);
        normal[1] += (a[2] - o[2]) * (b[0] - o[0]) - (a[0] - o[0]) * (b[2] - o[2]);
        normal[2] += (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
    }
    double area2 = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
    return sqrt(0.5 * sqrt(area2) * (last == 2 ? 2.0 : 1.0));
}

/** Facets that end within the domain are often a mistake, those that should meet but do not always are: 0.05
 * spacings cost 1 to 2 % of the density there, half a spacing a quarter. */
static int check_rims(const struct model *model, const struct model_wall *wall)
{
    const double spacing = model->fluid.spacing;
    const struct facets **surfaces = memory_create(wall->n_surfaces, sizeof *surfaces);
    struct surface_rims rims;
    CHECK_MEMORY(surfaces);
    for (size_t k = 0; k < wall->n_surfaces; ++k)
        surfaces[k] = &model->surfaces[wall->surfaces[k]].built;
    int status = surface_rims_find(surfaces, wall->n_surfaces, JOINT_PART * spacing, spacing,
                                   model->domain.lower, model->domain.upper, &rims);
    memory_free(surfaces);
    CALL(status);
    CHECK(rims.gap == 0.0, STATUS_DECK,
          "%s:%d:%d: error: <wall name=\"%s\">: facets miss each other by %.3g m (%.2g spacings) at (%g, %g, "
          "%g): edges that are meant to meet must do so within %g spacings, others end a spacing apart",
          model->path, wall->where.line, wall->where.column, wall->name, rims.gap, rims.gap / spacing,
          rims.place[0], rims.place[1], rims.place[2], JOINT_PART);
    if (rims.n_open)
        log_message(LOG_WARNING,
                    "%s:%d:%d: the surfaces of <wall name=\"%s\"> are not closed (%zu open %s): they should "
                    "continue at least three spacings beyond openings and periodic sides",
                    model->path, wall->where.line, wall->where.column, wall->name, rims.n_open,
                    model->dim == 2 ? "ends" : "edges");
    return 0;
}

static int sliding_check(const struct model *model, const struct model_wall *wall)
{
    const int line = wall->where.line, column = wall->where.column;
    CHECK(!wall->has_region, STATUS_DECK,
          "%s:%d:%d: error: <wall name=\"%s\">: sliding particles stand on surfaces; a region of wall "
          "particles "
          "belongs to treatment=\"fixed-particles\"",
          model->path, line, column, wall->name);
    CHECK(wall->n_surfaces > 0, STATUS_DECK,
          "%s:%d:%d: error: <wall name=\"%s\">: sliding particles need a surface", model->path, line, column,
          wall->name);
    for (size_t k = 0; k < wall->n_surfaces; ++k) {
        CALL(check_surface(model, wall, wall->surfaces[k]));
        const struct model_surface *surface = &model->surfaces[wall->surfaces[k]];
        size_t small = 0;
        for (size_t f = 0; model->dim == 3 && f < surface->built.n_facets; ++f)
            small += facet_size(&surface->built, f) < model->fluid.spacing;
        if (small)
            log_message(
                LOG_WARNING,
                "%s:%d:%d: surface \"%s\" has %zu facets smaller than the particle spacing: walls cost "
                "less with facets of at least twice the spacing",
                model->path, line, column, surface->name, small);
    }
    return model->dim > 1 ? check_rims(model, wall) : 0;
}

static void count_facets(const struct boundary *boundary, struct sliding *s)
{
    for (size_t k = 0; k < boundary->n_surfaces; ++k) {
        const struct surface *surface = boundary->surfaces[k];
        for (size_t f = 0; f < surface->n_facets; ++f) {
            int n = surface->nodes[f][2] < 0 ? 2 : surface->nodes[f][3] < 0 ? 3 : 4;
            if (s->facets)
                s->facets[s->n_facets] =
                    (struct sliding_facet){(int32_t)k, (int32_t)f, (int32_t)s->n_pieces, 0, n};
            s->n_pieces += n == 4 ? 4 : 1;
            ++s->n_facets;
        }
    }
}

static int sliding_allocate(struct boundary *boundary, struct sliding *s)
{
    count_facets(boundary, s);
    CHECK_MEMORY(s->facets = memory_create(s->n_facets, sizeof *s->facets));
    CHECK_MEMORY(s->pieces = memory_create(s->n_pieces, sizeof *s->pieces));
    s->n_facets = s->n_pieces = 0;
    count_facets(boundary, s);
    CHECK_MEMORY(s->shapes = memory_create(boundary->n_surfaces, sizeof *s->shapes));
    CHECK_MEMORY(s->pending_moment = memory_create(boundary->n_surfaces, sizeof *s->pending_moment));
    CHECK_MEMORY(s->pending = memory_create(boundary->n_surfaces, sizeof *s->pending));
    CHECK_MEMORY(s->wall_x = memory_create(boundary->n_surfaces, sizeof *s->wall_x));
    for (size_t k = 0; k < boundary->n_surfaces; ++k) {
        const struct surface *surface = boundary->surfaces[k];
        CHECK_MEMORY(s->pending[k] = memory_create(surface->n_points, sizeof **s->pending));
        CHECK_MEMORY(s->wall_x[k] = memory_create(surface->n_points, sizeof **s->wall_x));
        const size_t curved = surface->dim == 2 ? 3 : SIDE_MAX_NODES, plane = surface->dim == 2 ? 2 : 4;
        s->anchors =
            (surface->sides ? curved : plane) > s->anchors ? (surface->sides ? curved : plane) : s->anchors;
    }
    s->n_work = (size_t)omp_get_max_threads();
    CHECK_MEMORY(s->work = memory_create(s->n_work, sizeof *s->work));
    return 0;
}

static int sliding_create(struct boundary *boundary, const struct model *model, const struct fluid_view *view)
{
    (void)model;
    struct sliding *s = memory_create(1, sizeof *s);
    CHECK_MEMORY(s);
    boundary->data = s;
    s->paper = boundary->wall->corners == CORNERS_PAPER;
    s->gradient = boundary->wall->pressure_gradient;
    s->layered = view->dim == 3 && !s->paper;
    s->snap = SNAP_PART * view->kernel.support;
    s->flat = FLAT_PART * view->spacing;
    CALL(facet_shares_create(&s->shares, view->kernel, view->spacing, view->isa));
    s->block = (size_t)s->shares.layers;
    for (int k = 1; k < view->dim; ++k)
        s->block *= 2 * (size_t)s->shares.layers - 1;
    s->reach = s->paper ? view->kernel.support : s->shares.range;
    return sliding_allocate(boundary, s);
}

static void sliding_destroy(struct boundary *boundary)
{
    struct sliding *s = boundary->data;
    if (!s)
        return;
    facet_shares_reset(&s->shares);
    for (size_t k = 0; k < boundary->n_surfaces; ++k) {
        if (s->pending)
            memory_free(s->pending[k]);
        if (s->wall_x)
            memory_free(s->wall_x[k]);
    }
    for (size_t k = 0; s->work && k < s->n_work; ++k) {
        memory_free(s->work[k].hits);
        memory_free(s->work[k].contacts);
        memory_free(s->work[k].touches);
        memory_free(s->work[k].owners);
        memory_free(s->work[k].order);
        memory_free(s->work[k].list);
        memory_free(s->work[k].pairs);
        wall_neighbours_reset(&s->work[k].neighbours);
    }
    void *const arrays[] = {
        s->facets, s->pieces,      s->shapes,      s->candidates,    s->candidate_start, s->stamp,
        s->mask,   s->count,       s->contacts,    s->contact_start, s->contact_count,   s->touches,
        s->layers, s->touch_start, s->touch_count, s->rows,          s->clear,           s->clear_x,
        s->wall_x, s->put,         s->work,        s->pending,       s->pending_moment};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; ++k)
        memory_free(arrays[k]);
    memory_free(s);
    boundary->data = NULL;
}

static void place_shape(const struct surface *surface, struct sliding_shape *shape)
{
    const struct model_surface *definition = surface->definition;
    const double *axis = definition->axis;
    double length = 0.0;
    motion_frame_at(&definition->motion, surface->now.t, &shape->frame);
    memcpy(shape->centre, surface->now.x[0], sizeof shape->centre);
    for (int k = 0; k < 3; ++k) {
        const double *row = shape->frame.rotation[k];
        shape->axis[k] = row[0] * axis[0] + row[1] * axis[1] + row[2] * axis[2];
        length += shape->axis[k] * shape->axis[k];
    }
    if (surface->dim == 2 && definition->kind == SURFACE_CYLINDER) {
        shape->axis[0] = shape->axis[1] = 0.0;
        shape->axis[2] = length = 1.0;
    }
    for (int k = 0; k < 3 && length > 0.0; ++k)
        shape->axis[k] /= sqrt(length);
}

void sliding_place(struct boundary *boundary, bool again)
{
    struct sliding *s = boundary->data;
    if (s->placed && !boundary->moving)
        return;
    s->placed = true;
    for (size_t k = 0; k < boundary->n_surfaces; ++k)
        if (boundary->surfaces[k]->definition->kind != SURFACE_FACETS)
            place_shape(boundary->surfaces[k], &s->shapes[k]);
#pragma omp parallel for schedule(static)
    for (size_t f = 0; f < s->n_facets; ++f) {
        struct sliding_facet *facet = &s->facets[f];
        const struct surface *surface = boundary->surfaces[facet->surface];
        double x[4][3];
        struct piece pieces[4];
        for (int c = 0; c < 4 && c < facet->n_nodes; ++c)
            memcpy(x[c], surface->now.x[surface->nodes[facet->facet][c]], sizeof x[c]);
        facet->n_pieces = piece_cut(pieces, (int32_t)f, surface->dim, facet->n_nodes, (const double(*)[3])x,
                                    s->flat, again ? facet->n_pieces : 0);
        memcpy(&s->pieces[facet->pieces], pieces, (size_t)facet->n_pieces * sizeof *pieces);
    }
}

/** Periods that bring @p middle into the domain: walls that drift leave it as often as they like. */
static void image_find(const struct sliding *s, const struct cell_grid *grid, const double middle[3],
                       double image[3])
{
    for (int k = 0; k < 3; ++k)
        image[k] = s->period[k] > 0.0 ? -floor((middle[k] - grid->lower[k]) / s->period[k]) : 0.0;
}

/** The same for the middle of every facet. */
static void images_find(struct boundary *boundary, const struct cell_grid *grid)
{
    struct sliding *s = boundary->data;
    for (size_t f = 0; f < s->n_facets; ++f) {
        struct sliding_facet *facet = &s->facets[f];
        const struct surface *surface = boundary->surfaces[facet->surface];
        double middle[3] = {0.0, 0.0, 0.0};
        for (int c = 0; c < facet->n_nodes; ++c)
            for (int k = 0; k < 3; ++k)
                middle[k] += surface->now.x[surface->nodes[facet->facet][c]][k] / facet->n_nodes;
        image_find(s, grid, middle, facet->image);
    }
}

/** Note in @p work that particle @p j reaches @p item in the image @p shift beside the item's. */
static int add_pair(struct sliding_work *work, uint32_t j, int32_t item, const int shift[3])
{
    CALL(memory_grow((void **)&work->pairs, &work->pairs_capacity, work->n_pairs + 1, sizeof *work->pairs));
    work->pairs[work->n_pairs++] =
        (struct near_pair){j, {item, {(int8_t)shift[0], (int8_t)shift[1], (int8_t)shift[2]}}};
    return 0;
}

/** The bounding rectangle of a piece, cut into tiles of a few supports, so that large and slender facets cost
 * what they touch. */
struct tiling {
    const struct piece *piece;
    double low[2], step[2], half; /**< half: of a tile's diagonal */
    int tiles[2];
};

static void tiling_create(struct tiling *tiling, const struct piece *piece, double support)
{
    double high[2] = {0.0, 0.0};
    *tiling = (struct tiling){.piece = piece};
    for (int c = 1; c < piece->n; ++c)
        for (int k = 0; k < 2; ++k) {
            tiling->low[k] = fmin(tiling->low[k], piece->corner[c][k]);
            high[k] = fmax(high[k], piece->corner[c][k]);
        }
    for (int k = 0; k < 2; ++k) {
        tiling->tiles[k] = (int)ceil(fmax(1.0, (high[k] - tiling->low[k]) / support));
        tiling->step[k] = (high[k] - tiling->low[k]) / tiling->tiles[k];
    }
    tiling->half = 0.5 * sqrt(tiling->step[0] * tiling->step[0] + tiling->step[1] * tiling->step[1]);
}

/** Whether the point of the rectangle closest to @p x belongs to @p tile: it does to just one. */
static bool tile_owns(const struct tiling *tiling, const int tile[2], const double x[3])
{
    const struct piece *piece = tiling->piece;
    for (int k = 0; k < 2; ++k) {
        if (tiling->tiles[k] == 1)
            continue;
        double local = -tiling->low[k];
        for (int i = 0; i < 3; ++i)
            local += (x[i] - piece->origin[i]) * piece->axis[k][i];
        if ((tile[k] > 0 && local < tile[k] * tiling->step[k]) ||
            (tile[k] + 1 < tiling->tiles[k] && local >= (tile[k] + 1) * tiling->step[k]))
            return false;
    }
    return true;
}

/** Particles within @p reach of a piece that @p tile owns. */
static int search_tile(const struct sliding *s, const struct fluid_view *view, const struct tiling *tiling,
                       const int tile[2], double reach, struct sliding_work *work)
{
    const double *const *x = (const double *const *)view->particles->x;
    const struct piece *piece = tiling->piece;
    const double local[2] = {tiling->low[0] + (tile[0] + 0.5) * tiling->step[0],
                             tiling->low[1] + (tile[1] + 0.5) * tiling->step[1]},
                 radius = tiling->half + reach;
    double place[3];
    struct projection projection;
    piece_place(piece, local, place);
    projection_find(&projection, piece, place, 0.0);
    if (projection.distance > radius)
        return 0;
    struct cell_range ranges[CELL_GRID_RANGES];
    const size_t n_ranges = cell_grid_ranges(view->grid, place, radius, ranges);
    for (size_t r = 0; r < n_ranges; ++r) {
        int shift[3];
        for (int k = 0; k < 3; ++k) {
            shift[k] =
                s->period[k] > 0.0
                    ? (int)lround(-ranges[r].shift[k] / s->period[k] - s->facets[piece->facet].image[k])
                    : 0;
            if (shift[k] < -1 || shift[k] > 1)
                return work->quiet ? STATUS_NUMERICAL
                                   : error_report(STATUS_NUMERICAL,
                                                  "a wall facet at (%g, %g, %g) is too long for the period "
                                                  "of %g m in direction %c: give smaller facets",
                                                  place[0], place[1], place[2], s->period[k], "xyz"[k]);
        }
        for (uint32_t j = ranges[r].begin; j < ranges[r].end; ++j) {
            double at[3];
            for (int k = 0; k < 3; ++k)
                at[k] = x[k][j] + ranges[r].shift[k];
            if (fabs(piece_plane_distance(piece, at)) >= reach || !tile_owns(tiling, tile, at))
                continue;
            projection_find(&projection, piece, at, 0.0);
            if (projection.distance < reach)
                CALL(add_pair(work, j, piece->facet, shift));
        }
    }
    return 0;
}

/** Particles within @p reach of part @p part of @p n_parts of the facets; the pieces of a quad can note a
 * particle more than once. */
static int search_facets(const struct sliding *s, const struct fluid_view *view, size_t part, size_t n_parts,
                         double reach, struct sliding_work *work)
{
    const size_t begin = s->n_facets * part / n_parts, end = s->n_facets * (part + 1) / n_parts;
    for (size_t f = begin; f < end; ++f)
        for (int p = 0; p < s->facets[f].n_pieces; ++p) {
            const struct piece *piece = &s->pieces[s->facets[f].pieces + p];
            struct tiling tiling;
            tiling_create(&tiling, piece, view->kernel.support);
            for (int b = 0; b < tiling.tiles[1] && piece->n; ++b)
                for (int a = 0; a < tiling.tiles[0]; ++a)
                    CALL(search_tile(s, view, &tiling, (const int[2]){a, b}, reach, work));
        }
    return 0;
}

/** Whether periodic images of an analytic surface count: of bodies in the fluid, not of what bounds it. */
static bool shape_repeats(const struct model_surface *definition)
{
    return definition->kind != SURFACE_PLANE && !definition->fluid_inside;
}

/** Distance of @p x from the image of an analytic surface whose centre is nearest; @p shift: that image. */
static double sliding_shape_distance(const struct sliding *s, const struct sliding_shape *shape,
                                     const struct model_surface *definition, const double x[3], int shift[3])
{
    double r[3], along = 0.0, r2 = 0.0;
    for (int k = 0; k < 3; ++k) {
        r[k] = x[k] - shape->centre[k];
        shift[k] = 0;
        if (shape_repeats(definition) && s->period[k] > 0.0) {
            shift[k] = (int)lround(r[k] / s->period[k]);
            r[k] -= shift[k] * s->period[k];
        }
        along += r[k] * shape->axis[k];
        r2 += r[k] * r[k];
    }
    if (definition->kind == SURFACE_PLANE)
        return along;
    return sqrt(definition->kind == SURFACE_CYLINDER ? fmax(0.0, r2 - along * along) : r2) -
           definition->radius;
}

/** Particles near an analytic surface: all of them are asked, by all threads; those that are near are added
 * in turn. */
static int search_shape(struct boundary *boundary, const struct fluid_view *view, size_t surface,
                        double reach, struct sliding_work *work)
{
    struct sliding *s = boundary->data;
    const struct model_surface *definition = boundary->surfaces[surface]->definition;
    struct sliding_shape *shape = &s->shapes[surface];
    const double *const *x = (const double *const *)view->particles->x;
    const size_t n_particles = view->particles->n;
    CALL(memory_grow((void **)&s->count, &s->count_capacity, n_particles, sizeof *s->count));
    if (shape_repeats(definition))
        image_find(s, view->grid, shape->centre, shape->image);
#pragma omp parallel for schedule(static)
    for (size_t j = 0; j < n_particles; ++j) {
        int shift[3];
        const double at[3] = {x[0][j], x[1][j], x[2][j]};
        s->count[j] = fabs(sliding_shape_distance(s, shape, definition, at, shift)) < reach;
    }
    for (size_t j = 0; j < n_particles; ++j) {
        if (!s->count[j])
            continue;
        int shift[3];
        const double at[3] = {x[0][j], x[1][j], x[2][j]};
        sliding_shape_distance(s, shape, definition, at, shift);
        for (int k = 0; k < 3; ++k)
            shift[k] -= (int)shape->image[k];
        CALL(add_pair(work, (uint32_t)j, (int32_t)(s->n_facets + surface), shift));
    }
    return 0;
}

/** Drop pairs that are there twice; counts those of each particle. Returns the number of particles that have
 * some. */
static size_t pairs_count(struct sliding *s, size_t n, size_t *n_pairs)
{
    size_t n_near = 0;
    *n_pairs = 0;
    memset(s->stamp, 0, n * sizeof *s->stamp);
    memset(s->count, 0, n * sizeof *s->count);
    for (size_t t = 0; t < s->n_work; ++t) {
        struct sliding_work *work = &s->work[t];
        size_t kept = 0;
        for (size_t p = 0; p < work->n_pairs; ++p) {
            const uint32_t j = work->pairs[p].particle, item = (uint32_t)work->pairs[p].candidate.item;
            const int8_t *shift = work->pairs[p].candidate.shift;
            const uint32_t bit =
                1u << ((shift[0] + 1) + SHIFT_CODES * ((shift[1] + 1) + SHIFT_CODES * (shift[2] + 1)));
            if (s->stamp[j] != item + 1) {
                s->stamp[j] = item + 1;
                s->mask[j] = 0;
            }
            if (s->mask[j] & bit)
                continue;
            s->mask[j] |= bit;
            n_near += s->count[j]++ == 0;
            work->pairs[kept++] = work->pairs[p];
        }
        work->n_pairs = kept;
        *n_pairs += kept;
    }
    return n_near;
}

/** Sort the pairs by particle: near particles ascending, candidates ascending. */
static int fill_near(struct boundary *boundary, const struct fluid_view *view)
{
    struct sliding *s = boundary->data;
    const size_t n = view->particles->n;
    size_t n_pairs, offset = 0;
    CALL(memory_grow((void **)&s->count, &s->count_capacity, n, sizeof *s->count));
    CALL(memory_grow((void **)&s->stamp, &s->stamp_capacity, n, sizeof *s->stamp));
    CALL(memory_grow((void **)&s->mask, &s->mask_capacity, n, sizeof *s->mask));
    const size_t n_near = pairs_count(s, n, &n_pairs);
    CALL(boundary_reserve_near(boundary, n_near));
    CALL(memory_grow((void **)&s->candidate_start, &s->candidate_start_capacity, n_near + 1,
                     sizeof *s->candidate_start));
    CALL(memory_grow((void **)&s->candidates, &s->candidates_capacity, n_pairs, sizeof *s->candidates));
    boundary->n_near = n_near;
    size_t near = 0;
    for (size_t j = 0; j < n; ++j) {
        if (!s->count[j])
            continue;
        boundary->near[near] = (uint32_t)j;
        s->candidate_start[near] = offset;
        offset += s->count[j];
        s->count[j] = (uint32_t)near++;
    }
    s->candidate_start[n_near] = offset;
    // the starts serve as cursors and are set back afterwards
    for (size_t t = 0; t < s->n_work; ++t)
        for (size_t p = 0; p < s->work[t].n_pairs; ++p)
            s->candidates[s->candidate_start[s->count[s->work[t].pairs[p].particle]]++] =
                s->work[t].pairs[p].candidate;
    for (size_t k = n_near; k > 0; --k)
        s->candidate_start[k] = s->candidate_start[k - 1];
    s->candidate_start[0] = 0;
    return 0;
}

/** Room for the contacts of every near particle, and for the hits of the largest in each thread. */
static int reserve_contacts(struct boundary *boundary)
{
    struct sliding *s = boundary->data;
    const size_t n = boundary->n_near;
    CALL(
        memory_grow((void **)&s->contact_start, &s->contact_start_capacity, n + 1, sizeof *s->contact_start));
    CALL(memory_grow((void **)&s->touch_start, &s->touch_start_capacity, n + 1, sizeof *s->touch_start));
    CALL(memory_grow((void **)&s->contact_count, &s->contact_count_capacity, n, sizeof *s->contact_count));
    CALL(memory_grow((void **)&s->touch_count, &s->touch_count_capacity, n, sizeof *s->touch_count));
    CALL(memory_grow((void **)&s->clear, &s->clear_capacity, n, sizeof *s->clear));
    CALL(memory_grow((void **)&s->clear_x, &s->clear_x_capacity, n, sizeof *s->clear_x));
    CALL(memory_grow((void **)&s->put, &s->put_capacity, n, sizeof *s->put));
    size_t most = 0, contacts = 0, touches = 0;
    for (size_t k = 0; k < n; ++k) {
        size_t hits = 0, first = s->candidate_start[k], end = s->candidate_start[k + 1];
        for (size_t c = first; c < end; ++c) {
            size_t item = (size_t)s->candidates[c].item;
            hits += item < s->n_facets && s->facets[item].n_nodes == 4 ? 4 : 1;
        }
        most = hits > most ? hits : most;
        s->contact_start[k] = contacts;
        s->touch_start[k] = touches;
        contacts += end - first < 2 ? end - first : 2;
        touches += end - first < 4 ? end - first : 4;
        s->contact_count[k] = s->touch_count[k] = 0;
    }
    s->contact_start[n] = contacts;
    s->touch_start[n] = touches;
    s->clear_current = false;
    for (size_t t = 0; t < s->n_work; ++t) {
        struct sliding_work *work = &s->work[t];
        CALL(memory_grow((void **)&work->hits, &work->hits_capacity, most, sizeof *work->hits));
        CALL(memory_grow((void **)&work->contacts, &work->contacts_capacity, most, sizeof *work->contacts));
        CALL(memory_grow((void **)&work->touches, &work->touches_capacity, most, sizeof *work->touches));
        CALL(memory_grow((void **)&work->owners, &work->owners_capacity, most, sizeof *work->owners));
        CALL(memory_grow((void **)&work->order, &work->order_capacity, most, sizeof *work->order));
    }
    return sliding_reserve_contacts(s, n);
}

static int sliding_list(struct boundary *boundary, const struct fluid_view *view)
{
    struct sliding *s = boundary->data;
    const double reach = s->reach + view->skin;
    int status = 0;
    for (int k = 0; k < 3; ++k)
        s->period[k] = view->grid->periodic[k] ? view->grid->upper[k] - view->grid->lower[k] : 0.0;
    sliding_place(boundary, false);
    images_find(boundary, view->grid);
#pragma omp parallel for schedule(static, 1) reduction(| : status)
    for (size_t t = 0; t < s->n_work; ++t) {
        s->work[t].n_pairs = 0;
        s->work[t].quiet = true;
        status |= search_facets(s, view, t, s->n_work, reach, &s->work[t]);
    }
    /* what is wrong is told once, of the first facet: asked again in turn */
    for (size_t t = 0; t < s->n_work && status; ++t) {
        s->work[t].quiet = false;
        CALL(search_facets(s, view, t, s->n_work, reach, &s->work[t]));
    }
    CALL(status);
    for (size_t k = 0; k < boundary->n_surfaces; ++k)
        if (boundary->surfaces[k]->definition->kind != SURFACE_FACETS)
            CALL(search_shape(boundary, view, k, reach, &s->work[s->n_work - 1]));
    CALL(fill_near(boundary, view));
    return reserve_contacts(boundary);
}

const struct boundary_type boundary_sliding_particles = {
    .name = "sliding-particles",
    .check = sliding_check,
    .create = sliding_create,
    .destroy = sliding_destroy,
    .list = sliding_list,
    .put_back = sliding_put_back,
    .prepare = sliding_prepare,
    .close = sliding_close,
    .gather = sliding_gather,
    .unfold = sliding_unfold,
    .react = sliding_react,
    .load = sliding_load,
    .added_mass = sliding_added_mass,
};

// SPDX-License-Identifier: GPL-3.0-or-later
/* Walls of boundary particles fixed to the wall: Adami, Hu and Adams (2012), as Fuchs et al. (2021),
 * section 3.1.6. Pressure and velocity are extrapolated from the fluid by a local force balance. Wall
 * particles sit on the fluid's lattice behind the surfaces (so that flat walls are in line with the fluid),
 * or where the deck's region puts them, and move with the prescribed motion of their surface. Behind the skin
 * of a mesh they are material points of the mesh: where it is stretched they are drawn apart, and leave holes
 * in the end (section 4.1.4). */
#include "base/error.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "sph/boundary.h"
#include "wall/material_points.h"
#include "wall/wall_list.h"
#include "wall/wall_places.h"

#include <math.h>
#include <string.h>

/** How far outside a periodic side a wall particle may lie, of the period. */
#define WRAP_SLACK 1e-9

/** One wall particle within reach of a near particle. */
struct fixed_pair {
    uint32_t wall;
    uint8_t image; /**< periodic image: index into fixed_particles.shift */
};

/** The pairs of some consecutive particles that may be near, found by one thread. */
struct fixed_part {
    struct fixed_pair *pairs;
    size_t n_pairs, capacity;
};

struct fixed_particles {
    size_t n;
    char *group_name; /**< "wall-NAME" */
    struct wall_places places;
    struct material_points material; /**< the particles that meshes move */
    size_t *tensor;      /**< per material point: its place among the added masses of its surface */
    int32_t *load_point; /**< per particle: point of the surface that takes its load, -1: none, or several */
    double *x[3], *v[3], *a[3]; /**< of the wall */
    double *p, *rho, *u[3];     /**< extrapolated; u for the viscous term */
    double *listed[3];          /**< places when the lists were made */
    double *wrap[3];            /**< what brings a moving particle back into a periodic domain */
    double *force[3];           /**< reaction of this step */
    struct cell_grid grid;
    uint32_t *order;
    double shift[27][3];
    size_t n_pairs, pair_capacity, start_capacity;
    struct fixed_pair *pairs; /**< grouped by near particle */
    uint32_t *start;          /**< n_near + 1 */
    size_t back_capacity;
    uint32_t *back_start;  /**< n + 1: pairs grouped by wall particle */
    uint32_t *back;        /**< pair numbers */
    uint32_t *back_near;   /**< near number of each pair in back */
    double *pair_force[3]; /**< per pair */
    size_t force_capacity[3], back_near_capacity;
    /* workspace of the list */
    uint8_t *marked;             /**< per moving particle: may be near */
    uint32_t *candidate, *count; /**< the particles marked, and how many pairs each has */
    size_t marked_capacity, candidate_capacity, count_capacity, n_parts;
    struct fixed_part *parts; /**< one per thread */
};

/** A mesh that is filled with particles twice would weigh twice. */
static int check_alone(const struct model *model, const struct model_wall *wall, int mesh)
{
    for (size_t w = 0; w < model->n_walls; ++w)
        for (size_t s = 0; s < model->walls[w].n_surfaces; ++s) {
            const struct model_wall *other = &model->walls[w];
            const struct model_surface *surface = &model->surfaces[other->surfaces[s]];
            CHECK(other == wall || !wall_places_has_mesh(surface, mesh), STATUS_DECK,
                  "%s:%d:%d: error: <wall name=\"%s\">: its particles fill mesh \"%s\", which wall \"%s\" "
                  "has a "
                  "surface of, too; name all surfaces of a mesh in one wall",
                  model->path, wall->where.line, wall->where.column, wall->name, model->meshes[mesh].name,
                  other->name);
        }
    return 0;
}

static bool wall_has_mesh(const struct model *model, const struct model_wall *wall, int mesh)
{
    for (size_t s = 0; s < wall->n_surfaces; ++s)
        if (wall_places_has_mesh(&model->surfaces[wall->surfaces[s]], mesh))
            return true;
    return false;
}

/** Whether every mesh of the wall has particles. */
static int check_meshes(const struct model *model, const struct model_wall *wall,
                        const struct wall_places *places)
{
    for (size_t m = 0; m < model->n_meshes; ++m) {
        bool filled = !wall_has_mesh(model, wall, (int)m);
        for (size_t k = 0; k < places->n && !filled; ++k)
            filled = places->mesh[k] == (int32_t)m;
        CHECK(filled, STATUS_DECK,
              "%s:%d:%d: error: <wall name=\"%s\">: no point of the fluid's lattice (spacing %g m) lies "
              "inside "
              "mesh \"%s\"; take a smaller spacing, or treatment=\"sliding-particles\"",
              model->path, wall->where.line, wall->where.column, wall->name, model->fluid.spacing,
              model->meshes[m].name);
    }
    return 0;
}

static int fixed_particles_check(const struct model *model, const struct model_wall *wall)
{
    bool any = false;
    for (size_t m = 0; m < model->n_meshes; ++m)
        if (wall_has_mesh(model, wall, (int)m)) {
            any = true;
            CALL(check_alone(model, wall, (int)m));
        }
    if (!any)
        return 0;
    struct wall_places places;
    int status = wall_places_init(&places, model, wall, model->fluid.spacing, kernel_of_model(model).support);
    if (!status)
        status = check_meshes(model, wall, &places);
    wall_places_reset(&places);
    return status;
}

/** The point of a surface nearest to @p X takes the load of the wall particle there, unless a mesh moves it.
 */
static int32_t nearest_point(const struct surface *surface, const double X[3])
{
    int32_t best = -1;
    double least = INFINITY;
    for (size_t k = 0; k < surface->n_points; ++k) {
        double d2 = 0.0;
        for (int d = 0; d < 3; ++d)
            d2 += (surface->X[k][d] - X[d]) * (surface->X[k][d] - X[d]);
        if (d2 < least && surface->mesh[k] < 0) {
            least = d2;
            best = (int32_t)k;
        }
    }
    return best;
}

static int arrays_create(struct fixed_particles *f)
{
    double **const arrays[] = {&f->wrap[0],   &f->wrap[1],  &f->wrap[2], &f->listed[0], &f->listed[1],
                               &f->listed[2], &f->x[0],     &f->x[1],    &f->x[2],      &f->v[0],
                               &f->v[1],      &f->v[2],     &f->a[0],    &f->a[1],      &f->a[2],
                               &f->u[0],      &f->u[1],     &f->u[2],    &f->p,         &f->rho,
                               &f->force[0],  &f->force[1], &f->force[2]};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; ++k) {
        *arrays[k] = memory_create(f->n, sizeof(double));
        CHECK_MEMORY(*arrays[k]);
    }
    f->load_point = memory_create(f->n, sizeof *f->load_point);
    f->order = memory_create(f->n, sizeof *f->order);
    f->back_start = memory_create(f->n + 1, sizeof *f->back_start);
    return f->load_point && f->order && f->back_start ? 0 : STATUS_MEMORY;
}

static void particle_put(struct fixed_particles *f, size_t k, const double x[3], const double v[3],
                         const double a[3])
{
    for (int d = 0; d < 3; ++d) {
        f->x[d][k] = x[d] + f->wrap[d][k];
        f->v[d][k] = v[d];
        f->a[d][k] = a[d];
    }
}

/** Place, velocity and acceleration of the particles whose motion is prescribed, at time @p t. */
static void prescribed_move(struct boundary *boundary, double t)
{
    struct fixed_particles *f = boundary->data;
    const struct wall_places *places = &f->places;
    for (size_t k = 0; k < f->n; ++k) {
        double x[3], v[3], a[3];
        if (places->mesh[k] >= 0)
            continue;
        const struct motion *motion = places->surface[k] < 0
                                          ? &boundary->wall->motion
                                          : &boundary->surfaces[places->surface[k]]->definition->motion;
        motion_at(motion, places->X[k], t, x, v, a);
        particle_put(f, k, x, v, a);
    }
}

/** The same of those that meshes move, as the surfaces are now. */
static void material_move(struct boundary *boundary)
{
    struct fixed_particles *f = boundary->data;
#pragma omp parallel for schedule(static)
    for (size_t k = 0; k < f->material.n; ++k) {
        double x[3], v[3], a[3];
        material_points_motion(&f->material, boundary, k, x, v, a);
        particle_put(f, f->material.particle[k], x, v, a);
    }
}

static void particles_move(struct boundary *boundary, double t)
{
    prescribed_move(boundary, t);
    material_move(boundary);
}

/** Particles of a moving wall that left through a periodic side come in through the other. Those on the side
 * to rounding stay, so that a resumed run, which does this twice, finds them in the same place. */
static void particles_wrap(struct boundary *boundary, double t)
{
    struct fixed_particles *f = boundary->data;
    bool moved = false;
    for (int d = 0; d < f->grid.dim; ++d) {
        const double low = f->grid.lower[d], high = f->grid.upper[d], length = high - low;
        const double slack = WRAP_SLACK * length;
        for (size_t k = 0; k < f->n && f->grid.periodic[d]; ++k) {
            if (f->x[d][k] >= low - slack && f->x[d][k] < high + slack)
                continue;
            f->wrap[d][k] -= floor((f->x[d][k] - low) / length) * length;
            moved = true;
        }
    }
    if (moved)
        particles_move(boundary, t);
}

static void fields_register(struct boundary *boundary, struct fixed_particles *f)
{
    struct field *field = boundary->wall_field_list;
    *field++ = (struct field){"Density", "kg/m^3", FIELD_DOUBLE, 1, FIELD_OUTPUT, {f->rho}, NULL};
    *field++ =
        (struct field){"Velocity", "m/s", FIELD_DOUBLE, 3, FIELD_OUTPUT, {f->v[0], f->v[1], f->v[2]}, NULL};
    *field++ = (struct field){"Pressure", "Pa", FIELD_DOUBLE, 1, FIELD_OUTPUT, {f->p}, NULL};
    *field++ = (struct field){
        "ReactionForce", "N", FIELD_DOUBLE, 3, FIELD_OUTPUT, {f->force[0], f->force[1], f->force[2]}, NULL};
    *field++ = (struct field){"PeriodicShift",
                              "m",
                              FIELD_DOUBLE,
                              3,
                              boundary->moving ? FIELD_STATE : 0,
                              {f->wrap[0], f->wrap[1], f->wrap[2]},
                              NULL};
    boundary->wall_fields = (struct field_group){.name = f->group_name,
                                                 .owner = boundary,
                                                 .count = &f->n,
                                                 .fields = boundary->wall_field_list,
                                                 .n_fields = (size_t)(field - boundary->wall_field_list)};
    for (int d = 0; d < 3; ++d)
        boundary->wall_x[d] = f->x[d];
}

static int fixed_particles_create(struct boundary *boundary, const struct model *model,
                                  const struct fluid_view *view)
{
    struct fixed_particles *f = memory_create(1, sizeof *f);
    CHECK_MEMORY(f);
    boundary->data = f;
    const struct model_wall *wall = boundary->wall;
    CALL(wall_places_init(&f->places, model, wall, view->spacing, view->kernel.support));
    f->n = f->places.n;
    CHECK(f->n, STATUS_DECK,
          "%s:%d:%d: error: <wall name=\"%s\">: no wall particle lies inside the domain; it must reach "
          "%g m behind the wall",
          model->path, wall->where.line, wall->where.column, wall->name, view->kernel.support);
    CALL(arrays_create(f));
    CALL(material_points_init(&f->material, boundary, model, &f->places));
    CHECK_MEMORY(f->tensor = memory_create(f->material.n, sizeof *f->tensor));
    for (size_t k = 0; k < f->n; ++k) {
        const int32_t surface = f->places.surface[k];
        const bool none = surface < 0 || f->places.mesh[k] >= 0;
        f->load_point[k] = none ? -1 : nearest_point(boundary->surfaces[surface], f->places.X[k]);
    }
    for (int image = 0; image < 27; ++image)
        for (int d = 0, rest = image; d < 3; ++d, rest /= 3)
            f->shift[image][d] = d < model->dim && model->domain.periodic[d]
                                     ? (rest % 3 - 1) * (model->domain.upper[d] - model->domain.lower[d])
                                     : 0.0;
    particles_move(boundary, 0.0);
    f->n_parts = (size_t)parallel_threads();
    CHECK_MEMORY(f->parts = memory_create(f->n_parts, sizeof *f->parts));
    CHECK_MEMORY(f->group_name = memory_print("wall-%s", wall->name));
    fields_register(boundary, f);
    double reach = view->kernel.support + view->skin;
    return cell_grid_create(&f->grid, model->dim, model->domain.lower, model->domain.upper,
                            model->domain.periodic, reach, reach, view->spacing);
}

static void fixed_particles_destroy(struct boundary *boundary)
{
    struct fixed_particles *f = boundary->data;
    if (!f)
        return;
    for (int d = 0; d < 3; ++d) {
        double *const arrays[] = {f->x[d],      f->v[d],    f->a[d],     f->u[d],
                                  f->listed[d], f->wrap[d], f->force[d], f->pair_force[d]};
        for (size_t k = 0; k < sizeof arrays / sizeof *arrays; ++k)
            memory_free(arrays[k]);
    }
    void *const others[] = {f->group_name, f->load_point, f->order,      f->p,     f->rho,
                            f->pairs,      f->start,      f->back_start, f->back,  f->back_near,
                            f->marked,     f->candidate,  f->count,      f->tensor};
    wall_places_reset(&f->places);
    material_points_reset(&f->material);
    for (size_t k = 0; k < f->n_parts; ++k)
        memory_free(f->parts[k].pairs);
    memory_free(f->parts);
    for (size_t k = 0; k < sizeof others / sizeof *others; ++k)
        memory_free(others[k]);
    cell_grid_reset(&f->grid);
    memory_free(f);
}

static uint8_t image_of(const struct cell_range *range)
{
    int image = 0;
    for (int d = 2; d >= 0; --d)
        image = 3 * image + (range->shift[d] > 0.0 ? 2 : range->shift[d] < 0.0 ? 0 : 1);
    return (uint8_t)image;
}

/** Pairs grouped by wall particle, for the extrapolation. */
static int pairs_turn(struct boundary *boundary)
{
    struct fixed_particles *f = boundary->data;
    CALL(memory_grow((void **)&f->back, &f->back_capacity, f->n_pairs, sizeof *f->back));
    CALL(memory_grow((void **)&f->back_near, &f->back_near_capacity, f->n_pairs, sizeof *f->back_near));
    memset(f->back_start, 0, (f->n + 1) * sizeof *f->back_start);
    for (size_t k = 0; k < f->n_pairs; ++k)
        ++f->back_start[f->pairs[k].wall + 1];
    for (size_t k = 0; k < f->n; ++k)
        f->back_start[k + 1] += f->back_start[k];
    for (size_t near = 0; near < boundary->n_near; ++near)
        for (uint32_t k = f->start[near]; k < f->start[near + 1]; ++k) {
            uint32_t place = f->back_start[f->pairs[k].wall]++;
            f->back[place] = k;
            f->back_near[place] = (uint32_t)near;
        }
    for (size_t k = f->n; k > 0; --k)
        f->back_start[k] = f->back_start[k - 1];
    f->back_start[0] = 0;
    return 0;
}

/** Mark the moving particles in the cells that some wall particle reaches: few, where walls are few. */
static int moving_mark(struct fixed_particles *f, const struct fluid_view *view, double reach)
{
    struct cell_range ranges[CELL_GRID_RANGES];
    CALL(memory_grow((void **)&f->marked, &f->marked_capacity, view->particles->n, sizeof *f->marked));
    memset(f->marked, 0, view->particles->n);
    for (size_t k = 0; k < f->n; ++k) {
        const double place[3] = {f->x[0][k], f->x[1][k], f->x[2][k]};
        const size_t n = cell_grid_ranges(view->grid, place, reach, ranges);
        for (size_t r = 0; r < n; ++r)
            memset(f->marked + ranges[r].begin, 1, ranges[r].end - ranges[r].begin);
    }
    return 0;
}

/** The pairs of particle @p i, added to a part. */
static int pairs_find(const struct fixed_particles *f, const struct particles *block, size_t i, double reach,
                      struct fixed_part *part)
{
    struct cell_range ranges[CELL_GRID_RANGES];
    const double place[3] = {block->x[0][i], block->x[1][i], block->x[2][i]};
    const size_t n = cell_grid_ranges(&f->grid, place, reach, ranges);
    for (size_t r = 0; r < n; ++r)
        for (uint32_t c = ranges[r].begin; c < ranges[r].end; ++c) {
            const uint32_t k = f->order[c];
            double r2 = 0.0;
            for (int d = 0; d < 3; ++d)
                r2 += pow(place[d] - f->x[d][k] - ranges[r].shift[d], 2.0);
            if (r2 >= reach * reach)
                continue;
            CALL(memory_grow((void **)&part->pairs, &part->capacity, part->n_pairs + 1, sizeof *part->pairs));
            part->pairs[part->n_pairs++] = (struct fixed_pair){k, image_of(&ranges[r])};
        }
    return 0;
}

/** Fill the parts, each with the pairs of its share of @p n candidates. */
static int parts_fill(struct fixed_particles *f, const struct particles *block, double reach, size_t n)
{
    int status = 0;
#pragma omp parallel for schedule(static, 1) reduction(max : status)
    for (size_t k = 0; k < f->n_parts; ++k) {
        struct fixed_part *part = &f->parts[k];
        int failed = 0;
        part->n_pairs = 0;
        for (size_t c = n * k / f->n_parts; c < n * (k + 1) / f->n_parts && !failed; ++c) {
            const size_t before = part->n_pairs;
            failed = pairs_find(f, block, f->candidate[c], reach, part);
            f->count[c] = (uint32_t)(part->n_pairs - before);
        }
        status = failed > status ? failed : status;
    }
    return status;
}

/** The parts one behind the other, the same for any number of them. */
static int parts_join(struct fixed_particles *f)
{
    f->n_pairs = 0;
    for (size_t k = 0; k < f->n_parts; ++k)
        f->n_pairs += f->parts[k].n_pairs;
    CALL(memory_grow((void **)&f->pairs, &f->pair_capacity, f->n_pairs, sizeof *f->pairs));
    for (size_t k = 0, first = 0; k < f->n_parts; first += f->parts[k++].n_pairs)
        if (f->parts[k].n_pairs)
            memcpy(f->pairs + first, f->parts[k].pairs, f->parts[k].n_pairs * sizeof *f->pairs);
    for (int d = 0; d < 3; ++d)
        CALL(memory_grow((void **)&f->pair_force[d], &f->force_capacity[d], f->n_pairs, sizeof(double)));
    return 0;
}

static int pairs_list(struct boundary *boundary, const struct particles *block, double reach)
{
    struct fixed_particles *f = boundary->data;
    size_t n = 0, first = 0;
    for (size_t i = 0; i < block->n; ++i)
        n += f->marked[i];
    CALL(memory_grow((void **)&f->candidate, &f->candidate_capacity, n, sizeof *f->candidate));
    CALL(memory_grow((void **)&f->count, &f->count_capacity, n, sizeof *f->count));
    n = 0;
    for (size_t i = 0; i < block->n; ++i)
        if (f->marked[i])
            f->candidate[n++] = (uint32_t)i;
    CALL(parts_fill(f, block, reach, n));
    CALL(parts_join(f));
    CALL(boundary_reserve_near(boundary, n));
    CALL(memory_grow((void **)&f->start, &f->start_capacity, n + 1, sizeof *f->start));
    boundary->n_near = 0;
    for (size_t c = 0; c < n; first += f->count[c++]) {
        if (!f->count[c])
            continue;
        f->start[boundary->n_near] = (uint32_t)first;
        boundary->near[boundary->n_near++] = f->candidate[c];
    }
    f->start[boundary->n_near] = (uint32_t)first;
    return 0;
}

static int fixed_particles_list(struct boundary *boundary, const struct fluid_view *view)
{
    struct fixed_particles *f = boundary->data;
    const double reach = view->kernel.support + view->skin;
    if (boundary->moving) {
        particles_move(boundary, view->t);
        particles_wrap(boundary, view->t);
    }
    for (int d = 0; d < 3; ++d)
        memcpy(f->listed[d], f->x[d], f->n * sizeof(double));
    const double *x[3] = {f->x[0], f->x[1], f->x[2]};
    CALL(cell_grid_sort(&f->grid, x, f->n, f->order));
    CALL(moving_mark(f, view, reach));
    CALL(pairs_list(boundary, view->particles, reach));
    return pairs_turn(boundary);
}

static int fixed_particles_state(struct boundary *boundary, struct field_list *list)
{
    return field_list_add(list, &boundary->wall_fields);
}

/** Vector from the wall particle of a pair to fluid particle @p i; returns its squared length. */
static inline double pair_vector(const struct fixed_particles *f, const struct particles *block, size_t i,
                                 const struct fixed_pair *pair, double d[3])
{
    const double *shift = f->shift[pair->image];
    double r2 = 0.0;
    for (int k = 0; k < 3; ++k) {
        d[k] = block->x[k][i] - f->x[k][pair->wall] - shift[k];
        r2 += d[k] * d[k];
    }
    return r2;
}

static int fixed_particles_prepare(struct boundary *boundary, const struct fluid_view *view, bool again)
{
    const struct fixed_particles *f = boundary->data;
    if (boundary->moving) {
        double moved2 = 0.0;
        if (!again)
            prescribed_move(boundary, view->t);
        material_move(boundary);
        for (size_t k = 0; k < f->n; ++k) {
            double d2 = 0.0;
            for (int d = 0; d < 3; ++d)
                d2 += (f->x[d][k] - f->listed[d][k]) * (f->x[d][k] - f->listed[d][k]);
            moved2 = fmax(moved2, d2);
        }
        boundary->drift = sqrt(moved2);
    }
#pragma omp parallel for schedule(static)
    for (size_t near = 0; near < boundary->n_near; ++near) {
        double sum = 0.0, d[3];
        for (uint32_t k = f->start[near]; k < f->start[near + 1]; ++k)
            sum += kernel_w(&view->kernel,
                            sqrt(pair_vector(f, view->particles, boundary->near[near], &f->pairs[k], d)));
        boundary->kernel_sum[near] = sum;
    }
    return 0;
}

/** Adami's extrapolation, with the wall's acceleration in the force balance. */
static int fixed_particles_close(struct boundary *boundary, const struct fluid_view *view)
{
    struct fixed_particles *f = boundary->data;
    const struct particles *block = view->particles;
    const double c2 = view->sound_speed * view->sound_speed;
#pragma omp parallel for schedule(static)
    for (size_t wall = 0; wall < f->n; ++wall) {
        double weight = 0.0, p = 0.0, u[3] = {0}, moment[3] = {0};
        for (uint32_t c = f->back_start[wall]; c < f->back_start[wall + 1]; ++c) {
            size_t i = boundary->near[f->back_near[c]];
            double d[3],
                w = kernel_w(&view->kernel, sqrt(pair_vector(f, block, i, &f->pairs[f->back[c]], d)));
            weight += w;
            p += block->p[i] * w;
            for (int k = 0; k < 3; ++k) {
                u[k] += block->u[k][i] * w;
                moment[k] -= block->rho[i] * d[k] * w; /* rho (r_wall - r_fluid) W */
            }
        }
        double inverse = weight > 0.0 ? 1.0 / weight : 0.0;
        for (int k = 0; k < 3; ++k) {
            p += (view->body_force[k] - f->a[k][wall]) * moment[k];
            f->u[k][wall] = weight > 0.0 ? 2.0 * f->v[k][wall] - u[k] * inverse : f->v[k][wall];
        }
        f->p[wall] = p * inverse;
        f->rho[wall] = f->p[wall] / c2 + view->density;
    }
    return 0;
}

static int fixed_particles_gather(const struct boundary *boundary, const struct fluid_view *view, size_t near,
                                  struct wall_neighbours *neighbours)
{
    const struct fixed_particles *f = boundary->data;
    const uint32_t first = f->start[near], last = f->start[near + 1];
    const double support2 = view->kernel.support * view->kernel.support;
    CALL(wall_neighbours_reserve(neighbours, last - first));
    size_t n = 0;
    for (uint32_t k = first; k < last; ++k) {
        double d[3], r2 = pair_vector(f, view->particles, boundary->near[near], &f->pairs[k], d),
                     r = sqrt(r2);
        uint32_t wall = f->pairs[k].wall;
        f->pair_force[0][k] = f->pair_force[1][k] = f->pair_force[2][k] = 0.0;
        if (r2 >= support2)
            continue;
        for (int c = 0; c < 3; ++c) {
            neighbours->dx[c][n] = d[c];
            neighbours->u[c][n] = f->v[c][wall];
            neighbours->u_viscous[c][n] = f->u[c][wall];
            neighbours->a[c][n] = f->a[c][wall];
            neighbours->normal[c][n] = d[c] / r;
        }
        neighbours->r[n] = r;
        neighbours->w[n] = kernel_w(&view->kernel, r);
        neighbours->dw[n] = kernel_dw(&view->kernel, r);
        neighbours->rho[n] = f->rho[wall];
        neighbours->p[n] = f->p[wall];
        neighbours->volume[n] = view->mass / f->rho[wall];
        neighbours->share_density[n] = neighbours->share_pressure[n] = neighbours->share_viscous[n] = 1.0;
        neighbours->source[n++] = (int32_t)(k - first);
    }
    neighbours->n = n;
    return 0;
}

static void fixed_particles_react(struct boundary *boundary, size_t near,
                                  const struct wall_neighbours *neighbours, double *const force[3])
{
    struct fixed_particles *f = boundary->data;
    for (size_t k = 0; k < neighbours->n; ++k)
        for (int d = 0; d < 3; ++d)
            f->pair_force[d][f->start[near] + (uint32_t)neighbours->source[k]] = -force[d][k];
}

/** The load of a particle that no mesh moves: on the nearest point of its surface, with its moment about that
 * point. */
static void prescribed_load(struct boundary *boundary, size_t wall)
{
    const struct fixed_particles *f = boundary->data;
    struct surface *surface = boundary->surfaces[f->places.surface[wall]];
    const int32_t point = f->load_point[wall];
    double arm[3];
    for (int d = 0; d < 3; ++d)
        arm[d] = f->x[d][wall] - f->wrap[d][wall] - surface->now.x[point][d];
    for (int d = 0; d < 3; ++d) {
        surface->load[point][d] += f->force[d][wall];
        surface->moment[d] +=
            arm[(d + 1) % 3] * f->force[(d + 2) % 3][wall] - arm[(d + 2) % 3] * f->force[(d + 1) % 3][wall];
    }
}

static void fixed_particles_load(struct boundary *boundary, const struct fluid_view *view)
{
    struct fixed_particles *f = boundary->data;
    (void)view;
#pragma omp parallel for schedule(static)
    for (size_t wall = 0; wall < f->n; ++wall)
        for (int d = 0; d < 3; ++d) {
            double total = 0.0;
            for (uint32_t c = f->back_start[wall]; c < f->back_start[wall + 1]; ++c)
                total += f->pair_force[d][f->back[c]];
            f->force[d][wall] = total;
        }
    for (size_t k = 0; k < f->material.n; ++k) {
        const size_t wall = f->material.particle[k];
        const double total[3] = {f->force[0][wall], f->force[1][wall], f->force[2][wall]};
        material_points_load(&f->material, boundary, k, total);
    }
    for (size_t wall = 0; wall < f->n; ++wall)
        if (f->load_point[wall] >= 0)
            prescribed_load(boundary, wall);
}

/** T and D of wall particle @p wall: minus the derivatives of its load by its acceleration a and velocity v.
 * The load is sum_i (V_i^2 + V^2) W' (e_i (rho p_i + rho_i p) / (rho + rho_i) + eta (u - u_i)/r), e_i from it
 * to fluid particle i; a is in p = ... - a . sum_j rho_j (r - r_j) W / sum_j W, and v in u = 2 v - ...; that
 * rho follows p is left out. */
static void contact_fill(const struct boundary *boundary, const struct fluid_view *view, size_t wall,
                         struct added_mass_contact *contact)
{
    const struct fixed_particles *f = boundary->data;
    const struct particles *block = view->particles;
    const double rho = f->rho[wall], volume = view->mass / rho;
    double weight = 0.0, push[3] = {0.0, 0.0, 0.0}, moment[3] = {0.0, 0.0, 0.0};
    contact->damping = 0.0;
    for (uint32_t c = f->back_start[wall]; c < f->back_start[wall + 1]; ++c) {
        const size_t i = boundary->near[f->back_near[c]];
        double d[3];
        const double r = sqrt(pair_vector(f, block, i, &f->pairs[f->back[c]], d)),
                     w = kernel_w(&view->kernel, r), volume_i = block->m[i] / block->rho[i];
        const double pair = (volume_i * volume_i + volume * volume) * kernel_dw(&view->kernel, r) / r,
                     factor = pair * block->rho[i] / (rho + block->rho[i]);
        contact->damping -= 2.0 * view->viscosity * pair;
        weight += w;
        for (int k = 0; k < 3; ++k) {
            push[k] += factor * d[k];
            moment[k] -= block->rho[i] * d[k] * w;
        }
    }
    for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l)
            contact->tensor[k][l] = weight > 0.0 ? push[k] * moment[l] / weight : 0.0;
}

static int fixed_particles_added_mass(struct boundary *boundary, const struct fluid_view *view)
{
    struct fixed_particles *f = boundary->data;
    for (size_t s = 0; s < boundary->n_surfaces; ++s)
        boundary->surfaces[s]->n_added_mass = 0;
    for (size_t k = 0; k < f->material.n; ++k)
        f->tensor[k] = boundary->surfaces[f->material.surface[k]]->n_added_mass++;
    for (size_t s = 0; s < boundary->n_surfaces; ++s) {
        boundary->surfaces[s]->n_anchors = f->material.n ? f->material.start[f->material.n] : 0;
        CALL(surface_added_mass_reserve(boundary->surfaces[s]));
    }
#pragma omp parallel for schedule(static)
    for (size_t k = 0; k < f->material.n; ++k) {
        struct added_mass_contact *contact =
            &boundary->surfaces[f->material.surface[k]]->added_mass[f->tensor[k]];
        material_points_contact(&f->material, boundary, k, contact);
        contact_fill(boundary, view, f->material.particle[k], contact);
    }
    return 0;
}

const struct boundary_type boundary_fixed_particles = {
    .name = "fixed-particles",
    .check = fixed_particles_check,
    .create = fixed_particles_create,
    .destroy = fixed_particles_destroy,
    .list = fixed_particles_list,
    .state = fixed_particles_state,
    .prepare = fixed_particles_prepare,
    .close = fixed_particles_close,
    .gather = fixed_particles_gather,
    .unfold = fixed_particles_gather,
    .react = fixed_particles_react,
    .load = fixed_particles_load,
    .added_mass = fixed_particles_added_mass,
};

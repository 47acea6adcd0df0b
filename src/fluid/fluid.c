// SPDX-License-Identifier: GPL-3.0-or-later
/* The fluid object: what every formulation shares. The order of a step is that of the kick-drift-kick scheme
 * of Fuchs et al. (2021), section 3.1.7, cut so that everything a moving surface changes can be repeated
 * cheaply (fluid_interface). */
#include "fluid/fluid.h"

#include "base/error.h"
#include "base/log.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "fluid/fluid_internal.h"
#include "fluid/fluid_list.h"
#include "sph/shepard.h"

#include <math.h>
#include <string.h>

static const double skin_ratio = 0.3; /* of the spacing: measured, flat between 0.15 and 0.45 */

static void view_fill(struct fluid *fluid)
{
    const struct model *model = fluid->model;
    double dx = model->fluid.spacing;
    fluid->view = (struct fluid_view){
        .dim = model->dim,
        .spacing = dx,
        .mass = fluid->material->density * pow(dx, model->dim),
        .skin = skin_ratio * dx,
        .kernel = kernel_of_model(model),
        .density = fluid->material->density,
        .sound_speed = fluid->material->sound_speed,
        .viscosity = fluid->material->density * fluid->material->kinematic_viscosity,
        .particles = fluid->block,
        .grid = &fluid->grid,
        .isa = fluid->isa,
    };
    fluid->skin = fluid->view.skin;
}

static void body_force_at(struct fluid *fluid, double t)
{
    for (int k = 0; k < fluid->model->dim; ++k)
        fluid->view.body_force[k] = expression_value(fluid->model->time.body_force[k], NULL, t);
}

/** Particles of a region; the density they start with is only a first value, it is summed before it is used.
 */
static int region_fill(struct fluid *fluid, const struct model_region *region)
{
    int dim = fluid->model->dim;
    double(*points)[3] = region->points, lower[3] = {0}, upper[3] = {0};
    size_t n = region->n_points;
    if (!n) {
        shape_bounds(&region->shape, dim, lower, upper);
        CALL(geometry_fill(&region->shape, dim, fluid->view.spacing,
                           region->has_origin ? region->origin : lower, 0.02 * fluid->view.spacing, &points,
                           &n));
    }
    int status = particles_reserve(fluid->block, fluid->block->n + n);
    for (size_t i = 0; i < n && !status; ++i) {
        size_t index;
        status = particles_append(fluid->block, PARTICLE_FLUID, points[i], fluid->view.mass, &index);
        if (!status)
            fluid->block->rho[index] = fluid->view.density;
        for (int k = 0; k < dim && !status; ++k)
            if (region->velocity[k])
                fluid->block->u[k][index] = expression_value(region->velocity[k], points[i], 0.0);
    }
    if (!region->n_points)
        memory_free(points);
    return status;
}

/** Fill the zone of an opening: a lattice of full depth behind its plane, in line with the plane. */
static int opening_fill(struct fluid *fluid, struct open_boundary *open)
{
    const struct model_open *definition = open->definition;
    double dx = fluid->view.spacing;
    struct shape box = {.kind = SHAPE_BOX};
    for (int k = 0; k < fluid->model->dim; ++k) {
        box.a[k] = definition->lower[k];
        box.b[k] = definition->upper[k];
    }
    int axis = definition->axis;
    box.a[axis] = definition->into > 0 ? definition->at - open->depth : definition->at;
    box.b[axis] = box.a[axis] + open->depth;
    double(*points)[3];
    size_t n;
    CALL(geometry_fill(&box, fluid->model->dim, dx, box.a, 0.02 * dx, &points, &n));
    enum particle_kind kind = definition->kind == OPEN_INFLOW ? PARTICLE_INFLOW : PARTICLE_OUTFLOW;
    int status = particles_reserve(fluid->block, fluid->block->n + n);
    for (size_t i = 0; i < n && !status; ++i) {
        size_t index;
        status = particles_append(fluid->block, kind, points[i], fluid->view.mass, &index);
        if (status)
            break;
        fluid->block->opening[index] = (uint8_t)open->index;
        fluid->block->rho[index] = fluid->view.density;
    }
    memory_free(points);
    return status;
}

static int opening_register(struct open_boundary *open)
{
    const struct field fields[] = {
        {"Born", "-", FIELD_INT64, 1, FIELD_STATE, {&open->born}, NULL},
        {"Removed", "-", FIELD_INT64, 1, FIELD_STATE, {&open->removed}, NULL},
    };
    char *name = memory_print("opening-%s", open->definition->name);
    CHECK_MEMORY(name);
    open->state = field_singles(name, open, open->state_fields, fields, sizeof fields / sizeof *fields);
    return 0;
}

static int openings_create(struct fluid *fluid, const struct fluid_parts *parts)
{
    const struct model *model = fluid->model;
    CHECK(model->n_openings < 256, STATUS_DECK, "%s: error: %zu openings: at most 255 are possible",
          model->path, model->n_openings);
    fluid->openings = memory_create(model->n_openings, sizeof *fluid->openings);
    CHECK_MEMORY(fluid->openings);
    double reach = fluid->view.kernel.support + fluid->skin, dx = fluid->view.spacing;
    if (model->n_openings)
        particles_add_flags(fluid->block, "Kind", FIELD_OUTPUT); /* tells zone particles from fluid */
    for (size_t k = 0; k < model->n_openings; ++k) {
        struct open_boundary *open = &fluid->openings[k];
        open->definition = &model->openings[k];
        open->type = parts->opening_types[open->definition->kind];
        open->index = (int)k;
        open->depth = ceil(reach / dx - 1e-6) * dx;
        ++fluid->n_openings;
        CALL(opening_register(open));
        CALL(open->type->create(open, model, &fluid->view));
        if (open->reads_density) {
            particles_add_flags(fluid->block, "Density", FIELD_STATE);
            particles_add_flags(fluid->block, "Pressure", FIELD_STATE);
        }
        CALL(opening_fill(fluid, open));
    }
    return 0;
}

static int boundaries_create(struct fluid *fluid, const struct fluid_parts *parts)
{
    const struct model *model = fluid->model;
    fluid->boundaries = memory_create(model->n_walls, sizeof *fluid->boundaries);
    fluid->wall_forces = memory_create(model->n_walls, sizeof *fluid->wall_forces);
    if (!fluid->boundaries || !fluid->wall_forces)
        return STATUS_MEMORY;
    for (size_t k = 0; k < model->n_walls; ++k) {
        ++fluid->n_boundaries;
        CALL(boundary_create(&fluid->boundaries[k], model, (int)k, parts->surfaces, &fluid->view,
                             parts->wall_types, parts->n_wall_types));
    }
    return 0;
}

static int scratch_create(struct fluid *fluid)
{
    size_t threads = (size_t)parallel_threads();
    fluid->scratch = memory_create(threads, sizeof *fluid->scratch);
    fluid->force = memory_create(threads, sizeof *fluid->force);
    fluid->force_capacity = memory_create(threads, sizeof *fluid->force_capacity);
    if (!fluid->scratch || !fluid->force || !fluid->force_capacity)
        return STATUS_MEMORY;
    fluid->n_scratch = threads;
    return 0;
}

/** Particles that sit on each other can never be told apart again. */
static int overlaps_check(const struct fluid *fluid)
{
    const double *x = fluid->block->x[0], *y = fluid->block->x[1], *z = fluid->block->x[2];
    double least = 1e-6 * fluid->view.spacing;
    for (size_t i = 0; i < fluid->block->n; ++i) {
        struct cell_range ranges[CELL_GRID_RANGES];
        double place[3] = {x[i], y[i], z[i]};
        size_t n = cell_grid_ranges(&fluid->grid, place, least, ranges);
        for (size_t r = 0; r < n; ++r)
            for (uint32_t j = ranges[r].begin; j < ranges[r].end; ++j) {
                if (j == i)
                    continue;
                double dx = x[i] - x[j] - ranges[r].shift[0], dy = y[i] - y[j] - ranges[r].shift[1],
                       dz = z[i] - z[j] - ranges[r].shift[2];
                CHECK(dx * dx + dy * dy + dz * dz > least * least, STATUS_DECK,
                      "%s: error: two particles start at (%g, %g, %g): do two regions overlap?",
                      fluid->model->path, place[0], place[1], place[2]);
            }
    }
    return 0;
}

static int state_register(struct fluid *fluid)
{
    const struct field fields[] = {
        {"ListTime", "s", FIELD_DOUBLE, 1, FIELD_STATE, {&fluid->list_time}, NULL},
        {"Drift", "m", FIELD_DOUBLE, 1, FIELD_STATE, {&fluid->drift}, NULL},
        {"NextId", "-", FIELD_INT64, 1, FIELD_STATE, {&fluid->block->next_id}, NULL},
        {"Rebuilds", "-", FIELD_INT64, 1, FIELD_STATE, {&fluid->rebuilds}, NULL},
    };
    fluid->state =
        field_singles("fluid:state", fluid, fluid->state_fields, fields, sizeof fields / sizeof *fields);
    return particles_add_field(fluid->block, "ListedPosition", "m", 3, FIELD_STATE, fluid->listed);
}

static int fluid_build(struct fluid *fluid, const struct fluid_parts *parts)
{
    const struct model *model = fluid->model;
    for (size_t k = 0; k < FLUID_TYPES; ++k)
        if (!strcmp(fluid_types[k]->name, model->fluid.formulation))
            fluid->type = fluid_types[k];
    CHECK(fluid->type, STATUS_DECK, "%s:%d:%d: error: <fluid>: unknown formulation \"%s\"", model->path,
          model->fluid.where.line, model->fluid.where.column, model->fluid.formulation);
    CALL(particles_create(&fluid->block, "fluid", model->dim, 1024));
    CALL(state_register(fluid));
    view_fill(fluid);
    /* rows of about 2.8 spacings in 2-D and 2 in 3-D: a cluster is then about as long as its row is wide */
    double width = (model->dim == 3 ? 2.0 / 3.0 : 2.8 / 3.0) * fluid->view.kernel.support;
    CALL(cell_grid_create(&fluid->grid, model->dim, model->domain.lower, model->domain.upper,
                          model->domain.periodic, fluid->view.kernel.support + fluid->skin, width,
                          fluid->view.spacing));
    for (size_t k = 0; k < model->fluid.n_regions; ++k)
        CALL(region_fill(fluid, &model->fluid.regions[k]));
    CHECK(fluid->block->n, STATUS_DECK,
          "%s:%d:%d: error: <fluid>: no particle fits into the regions (spacing %g m)", model->path,
          model->fluid.where.line, model->fluid.where.column, fluid->view.spacing);
    CALL(openings_create(fluid, parts));
    CALL(scratch_create(fluid));
    CALL(fluid->type->create(fluid));
    body_force_at(fluid, 0.0);
    return boundaries_create(fluid, parts);
}

int fluid_create(struct fluid **fluid, const struct model *model, const struct fluid_parts *parts)
{
    struct fluid *f = memory_create(1, sizeof *f);
    CHECK_MEMORY(f);
    f->model = model;
    f->material = &model->fluid_materials[model->fluid.material];
    f->timer = parts->timer;
    *fluid = f;
    int status = isa_choose(parts->isa, &f->isa);
    if (!status)
        status = fluid_build(f, parts);
    if (status) {
        fluid_destroy(f);
        *fluid = NULL;
    }
    return status;
}

void fluid_destroy(struct fluid *fluid)
{
    if (!fluid)
        return;
    for (size_t k = 0; k < fluid->n_boundaries; ++k) {
        boundary_destroy(fluid->boundaries[k]);
        for (int d = 0; d < 3; ++d) {
            memory_free(fluid->wall_forces[k].a[d]);
            memory_free(fluid->wall_forces[k].a_background[d]);
        }
    }
    for (size_t k = 0; k < fluid->n_openings; ++k) {
        fluid->openings[k].type->destroy(&fluid->openings[k]);
        memory_free(fluid->openings[k].zone);
        memory_free((char *)fluid->openings[k].state.name);
    }
    if (fluid->type)
        fluid->type->destroy(fluid);
    for (size_t k = 0; k < fluid->n_scratch; ++k) {
        wall_neighbours_reset(&fluid->scratch[k]);
        memory_free(fluid->force[k]);
    }
    memory_free(fluid->boundaries);
    memory_free(fluid->wall_forces);
    memory_free(fluid->openings);
    memory_free(fluid->scratch);
    memory_free(fluid->force);
    memory_free(fluid->force_capacity);
    memory_free(fluid->order);
    memory_free(fluid->dead);
    neighbour_list_reset(&fluid->list);
    cell_grid_reset(&fluid->grid);
    particles_destroy(fluid->block);
    memory_free(fluid);
}

/** Walls that can be crossed put particles back; @p moved tells whether any was. */
static int penetrated_put_back(struct fluid *fluid, bool *moved)
{
    for (size_t k = 0; k < fluid->n_boundaries; ++k) {
        struct boundary *b = fluid->boundaries[k];
        const int64_t before = b->put_back_count;
        if (b->type->put_back)
            CALL(b->type->put_back(b, &fluid->view, fluid->block));
        *moved |= b->put_back_count > before;
    }
    return 0;
}

/** Surfaces move by prediction: how far, and whether the lists still hold everything. */
static int lists_update(struct fluid *fluid, double moved, bool stale)
{
    stale |= 2.0 * (fluid->drift += moved) > fluid->skin;
    fluid->grid.moved = fluid->drift;
    for (size_t k = 0; k < fluid->n_boundaries; ++k) {
        struct boundary *b = fluid->boundaries[k];
        double wall = 0.0;
        for (size_t s = 0; s < b->n_surfaces && b->moving; ++s)
            wall = fmax(wall, surface_travel(b->surfaces[s], fluid->view.t, fluid->view.dt));
        b->drift += wall;
        /* a tenth of the skin is left for what the iterations add to the prediction */
        stale |= fluid->drift + b->drift > 0.9 * fluid->skin;
    }
    return stale ? fluid_rebuild(fluid) : 0;
}

void fluid_surface_moved(struct fluid *fluid, const struct surface *surface, double distance)
{
    for (size_t k = 0; k < fluid->n_boundaries; ++k)
        for (size_t s = 0; s < fluid->boundaries[k]->n_surfaces; ++s)
            if (fluid->boundaries[k]->surfaces[s] == surface)
                fluid->boundaries[k]->drift += distance;
}

int fluid_start(struct fluid *fluid, double t)
{
    fluid->view.t = t;
    fluid->view.dt = 0.0;
    body_force_at(fluid, t);
    fluid->type->start(fluid);
    CALL(fluid_rebuild(fluid));
    for (size_t k = 0; k < fluid->n_openings; ++k)
        CALL(fluid->openings[k].type->velocities(&fluid->openings[k], &fluid->view, fluid->block, t));
    CALL(overlaps_check(fluid));
    double since = timer_now();
    CALL(fluid->type->density(fluid));
    timer_lap(fluid->timer, TIMER_FLUID, &since);
    CALL(fluid_interface(fluid, false));
    return fluid_end_step(fluid);
}

int fluid_state(struct fluid *fluid, struct field_list *list)
{
    CALL(field_list_add(list, &fluid->block->fields));
    CALL(field_list_add(list, &fluid->state));
    for (size_t k = 0; k < fluid->n_boundaries; ++k)
        CALL(boundary_state(fluid->boundaries[k], list));
    for (size_t k = 0; k < fluid->n_openings; ++k)
        CALL(field_list_add(list, &fluid->openings[k].state));
    return 0;
}

int fluid_resume(struct fluid *fluid, double t)
{
    const struct particles *block = fluid->block;
    for (size_t i = 0; i < block->n; ++i)
        CHECK(block->kind[i] <= PARTICLE_OUTFLOW &&
                  (block->kind[i] == PARTICLE_FLUID || block->opening[i] < fluid->n_openings),
              STATUS_IO, "the checkpoint does not fit the deck: particle %lld is of kind %d, opening %d",
              (long long)block->id[i], block->kind[i], block->opening[i]);
    fluid->view.dt = 0.0;
    CALL(fluid_relist(fluid));
    fluid->view.t = t;
    body_force_at(fluid, t);
    return 0;
}

double fluid_stable_step(const struct fluid *fluid)
{
    const struct particles *block = fluid->block;
    const struct fluid_view *view = &fluid->view;
    double u2 = 0.0, b2 = 0.0, h = view->kernel.h;
    for (size_t i = 0; i < block->n; ++i)
        u2 = fmax(u2, block->u[0][i] * block->u[0][i] + block->u[1][i] * block->u[1][i] +
                          block->u[2][i] * block->u[2][i]);
    for (int k = 0; k < 3; ++k)
        b2 += view->body_force[k] * view->body_force[k];
    double step = 0.25 * h / (view->sound_speed + sqrt(u2));
    if (fluid->material->kinematic_viscosity > 0.0)
        step = fmin(step, 0.125 * h * h / fluid->material->kinematic_viscosity);
    if (b2 > 0.0)
        step = fmin(step, 0.25 * sqrt(h / sqrt(b2)));
    return step;
}

int fluid_begin_step(struct fluid *fluid, double t, double dt)
{
    double since = timer_now(), moved;
    fluid->view.t = t + dt;
    fluid->view.dt = dt;
    body_force_at(fluid, t + dt);
    for (size_t k = 0; k < fluid->n_openings; ++k)
        CALL(fluid->openings[k].type->velocities(&fluid->openings[k], &fluid->view, fluid->block, t + dt));
    CALL(fluid->type->drift(fluid, dt, &moved));
    timer_lap(fluid->timer, TIMER_FLUID, &since);
    bool moved_back = false;
    CALL(penetrated_put_back(fluid, &moved_back));
    timer_lap(fluid->timer, TIMER_WALLS, &since);
    CALL(lists_update(fluid, moved, moved_back));
    timer_lap(fluid->timer, TIMER_NEIGHBOURS, &since);
    CALL(fluid->type->density(fluid));
    timer_lap(fluid->timer, TIMER_FLUID, &since);
    return 0;
}

int fluid_interface(struct fluid *fluid, bool moving_only)
{
    double since = timer_now();
    for (size_t k = 0; k < fluid->n_boundaries; ++k)
        if (!moving_only || fluid->boundaries[k]->coupled)
            CALL(boundary_prepare(fluid->boundaries[k], &fluid->view, moving_only));
    fluid->type->pressure(fluid, moving_only);
    for (size_t k = 0; k < fluid->n_openings; ++k)
        CALL(fluid->openings[k].type->values(&fluid->openings[k], &fluid->view, fluid->block));
    for (size_t k = 0; k < fluid->n_boundaries; ++k)
        if (fluid->boundaries[k]->coupled)
            CALL(fluid_wall_forces(fluid, k));
    timer_lap(fluid->timer, TIMER_WALLS, &since);
    return 0;
}

int fluid_added_mass(struct fluid *fluid)
{
    double since = timer_now();
    for (size_t k = 0; k < fluid->n_boundaries; ++k) {
        struct boundary *b = fluid->boundaries[k];
        if (b->coupled && b->type->added_mass)
            CALL(b->type->added_mass(b, &fluid->view));
    }
    timer_lap(fluid->timer, TIMER_COUPLING, &since);
    return 0;
}

int fluid_end_step(struct fluid *fluid)
{
    double since = timer_now();
    for (size_t k = 0; k < fluid->n_boundaries; ++k)
        if (!fluid->boundaries[k]->coupled)
            CALL(fluid_wall_forces(fluid, k));
    timer_lap(fluid->timer, TIMER_WALLS, &since);
    CALL(fluid->type->finish(fluid, fluid->view.dt));
    timer_lap(fluid->timer, TIMER_FLUID, &since);
    return 0;
}

const struct particles *fluid_particles(const struct fluid *fluid)
{
    return fluid->block;
}

const struct fluid_view *fluid_view(const struct fluid *fluid)
{
    return &fluid->view;
}

size_t fluid_boundary_count(const struct fluid *fluid)
{
    return fluid->n_boundaries;
}

void fluid_openings_count(const struct fluid *fluid, int64_t *born, int64_t *removed)
{
    *born = *removed = 0;
    for (size_t k = 0; k < fluid->n_openings; ++k) {
        *born += fluid->openings[k].born;
        *removed += fluid->openings[k].removed;
    }
}

const struct boundary *fluid_boundary(const struct fluid *fluid, size_t index)
{
    return fluid->boundaries[index];
}

const char *fluid_isa(const struct fluid *fluid)
{
    return isa_name(fluid->isa);
}

int64_t fluid_rebuilds(const struct fluid *fluid)
{
    return fluid->rebuilds;
}

size_t fluid_bytes(const struct fluid *fluid)
{
    size_t bytes = neighbour_list_bytes(&fluid->list);
    for (size_t k = 0; k < fluid->block->fields.n_fields; ++k) {
        const struct field *field = &fluid->block->fields.fields[k];
        const int components = field->components > fluid->model->dim ? fluid->model->dim : field->components;
        bytes += fluid->block->capacity * field_size(field->type) * (size_t)components;
    }
    const size_t spare = fluid->model->dim < 3 ? 2 : 1; /* arrays of the block: room for sorting, zeros */
    bytes += spare * fluid->block->capacity * sizeof(double);
    bytes += fluid->type->bytes(fluid);
    return bytes + fluid->order_capacity * sizeof *fluid->order + fluid->dead_capacity +
           fluid->grid.start_capacity * sizeof *fluid->grid.start +
           fluid->grid.cell_of_capacity * sizeof *fluid->grid.cell_of +
           fluid->grid.count_capacity * sizeof *fluid->grid.count;
}

double fluid_probe(const struct fluid *fluid, const double x[3], double *pressure, double velocity[3],
                   double *density)
{
    const struct particles *block = fluid->block;
    const struct shepard particles = {.kernel = &fluid->view.kernel,
                                      .grid = &fluid->grid,
                                      .x = {block->x[0], block->x[1], block->x[2]},
                                      .m = block->m,
                                      .rho = block->rho,
                                      .kind = block->kind};
    const double *const values[] = {block->p, block->rho, block->u[0], block->u[1], block->u[2]};
    enum { VALUES = sizeof values / sizeof *values };
    double means[VALUES];
    const double support = shepard_means(&particles, x, VALUES, values, means);
    for (size_t v = 0; v < VALUES && !(support > 0.0); ++v)
        means[v] = 0.0;
    *pressure = means[0];
    *density = means[1];
    memcpy(velocity, &means[2], 3 * sizeof *velocity);
    return support;
}

// SPDX-License-Identifier: GPL-3.0-or-later
/* Inflow: a zone of particles with prescribed velocity; their pressure is that of the fluid before them
 * (Fuchs et al. 2021, section 3.1.6 and eq. 21), their density follows from the equation of state. */
#include "base/error.h"
#include "base/memory.h"
#include "open/open_list.h"
#include "open/zone.h"

struct inflow {
    size_t start_capacity, pair_capacity, n_pairs;
    uint32_t *start; /**< n_zone + 1 */
    uint32_t *fluid; /**< particles within reach of each zone particle */
    double (*shift)[3];
    size_t shift_capacity;
};

static int inflow_create(struct open_boundary *open, const struct model *model, const struct fluid_view *view)
{
    (void)model;
    (void)view;
    open->data = memory_create(1, sizeof(struct inflow));
    return open->data ? 0 : STATUS_MEMORY;
}

static void inflow_destroy(struct open_boundary *open)
{
    struct inflow *inflow = open->data;
    if (!inflow)
        return;
    memory_free(inflow->start);
    memory_free(inflow->fluid);
    memory_free(inflow->shift);
    memory_free(inflow);
}

/** The prescribed velocity at each particle's place; in an inflow that runs backwards particles leave at the
 * zone's end. */
static int inflow_velocities(struct open_boundary *open, const struct fluid_view *view,
                             struct particles *particles, double t)
{
    const struct model_open *definition = open->definition;
    for (size_t z = 0; z < open->n_zone; ++z) {
        size_t i = open->zone[z];
        double x[3] = {particles->x[0][i], particles->x[1][i], particles->x[2][i]};
        for (int k = 0; k < view->dim; ++k)
            particles->u[k][i] = expression_value(definition->velocity[k], x, t);
    }
    return 0;
}

static int inflow_move(struct open_boundary *open, const struct fluid_view *view, struct particles *particles,
                       uint8_t *dead)
{
    const size_t n = particles->n;
    const struct model_open *definition = open->definition;
    CALL(zone_release(open, view, particles));
    int64_t removed = 0;
#pragma omp parallel for schedule(static) reduction(+ : removed)
    for (size_t i = 0; i < n; ++i) {
        double x[3] = {particles->x[0][i], particles->x[1][i], particles->x[2][i]};
        double inside = zone_inside(definition, x);
        if (particles->kind[i] == PARTICLE_INFLOW && particles->opening[i] == open->index) {
            if (inside < -open->depth - 1e-9 * view->spacing) {
                dead[i] = 1;
                ++removed;
            }
        } else if (particles->kind[i] == PARTICLE_FLUID && inside < -0.1 * view->spacing &&
                   inside > -open->depth && zone_across(definition, view->dim, x, 0.5 * view->spacing)) {
            particles->kind[i] = PARTICLE_INFLOW; /* the flow runs out here: it is taken in by the zone */
            particles->opening[i] = (uint8_t)open->index;
        }
    }
    open->removed += removed;
    return 0;
}

static int inflow_list(struct open_boundary *open, const struct fluid_view *view)
{
    struct inflow *inflow = open->data;
    const struct particles *particles = view->particles;
    const double reach = view->kernel.support + view->skin;
    CALL(zone_list(open, view));
    CALL(memory_grow((void **)&inflow->start, &inflow->start_capacity, open->n_zone + 1,
                     sizeof *inflow->start));
    inflow->n_pairs = 0;
    for (size_t z = 0; z < open->n_zone; ++z) {
        struct cell_range ranges[CELL_GRID_RANGES];
        size_t k = open->zone[z];
        double x[3] = {particles->x[0][k], particles->x[1][k], particles->x[2][k]};
        size_t n = cell_grid_ranges(view->grid, x, reach, ranges);
        inflow->start[z] = (uint32_t)inflow->n_pairs;
        for (size_t r = 0; r < n; ++r)
            for (uint32_t i = ranges[r].begin; i < ranges[r].end; ++i) {
                double r2 = 0.0;
                for (int d = 0; d < 3; ++d)
                    r2 += pow(x[d] - particles->x[d][i] - ranges[r].shift[d], 2.0);
                if (particles->kind[i] != PARTICLE_FLUID || r2 >= reach * reach)
                    continue;
                CALL(memory_grow((void **)&inflow->fluid, &inflow->pair_capacity, inflow->n_pairs + 1,
                                 sizeof *inflow->fluid));
                CALL(memory_grow((void **)&inflow->shift, &inflow->shift_capacity, inflow->n_pairs + 1,
                                 sizeof *inflow->shift));
                memcpy(inflow->shift[inflow->n_pairs], ranges[r].shift, sizeof *inflow->shift);
                inflow->fluid[inflow->n_pairs++] = i;
            }
    }
    inflow->start[open->n_zone] = (uint32_t)inflow->n_pairs;
    return 0;
}

static int inflow_values(struct open_boundary *open, const struct fluid_view *view,
                         struct particles *particles)
{
    const struct inflow *inflow = open->data;
    const double c2 = view->sound_speed * view->sound_speed;
#pragma omp parallel for schedule(static)
    for (size_t z = 0; z < open->n_zone; ++z) {
        size_t k = open->zone[z];
        double weight = 0.0, p = 0.0;
        for (uint32_t c = inflow->start[z]; c < inflow->start[z + 1]; ++c) {
            size_t i = inflow->fluid[c];
            double r2 = 0.0;
            for (int d = 0; d < 3; ++d)
                r2 += pow(particles->x[d][k] - particles->x[d][i] - inflow->shift[c][d], 2.0);
            double w = particles->m[i] / particles->rho[i] * kernel_w(&view->kernel, sqrt(r2));
            weight += w;
            p += particles->p[i] * w;
        }
        particles->p[k] = weight > 0.0 ? p / weight : 0.0;
        particles->rho[k] = particles->p[k] / c2 + view->density;
    }
    return 0;
}

const struct open_boundary_type open_boundary_inflow = {
    .name = "inflow",
    .create = inflow_create,
    .destroy = inflow_destroy,
    .velocities = inflow_velocities,
    .move = inflow_move,
    .list = inflow_list,
    .values = inflow_values,
};

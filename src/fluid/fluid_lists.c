// SPDX-License-Identifier: GPL-3.0-or-later
/* Rebuilding: particles that left or changed kind, the sort, and the lists of fluid, walls and openings. */
#include "base/error.h"
#include "base/log.h"
#include "base/memory.h"
#include "fluid/fluid_internal.h"

#include <math.h>
#include <string.h>

/** Wrap into a box that is periodic in direction @p k. */
static void along_wrap(struct particles *block, int k, double low, double high)
{
    const double length = high - low;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < block->n; ++i) {
        double x = block->x[k][i];
        if (x >= low && x < high)
            continue;
        x -= length * floor((x - low) / length);
        block->x[k][i] = x < high ? x : low;
    }
}

/** Wrap into periodic boxes; deal with particles that left the domain elsewhere. */
static int block_wrap(struct fluid *fluid)
{
    const struct model_domain *domain = &fluid->model->domain;
    struct particles *block = fluid->block;
    long removed = 0;
    for (int k = 0; k < fluid->model->dim; ++k) {
        double low = domain->lower[k], high = domain->upper[k];
        if (domain->periodic[k]) {
            along_wrap(block, k, low, high);
            continue;
        }
        for (size_t i = 0; i < block->n; ++i) {
            double x = block->x[k][i];
            if (x >= low && x < high)
                continue;
            CHECK(domain->outside == OUTSIDE_REMOVE && block->kind[i] == PARTICLE_FLUID, STATUS_NUMERICAL,
                  "particle %lld left the domain at (%g, %g, %g) at t = %g s: is a wall open there, or the "
                  "step too "
                  "large?",
                  (long long)block->id[i], block->x[0][i], block->x[1][i], block->x[2][i], fluid->view.t);
            removed += !fluid->dead[i];
            fluid->dead[i] = 1;
        }
    }
    if (removed)
        log_message(LOG_WARNING, "%ld particles left the domain before t = %g s and were removed", removed,
                    fluid->view.t);
    return 0;
}

/** Kinds change, particles are born and die: leaves in fluid->dead a flag for every particle of the block. */
static int block_recycle(struct fluid *fluid)
{
    size_t n = fluid->block->n;
    CALL(memory_grow((void **)&fluid->dead, &fluid->dead_capacity, n, 1));
    memset(fluid->dead, 0, n);
    for (size_t k = 0; k < fluid->n_openings; ++k)
        CALL(fluid->openings[k].type->move(&fluid->openings[k], &fluid->view, fluid->block, fluid->dead));
    size_t born = fluid->block->n - n;
    CALL(memory_grow((void **)&fluid->dead, &fluid->dead_capacity, n + born, 1));
    memset(fluid->dead + n, 0, born);
    /* a dead particle may lie anywhere: it must not be found outside the domain below */
    for (size_t i = 0; i < n; ++i)
        for (int d = 0; d < fluid->model->dim && fluid->dead[i]; ++d)
            fluid->block->x[d][i] = fluid->model->domain.lower[d];
    return block_wrap(fluid);
}

/** Lists of fluid, walls and openings for sorted particles and walls where they are. */
static int lists_make(struct fluid *fluid)
{
    const double *x[3] = {fluid->block->x[0], fluid->block->x[1], fluid->block->x[2]};
    CALL(neighbour_list_make(&fluid->list, &fluid->grid, x, fluid->block->n,
                             fluid->view.kernel.support + fluid->skin, fluid->isa));
    for (size_t k = 0; k < fluid->n_boundaries; ++k)
        CALL(fluid->boundaries[k]->type->list(fluid->boundaries[k], &fluid->view));
    for (size_t k = 0; k < fluid->n_openings; ++k)
        CALL(fluid->openings[k].type->list(&fluid->openings[k], &fluid->view));
    return 0;
}

int fluid_rebuild(struct fluid *fluid)
{
    struct particles *block = fluid->block;
    CALL(block_recycle(fluid));
    CALL(memory_grow((void **)&fluid->order, &fluid->order_capacity, block->n, sizeof *fluid->order));
    size_t alive = 0, dead = 0;
    for (size_t i = 0; i < block->n; ++i)
        dead += fluid->dead[i];
    if (dead) {
        for (size_t i = 0; i < block->n; ++i)
            if (!fluid->dead[i])
                fluid->order[alive++] = (uint32_t)i;
        CALL(particles_permute(block, fluid->order, alive));
    }
    const double *x[3] = {block->x[0], block->x[1], block->x[2]};
    CALL(cell_grid_sort(&fluid->grid, x, block->n, fluid->order));
    CALL(particles_permute(block, fluid->order, block->n));
    for (int k = 0; k < fluid->model->dim; ++k)
        memcpy(fluid->listed[k], block->x[k], block->n * sizeof(double));
    fluid->list_time = fluid->view.t;
    fluid->drift = 0.0;
    for (size_t k = 0; k < fluid->n_boundaries; ++k) {
        struct boundary *b = fluid->boundaries[k];
        b->drift = 0.0;
        for (size_t s = 0; s < b->n_surfaces; ++s) {
            surface_at(b->surfaces[s], fluid->view.t);
            surface_mark(b->surfaces[s]);
        }
    }
    ++fluid->rebuilds;
    return lists_make(fluid);
}

/** Exchange the particles' places with those of the last rebuild. */
static void places_swap(struct fluid *fluid)
{
    struct particles *block = fluid->block;
    const size_t size = block->n * sizeof(double);
    for (int k = 0; k < fluid->model->dim; ++k) {
        memcpy(block->scratch, block->x[k], size);
        memcpy(block->x[k], fluid->listed[k], size);
        memcpy(fluid->listed[k], block->scratch, size);
    }
}

int fluid_relist(struct fluid *fluid)
{
    struct particles *block = fluid->block;
    const double *x[3] = {block->x[0], block->x[1], block->x[2]};
    places_swap(fluid);
    CALL(memory_grow((void **)&fluid->order, &fluid->order_capacity, block->n, sizeof *fluid->order));
    CALL(cell_grid_sort(&fluid->grid, x, block->n, fluid->order));
    for (size_t i = 0; i < block->n; ++i)
        CHECK(fluid->order[i] == i, STATUS_IO,
              "the checkpoint does not fit the deck: its particles are not sorted by the deck's cells");
    fluid->view.t = fluid->list_time;
    for (size_t k = 0; k < fluid->n_boundaries; ++k)
        for (size_t s = 0; s < fluid->boundaries[k]->n_surfaces; ++s)
            surface_recall(fluid->boundaries[k]->surfaces[s], fluid->list_time);
    CALL(lists_make(fluid));
    fluid->list.fresh = false;
    places_swap(fluid);
    fluid->grid.moved = fluid->drift;
    return 0;
}

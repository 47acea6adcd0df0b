// SPDX-License-Identifier: GPL-3.0-or-later
/* The sweep over walls: in double, with global coordinates, exactly antisymmetric; parallel over near
 * particles. */
#include "base/error.h"
#include "base/memory.h"
#include "fluid/fluid_internal.h"

#include <omp.h>

static int forces_reserve(struct fluid_wall_forces *forces, size_t n)
{
    size_t capacity = forces->capacity;
    for (int k = 0; k < 3; ++k) {
        size_t old = capacity;
        CALL(memory_grow((void **)&forces->a[k], &old, n, sizeof(double)));
        old = capacity;
        CALL(memory_grow((void **)&forces->a_background[k], &old, n, sizeof(double)));
        forces->capacity = old;
    }
    return 0;
}

static int near_forces(struct fluid *fluid, struct boundary *boundary, struct fluid_wall_forces *forces,
                       size_t near, int thread)
{
    struct wall_neighbours *neighbours = &fluid->scratch[thread];
    CALL(boundary->type->gather(boundary, &fluid->view, near, neighbours));
    CALL(memory_grow((void **)&fluid->force[thread], &fluid->force_capacity[thread],
                     3 * neighbours->capacity + 3, sizeof(double)));
    double *base = fluid->force[thread];
    double *const force[3] = {base, base + neighbours->capacity, base + 2 * neighbours->capacity};
    double a[3], background[3];
    fluid->type->wall_pair(fluid, boundary->near[near], neighbours, a, background, force);
    for (int k = 0; k < 3; ++k) {
        forces->a[k][near] = a[k];
        forces->a_background[k][near] = background[k];
    }
    boundary->type->react(boundary, near, neighbours, force);
    return 0;
}

int fluid_wall_forces(struct fluid *fluid, size_t b)
{
    struct boundary *boundary = fluid->boundaries[b];
    struct fluid_wall_forces *forces = &fluid->wall_forces[b];
    CALL(forces_reserve(forces, boundary->n_near));
    CALL(boundary->type->close(boundary, &fluid->view));
    int status = 0;
#pragma omp parallel for schedule(dynamic, 32) reduction(| : status)
    for (size_t near = 0; near < boundary->n_near; ++near)
        if (!status)
            status = near_forces(fluid, boundary, forces, near, omp_get_thread_num());
    if (status)
        return status;
    for (size_t s = 0; s < boundary->n_surfaces; ++s)
        surface_clear_load(boundary->surfaces[s]);
    boundary_load(boundary, &fluid->view);
    return 0;
}

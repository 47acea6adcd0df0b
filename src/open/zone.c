// SPDX-License-Identifier: GPL-3.0-or-later
#include "open/zone.h"

#include "base/error.h"
#include "base/memory.h"

int zone_release(struct open_boundary *open, const struct fluid_view *view, struct particles *particles)
{
    const struct model_open *definition = open->definition;
    const uint8_t kind = definition->kind == OPEN_INFLOW ? PARTICLE_INFLOW : PARTICLE_OUTFLOW;
    const size_t n = particles->n;
    for (size_t i = 0; i < n; ++i) {
        if (particles->kind[i] != kind || particles->opening[i] != open->index)
            continue;
        double x[3] = {particles->x[0][i], particles->x[1][i], particles->x[2][i]};
        if (zone_inside(definition, x) <= 0.1 * view->spacing)
            continue;
        size_t born;
        particles->kind[i] = PARTICLE_FLUID;
        particles->opening[i] = 0;
        x[definition->axis] -= definition->into * open->depth;
        CALL(particles_reserve(particles, particles->n + 1 > particles->capacity
                                              ? particles->n + particles->n / 4 + 64
                                              : particles->n + 1));
        CALL(particles_append(particles, (enum particle_kind)kind, x, view->mass, &born));
        particles->opening[born] = (uint8_t)open->index;
        particles->rho[born] = particles->rho[i];
        particles->p[born] = particles->p[i];
        for (int k = 0; k < 3; ++k)
            particles->u[k][born] = particles->u[k][i];
        ++open->born;
    }
    return 0;
}

int zone_list(struct open_boundary *open, const struct fluid_view *view)
{
    const struct particles *particles = view->particles;
    const uint8_t kind = open->definition->kind == OPEN_INFLOW ? PARTICLE_INFLOW : PARTICLE_OUTFLOW;
    open->n_zone = 0;
    for (size_t i = 0; i < particles->n; ++i) {
        if (particles->kind[i] != kind || particles->opening[i] != open->index)
            continue;
        CALL(memory_grow((void **)&open->zone, &open->zone_capacity, open->n_zone + 1, sizeof *open->zone));
        open->zone[open->n_zone++] = (uint32_t)i;
    }
    return 0;
}

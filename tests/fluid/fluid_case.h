// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TESTS_FLUID_FLUID_CASE_H
#define TESTS_FLUID_FLUID_CASE_H

#include "base/timer.h"
#include "fluid/fluid.h"
#include "model/model.h"

/** A box of fluid without walls, made without a deck. */
struct fluid_case {
    struct model model;
    struct fluid_material material;
    struct model_region region;
    struct timer timer;
    struct fluid *fluid;
};

/** A periodic box of @p cells[k] spacings of @p dx, particles moved off the lattice by up to @p jitter
 * spacings (and, if @p cluster, drawn together towards the middle), random velocities of size @p speed. @p
 * isa as in fluid_parts. Returns a status. */
int fluid_case_create(struct fluid_case *c, int dim, const int cells[3], double dx, double jitter,
                      double speed, int cluster, enum arithmetic arithmetic, const char *isa);
void fluid_case_reset(struct fluid_case *c);

/** A repeatable number in [-1, 1). */
double fluid_case_random(uint64_t *seed);

#endif

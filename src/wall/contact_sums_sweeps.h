// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef WALL_CONTACT_SUMS_SWEEPS_H
#define WALL_CONTACT_SUMS_SWEEPS_H

#include "model/particles.h"
#include "sph/isa.h"
#include "sph/kernel.h"

#include <stdint.h>

/** Particles around a place of the wall, and how they count there. */
struct contact_sums_task {
    const struct kernel *kernel;
    const struct particles *particles;
    const uint32_t *list; /**< of @c n particles; those out of the kernel's support do not count */
    uint32_t n;
    uint32_t self;    /**< this one counts fully wherever it is */
    double c[3];      /**< the place, m */
    double period[3]; /**< the nearest images count; 0: not periodic */
    double normal[3];
    double per_ramp; /**< 1/m; above 0: weights rise with the height over the plane through c, times this,
                        from 0 at 0 to 1 at 1 */
};

/** Sums of weight, and weight times pressure, density, velocity and place relative to c. */
struct contact_sums {
    double weight, p, rho, u[3], r[3];
};

typedef void contact_sums_sweep(const struct contact_sums_task *task, struct contact_sums *sums);

/** The sweep for each instruction set. */
contact_sums_sweep *contact_sums_of(enum isa isa);

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef SPH_SHEPARD_H
#define SPH_SHEPARD_H

#include "model/particles.h"
#include "sph/cell_grid.h"
#include "sph/kernel.h"

#include <stddef.h>
#include <stdint.h>

/** Fluid particles to be summed over, in the order of a cell grid. Nothing here is owned. */
struct shepard {
    const struct kernel *kernel;
    const struct cell_grid *grid;
    const double *x[3];
    const double *m, *rho; /**< V = m / rho */
    const uint8_t *kind;   /**< only PARTICLE_FLUID counts; NULL: every particle does */
};

/** Shepard-corrected sums at place @p x (paper 000 eq. 14): @p means[v] = sum V f W / sum V W for each of the
 * @p n fields f = @p values[v], NaN where no particle is in reach. Returns sum V W (0: none is). */
double shepard_means(const struct shepard *shepard, const double x[3], size_t n, const double *const *values,
                     double *means);

#endif

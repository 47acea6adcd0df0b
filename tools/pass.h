// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TOOLS_PASS_H
#define TOOLS_PASS_H

#include "sph/neighbour_list.h"

/** What one evaluation of a weakly compressible free-surface formulation reads and writes: n entries each. */
struct pass_arrays {
    int dim;
    const double *x[3];
    double *u[3], *rho, *p;          /**< velocity, density, pressure */
    double mass, h, kernel_constant; /**< of a particle; smoothing length; alpha_D of the kernel */
    double viscosity, diffusion;     /**< nu_0, m^2/s; 2 delta h c, m^2/s */
    double *drho, *a[3];             /**< result: rates of density and velocity */
    void *places, *records;          /**< workspace for every slot: dim and dim + 3 numbers of 4 bytes */
};

/** The pair terms of Martinez-Estevez et al. (2023), Wendland C2 kernel (eq. 3) with support 2 h: momentum
 * (4) with the laminar term of (5), continuity (8) with the diffusion (9), in one sweep. Compiled once per
 * instruction set. */
typedef void pass_sweep(struct neighbour_list *list, const struct pass_arrays *arrays);

pass_sweep pass_sweep_baseline_mixed, pass_sweep_v3_mixed, pass_sweep_v4_mixed;

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FLUID_TRANSPORT_VELOCITY_H
#define FLUID_TRANSPORT_VELOCITY_H

#include "sph/isa.h"
#include "sph/neighbour_list.h"

#include <stdbool.h>

/** What the sweeps of the transport-velocity formulation read and write: arrays of the moving block (in
 * double), n entries. */
struct transport_velocity_arrays {
    int dim;
    const double *x[3], *u[3], *w[3]; /**< place, velocity u, transport minus momentum velocity */
    size_t n;
    const double *rho, *p, *m;
    void *places, *records;     /**< workspace for every slot of the list: dim places (4 bytes each in mixed
                                     arithmetic, else 8) and dim + 3 numbers of the pair arithmetic, 2 dim + 3
                                     with the convective stress */
    double h, constant;         /**< smoothing length; kernel normalisation */
    double viscosity;           /**< dynamic, Pa s */
    double background_pressure; /**< Pa */
    bool convective_stress;     /**< add it to the momentum equation */
    double *kernel_sum;         /**< density sweep: sum_j W_ij, self included, 1/m^dim */
    double *a[3],
        *a_background[3]; /**< force sweep: accelerations by eq. 16 and by the background pressure */
};

/** The sweeps, compiled once per instruction set and precision of the pair arithmetic. */
struct transport_velocity_sweeps {
    void (*density)(struct neighbour_list *list, const struct transport_velocity_arrays *arrays);
    void (*force)(struct neighbour_list *list, const struct transport_velocity_arrays *arrays);
};

#define TRANSPORT_VELOCITY_DECLARE(isa)                                                                      \
    extern const struct transport_velocity_sweeps transport_velocity_sweeps_##isa##_mixed;                   \
    extern const struct transport_velocity_sweeps transport_velocity_sweeps_##isa##_double;
TRANSPORT_VELOCITY_DECLARE(baseline)
TRANSPORT_VELOCITY_DECLARE(v3)
TRANSPORT_VELOCITY_DECLARE(v4)
#undef TRANSPORT_VELOCITY_DECLARE

#endif

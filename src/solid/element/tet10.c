// SPDX-License-Identifier: GPL-3.0-or-later
#include "solid/element/element_list.h"
#include "solid/element/full.h"

enum { DIM = 3, NODES = 10, POINTS = 4 };

static int full_prepare_kernel(const double (*X)[3], const struct constitutive *material, double *data)
{
    (void)material;
    return prepare_points(DIM, NODES, ELEMENT_TET10, X, data);
}

static int full_forces_kernel(const double *data, const struct constitutive *material, const double *d,
                              double *f, double *K)
{
    return full_forces(DIM, NODES, POINTS, data, material, d, f, K);
}

static double full_energy_kernel(const double *data, const struct constitutive *material, const double *d,
                                 double stress[6], double *volume)
{
    return full_energy(DIM, NODES, POINTS, data, material, d, stress, volume);
}

const struct element_kernel tet10_full = {
    .type = ELEMENT_TET10,
    .formulation = SOLID_FULL,
    .n_points = POINTS,
    .data_size = POINTS * (1 + NODES * DIM),
    .prepare = full_prepare_kernel,
    .forces = full_forces_kernel,
    .energy = full_energy_kernel,
};

// SPDX-License-Identifier: GPL-3.0-or-later
#include "solid/element/eas.h"
#include "solid/element/element_list.h"
#include "solid/element/f_bar.h"
#include "solid/element/full.h"

enum { DIM = 2, NODES = 4, POINTS = 4 };

static int points_prepare_kernel(const double (*X)[3], const struct constitutive *material, double *data)
{
    (void)material;
    return prepare_points(DIM, NODES, ELEMENT_QUAD4, X, data);
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

const struct element_kernel quad4_full = {
    .type = ELEMENT_QUAD4,
    .formulation = SOLID_FULL,
    .n_points = POINTS,
    .data_size = POINTS * (1 + NODES * DIM),
    .prepare = points_prepare_kernel,
    .forces = full_forces_kernel,
    .energy = full_energy_kernel,
};

static int f_bar_forces_kernel(const double *data, const struct constitutive *material, const double *d,
                               double *f, double *K)
{
    return f_bar_forces(DIM, NODES, POINTS, data, material, d, f, K);
}

static double f_bar_energy_kernel(const double *data, const struct constitutive *material, const double *d,
                                  double stress[6], double *volume)
{
    return f_bar_energy(DIM, NODES, POINTS, data, material, d, stress, volume);
}

const struct element_kernel quad4_f_bar = {
    .type = ELEMENT_QUAD4,
    .formulation = SOLID_F_BAR,
    .n_points = POINTS,
    .data_size = POINTS * (1 + NODES * DIM),
    .prepare = points_prepare_kernel,
    .forces = f_bar_forces_kernel,
    .energy = f_bar_energy_kernel,
};

static int eas_prepare_kernel(const double (*X)[3], const struct constitutive *material, double *data)
{
    return eas_prepare(DIM, NODES, ELEMENT_QUAD4, POINTS, X, material, data);
}

static int eas_forces_kernel(const double *data, const struct constitutive *material, const double *d,
                             double *f, double *K)
{
    return eas_forces(DIM, NODES, POINTS, data, material, d, f, K);
}

static double eas_energy_kernel(const double *data, const struct constitutive *material, const double *d,
                                double stress[6], double *volume)
{
    return eas_energy(DIM, NODES, POINTS, data, material, d, stress, volume);
}

const struct element_kernel quad4_eas = {
    .type = ELEMENT_QUAD4,
    .formulation = SOLID_EAS,
    .n_points = POINTS,
    .data_size = POINTS * (1 + NODES * DIM + 2 * 3 * 4),
    .prepare = eas_prepare_kernel,
    .forces = eas_forces_kernel,
    .energy = eas_energy_kernel,
};

// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef SOLID_ELEMENT_FULL_H
#define SOLID_ELEMENT_FULL_H

#include "base/error.h"
#include "solid/element/kinematics.h"

#include <math.h>

/** Displacement elements with full integration: f = integral of B^T S (paper 000 eq. 26). First-order ones
 * lock in bending and near incompressibility. */

ALWAYS_INLINE int full_forces(const int dim, const int nodes, const int points, const double *data,
                              const struct constitutive *material, const double *d, double *f, double *K)
{
    const int dof = nodes * dim;
    memset(f, 0, (size_t)dof * sizeof *f);
    if (K)
        memset(K, 0, (size_t)(dof * dof) * sizeof *K);
    for (int p = 0; p < points; p++) {
        const double w = data[p * point_stride(dim, nodes)];
        const double *G = data + p * point_stride(dim, nodes) + 1;
        double F[9], E[VOIGT_MAX], S[VOIGT_MAX], D[VOIGT_MAX * VOIGT_MAX], B[VOIGT_MAX * ELEMENT_MAX_DOF];
        if (!(deformation_gradient(dim, nodes, G, d, F) > 0))
            return STATUS_NUMERICAL;
        green_lagrange(dim, F, E);
        if (isnan(material->law->stress(material->parameters, dim, E, S, K ? D : NULL)))
            return STATUS_NUMERICAL;
        add_force(dim, nodes, w, F, S, G, f);
        if (!K)
            continue;
        strain_operator(dim, nodes, F, G, B);
        add_material_stiffness(dim, nodes, w, B, D, B, K);
        add_geometric_stiffness(dim, nodes, w, S, G, K);
    }
    return 0;
}

ALWAYS_INLINE double full_energy(const int dim, const int nodes, const int points, const double *data,
                                 const struct constitutive *material, const double *d, double *stress,
                                 double *volume)
{
    double energy = 0, total = 0;
    if (stress)
        memset(stress, 0, 6 * sizeof *stress);
    for (int p = 0; p < points; p++) {
        const double w = data[p * point_stride(dim, nodes)];
        double F[9], E[VOIGT_MAX], S[VOIGT_MAX];
        deformation_gradient(dim, nodes, data + p * point_stride(dim, nodes) + 1, d, F);
        green_lagrange(dim, F, E);
        energy += w * material->law->stress(material->parameters, dim, E, S, NULL);
        total += w;
        if (stress)
            add_cauchy(dim, w, F, S, stress);
    }
    finish_average(total, stress, volume);
    return energy;
}

#endif

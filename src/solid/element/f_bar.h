// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef SOLID_ELEMENT_F_BAR_H
#define SOLID_ELEMENT_F_BAR_H

#include "base/error.h"
#include "solid/element/kinematics.h"

#include <math.h>

/** F-bar: the stress comes from Fbar = (theta/J)^(1/n) F with one dilatation theta per element, n = 2 in
 * plane strain (in-plane part) and 3 otherwise (de Souza Neto et al. 1996). Here in the variational form
 * (Elguedj et al. 2008): theta is the mean of J = det F over the element, and the force is the gradient of
 * the energy of Fbar, so that the tangent is symmetric, energy is conserved and hexahedra of any shape pass
 * the patch test. With r = (theta/J)^(1/n), g_a = F^-T G_a, g0_a = grad theta / theta = integral of J g_a /
 * (V theta) and h_a = (g0_a - g_a)/n: Ebar = (r^2 C - I)/2,   dEbar/dd_p = r^2 (B_p + h_p C), S : d2Ebar/dd_p
 * dd_q = r^2 [(2 h_p h_q + h_pq) S:C + 2 h_p S:B_q + 2 h_q S:B_p + delta_ij G_a S G_b], n h_pq = g_bi g_aj +
 * integral of J (g_ai g_bj - g_bi g_aj) / (V theta) - g0_ai g0_bj  for p = (a, i), q = (b, j). */

enum { F_BAR_MAX_POINTS = 8, F_BAR_MAX_DOF = 24 };

/** What a point needs. */
struct f_bar_point {
    double F[9], C[VOIGT_MAX], det, r2;
    double g[F_BAR_MAX_DOF], h[F_BAR_MAX_DOF];
};

/** g_a = F^-T G_a. */
ALWAYS_INLINE void spatial_gradients(const int dim, const int nodes, const double *F, const double det,
                                     const double *G, double *g)
{
    double inverse[9];
    invert(dim, F, det, inverse);
    for (int a = 0; a < nodes; a++)
        for (int i = 0; i < dim; i++) {
            g[a * dim + i] = 0;
            for (int J = 0; J < dim; J++)
                g[a * dim + i] += inverse[dim * J + i] * G[a * dim + J];
        }
}

/** First pass: kinematics of all points, and g0. */
ALWAYS_INLINE int f_bar_kinematics(const int dim, const int nodes, const int points, const double *data,
                                   const double *d, struct f_bar_point *point, double *g0,
                                   double *current_volume)
{
    const int dof = nodes * dim, stride = point_stride(dim, nodes);
    double reference = 0, current = 0;
    memset(g0, 0, (size_t)dof * sizeof *g0);
    for (int p = 0; p < points; p++) {
        const double w = data[p * stride], *G = data + p * stride + 1;
        point[p].det = deformation_gradient(dim, nodes, G, d, point[p].F);
        if (!(point[p].det > 0))
            return STATUS_NUMERICAL;
        right_cauchy_green(dim, point[p].F, point[p].C);
        spatial_gradients(dim, nodes, point[p].F, point[p].det, G, point[p].g);
        reference += w;
        current += w * point[p].det;
        for (int q = 0; q < dof; q++)
            g0[q] += w * point[p].det * point[p].g[q];
    }
    for (int q = 0; q < dof; q++)
        g0[q] /= current;
    for (int p = 0; p < points; p++) {
        const double ratio = current / (reference * point[p].det);
        point[p].r2 = dim == 2 ? ratio : cbrt(ratio) * cbrt(ratio);
        for (int q = 0; q < dof; q++)
            point[p].h[q] = (g0[q] - point[p].g[q]) / dim;
    }
    *current_volume = current;
    return 0;
}

ALWAYS_INLINE void f_bar_strain(const int dim, const struct f_bar_point *point, double *E)
{
    for (int k = 0; k < voigt_size(dim); k++)
        E[k] = 0.5 * (point->r2 * point->C[k] - (k < dim));
}

/** Stiffness of one point, without the second derivative of theta. */
ALWAYS_INLINE void f_bar_add_stiffness(const int dim, const int nodes, const double w,
                                       const struct f_bar_point *point, const double *S, const double SC,
                                       const double *D, const double *G, double *K)
{
    const int dof = nodes * dim;
    double B[VOIGT_MAX * F_BAR_MAX_DOF], Bbar[VOIGT_MAX * F_BAR_MAX_DOF], SB[F_BAR_MAX_DOF];
    strain_operator(dim, nodes, point->F, G, B);
    for (int q = 0; q < dof; q++) {
        SB[q] = 0;
        for (int k = 0; k < voigt_size(dim); k++) {
            Bbar[k * dof + q] = point->r2 * (B[k * dof + q] + point->h[q] * point->C[k]);
            SB[q] += S[k] * B[k * dof + q];
        }
    }
    add_material_stiffness(dim, nodes, w, Bbar, D, Bbar, K);
    const double *g = point->g, *h = point->h, wr = w * point->r2;
    for (int p = 0; p < dof; p++)
        for (int q = 0; q < dof; q++) {
            const int x = q - q % dim + p % dim, y = p - p % dim + q % dim; /* (b, i) and (a, j) */
            K[p * dof + q] +=
                wr * ((2 * h[p] * h[q] + g[x] * g[y] / dim) * SC + 2 * (h[p] * SB[q] + h[q] * SB[p]));
        }
    add_geometric_stiffness(dim, nodes, wr, S, G, K);
}

/** The second derivative of ln theta, times @p factor. */
ALWAYS_INLINE void f_bar_add_dilatation(const int dim, const int nodes, const int points, const double *data,
                                        const struct f_bar_point *point, const double *g0,
                                        const double current_volume, const double factor, double *K)
{
    const int dof = nodes * dim;
    for (int p = 0; p < dof; p++)
        for (int q = 0; q < dof; q++) {
            const int x = q - q % dim + p % dim, y = p - p % dim + q % dim;
            double sum = -g0[p] * g0[q];
            for (int k = 0; k < points; k++) {
                const double *g = point[k].g;
                sum += data[k * point_stride(dim, nodes)] * point[k].det / current_volume *
                       (g[p] * g[q] - g[x] * g[y]);
            }
            K[p * dof + q] += factor * sum;
        }
}

ALWAYS_INLINE int f_bar_forces(const int dim, const int nodes, const int points, const double *data,
                               const struct constitutive *material, const double *d, double *f, double *K)
{
    const int dof = nodes * dim;
    struct f_bar_point point[F_BAR_MAX_POINTS];
    double g0[F_BAR_MAX_DOF], current_volume, factor = 0;
    CALL(f_bar_kinematics(dim, nodes, points, data, d, point, g0, &current_volume));
    memset(f, 0, (size_t)dof * sizeof *f);
    if (K)
        memset(K, 0, (size_t)(dof * dof) * sizeof *K);
    for (int p = 0; p < points; p++) {
        const double w = data[p * point_stride(dim, nodes)];
        const double *G = data + p * point_stride(dim, nodes) + 1;
        double E[VOIGT_MAX], S[VOIGT_MAX], D[VOIGT_MAX * VOIGT_MAX], SC = 0;
        f_bar_strain(dim, &point[p], E);
        if (isnan(material->law->stress(material->parameters, dim, E, S, K ? D : NULL)))
            return STATUS_NUMERICAL;
        add_force(dim, nodes, w * point[p].r2, point[p].F, S, G, f);
        for (int k = 0; k < voigt_size(dim); k++)
            SC += S[k] * point[p].C[k];
        for (int q = 0; q < dof; q++)
            f[q] += w * point[p].r2 * SC * point[p].h[q];
        factor += w * point[p].r2 * SC / dim;
        if (K)
            f_bar_add_stiffness(dim, nodes, w, &point[p], S, SC, D, G, K);
    }
    if (K)
        f_bar_add_dilatation(dim, nodes, points, data, point, g0, current_volume, factor, K);
    return 0;
}

ALWAYS_INLINE double f_bar_energy(const int dim, const int nodes, const int points, const double *data,
                                  const struct constitutive *material, const double *d, double *stress,
                                  double *volume)
{
    struct f_bar_point point[F_BAR_MAX_POINTS];
    double g0[F_BAR_MAX_DOF], current_volume, energy = 0, total = 0;
    if (stress)
        memset(stress, 0, 6 * sizeof *stress);
    if (f_bar_kinematics(dim, nodes, points, data, d, point, g0, &current_volume))
        return NAN;
    for (int p = 0; p < points; p++) {
        const double w = data[p * point_stride(dim, nodes)], r = sqrt(point[p].r2);
        double E[VOIGT_MAX], S[VOIGT_MAX];
        f_bar_strain(dim, &point[p], E);
        energy += w * material->law->stress(material->parameters, dim, E, S, NULL);
        total += w;
        for (int k = 0; k < dim * dim; k++)
            point[p].F[k] *= r;
        if (stress)
            add_cauchy(dim, w, point[p].F, S, stress);
    }
    finish_average(total, stress, volume);
    return energy;
}

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef SOLID_ELEMENT_KINEMATICS_H
#define SOLID_ELEMENT_KINEMATICS_H

#include "solid/element/element.h"
#include "solid/element/quadrature.h"

#include <string.h>

/** Kinematics shared by all formulations. Everything is forced inline with the dimension and the number of
 * nodes as constants, so that each element file gets its own unrolled loops. Gradients G: nodes x dim, G_aJ =
 * dN_a/dX_J. Tensors: dim x dim, row by row.
 *
 * Layout of the data of an element: per quadrature point POINT_STRIDE doubles (weight x Jacobian, then G),
 * then what the formulation adds. */

#define ALWAYS_INLINE static inline __attribute__((always_inline))

ALWAYS_INLINE int point_stride(const int dim, const int nodes)
{
    return 1 + nodes * dim;
}

ALWAYS_INLINE int voigt_size(const int dim)
{
    return dim == 2 ? 3 : 6;
}

/** Rows and columns of the components XX YY XY and XX YY ZZ XY YZ XZ. */
ALWAYS_INLINE int voigt_row(const int dim, const int k)
{
    return k < dim ? k : dim == 2 ? 0 : k == 3 ? 0 : k == 4 ? 1 : 0;
}

ALWAYS_INLINE int voigt_column(const int dim, const int k)
{
    return k < dim ? k : dim == 2 ? 1 : k == 3 ? 1 : 2;
}

ALWAYS_INLINE double determinant(const int dim, const double *A)
{
    if (dim == 2)
        return A[0] * A[3] - A[1] * A[2];
    return A[0] * (A[4] * A[8] - A[5] * A[7]) - A[1] * (A[3] * A[8] - A[5] * A[6]) +
           A[2] * (A[3] * A[7] - A[4] * A[6]);
}

/** Inverse; the determinant is known. */
ALWAYS_INLINE void invert(const int dim, const double *A, const double det, double *inverse)
{
    if (dim == 2) {
        inverse[0] = A[3] / det;
        inverse[1] = -A[1] / det;
        inverse[2] = -A[2] / det;
        inverse[3] = A[0] / det;
        return;
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int p = (j + 1) % 3, q = (j + 2) % 3, r = (i + 1) % 3, s = (i + 2) % 3;
            inverse[3 * i + j] = (A[3 * p + r] * A[3 * q + s] - A[3 * p + s] * A[3 * q + r]) / det;
        }
}

/** Jacobian J_iA = dX_i/dxi_A at @p xi; returns its determinant. */
ALWAYS_INLINE double jacobian(const int dim, const int nodes, const enum element_type type,
                              const double (*X)[3], const double xi[3], double (*dN)[3], double *J)
{
    double N[ELEMENT_MAX_NODES];
    element_shape(type, xi, N, dN);
    for (int i = 0; i < dim; i++)
        for (int A = 0; A < dim; A++) {
            J[dim * i + A] = 0;
            for (int a = 0; a < nodes; a++)
                J[dim * i + A] += X[a][i] * dN[a][A];
        }
    return determinant(dim, J);
}

/** Gradients at @p xi; returns the Jacobian's determinant. */
ALWAYS_INLINE double gradients(const int dim, const int nodes, const enum element_type type,
                               const double (*X)[3], const double xi[3], double *G)
{
    double dN[ELEMENT_MAX_NODES][3], J[9], inverse[9];
    const double det = jacobian(dim, nodes, type, X, xi, dN, J);
    invert(dim, J, det, inverse);
    for (int a = 0; a < nodes; a++)
        for (int I = 0; I < dim; I++) {
            G[a * dim + I] = 0;
            for (int A = 0; A < dim; A++)
                G[a * dim + I] += dN[a][A] * inverse[dim * A + I];
        }
    return det;
}

/** Weights and gradients of all points; STATUS_DECK when a Jacobian is not positive. */
ALWAYS_INLINE int prepare_points(const int dim, const int nodes, const enum element_type type,
                                 const double (*X)[3], double *data)
{
    const struct quadrature rule = quadrature_of(type, QUADRATURE_STIFFNESS);
    for (int p = 0; p < rule.n; p++) {
        double *point = data + p * point_stride(dim, nodes);
        const double det = gradients(dim, nodes, type, X, rule.xi[p], point + 1);
        if (!(det > 0))
            return STATUS_DECK;
        point[0] = rule.weight[p] * det;
    }
    return 0;
}

/** F = I + grad d (paper 000 after eq. 5; the printed text drops I); returns det F. */
ALWAYS_INLINE double deformation_gradient(const int dim, const int nodes, const double *G, const double *d,
                                          double *F)
{
    for (int i = 0; i < dim; i++)
        for (int J = 0; J < dim; J++) {
            double sum = i == J;
            for (int a = 0; a < nodes; a++)
                sum += d[a * dim + i] * G[a * dim + J];
            F[dim * i + J] = sum;
        }
    return determinant(dim, F);
}

/** C = F^T F as a strain vector (shear doubled). */
ALWAYS_INLINE void right_cauchy_green(const int dim, const double *F, double *C)
{
    for (int k = 0; k < voigt_size(dim); k++) {
        double sum = 0;
        for (int i = 0; i < dim; i++)
            sum += F[dim * i + voigt_row(dim, k)] * F[dim * i + voigt_column(dim, k)];
        C[k] = k < dim ? sum : 2 * sum;
    }
}

/** E = (F^T F - I)/2 as a strain vector. */
ALWAYS_INLINE void green_lagrange(const int dim, const double *F, double *E)
{
    right_cauchy_green(dim, F, E);
    for (int k = 0; k < voigt_size(dim); k++)
        E[k] = 0.5 * (E[k] - (k < dim));
}

/** f_ai += w P_iJ G_aJ with P = F S. */
ALWAYS_INLINE void add_force(const int dim, const int nodes, const double w, const double *F, const double *S,
                             const double *G, double *f)
{
    double P[9];
    for (int i = 0; i < dim; i++)
        for (int J = 0; J < dim; J++)
            P[dim * i + J] = 0;
    for (int k = 0; k < voigt_size(dim); k++) {
        const int r = voigt_row(dim, k), c = voigt_column(dim, k);
        for (int i = 0; i < dim; i++) {
            P[dim * i + c] += w * F[dim * i + r] * S[k];
            if (r != c)
                P[dim * i + r] += w * F[dim * i + c] * S[k];
        }
    }
    for (int a = 0; a < nodes; a++)
        for (int i = 0; i < dim; i++)
            for (int J = 0; J < dim; J++)
                f[a * dim + i] += P[dim * i + J] * G[a * dim + J];
}

/** B: voigt x dof, dE = B dd. */
ALWAYS_INLINE void strain_operator(const int dim, const int nodes, const double *F, const double *G,
                                   double *B)
{
    const int dof = nodes * dim;
    for (int k = 0; k < voigt_size(dim); k++) {
        const int r = voigt_row(dim, k), c = voigt_column(dim, k);
        for (int a = 0; a < nodes; a++)
            for (int i = 0; i < dim; i++)
                B[k * dof + a * dim + i] =
                    r == c ? F[dim * i + r] * G[a * dim + r]
                           : F[dim * i + r] * G[a * dim + c] + F[dim * i + c] * G[a * dim + r];
    }
}

/** K += w B^T D R (B and R: voigt x dof). */
ALWAYS_INLINE void add_material_stiffness(const int dim, const int nodes, const double w, const double *B,
                                          const double *D, const double *R, double *K)
{
    const int dof = nodes * dim, n = voigt_size(dim);
    double DR[VOIGT_MAX * ELEMENT_MAX_DOF];
    for (int k = 0; k < n; k++)
        for (int q = 0; q < dof; q++) {
            double sum = 0;
            for (int l = 0; l < n; l++)
                sum += D[k * n + l] * R[l * dof + q];
            DR[k * dof + q] = w * sum;
        }
    for (int p = 0; p < dof; p++)
        for (int k = 0; k < n; k++)
            for (int q = 0; q < dof; q++)
                K[p * dof + q] += B[k * dof + p] * DR[k * dof + q];
}

/** Geometric stiffness: K_(ai)(bi) += w G_a S G_b. */
ALWAYS_INLINE void add_geometric_stiffness(const int dim, const int nodes, const double w, const double *S,
                                           const double *G, double *K)
{
    const int dof = nodes * dim;
    for (int a = 0; a < nodes; a++) {
        double SG[3] = {0};
        for (int k = 0; k < voigt_size(dim); k++) {
            const int r = voigt_row(dim, k), c = voigt_column(dim, k);
            SG[r] += w * S[k] * G[a * dim + c];
            if (r != c)
                SG[c] += w * S[k] * G[a * dim + r];
        }
        for (int b = 0; b < nodes; b++) {
            double sum = 0;
            for (int J = 0; J < dim; J++)
                sum += SG[J] * G[b * dim + J];
            for (int i = 0; i < dim; i++)
                K[(a * dim + i) * dof + b * dim + i] += sum;
        }
    }
}

/** Add w F S F^T / det F to a Cauchy stress XX YY ZZ XY YZ XZ; plane strain: S[3] = S_ZZ and F_zz = 1. */
ALWAYS_INLINE void add_cauchy(const int dim, const double w, const double *F, const double *S,
                              double stress[6])
{
    const double scale = w / determinant(dim, F);
    for (int k = 0; k < 6; k++) {
        const int i = voigt_row(3, k), j = voigt_column(3, k);
        if (i >= dim || j >= dim)
            continue;
        double sum = 0;
        for (int l = 0; l < voigt_size(dim); l++) {
            const int r = voigt_row(dim, l), c = voigt_column(dim, l);
            sum += S[l] * F[dim * i + r] * F[dim * j + c];
            if (r != c)
                sum += S[l] * F[dim * i + c] * F[dim * j + r];
        }
        stress[k] += scale * sum;
    }
    if (dim == 2)
        stress[2] += scale * S[3];
}

/** Turn the sum of w times the stress into the average and hand out the volume. */
ALWAYS_INLINE void finish_average(const double volume, double stress[6], double *volume_out)
{
    for (int k = 0; stress && k < 6; k++)
        stress[k] /= volume;
    if (volume_out)
        *volume_out = volume;
}

#endif

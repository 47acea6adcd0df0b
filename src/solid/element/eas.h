// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef SOLID_ELEMENT_EAS_H
#define SOLID_ELEMENT_EAS_H

#include "base/error.h"
#include "solid/element/kinematics.h"

#include <math.h>

/** Enhanced assumed strain on Green-Lagrange's strain: E = E_u + M alpha (Simo and Rifai 1990; on E: Klinkel
 * and Wagner 1997), with M = (j0/j) T0 M_xi, whose covariant modes are xi_A for E_AA and xi_A, xi_B for 2
 * E_AB: 4 in 2-D, 9 in 3-D. The integral of M over an element vanishes, so that the patch test is passed; an
 * element that turns keeps E_u = 0 and alpha = 0. For a law linear in E, stationarity gives alpha = -D^-1
 * integral of M^T C E_u in closed form with constant D = integral of M^T C M: no inner iteration, no history.
 * For other laws alpha is the minimum of the element's energy for the given displacement, found by Newton's
 * method from that closed form with the law's tangent at rest: again a function of the displacement alone,
 * and the force is the derivative of the minimum's energy. Data: after the points, per point M (voigt x
 * modes) and A = -D^-1 M^T C w (modes x voigt), so that alpha = sum of A E_u. */

enum { EAS_MAX_MODES = 9, EAS_MAX_POINTS = 8, EAS_MAX_DOF = 24, EAS_ITERATIONS = 50 };

ALWAYS_INLINE int eas_modes(const int dim)
{
    return dim == 2 ? 4 : 9;
}

ALWAYS_INLINE int eas_stride(const int dim)
{
    return 2 * voigt_size(dim) * eas_modes(dim);
}

/** M at @p xi: E = sum of E_AB G^A (x) G^B with the contravariant base G^A (rows of J0^-1) at the centre. */
ALWAYS_INLINE void eas_operator(const int dim, const double *inverse0, const double ratio, const double xi[3],
                                double *M)
{
    const int n = voigt_size(dim), modes = eas_modes(dim);
    for (int l = 0, mode = 0; l < n; l++) {
        const int A = voigt_row(dim, l), B = voigt_column(dim, l);
        for (int m = 0; m < (l < dim ? 1 : 2); m++, mode++) {
            const double value = ratio * (m == 0 ? xi[A] : xi[B]);
            for (int k = 0; k < n; k++) {
                const int i = voigt_row(dim, k), j = voigt_column(dim, k);
                const double *a = inverse0 + dim * A, *b = inverse0 + dim * B;
                /* shear: 2 E_ij from 2 E_AB; direct: E_ij from E_AA */
                M[k * modes + mode] =
                    value * (k < dim ? a[i] * b[j] : (l < dim ? 2 * a[i] * b[j] : a[i] * b[j] + b[i] * a[j]));
            }
        }
    }
}

/** Solve D X = R (modes x columns) by Cholesky's factorisation of the small matrix @p D; false if D is not
 * positive. */
ALWAYS_INLINE bool eas_solve(const int modes, double *D, const int columns, double *R)
{
    for (int j = 0; j < modes; j++)
        for (int i = j; i < modes; i++) {
            double sum = D[i * modes + j];
            for (int k = 0; k < j; k++)
                sum -= D[i * modes + k] * D[j * modes + k];
            if (i == j && !(sum > 0))
                return false;
            D[i * modes + j] = i == j ? sqrt(sum) : sum / D[j * modes + j];
        }
    for (int c = 0; c < columns; c++) {
        for (int i = 0; i < modes; i++) {
            for (int k = 0; k < i; k++)
                R[i * columns + c] -= D[i * modes + k] * R[k * columns + c];
            R[i * columns + c] /= D[i * modes + i];
        }
        for (int i = modes - 1; i >= 0; i--) {
            for (int k = i + 1; k < modes; k++)
                R[i * columns + c] -= D[k * modes + i] * R[k * columns + c];
            R[i * columns + c] /= D[i * modes + i];
        }
    }
    return true;
}

ALWAYS_INLINE int eas_prepare(const int dim, const int nodes, const enum element_type type, const int points,
                              const double (*X)[3], const struct constitutive *material, double *data)
{
    const int n = voigt_size(dim), modes = eas_modes(dim);
    const struct quadrature rule = quadrature_of(type, QUADRATURE_STIFFNESS);
    const double centre[3] = {0, 0, 0}, rest[VOIGT_MAX] = {0};
    double dN[ELEMENT_MAX_NODES][3], J0[9], inverse0[9], S[VOIGT_MAX], C[VOIGT_MAX * VOIGT_MAX];
    double D[EAS_MAX_MODES * EAS_MAX_MODES] = {0};
    CALL(prepare_points(dim, nodes, type, X, data));
    const double det0 = jacobian(dim, nodes, type, X, centre, dN, J0);
    invert(dim, J0, det0, inverse0);
    material->law->stress(material->parameters, dim, rest, S, C);
    for (int p = 0; p < points; p++) {
        const double w = data[p * point_stride(dim, nodes)];
        double *M = data + points * point_stride(dim, nodes) + p * eas_stride(dim), *A = M + n * modes;
        eas_operator(dim, inverse0, det0 * rule.weight[p] / w, rule.xi[p], M);
        for (int m = 0; m < modes; m++)
            for (int k = 0; k < n; k++) {
                A[m * n + k] = 0;
                for (int l = 0; l < n; l++)
                    A[m * n + k] -= w * M[l * modes + m] * C[l * n + k];
            }
        for (int m = 0; m < modes; m++)
            for (int o = 0; o < modes; o++)
                for (int k = 0; k < n; k++)
                    D[m * modes + o] -= A[m * n + k] * M[k * modes + o];
    }
    for (int p = 0; p < points; p++) {
        double copy[EAS_MAX_MODES * EAS_MAX_MODES];
        memcpy(copy, D, sizeof copy);
        if (!eas_solve(modes, copy, n,
                       data + points * point_stride(dim, nodes) + p * eas_stride(dim) + n * modes))
            return STATUS_DECK;
    }
    return 0;
}

/** E += M alpha at all points. */
ALWAYS_INLINE void eas_enhance(const int dim, const int nodes, const int points, const double *data,
                               const double *alpha, double (*E)[VOIGT_MAX])
{
    const int n = voigt_size(dim), modes = eas_modes(dim);
    const double *enhanced = data + points * point_stride(dim, nodes);
    for (int p = 0; p < points; p++)
        for (int k = 0; k < n; k++)
            for (int m = 0; m < modes; m++)
                E[p][k] += enhanced[p * eas_stride(dim) + k * modes + m] * alpha[m];
}

/** Energy at strains @p E, its gradient @p g and second derivative @p H by alpha; from the tangent at rest if
 * @p at_rest. NaN where the law has no value. */
ALWAYS_INLINE double eas_balance(const int dim, const int nodes, const int points, const double *data,
                                 const struct constitutive *material, const double (*E)[VOIGT_MAX],
                                 const bool at_rest, double *g, double *H)
{
    const int n = voigt_size(dim), modes = eas_modes(dim);
    const double *enhanced = data + points * point_stride(dim, nodes), rest[VOIGT_MAX] = {0};
    double energy = 0;
    for (int m = 0; m < modes; m++)
        g[m] = 0;
    for (int m = 0; m < modes * modes; m++)
        H[m] = 0;
    for (int p = 0; p < points; p++) {
        const double w = data[p * point_stride(dim, nodes)], *M = enhanced + p * eas_stride(dim);
        double S[VOIGT_MAX], D[VOIGT_MAX * VOIGT_MAX], DM[VOIGT_MAX * EAS_MAX_MODES];
        energy += w * material->law->stress(material->parameters, dim, E[p], S, D);
        if (isnan(energy))
            return energy;
        for (int m = 0; m < modes; m++)
            for (int k = 0; k < n; k++)
                g[m] += w * M[k * modes + m] * S[k];
        if (at_rest)
            material->law->stress(material->parameters, dim, rest, S, D);
        for (int k = 0; k < n; k++)
            for (int m = 0; m < modes; m++) {
                DM[k * modes + m] = 0;
                for (int l = 0; l < n; l++)
                    DM[k * modes + m] += w * D[k * n + l] * M[l * modes + m];
            }
        for (int m = 0; m < modes; m++)
            for (int k = 0; k < n; k++)
                for (int o = 0; o < modes; o++)
                    H[m * modes + o] += M[k * modes + m] * DM[k * modes + o];
    }
    return energy;
}

/** The strains @p dE of Newton's step for alpha; where the energy is not convex, of a step down with the
 * stiffness at rest. Returns the largest of them and whether the step is Newton's. */
ALWAYS_INLINE double eas_newton_step(const int dim, const int nodes, const int points, const double *data,
                                     const struct constitutive *material, const double (*E)[VOIGT_MAX],
                                     double *g, double *H, double (*dE)[VOIGT_MAX], bool *convex)
{
    const int modes = eas_modes(dim);
    double length = 0, step[EAS_MAX_MODES];
    for (int m = 0; m < modes; m++)
        step[m] = -g[m];
    *convex = eas_solve(modes, H, 1, step);
    if (!*convex) {
        eas_balance(dim, nodes, points, data, material, E, true, g, H);
        for (int m = 0; m < modes; m++)
            step[m] = -g[m];
        eas_solve(modes, H, 1, step); /* positive: prepare has solved with it */
    }
    memset(dE, 0, EAS_MAX_POINTS * sizeof *dE);
    eas_enhance(dim, nodes, points, data, step, dE);
    for (int p = 0; p < points; p++)
        for (int k = 0; k < voigt_size(dim); k++)
            length = fmax(length, fabs(dE[p][k]));
    return length;
}

/** Strains at the minimum of the energy, from the guess @p E; @p E_u: without enhancement. The step after one
 * shorter than 1e-9 would be of the order of its square: none is needed. STATUS_NUMERICAL (not reported) when
 * there is no minimum. */
ALWAYS_INLINE int eas_minimise(const int dim, const int nodes, const int points, const double *data,
                               const struct constitutive *material, const double (*E_u)[VOIGT_MAX],
                               double (*E)[VOIGT_MAX])
{
    double g[EAS_MAX_MODES], H[EAS_MAX_MODES * EAS_MAX_MODES], dE[EAS_MAX_POINTS][VOIGT_MAX];
    double trial[EAS_MAX_POINTS][VOIGT_MAX];
    double energy =
        eas_balance(dim, nodes, points, data, material, (const double(*)[VOIGT_MAX])E, false, g, H);
    if (isnan(energy)) { /* the guess went too far */
        memcpy(E, E_u, (size_t)points * sizeof *E);
        energy = eas_balance(dim, nodes, points, data, material, E_u, false, g, H);
    }
    for (int iteration = 0; iteration < EAS_ITERATIONS && !isnan(energy); iteration++) {
        bool convex, better = false;
        const double length = eas_newton_step(dim, nodes, points, data, material,
                                              (const double(*)[VOIGT_MAX])E, g, H, dE, &convex);
        const bool last = convex && length < 1e-9;
        for (double scale = 1; !better && scale > 1e-6; scale *= 0.5) {
            for (int p = 0; p < points; p++)
                for (int k = 0; k < voigt_size(dim); k++)
                    trial[p][k] = E[p][k] + scale * dE[p][k];
            if (last)
                break;
            const double value = eas_balance(dim, nodes, points, data, material,
                                             (const double(*)[VOIGT_MAX])trial, false, g, H);
            /* the energy of short steps differs by less than its rounding */
            better = value <= energy || (convex && length < 1e-5 && !isnan(value));
            energy = better ? value : energy;
        }
        if (!last && !better)
            return STATUS_NUMERICAL;
        memcpy(E, trial, (size_t)points * sizeof *E);
        if (last)
            return 0;
    }
    return STATUS_NUMERICAL;
}

/** First pass over the points: F and the enhanced strains. */
ALWAYS_INLINE int eas_strains(const int dim, const int nodes, const int points, const double *data,
                              const struct constitutive *material, const double *d, double (*F)[9],
                              double (*E)[VOIGT_MAX])
{
    const int n = voigt_size(dim), modes = eas_modes(dim);
    const double *enhanced = data + points * point_stride(dim, nodes);
    double alpha[EAS_MAX_MODES], E_u[EAS_MAX_POINTS][VOIGT_MAX];
    for (int m = 0; m < modes; m++)
        alpha[m] = 0;
    for (int p = 0; p < points; p++) {
        const double *A = enhanced + p * eas_stride(dim) + n * modes;
        if (!(deformation_gradient(dim, nodes, data + p * point_stride(dim, nodes) + 1, d, F[p]) > 0))
            return STATUS_NUMERICAL;
        green_lagrange(dim, F[p], E[p]);
        for (int m = 0; m < modes; m++)
            for (int k = 0; k < n; k++)
                alpha[m] += A[m * n + k] * E[p][k];
    }
    memcpy(E_u, E, (size_t)points * sizeof *E);
    eas_enhance(dim, nodes, points, data, alpha, E);
    if (material->law->linear)
        return 0;
    return eas_minimise(dim, nodes, points, data, material, (const double(*)[VOIGT_MAX])E_u, E);
}

/** A = -H^-1 w M^T D (modes x voigt) at all points, with H for the strains @p E. STATUS_NUMERICAL when H is
 * not positive. */
ALWAYS_INLINE int eas_condense(const int dim, const int nodes, const int points, const double *data,
                               const struct constitutive *material, const double (*E)[VOIGT_MAX],
                               double (*A)[EAS_MAX_MODES * VOIGT_MAX])
{
    const int n = voigt_size(dim), modes = eas_modes(dim);
    double g[EAS_MAX_MODES], H[EAS_MAX_MODES * EAS_MAX_MODES];
    eas_balance(dim, nodes, points, data, material, E, false, g, H);
    for (int p = 0; p < points; p++) {
        const double w = data[p * point_stride(dim, nodes)];
        const double *M = data + points * point_stride(dim, nodes) + p * eas_stride(dim);
        double S[VOIGT_MAX], D[VOIGT_MAX * VOIGT_MAX], copy[EAS_MAX_MODES * EAS_MAX_MODES];
        material->law->stress(material->parameters, dim, E[p], S, D);
        for (int m = 0; m < modes; m++)
            for (int k = 0; k < n; k++) {
                A[p][m * n + k] = 0;
                for (int l = 0; l < n; l++)
                    A[p][m * n + k] -= w * M[l * modes + m] * D[l * n + k];
            }
        memcpy(copy, H, sizeof copy);
        if (!eas_solve(modes, copy, n, A[p]))
            return STATUS_NUMERICAL;
    }
    return 0;
}

/** K from the points' B: with R = dalpha/dd = sum of A B, K = sum of w B^T C (B + M R) and the geometric
 * part. */
ALWAYS_INLINE int eas_stiffness(const int dim, const int nodes, const int points, const double *data,
                                const struct constitutive *material, double (*F)[9], double (*E)[VOIGT_MAX],
                                double *K)
{
    const int n = voigt_size(dim), modes = eas_modes(dim), dof = nodes * dim;
    const double *enhanced = data + points * point_stride(dim, nodes);
    double B[EAS_MAX_POINTS][VOIGT_MAX * EAS_MAX_DOF], R[EAS_MAX_MODES * EAS_MAX_DOF] = {0};
    double condensed[EAS_MAX_POINTS][EAS_MAX_MODES * VOIGT_MAX];
    if (!material->law->linear)
        CALL(eas_condense(dim, nodes, points, data, material, (const double(*)[VOIGT_MAX])E, condensed));
    memset(K, 0, (size_t)(dof * dof) * sizeof *K);
    for (int p = 0; p < points; p++) {
        const double *A = material->law->linear ? enhanced + p * eas_stride(dim) + n * modes : condensed[p];
        strain_operator(dim, nodes, F[p], data + p * point_stride(dim, nodes) + 1, B[p]);
        for (int m = 0; m < modes; m++)
            for (int k = 0; k < n; k++)
                for (int q = 0; q < dof; q++)
                    R[m * dof + q] += A[m * n + k] * B[p][k * dof + q];
    }
    for (int p = 0; p < points; p++) {
        const double w = data[p * point_stride(dim, nodes)], *M = enhanced + p * eas_stride(dim);
        double S[VOIGT_MAX], D[VOIGT_MAX * VOIGT_MAX], total[VOIGT_MAX * EAS_MAX_DOF];
        material->law->stress(material->parameters, dim, E[p], S, D);
        memcpy(total, B[p], sizeof total);
        for (int k = 0; k < n; k++)
            for (int m = 0; m < modes; m++)
                for (int q = 0; q < dof; q++)
                    total[k * dof + q] += M[k * modes + m] * R[m * dof + q];
        add_material_stiffness(dim, nodes, w, B[p], D, total, K);
        add_geometric_stiffness(dim, nodes, w, S, data + p * point_stride(dim, nodes) + 1, K);
    }
    return 0;
}

ALWAYS_INLINE int eas_forces(const int dim, const int nodes, const int points, const double *data,
                             const struct constitutive *material, const double *d, double *f, double *K)
{
    double F[EAS_MAX_POINTS][9], E[EAS_MAX_POINTS][VOIGT_MAX];
    CALL(eas_strains(dim, nodes, points, data, material, d, F, E));
    memset(f, 0, (size_t)(nodes * dim) * sizeof *f);
    for (int p = 0; p < points; p++) {
        double S[VOIGT_MAX];
        material->law->stress(material->parameters, dim, E[p], S, NULL);
        add_force(dim, nodes, data[p * point_stride(dim, nodes)], F[p], S,
                  data + p * point_stride(dim, nodes) + 1, f);
    }
    return K ? eas_stiffness(dim, nodes, points, data, material, F, E, K) : 0;
}

ALWAYS_INLINE double eas_energy(const int dim, const int nodes, const int points, const double *data,
                                const struct constitutive *material, const double *d, double *stress,
                                double *volume)
{
    double F[EAS_MAX_POINTS][9], E[EAS_MAX_POINTS][VOIGT_MAX], energy = 0, total = 0;
    if (stress)
        memset(stress, 0, 6 * sizeof *stress);
    if (eas_strains(dim, nodes, points, data, material, d, F, E))
        return NAN;
    for (int p = 0; p < points; p++) {
        const double w = data[p * point_stride(dim, nodes)];
        double S[VOIGT_MAX];
        energy += w * material->law->stress(material->parameters, dim, E[p], S, NULL);
        total += w;
        if (stress)
            add_cauchy(dim, w, F[p], S, stress);
    }
    finish_average(total, stress, volume);
    return energy;
}

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
/* Compressible neo-Hookean (paper 002 eq. 12): W = mu tr E - mu ln J + lambda/2 ln^2 J with J = det F; plane
 * strain in 2-D. With C = I + 2 E: S = mu (I - C^-1) + lambda ln J C^-1. Written in E and C - I, so that
 * small strains lose no digits: I - C^-1 = 2 C^-1 E, ln J = log1p(det C - 1)/2. */
#include "solid/constitutive/constitutive.h"

#include <math.h>
#include <string.h>

enum { LAMBDA = CONSTITUTIVE_LAMBDA, MU = CONSTITUTIVE_MU };

/** Row and column of a component in three dimensions, XX YY ZZ XY YZ XZ. */
static const int rows[6] = {0, 1, 2, 0, 1, 0}, columns[6] = {0, 1, 2, 1, 2, 2};

/** det C - 1 by the invariants of A = C - I. */
static double excess_of_determinant(double A[3][3])
{
    const double minors = A[0][0] * A[1][1] - A[0][1] * A[1][0] + A[1][1] * A[2][2] - A[1][2] * A[2][1] +
                          A[2][2] * A[0][0] - A[2][0] * A[0][2];
    const double det = A[0][0] * (A[1][1] * A[2][2] - A[1][2] * A[2][1]) -
                       A[0][1] * (A[1][0] * A[2][2] - A[1][2] * A[2][0]) +
                       A[0][2] * (A[1][0] * A[2][1] - A[1][1] * A[2][0]);
    return A[0][0] + A[1][1] + A[2][2] + minors + det;
}

/** Whether C = I + A is positive definite (leading minors); the determinant is known. */
static bool is_positive(double A[3][3], double det)
{
    return 1 + A[0][0] > 0 && (1 + A[0][0]) * (1 + A[1][1]) - A[0][1] * A[0][1] > 0 && det > 0;
}

/** Inverse of C = I + A. */
static void invert(double A[3][3], double det, double inverse[3][3])
{
    double C[3][3];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            C[i][j] = A[i][j] + (i == j);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int p = (j + 1) % 3, q = (j + 2) % 3, r = (i + 1) % 3, s = (i + 2) % 3;
            inverse[i][j] = (C[p][r] * C[q][s] - C[p][s] * C[q][r]) / det;
        }
}

/** dS/dE = lambda C^-1 (x) C^-1 + 2 (mu - lambda ln J) d(-C^-1)/dC. */
static void tangent(int dim, double lambda, double shear, double inverse[3][3], double *D)
{
    const int n = dim == 2 ? 3 : 6;
    for (int k = 0; k < n; k++)
        for (int l = 0; l < n; l++) {
            const int a = dim == 2 && k == 2 ? 3 : k, b = dim == 2 && l == 2 ? 3 : l;
            const int I = rows[a], J = columns[a], K = rows[b], L = columns[b];
            D[k * n + l] = lambda * inverse[I][J] * inverse[K][L] +
                           shear * (inverse[I][K] * inverse[J][L] + inverse[I][L] * inverse[J][K]);
        }
}

static double stress(const double *parameters, int dim, const double *E, double *S, double *D)
{
    const double lambda = parameters[LAMBDA], mu = parameters[MU];
    const int n = dim == 2 ? 3 : 6;
    double A[3][3] = {{0}}, inverse[3][3];
    for (int k = 0; k < n; k++) {
        const int a = dim == 2 && k == 2 ? 3 : k;
        A[rows[a]][columns[a]] = A[columns[a]][rows[a]] = k < dim ? 2 * E[k] : E[k];
    }
    const double excess = excess_of_determinant(A), log_J = 0.5 * log1p(excess);
    if (!is_positive(A, 1 + excess)) {
        memset(S, 0, VOIGT_MAX * sizeof *S);
        return NAN;
    }
    invert(A, 1 + excess, inverse);
    for (int k = 0; k < n; k++) {
        const int a = dim == 2 && k == 2 ? 3 : k;
        S[k] = lambda * log_J * inverse[rows[a]][columns[a]];
        for (int j = 0; j < 3; j++)
            S[k] += mu * inverse[rows[a]][j] * A[j][columns[a]];
    }
    if (dim == 2)
        S[3] = lambda * log_J;
    if (D)
        tangent(dim, lambda, mu - lambda * log_J, inverse, D);
    return mu * (0.5 * (A[0][0] + A[1][1] + A[2][2]) - log_J) + 0.5 * lambda * log_J * log_J;
}

const struct constitutive_law neo_hookean_law = {
    .name = "neo-hookean",
    .check = constitutive_check_elastic,
    .prepare = constitutive_lame,
    .stress = stress,
};

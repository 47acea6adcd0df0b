// SPDX-License-Identifier: GPL-3.0-or-later
/* Saint Venant-Kirchhoff: Psi = lambda/2 (tr E)^2 + mu E:E, S = lambda tr E I + 2 mu E; plane strain in 2-D.
 */
#include "solid/constitutive/constitutive.h"

enum { LAMBDA = CONSTITUTIVE_LAMBDA, MU = CONSTITUTIVE_MU };

static double stress(const double *parameters, int dim, const double *E, double *S, double *D)
{
    const double lambda = parameters[LAMBDA], mu = parameters[MU];
    const int n = dim == 2 ? 3 : 6;
    double trace = 0, energy = 0;
    for (int i = 0; i < dim; i++)
        trace += E[i];
    for (int i = 0; i < n; i++) {
        S[i] = i < dim ? lambda * trace + 2 * mu * E[i] : mu * E[i];
        energy += 0.5 * S[i] * E[i];
    }
    if (dim == 2)
        S[3] = lambda * trace;
    if (!D)
        return energy;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            D[i * n + j] = (i < dim && j < dim ? lambda : 0) + (i != j ? 0 : i < dim ? 2 * mu : mu);
    return energy;
}

const struct constitutive_law saint_venant_kirchhoff_law = {
    .name = "saint-venant-kirchhoff",
    .linear = true,
    .check = constitutive_check_elastic,
    .prepare = constitutive_lame,
    .stress = stress,
};

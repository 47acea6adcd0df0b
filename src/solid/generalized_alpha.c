// SPDX-License-Identifier: GPL-3.0-or-later
#include "solid/generalized_alpha.h"

struct generalized_alpha generalized_alpha_of(double rho_infinity)
{
    const double alpha_m = (2 * rho_infinity - 1) / (rho_infinity + 1);
    const double alpha_f = rho_infinity / (rho_infinity + 1);
    const double beta_root = 1 - alpha_m + alpha_f;
    return (struct generalized_alpha){.alpha_m = alpha_m,
                                      .alpha_f = alpha_f,
                                      .beta = 0.25 * beta_root * beta_root,
                                      .gamma = 0.5 - alpha_m + alpha_f};
}

void generalized_alpha_newmark(const struct generalized_alpha *method, double dt, size_t n, const double *d0,
                               const double *v0, const double *a0, const double *a, double *d, double *v)
{
    for (size_t i = 0; i < n; i++) {
        d[i] = d0[i] + dt * v0[i] + dt * dt * ((0.5 - method->beta) * a0[i] + method->beta * a[i]);
        v[i] = v0[i] + dt * ((1 - method->gamma) * a0[i] + method->gamma * a[i]);
    }
}

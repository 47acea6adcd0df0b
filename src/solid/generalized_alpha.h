// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef SOLID_GENERALIZED_ALPHA_H
#define SOLID_GENERALIZED_ALPHA_H

#include <stddef.h>

/** The generalised-alpha method (Chung and Hulbert 1993): M ((1 - alpha_m) a_{n+1} + alpha_m a_n) + (1 -
 * alpha_f) f_int(d_{n+1})
 * + alpha_f f_int(d_n) = (1 - alpha_f) f_{n+1} + alpha_f f_n, with Newmark's displacement and velocity.
 * Second order, unconditionally stable for linear problems, largest damping of high frequencies for given
 * damping of low ones. */
struct generalized_alpha {
    double alpha_m, alpha_f, beta, gamma;
};

/** Coefficients for the spectral radius @p rho_infinity at infinite frequency (0: most damping, 1: none). */
struct generalized_alpha generalized_alpha_of(double rho_infinity);

/** Newmark: @p d and @p v of @p n numbers at the end of the step from the state (d0, v0, a0) and the new
 * acceleration @p a. */
void generalized_alpha_newmark(const struct generalized_alpha *method, double dt, size_t n, const double *d0,
                               const double *v0, const double *a0, const double *a, double *d, double *v);

#endif

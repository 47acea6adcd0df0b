// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef MATH_GMRES_H
#define MATH_GMRES_H

#include <stddef.h>

/** Right-preconditioned GMRES without restart in its flexible form (Saad 1993): the preconditioned directions
 * are kept, so that the answer costs no further application of the preconditioner, and the residual is that
 * of A x = b itself. */
struct gmres;

/** z := P^-1 v (P approximates A), w := A z. Returns a status. With P = J and A = J + M one has w = v + M z.
 */
typedef int (*gmres_apply)(void *context, const double *v, double *z, double *w);

/** Workspace for @p n unknowns and at most @p iterations directions. Free with gmres_destroy. */
int gmres_create(struct gmres **gmres, size_t n, int iterations);
void gmres_destroy(struct gmres *gmres);

/** Solve A x = b from x = 0 until |b - A x| <= @p tolerance |b| or the workspace's iterations are used up
 * (then the best answer so far is given). @p iterations (or NULL) and @p residual (relative, or NULL) tell
 * how it went. Returns 0, the status of @p apply, or STATUS_NUMERICAL (reported) when a direction is not
 * finite. */
int gmres_solve(struct gmres *gmres, gmres_apply apply, void *context, const double *b, double *x,
                double tolerance, int *iterations, double *residual);

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef MATH_SPARSE_H
#define MATH_SPARSE_H

#include <stdbool.h>
#include <stddef.h>

/** Direct solution of symmetric sparse systems with one pattern and changing values: CHOLMOD's Cholesky
 * factorisation (LL^T, symbolic analysis kept); UMFPACK's LU takes over while a matrix is not positive
 * definite. BLAS runs on one thread, so that results do not depend on the number of threads. Factor and solve
 * allocate through SuiteSparse only when sizes change, which a fixed pattern does not. */
struct sparse_solver;

/** Analyse the pattern of an @p n x @p n matrix given by its upper triangle in compressed columns: @p columns
 * has n + 1 offsets into @p rows, row numbers ascend within a column and end at the diagonal, which must be
 * there. The pattern is copied. Returns 0, STATUS_MEMORY or STATUS_NUMERICAL (reported). Free with
 * sparse_solver_destroy. */
int sparse_solver_create(struct sparse_solver **solver, size_t n, const long *columns, const long *rows);
void sparse_solver_destroy(struct sparse_solver *solver);

/** Factor the matrix with @p values in the order of the pattern. STATUS_NUMERICAL (reported) if it is
 * singular to rounding or holds NaN. */
int sparse_solver_factor(struct sparse_solver *solver, const double *values);

/** Solve with the newest factor; @p b and @p x (n entries) may be the same. */
int sparse_solver_solve(struct sparse_solver *solver, const double *b, double *x);

/** Whether the newest factor is Cholesky's (false: the matrix was not positive definite, LU took over). */
bool sparse_solver_is_positive(const struct sparse_solver *solver);

#endif

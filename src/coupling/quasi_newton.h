// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef COUPLING_QUASI_NEWTON_H
#define COUPLING_QUASI_NEWTON_H

#include "base/field.h"

#include <stdint.h>

/** Interface quasi-Newton method with inverse least squares (IQN-ILS: Degroote, Bathe and Vierendeels 2009)
 * for a fixed point x = S(x) of @c n unknowns: from the changes of the residual r = S(x) - x and of the
 * answer S(x) between iterations, those of the last steps too, comes the combination that takes the residual
 * away as far as they can. The coefficients are found for the displacement and applied to displacement,
 * velocity and acceleration alike, so an answer is these three, one after the other (3 n numbers). */
struct quasi_newton {
    size_t n, capacity;
    int reused_steps; /**< whose columns are kept */
    double filter;    /**< a column is dropped when less than this part of it is new */
    double first;     /**< relaxation factor as long as there is no column */
    size_t n_columns; /**< oldest first */
    int64_t *ages;    /**< per column: steps since it was made */
    double *residual_changes, *answer_changes;
    double *residual, *answer; /**< of the iteration before */
    double *basis, *triangle;  /**< workspace: Q, column by column, and R, row by row */
    double *coefficients;
    size_t *chosen; /**< workspace: the column behind each of the basis */
    int iteration;  /**< since quasi_newton_restart */
    struct field_group state;
    struct field state_fields[3];
};

/** For @p n unknowns. Returns 0 or STATUS_MEMORY (reported). Free with quasi_newton_destroy. */
int quasi_newton_create(struct quasi_newton **quasi_newton, size_t n, double first, int reused_steps,
                        double filter);
void quasi_newton_destroy(struct quasi_newton *quasi_newton);

/** Start the iterations of a step: columns that are too old go. */
void quasi_newton_restart(struct quasi_newton *quasi_newton);

/** The next iterate (3 n numbers), which comes in as the last one, from its residual (n) and answer (3 n). */
void quasi_newton_next(struct quasi_newton *quasi_newton, const double *residual, const double *answer,
                       double *iterate);

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef COUPLING_RELAXATION_H
#define COUPLING_RELAXATION_H

#include <stddef.h>

enum relaxation_kind { RELAXATION_NONE, RELAXATION_CONSTANT, RELAXATION_AITKEN };

/** Relaxation of a fixed-point iteration on plain vectors (Kuettler and Wall 2008). The factor found from the
 * displacement residual is applied to displacement, velocity and acceleration alike: their weights sum to
 * one, so that iterates stay consistent with the time integration. */
struct relaxation {
    enum relaxation_kind kind;
    double first;  /**< factor of the first iteration (Aitken) or of all (constant) */
    double factor; /**< of the last iteration */
    size_t n;
    double *previous; /**< last residual */
    int iteration;    /**< since relaxation_restart */
};

/** For vectors of @p n entries; @p name: "none", "constant", "aitken". */
int relaxation_create(struct relaxation **relaxation, enum relaxation_kind kind, double first, size_t n);
void relaxation_destroy(struct relaxation *relaxation);

/** Start the iterations of a step. */
void relaxation_restart(struct relaxation *relaxation);

/** Factor for the iteration with residual @p residual (n entries): iterate += factor * residual. */
double relaxation_factor(struct relaxation *relaxation, const double *residual);

#endif

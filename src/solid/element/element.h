// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef SOLID_ELEMENT_ELEMENT_H
#define SOLID_ELEMENT_ELEMENT_H

#include "model/model.h"
#include "solid/constitutive/constitutive.h"

#include <stddef.h>

/** Largest number of degrees of freedom of an element. */
enum { ELEMENT_MAX_DOF = 3 * ELEMENT_MAX_NODES };

/** What an element does, for one type and formulation; history-free. Total Lagrangian: everything that
 * depends on the reference places only is computed once into @c data. Displacements, forces: nodes x dim
 * numbers, node by node. 2-D: plane strain, per metre of depth. All functions are thread-safe. */
struct element_kernel {
    enum element_type type;
    enum solid_formulation formulation;
    int n_points;     /**< quadrature points */
    size_t data_size; /**< doubles of precomputed data per element */
    /** Precompute from the reference places @p X (nodes rows of 3). STATUS_DECK (not reported) when the
     * Jacobian is not positive at a quadrature point. */
    int (*prepare)(const double (*X)[3], const struct constitutive *material, double *data);
    /** Internal force @p f and, unless NULL, its derivative @p K by @p d (row by row; symmetric) at
     * displacement @p d. STATUS_NUMERICAL (not reported) when det F <= 0 at a point: the element is inverted;
     * or when the law has no stable state of the enhanced strains. */
    int (*forces)(const double *data, const struct constitutive *material, const double *d, double *f,
                  double *K);
    /** Elastic energy (J; 2-D: J/m); Cauchy stress XX YY ZZ XY YZ XZ averaged over the points into @p stress
     * and the element's reference volume into @p volume, unless NULL. */
    double (*energy)(const double *data, const struct constitutive *material, const double *d,
                     double stress[6], double *volume);
};

/** The kernel for a type and formulation, or NULL with the reason in *@p reason. */
const struct element_kernel *element_kernel_find(enum element_type type, enum solid_formulation formulation,
                                                 const char **reason);

/** Name of a formulation as in the deck ("full", "f-bar", "eas"). */
const char *element_formulation_name(enum solid_formulation formulation);

#endif

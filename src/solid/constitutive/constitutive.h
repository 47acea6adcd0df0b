// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef SOLID_CONSTITUTIVE_CONSTITUTIVE_H
#define SOLID_CONSTITUTIVE_CONSTITUTIVE_H

#include "model/model.h"

/** Strains and stresses are written as vectors: XX YY XY in plane strain, XX YY ZZ XY YZ XZ in three
 * dimensions; the shear components of a strain are doubled, so that the product of both is the work. */
enum { VOIGT_MAX = 6, CONSTITUTIVE_PARAMETERS = 4 };

/** Where constitutive_lame writes Lame's parameters. */
enum { CONSTITUTIVE_LAMBDA, CONSTITUTIVE_MU };

/** A hyperelastic law: stress from the Green-Lagrange strain E = (F^T F - I)/2. */
struct constitutive_law {
    const char *name;
    bool linear; /**< S = D E with constant D: enhanced strains are eliminated in closed form */
    /** Say why the material cannot be used with this law (NULL: it can). */
    const char *(*check)(const struct solid_material *material);
    void (*prepare)(const struct solid_material *material, double *parameters);
    /** Energy density (J/m^3) at strain @p E; second Piola-Kirchhoff stress into @p S (plane strain: S[3] is
     * S_ZZ) and, unless NULL, the tangent dS/dE into @p D (row by row, 3 x 3 or 6 x 6). NaN where the law has
     * no value because I + 2 E is not positive (an enhanced strain has gone too far). */
    double (*stress)(const double *parameters, int dim, const double *E, double *S, double *D);
};

/** A law with the parameters of one material. */
struct constitutive {
    const struct constitutive_law *law;
    double parameters[CONSTITUTIVE_PARAMETERS];
};

/** Why Young's modulus and Poisson's ratio of @p material do not make an elastic material, or NULL. */
const char *constitutive_check_elastic(const struct solid_material *material);

/** Lame's parameters of @p material. */
void constitutive_lame(const struct solid_material *material, double *parameters);

/** The law called @p name, or NULL. */
const struct constitutive_law *constitutive_find(const char *name);

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef SOLID_CONSTITUTIVE_CONSTITUTIVE_H
#define SOLID_CONSTITUTIVE_CONSTITUTIVE_H

#include "model/model.h"

/** Strains and stresses are written as vectors: XX YY XY in plane strain, XX YY ZZ XY YZ XZ in three
 * dimensions; the shear components of a strain are doubled, so that the product of both is the work. */
enum { VOIGT_MAX = 6, CONSTITUTIVE_PARAMETERS = 4 };

/** A hyperelastic law: stress from the Green-Lagrange strain E = (F^T F - I)/2. */
struct constitutive_law {
    const char *name;
    bool linear; /**< S = D E with constant D (needed where enhanced strains are eliminated in closed form) */
    /** Say why the material cannot be used with this law (NULL: it can). */
    const char *(*check)(const struct solid_material *material);
    void (*prepare)(const struct solid_material *material, double *parameters);
    /** Energy density (J/m^3) at strain @p E; second Piola-Kirchhoff stress into @p S (plane strain: S[3] is
     * S_ZZ) and, unless NULL, the tangent dS/dE into @p D (row by row, 3 x 3 or 6 x 6). */
    double (*stress)(const double *parameters, int dim, const double *E, double *S, double *D);
};

/** A law with the parameters of one material. */
struct constitutive {
    const struct constitutive_law *law;
    double parameters[CONSTITUTIVE_PARAMETERS];
};

/** The law called @p name, or NULL. */
const struct constitutive_law *constitutive_find(const char *name);

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef SOLID_ELEMENT_QUADRATURE_H
#define SOLID_ELEMENT_QUADRATURE_H

#include "model/mesh.h"

enum { QUADRATURE_MAX = 27 };

/** A rule in natural coordinates: integral of f = sum of weight f(xi). */
struct quadrature {
    int n;
    double xi[QUADRATURE_MAX][3];
    double weight[QUADRATURE_MAX];
};

/** What a rule has to integrate exactly on undistorted elements. */
enum quadrature_use {
    /** full integration of products of gradients: 2^dim Gauss points, quadratic elements 3^dim; simplices 1,
     * quadratic ones dim + 1 */
    QUADRATURE_STIFFNESS,
    QUADRATURE_MASS /**< products of shape functions */
};

/** The rule for a continuum element type (dimension 2 or 3). */
struct quadrature quadrature_of(enum element_type type, enum quadrature_use use);

#endif

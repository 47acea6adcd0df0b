// SPDX-License-Identifier: GPL-3.0-or-later
#include "solid/element/quadrature.h"

#include <math.h>

static void gauss_product(int dim, struct quadrature *rule)
{
    const double at = 1 / sqrt(3.0);
    rule->n = 1 << dim;
    for (int p = 0; p < rule->n; p++) {
        for (int d = 0; d < dim; d++)
            rule->xi[p][d] = p >> d & 1 ? at : -at;
        rule->weight[p] = 1;
    }
}

/** Degree 1: the centroid; degree 2: one point towards each corner (Hammer and Stroud 1956). */
static void simplex(int dim, enum quadrature_use use, struct quadrature *rule)
{
    const double volume = dim == 2 ? 1.0 / 2 : 1.0 / 6;
    const double near = dim == 2 ? 2.0 / 3 : (5 + 3 * sqrt(5.0)) / 20;
    const double far = (1 - near) / dim;
    rule->n = use == QUADRATURE_MASS ? dim + 1 : 1;
    for (int p = 0; p < rule->n; p++) {
        for (int d = 0; d < dim; d++)
            rule->xi[p][d] = rule->n == 1 ? 1.0 / (dim + 1) : p == d + 1 ? near : far;
        rule->weight[p] = volume / rule->n;
    }
}

struct quadrature quadrature_of(enum element_type type, enum quadrature_use use)
{
    struct quadrature rule = {0};
    const int dim = element_dim(type);
    if (type == ELEMENT_TRI3 || type == ELEMENT_TET4)
        simplex(dim, use, &rule);
    else
        gauss_product(dim, &rule);
    return rule;
}

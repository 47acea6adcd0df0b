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

/** Three points a direction: degree 5. */
static void gauss_product_3(int dim, struct quadrature *rule)
{
    const double at[3] = {-sqrt(0.6), 0, sqrt(0.6)}, weight[3] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
    rule->n = dim == 2 ? 9 : 27;
    for (int p = 0; p < rule->n; p++) {
        rule->weight[p] = 1;
        for (int d = 0, rest = p; d < dim; d++, rest /= 3) {
            rule->xi[p][d] = at[rest % 3];
            rule->weight[p] *= weight[rest % 3];
        }
    }
}

/** Degree 1: the centroid. */
static void simplex_centre(int dim, struct quadrature *rule)
{
    rule->n = 1;
    for (int d = 0; d < dim; d++)
        rule->xi[0][d] = 1.0 / (dim + 1);
    rule->weight[0] = dim == 2 ? 1.0 / 2 : 1.0 / 6;
}

/** Append the points with barycentric coordinate @p near towards each corner and equal ones otherwise. */
static void add_towards_corners(int dim, double near, double weight, struct quadrature *rule)
{
    const double far = (1 - near) / dim;
    for (int p = 0; p <= dim; p++) {
        for (int d = 0; d < dim; d++)
            rule->xi[rule->n][d] = p == d + 1 ? near : far;
        rule->weight[rule->n++] = weight;
    }
}

/** Degree 2: one point towards each corner (Hammer and Stroud 1956). */
static void simplex_2(int dim, struct quadrature *rule)
{
    if (dim == 2)
        add_towards_corners(2, 2.0 / 3, 1.0 / 6, rule);
    else
        add_towards_corners(3, (5 + 3 * sqrt(5.0)) / 20, 1.0 / 24, rule);
}

/** Degree 4 with 6 points (Cowper 1973, in closed form). */
static void triangle_4(struct quadrature *rule)
{
    const double root = sqrt(38 - 44 * sqrt(0.4)), spread = sqrt(213125 - 53320 * sqrt(10.0));
    const double far[2] = {(8 - sqrt(10.0) + root) / 18, (8 - sqrt(10.0) - root) / 18};
    add_towards_corners(2, 1 - 2 * far[0], (620 + spread) / 7440, rule);
    add_towards_corners(2, 1 - 2 * far[1], (620 - spread) / 7440, rule);
}

/** Degree 5 with 14 points, all inside and with positive weights (Walkington 2000): the solution of the
 * moment equations to 19 digits. */
static void tetrahedron_5(struct quadrature *rule)
{
    const double far[2] = {0.3108859192633006098, 0.0927352503108912264}, edge = 0.0455037041256496495;
    add_towards_corners(3, 1 - 3 * far[0], 0.1126879257180158508 / 6, rule);
    add_towards_corners(3, 1 - 3 * far[1], 0.0734930431163619495 / 6, rule);
    for (int p = 0; p < 4; p++)
        for (int q = p + 1; q < 4; q++) { /* near the middle of the edge from p to q */
            for (int d = 0; d < 3; d++)
                rule->xi[rule->n][d] = p == d + 1 || q == d + 1 ? 0.5 - edge : edge;
            rule->weight[rule->n++] = 0.0425460207770814664 / 6;
        }
}

struct quadrature quadrature_of(enum element_type type, enum quadrature_use use)
{
    struct quadrature rule = {0};
    const int dim = element_dim(type);
    const bool quadratic = element_is_quadratic(type), mass = use == QUADRATURE_MASS;
    if (!element_is_simplex(type))
        (quadratic ? gauss_product_3 : gauss_product)(dim, &rule);
    else if (!quadratic && !mass)
        simplex_centre(dim, &rule);
    else if (!quadratic || !mass)
        simplex_2(dim, &rule);
    else if (dim == 2)
        triangle_4(&rule);
    else
        tetrahedron_5(&rule);
    return rule;
}

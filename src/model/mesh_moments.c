// SPDX-License-Identifier: GPL-3.0-or-later
/* Volume, first and second moments of a mesh. The integrand of a curved hex27 is of degree 9 in each natural
 * coordinate (Jacobian 5, x x 4), the highest of all: Gauss's rule of five points a direction, for simplices
 * on the cube that collapses to them (the factor takes the degree of a tet10 from 7 to 9). */
#include "model/mesh.h"

#include <math.h>
#include <string.h>

enum { GAUSS = 5 };

/** Nodes and weights on [0, 1]. */
static void gauss_rule(double at[GAUSS], double weight[GAUSS])
{
    const double root = 2 * sqrt(10.0 / 7), heavy = (322 + 13 * sqrt(70.0)) / 900,
                 light = (322 - 13 * sqrt(70.0)) / 900;
    const double far = sqrt(5 + root) / 3, near = sqrt(5 - root) / 3;
    const double x[GAUSS] = {-far, -near, 0, near, far}, w[GAUSS] = {light, heavy, 128.0 / 225, heavy, light};
    for (int p = 0; p < GAUSS; p++) {
        at[p] = 0.5 * (1 + x[p]);
        weight[p] = 0.5 * w[p];
    }
}

/** Natural coordinates of the place @p c of the unit cube; returns the factor of volumes. */
static double natural(enum element_type type, const double c[3], double xi[3])
{
    if (!element_is_simplex(type)) {
        for (int d = 0; d < 3; d++)
            xi[d] = 2 * c[d] - 1;
        return element_dim(type) == 2 ? 4 : 8;
    }
    xi[0] = c[0];
    xi[1] = c[1] * (1 - c[0]);
    xi[2] = element_dim(type) == 2 ? 0 : c[2] * (1 - c[0]) * (1 - c[1]);
    return element_dim(type) == 2 ? 1 - c[0] : (1 - c[0]) * (1 - c[0]) * (1 - c[1]);
}

static void add_point(const struct mesh *mesh, size_t e, const double xi[3], double weight,
                      const double about[3], double *volume, double first[3], double second[3][3])
{
    const int32_t *nodes = &mesh->connectivity[e * (size_t)mesh->nodes_per_element];
    double N[ELEMENT_MAX_NODES], x[3] = {0};
    element_shape(mesh->type, xi, N, NULL);
    for (int a = 0; a < mesh->nodes_per_element; a++)
        for (int i = 0; i < mesh->dim; i++)
            x[i] += N[a] * (mesh->X[nodes[a]][i] - about[i]);
    const double part = weight * mesh_jacobian(mesh, e, xi);
    *volume += part;
    for (int i = 0; i < 3; i++) {
        first[i] += part * x[i];
        for (int j = 0; j < 3; j++)
            second[i][j] += part * x[i] * x[j];
    }
}

void mesh_moments(const struct mesh *mesh, const double about[3], double *volume, double first[3],
                  double second[3][3])
{
    double at[GAUSS], weight[GAUSS];
    const int layers = mesh->dim == 2 ? 1 : GAUSS;
    gauss_rule(at, weight);
    *volume = 0;
    memset(first, 0, 3 * sizeof *first);
    memset(second, 0, 3 * sizeof *second);
    for (size_t e = 0; e < mesh->n_elements; e++)
        for (int p = 0; p < GAUSS; p++)
            for (int q = 0; q < GAUSS; q++)
                for (int r = 0; r < layers; r++) {
                    const double c[3] = {at[p], at[q], mesh->dim == 2 ? 0.5 : at[r]};
                    const double w = weight[p] * weight[q] * (mesh->dim == 2 ? 1 : weight[r]);
                    double xi[3];
                    const double factor = natural(mesh->type, c, xi);
                    add_point(mesh, e, xi, factor * w, about, volume, first, second);
                }
}

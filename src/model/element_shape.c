// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/mesh.h"

#include <string.h>

/** Nodes of quad4, quad8 and quad9 in natural coordinates. */
static const double quad_nodes[9][3] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0},  {-1, 1, 0}, {0, -1, 0},
                                        {1, 0, 0},   {0, 1, 0},  {-1, 0, 0}, {0, 0, 0}};

/** Nodes of hex8, hex20 and hex27. */
static const double hex_nodes[27][3] = {
    {-1, -1, -1}, {1, -1, -1}, {1, 1, -1},  {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1},
    {-1, 1, 1},   {0, -1, -1}, {1, 0, -1},  {0, 1, -1},  {-1, 0, -1}, {0, -1, 1}, {1, 0, 1},
    {0, 1, 1},    {-1, 0, 1},  {-1, -1, 0}, {1, -1, 0},  {1, 1, 0},   {-1, 1, 0}, {-1, 0, 0},
    {1, 0, 0},    {0, -1, 0},  {0, 1, 0},   {0, 0, -1},  {0, 0, 1},   {0, 0, 0}};

static const double line_nodes[3][3] = {{-1, 0, 0}, {1, 0, 0}, {0, 0, 0}};

/** Corners between which the further nodes of tri6 and tet10 lie. */
static const int tri_edges[3][2] = {{0, 1}, {1, 2}, {2, 0}};
static const int tet_edges[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};

bool element_is_simplex(enum element_type type)
{
    return type == ELEMENT_TRI3 || type == ELEMENT_TET4 || type == ELEMENT_TRI6 || type == ELEMENT_TET10;
}

bool element_is_quadratic(enum element_type type)
{
    return type >= ELEMENT_LINE3;
}

/** The corners of a node that lies between two of a simplex; a corner lies between itself and itself. */
static void simplex_ends(int dim, int node, int ends[2])
{
    ends[0] = ends[1] = node;
    if (node > dim)
        memcpy(ends, dim == 2 ? tri_edges[node - 3] : tet_edges[node - 4], 2 * sizeof *ends);
}

void element_node(enum element_type type, int node, double xi[3])
{
    const int dim = element_dim(type);
    if (!element_is_simplex(type)) {
        memcpy(xi,
               dim == 1   ? line_nodes[node]
               : dim == 2 ? quad_nodes[node]
                          : hex_nodes[node],
               3 * sizeof *xi);
        return;
    }
    int ends[2];
    simplex_ends(dim, node, ends);
    for (int d = 0; d < 3; d++)
        xi[d] = 0.5 * ((ends[0] == d + 1) + (ends[1] == d + 1));
}

/** N = product of (1 + s_d xi_d) / 2 over the dimensions. */
static void shape_linear(enum element_type type, int dim, int nodes, const double xi[3], double *N,
                         double (*dN)[3])
{
    for (int n = 0; n < nodes; n++) {
        double corner[3], factor[3] = {1, 1, 1};
        element_node(type, n, corner);
        for (int d = 0; d < dim; d++)
            factor[d] = 0.5 * (1 + corner[d] * xi[d]);
        N[n] = factor[0] * factor[1] * factor[2];
        if (!dN)
            continue;
        for (int d = 0; d < 3; d++)
            dN[n][d] = d < dim ? 0.5 * corner[d] * factor[(d + 1) % 3] * factor[(d + 2) % 3] : 0;
    }
}

/** N = product of Lagrange's polynomials for -1, 0, 1. */
static void shape_lagrange(enum element_type type, int dim, int nodes, const double xi[3], double *N,
                           double (*dN)[3])
{
    for (int n = 0; n < nodes; n++) {
        double at[3], factor[3] = {1, 1, 1}, slope[3] = {0};
        element_node(type, n, at);
        for (int d = 0; d < dim; d++) {
            const bool middle = at[d] == 0;
            factor[d] = middle ? 1 - xi[d] * xi[d] : 0.5 * xi[d] * (xi[d] + at[d]);
            slope[d] = middle ? -2 * xi[d] : xi[d] + 0.5 * at[d];
        }
        N[n] = factor[0] * factor[1] * factor[2];
        for (int d = 0; dN && d < 3; d++)
            dN[n][d] = slope[d] * factor[(d + 1) % 3] * factor[(d + 2) % 3];
    }
}

/** Serendipity elements: (1 - xi_m^2) times the linear factors of the others at the middle of an edge along
 * m; linear factors times (sum of s_d xi_d - dim + 1) at corners. */
static void shape_serendipity(enum element_type type, int dim, int nodes, const double xi[3], double *N,
                              double (*dN)[3])
{
    for (int n = 0; n < nodes; n++) {
        double at[3], factor[3] = {1, 1, 1}, slope[3] = {0}, rest = 1 - dim;
        bool corner = true;
        element_node(type, n, at);
        for (int d = 0; d < dim; d++) {
            const bool middle = at[d] == 0;
            factor[d] = middle ? 1 - xi[d] * xi[d] : 0.5 * (1 + at[d] * xi[d]);
            slope[d] = middle ? -2 * xi[d] : 0.5 * at[d];
            rest += at[d] * xi[d];
            corner = corner && !middle;
        }
        const double product = factor[0] * factor[1] * factor[2];
        N[n] = corner ? product * rest : product;
        for (int d = 0; dN && d < 3; d++) {
            const double derivative = slope[d] * factor[(d + 1) % 3] * factor[(d + 2) % 3];
            dN[n][d] = corner && d < dim ? derivative * rest + product * at[d] : derivative;
        }
    }
}

/** Barycentric coordinates. */
static void shape_simplex(int dim, const double xi[3], double *N, double (*dN)[3])
{
    N[0] = 1;
    for (int d = 0; d < dim; d++) {
        N[0] -= xi[d];
        N[d + 1] = xi[d];
    }
    if (!dN)
        return;
    for (int n = 0; n <= dim; n++)
        for (int d = 0; d < 3; d++)
            dN[n][d] = d >= dim ? 0 : n == 0 ? -1 : n == d + 1 ? 1 : 0;
}

/** L (2 L - 1) at corners, 4 L_a L_b between them. */
static void shape_quadratic_simplex(int dim, int nodes, const double xi[3], double *N, double (*dN)[3])
{
    double L[4], dL[4][3];
    shape_simplex(dim, xi, L, dL);
    for (int n = 0; n < nodes; n++) {
        int ends[2];
        simplex_ends(dim, n, ends);
        const double a = L[ends[0]], b = L[ends[1]];
        N[n] = n <= dim ? a * (2 * a - 1) : 4 * a * b;
        for (int d = 0; dN && d < 3; d++)
            dN[n][d] = n <= dim ? (4 * a - 1) * dL[n][d] : 4 * (a * dL[ends[1]][d] + b * dL[ends[0]][d]);
    }
}

void element_shape(enum element_type type, const double xi[3], double *N, double (*dN)[3])
{
    const int dim = element_dim(type), nodes = element_nodes(type);
    switch (type) {
    case ELEMENT_TRI3:
    case ELEMENT_TET4:
        shape_simplex(dim, xi, N, dN);
        break;
    case ELEMENT_TRI6:
    case ELEMENT_TET10:
        shape_quadratic_simplex(dim, nodes, xi, N, dN);
        break;
    case ELEMENT_QUAD8:
    case ELEMENT_HEX20:
        shape_serendipity(type, dim, nodes, xi, N, dN);
        break;
    case ELEMENT_LINE3:
    case ELEMENT_QUAD9:
    case ELEMENT_HEX27:
        shape_lagrange(type, dim, nodes, xi, N, dN);
        break;
    default:
        shape_linear(type, dim, nodes, xi, N, dN);
    }
}

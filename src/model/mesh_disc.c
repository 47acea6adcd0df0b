// SPDX-License-Identifier: GPL-3.0-or-later
/* A disc of quads: the rings of cells of a square bent round. */
#include "base/error.h"
#include "base/memory.h"
#include "model/mesh.h"

#include <math.h>
#include <string.h>

/** Direction of the point (u, v) of a square's edge on a circle, so that even steps along the edge are even
 * steps of the angle. */
static void direction(double u, double v, double e[2])
{
    const bool side = fabs(u) >= fabs(v);
    const double angle = side ? M_PI_4 * v / u : M_PI_4 * u / v;
    const double along = (side ? u : v) > 0 ? cos(angle) : -cos(angle),
                 across = (side ? u : v) > 0 ? sin(angle) : -sin(angle);
    e[0] = side ? along : across;
    e[1] = side ? across : along;
}

/** From the square [-1, 1] x [-1, 1] to the unit disc: between the square inscribed in the circle of the
 * point's ring (s = 0) and that circle (s = 1). Elements at the corners cannot avoid an angle near pi; their
 * least Jacobian at Gauss points stays above half the product of their sides. */
static void bend(double u, double v, double x[2])
{
    const double s = fmax(fabs(u), fabs(v));
    double e[2] = {0};
    if (s > 0)
        direction(u, v, e);
    x[0] = (1 - s) * M_SQRT1_2 * u + s * (s * e[0]);
    x[1] = (1 - s) * M_SQRT1_2 * v + s * (s * e[1]);
}

/** Nodes of a grid on [-1, 1] x [-1, 1] to their places; those of the rim into its only set. */
static int bend_grid(struct mesh *mesh, const double centre[3], double radius, int cells)
{
    struct node_set rim = {.name = memory_text("rim"),
                           .nodes = memory_create(4 * (size_t)cells, sizeof *rim.nodes)};
    const size_t side = (size_t)cells + 1;
    for (size_t i = 0; rim.nodes && i < mesh->n_nodes; i++) {
        const int at[2] = {(int)(i % side), (int)(i / side)};
        double x[2];
        /* multiples of 1/cells: the same bits in all quadrants */
        bend((2.0 * at[0] - cells) / cells, (2.0 * at[1] - cells) / cells, x);
        for (int d = 0; d < 2; d++)
            mesh->X[i][d] = centre[d] + radius * x[d];
        if (at[0] == 0 || at[0] == cells || at[1] == 0 || at[1] == cells)
            rim.nodes[rim.n++] = (int32_t)i;
    }
    for (size_t s = 0; s < mesh->n_sets; s++) {
        memory_free(mesh->sets[s].name);
        memory_free(mesh->sets[s].nodes);
    }
    mesh->n_sets = 1;
    mesh->sets[0] = rim;
    return rim.name && rim.nodes ? 0 : STATUS_MEMORY;
}

/** Nodes in the middle of sides on the rim go from the chord to the circle. */
static void round_rim(struct mesh *mesh, const double centre[3], double radius)
{
    const struct node_set *rim = &mesh->sets[0];
    for (size_t k = 0; k < rim->n; k++) {
        double *X = mesh->X[rim->nodes[k]];
        const double x = X[0] - centre[0], y = X[1] - centre[1], r = hypot(x, y);
        X[0] = centre[0] + radius * (x / r);
        X[1] = centre[1] + radius * (y / r);
    }
}

int mesh_create_disc(struct mesh *mesh, enum element_type type, const double centre[3], double radius,
                     int cells)
{
    static const double lower[3] = {-1, -1, 0}, upper[3] = {1, 1, 0};
    *mesh = (struct mesh){0};
    CHECK(type == ELEMENT_QUAD4 || type == ELEMENT_QUAD8 || type == ELEMENT_QUAD9, STATUS_DECK,
          "disc mesh: %s elements; it is made of quad4, quad8 or quad9", element_name(type));
    CHECK(cells >= 2 && radius > 0, STATUS_DECK,
          "disc mesh: %d cells, radius %g; at least 2 and more than 0 are needed", cells, radius);
    CALL(mesh_create_grid(mesh, 2, lower, upper, (const int[3]){cells, cells, 0}));
    int status = bend_grid(mesh, centre, radius, cells);
    if (!status && type != mesh->type) {
        status = mesh_convert(mesh, type);
        if (!status)
            round_rim(mesh, centre, radius);
    }
    if (status)
        mesh_reset(mesh);
    return status;
}

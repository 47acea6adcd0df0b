// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef MODEL_MESH_H
#define MODEL_MESH_H

#include <stddef.h>
#include <stdint.h>

enum element_type { ELEMENT_LINE2, ELEMENT_TRI3, ELEMENT_QUAD4, ELEMENT_TET4, ELEMENT_HEX8, ELEMENT_TYPES };

/** Facets: the boundary of a mesh, or a surface on its own. Points are rows of 3 (z = 0 in 2-D). A facet has
 * 2 (segment), 3 or 4 nodes; unused entries are -1. Orientation: the normal points into the fluid, out of the
 * solid. 2-D: the solid lies to the LEFT of the way from node 0 to node 1, the normal (t_y, -t_x) points to
 * the right. 3-D: counter-clockwise seen from the fluid. */
struct facets {
    int dim;
    size_t n_points, n_facets;
    double (*points)[3];
    int32_t (*nodes)[4];
};

struct node_set {
    char *name;
    size_t n;
    int32_t *nodes;
};

/** A finite element mesh: geometry only. */
struct mesh {
    int dim;
    enum element_type type;
    int nodes_per_element;
    size_t n_nodes, n_elements;
    double (*X)[3];        /**< reference places, n_nodes rows (z = 0 in 2-D) */
    int32_t *connectivity; /**< n_elements rows of nodes_per_element, VTK order, positive Jacobian */
    size_t n_sets;
    struct node_set *sets;
};

/** Structured grid of quad4 (dim 2) or hex8 (dim 3) elements in the box, x fastest; node sets "x-", "x+",
 * "y-", ... are made. Returns a status. */
int mesh_create_grid(struct mesh *mesh, int dim, const double lower[3], const double upper[3],
                     const int cells[3]);

/** Add the set of all nodes in the box [lower, upper] (widened by @p tolerance). STATUS_DECK (not reported)
 * if it is empty. */
int mesh_add_set_box(struct mesh *mesh, const char *name, const double lower[3], const double upper[3],
                     double tolerance);

/** The set called @p name, or NULL. */
const struct node_set *mesh_find_set(const struct mesh *mesh, const char *name);

/** The skin of the mesh without the facets all of whose nodes lie in @p exclude (NULL: none); node numbers
 * are those of the mesh, facets->points a copy of all mesh nodes. Free with facets_reset. */
int mesh_skin(const struct mesh *mesh, const struct node_set *exclude, struct facets *skin);

/** Spatial dimension, nodes, VTK cell type and name of an element type ("quad4"). */
int element_dim(enum element_type type);
int element_nodes(enum element_type type);
int element_vtk(enum element_type type);
const char *element_name(enum element_type type);

/** Shape functions N[nodes] and, unless NULL, derivatives dN[nodes][3] by xi at @p xi (natural coordinates,
 * VTK order). */
void element_shape(enum element_type type, const double xi[3], double *N, double (*dN)[3]);

void facets_reset(struct facets *facets);
void mesh_reset(struct mesh *mesh);

#endif

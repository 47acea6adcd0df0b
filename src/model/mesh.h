// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef MODEL_MESH_H
#define MODEL_MESH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** First-order elements, then quadratic ones; line3 occurs as a side only. */
enum element_type {
    ELEMENT_LINE2,
    ELEMENT_TRI3,
    ELEMENT_QUAD4,
    ELEMENT_TET4,
    ELEMENT_HEX8,
    ELEMENT_LINE3,
    ELEMENT_TRI6,
    ELEMENT_QUAD8,
    ELEMENT_QUAD9,
    ELEMENT_TET10,
    ELEMENT_HEX20,
    ELEMENT_HEX27,
    ELEMENT_TYPES
};

/** Largest numbers of nodes of an element and of one of its sides. */
enum { ELEMENT_MAX_NODES = 27, SIDE_MAX_NODES = 9 };

/** Facets: the boundary of a mesh, or a surface on its own. Points are rows of 3 (z = 0 in 2-D). A facet has
 * 2 (segment), 3 or 4 nodes; unused entries are -1. Orientation: the normal points into the fluid, out of the
 * solid. 2-D: the solid lies to the LEFT of the way from node 0 to node 1, the normal (t_y, -t_x) points to
 * the right. 3-D: counter-clockwise seen from the fluid. */
struct facets {
    int dim;
    size_t n_points, n_facets;
    double (*points)[3];
    int32_t (*nodes)[4];
    /** Nodes of the curved side (line3, tri6, quad8, quad9; VTK order) that a facet is a straight piece of,
     * -1 unused; NULL, or -1 first: the facet is a side of its own. All nodes of the facet are among them. */
    int32_t (*sides)[SIDE_MAX_NODES];
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

/** Disc in 2-D of quad4, quad8 or quad9 elements: a square of cells x cells (at least 2) of them bent round.
 * Its nodes lie on rings: halfway between the circle of the ring and the square inscribed in it, nearer to
 * the circle the larger the ring; those of the outermost are on the circle, evenly spread over 4 cells sides,
 * and form the node set "rim". Returns a status. */
int mesh_create_disc(struct mesh *mesh, enum element_type type, const double centre[3], double radius,
                     int cells);

/** Leave out the elements that @p left_out (n_elements values) names; nodes that none of the others has
 * vanish, also from the sets, and so do sets that become empty. At least one element has to stay. Returns a
 * status.
 */
int mesh_leave_out(struct mesh *mesh, const bool *left_out);

/** Centre of the nodes of element @p e. */
void mesh_centre(const struct mesh *mesh, size_t e, double centre[3]);

/** Add the set of all nodes in the box [lower, upper] (widened by @p tolerance). STATUS_DECK (not reported)
 * if it is empty. */
int mesh_add_set_box(struct mesh *mesh, const char *name, const double lower[3], const double upper[3],
                     double tolerance);

/** The set called @p name, or NULL. */
const struct node_set *mesh_find_set(const struct mesh *mesh, const char *name);

/** Make a mesh of quad4 or hex8 elements into one of another @p type: tri3, tri6, quad8, quad9 or tet4,
 * tet10, hex20, hex27. Simplices come from cutting all elements alike, which fits together in grids only; new
 * nodes follow the old ones, in the middle of edges, faces and cells, and belong to the sets that all corners
 * around them belong to. STATUS_DECK for any other type (reported); the mesh may then be reset. */
int mesh_convert(struct mesh *mesh, enum element_type type);

/** Volume of the mesh (2-D: area), and the integrals of x and of x_i x_j over it, x from the place @p about:
 * exact for all element types, curved ones too. */
void mesh_moments(const struct mesh *mesh, const double about[3], double *volume, double first[3],
                  double second[3][3]);

/** Determinant of the map from natural coordinates of element @p e at @p xi. */
double mesh_jacobian(const struct mesh *mesh, size_t e, const double xi[3]);

/** The skin of the mesh without the sides of elements all of whose nodes lie in one of the @p n_excluded sets
 * @p excluded (indices); node numbers are those of the mesh, facets->points a copy of all mesh nodes. A side
 * of a quadratic element is cut into facets at its nodes: 2 segments, 4 triangles, 4 triangles and a quad, 4
 * quads. Free with facets_reset.
 */
int mesh_skin(const struct mesh *mesh, const int *excluded, size_t n_excluded, struct facets *skin);

/** Spatial dimension, nodes, VTK cell type and name of an element type ("quad4"). */
int element_dim(enum element_type type);
int element_nodes(enum element_type type);
int element_vtk(enum element_type type);
const char *element_name(enum element_type type);

bool element_is_simplex(enum element_type type);
bool element_is_quadratic(enum element_type type);

/** The type of a curved side with these nodes (struct facets), in @p dim dimensions. */
enum element_type mesh_side_type(int dim, const int32_t nodes[SIDE_MAX_NODES]);

/** Natural coordinates of a node. */
void element_node(enum element_type type, int node, double xi[3]);

/** Shape functions N[nodes] and, unless NULL, derivatives dN[nodes][3] by xi at @p xi (natural coordinates,
 * VTK order). */
void element_shape(enum element_type type, const double xi[3], double *N, double (*dN)[3]);

void facets_reset(struct facets *facets);
void mesh_reset(struct mesh *mesh);

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef MODEL_MESH_SEARCH_H
#define MODEL_MESH_SEARCH_H

#include "model/mesh.h"

/** Finds the elements of a mesh in which places of the reference configuration lie: a grid of cells, each
 * with the elements that reach into it. */
struct mesh_search {
    const struct mesh *mesh; /**< not owned */
    double margin;           /**< how far outside the mesh a place may lie, m */
    double lower[3], size[3];
    int cells[3];
    uint32_t *start;    /**< per cell, and one more: where its elements begin */
    uint32_t *elements; /**< ascending in each cell */
};

/** Prepare the search in @p mesh, which must outlive it. A place at most @p margin (m) outside all elements
 * belongs to the one whose natural coordinates it exceeds least. Returns 0 or STATUS_MEMORY; free with
 * mesh_search_reset. */
int mesh_search_init(struct mesh_search *search, const struct mesh *mesh, double margin);
void mesh_search_reset(struct mesh_search *search);

/** Element and natural coordinates of the material point at reference place @p X; false when it lies outside
 * the mesh. On the common side of several elements rounding decides which it is. */
bool mesh_search_find(const struct mesh_search *search, const double X[3], size_t *element, double xi[3]);

/** The same for one place only, which must lie in the mesh: STATUS_DECK (not reported) when it does not. */
int mesh_search_once(const struct mesh *mesh, const double X[3], int *element, double xi[3]);

#endif

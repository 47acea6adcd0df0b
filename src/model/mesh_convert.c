// SPDX-License-Identifier: GPL-3.0-or-later
/* Other elements from a mesh of quad4 or hex8: cut into simplices, further nodes added. */
#include "base/error.h"
#include "base/memory.h"
#include "model/mesh.h"

#include <stdlib.h>
#include <string.h>

/** The type with the corners of @p type only. */
static enum element_type corners_of(enum element_type type)
{
    switch (type) {
    case ELEMENT_TRI6:
        return ELEMENT_TRI3;
    case ELEMENT_QUAD8:
    case ELEMENT_QUAD9:
        return ELEMENT_QUAD4;
    case ELEMENT_TET10:
        return ELEMENT_TET4;
    case ELEMENT_HEX20:
    case ELEMENT_HEX27:
        return ELEMENT_HEX8;
    default:
        return type;
    }
}

/** Cut quads into 2 triangles, hexahedra into 6 tetrahedra about the diagonal from corner 0 to corner 6: in a
 * grid the cuts of neighbours meet. */
static int cut(struct mesh *mesh, enum element_type type)
{
    static const int tri[2][3] = {{0, 1, 2}, {0, 2, 3}};
    static const int tet[6][4] = {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6},
                                  {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
    const size_t parts = mesh->dim == 2 ? 2 : 6, nodes = (size_t)element_nodes(type),
                 old = (size_t)mesh->nodes_per_element;
    int32_t *connectivity = memory_create(mesh->n_elements * parts * nodes, sizeof *connectivity);
    CHECK_MEMORY(connectivity);
    for (size_t e = 0; e < mesh->n_elements; e++)
        for (size_t p = 0; p < parts; p++)
            for (size_t n = 0; n < nodes; n++)
                connectivity[(e * parts + p) * nodes + n] =
                    mesh->connectivity[e * old + (size_t)(mesh->dim == 2 ? tri[p][n] : tet[p][n])];
    memory_free(mesh->connectivity);
    mesh->connectivity = connectivity;
    mesh->n_elements *= parts;
    mesh->nodes_per_element = (int)nodes;
    mesh->type = type;
    return 0;
}

/** A further node of an element and the corners it lies between, in ascending order (-1: unused): elements
 * that have these in common share the node. */
struct middle {
    int32_t corners[8];
    int n;
    size_t at; /**< in the new connectivity */
};

static int compare_corners(const struct middle *a, const struct middle *b)
{
    for (int k = 0; k < 8; k++)
        if (a->corners[k] != b->corners[k])
            return a->corners[k] < b->corners[k] ? -1 : 1;
    return 0;
}

static int compare_middles(const void *left, const void *right)
{
    const struct middle *a = left, *b = right;
    const int by_corners = compare_corners(a, b);
    return by_corners ? by_corners : (a->at > b->at) - (a->at < b->at);
}

/** Those of an element's @p corners that take part in the shape functions @p N. */
static void fill_middle(const int32_t *corners, int n_corners, const double *N, struct middle *middle)
{
    memset(middle->corners, -1, sizeof middle->corners);
    middle->n = 0;
    for (int c = 0; c < n_corners; c++) {
        if (!(N[c] > 0))
            continue;
        int at = middle->n++;
        for (; at > 0 && middle->corners[at - 1] > corners[c]; at--)
            middle->corners[at] = middle->corners[at - 1];
        middle->corners[at] = corners[c];
    }
}

/** All further nodes of all elements of the new @p type, sorted so that equal ones follow each other. */
static struct middle *list_middles(const struct mesh *mesh, enum element_type type, size_t n)
{
    struct middle *middles = memory_create(n, sizeof *middles);
    const int old = mesh->nodes_per_element, nodes = element_nodes(type);
    size_t k = 0;
    for (int a = old; middles && a < nodes; a++) {
        double xi[3], N[ELEMENT_MAX_NODES];
        element_node(type, a, xi);
        element_shape(mesh->type, xi, N, NULL);
        for (size_t e = 0; e < mesh->n_elements; e++, k++) {
            fill_middle(&mesh->connectivity[e * (size_t)old], old, N, &middles[k]);
            middles[k].at = e * (size_t)nodes + (size_t)a;
        }
    }
    if (middles)
        qsort(middles, n, sizeof *middles, compare_middles);
    return middles;
}

/** The mean of the corners; exactly in the plane of a side they share. */
static void place_middle(const struct mesh *mesh, const struct middle *middle, double X[3])
{
    const double *first = mesh->X[middle->corners[0]];
    for (int i = 0; i < 3; i++) {
        double sum = 0;
        for (int k = 1; k < middle->n; k++)
            sum += mesh->X[middle->corners[k]][i] - first[i];
        X[i] = first[i] + sum / middle->n;
    }
}

/** Nodes all of whose corners are in a set join it. */
static int extend_sets(struct mesh *mesh, const struct middle *middles, size_t n, size_t n_nodes)
{
    bool *in = memory_create(mesh->n_nodes, sizeof *in);
    CHECK_MEMORY(in);
    for (size_t s = 0; s < mesh->n_sets; s++) {
        struct node_set *set = &mesh->sets[s];
        int32_t *nodes = memory_create(set->n + n_nodes - mesh->n_nodes, sizeof *nodes);
        if (!nodes) {
            memory_free(in);
            return STATUS_MEMORY;
        }
        memcpy(nodes, set->nodes, set->n * sizeof *nodes);
        memory_free(set->nodes);
        set->nodes = nodes;
        memset(in, 0, mesh->n_nodes * sizeof *in);
        for (size_t k = 0; k < set->n; k++)
            in[nodes[k]] = true;
        size_t number = mesh->n_nodes;
        for (size_t m = 0; m < n; m++) {
            if (m > 0 && compare_corners(&middles[m], &middles[m - 1]) == 0)
                continue;
            bool all = true;
            for (int k = 0; k < middles[m].n; k++)
                all = all && in[middles[m].corners[k]];
            if (all)
                nodes[set->n++] = (int32_t)number;
            number++;
        }
    }
    memory_free(in);
    return 0;
}

/** Number and place the further nodes, which follow those there are. */
static int add_middles(struct mesh *mesh, enum element_type type, const struct middle *middles, size_t n)
{
    const size_t old = (size_t)mesh->nodes_per_element, nodes = (size_t)element_nodes(type);
    size_t n_nodes = mesh->n_nodes;
    for (size_t m = 0; m < n; m++)
        n_nodes += m == 0 || compare_corners(&middles[m], &middles[m - 1]) != 0;
    CHECK(n_nodes <= INT32_MAX, STATUS_DECK, "mesh: %zu nodes are more than 2147483647", n_nodes);
    int32_t *connectivity = memory_create(mesh->n_elements * nodes, sizeof *connectivity);
    double(*X)[3] = memory_create(n_nodes, sizeof *X);
    const int status = connectivity && X ? extend_sets(mesh, middles, n, n_nodes) : STATUS_MEMORY;
    if (status) {
        memory_free(connectivity);
        memory_free(X);
        return status;
    }
    for (size_t e = 0; e < mesh->n_elements; e++)
        memcpy(&connectivity[e * nodes], &mesh->connectivity[e * old], old * sizeof *connectivity);
    memcpy(X, mesh->X, mesh->n_nodes * sizeof *X);
    n_nodes = mesh->n_nodes;
    for (size_t m = 0; m < n; m++) {
        if (m == 0 || compare_corners(&middles[m], &middles[m - 1]) != 0)
            place_middle(mesh, &middles[m], X[n_nodes++]);
        connectivity[middles[m].at] = (int32_t)n_nodes - 1;
    }
    memory_free(mesh->connectivity);
    memory_free(mesh->X);
    mesh->connectivity = connectivity;
    mesh->X = X;
    mesh->n_nodes = n_nodes;
    mesh->nodes_per_element = (int)nodes;
    mesh->type = type;
    return 0;
}

int mesh_convert(struct mesh *mesh, enum element_type type)
{
    const enum element_type corners = corners_of(type);
    CHECK(element_dim(type) == mesh->dim && (mesh->type == ELEMENT_QUAD4 || mesh->type == ELEMENT_HEX8),
          STATUS_DECK, "a mesh of %s elements cannot be made into %s", element_name(mesh->type),
          element_name(type));
    if (corners != mesh->type)
        CALL(cut(mesh, corners));
    const size_t n = mesh->n_elements * (size_t)(element_nodes(type) - mesh->nodes_per_element);
    if (n == 0)
        return 0;
    struct middle *middles = list_middles(mesh, type, n);
    CHECK_MEMORY(middles);
    const int status = add_middles(mesh, type, middles, n);
    memory_free(middles);
    return status;
}

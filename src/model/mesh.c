// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/mesh.h"

#include "base/error.h"
#include "base/memory.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/** What an element type is; its sides are listed with the normal out of the element, struct facets'
 * orientation, in VTK order. */
struct element_description {
    const char *name;
    int dim, nodes, vtk;
    int n_sides;
    enum element_type side;
    int sides[6][SIDE_MAX_NODES];
};

static const struct element_description descriptions[ELEMENT_TYPES] = {
    [ELEMENT_LINE2] = {.name = "line2", .dim = 1, .nodes = 2, .vtk = 3},
    [ELEMENT_LINE3] = {.name = "line3", .dim = 1, .nodes = 3, .vtk = 21},
    [ELEMENT_TRI3] = {.name = "tri3",
                      .dim = 2,
                      .nodes = 3,
                      .vtk = 5,
                      .n_sides = 3,
                      .side = ELEMENT_LINE2,
                      .sides = {{0, 1}, {1, 2}, {2, 0}}},
    [ELEMENT_TRI6] = {.name = "tri6",
                      .dim = 2,
                      .nodes = 6,
                      .vtk = 22,
                      .n_sides = 3,
                      .side = ELEMENT_LINE3,
                      .sides = {{0, 1, 3}, {1, 2, 4}, {2, 0, 5}}},
    [ELEMENT_QUAD4] = {.name = "quad4",
                       .dim = 2,
                       .nodes = 4,
                       .vtk = 9,
                       .n_sides = 4,
                       .side = ELEMENT_LINE2,
                       .sides = {{0, 1}, {1, 2}, {2, 3}, {3, 0}}},
    [ELEMENT_QUAD8] = {.name = "quad8",
                       .dim = 2,
                       .nodes = 8,
                       .vtk = 23,
                       .n_sides = 4,
                       .side = ELEMENT_LINE3,
                       .sides = {{0, 1, 4}, {1, 2, 5}, {2, 3, 6}, {3, 0, 7}}},
    [ELEMENT_QUAD9] = {.name = "quad9",
                       .dim = 2,
                       .nodes = 9,
                       .vtk = 28,
                       .n_sides = 4,
                       .side = ELEMENT_LINE3,
                       .sides = {{0, 1, 4}, {1, 2, 5}, {2, 3, 6}, {3, 0, 7}}},
    [ELEMENT_TET4] = {.name = "tet4",
                      .dim = 3,
                      .nodes = 4,
                      .vtk = 10,
                      .n_sides = 4,
                      .side = ELEMENT_TRI3,
                      .sides = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}},
    [ELEMENT_TET10] =
        {.name = "tet10",
         .dim = 3,
         .nodes = 10,
         .vtk = 24,
         .n_sides = 4,
         .side = ELEMENT_TRI6,
         .sides = {{0, 2, 1, 6, 5, 4}, {0, 1, 3, 4, 8, 7}, {1, 2, 3, 5, 9, 8}, {0, 3, 2, 7, 9, 6}}},
    [ELEMENT_HEX8] =
        {.name = "hex8",
         .dim = 3,
         .nodes = 8,
         .vtk = 12,
         .n_sides = 6,
         .side = ELEMENT_QUAD4,
         .sides = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}},
    [ELEMENT_HEX20] = {.name = "hex20",
                       .dim = 3,
                       .nodes = 20,
                       .vtk = 25,
                       .n_sides = 6,
                       .side = ELEMENT_QUAD8,
                       .sides = {{0, 3, 2, 1, 11, 10, 9, 8},
                                 {4, 5, 6, 7, 12, 13, 14, 15},
                                 {0, 1, 5, 4, 8, 17, 12, 16},
                                 {1, 2, 6, 5, 9, 18, 13, 17},
                                 {2, 3, 7, 6, 10, 19, 14, 18},
                                 {3, 0, 4, 7, 11, 16, 15, 19}}},
    [ELEMENT_HEX27] = {.name = "hex27",
                       .dim = 3,
                       .nodes = 27,
                       .vtk = 29,
                       .n_sides = 6,
                       .side = ELEMENT_QUAD9,
                       .sides = {{0, 3, 2, 1, 11, 10, 9, 8, 24},
                                 {4, 5, 6, 7, 12, 13, 14, 15, 25},
                                 {0, 1, 5, 4, 8, 17, 12, 16, 22},
                                 {1, 2, 6, 5, 9, 18, 13, 17, 21},
                                 {2, 3, 7, 6, 10, 19, 14, 18, 23},
                                 {3, 0, 4, 7, 11, 16, 15, 19, 20}}},
};

/** Straight pieces of a side, through its nodes. */
struct side_pieces {
    int corners, n;
    int nodes[5][4];
};

static const struct side_pieces pieces[ELEMENT_TYPES] = {
    [ELEMENT_LINE2] = {2, 1, {{0, 1, -1, -1}}},
    [ELEMENT_TRI3] = {3, 1, {{0, 1, 2, -1}}},
    [ELEMENT_QUAD4] = {4, 1, {{0, 1, 2, 3}}},
    [ELEMENT_LINE3] = {2, 2, {{0, 2, -1, -1}, {2, 1, -1, -1}}},
    [ELEMENT_TRI6] = {3, 4, {{0, 3, 5, -1}, {3, 1, 4, -1}, {5, 4, 2, -1}, {3, 4, 5, -1}}},
    [ELEMENT_QUAD8] = {4, 5, {{0, 4, 7, -1}, {4, 1, 5, -1}, {5, 2, 6, -1}, {6, 3, 7, -1}, {4, 5, 6, 7}}},
    [ELEMENT_QUAD9] = {4, 4, {{0, 4, 8, 7}, {4, 1, 5, 8}, {8, 5, 2, 6}, {7, 8, 6, 3}}},
};

/** A side of an element with its corners in ascending order, to find the sides that occur only once. */
struct side_key {
    int32_t nodes[4];
    size_t side; /**< element * sides per element + side */
};

int element_dim(enum element_type type)
{
    return descriptions[type].dim;
}

int element_nodes(enum element_type type)
{
    return descriptions[type].nodes;
}

int element_vtk(enum element_type type)
{
    return descriptions[type].vtk;
}

const char *element_name(enum element_type type)
{
    return descriptions[type].name;
}

enum element_type mesh_side_type(int dim, const int32_t nodes[SIDE_MAX_NODES])
{
    int n = 0;
    while (n < SIDE_MAX_NODES && nodes[n] >= 0)
        n++;
    return dim == 2 ? ELEMENT_LINE3 : n == 6 ? ELEMENT_TRI6 : n == 8 ? ELEMENT_QUAD8 : ELEMENT_QUAD9;
}

double mesh_jacobian(const struct mesh *mesh, size_t e, const double xi[3])
{
    const int32_t *nodes = &mesh->connectivity[e * (size_t)mesh->nodes_per_element];
    double N[ELEMENT_MAX_NODES], dN[ELEMENT_MAX_NODES][3], J[3][3] = {{0}};
    element_shape(mesh->type, xi, N, dN);
    for (int i = 0; i < mesh->dim; i++)
        for (int A = 0; A < mesh->dim; A++)
            for (int a = 0; a < mesh->nodes_per_element; a++)
                J[i][A] += mesh->X[nodes[a]][i] * dN[a][A];
    if (mesh->dim == 2)
        J[2][2] = 1;
    return J[0][0] * (J[1][1] * J[2][2] - J[1][2] * J[2][1]) -
           J[0][1] * (J[1][0] * J[2][2] - J[1][2] * J[2][0]) +
           J[0][2] * (J[1][0] * J[2][1] - J[1][1] * J[2][0]);
}

/** Append an empty set with room for @p capacity nodes. */
static struct node_set *append_set(struct mesh *mesh, const char *name, size_t capacity)
{
    size_t room = mesh->n_sets;
    if (memory_grow((void **)&mesh->sets, &room, mesh->n_sets + 1, sizeof *mesh->sets))
        return NULL;
    struct node_set *set = &mesh->sets[mesh->n_sets];
    *set = (struct node_set){0};
    set->name = memory_text(name);
    set->nodes = set->name ? memory_create(capacity, sizeof *set->nodes) : NULL;
    if (!set->nodes) {
        memory_free(set->name);
        return NULL;
    }
    mesh->n_sets++;
    return set;
}

/** One set per side: "x-", "x+", "y-", ... */
static int add_side_sets(struct mesh *mesh, const int cells[3])
{
    const size_t n[3] = {(size_t)cells[0] + 1, (size_t)cells[1] + 1,
                         mesh->dim == 3 ? (size_t)cells[2] + 1 : 1};
    for (int d = 0; d < mesh->dim; d++)
        for (int side = 0; side < 2; side++) {
            const char name[3] = {"xyz"[d], "-+"[side], 0};
            struct node_set *set = append_set(mesh, name, mesh->n_nodes / n[d]);
            CHECK_MEMORY(set);
            for (size_t i = 0; i < mesh->n_nodes; i++) {
                const size_t index[3] = {i % n[0], i / n[0] % n[1], i / (n[0] * n[1])};
                if (index[d] == (side ? n[d] - 1 : 0))
                    set->nodes[set->n++] = (int32_t)i;
            }
        }
    return 0;
}

static void fill_grid(struct mesh *mesh, const double lower[3], const double upper[3], const int cells[3])
{
    const size_t n[3] = {(size_t)cells[0] + 1, (size_t)cells[1] + 1,
                         mesh->dim == 3 ? (size_t)cells[2] + 1 : 1};
    for (size_t i = 0; i < mesh->n_nodes; i++) {
        const size_t index[3] = {i % n[0], i / n[0] % n[1], i / (n[0] * n[1])};
        for (int d = 0; d < mesh->dim; d++)
            mesh->X[i][d] = index[d] == n[d] - 1
                                ? upper[d] /* exactly, so that surfaces of neighbouring parts meet */
                                : lower[d] + (upper[d] - lower[d]) * (double)index[d] / cells[d];
    }
    const size_t layers = mesh->dim == 3 ? (size_t)cells[2] : 1;
    int32_t *row = mesh->connectivity;
    for (size_t k = 0; k < layers; k++)
        for (size_t j = 0; j + 1 < n[1]; j++)
            for (size_t i = 0; i + 1 < n[0]; i++)
                for (int c = 0; c < mesh->nodes_per_element; c++) {
                    double corner[3];
                    element_node(mesh->type, c, corner);
                    *row++ = (int32_t)(i + (corner[0] > 0) +
                                       n[0] * (j + (corner[1] > 0) + n[1] * (k + (corner[2] > 0))));
                }
}

int mesh_create_grid(struct mesh *mesh, int dim, const double lower[3], const double upper[3],
                     const int cells[3])
{
    *mesh = (struct mesh){.dim = dim, .type = dim == 3 ? ELEMENT_HEX8 : ELEMENT_QUAD4};
    CHECK(dim == 2 || dim == 3, STATUS_DECK, "grid mesh: dimension %d; it must be 2 or 3", dim);
    double nodes = 1;
    for (int d = 0; d < dim; d++) {
        CHECK(cells[d] >= 1, STATUS_DECK, "grid mesh: %d cells along %c; at least 1 is needed", cells[d],
              "xyz"[d]);
        CHECK(upper[d] > lower[d], STATUS_DECK, "grid mesh: upper %g along %c must be greater than lower %g",
              upper[d], "xyz"[d], lower[d]);
        nodes *= cells[d] + 1.0;
    }
    CHECK(nodes < INT32_MAX, STATUS_DECK, "grid mesh: %.0f nodes are too many; at most %d", nodes, INT32_MAX);
    mesh->nodes_per_element = element_nodes(mesh->type);
    mesh->n_nodes = mesh->n_elements = 1;
    for (int d = 0; d < dim; d++) {
        mesh->n_nodes *= (size_t)cells[d] + 1;
        mesh->n_elements *= (size_t)cells[d];
    }
    mesh->X = memory_create(mesh->n_nodes, sizeof *mesh->X);
    mesh->connectivity =
        memory_create(mesh->n_elements * (size_t)mesh->nodes_per_element, sizeof *mesh->connectivity);
    if (!mesh->X || !mesh->connectivity) {
        mesh_reset(mesh);
        return STATUS_MEMORY;
    }
    fill_grid(mesh, lower, upper, cells);
    int status = add_side_sets(mesh, cells);
    if (status)
        mesh_reset(mesh);
    return status;
}

int mesh_add_set_box(struct mesh *mesh, const char *name, const double lower[3], const double upper[3],
                     double tolerance)
{
    struct node_set *set = append_set(mesh, name, mesh->n_nodes);
    CHECK_MEMORY(set);
    for (size_t i = 0; i < mesh->n_nodes; i++) {
        bool inside = true;
        for (int d = 0; d < mesh->dim; d++)
            inside = inside && mesh->X[i][d] >= lower[d] - tolerance && mesh->X[i][d] <= upper[d] + tolerance;
        if (inside)
            set->nodes[set->n++] = (int32_t)i;
    }
    if (set->n > 0)
        return 0;
    mesh->n_sets--;
    memory_free(set->name);
    memory_free(set->nodes);
    return STATUS_DECK;
}

const struct node_set *mesh_find_set(const struct mesh *mesh, const char *name)
{
    for (size_t s = 0; s < mesh->n_sets; s++)
        if (!strcmp(mesh->sets[s].name, name))
            return &mesh->sets[s];
    return NULL;
}

static int compare_nodes(const struct side_key *a, const struct side_key *b)
{
    for (int n = 0; n < 4; n++)
        if (a->nodes[n] != b->nodes[n])
            return a->nodes[n] < b->nodes[n] ? -1 : 1;
    return 0;
}

static int compare_keys(const void *a, const void *b)
{
    const struct side_key *p = a, *q = b;
    const int by_nodes = compare_nodes(p, q);
    return by_nodes ? by_nodes : (p->side > q->side) - (p->side < q->side);
}

static void fill_key(const struct mesh *mesh, size_t side, struct side_key *key)
{
    const struct element_description *description = &descriptions[mesh->type];
    const size_t per_element = (size_t)description->n_sides;
    const int32_t *element = &mesh->connectivity[side / per_element * (size_t)mesh->nodes_per_element];
    const int *local = description->sides[side % per_element];
    key->side = side;
    for (int n = 0; n < 4; n++) {
        int32_t node = n < pieces[description->side].corners ? element[local[n]] : -1;
        int at = n;
        for (; at > 0 && key->nodes[at - 1] > node; at--)
            key->nodes[at] = key->nodes[at - 1];
        key->nodes[at] = node;
    }
}

/** Mark the sides that belong to one element only. */
static int mark_outer(const struct mesh *mesh, size_t n_sides, bool *outer)
{
    struct side_key *keys = memory_create(n_sides, sizeof *keys);
    CHECK_MEMORY(keys);
    for (size_t f = 0; f < n_sides; f++)
        fill_key(mesh, f, &keys[f]);
    qsort(keys, n_sides, sizeof *keys, compare_keys);
    for (size_t f = 0; f < n_sides; f++) {
        const bool shared = (f > 0 && !compare_nodes(&keys[f], &keys[f - 1])) ||
                            (f + 1 < n_sides && !compare_nodes(&keys[f], &keys[f + 1]));
        outer[keys[f].side] = !shared;
    }
    memory_free(keys);
    return 0;
}

/** Append the pieces of one side. */
static void add_pieces(const int32_t *nodes, int n, const struct side_pieces *cut, struct facets *skin)
{
    for (int p = 0; p < cut->n; p++) {
        for (int k = 0; k < 4; k++)
            skin->nodes[skin->n_facets][k] = cut->nodes[p][k] < 0 ? -1 : nodes[cut->nodes[p][k]];
        for (int k = 0; skin->sides && k < SIDE_MAX_NODES; k++)
            skin->sides[skin->n_facets][k] = k < n ? nodes[k] : -1;
        skin->n_facets++;
    }
}

/** Of the sides of all elements, unmark those all of whose nodes lie in the set. */
static void exclude_sides(const struct mesh *mesh, const struct node_set *set, bool *in_set, bool *outer)
{
    const struct element_description *description = &descriptions[mesh->type];
    const int n = element_nodes(description->side);
    memset(in_set, 0, mesh->n_nodes * sizeof *in_set);
    for (size_t i = 0; i < set->n; i++)
        in_set[set->nodes[i]] = true;
    for (size_t e = 0; e < mesh->n_elements; e++)
        for (int f = 0; f < description->n_sides; f++) {
            const int32_t *nodes = &mesh->connectivity[e * (size_t)mesh->nodes_per_element];
            bool all = true;
            for (int k = 0; k < n && all; k++)
                all = in_set[nodes[description->sides[f][k]]];
            if (all)
                outer[e * (size_t)description->n_sides + (size_t)f] = false;
        }
}

/** Write the marked sides in the order of the elements. */
static void collect_skin(const struct mesh *mesh, const bool *outer, struct facets *skin)
{
    const struct element_description *description = &descriptions[mesh->type];
    const int n = element_nodes(description->side);
    for (size_t e = 0; e < mesh->n_elements; e++)
        for (int f = 0; f < description->n_sides; f++) {
            if (!outer[e * (size_t)description->n_sides + (size_t)f])
                continue;
            int32_t nodes[SIDE_MAX_NODES];
            for (int k = 0; k < n; k++)
                nodes[k] = mesh->connectivity[e * (size_t)mesh->nodes_per_element +
                                              (size_t)description->sides[f][k]];
            add_pieces(nodes, n, &pieces[description->side], skin);
        }
}

int mesh_skin(const struct mesh *mesh, const int *excluded, size_t n_excluded, struct facets *skin)
{
    *skin = (struct facets){.dim = mesh->dim, .n_points = mesh->n_nodes};
    const struct element_description *description = &descriptions[mesh->type];
    CHECK(description->n_sides > 0, STATUS_DECK,
          "a mesh of %s elements has no skin; give the surface by facets of its own",
          element_name(mesh->type));
    const size_t n_sides = mesh->n_elements * (size_t)description->n_sides,
                 n_facets = n_sides * (size_t)pieces[description->side].n;
    const bool curved = element_is_quadratic(mesh->type);
    bool *outer = memory_create(n_sides, sizeof *outer);
    bool *in_set = memory_create(mesh->n_nodes, sizeof *in_set);
    skin->points = memory_create(mesh->n_nodes, sizeof *skin->points);
    skin->nodes = memory_create(n_facets, sizeof *skin->nodes);
    skin->sides = curved ? memory_create(n_facets, sizeof *skin->sides) : NULL;
    int status = outer && in_set && skin->points && skin->nodes && (skin->sides || !curved)
                     ? mark_outer(mesh, n_sides, outer)
                     : STATUS_MEMORY;
    if (!status) {
        memcpy(skin->points, mesh->X, mesh->n_nodes * sizeof *mesh->X);
        for (size_t s = 0; s < n_excluded; s++)
            exclude_sides(mesh, &mesh->sets[excluded[s]], in_set, outer);
        collect_skin(mesh, outer, skin);
    } else {
        facets_reset(skin);
    }
    memory_free(outer);
    memory_free(in_set);
    return status;
}

void facets_reset(struct facets *facets)
{
    memory_free(facets->points);
    memory_free(facets->nodes);
    memory_free(facets->sides);
    *facets = (struct facets){0};
}

void mesh_centre(const struct mesh *mesh, size_t e, double centre[3])
{
    const int n = mesh->nodes_per_element;
    memset(centre, 0, 3 * sizeof *centre);
    for (int a = 0; a < n; a++)
        for (int d = 0; d < 3; d++)
            centre[d] += mesh->X[mesh->connectivity[e * (size_t)n + (size_t)a]][d] / n;
}

/** Sets by the new numbers of their nodes (-1: gone). */
static void renumber_sets(struct mesh *mesh, const int32_t *numbers)
{
    size_t n_sets = 0;
    for (size_t s = 0; s < mesh->n_sets; s++) {
        struct node_set *set = &mesh->sets[s];
        size_t n = 0;
        for (size_t i = 0; i < set->n; i++)
            if (numbers[set->nodes[i]] >= 0)
                set->nodes[n++] = numbers[set->nodes[i]];
        set->n = n;
        if (n > 0) {
            mesh->sets[n_sets++] = *set;
        } else {
            memory_free(set->name);
            memory_free(set->nodes);
        }
    }
    mesh->n_sets = n_sets;
}

int mesh_leave_out(struct mesh *mesh, const bool *left_out)
{
    const size_t columns = (size_t)mesh->nodes_per_element;
    int32_t *numbers = memory_create(mesh->n_nodes, sizeof *numbers);
    CHECK_MEMORY(numbers);
    size_t n = 0;
    for (size_t i = 0; i < mesh->n_nodes; i++)
        numbers[i] = -1;
    for (size_t e = 0; e < mesh->n_elements; e++) {
        const int32_t *nodes = mesh->connectivity + e * columns;
        if (left_out[e])
            continue;
        for (size_t a = 0; a < columns; a++)
            numbers[nodes[a]] = 0;
        memmove(mesh->connectivity + n++ * columns, nodes, columns * sizeof *nodes);
    }
    mesh->n_elements = n;
    n = 0;
    for (size_t i = 0; i < mesh->n_nodes; i++)
        if (numbers[i] == 0) {
            memmove(mesh->X[n], mesh->X[i], sizeof *mesh->X);
            numbers[i] = (int32_t)n++;
        }
    mesh->n_nodes = n;
    for (size_t k = 0; k < mesh->n_elements * columns; k++)
        mesh->connectivity[k] = numbers[mesh->connectivity[k]];
    renumber_sets(mesh, numbers);
    memory_free(numbers);
    return 0;
}

void mesh_reset(struct mesh *mesh)
{
    memory_free(mesh->X);
    memory_free(mesh->connectivity);
    for (size_t s = 0; s < mesh->n_sets; s++) {
        memory_free(mesh->sets[s].name);
        memory_free(mesh->sets[s].nodes);
    }
    memory_free(mesh->sets);
    *mesh = (struct mesh){0};
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/mesh.h"

#include "base/error.h"
#include "base/memory.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/** What an element type is; faces are listed with the normal out of the element, struct facets' orientation.
 */
struct element_description {
    const char *name;
    int dim, nodes, vtk;
    int n_faces, nodes_per_face;
    int faces[6][4];
};

static const struct element_description descriptions[ELEMENT_TYPES] = {
    [ELEMENT_LINE2] = {.name = "line2", .dim = 1, .nodes = 2, .vtk = 3},
    [ELEMENT_TRI3] = {.name = "tri3",
                      .dim = 2,
                      .nodes = 3,
                      .vtk = 5,
                      .n_faces = 3,
                      .nodes_per_face = 2,
                      .faces = {{0, 1, -1, -1}, {1, 2, -1, -1}, {2, 0, -1, -1}}},
    [ELEMENT_QUAD4] = {.name = "quad4",
                       .dim = 2,
                       .nodes = 4,
                       .vtk = 9,
                       .n_faces = 4,
                       .nodes_per_face = 2,
                       .faces = {{0, 1, -1, -1}, {1, 2, -1, -1}, {2, 3, -1, -1}, {3, 0, -1, -1}}},
    [ELEMENT_TET4] = {.name = "tet4",
                      .dim = 3,
                      .nodes = 4,
                      .vtk = 10,
                      .n_faces = 4,
                      .nodes_per_face = 3,
                      .faces = {{0, 2, 1, -1}, {0, 1, 3, -1}, {1, 2, 3, -1}, {0, 3, 2, -1}}},
    [ELEMENT_HEX8] =
        {.name = "hex8",
         .dim = 3,
         .nodes = 8,
         .vtk = 12,
         .n_faces = 6,
         .nodes_per_face = 4,
         .faces = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}},
};

/** Corners of quad4 (first four) and hex8 in natural coordinates. */
static const double corners[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                     {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};

/** A face of an element with its nodes in ascending order, to find the faces that occur only once. */
struct face_key {
    int32_t nodes[4];
    size_t face; /**< element * faces per element + face */
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

/** N = product of (1 + s_d xi_d) / 2 over the dimensions. */
static void shape_tensor_product(int dim, int nodes, const double xi[3], double *N, double (*dN)[3])
{
    for (int n = 0; n < nodes; n++) {
        double factor[3] = {1, 1, 1};
        for (int d = 0; d < dim; d++)
            factor[d] = 0.5 * (1 + corners[n][d] * xi[d]);
        N[n] = factor[0] * factor[1] * factor[2];
        if (!dN)
            continue;
        for (int d = 0; d < 3; d++)
            dN[n][d] = d < dim ? 0.5 * corners[n][d] * factor[(d + 1) % 3] * factor[(d + 2) % 3] : 0;
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

void element_shape(enum element_type type, const double xi[3], double *N, double (*dN)[3])
{
    const struct element_description *description = &descriptions[type];
    if (type == ELEMENT_TRI3 || type == ELEMENT_TET4)
        shape_simplex(description->dim, xi, N, dN);
    else
        shape_tensor_product(description->dim, description->nodes, xi, N, dN);
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
                for (int c = 0; c < mesh->nodes_per_element; c++)
                    *row++ = (int32_t)(i + (corners[c][0] > 0) +
                                       n[0] * (j + (corners[c][1] > 0) +
                                               n[1] * (k + (mesh->dim == 3 && corners[c][2] > 0))));
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

static int compare_nodes(const struct face_key *a, const struct face_key *b)
{
    for (int n = 0; n < 4; n++)
        if (a->nodes[n] != b->nodes[n])
            return a->nodes[n] < b->nodes[n] ? -1 : 1;
    return 0;
}

static int compare_keys(const void *a, const void *b)
{
    const struct face_key *p = a, *q = b;
    const int by_nodes = compare_nodes(p, q);
    return by_nodes ? by_nodes : (p->face > q->face) - (p->face < q->face);
}

static void fill_key(const struct mesh *mesh, size_t face, struct face_key *key)
{
    const struct element_description *description = &descriptions[mesh->type];
    const size_t per_element = (size_t)description->n_faces;
    const int32_t *element = &mesh->connectivity[face / per_element * (size_t)mesh->nodes_per_element];
    const int *local = description->faces[face % per_element];
    key->face = face;
    for (int n = 0; n < 4; n++) {
        int32_t node = local[n] < 0 ? -1 : element[local[n]];
        int at = n;
        for (; at > 0 && key->nodes[at - 1] > node; at--)
            key->nodes[at] = key->nodes[at - 1];
        key->nodes[at] = node;
    }
}

/** Mark the faces that belong to one element only. */
static int mark_outer(const struct mesh *mesh, size_t n_faces, bool *outer)
{
    struct face_key *keys = memory_create(n_faces, sizeof *keys);
    CHECK_MEMORY(keys);
    for (size_t f = 0; f < n_faces; f++)
        fill_key(mesh, f, &keys[f]);
    qsort(keys, n_faces, sizeof *keys, compare_keys);
    for (size_t f = 0; f < n_faces; f++) {
        const bool shared = (f > 0 && !compare_nodes(&keys[f], &keys[f - 1])) ||
                            (f + 1 < n_faces && !compare_nodes(&keys[f], &keys[f + 1]));
        outer[keys[f].face] = !shared;
    }
    memory_free(keys);
    return 0;
}

/** Write the outer faces in the order of the elements. */
static void collect_skin(const struct mesh *mesh, const bool *outer, const bool *excluded,
                         struct facets *skin)
{
    const struct element_description *description = &descriptions[mesh->type];
    for (size_t e = 0; e < mesh->n_elements; e++)
        for (int f = 0; f < description->n_faces; f++) {
            if (!outer[e * (size_t)description->n_faces + (size_t)f])
                continue;
            int32_t *nodes = skin->nodes[skin->n_facets];
            bool drop = true;
            for (int n = 0; n < 4; n++) {
                const int local = description->faces[f][n];
                nodes[n] =
                    local < 0 ? -1 : mesh->connectivity[e * (size_t)mesh->nodes_per_element + (size_t)local];
                drop = drop && (local < 0 || excluded[nodes[n]]);
            }
            skin->n_facets += !drop;
        }
}

int mesh_skin(const struct mesh *mesh, const struct node_set *exclude, struct facets *skin)
{
    *skin = (struct facets){.dim = mesh->dim, .n_points = mesh->n_nodes};
    CHECK(descriptions[mesh->type].n_faces > 0, STATUS_DECK,
          "a mesh of %s elements has no skin; give the surface by facets of its own",
          element_name(mesh->type));
    const size_t n_faces = mesh->n_elements * (size_t)descriptions[mesh->type].n_faces;
    bool *outer = memory_create(n_faces, sizeof *outer);
    bool *excluded = memory_create(mesh->n_nodes, sizeof *excluded);
    skin->points = memory_create(mesh->n_nodes, sizeof *skin->points);
    skin->nodes = memory_create(n_faces, sizeof *skin->nodes);
    int status =
        outer && excluded && skin->points && skin->nodes ? mark_outer(mesh, n_faces, outer) : STATUS_MEMORY;
    if (!status) {
        memcpy(skin->points, mesh->X, mesh->n_nodes * sizeof *mesh->X);
        for (size_t n = 0; exclude && n < exclude->n; n++)
            excluded[exclude->nodes[n]] = true;
        collect_skin(mesh, outer, excluded, skin);
    } else {
        facets_reset(skin);
    }
    memory_free(outer);
    memory_free(excluded);
    return status;
}

void facets_reset(struct facets *facets)
{
    memory_free(facets->points);
    memory_free(facets->nodes);
    *facets = (struct facets){0};
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

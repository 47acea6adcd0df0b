// SPDX-License-Identifier: GPL-3.0-or-later
// Section <meshes>.
#include "deck/deck_node.h"

#include "base/error.h"
#include "base/memory.h"

#include <limits.h>
#include <math.h>
#include <string.h>

enum { DISC_CELLS = 20000 }; // across: nodes of quad9 stay below 2^31

static const double set_tolerance = 1e-6; // of the mesh's diagonal: how far a box of a node set is widened

/** ELEMENT_TYPES: none, which has been noted. */
static enum element_type element_type_of(struct deck *deck, const struct deck_node *node)
{
    const char *name = deck_get(deck, node, "type");
    enum element_type type = 0;
    while (type < ELEMENT_TYPES && (!name || strcmp(element_name(type), name) != 0))
        type++;
    return type;
}

/** A solid's elements fill space. */
static void check_dimension(struct deck *deck, const struct deck_node *node, enum element_type type)
{
    const int dim = deck->model->dim;
    if (element_dim(type) != dim)
        deck_error(deck, node, "type", "%s elements do not fill %d-D space; use %s", element_name(type), dim,
                   dim == 2 ? "quad4, quad8, quad9, tri3 or tri6" : "hex8, hex20, hex27, tet4 or tet10");
}

/** Mark the elements whose centres lie in a shape of the hole @p node. */
static int read_hole(struct deck *deck, const struct deck_node *node, const struct mesh *mesh, bool *left_out)
{
    for (const struct deck_node *child = node->children; child; child = child->next) {
        struct shape shape = {0};
        const size_t before = deck->n_problems;
        size_t n = 0;
        int status = deck_read_shape(deck, child, &shape);
        for (size_t e = 0; !status && deck->n_problems == before && e < mesh->n_elements; e++) {
            double centre[3];
            mesh_centre(mesh, e, centre);
            if (shape_distance(&shape, mesh->dim, centre) < 0.0) {
                left_out[e] = true;
                n++;
            }
        }
        shape_reset(&shape);
        CALL(status);
        if (deck->n_problems == before && n == 0)
            deck_error(deck, child, NULL, "no element of the grid has its centre in here");
    }
    return 0;
}

static int read_holes(struct deck *deck, const struct deck_node *grid, struct mesh *mesh)
{
    const size_t before = deck->n_problems;
    bool *left_out = memory_create(mesh->n_elements, sizeof *left_out);
    CHECK_MEMORY(left_out);
    int status = 0;
    for (const struct deck_node *hole = deck_child(grid, SCHEMA_HOLE); hole && !status;
         hole = deck_next(hole))
        status = read_hole(deck, hole, mesh, left_out);
    size_t left = 0;
    for (size_t e = 0; e < mesh->n_elements; e++)
        left += !left_out[e];
    if (left == 0 && !status)
        deck_error(deck, grid, NULL, "its holes leave none of its %zu elements", mesh->n_elements);
    if (deck->n_problems == before && !status && left < mesh->n_elements)
        status = mesh_leave_out(mesh, left_out);
    memory_free(left_out);
    return status;
}

static void read_grid(struct deck *deck, const struct deck_node *node, struct mesh *mesh)
{
    const enum element_type type = deck_has(node, "type")  ? element_type_of(deck, node)
                                   : deck->model->dim == 3 ? ELEMENT_HEX8
                                                           : ELEMENT_QUAD4;
    double lower[3], upper[3], nodes = 1.0;
    int cells[3];
    if (type == ELEMENT_TYPES) { // noted already
        deck->n_problems++;
        return;
    }
    size_t before = deck->n_problems;
    check_dimension(deck, node, type);
    deck_vector(deck, node, "lower", lower);
    deck_vector(deck, node, "upper", upper);
    deck_cells(deck, node, "cells", cells);
    for (int d = 0; d < deck->model->dim && deck->n_problems == before; d++) {
        nodes *= (element_is_quadratic(type) ? 2.0 : 1.0) * cells[d] + 1.0;
        if (!(lower[d] < upper[d]))
            deck_error(deck, node, "upper",
                       "upper corner %.9g is not above lower corner %.9g in direction %c", upper[d], lower[d],
                       "xyz"[d]);
    }
    if (deck->n_problems == before && nodes > INT_MAX)
        deck_error(deck, node, "cells", "%.3g nodes are more than 2147483647", nodes);
    if (deck->n_problems > before)
        return;
    int status = mesh_create_grid(mesh, deck->model->dim, lower, upper, cells);
    if (!status && deck_child(node, SCHEMA_HOLE))
        status = read_holes(deck, node, mesh);
    if (!status && type != mesh->type && deck->n_problems == before)
        status = mesh_convert(mesh, type);
    if (status)
        deck->status = status;
}

static void read_disc(struct deck *deck, const struct deck_node *node, struct mesh *mesh)
{
    static const enum element_type types[] = {ELEMENT_QUAD4, ELEMENT_QUAD8, ELEMENT_QUAD9};
    const int type = deck_choice(deck, node, "type");
    double centre[3];
    size_t before = deck->n_problems;
    deck_need_dim(deck, node, 2, "<grid>, or <nodes> and <elements>");
    deck_vector(deck, node, "centre", centre);
    const double radius = deck_real(deck, node, "radius");
    const int cells = deck_integer(deck, node, "cells");
    if (deck->n_problems == before && cells < 2)
        deck_error(deck, node, "cells", "a disc of %d element%s across cannot be round; use 2 or more", cells,
                   cells == 1 ? "" : "s");
    if (deck->n_problems == before && cells > DISC_CELLS)
        deck_error(deck, node, "cells", "%d elements across are more than %d", cells, DISC_CELLS);
    if (deck->n_problems > before || type < 0)
        return;
    int status = mesh_create_disc(mesh, types[type], centre, radius, cells);
    if (status)
        deck->status = status;
}

/** Rows of node numbers, each from 0 to n_nodes - 1. NULL after noting a mistake. */
static int32_t *read_connectivity(struct deck *deck, const struct deck_node *node, size_t columns,
                                  size_t n_nodes, size_t *n)
{
    double *values = NULL;
    size_t before = deck->n_problems;
    *n = deck_numbers(deck, node, node->text, columns, &values);
    int32_t *numbers = deck->n_problems == before ? deck_memory(deck, *n * columns, sizeof *numbers) : NULL;
    for (size_t i = 0; numbers && i < *n * columns; i++) {
        if (!(values[i] >= 0.0 && values[i] < (double)n_nodes) || values[i] != floor(values[i])) {
            deck_error(deck, node, NULL, "element %zu: %.9g is no node; nodes are numbered from 0 to %zu",
                       i / columns, values[i], n_nodes - 1);
            memory_free(numbers);
            numbers = NULL;
        } else {
            numbers[i] = (int32_t)values[i];
        }
    }
    memory_free(values);
    return numbers;
}

/** Rows of dim coordinates as rows of 3. NULL after noting a mistake. */
static double (*read_nodes(struct deck *deck, const struct deck_node *node, size_t *n))[3]
{
    const size_t dim = (size_t)deck->model->dim;
    double *values = NULL;
    size_t before = deck->n_problems;
    *n = deck_numbers(deck, node, node->text, dim, &values);
    double(*points)[3] = deck->n_problems == before ? deck_memory(deck, *n, sizeof *points) : NULL;
    for (size_t i = 0; points && i < *n; i++)
        memcpy(points[i], values + i * dim, dim * sizeof *values);
    memory_free(values);
    return points;
}

/** Whether the map from natural coordinates keeps its orientation at the element's centre, and at the nodes
 * of a quadratic one, whose edges may fold back. */
static bool element_is_proper(const struct mesh *mesh, size_t e)
{
    const double third = element_is_simplex(mesh->type) ? 0.25 : 0.0, centre[3] = {third, third, third};
    bool proper = mesh_jacobian(mesh, e, centre) > 0.0;
    for (int a = 0; element_is_quadratic(mesh->type) && a < mesh->nodes_per_element; a++) {
        double xi[3];
        element_node(mesh->type, a, xi);
        proper = proper && mesh_jacobian(mesh, e, xi) > 0.0;
    }
    return proper;
}

static void read_inline(struct deck *deck, const struct deck_node *node, struct mesh *mesh)
{
    const struct deck_node *nodes = deck_child(node, SCHEMA_NODES),
                           *elements = deck_child(node, SCHEMA_ELEMENTS);
    mesh->dim = deck->model->dim;
    mesh->type = element_type_of(deck, elements);
    if (mesh->type == ELEMENT_TYPES) { // noted already
        deck->n_problems++;
        return;
    }
    mesh->nodes_per_element = element_nodes(mesh->type);
    size_t before = deck->n_problems;
    check_dimension(deck, elements, mesh->type);
    if (deck->n_problems > before)
        return;
    mesh->X = read_nodes(deck, nodes, &mesh->n_nodes);
    if (mesh->X)
        mesh->connectivity = read_connectivity(deck, elements, (size_t)mesh->nodes_per_element, mesh->n_nodes,
                                               &mesh->n_elements);
    for (size_t e = 0; mesh->connectivity && e < mesh->n_elements; e++)
        if (!element_is_proper(mesh, e)) {
            deck_error(deck, elements, NULL,
                       "element %zu is inside out or flat: its nodes go counter-clockwise (VTK order)%s", e,
                       element_is_quadratic(mesh->type) ? ", those of an edge near its middle" : "");
            return;
        }
}

static void add_set_of_nodes(struct deck *deck, const struct deck_node *node, struct mesh *mesh)
{
    long *numbers = NULL;
    size_t n = deck_integers(deck, node, "nodes", &numbers), room = mesh->n_sets;
    if (deck->status || memory_grow((void **)&mesh->sets, &room, mesh->n_sets + 1, sizeof *mesh->sets)) {
        deck->status = STATUS_MEMORY;
        memory_free(numbers);
        return;
    }
    struct node_set *set = &mesh->sets[mesh->n_sets++];
    *set = (struct node_set){.name = deck_word(deck, node, "name"),
                             .nodes = deck_memory(deck, n, sizeof *set->nodes)};
    for (size_t i = 0; set->nodes && i < n; i++) {
        if (numbers[i] < 0 || (size_t)numbers[i] >= mesh->n_nodes)
            deck_error(deck, node, "nodes", "there is no node %ld; nodes are numbered from 0 to %zu",
                       numbers[i], mesh->n_nodes - 1);
        else
            set->nodes[set->n++] = (int32_t)numbers[i];
    }
    memory_free(numbers);
}

static void read_set(struct deck *deck, const struct deck_node *node, struct mesh *mesh)
{
    const struct deck_node *box = deck_child(node, SCHEMA_BOX);
    double lower[3], upper[3], diagonal = 0.0;
    if (!deck_get(deck, node, "name"))
        return;
    if ((box != NULL) == deck_has(node, "nodes")) {
        deck_error(deck, node, "nodes", "takes either the attribute \"nodes\" or a <box>");
        return;
    }
    if (mesh_find_set(mesh, deck_text(node, "name"))) {
        deck_error(deck, node, "name",
                   "the mesh has such a set already; a grid makes x- x+ y- y+ (z- z+), a disc rim");
        return;
    }
    if (!box) {
        add_set_of_nodes(deck, node, mesh);
        return;
    }
    size_t before = deck->n_problems;
    deck_vector(deck, box, "lower", lower);
    deck_vector(deck, box, "upper", upper);
    for (int d = 0; d < mesh->dim; d++) {
        double least = INFINITY, most = -INFINITY;
        for (size_t i = 0; i < mesh->n_nodes; i++) {
            least = fmin(least, mesh->X[i][d]);
            most = fmax(most, mesh->X[i][d]);
        }
        diagonal = hypot(diagonal, most - least);
    }
    if (deck->n_problems > before)
        return;
    int status = mesh_add_set_box(mesh, deck_text(node, "name"), lower, upper, set_tolerance * diagonal);
    if (status == STATUS_DECK)
        deck_error(deck, box, NULL, "no node of the mesh lies in the box");
    else if (status)
        deck->status = status;
}

static int read_supports(struct deck *deck, const struct deck_node *node, struct model_mesh *definition)
{
    struct mesh *mesh = &definition->mesh;
    CHECK_MEMORY(definition->supports =
                     memory_create(deck_count(node, SCHEMA_SUPPORT), sizeof *definition->supports));
    for (const struct deck_node *child = deck_child(node, SCHEMA_SUPPORT); child; child = deck_next(child)) {
        struct model_support *support = &definition->supports[definition->n_supports++];
        support->where = child->where;
        support->set =
            deck_reference(deck, child, "set", "node set", mesh->sets, mesh->n_sets, sizeof *mesh->sets);
        deck_choices(deck, child, "fixed", support->fixed);
        deck_read_motion(deck, child, &support->motion);
        support->moves = support->motion.kind != MOTION_NONE;
        const bool fixes = support->fixed[0] || support->fixed[1] || support->fixed[2];
        if (fixes == support->moves)
            deck_error(deck, child, "fixed",
                       fixes
                           ? "a support that moves holds all directions: leave out the attribute \"fixed\""
                           : "says neither which directions are fixed (fixed=\"x y\") nor how the set moves");
        for (int d = deck->model->dim; d < 3; d++)
            if (support->fixed[d])
                deck_error(deck, child, "fixed", "a %d-D deck has no direction %c", deck->model->dim,
                           "xyz"[d]);
    }
    return deck->status;
}

static int read_loads(struct deck *deck, const struct deck_node *node, struct model_mesh *definition)
{
    struct mesh *mesh = &definition->mesh;
    const struct deck_node *body = deck_child(node, SCHEMA_BODY_FORCE);
    CHECK_MEMORY(definition->loads =
                     memory_create(deck_count(node, SCHEMA_LOAD) + 1, sizeof *definition->loads));
    for (const struct deck_node *child = deck_child(node, SCHEMA_LOAD); child; child = deck_next(child)) {
        struct model_load *load = &definition->loads[definition->n_loads++];
        load->where = child->where;
        load->set =
            deck_reference(deck, child, "set", "node set", mesh->sets, mesh->n_sets, sizeof *mesh->sets);
        deck_expressions(deck, child, "force", load->force);
    }
    if (body) {
        struct model_load *load = &definition->loads[definition->n_loads++];
        load->where = body->where;
        load->set = -1;
        deck_expressions(deck, body, "value", load->force);
    }
    for (size_t l = 0; l < definition->n_loads; l++)
        for (int d = deck->model->dim; d < 3; d++)
            CHECK_MEMORY(definition->loads[l].force[d] = expression_constant(0.0));
    return deck->status;
}

static int read_mesh(struct deck *deck, const struct deck_node *node, struct model_mesh *definition)
{
    const struct deck_node *grid = deck_child(node, SCHEMA_GRID), *nodes = deck_child(node, SCHEMA_NODES);
    const struct deck_node *disc = deck_child(node, SCHEMA_DISC_MESH);
    const struct deck_node *elements = deck_child(node, SCHEMA_ELEMENTS),
                           *initial = deck_child(node, SCHEMA_INITIAL);
    struct model *model = deck->model;
    definition->where = node->where;
    definition->name = deck_word(deck, node, "name");
    definition->material = deck_reference(deck, node, "material", "material", model->solid_materials,
                                          model->n_solid_materials, sizeof *model->solid_materials);
    const enum solid_formulation formulations[] = {SOLID_FULL, SOLID_F_BAR, SOLID_EAS};
    const int formulation = deck_choice(deck, node, "formulation");
    definition->formulation = formulation < 0 ? SOLID_FULL : formulations[formulation];
    definition->rho_infinity = deck_real(deck, node, "rho-infinity");
    definition->newton_tolerance = deck_real(deck, node, "newton-tolerance");
    deck_read_rigid(deck, node, definition);
    size_t before = deck->n_problems;
    if (model->dim == 1)
        deck_error(deck, node, NULL, "meshes need a 2-D or 3-D deck");
    else if ((grid || disc) && (nodes || elements))
        deck_error(deck, grid ? grid : disc, NULL,
                   "stands beside <nodes> or <elements>; a mesh is one or the other");
    else if (grid && disc)
        deck_error(deck, disc, NULL, "stands beside a <grid>; a mesh is one or the other");
    else if (grid)
        read_grid(deck, grid, &definition->mesh);
    else if (disc)
        read_disc(deck, disc, &definition->mesh);
    else if (nodes && elements)
        read_inline(deck, node, &definition->mesh);
    else
        deck_error(deck, node, NULL, "needs a <grid>, a <disc>, or <nodes> and <elements>");
    if (deck->n_problems > before || deck->status)
        return deck->status;
    for (const struct deck_node *set = deck_child(node, SCHEMA_SET); set; set = deck_next(set))
        read_set(deck, set, &definition->mesh);
    CALL(read_supports(deck, node, definition));
    CALL(read_loads(deck, node, definition));
    if (initial) {
        deck_expressions(deck, initial, "displacement", definition->displacement);
        deck_expressions(deck, initial, "velocity", definition->velocity);
    }
    return deck->status;
}

int deck_read_meshes(struct deck *deck)
{
    const struct deck_node *section = deck_child(deck->root, SCHEMA_MESHES);
    struct model *model = deck->model;
    CHECK_MEMORY(model->meshes = memory_create(deck_count(section, SCHEMA_MESH), sizeof *model->meshes));
    for (const struct deck_node *node = deck_child(section, SCHEMA_MESH); node; node = deck_next(node))
        CALL(read_mesh(deck, node, &model->meshes[model->n_meshes++]));
    return deck->status;
}

void deck_read_facets(struct deck *deck, const struct deck_node *node, struct facets *facets)
{
    const struct deck_node *nodes = deck_child(node, SCHEMA_NODES),
                           *elements = deck_child(node, SCHEMA_ELEMENTS);
    const enum element_type type = nodes && elements ? element_type_of(deck, elements) : ELEMENT_TYPES;
    if (type == ELEMENT_TYPES) {
        deck->n_problems++;
        return;
    }
    const int dim = deck->model->dim, corners = element_nodes(type);
    if (element_dim(type) != dim - 1 || element_is_quadratic(type)) {
        deck_error(deck, elements, "type", "facets of a %d-D deck are %s", dim,
                   dim == 2   ? "line2"
                   : dim == 3 ? "tri3 or quad4"
                              : "not possible: use <plane>");
        return;
    }
    facets->dim = dim;
    facets->points = read_nodes(deck, nodes, &facets->n_points);
    int32_t *numbers = facets->points ? read_connectivity(deck, elements, (size_t)corners, facets->n_points,
                                                          &facets->n_facets)
                                      : NULL;
    facets->nodes = numbers ? deck_memory(deck, facets->n_facets, sizeof *facets->nodes) : NULL;
    if (!facets->nodes)
        facets->n_facets = 0;
    for (size_t f = 0; f < facets->n_facets; f++)
        for (int k = 0; k < 4; k++)
            facets->nodes[f][k] = k < corners ? numbers[f * (size_t)corners + (size_t)k] : -1;
    memory_free(numbers);
}

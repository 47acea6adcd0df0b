// SPDX-License-Identifier: GPL-3.0-or-later
// clang-format off
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>
// clang-format on

#include "base/error.h"
#include "base/memory.h"
#include "model/mesh.h"

#include <math.h>
#include <string.h>

static const double lower[3] = {0.24899, 0.19, -0.3}, upper[3] = {0.6, 0.21, 0.1};

static void test_grid_2d(void **state)
{
    (void)state;
    struct mesh mesh;
    assert_int_equal(mesh_create_grid(&mesh, 2, lower, upper, (const int[3]){35, 3, 9}), 0);
    assert_int_equal(mesh.n_nodes, 36 * 4);
    assert_int_equal(mesh.n_elements, 105);
    assert_int_equal(mesh.type, ELEMENT_QUAD4);
    assert_true(mesh.X[35][0] == 0.6 && mesh.X[143][1] == 0.21 && mesh.X[143][2] == 0);
    assert_true(fabs(mesh.X[1][0] - (0.24899 + 0.35101 / 35)) < 1e-16);
    const int32_t second_row[4] = {36, 37, 73, 72}; /* element 35: first of the second row */
    assert_memory_equal(&mesh.connectivity[35 * 4], second_row, sizeof second_row);
    const struct node_set *right = mesh_find_set(&mesh, "x+");
    assert_non_null(right);
    assert_int_equal(right->n, 4);
    assert_int_equal(right->nodes[2], 107);
    assert_int_equal(mesh_find_set(&mesh, "y-")->n, 36);
    assert_null(mesh_find_set(&mesh, "z-"));
    mesh_reset(&mesh);
}

static void test_grid_refuses(void **state)
{
    (void)state;
    struct mesh mesh;
    assert_int_equal(mesh_create_grid(&mesh, 1, lower, upper, (const int[3]){3, 3, 3}), STATUS_DECK);
    assert_int_equal(mesh_create_grid(&mesh, 2, lower, upper, (const int[3]){3, 0, 3}), STATUS_DECK);
    assert_int_equal(mesh_create_grid(&mesh, 2, upper, lower, (const int[3]){3, 3, 3}), STATUS_DECK);
    assert_int_equal(mesh_create_grid(&mesh, 3, lower, upper, (const int[3]){60000, 60000, 9}), STATUS_DECK);
}

/** Sum of the area vectors of a mesh's skin; returns the volume inside (divergence theorem). */
static double skin_volume(const struct facets *skin, double area[3])
{
    double volume = 0.0;
    memset(area, 0, 3 * sizeof *area);
    for (size_t f = 0; f < skin->n_facets; f++) {
        const double *a = skin->points[skin->nodes[f][0]], *b = skin->points[skin->nodes[f][1]];
        const double *last = skin->dim == 2 ? b : skin->points[skin->nodes[f][2]];
        double normal[3] = {b[1] - a[1], a[0] - b[0], 0};
        if (skin->dim == 3) {
            const double *d = skin->points[skin->nodes[f][3]];
            for (int i = 0; i < 3; i++) {
                const int j = (i + 1) % 3, k = (i + 2) % 3;
                normal[i] = 0.5 * ((last[j] - a[j]) * (d[k] - b[k]) - (last[k] - a[k]) * (d[j] - b[j]));
            }
        } else {
            assert_int_equal(skin->nodes[f][2], -1);
        }
        for (int i = 0; i < skin->dim; i++) {
            area[i] += normal[i];
            volume += normal[i] * 0.5 * (a[i] + last[i]) / skin->dim;
        }
    }
    return volume;
}

/** A frame: 5 x 4 (x 3) cells without all those that lie inside, and without the upper right corner. */
static void test_left_out(void **state)
{
    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        struct mesh mesh;
        const int cells[3] = {5, 4, 3};
        const double size[3] = {0.5, 0.8, 0.9}, low[3] = {0.3, -0.1, 0.2};
        const double high[3] = {low[0] + size[0], low[1] + size[1], low[2] + size[2]};
        assert_int_equal(mesh_create_grid(&mesh, dim, low, high, cells), 0);
        bool left_out[5 * 4 * 3] = {0};
        double volume = 0.0;
        size_t n = 0;
        for (size_t e = 0; e < mesh.n_elements; e++) {
            const size_t i = e % 5, j = e / 5 % 4, k = e / 20;
            const bool inside = i > 0 && i < 4 && j > 0 && j < 3 && (dim == 2 || k == 1);
            left_out[e] = inside || (i == 4 && j == 3 && k == (size_t)(dim - 2) * 2);
            n += !left_out[e];
            volume += left_out[e] ? 0.0 : 0.1 * 0.2 * (dim == 3 ? 0.3 : 1.0);
        }
        assert_int_equal(mesh_leave_out(&mesh, left_out), 0);
        assert_int_equal(mesh.n_elements, n);
        /* only the corner's node has no element left: 6 x 5 (x 4), where the frame keeps those inside */
        assert_int_equal(mesh.n_nodes, (dim == 3 ? 120 : 30) - (dim == 3 ? 1 : 2 + 1));
        assert_int_equal(mesh_find_set(&mesh, "y+")->n, dim == 3 ? 23 : 5);
        const struct node_set *right = mesh_find_set(&mesh, "x+");
        for (size_t s = 0; s < right->n; s++)
            assert_true(fabs(mesh.X[right->nodes[s]][0] - high[0]) < 1e-15);
        struct facets skin;
        double centre[3], area[3];
        mesh_centre(&mesh, 0, centre);
        assert_true(fabs(centre[0] - (low[0] + 0.05)) < 1e-15 && fabs(centre[1] - (low[1] + 0.1)) < 1e-15);
        assert_int_equal(mesh_skin(&mesh, NULL, 0, &skin), 0);
        assert_true(fabs(skin_volume(&skin, area) - volume) < 1e-14);
        for (int d = 0; d < dim; d++)
            assert_true(fabs(area[d]) < 1e-14);
        facets_reset(&skin);
        mesh_reset(&mesh);
    }
}

/** Sets without a node that is left vanish. */
static void test_left_out_set(void **state)
{
    (void)state;
    struct mesh mesh;
    const bool left_out[2] = {true, false};
    assert_int_equal(mesh_create_grid(&mesh, 2, lower, upper, (const int[3]){2, 1, 1}), 0);
    assert_int_equal(mesh_leave_out(&mesh, left_out), 0);
    assert_int_equal(mesh.n_nodes, 4);
    assert_null(mesh_find_set(&mesh, "x-"));
    assert_int_equal(mesh_find_set(&mesh, "y+")->n, 2);
    assert_true(mesh_jacobian(&mesh, 0, (const double[3]){0}) > 0.0);
    mesh_reset(&mesh);
}

static void test_sets(void **state)
{
    (void)state;
    struct mesh mesh;
    const int cells[3] = {5, 2, 0};
    assert_int_equal(mesh_create_grid(&mesh, 2, lower, upper, cells), 0);
    const double at = 0.24899 + 1e-7;
    const double low[3] = {at, 0.19, 0}, high[3] = {at, 0.21, 0};
    assert_int_equal(mesh_add_set_box(&mesh, "root", low, high, 1e-8), STATUS_DECK);
    assert_null(mesh_find_set(&mesh, "root"));
    assert_int_equal(mesh_add_set_box(&mesh, "root", low, high, 1e-6), 0);
    const int32_t nodes[3] = {0, 6, 12};
    assert_int_equal(mesh_find_set(&mesh, "root")->n, 3);
    assert_memory_equal(mesh_find_set(&mesh, "root")->nodes, nodes, sizeof nodes);
    mesh_reset(&mesh);
}

/** Sum of area vectors is 0 for a closed skin, and the enclosed volume (divergence theorem) is that of the
 * box. */
static void test_skin_is_closed_and_faces_out(void **state)
{
    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        struct mesh mesh;
        struct facets skin;
        assert_int_equal(mesh_create_grid(&mesh, dim, lower, upper, (const int[3]){4, 3, 2}), 0);
        assert_int_equal(mesh_skin(&mesh, NULL, 0, &skin), 0);
        assert_int_equal(skin.n_facets, dim == 2 ? 14 : 2 * (12 + 8 + 6));
        double area[3];
        const double volume = skin_volume(&skin, area);
        for (int i = 0; i < dim; i++)
            assert_true(fabs(area[i]) < 1e-15);
        assert_true(fabs(volume - 0.35101 * 0.02 * (dim == 3 ? 0.4 : 1)) < 1e-15);
        facets_reset(&skin);
        const int sides[2] = {(int)(mesh_find_set(&mesh, "x-") - mesh.sets),
                              (int)(mesh_find_set(&mesh, "y+") - mesh.sets)};
        for (size_t n = 1; n <= 2; n++) { /* what x- and y+ share is no side of either */
            assert_int_equal(mesh_skin(&mesh, sides, n, &skin), 0);
            const size_t right = dim == 2 ? 4 : 8;
            assert_int_equal(skin.n_facets, (dim == 2 ? 11 : 2 * (12 + 8 + 6) - 6) - (n - 1) * right);
            facets_reset(&skin);
        }
        mesh_reset(&mesh);
    }
}

static void test_skin_of_tetrahedron(void **state)
{
    (void)state;
    double X[4][3] = {{0, 0, 0}, {1.3, 0, 0}, {0, 0.7, 0}, {0, 0, 0.9}};
    int32_t nodes[4] = {0, 1, 2, 3};
    const struct mesh mesh = {.dim = 3,
                              .type = ELEMENT_TET4,
                              .nodes_per_element = 4,
                              .n_nodes = 4,
                              .n_elements = 1,
                              .X = X,
                              .connectivity = nodes};
    struct facets skin;
    assert_int_equal(mesh_skin(&mesh, NULL, 0, &skin), 0);
    assert_int_equal(skin.n_facets, 4);
    double volume = 0;
    for (size_t f = 0; f < 4; f++) {
        const double *a = X[skin.nodes[f][0]], *b = X[skin.nodes[f][1]], *c = X[skin.nodes[f][2]];
        for (int i = 0; i < 3; i++) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            volume += a[i] * (b[j] * c[k] - b[k] * c[j]) / 6;
        }
    }
    assert_true(fabs(volume - 1.3 * 0.7 * 0.9 / 6) < 1e-15);
    facets_reset(&skin);
    const struct mesh line = {.dim = 2,
                              .type = ELEMENT_LINE2,
                              .nodes_per_element = 2,
                              .n_nodes = 4,
                              .n_elements = 1,
                              .X = X,
                              .connectivity = nodes};
    assert_int_equal(mesh_skin(&line, NULL, 0, &skin), STATUS_DECK);
}

static double monomial(const double x[3], int i, int j, int k)
{
    return pow(x[0], i) * pow(x[1], j) * pow(x[2], k);
}

/** Partition of unity, derivatives against differences; 1 at the own node and 0 at others; polynomials of the
 * element's degree are reproduced. */
static void test_shape_functions(void **state)
{
    (void)state;
    for (enum element_type type = 0; type < ELEMENT_TYPES; type++) {
        const int nodes = element_nodes(type), dim = element_dim(type);
        double N[ELEMENT_MAX_NODES], dN[ELEMENT_MAX_NODES][3], plus[ELEMENT_MAX_NODES],
            minus[ELEMENT_MAX_NODES], sum = 0;
        const double xi[3] = {0.13, 0.29, 0.17}, h = 1e-5;
        element_shape(type, xi, N, dN);
        for (int a = 0; a < nodes; a++)
            sum += N[a];
        assert_true(fabs(sum - 1) < 1e-15);
        for (int d = 0; d < 3; d++) {
            double shifted[3] = {xi[0], xi[1], xi[2]};
            shifted[d] += h;
            element_shape(type, shifted, plus, NULL);
            shifted[d] -= 2 * h;
            element_shape(type, shifted, minus, NULL);
            for (int a = 0; a < nodes; a++)
                assert_true(fabs(dN[a][d] - (d < dim ? (plus[a] - minus[a]) / (2 * h) : 0)) < 1e-10);
        }
        double at[ELEMENT_MAX_NODES][3];
        for (int a = 0; a < nodes; a++) {
            element_node(type, a, at[a]);
            element_shape(type, at[a], plus, NULL);
            for (int b = 0; b < nodes; b++)
                assert_true(plus[b] == (a == b));
        }
        const int degree = element_is_quadratic(type) ? 2 : 1;
        for (int i = 0; i <= degree; i++)
            for (int j = 0; j <= (dim > 1 ? degree - i : 0); j++)
                for (int k = 0; k <= (dim > 2 ? degree - i - j : 0); k++) {
                    double value = 0;
                    for (int a = 0; a < nodes; a++)
                        value += N[a] * monomial(at[a], i, j, k);
                    assert_true(fabs(value - monomial(xi, i, j, k)) < 1e-15);
                }
    }
    double N[8];
    element_shape(ELEMENT_HEX8, (const double[3]){1, 1, -1}, N, NULL);
    assert_true(N[2] == 1 && N[6] == 0);
    assert_string_equal(element_name(ELEMENT_HEX8), "hex8");
    assert_int_equal(element_vtk(ELEMENT_TET4), 10);
}

/** Names, and cell types of the VTK file format. */
static void test_vtk_types(void **state)
{
    (void)state;
    const struct {
        enum element_type type;
        const char *name;
        int vtk, nodes;
    } types[] = {{ELEMENT_LINE3, "line3", 21, 3},  {ELEMENT_TRI6, "tri6", 22, 6},
                 {ELEMENT_QUAD8, "quad8", 23, 8},  {ELEMENT_QUAD9, "quad9", 28, 9},
                 {ELEMENT_TET10, "tet10", 24, 10}, {ELEMENT_HEX20, "hex20", 25, 20},
                 {ELEMENT_HEX27, "hex27", 29, 27}};
    for (size_t k = 0; k < sizeof types / sizeof types[0]; k++) {
        assert_string_equal(element_name(types[k].type), types[k].name);
        assert_int_equal(element_vtk(types[k].type), types[k].vtk);
        assert_int_equal(element_nodes(types[k].type), types[k].nodes);
    }
    /* VTK's face nodes of hex27: 20 on x-, 21 x+, 22 y-, 23 y+, 24 z-, 25 z+ */
    double xi[3];
    for (int side = 0; side < 6; side++) {
        element_node(ELEMENT_HEX27, 20 + side, xi);
        for (int d = 0; d < 3; d++)
            assert_true(xi[d] == (d == side / 2 ? (side % 2 ? 1 : -1) : 0));
    }
}

static const struct conversion {
    enum element_type type;
    size_t n_nodes, n_elements; /**< of a grid of 4 x 3 (x 2) cells */
    size_t x_plus;              /**< nodes on the side x+ */
    size_t facets;
} conversions[] = {{ELEMENT_TRI3, 20, 24, 4, 14},     {ELEMENT_QUAD4, 20, 12, 4, 14},
                   {ELEMENT_TRI6, 63, 24, 7, 28},     {ELEMENT_QUAD8, 51, 12, 7, 28},
                   {ELEMENT_QUAD9, 63, 12, 7, 28},    {ELEMENT_TET4, 60, 144, 12, 104},
                   {ELEMENT_HEX8, 60, 24, 12, 52},    {ELEMENT_TET10, 315, 144, 35, 416},
                   {ELEMENT_HEX20, 193, 24, 29, 260}, {ELEMENT_HEX27, 315, 24, 35, 208}};

/** Area vector of a facet (2-D: length times the normal) and its centroid's product with it. */
static double facet_area(const struct facets *skin, size_t f, double area[3])
{
    const int32_t *nodes = skin->nodes[f];
    const double *a = skin->points[nodes[0]], *b = skin->points[nodes[1]];
    memset(area, 0, 3 * sizeof *area);
    if (skin->dim == 2) {
        area[0] = b[1] - a[1];
        area[1] = a[0] - b[0];
        return 0.5 * ((a[0] + b[0]) * area[0] + (a[1] + b[1]) * area[1]);
    }
    for (int part = 0; part < (nodes[3] < 0 ? 1 : 2); part++) {
        const double *p = skin->points[nodes[part + 1]], *q = skin->points[nodes[part + 2]];
        for (int i = 0; i < 3; i++) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            area[i] += 0.5 * ((p[j] - a[j]) * (q[k] - a[k]) - (p[k] - a[k]) * (q[j] - a[j]));
        }
    }
    return a[0] * area[0] + a[1] * area[1] + a[2] * area[2]; /* the facets are plane */
}

/** A grid of any type: counts, volume, node sets on their sides, and a closed skin whose facets face out and
 * know their curved sides. */
static void test_conversion(void **state)
{
    (void)state;
    for (size_t c = 0; c < sizeof conversions / sizeof conversions[0]; c++) {
        const struct conversion *expected = &conversions[c];
        const int dim = element_dim(expected->type);
        struct mesh mesh;
        struct facets skin;
        assert_int_equal(mesh_create_grid(&mesh, dim, lower, upper, (const int[3]){4, 3, 2}), 0);
        assert_int_equal(mesh_convert(&mesh, expected->type), 0);
        assert_int_equal(mesh.type, expected->type);
        assert_int_equal(mesh.n_nodes, expected->n_nodes);
        assert_int_equal(mesh.n_elements, expected->n_elements);
        const struct node_set *set = mesh_find_set(&mesh, "x+");
        assert_int_equal(set->n, expected->x_plus);
        for (size_t n = 0; n < set->n; n++)
            assert_true(mesh.X[set->nodes[n]][0] == upper[0]);
        const double all = 0.35101 * 0.02 * (dim == 3 ? 0.4 : 1), reference[3] = {0.13, 0.29, 0.17};
        double volume = 0, area[3] = {0}, enclosed = 0;
        for (size_t e = 0; e < mesh.n_elements; e++) { /* the Jacobian is constant */
            assert_true(mesh_jacobian(&mesh, e, reference) > 0);
            volume += mesh_jacobian(&mesh, e, reference) * (element_is_simplex(mesh.type)
                                                                ? (dim == 2 ? 1.0 / 2 : 1.0 / 6)
                                                            : dim == 2 ? 4
                                                                       : 8);
        }
        assert_true(fabs(volume - all) < 1e-15);
        assert_int_equal(mesh_skin(&mesh, NULL, 0, &skin), 0);
        assert_int_equal(skin.n_facets, expected->facets);
        assert_true((skin.sides != NULL) == element_is_quadratic(mesh.type));
        for (size_t f = 0; f < skin.n_facets; f++) {
            double normal[3];
            enclosed += facet_area(&skin, f, normal) / dim;
            for (int i = 0; i < 3; i++)
                area[i] += normal[i];
            for (int k = 0; skin.sides && k < 4 && skin.nodes[f][k] >= 0; k++) {
                const int n = element_nodes(mesh_side_type(dim, skin.sides[f]));
                bool found = false;
                for (int s = 0; s < n; s++)
                    found = found || skin.sides[f][s] == skin.nodes[f][k];
                assert_true(found);
            }
        }
        for (int i = 0; i < 3; i++)
            assert_true(fabs(area[i]) < 1e-15);
        assert_true(fabs(enclosed - all) < 1e-15);
        facets_reset(&skin);
        const int number = (int)(set - mesh.sets);
        assert_int_equal(mesh_skin(&mesh, &number, 1, &skin), 0);
        assert_true(skin.n_facets < expected->facets);
        facets_reset(&skin);
        mesh_reset(&mesh);
    }
}

static void test_conversion_refuses(void **state)
{
    (void)state;
    struct mesh mesh;
    assert_int_equal(mesh_create_grid(&mesh, 2, lower, upper, (const int[3]){4, 3, 2}), 0);
    assert_int_equal(mesh_convert(&mesh, ELEMENT_HEX20), STATUS_DECK);
    assert_int_equal(mesh_convert(&mesh, ELEMENT_LINE3), STATUS_DECK);
    assert_int_equal(mesh_convert(&mesh, ELEMENT_TRI6), 0);
    assert_int_equal(mesh_convert(&mesh, ELEMENT_QUAD8), STATUS_DECK);
    mesh_reset(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_grid_2d),
        cmocka_unit_test(test_grid_refuses),
        cmocka_unit_test(test_left_out),
        cmocka_unit_test(test_left_out_set),
        cmocka_unit_test(test_sets),
        cmocka_unit_test(test_skin_is_closed_and_faces_out),
        cmocka_unit_test(test_skin_of_tetrahedron),
        cmocka_unit_test(test_shape_functions),
        cmocka_unit_test(test_vtk_types),
        cmocka_unit_test(test_conversion),
        cmocka_unit_test(test_conversion_refuses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

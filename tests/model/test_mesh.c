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
        assert_int_equal(mesh_skin(&mesh, NULL, &skin), 0);
        assert_int_equal(skin.n_facets, dim == 2 ? 14 : 2 * (12 + 8 + 6));
        double area[3] = {0}, volume = 0;
        for (size_t f = 0; f < skin.n_facets; f++) {
            const double *a = skin.points[skin.nodes[f][0]], *b = skin.points[skin.nodes[f][1]];
            double normal[3] = {b[1] - a[1], a[0] - b[0], 0};
            if (dim == 3) {
                const double *c = skin.points[skin.nodes[f][2]], *d = skin.points[skin.nodes[f][3]];
                for (int i = 0; i < 3; i++) {
                    const int j = (i + 1) % 3, k = (i + 2) % 3;
                    normal[i] = 0.5 * ((c[j] - a[j]) * (d[k] - b[k]) - (c[k] - a[k]) * (d[j] - b[j]));
                }
            } else {
                assert_int_equal(skin.nodes[f][2], -1);
            }
            for (int i = 0; i < dim; i++) {
                area[i] += normal[i];
                volume +=
                    normal[i] * 0.5 * (a[i] + (dim == 2 ? b[i] : skin.points[skin.nodes[f][2]][i])) / dim;
            }
        }
        for (int i = 0; i < dim; i++)
            assert_true(fabs(area[i]) < 1e-15);
        assert_true(fabs(volume - 0.35101 * 0.02 * (dim == 3 ? 0.4 : 1)) < 1e-15);
        facets_reset(&skin);
        assert_int_equal(mesh_skin(&mesh, mesh_find_set(&mesh, "x-"), &skin), 0);
        assert_int_equal(skin.n_facets, dim == 2 ? 11 : 2 * (12 + 8 + 6) - 6);
        facets_reset(&skin);
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
    assert_int_equal(mesh_skin(&mesh, NULL, &skin), 0);
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
    assert_int_equal(mesh_skin(&line, NULL, &skin), STATUS_DECK);
}

/** Partition of unity, nodal values, derivatives against differences. */
static void test_shape_functions(void **state)
{
    (void)state;
    for (enum element_type type = 0; type < ELEMENT_TYPES; type++) {
        const int nodes = element_nodes(type), dim = element_dim(type);
        double N[8], dN[8][3], plus[8], minus[8], sum = 0;
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
    }
    double N[8];
    element_shape(ELEMENT_HEX8, (const double[3]){1, 1, -1}, N, NULL);
    assert_true(N[2] == 1 && N[6] == 0);
    assert_string_equal(element_name(ELEMENT_HEX8), "hex8");
    assert_int_equal(element_vtk(ELEMENT_TET4), 10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_grid_2d),
        cmocka_unit_test(test_grid_refuses),
        cmocka_unit_test(test_sets),
        cmocka_unit_test(test_skin_is_closed_and_faces_out),
        cmocka_unit_test(test_skin_of_tetrahedron),
        cmocka_unit_test(test_shape_functions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

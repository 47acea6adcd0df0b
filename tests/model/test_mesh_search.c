// SPDX-License-Identifier: GPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "model/mesh_search.h"

#include <math.h>
#include <string.h>

static const double lower[3] = {0.24899, 0.19, -0.3}, upper[3] = {0.6, 0.41, 0.1};

static const enum element_type types[] = {ELEMENT_TRI3,  ELEMENT_QUAD4, ELEMENT_TRI6, ELEMENT_QUAD8,
                                          ELEMENT_QUAD9, ELEMENT_TET4,  ELEMENT_HEX8, ELEMENT_TET10,
                                          ELEMENT_HEX20, ELEMENT_HEX27};

enum { TYPES = sizeof types / sizeof *types };

/** A grid of a type, bent and sheared: quadratic elements get curved sides. */
static void bent_create(struct mesh *mesh, enum element_type type)
{
    assert_int_equal(mesh_create_grid(mesh, element_dim(type), lower, upper, (const int[3]){7, 3, 4}), 0);
    assert_int_equal(mesh_convert(mesh, type), 0);
    for (size_t a = 0; a < mesh->n_nodes; ++a) {
        double *X = mesh->X[a];
        X[1] += 0.9 * (X[0] - 0.4) * (X[0] - 0.4);
        X[0] += mesh->dim == 3 ? 0.2 * X[2] : 0.0;
    }
}

static void place_of(const struct mesh *mesh, size_t e, const double xi[3], double X[3])
{
    const int32_t *nodes = &mesh->connectivity[e * (size_t)mesh->nodes_per_element];
    double N[ELEMENT_MAX_NODES];
    element_shape(mesh->type, xi, N, NULL);
    memset(X, 0, 3 * sizeof *X);
    for (int a = 0; a < mesh->nodes_per_element; ++a)
        for (int d = 0; d < 3; ++d)
            X[d] += N[a] * mesh->X[nodes[a]][d];
}

/** Places inside every element are found in it, with their natural coordinates. */
static void test_inside(void **state)
{
    (void)state;
    for (int k = 0; k < TYPES; ++k) {
        struct mesh mesh;
        struct mesh_search search;
        bent_create(&mesh, types[k]);
        assert_int_equal(mesh_search_init(&search, &mesh, 0.0), 0);
        assert_true(search.cells[0] * search.cells[1] * search.cells[2] > 6);
        for (size_t e = 0; e < mesh.n_elements; ++e) {
            const double inside[2][3] = {{0.13, 0.29, mesh.dim == 3 ? 0.17 : 0.0},
                                         {0.61, 0.07, mesh.dim == 3 ? 0.23 : 0.0}};
            for (int i = 0; i < 2; ++i) {
                double X[3], xi[3];
                size_t element;
                place_of(&mesh, e, inside[i], X);
                assert_true(mesh_search_find(&search, X, &element, xi));
                assert_int_equal(element, e);
                for (int d = 0; d < mesh.dim; ++d)
                    assert_true(fabs(xi[d] - inside[i][d]) < 1e-12);
            }
        }
        mesh_search_reset(&search);
        mesh_reset(&mesh);
    }
}

/** A common node belongs to one of its elements; outside there is nothing, but within the margin the
 * nearest element. */
static void test_edges(void **state)
{
    (void)state;
    for (int k = 0; k < TYPES; ++k) {
        struct mesh mesh;
        struct mesh_search search;
        size_t element;
        double xi[3], X[3];
        bent_create(&mesh, types[k]);
        const size_t per_element = (size_t)mesh.nodes_per_element;
        const int32_t last_node = mesh.connectivity[mesh.n_elements * per_element - 1];
        assert_int_equal(mesh_search_init(&search, &mesh, 0.0), 0);
        assert_true(mesh_search_find(&search, mesh.X[last_node], &element, xi));
        bool its_own = false;
        for (size_t a = 0; a < per_element; ++a)
            its_own = its_own || mesh.connectivity[element * per_element + a] == last_node;
        assert_true(its_own);
        /* a corner of the grid that is a convex corner of the body */
        memcpy(X, mesh.X[0], sizeof X);
        assert_true(mesh_search_find(&search, X, &element, xi));
        X[0] -= 3e-4;
        assert_false(mesh_search_find(&search, X, &element, xi));
        X[0] = 17.0;
        assert_false(mesh_search_find(&search, X, &element, xi));
        mesh_search_reset(&search);
        assert_int_equal(mesh_search_init(&search, &mesh, 1e-3), 0);
        memcpy(X, mesh.X[0], sizeof X);
        X[0] -= 3e-4;
        assert_true(mesh_search_find(&search, X, &element, xi));
        double back[3];
        place_of(&mesh, element, xi, back);
        for (int d = 0; d < mesh.dim; ++d)
            assert_true(fabs(back[d] - X[d]) < 1e-14);
        X[0] -= 3e-3;
        assert_false(mesh_search_find(&search, X, &element, xi));
        mesh_search_reset(&search);
        mesh_reset(&mesh);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_inside), cmocka_unit_test(test_edges)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/error.h"
#include "base/log.h"
#include "model/surface.h"
#include "model/surface_build.h"
#include "model/surface_rims.h"

#include <math.h>
#include <string.h>

static const double everywhere_lower[3] = {-INFINITY, -INFINITY, -INFINITY};
static const double everywhere_upper[3] = {INFINITY, INFINITY, INFINITY};

static size_t open_ends(const struct facets *facets)
{
    struct surface_rims rims;
    assert_int_equal(surface_rims_find(&facets, 1, 0.0, 0.0, everywhere_lower, everywhere_upper, &rims), 0);
    assert_true(rims.gap == 0.0);
    return rims.n_open;
}

/** A beam clamped to an arc whose ends meet its corners only within 3e-6. */
static void test_beam_on_cylinder(void **state)
{
    (void)state;
    enum { SEGMENTS = 20 };
    const double pi = acos(-1.0), angle = 11.54 * pi / 180.0;
    double points[SEGMENTS + 1][3] = {{0}};
    int32_t nodes[SEGMENTS][4];
    for (int i = 0; i <= SEGMENTS; i++) {
        double a = angle + (2.0 * pi - 2.0 * angle) * i / SEGMENTS;
        points[i][0] = 0.2 + 0.05 * cos(a);
        points[i][1] = 0.2 + 0.05 * sin(a);
    }
    for (int i = 0; i < SEGMENTS; i++)
        memcpy(nodes[i], (int32_t[4]){i, i + 1, -1, -1}, sizeof nodes[i]);
    struct model_mesh mesh = {.name = "beam"};
    assert_int_equal(mesh_create_grid(&mesh.mesh, 2, (double[3]){0.24899, 0.19, 0}, (double[3]){0.6, 0.21, 0},
                                      (int[3]){35, 3, 0}),
                     0);
    int root = (int)(mesh_find_set(&mesh.mesh, "x-") - mesh.mesh.sets);
    struct surface_part parts[2] = {
        {.mesh = -1,
         .facets =
             {.dim = 2, .n_points = SEGMENTS + 1, .n_facets = SEGMENTS, .points = points, .nodes = nodes}},
        {.mesh = 0, .n_excluded = 1, .excluded = &root}};
    struct model_surface surface = {.name = "obstacle", .kind = SURFACE_FACETS, .n_parts = 2, .parts = parts};
    const struct model model = {.path = "deck.xml", .dim = 2, .n_meshes = 1, .meshes = &mesh};
    assert_int_equal(surface_build(&model, &surface), 0);
    assert_int_equal(surface.built.n_facets, 20 + 35 + 3 + 35);
    assert_int_equal(surface.built.n_points, surface.built.n_facets); // one closed loop
    assert_int_equal(open_ends(&surface.built), 0);
    size_t coupled = 0, corners = 0;
    for (size_t i = 0; i < surface.built.n_points; i++) {
        const int32_t node = surface.built_node[i];
        coupled += surface.built_mesh[i] == 0;
        assert_int_equal(surface.built_mesh[i] >= 0, node >= 0);
        if (node >= 0)
            assert_memory_equal(surface.built.points[i], mesh.mesh.X[node], 3 * sizeof(double));
        corners += node >= 0 && mesh.mesh.X[node][0] == 0.24899;
    }
    assert_int_equal(coupled, 36 + 36 + 2);
    assert_int_equal(corners, 2); // the mesh's points stayed, not the arc's
    surface_build_reset(&surface);
    assert_null(surface.built_node);

    parts[0].facets.points[0][1] += 1e-3; // too far apart to be one point
    assert_int_equal(surface_build(&model, &surface), 0);
    assert_int_equal(surface.built.n_points, surface.built.n_facets + 1);
    assert_int_equal(open_ends(&surface.built), 2);
    const struct facets *const built = &surface.built;
    struct surface_rims rims;
    assert_int_equal(surface_rims_find(&built, 1, 0.0, 0.0, (double[3]){0.3, 0, 0}, everywhere_upper, &rims),
                     0);
    assert_int_equal(rims.n_open, 0); // both lie outside this box
    const double gap = hypot(points[0][0] - 0.24899, points[0][1] - 0.21);
    assert_int_equal(
        surface_rims_find(&built, 1, 0.99 * gap, 2.0 * gap, everywhere_lower, everywhere_upper, &rims), 0);
    assert_int_equal(rims.n_open, 2);
    assert_float_equal(rims.gap, gap, 1e-15);
    assert_int_equal(
        surface_rims_find(&built, 1, 1.01 * gap, 2.0 * gap, everywhere_lower, everywhere_upper, &rims), 0);
    assert_int_equal(rims.n_open, 0);
    surface_build_reset(&surface);
    mesh_reset(&mesh.mesh);
}

/** Points of one own part fall together only when they coincide; degenerate facets vanish. */
static void test_within_part(void **state)
{
    (void)state;
    double points[5][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1e-5, 0, 0}, {1e-11, 0, 0}};
    int32_t nodes[4][4] = {{0, 1, -1, -1}, {1, 2, -1, -1}, {2, 4, -1, -1}, {4, 0, -1, -1}};
    struct surface_part part = {
        .mesh = -1, .facets = {.dim = 2, .n_points = 5, .n_facets = 4, .points = points, .nodes = nodes}};
    struct model_surface surface = {.name = "s", .kind = SURFACE_FACETS, .n_parts = 1, .parts = &part};
    const struct model model = {.path = "deck.xml", .dim = 2};
    assert_int_equal(surface_build(&model, &surface), 0);
    assert_int_equal(surface.built.n_points, 3);
    assert_int_equal(surface.built.n_facets, 3);
    assert_int_equal(open_ends(&surface.built), 0);
    nodes[2][1] = 3; // 1e-5 away: another point
    nodes[3][0] = 3;
    assert_int_equal(surface_build(&model, &surface), 0);
    assert_int_equal(surface.built.n_points, 4);
    assert_int_equal(surface.built.n_facets, 4);
    surface_build_reset(&surface);
}

/** Two halves of a cube's skin, one of quads and one of triangles. */
static void test_3d(void **state)
{
    (void)state;
    double points[8][3];
    for (int i = 0; i < 8; i++)
        for (int d = 0; d < 3; d++)
            points[i][d] = i >> d & 1;
    int32_t quads[3][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}};
    int32_t triangles[6][4] = {{2, 6, 7, -1}, {2, 7, 3, -1}, {0, 4, 6, -1},
                               {0, 6, 2, -1}, {1, 3, 7, -1}, {1, 7, 5, -1}};
    struct surface_part parts[2] = {{.mesh = -1, .facets = {3, 8, 3, points, quads}},
                                    {.mesh = -1, .facets = {3, 8, 6, points, triangles}}};
    struct model_surface surface = {.name = "cube", .kind = SURFACE_FACETS, .n_parts = 2, .parts = parts};
    const struct model model = {.path = "deck.xml", .dim = 3};
    assert_int_equal(surface_build(&model, &surface), 0);
    assert_int_equal(surface.built.n_points, 8);
    assert_int_equal(surface.built.n_facets, 9);
    assert_int_equal(open_ends(&surface.built), 0);
    parts[1].facets.n_facets = 5;
    assert_int_equal(surface_build(&model, &surface), 0);
    assert_int_equal(open_ends(&surface.built), 3);
    surface_build_reset(&surface);
    parts[1].facets.n_facets = 0;
    log_set_level(LOG_ERROR);
    assert_int_equal(surface_build(&model, &surface), STATUS_DECK);
    assert_null(surface.built.points);
    surface.kind = SURFACE_PLANE;
    assert_int_equal(surface_build(&model, &surface), 0);
    assert_int_equal(surface.built.n_points, 0);
    surface_build_reset(&surface);
}

/** Quadratic meshes of all kinds: the facets are closed, know their sides, and spread a place linearly over
 * the side's points so that it is the same place (the sides are straight). An own part beside them stands for
 * itself. */
static void test_curved_sides(void **state)
{
    (void)state;
    const enum element_type types[] = {ELEMENT_TRI6,  ELEMENT_QUAD8, ELEMENT_QUAD9,
                                       ELEMENT_TET10, ELEMENT_HEX20, ELEMENT_HEX27};
    for (size_t t = 0; t < sizeof types / sizeof types[0]; t++) {
        const int dim = element_dim(types[t]);
        struct model_mesh mesh = {.name = "block"};
        assert_int_equal(mesh_create_grid(&mesh.mesh, dim, (double[3]){0.3, 0.1, -0.2},
                                          (double[3]){0.7, 0.4, 0.5}, (int[3]){2, 3, 1}),
                         0);
        assert_int_equal(mesh_convert(&mesh.mesh, types[t]), 0);
        double points[3][3] = {{5, 5, 5}, {6, 5, 5}, {5, 6, 5}};
        int32_t nodes[1][4] = {{0, 1, dim == 3 ? 2 : -1, -1}};
        struct surface_part parts[2] = {
            {.mesh = -1,
             .facets = {.dim = dim, .n_points = 3, .n_facets = 1, .points = points, .nodes = nodes}},
            {.mesh = 0}};
        struct model_surface definition = {
            .name = "wet", .kind = SURFACE_FACETS, .n_parts = 2, .parts = parts};
        const struct model model = {.path = "deck.xml",
                                    .dim = dim,
                                    .n_meshes = 1,
                                    .meshes = &mesh,
                                    .n_surfaces = 1,
                                    .surfaces = &definition};
        assert_int_equal(surface_build(&model, &definition), 0);
        assert_int_equal(open_ends(&definition.built), dim == 2 ? 2 : 3); // those of the own part
        assert_non_null(definition.built.sides);
        assert_int_equal(definition.built.sides[0][0], -1);
        struct surface *surface;
        assert_int_equal(surface_create(&surface, &model, 0, 0.0), 0);
        for (size_t f = 0; f < surface->n_facets; f++) {
            int n = 0;
            while (n < 4 && surface->nodes[f][n] >= 0)
                n++;
            double weights[SIDE_MAX_NODES] = {0.2, 0.3, 0.5}, place[3] = {0}, sum = 0;
            if (n == 2)
                weights[0] = 0.7;
            if (n == 4) { /* bilinear at (0.2, -0.4) */
                const double bilinear[4] = {0.28, 0.42, 0.18, 0.12};
                memcpy(weights, bilinear, sizeof bilinear);
            }
            for (int j = 0; j < n; j++)
                for (int k = 0; k < 3; k++)
                    place[k] += weights[j] * surface->X[surface->nodes[f][j]][k];
            int32_t spread[SIDE_MAX_NODES];
            const int m = surface_spread(surface, f, spread, weights);
            assert_int_equal(m, f == 0 ? n : element_nodes(mesh_side_type(dim, definition.built.sides[f])));
            for (int j = 0; j < m; j++) {
                sum += weights[j];
                for (int k = 0; k < 3; k++)
                    place[k] -= weights[j] * surface->X[spread[j]][k];
            }
            assert_true(fabs(sum - 1) < 1e-14);
            assert_true(fabs(place[0]) + fabs(place[1]) + fabs(place[2]) < 1e-14);
        }
        surface_destroy(surface);
        surface_build_reset(&definition);
        mesh_reset(&mesh.mesh);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_beam_on_cylinder),
                                       cmocka_unit_test(test_within_part), cmocka_unit_test(test_3d),
                                       cmocka_unit_test(test_curved_sides)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

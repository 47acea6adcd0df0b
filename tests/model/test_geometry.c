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
#include "model/geometry.h"
#include "model/mesh.h"

#include <math.h>
#include <string.h>

#define NEAR(value, expected) assert_true(fabs((value) - (expected)) < 1e-13)

static double at(const struct shape *shape, int dim, double x, double y, double z)
{
    return shape_distance(shape, dim, (const double[3]){x, y, z});
}

static void test_simple_shapes(void **state)
{
    (void)state;
    struct shape box = {.kind = SHAPE_BOX, .a = {-0.7, 0.2, 1.1}, .b = {0.3, 0.9, 1.6}};
    NEAR(at(&box, 2, 0.0, 0.55, 99.0), -0.3);
    NEAR(at(&box, 2, 0.0, 0.30, 0.0), -0.1);
    NEAR(at(&box, 2, 0.6, 1.3, 0.0), 0.5); // 3-4-5 from the corner
    NEAR(at(&box, 3, 0.0, 0.55, 1.0), 0.1);
    NEAR(at(&box, 1, -1.0, 0.0, 0.0), 0.3);

    struct shape ball = {.kind = SHAPE_BALL, .a = {0.1, -0.2, 0.3}, .radius = 0.7};
    NEAR(at(&ball, 3, 0.1 + 0.2, -0.2 + 0.3, 0.3 + 0.6), 0.0); // 2-3-6-7
    NEAR(at(&ball, 2, 0.1 + 0.3, -0.2 + 0.4, 55.0), -0.2);

    struct shape ring = {.kind = SHAPE_CYLINDER, .a = {0, 0, 0}, .inner_radius = 1.0, .radius = 2.0};
    NEAR(at(&ring, 2, 0.6, 0.8, 0.0), 0.0);
    NEAR(at(&ring, 2, 0.3, 0.4, 0.0), 0.5);
    NEAR(at(&ring, 2, 1.5, 2.0, 0.0), 0.5);
    NEAR(at(&ring, 2, 1.08, 1.44, 0.0), -0.2);

    struct shape rod = {.kind = SHAPE_CYLINDER, .a = {1, 0, 0}, .b = {1, 0, 5}, .radius = 0.5};
    NEAR(at(&rod, 3, 1.0, 0.1, 2.0), -0.4);
    NEAR(at(&rod, 3, 1.0, 0.1, 4.9), -0.1);
    NEAR(at(&rod, 3, 1.0, 0.9, 5.3), 0.5);

    struct shape half = {.kind = SHAPE_HALF_SPACE, .a = {0.0, 2.0, 0.0}, .b = {3.0, 4.0, 0.0}};
    NEAR(at(&half, 2, 1.0, 3.0, 0.0), 1.4);
    NEAR(at(&half, 2, -5.0, 2.0, 0.0), -3.0);
}

static void test_polygon_is_concave_and_has_any_sense(void **state)
{
    (void)state;
    double corner[6][3] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 3}, {0, 3}}, reversed[6][3];
    for (int i = 0; i < 6; i++)
        memcpy(reversed[i], corner[5 - i], sizeof corner[i]);
    struct shape ell = {.kind = SHAPE_POLYGON, .n_points = 6, .points = corner};
    for (int sense = 0; sense < 2; sense++) {
        ell.points = sense ? reversed : corner;
        NEAR(at(&ell, 2, 0.4, 2.1, 0), -0.4);
        NEAR(at(&ell, 2, 1.5, 0.75, 0), -0.25);
        NEAR(at(&ell, 2, 1.3, 1.4, 0), 0.3);  // in the notch
        NEAR(at(&ell, 2, -0.5, 1.0, 0), 0.5); // the ray passes through two corners
        NEAR(at(&ell, 2, 0.5, 1.0, 0), -0.5);
        NEAR(at(&ell, 2, 2.3, -0.4, 0), 0.5);
    }
    double lower[3], upper[3];
    shape_bounds(&ell, 2, lower, upper);
    assert_true(lower[0] == 0 && lower[1] == 0 && upper[0] == 2 && upper[1] == 3 && upper[2] == 0);
}

static void test_combinations_and_bounds(void **state)
{
    (void)state;
    struct shape part[2] = {{.kind = SHAPE_BOX, .a = {0, 0, 0}, .b = {4, 2, 1}},
                            {.kind = SHAPE_BALL, .a = {4, 1, 0}, .radius = 0.5}};
    struct shape all = {.kind = SHAPE_UNION, .n_children = 2, .children = part};
    double lower[3], upper[3];

    NEAR(at(&all, 2, 4.25, 1, 0), -0.25);
    shape_bounds(&all, 2, lower, upper);
    assert_true(lower[0] == 0 && upper[0] == 4.5 && upper[1] == 2 && lower[2] == 0 && upper[2] == 0);
    all.kind = SHAPE_INTERSECTION;
    NEAR(at(&all, 2, 3.9, 1, 0), -0.1);
    shape_bounds(&all, 2, lower, upper);
    assert_true(lower[0] == 3.5 && upper[0] == 4 && lower[1] == 0.5 && upper[1] == 1.5);
    all.kind = SHAPE_DIFFERENCE;
    NEAR(at(&all, 2, 3.9, 1, 0), 0.4);
    NEAR(at(&all, 2, 1.0, 1, 0), -1.0);
    shape_bounds(&all, 2, lower, upper);
    assert_true(lower[0] == 0 && upper[0] == 4);

    struct shape slanted = {.kind = SHAPE_CYLINDER, .a = {0, 0, 0}, .b = {3, 0, 4}, .radius = 1};
    shape_bounds(&slanted, 3, lower, upper);
    NEAR(lower[0], -0.8);
    NEAR(upper[0], 3.8);
    NEAR(upper[1], 1.0);
    NEAR(upper[2], 4.6);
    struct shape half = {.kind = SHAPE_HALF_SPACE, .b = {1, 0, 0}};
    shape_bounds(&half, 2, lower, upper);
    assert_true(isinf(lower[0]) && isinf(upper[1]) && upper[2] == 0);
}

/** A square around the origin, counter-clockwise (solid inside) or clockwise (solid outside). */
static struct facets square(double (*points)[3], int32_t (*nodes)[4], bool solid_outside)
{
    const double corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};

    for (int i = 0; i < 4; i++) {
        points[i][0] = corner[i][0];
        points[i][1] = corner[i][1];
        points[i][2] = 0.0;
        nodes[i][0] = solid_outside ? (i + 1) % 4 : i;
        nodes[i][1] = solid_outside ? i : (i + 1) % 4;
        nodes[i][2] = nodes[i][3] = -1;
    }
    return (struct facets){.dim = 2, .n_points = 4, .n_facets = 4, .points = points, .nodes = nodes};
}

static void test_facets_in_the_plane(void **state)
{
    (void)state;
    double points[4][3];
    int32_t nodes[4][4];

    for (int outside = 0; outside < 2; outside++) {
        struct facets facets = square(points, nodes, outside);
        struct shape inside = {.kind = SHAPE_FACETS, .facets = &facets};
        double sign = outside ? -1.0 : 1.0;
        NEAR(facets_distance(&facets, (const double[3]){0.3, 0.1, 0}), -0.7 * sign);
        NEAR(facets_distance(&facets, (const double[3]){1.3, 1.4, 0}), 0.5 * sign);
        NEAR(facets_distance(&facets, (const double[3]){-1.3, 1.0, 0}), 0.3 * sign); // level with corners
        NEAR(facets_distance(&facets, (const double[3]){0.0, -1.0, 0}), 0.0);
        NEAR(at(&inside, 2, 0.3, 0.1, 0), -0.7 * sign); // the solid side
        double lower[3], upper[3];
        shape_bounds(&inside, 2, lower, upper);
        assert_true(outside ? isinf(lower[0]) && isinf(upper[1]) : lower[0] == -1 && upper[1] == 1);
    }
    // an open one: the side of the nearest facet, also beyond its ends and at the shared corner
    struct facets open = square(points, nodes, false);
    open.n_facets = 2; // bottom and right
    NEAR(facets_distance(&open, (const double[3]){0.0, 5.0, 0}), -sqrt(17.0));
    NEAR(facets_distance(&open, (const double[3]){0.3, -1.25, 0}), 0.25);
    NEAR(facets_distance(&open, (const double[3]){0.3, -0.75, 0}), -0.25);
    NEAR(facets_distance(&open, (const double[3]){1.3, -1.4, 0}), 0.5);
    NEAR(facets_distance(&open, (const double[3]){-1.3, -1.4, 0}), 0.5);
}

static void test_facets_in_space(void **state)
{
    (void)state;
    double points[8][3];
    int32_t quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    int32_t mixed[7][4];

    for (int i = 0; i < 8; i++) {
        points[i][0] = i & 1 ? 2 : 0;
        points[i][1] = i & 2 ? 3 : 0;
        points[i][2] = i & 4 ? 4 : 0;
    }
    memcpy(mixed, quads, sizeof quads);
    mixed[6][0] = quads[5][0];
    mixed[6][1] = quads[5][2];
    mixed[6][2] = quads[5][3];
    mixed[5][3] = mixed[6][3] = -1;
    for (int triangles = 0; triangles < 2; triangles++) {
        struct facets box = {.dim = 3,
                             .n_points = 8,
                             .n_facets = triangles ? 7 : 6,
                             .points = points,
                             .nodes = triangles ? mixed : quads};
        NEAR(facets_distance(&box, (const double[3]){1.7, 1.4, 2.2}), -0.3);
        NEAR(facets_distance(&box, (const double[3]){1.0, 1.5, 4.7}), 0.7);
        NEAR(facets_distance(&box, (const double[3]){2.2, 3.3, 4.6}), 0.7); // 2-3-6-7 from a corner
        NEAR(facets_distance(&box, (const double[3]){2.3, 3.4, 1.9}), 0.5); // from an edge
        NEAR(facets_distance(&box, (const double[3]){2.0, 1.1, 3.9}), 0.0);
        // at the body's centre every face is seen under the same half of the turn
        NEAR(facets_distance(&box, (const double[3]){1.0, 1.5, 2.0}), -1.0);
    }
    struct facets plate = {.dim = 3, .n_points = 8, .n_facets = 1, .points = points, .nodes = quads + 1};
    NEAR(facets_distance(&plate, (const double[3]){0.6, 2.5, 4.25}), 0.25);
    NEAR(facets_distance(&plate, (const double[3]){0.6, 2.5, 3.5}), -0.5);
    NEAR(facets_distance(&plate, (const double[3]){2.3, 2.5, 4.4}), 0.5);
    NEAR(facets_distance(&plate, (const double[3]){2.3, 2.5, 3.6}), -0.5);
}

static void test_fill_has_no_row_too_many_or_too_few(void **state)
{
    (void)state;
    // quotients that are not whole in floating point: 2.2/0.005 = 440.00000000000006, 0.41/(0.41/50), ...
    const struct {
        double lower[2], size[2], spacing;
        size_t n[2];
    } cases[] = {{{0, 0}, {2.2, 0.41}, 0.005, {440, 82}},
                 {{0, 0}, {2.05, 0.41}, 0.41 / 50, {250, 50}},
                 {{-0.1, 0.3}, {0.3, 0.7}, 0.1, {3, 7}},
                 {{1.0 / 3, -1.0 / 7}, {1.1, 2.3}, 0.1 / 3, {33, 69}},
                 {{1e3 + 0.1, -1e3 - 0.7}, {0.6, 0.9}, 0.3, {2, 3}}};
    for (size_t c = 0; c < sizeof cases / sizeof cases[0]; c++)
        for (int half = 0; half < 2; half++) {
            double dx = cases[c].spacing, origin[3] = {0}, (*points)[3];
            struct shape box = {.kind = SHAPE_BOX};
            size_t n;
            for (int k = 0; k < 2; k++) {
                box.a[k] = cases[c].lower[k];
                box.b[k] = cases[c].lower[k] + cases[c].size[k];
                origin[k] = box.a[k] + (half ? dx / 2 : 0);
            }
            // a lattice shifted by half a cell has points on the sides: none of them may be kept
            assert_int_equal(geometry_fill(&box, 2, dx, origin, 0.0, &points, &n), 0);
            assert_int_equal(n, (cases[c].n[0] - half) * (cases[c].n[1] - half));
            if (n == cases[c].n[0] * cases[c].n[1])
                NEAR((points[1][0] - points[0][0] - dx) * 1e-3, 0.0); // x fastest
            memory_free(points);
        }
}

static void test_fill_of_the_periodic_box_in_space(void **state)
{
    (void)state;
    struct shape box = {.kind = SHAPE_BOX, .a = {-0.025, -0.025, -0.025}, .b = {0.025, 0.025, 0.025}};
    double(*points)[3];
    size_t n;

    assert_int_equal(geometry_fill(&box, 3, 0.005, box.a, 0.02 * 0.005, &points, &n), 0);
    assert_int_equal(n, 1000);
    const struct {
        size_t id;
        double x[3];
    } place[] = {{0, {-0.0225, -0.0225, -0.0225}},
                 {111, {-0.0175, -0.0175, -0.0175}},
                 {925, {0.0025, -0.0125, 0.0225}}};
    for (size_t i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            NEAR(points[place[i].id][k], place[i].x[k]);
    memory_free(points);
}

static void test_fill_on_a_line(void **state)
{
    (void)state;
    struct shape box = {.kind = SHAPE_BOX, .a = {-0.102, 0, 0}, .b = {0.102, 0, 0}};
    double(*points)[3];
    size_t n;

    assert_int_equal(geometry_fill(&box, 1, 0.004, box.a, 0.02 * 0.004, &points, &n), 0);
    assert_int_equal(n, 51);
    NEAR(points[22][0], -0.012);
    assert_true(points[22][1] == 0 && points[22][2] == 0);
    memory_free(points);
}

/** Walking in steps must keep exactly the points that looking at each would keep. */
static void test_fill_equals_looking_at_each_point(void **state)
{
    (void)state;
    double corner[61][3];
    int32_t nodes[60][4];
    for (int i = 0; i < 60; i++) {
        double angle = 2 * M_PI * i / 60, radius = 0.3 + 0.07 * cos(5 * angle);
        corner[i][0] = 0.61 + radius * cos(angle);
        corner[i][1] = 0.43 + radius * sin(angle);
        corner[i][2] = 0;
        nodes[i][0] = i;
        nodes[i][1] = (i + 1) % 60;
        nodes[i][2] = nodes[i][3] = -1;
    }
    struct facets star = {.dim = 2, .n_points = 60, .n_facets = 60, .points = corner, .nodes = nodes};
    struct shape part[2] = {{.kind = SHAPE_BOX, .a = {0, 0}, .b = {1.7, 0.9}},
                            {.kind = SHAPE_FACETS, .facets = &star}};
    struct shape fluid = {.kind = SHAPE_DIFFERENCE, .n_children = 2, .children = part};
    const double spacing = 0.0101, origin[3] = {0.003, -0.002, 0};
    for (size_t n_facets = 60; n_facets >= 59; n_facets--) { // closed, then with a gap
        double(*points)[3];
        size_t n, expected = 0;
        star.n_facets = n_facets;
        assert_int_equal(geometry_fill(&fluid, 2, spacing, origin, 0.0003, &points, &n), 0);
        for (int j = -1; j < 92; j++)
            for (int i = -1; i < 172; i++) {
                double x = origin[0] + (i + 0.5) * spacing, y = origin[1] + (j + 0.5) * spacing;
                if (at(&fluid, 2, x, y, 0) >= -0.0003)
                    continue;
                assert_true(expected < n);
                assert_true(points[expected][0] == x && points[expected][1] == y);
                expected++;
            }
        assert_int_equal(n, expected);
        if (n_facets == 60)
            assert_true(fabs((double)n * spacing * spacing - (1.7 * 0.9 - 0.29)) < 0.02);
        memory_free(points);
    }
}

static void test_fill_refuses(void **state)
{
    (void)state;
    struct shape half = {.kind = SHAPE_HALF_SPACE, .b = {1, 0, 0}};
    struct shape box = {.kind = SHAPE_BOX, .b = {1, 1, 1}};
    double origin[3] = {0}, (*points)[3];
    size_t n;

    assert_int_equal(geometry_fill(&half, 2, 0.1, origin, 0, &points, &n), STATUS_DECK);
    assert_int_equal(geometry_fill(&box, 3, 7e-4, origin, 0, &points, &n), STATUS_DECK); // 2.9e9
    assert_int_equal(geometry_fill(&box, 2, 1e-300, origin, 0, &points, &n), STATUS_DECK);
    assert_int_equal(geometry_fill(&box, 2, 0.0, origin, 0, &points, &n), STATUS_DECK);
    assert_int_equal(geometry_fill(&box, 2, NAN, origin, 0, &points, &n), STATUS_DECK);
    // nothing fits: no points, but no error
    assert_int_equal(geometry_fill(&box, 2, 0.1, origin, 0.6, &points, &n), 0);
    assert_int_equal(n, 0);
    memory_free(points);
}

static void test_reset_frees_the_tree(void **state)
{
    (void)state;
    struct shape shape = {.kind = SHAPE_UNION, .n_children = 2};
    shape.children = memory_create(2, sizeof *shape.children);
    shape.children[0].kind = SHAPE_POLYGON;
    shape.children[0].n_points = 3;
    shape.children[0].points = memory_create(3, sizeof *shape.points);
    shape_reset(&shape);
    assert_null(shape.children);
    shape_reset(&shape);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_simple_shapes),
        cmocka_unit_test(test_polygon_is_concave_and_has_any_sense),
        cmocka_unit_test(test_combinations_and_bounds),
        cmocka_unit_test(test_facets_in_the_plane),
        cmocka_unit_test(test_facets_in_space),
        cmocka_unit_test(test_fill_has_no_row_too_many_or_too_few),
        cmocka_unit_test(test_fill_of_the_periodic_box_in_space),
        cmocka_unit_test(test_fill_on_a_line),
        cmocka_unit_test(test_fill_equals_looking_at_each_point),
        cmocka_unit_test(test_fill_refuses),
        cmocka_unit_test(test_reset_frees_the_tree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

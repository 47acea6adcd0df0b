// SPDX-License-Identifier: GPL-3.0-or-later
// Where facets end and where they miss each other, in 3-D.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/memory.h"
#include "model/surface_rims.h"

#include <math.h>
#include <string.h>

static const double everywhere_lower[3] = {-INFINITY, -INFINITY, -INFINITY};
static const double everywhere_upper[3] = {INFINITY, INFINITY, INFINITY};

enum { MOST = 20 };

/** Rectangles with points of their own, counter-clockwise about e_b x e_c. */
struct sheet {
    struct facets facets;
    double points[4 * MOST][3];
    int32_t nodes[MOST][4];
};

static void plate(struct sheet *sheet, int axis, double level, int b, double b0, double b1, int c, double c0,
                  double c1)
{
    const double along_b[2] = {b0, b1}, along_c[2] = {c0, c1};
    struct facets *f = &sheet->facets;
    for (int corner = 0; corner < 4; ++corner) {
        double *x = sheet->points[f->n_points];
        x[axis] = level;
        x[b] = along_b[corner == 1 || corner == 2];
        x[c] = along_c[corner >= 2];
        sheet->nodes[f->n_facets][corner] = (int32_t)f->n_points++;
    }
    ++f->n_facets;
    f->dim = 3;
    f->points = sheet->points;
    f->nodes = sheet->nodes;
}

/** A plate of 3 x 3 with a square hole of side 1, and the four walls of a duct that begins at @p x0 and whose
 * section is larger than the hole by @p wide on one side. */
static void duct(struct sheet *plate_with_hole, struct sheet *walls, double x0, double wide)
{
    memset(plate_with_hole, 0, sizeof *plate_with_hole);
    memset(walls, 0, sizeof *walls);
    plate(plate_with_hole, 0, 0.0, 1, 0.0, 3.0, 2, 0.0, 1.0);
    plate(plate_with_hole, 0, 0.0, 1, 0.0, 3.0, 2, 2.0, 3.0);
    plate(plate_with_hole, 0, 0.0, 1, 0.0, 1.0, 2, 1.0, 2.0);
    plate(plate_with_hole, 0, 0.0, 1, 2.0, 3.0, 2, 1.0, 2.0);
    plate(walls, 1, 1.0, 0, x0, 5.0, 2, 1.0, 2.0);
    plate(walls, 1, 2.0 + wide, 2, 1.0, 2.0, 0, x0, 5.0);
    plate(walls, 2, 1.0, 1, 1.0, 2.0 + wide, 0, x0, 5.0);
    plate(walls, 2, 2.0, 0, x0, 5.0, 1, 1.0, 2.0 + wide);
}

static struct surface_rims rims_of(const struct sheet *a, const struct sheet *b, double tolerance,
                                   double reach)
{
    const struct facets *const both[2] = {&a->facets, &b->facets};
    struct surface_rims rims;
    // what ends at the plate's outline and at the far end of the duct is outside
    const double lower[3] = {-2.0, 0.5, 0.5}, upper[3] = {4.0, 2.7, 2.7};
    assert_int_equal(surface_rims_find(both, 2, tolerance, reach, lower, upper, &rims), 0);
    return rims;
}

/** Edges of the hole are parts of the plates' edges: the corners of the duct hang on them. */
static void test_hanging_nodes(void **state)
{
    (void)state;
    struct sheet hole, walls;
    duct(&hole, &walls, 0.0, 0.0);
    struct surface_rims rims = rims_of(&hole, &walls, 0.0, 0.1);
    assert_int_equal(rims.n_open, 0);
    assert_true(rims.gap == 0.0);
    // without the duct: two short edges of the small plates, and the part of the large ones between them
    const struct facets *const alone = &hole.facets;
    assert_int_equal(surface_rims_find(&alone, 1, 0.0, 0.1, (double[3]){-2.0, 0.5, 0.5},
                                       (double[3]){4.0, 2.7, 2.7}, &rims),
                     0);
    assert_int_equal(rims.n_open, 4);
    assert_true(rims.gap == 0.0);
    assert_int_equal(surface_rims_find(&alone, 1, 0.0, 0.1, everywhere_lower, everywhere_upper, &rims), 0);
    assert_int_equal(rims.n_open, 4 + 8);
}

/** A duct that begins before or after the hole, or is too wide, by more or less than what may be. */
static void test_gaps(void **state)
{
    (void)state;
    struct sheet hole, walls;
    for (int side = -1; side <= 1; side += 2) {
        duct(&hole, &walls, 0.03 * side, 0.0);
        struct surface_rims rims = rims_of(&hole, &walls, 0.02, 0.5);
        assert_int_equal(rims.n_open, 4 + 4);
        assert_float_equal(rims.gap, 0.03, 1e-14);
        assert_true(fabs(rims.place[0]) <= 0.03 && rims.place[1] >= 1.0 && rims.place[1] <= 2.0);
        rims = rims_of(&hole, &walls, 0.04, 0.5);
        assert_int_equal(rims.n_open, 0);
        rims = rims_of(&hole, &walls, 0.01, 0.02); // two things that have nothing to do with each other
        assert_int_equal(rims.n_open, 8);
        assert_true(rims.gap == 0.0);
    }
    duct(&hole, &walls, 0.0, 0.3);
    struct surface_rims rims = rims_of(&hole, &walls, 0.02, 0.5);
    assert_true(rims.n_open > 0);
    assert_float_equal(rims.gap, 0.3, 1e-14);
    assert_float_equal(rims.place[1], 2.0, 0.31);
}

/** Two triangles and a quad in a row: six sides are open, and walked as the facets are; in 2-D two ends. */
static void test_open_edges(void **state)
{
    (void)state;
    double points[6][3] = {{0.0}};
    int32_t nodes[3][4] = {{4, 1, 0, -1}, {0, 3, 4, -1}, {1, 4, 5, 2}}, (*edges)[2];
    static const int32_t expected[6][2] = {{1, 0}, {0, 3}, {2, 1}, {5, 2}, {3, 4}, {4, 5}};
    struct facets facets = {.dim = 3, .n_points = 6, .n_facets = 3, .points = points, .nodes = nodes};
    size_t n;
    assert_int_equal(surface_rims_edges(&facets, &edges, &n), 0);
    assert_int_equal(n, 6);
    for (size_t e = 0; e < n; ++e) {
        bool found = false;
        for (int k = 0; k < 6; ++k)
            found = found || !memcmp(edges[e], expected[k], sizeof *edges);
        assert_true(found);
    }
    memory_free(edges);
    int32_t line[2][4] = {{2, 5, -1, -1}, {5, 1, -1, -1}};
    facets = (struct facets){.dim = 2, .n_points = 6, .n_facets = 2, .points = points, .nodes = line};
    assert_int_equal(surface_rims_edges(&facets, &edges, &n), 0);
    assert_int_equal(n, 2);
    assert_true(edges[0][0] == 1 && edges[0][1] == 1 && edges[1][0] == 2 && edges[1][1] == 2);
    memory_free(edges);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_hanging_nodes),
        cmocka_unit_test(test_gaps),
        cmocka_unit_test(test_open_edges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

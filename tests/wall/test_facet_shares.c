// SPDX-License-Identifier: GPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "wall/facet_shares.h"
#include "wall/projection.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static FILE *open_data(const char *name)
{
    char path[1024];
    const char *folder = getenv("srcdir");
    snprintf(path, sizeof path, "%s/tests/wall/%s", folder ? folder : ".", name);
    FILE *file = fopen(path, "r");
    if (!file)
        fail_msg("cannot open %s: set srcdir to the top of the source tree", path);
    return file;
}

static void assert_close(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance))
        fail_msg("%.12g instead of %.12g, tolerance %g", value, expected, tolerance);
}

static void test_reference_2d(void **state)
{
    (void)state;
    struct facet_shares shares;
    assert_int_equal(facet_shares_create(&shares, kernel_quintic(2, 1.0, false), 1.0, isa_best()), 0);
    FILE *file = open_data("facet_shares_2d.csv");
    char line[1024];
    int rows = 0;
    while (fgets(line, sizeof line, file)) {
        double a, s, f[SHARES], c[SHARES], value[SHARES];
        if (sscanf(line, "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", &a, &s, f, f + 1, f + 2, c, c + 1, c + 2) != 8)
            continue;
        ++rows;
        facet_shares_block(&shares, a, value);
        for (int k = 0; k < SHARES; ++k)
            assert_close(value[k], f[k], 1e-11);
        facet_shares_segment_exact(&shares, a, -s, s, value);
        for (int k = 0; k < SHARES; ++k)
            assert_close(value[k], c[k], 1e-8);
        facet_shares_segment(&shares, a, -s, s, value);
        for (int k = 0; k < SHARES; ++k)
            assert_close(value[k], c[k], 1e-5);
    }
    fclose(file);
    assert_int_equal(rows, 35);
    facet_shares_reset(&shares);
}

/** The table against quadrature off its nodes, weighted with what it multiplies: also at h / dx other than 1.
 */
static void test_table_2d(void **state)
{
    (void)state;
    static const double ratio[] = {1.0, 1.13};
    for (size_t t = 0; t < 2; ++t) {
        struct facet_shares shares;
        const double dx = 0.0173;
        assert_int_equal(
            facet_shares_create(&shares, kernel_quintic(2, ratio[t] * dx, false), dx, isa_best()), 0);
        assert_int_equal(shares.layers, t ? 4 : 3);
        for (double a = 0.013; a < 0.98; a *= 1.19)
            for (double s = 0.0071; s < 1.1; s *= 1.31) {
                double value[SHARES], exact[SHARES], f[SHARES];
                const double d = -a * shares.range, s0 = -0.3 * s * shares.range, s1 = s * shares.range;
                facet_shares_block(&shares, -d, f);
                facet_shares_segment(&shares, d, s0, s1, value);
                facet_shares_segment_exact(&shares, d, s0, s1, exact);
                assert_close(value[0] * f[0], exact[0] * f[0], 3e-6);
                assert_close(value[1] * f[1] * dx, exact[1] * f[1] * dx, 3e-6);
                assert_close(value[2] * f[2] * dx * dx, exact[2] * f[2] * dx * dx, 3e-6);
                assert_true(value[0] < 0.0 && value[1] < 0.0 && value[2] < 0.0);
            }
        facet_shares_reset(&shares);
    }
}

/** Edges of a polygon with these corners, relative to the foot point. */
static const struct projection_edges *edges_of(struct projection_edges *edges, int n,
                                               const double (*corners)[2])
{
    edges->n = n;
    for (int e = 0; e < n; ++e) {
        const double *a = corners[e], *b = corners[(e + 1) % n];
        const double x = b[0] - a[0], y = b[1] - a[1], length = hypot(x, y);
        edges->h[e] = (a[0] * y - a[1] * x) / length;
        edges->s0[e] = (a[0] * x + a[1] * y) / length;
        edges->s1[e] = (b[0] * x + b[1] * y) / length;
    }
    return edges;
}

static void test_reference_3d(void **state)
{
    (void)state;
    struct facet_shares shares;
    struct projection_edges edges;
    assert_int_equal(facet_shares_create(&shares, kernel_quintic(3, 1.0, false), 1.0, isa_best()), 0);
    FILE *file = open_data("facet_shares_3d.csv");
    char line[1024];
    int rows = 0;
    while (fgets(line, sizeof line, file)) {
        double a, f[SHARES], expected[SHARES], value[SHARES];
        const char *end = strrchr(line, '"');
        if (!end || sscanf(end + 1, ",%lf,%lf,%lf,%lf,%lf,%lf,%lf", &a, f, f + 1, f + 2, expected,
                           expected + 1, expected + 2) != 7)
            continue;
        ++rows;
        double low = strstr(line, "centre") ? -10.0 : 0.0, side = strstr(line, "unit") ? 1.0 : 20.0;
        const double square[4][2] = {
            {low, low}, {low + side, low}, {low + side, low + side}, {low, low + side}};
        facet_shares_block(&shares, a, value);
        for (int k = 0; k < SHARES; ++k)
            assert_close(value[k], f[k], 1e-11);
        facet_shares_polygon_exact(&shares, a, edges_of(&edges, 4, square), value);
        for (int k = 0; k < SHARES; ++k)
            assert_close(value[k], expected[k], 1e-8);
        facet_shares_polygon(&shares, a, edges_of(&edges, 4, square), value);
        for (int k = 0; k < SHARES; ++k)
            assert_close(value[k] * f[k], expected[k] * f[k], 1e-4);
    }
    fclose(file);
    assert_int_equal(rows, 9);
    facet_shares_reset(&shares);
}

/** Instruction sets differ by rounding: quads all around the foot point, small and large. */
static void test_instruction_sets(void **state)
{
    (void)state;
    static const char *const names[] = {"baseline", "v3", "v4"};
    struct facet_shares shares;
    struct projection_edges edges;
    double largest = 0.0;
    assert_int_equal(facet_shares_create(&shares, kernel_quintic(3, 1.0, false), 1.0, ISA_BASELINE), 0);
    for (int k = 0; k < 400; ++k) {
        const double x = fmod(0.37 * k, 5.0) - 2.5, y = fmod(0.61 * k, 5.0) - 2.5, size = 0.3 + 0.01 * k;
        const double quad[4][2] = {
            {x, y}, {x + size, y - 0.1}, {x + 1.1 * size, y + size}, {x, y + 0.8 * size}};
        double value[ISAS][SHARES];
        for (int isa = 0; isa < ISAS; ++isa) {
            shares.isa = isa_available(names[isa]) ? isa : ISA_BASELINE;
            facet_shares_polygon(&shares, 0.07 + 0.005 * k, edges_of(&edges, 4, quad), value[isa]);
            for (int f = 0; f < SHARES; ++f) {
                assert_close(value[isa][f], value[0][f], 1e-13);
                largest = fmax(largest, value[isa][f]);
            }
        }
    }
    assert_true(largest > 0.5);
    facet_shares_reset(&shares);
}

/** Shares of the parts of a polygon add up, also with the foot point on an edge, on a corner and outside. */
static void test_additive_3d(void **state)
{
    (void)state;
    struct facet_shares shares;
    struct projection_edges edges;
    assert_int_equal(facet_shares_create(&shares, kernel_quintic(3, 1.0, false), 1.0, isa_best()), 0);
    static const double foot[][2] = {{0.31, 0.17}, {0.0, 0.0}, {0.5, 0.0},
                                     {-0.4, 0.7},  {0.4, 0.4}, {2.0, 1.7}};
    for (size_t i = 0; i < sizeof foot / sizeof *foot; ++i)
        for (double d = -1.9; d < 2.0; d += 0.63) {
            const double x = foot[i][0], y = foot[i][1];
            const double quad[4][2] = {{-x, -y}, {2.0 - x, -y}, {2.0 - x, 1.7 - y}, {-x, 1.7 - y}};
            const double lower[3][2] = {{-x, -y}, {2.0 - x, -y}, {2.0 - x, 1.7 - y}};
            const double upper[3][2] = {{-x, -y}, {2.0 - x, 1.7 - y}, {-x, 1.7 - y}};
            double whole[SHARES], a[SHARES], b[SHARES], exact[SHARES], f[SHARES];
            facet_shares_block(&shares, fabs(d), f);
            facet_shares_polygon(&shares, d, edges_of(&edges, 4, quad), whole);
            facet_shares_polygon(&shares, d, edges_of(&edges, 3, lower), a);
            facet_shares_polygon(&shares, d, edges_of(&edges, 3, upper), b);
            facet_shares_polygon_exact(&shares, d, edges_of(&edges, 4, quad), exact);
            for (int k = 0; k < SHARES; ++k) {
                assert_close(a[k] + b[k], whole[k], 1e-12);
                assert_close(whole[k] * f[k], exact[k] * f[k], 1e-4);
                assert_true(whole[k] * d >= -1e-9);
            }
        }
    facet_shares_reset(&shares);
}

/** The pressure force is the exact gradient of the density: minus the slope of w_S S by the distance is w_G
 * G. */
static void test_gradient_2d(void **state)
{
    (void)state;
    struct facet_shares shares;
    assert_int_equal(facet_shares_create(&shares, kernel_quintic(2, 1.0, false), 1.0, isa_best()), 0);
    const double h = 1e-3, s0 = -0.4, s1 = 1.3;
    double difference = 0.0;
    for (double d = 0.2; d < 2.0; d += 0.31) {
        // a corner of 90 degrees: the second facet runs down from s1; moving away from the plane moves the
        // foot point on it
        double low[SHARES], high[SHARES], f[SHARES], g[SHARES], share[SHARES];
        facet_shares_segment_exact(&shares, d - h, s0 - 40.0, s1, low);
        facet_shares_segment_exact(&shares, d + h, s0 - 40.0, s1, high);
        facet_shares_block(&shares, d - h, f);
        facet_shares_block(&shares, d + h, g);
        double slope = (high[0] * g[0] - low[0] * f[0]) / (2.0 * h);
        facet_shares_block(&shares, s1, f);
        double side[2][SHARES];
        facet_shares_segment_exact(&shares, -s1, -40.0, -(d - h), side[0]);
        facet_shares_segment_exact(&shares, -s1, -40.0, -(d + h), side[1]);
        slope += (side[1][0] - side[0][0]) * f[0] / (2.0 * h);
        facet_shares_segment_exact(&shares, d, s0 - 40.0, s1, share);
        facet_shares_block(&shares, d, g);
        difference = fmax(difference, fabs(slope + share[1] * g[1]));
    }
    assert_close(difference, 0.0, 1e-5);
    facet_shares_reset(&shares);
}

/** The table of layers against sums, and the layers of a block against the block. */
static void test_layers_3d(void **state)
{
    (void)state;
    static const double ratio[] = {1.0, 1.13};
    for (size_t t = 0; t < 2; ++t) {
        struct facet_shares shares;
        const double dx = 0.0173, volume = dx * dx * dx;
        assert_int_equal(
            facet_shares_create(&shares, kernel_quintic(3, ratio[t] * dx, false), dx, isa_best()), 0);
        double scale[LAYER_MOMENTS], value[LAYER_MOMENTS], exact[LAYER_MOMENTS];
        facet_shares_layer_exact(&shares, 0.5 * dx, scale);
        for (double y = 0.5 * dx; y < shares.kernel.support; y += 0.0137 * dx) {
            facet_shares_layer(&shares, y, value);
            facet_shares_layer_exact(&shares, y, exact);
            for (int k = 0; k < LAYER_MOMENTS; ++k)
                assert_close(value[k] / scale[k], exact[k] / scale[k], 1e-8);
        }
        for (double d = 0.0; d < shares.range; d += 0.237 * dx) {
            double block[SHARES], w = 0.0, normal = 0.0, viscous = 0.0;
            facet_shares_block(&shares, d, block);
            for (int m = 0; m < shares.layers; ++m) {
                facet_shares_layer(&shares, d + (m + 0.5) * dx, value);
                w += volume * value[LAYER_W];
                normal -= volume * value[LAYER_NORMAL];
                viscous -= volume * value[LAYER_VISCOUS];
            }
            assert_close(w, block[SHARE_DENSITY], 1e-8);
            assert_close(normal * dx, block[SHARE_PRESSURE] * dx, 1e-8);
            assert_close(viscous * dx * dx, block[SHARE_VISCOUS] * dx * dx, 1e-8);
        }
        facet_shares_reset(&shares);
    }
}

/** What the pieces of a quad whose corners lie @p off beside its mean plane add to the sums of a particle. */
static int quad_sums(const struct facet_shares *shares, double off, double flat, int before,
                     double sums[SHARES])
{
    const double corners[4][3] = {{-1.3, -1.1, off}, {1.6, -1.2, -off}, {1.5, 1.3, off}, {-1.4, 1.2, -off}},
                 place[3] = {0.37, -0.23, 0.71};
    struct piece pieces[4];
    const int n = piece_cut(pieces, 0, 3, 4, corners, flat, before);
    sums[0] = sums[1] = sums[2] = 0.0;
    for (int p = 0; p < n; ++p) {
        struct projection at;
        double share[SHARES], block[SHARES];
        projection_find(&at, &pieces[p], place, 1e-7);
        facet_shares_polygon(shares, at.d, &at.edges, share);
        facet_shares_block(shares, fabs(at.d), block);
        for (int k = 0; k < SHARES; ++k)
            sums[k] += share[k] * block[k];
    }
    return n;
}

/** A quad that warps is cut without a jump, is warped as a whole at twice that, and stays as it is on
 * request. */
static void test_warping_quad(void **state)
{
    (void)state;
    const double flat = 0.02;
    struct facet_shares shares;
    double plane[SHARES], cut[SHARES], before[SHARES], half[SHARES], whole[SHARES];
    assert_int_equal(facet_shares_create(&shares, kernel_quintic(3, 1.0, false), 1.0, isa_best()), 0);
    assert_int_equal(quad_sums(&shares, flat * (1.0 - 1e-7), flat, 0, plane), 1);
    assert_int_equal(quad_sums(&shares, flat * (1.0 + 1e-7), flat, 0, cut), 4);
    for (int k = 0; k < SHARES; ++k)
        assert_close(cut[k], plane[k], 1e-6 * fabs(plane[k]));
    assert_int_equal(quad_sums(&shares, 1.5 * flat, flat, 0, half), 4);
    assert_int_equal(quad_sums(&shares, 0.75 * flat, 0.0, 0, before), 4);
    for (int k = 0; k < SHARES; ++k) /* half way its corners lie half as far out of the plane as they do */
        assert_close(half[k], before[k], 1e-9 * fabs(plane[k]));
    assert_int_equal(quad_sums(&shares, 2.0 * flat, flat, 0, half), 4);
    assert_int_equal(quad_sums(&shares, 2.0 * flat, 0.0, 0, whole), 4);
    for (int k = 0; k < SHARES; ++k) {
        assert_close(half[k], whole[k], 1e-9 * fabs(plane[k]));
        assert_true(fabs(whole[k] - plane[k]) > 1e-3 * fabs(plane[k]));
    }
    assert_int_equal(quad_sums(&shares, 1.1 * flat, flat, 1, whole), 1);
    assert_int_equal(quad_sums(&shares, 0.9 * flat, flat, 4, cut), 4);
    for (int k = 0; k < SHARES; ++k)
        assert_close(cut[k], whole[k], 1e-4 * fabs(plane[k]));
    facet_shares_reset(&shares);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_reference_2d), cmocka_unit_test(test_table_2d),
        cmocka_unit_test(test_reference_3d), cmocka_unit_test(test_instruction_sets),
        cmocka_unit_test(test_additive_3d),  cmocka_unit_test(test_gradient_2d),
        cmocka_unit_test(test_layers_3d),    cmocka_unit_test(test_warping_quad),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

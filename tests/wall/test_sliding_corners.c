// SPDX-License-Identifier: GPL-3.0-or-later
// Static corners: density and sum of kernel gradients of particles on a true lattice beside walls that meet
// at an angle, with facet shares and with the published rule; and how they change while a particle slides
// past a corner.
#include "wall_scene.h"

#define PI 3.14159265358979323846

struct expected {
    double density,
        gradient; /**< in units of the fluid density and of density / spacing; negative: unknown */
};

static void compare(struct scene *scene, const struct expected *expected, double digit, double radius)
{
    double density, gradient;
    scene_errors(scene, radius, &density, &gradient);
    print_message("density %.5f (%.4f) gradient %.5f (%.4f)\n", density, expected->density, gradient,
                  expected->gradient);
    if (expected->density >= 0.0)
        assert_true(fabs(density - expected->density) < 0.51 * digit);
    if (expected->gradient >= 0.0)
        assert_true(fabs(gradient - expected->gradient) < 0.51 * (expected->gradient > 0.1 ? 1e-3 : digit));
}

/** Walls from the origin along the directions 0 and @p angle; the fluid lies between them. */
static void sector_walls(struct scene *scene, double apex_x, double apex_y, double angle, double length)
{
    const double points[3][3] = {{apex_x + length, apex_y, 0.0},
                                 {apex_x, apex_y, 0.0},
                                 {apex_x + length * cos(angle), apex_y + length * sin(angle), 0.0}};
    scene_chain(scene, 3, points, false);
}

static void square_lattice(struct scene *scene, bool (*fluid)(double x, double y))
{
    for (int j = -10; j < 10; ++j)
        for (int i = -10; i < 10; ++i)
            if (fluid(i + 0.5, j + 0.5))
                scene_add(scene, i + 0.5, j + 0.5, 0.0);
}

static bool quadrant(double x, double y)
{
    return x > 0.0 && y > 0.0;
}

static bool three_quadrants(double x, double y)
{
    return !(x > 0.0 && y < 0.0);
}

static bool around_plate(double x, double y)
{
    return !(x > 0.0 && fabs(y) < 2.0);
}

static void test_square(bool (*fluid)(double, double), double angle, const struct expected expected[2])
{
    for (int rule = 0; rule < 2; ++rule) {
        struct scene scene;
        scene_start(&scene, 2, -40.0, 40.0, false);
        square_lattice(&scene, fluid);
        sector_walls(&scene, 0.0, 0.0, angle, 30.0);
        scene_build(&scene, rule ? CORNERS_PAPER : CORNERS_SHARES);
        compare(&scene, &expected[rule], 1e-4, 5.0);
        scene_end(&scene);
    }
}

static void test_concave(void **state)
{
    (void)state;
    test_square(quadrant, 0.5 * PI, (struct expected[2]){{0.0001, 0.0005}, {0.0473, 0.146}});
}

static void test_convex(void **state)
{
    (void)state;
    test_square(three_quadrants, 1.5 * PI, (struct expected[2]){{0.0002, 0.0005}, {0.0891, 0.202}});
}

static void test_plate_tip(void **state)
{
    (void)state;
    const struct expected expected[2] = {{0.0002, 0.0005}, {0.0891, 0.202}};
    for (int rule = 0; rule < 2; ++rule) {
        struct scene scene;
        scene_start(&scene, 2, -40.0, 40.0, false);
        square_lattice(&scene, around_plate);
        const double points[4][3] = {{30.0, 2.0, 0.0}, {0.0, 2.0, 0.0}, {0.0, -2.0, 0.0}, {30.0, -2.0, 0.0}};
        scene_chain(&scene, 4, points, false);
        scene_build(&scene, rule ? CORNERS_PAPER : CORNERS_SHARES);
        compare(&scene, &expected[rule], 1e-4, 5.0);
        scene_end(&scene);
    }
}

/** Fluid on a hexagonal lattice between rows that meet in a lattice point; walls half a row outside. */
static void hexagonal(int degrees, const struct expected expected[2])
{
    const double a = sqrt(2.0 / sqrt(3.0)), half = 0.25 * sqrt(3.0) * a, angle = degrees * PI / 180.0;
    for (int rule = 0; rule < 2; ++rule) {
        struct scene scene;
        scene_start(&scene, 2, -40.0, 40.0, false);
        for (int j = -12; j <= 12; ++j)
            for (int i = -24; i <= 24; ++i) {
                double x = a * (i + 0.5 * j), y = 0.5 * sqrt(3.0) * a * j, theta = atan2(y, x);
                theta += theta < -1e-9 ? 2.0 * PI : 0.0;
                if (x * x + y * y < 100.0 && theta < angle + 1e-9)
                    scene_add(&scene, x, y, 0.0);
            }
        // where the line at -half below direction 0 meets the one at -half beside direction `angle`
        double shift = -half * (1.0 + cos(angle)) / sin(angle);
        sector_walls(&scene, shift, -half, angle, 30.0);
        scene_build(&scene, rule ? CORNERS_PAPER : CORNERS_SHARES);
        compare(&scene, &expected[rule], 1e-3, 7.0);
        scene_end(&scene);
    }
}

static void test_hexagonal_60(void **state)
{
    (void)state;
    hexagonal(60, (struct expected[2]){{0.011, 0.008}, {0.004, 0.043}});
}

static void test_hexagonal_120(void **state)
{
    (void)state;
    hexagonal(120, (struct expected[2]){{0.008, 0.020}, {0.118, 0.305}});
}

static void test_hexagonal_240(void **state)
{
    (void)state;
    hexagonal(240, (struct expected[2]){{0.014, 0.0135}, {0.079, 0.145}});
}

static void test_hexagonal_300(void **state)
{
    (void)state;
    hexagonal(300, (struct expected[2]){{0.011, 0.017}, {0.121, 0.301}});
}

/** The cube [0, size]^3: @p inside 0 with normals out of it, 1 with normals into it; two triangles or one
 * quad a side. */
static void cube_walls(struct scene *scene, double low, double high, bool inside, bool triangles)
{
    double points[8][3];
    static const int32_t quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                        {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    int32_t nodes[12][4];
    size_t n = 0;
    for (int c = 0; c < 8; ++c)
        for (int k = 0; k < 3; ++k)
            points[c][k] = c >> k & 1 ? high : low;
    for (int q = 0; q < 6; ++q) {
        int32_t f[4];
        for (int k = 0; k < 4; ++k)
            f[k] = quads[q][inside ? 3 - k : k];
        if (triangles) {
            memcpy(nodes[n++], (int32_t[4]){f[0], f[1], f[2], -1}, sizeof nodes[0]);
            memcpy(nodes[n++], (int32_t[4]){f[0], f[2], f[3], -1}, sizeof nodes[0]);
        } else {
            memcpy(nodes[n++], f, sizeof f);
        }
    }
    scene_facets(scene, 8, (const double(*)[3])points, n, (const int32_t(*)[4])nodes);
}

/** Errors near the corner (or, with @p edge, near the middle of an edge) of a cube with its corner at the
 * origin. */
static void cube(bool inside, bool edge, bool triangles, bool paper, const struct expected *expected)
{
    struct scene scene;
    const double length = 20.0, at = edge ? 10.0 : 0.0;
    scene_start(&scene, 3, -30.0, 30.0, false);
    // walls move by -at along x, so that the place looked at is the origin
    for (int k = -7; k < 7; ++k)
        for (int j = -7; j < 7; ++j)
            for (int i = -7; i < 7; ++i) {
                double x = i + 0.5, y = j + 0.5, z = k + 0.5;
                bool in_cube = x + at > 0.0 && y > 0.0 && z > 0.0;
                if (in_cube == inside)
                    scene_add(&scene, x, y, z);
            }
    cube_walls(&scene, 0.0, length, inside, triangles);
    for (int c = 0; c < 8; ++c)
        scene.surface_definition.built.points[c][0] -= at;
    scene_build(&scene, paper ? CORNERS_PAPER : CORNERS_SHARES);
    compare(&scene, expected, 1e-4, 3.5);
    scene_end(&scene);
}

static void test_cube_corners(void **state)
{
    (void)state;
    for (int triangles = 0; triangles < 2; ++triangles) {
        cube(true, true, triangles, false, &(struct expected){0.0003, -1.0});
        cube(true, false, triangles, false, &(struct expected){0.0006, -1.0});
        cube(false, true, triangles, false, &(struct expected){0.0003, -1.0});
        cube(false, false, triangles, false, &(struct expected){0.0003, -1.0});
    }
    cube(true, true, false, true, &(struct expected){0.0450, -1.0});
    cube(true, false, false, true, &(struct expected){0.1260, -1.0});
    cube(false, true, false, true, &(struct expected){0.0860, -1.0});
    cube(false, false, false, true, &(struct expected){0.0951, -1.0});
}

/** Largest step of the wall part of density and gradient while one particle slides along y = height towards
 * the second wall. */
static void slide(double degrees, enum corners corners, double height, struct expected *step)
{
    const double angle = degrees * PI / 180.0, stride = 2e-4;
    struct scene scene;
    scene_start(&scene, 2, -40.0, 40.0, false);
    scene_add(&scene, 0.0, height, 0.0);
    sector_walls(&scene, 0.0, 0.0, angle, 30.0);
    scene.view.skin = 10.0;
    scene_build(&scene, corners);
    double old_rho = 0.0, old[3];
    *step = (struct expected){0.0, 0.0};
    for (int n = 0; n < 25000; ++n) {
        double x = 4.0 - n * stride, rho = 0.0, g[3] = {0.0, 0.0, 0.0};
        // concave: stop before the second wall; convex: go on past the corner
        if (degrees < 180.0 && x * sin(angle) - height * cos(angle) < 0.2)
            break;
        scene.particles->x[0][0] = x;
        assert_int_equal(boundary_prepare(scene.boundary, &scene.view, false), 0);
        scene_wall_sums(&scene, 0, &rho, g);
        if (n > 0) {
            double change = 0.0;
            for (int k = 0; k < 2; ++k)
                change += (g[k] - old[k]) * (g[k] - old[k]);
            step->density = fmax(step->density, fabs(rho - old_rho));
            step->gradient = fmax(step->gradient, sqrt(change));
        }
        old_rho = rho;
        memcpy(old, g, sizeof old);
    }
    scene_end(&scene);
}

static void test_continuity(void **state)
{
    (void)state;
    static const double angles[] = {60.0, 90.0, 120.0, 150.0, 175.0, 210.0, 270.0, 330.0};
    for (size_t a = 0; a < sizeof angles / sizeof *angles; ++a)
        for (double height = 0.3; height < 2.0; height += 0.55) {
            struct expected step;
            slide(angles[a], CORNERS_SHARES, height, &step);
            assert_true(step.density < 1.5e-4);
            assert_true(step.gradient < 2.5e-4);
        }
    struct expected step;
    slide(150.0, CORNERS_PAPER, 0.5, &step);
    assert_true(step.density > 0.05);
    assert_true(step.gradient > 0.1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_concave),       cmocka_unit_test(test_convex),
        cmocka_unit_test(test_plate_tip),     cmocka_unit_test(test_hexagonal_60),
        cmocka_unit_test(test_hexagonal_120), cmocka_unit_test(test_hexagonal_240),
        cmocka_unit_test(test_hexagonal_300), cmocka_unit_test(test_cube_corners),
        cmocka_unit_test(test_continuity),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

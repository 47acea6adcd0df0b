// SPDX-License-Identifier: GPL-3.0-or-later
// The load on turning walls: exact for rigid motions whatever the facets, blind to waves that particles do
// not see, by hand for a stretched segment.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/memory.h"
#include "model/mesh.h"
#include "sph/turning_load.h"

#include <math.h>
#include <string.h>

static const double size[3] = {0.8, 0.6, 1.0}, spin[3] = {0.7, -0.4, 1.1}, viscosity = 0.3;

/** The skin of a box, its points numbered by the mesh, with cells of edge 0.2 (2-D: no z). */
static void box_create(struct surface *surface, int dim)
{
    const double lower[3] = {-0.1, 0.2, 0.3},
                 upper[3] = {lower[0] + size[0], lower[1] + size[1], lower[2] + size[2]};
    struct mesh mesh;
    struct facets skin;
    assert_int_equal(mesh_create_grid(&mesh, dim, lower, upper, (const int[3]){4, 3, 5}), 0);
    assert_int_equal(mesh_skin(&mesh, NULL, 0, &skin), 0);
    memset(surface, 0, sizeof *surface);
    surface->dim = dim;
    surface->n_points = skin.n_points;
    surface->n_facets = skin.n_facets;
    surface->X = skin.points;
    surface->nodes = skin.nodes;
    surface->now.x = memory_create(skin.n_points, sizeof *surface->now.x);
    surface->now.v = memory_create(skin.n_points, sizeof *surface->now.v);
    surface->load = memory_create(skin.n_points, sizeof *surface->load);
    memcpy(surface->now.x, surface->X, skin.n_points * sizeof *surface->X);
    mesh_reset(&mesh);
}

static void box_free(struct surface *surface)
{
    memory_free(surface->X);
    memory_free(surface->nodes);
    memory_free(surface->now.x);
    memory_free(surface->now.v);
    memory_free(surface->load);
}

/** Velocities of a turning body plus @p wave times a wave that changes sign at every second point. */
static void move(struct surface *surface, double turn, double wave)
{
    for (size_t i = 0; i < surface->n_points; ++i) {
        const double *x = surface->now.x[i];
        int sum = 0;
        for (int k = 0; k < surface->dim; ++k)
            sum += (int)lround(x[k] / 0.2 + 0.5);
        for (int k = 0; k < surface->dim; ++k) {
            const int a = (k + 1) % 3, b = (k + 2) % 3;
            const double rotation = (surface->dim == 3 || a == 2 ? spin[a] * x[b] : 0.0) -
                                    (surface->dim == 3 || b == 2 ? spin[b] * x[a] : 0.0);
            surface->now.v[i][k] = turn * (0.3 - 0.1 * k + rotation) + wave * (sum / 2 % 2 ? 1.0 : -1.0);
        }
    }
}

/** Force, moment about the origin, and largest load of a point. */
static double apply(struct surface *surface, double h, double force[3], double moment[3])
{
    struct turning_load load;
    double largest = 0.0;
    assert_int_equal(turning_load_create(&load, surface, h), 0);
    memset(surface->load, 0, surface->n_points * sizeof *surface->load);
    turning_load_add(&load, viscosity, surface->load);
    memset(force, 0, 3 * sizeof *force);
    memset(moment, 0, 3 * sizeof *moment);
    for (size_t i = 0; i < surface->n_points; ++i)
        for (int k = 0; k < 3; ++k) {
            const int a = (k + 1) % 3, b = (k + 2) % 3;
            force[k] += surface->load[i][k];
            moment[k] +=
                surface->now.x[i][a] * surface->load[i][b] - surface->now.x[i][b] * surface->load[i][a];
            largest = fmax(largest, fabs(surface->load[i][k]));
        }
    turning_load_reset(&load);
    return largest;
}

/** -2 eta volume omega, on facets that are long or short against h, and with a wave on top of short ones. */
static void test_rotation(void **state)
{
    (void)state;
    for (int dim = 2; dim <= 3; ++dim) {
        struct surface surface;
        double force[3], moment[3];
        box_create(&surface, dim);
        const double volume = size[0] * size[1] * (dim == 3 ? size[2] : 1.0);
        for (int k = 0; k < 3; ++k) {
            static const double h[3] = {0.05, 0.13, 0.4};
            move(&surface, 1.0, k == 0 ? 0.0 : 5.0);
            apply(&surface, h[k], force, moment);
            for (int d = 0; d < 3; ++d) {
                const double expected = dim == 3 || d == 2 ? -2.0 * viscosity * volume * spin[d] : 0.0;
                assert_true(fabs(force[d]) < 1e-13);
                /* of the wave little is left: it has a mean on some sides */
                assert_true(fabs(moment[d] - expected) < (k == 0 ? 1e-13 : 0.2));
            }
        }
        box_free(&surface);
    }
}

static void test_wave(void **state)
{
    (void)state;
    for (int dim = 2; dim <= 3; ++dim) {
        struct surface surface;
        double force[3], moment[3];
        box_create(&surface, dim);
        move(&surface, 0.0, 1.0);
        const double seen = apply(&surface, 0.05, force, moment),
                     blurred = apply(&surface, 0.4, force, moment);
        print_message("%d-D: a wave makes loads up to %g, averaged %g\n", dim, seen, blurred);
        assert_true(seen > 0.05);
        assert_true(blurred < 0.1 * seen);
        box_free(&surface);
    }
}

/** A box without the side where x is largest, held along its rim: nothing pulls on the whole. */
static void test_open(void **state)
{
    (void)state;
    for (int dim = 2; dim <= 3; ++dim) {
        struct surface surface;
        double force[3], moment[3];
        size_t n = 0;
        box_create(&surface, dim);
        for (size_t f = 0; f < surface.n_facets; ++f) {
            bool side = true;
            for (int c = 0; c < 4 && surface.nodes[f][c] >= 0; ++c)
                side = side && surface.X[surface.nodes[f][c]][0] > size[0] - 0.1 - 1e-9;
            if (!side)
                memcpy(surface.nodes[n++], surface.nodes[f], sizeof *surface.nodes);
        }
        assert_int_equal(surface.n_facets - n, dim == 2 ? 3 : 15);
        surface.n_facets = n;
        move(&surface, 1.0, 0.6);
        for (size_t i = 0; i < surface.n_points; ++i)
            for (int k = 0; k < 3 && surface.X[i][0] > size[0] - 0.1 - 1e-9; ++k)
                surface.now.v[i][k] = 0.0;
        for (int k = 0; k < 3; ++k) {
            static const double h[3] = {0.05, 0.13, 0.4};
            assert_true(apply(&surface, h[k], force, moment) > 0.01);
            for (int d = 0; d < 3; ++d)
                assert_true(fabs(force[d]) < 1e-14);
        }
        box_free(&surface);
    }
}

/** A segment along x that is stretched and turned: e_z x (v_end - v_begin), half to each end; nothing to the
 * points that a wall appends after its creation. */
static void test_segment(void **state)
{
    (void)state;
    enum { POINTS = 400 };
    double X[POINTS][3] = {{0.1, 0.2, 0.0}, {0.5, 0.2, 0.0}},
           v[POINTS][3] = {{0.3, -0.2, 0.0}, {0.9, 0.4, 0.0}}, load[POINTS][3];
    int32_t nodes[1][4] = {{0, 1, -1, -1}};
    struct surface surface = {
        .dim = 2, .n_points = 2, .n_facets = 1, .X = X, .nodes = nodes, .now = {.x = X, .v = v}};
    struct turning_load turning;
    for (int i = 2; i < POINTS; ++i)
        for (int k = 0; k < 2; ++k)
            v[i][k] = X[i][k] = 1.0 + 0.1 * i + k;
    for (int k = 0; k < 2; ++k) {
        memset(load, 0, sizeof load);
        surface.n_points = 2;
        assert_int_equal(turning_load_create(&turning, &surface, k == 0 ? 0.1 : 0.7), 0);
        assert_true((turning.passes > 0) == (k == 1));
        surface.n_points = POINTS;
        turning_load_add(&turning, viscosity, load);
        for (int i = 0; i < POINTS; ++i) {
            const double expected = i < 2 && k == 0 ? 0.5 * viscosity * 0.6 : 0.0;
            assert_true(k == 1 || fabs(load[i][0] + expected) < 1e-15);
            assert_true(k == 1 || fabs(load[i][1] - expected) < 1e-15);
            assert_true(i < 2 || (load[i][0] == 0.0 && load[i][1] == 0.0));
        }
        turning_load_reset(&turning);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rotation),
        cmocka_unit_test(test_wave),
        cmocka_unit_test(test_open),
        cmocka_unit_test(test_segment),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

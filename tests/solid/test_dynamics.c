// SPDX-License-Identifier: GPL-3.0-or-later
// clang-format off
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>
// clang-format on

#include "bench.h"
#include "solid/generalized_alpha.h"

static void test_coefficients(void **state)
{
    (void)state;
    const struct generalized_alpha trapezoidal = generalized_alpha_of(1);
    assert_true(trapezoidal.alpha_m == 0.5 && trapezoidal.alpha_f == 0.5);
    assert_true(trapezoidal.beta == 0.25 && trapezoidal.gamma == 0.5);
    const struct generalized_alpha damped = generalized_alpha_of(0.8); /* 1/3, 4/9, 100/324, 11/18 */
    assert_true(fabs(damped.alpha_m - 1.0 / 3) < 1e-15 && fabs(damped.alpha_f - 4.0 / 9) < 1e-15);
    assert_true(fabs(damped.beta - 100.0 / 324) < 1e-15 && fabs(damped.gamma - 11.0 / 18) < 1e-15);
}

/** Clamped at x = 0: 1 x 0.05, rubber, set swinging in about its first mode. */
static void cantilever(struct bench *bench, int length, int height)
{
    const double upper[3] = {1, 0.05, 0};
    bench_grid(bench, 2, upper, (const int[3]){length, height, 0});
    bench_support(bench, "x-", true, true, false);
    bench->mesh.velocity[1] = bench_expression("1e-4*x*x*(6 - 4*x + x*x)/3");
}

static double tip(const struct bench *bench)
{
    return bench_field(bench, "Displacement")[bench->mesh.mesh.n_nodes - 1][1];
}

/** First frequency of Euler and Bernoulli's beam with E/(1 - nu^2); shear and rotary inertia lower it by
 * about 0.3 %. */
static void test_cantilever_frequency(void **state)
{
    (void)state;
    struct bench bench;
    const double modulus = 1400 / (1 - 0.16), h = 0.05;
    const double f = 1.87510407 * 1.87510407 / (2 * M_PI) * sqrt(modulus * h * h / (12 * 1100));
    const double dt = 0.01 / f;
    double previous = 0, first = 0, last = 0;
    int crossings = 0;
    cantilever(&bench, 20, 1);
    bench.mesh.rho_infinity = 0.6;
    bench_start(&bench);
    for (int k = 0; k < 430; k++) {
        assert_int_equal(bench_step(&bench, dt), 0);
        const double now = tip(&bench);
        if (previous < 0 && now >= 0) {
            last = bench.t - dt * now / (now - previous);
            if (crossings++ == 0)
                first = last;
        }
        previous = now;
    }
    assert_int_equal(crossings, 4);
    const double measured = 3 / (last - first);
    assert_true(measured / f > 0.99 && measured / f < 1.001);
    bench_reset(&bench);
}

/** A block flying and turning free keeps momentum and angular momentum; linear ones to rounding. */
static void test_free_flight(void **state)
{
    (void)state;
    struct bench bench;
    const double upper[3] = {0.4, 0.2, 0.3};
    bench_grid(&bench, 3, upper, (const int[3]){2, 2, 2});
    bench.mesh.velocity[0] = bench_expression("0.3 - 1.5*y");
    bench.mesh.velocity[1] = bench_expression("-0.2 + 1.5*x");
    bench.mesh.velocity[2] = bench_expression("0.11");
    bench.mesh.rho_infinity = 1;
    bench.mesh.newton_tolerance = 1e-13;
    bench_start(&bench);
    struct solid_energies energies;
    solid_energies(bench.solid, &energies);
    const double kinetic = energies.kinetic, mass = 1100 * 0.4 * 0.2 * 0.3;
    const double vx = 0.3 - 1.5 * 0.1, vy = -0.2 + 1.5 * 0.2, inertia = mass * (0.16 + 0.04) / 12;
    assert_true(fabs(kinetic - 0.5 * (mass * (vx * vx + vy * vy + 0.0121) + inertia * 2.25)) < 1e-12);
    for (int k = 0; k < 50; k++)
        assert_int_equal(bench_step(&bench, 0.01), 0);
    struct solid_place place;
    double d[3], v[3], a[3];
    assert_int_equal(solid_locate(bench.solid, (const double[3]){0.2, 0.1, 0.15}, &place), 0);
    solid_evaluate(bench.solid, &place, d, v, a);
    assert_true(fabs(d[2] - 0.055) < 1e-10 && fabs(v[2] - 0.11) < 1e-10);
    assert_true(fabs(d[0] - 0.5 * vx) < 1e-5 && fabs(d[1] - 0.5 * vy) < 1e-5);
    solid_energies(bench.solid, &energies);
    assert_true(fabs((energies.kinetic + energies.elastic) / kinetic - 1) < 1e-3);
    bench_reset(&bench);
}

/** Small vibrations: the undamped method conserves energy over many steps; with rho_infinity = 0 it may only
 * fall. */
static void test_energy(void **state)
{
    (void)state;
    for (int damped = 0; damped < 2; damped++) {
        struct bench bench;
        struct solid_energies energies;
        cantilever(&bench, 8, 1);
        bench.mesh.rho_infinity = damped ? 0 : 1;
        bench_start(&bench);
        solid_energies(bench.solid, &energies);
        const double start = energies.kinetic;
        assert_true(start > 0 && energies.elastic == 0);
        double largest = 0;
        for (int k = 0; k < 800; k++) {
            assert_int_equal(bench_step(&bench, 1.3), 0);
            solid_energies(bench.solid, &energies);
            largest = fmax(largest, fabs((energies.kinetic + energies.elastic) / start - 1));
        }
        if (damped)
            assert_true(energies.kinetic + energies.elastic < 0.999 * start);
        else
            assert_true(largest < 1e-6);
        bench_reset(&bench);
    }
}

/** Work of loads and supports = energy gained (rho_infinity = 1, small motion), and the reaction balances the
 * load. */
static void test_external_work(void **state)
{
    (void)state;
    struct bench bench;
    struct solid_energies energies;
    cantilever(&bench, 8, 1);
    expression_destroy(bench.mesh.velocity[1]);
    bench.mesh.velocity[1] = NULL;
    bench.mesh.rho_infinity = 1;
    bench_load(&bench, "x+", 1, "1e-5*sin(t)");
    bench_load(&bench, NULL, 1, "-1e-6*t");
    bench.supports[0].moves = true;
    bench.supports[0].motion.kind = MOTION_FIELD;
    bench.supports[0].motion.displacement[1] = bench_expression("1e-4*(1 - cos(0.7*t))");
    bench.supports[0].motion.velocity[1] = bench_expression("0.7e-4*sin(0.7*t)");
    bench.supports[0].motion.acceleration[1] = bench_expression("0.49e-4*cos(0.7*t)");
    bench_start(&bench);
    for (int k = 0; k < 400; k++)
        assert_int_equal(bench_step(&bench, 0.01), 0);
    solid_energies(bench.solid, &energies);
    assert_true(energies.external > 1e-9);
    assert_true(fabs((energies.kinetic + energies.elastic) / energies.external - 1) < 2e-3);
    bench_reset(&bench);
}

static double tip_after(double dt, double rho_infinity)
{
    struct bench bench;
    cantilever(&bench, 4, 1);
    bench.mesh.rho_infinity = rho_infinity;
    bench_load(&bench, "x+", 1, "1e-4*t*t");
    bench_start(&bench);
    for (int k = 0; k < (int)(16 / dt + 0.5); k++)
        assert_int_equal(bench_step(&bench, dt), 0);
    const double d = tip(&bench);
    bench_reset(&bench);
    return d;
}

/** Halving the step divides the error by four. */
static void test_second_order(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        const double rho = k == 0 ? 0.8 : 0.3;
        const double a = tip_after(0.4, rho), b = tip_after(0.2, rho), c = tip_after(0.1, rho);
        const double order = log2(fabs((a - b) / (b - c)));
        print_message("order %g, tip %g\n", order, c);
        assert_true(order > 1.8 && order < 2.2);
    }
}

/** From rest under gravity the first acceleration is that of free fall. */
static void test_start(void **state)
{
    (void)state;
    struct bench bench;
    const double upper[3] = {0.4, 0.2, 0};
    bench_grid(&bench, 2, upper, (const int[3]){3, 2, 0});
    bench_load(&bench, NULL, 1, "-9.81 + 3*t");
    bench.model.time.body_force[0] = bench_expression("0.7 - t"); /* on everything in the deck */
    bench.t = 0.5;
    bench_start(&bench);
    const double(*a)[3] = bench_field(&bench, "Acceleration");
    for (size_t n = 0; n < bench.mesh.mesh.n_nodes; n++)
        assert_true(fabs(a[n][1] + 8.31) < 1e-12 && fabs(a[n][0] - 0.2) < 1e-12);
    assert_true(isinf(solid_stable_step(bench.solid)));
    assert_string_equal(solid_name(bench.solid), "body");
    assert_ptr_equal(solid_mesh(bench.solid), &bench.mesh.mesh);
    assert_int_equal(bench_step(&bench, 0.1), 0);
    assert_true(fabs(solid_positions(bench.solid)[0][1] - bench_field(&bench, "Displacement")[0][1]) < 1e-15);
    expression_destroy(bench.model.time.body_force[0]);
    bench_reset(&bench);
}

/** A load that crushes the mesh, and one that is not a number, end with a message. */
static void test_failures(void **state)
{
    (void)state;
    struct bench bench;
    cantilever(&bench, 4, 1);
    bench_load(&bench, "x+", 0, "t > 0 ? -1e7 : 0");
    bench_start(&bench);
    assert_int_equal(bench_step(&bench, 0.5), STATUS_NUMERICAL);
    bench_reset(&bench);

    cantilever(&bench, 4, 1);
    bench_load(&bench, "x+", 0, "t > 0 ? log(-t) : 0");
    bench_start(&bench);
    assert_int_equal(bench_step(&bench, 0.5), STATUS_NUMERICAL);
    bench_reset(&bench);

    cantilever(&bench, 4, 1);
    bench.mesh.displacement[0] = bench_expression("-3*x");
    assert_int_equal(solid_create(&bench.solid, &bench.model, 0), 0);
    assert_int_equal(solid_start(bench.solid, 0), STATUS_NUMERICAL);
    bench_reset(&bench);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_coefficients),  cmocka_unit_test(test_cantilever_frequency),
        cmocka_unit_test(test_free_flight),   cmocka_unit_test(test_energy),
        cmocka_unit_test(test_external_work), cmocka_unit_test(test_second_order),
        cmocka_unit_test(test_start),         cmocka_unit_test(test_failures),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

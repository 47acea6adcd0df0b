// SPDX-License-Identifier: GPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "model/motion.h"

#include <math.h>

static struct expression *make(const char *text)
{
    struct expression *expression = NULL;
    char message[256];
    const struct expression_scope scope = {0};
    if (expression_create(&expression, text, &scope, message, sizeof message))
        fail_msg("%s: %s", text, message);
    return expression;
}

static void close_to(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance))
        fail_msg("%.15g instead of %.15g, tolerance %g", value, expected, tolerance);
}

static void test_none(void **state)
{
    (void)state;
    struct motion motion = {0};
    const double X[3] = {1.5, -2.25, 0.125};
    double x[3], v[3], a[3];
    motion_at(&motion, X, 3.0, x, v, a);
    for (int k = 0; k < 3; ++k) {
        assert_true(x[k] == X[k]);
        assert_true(v[k] == 0.0 && a[k] == 0.0);
    }
    assert_false(motion_moves(&motion));
}

/** Rotation about a skew axis and translation: derivatives from the expressions alone, against hand
 * calculation. */
static void test_rigid(void **state)
{
    (void)state;
    struct motion motion = {.kind = MOTION_RIGID, .centre = {0.3, -0.7, 1.1}, .axis = {0.48, 0.6, 0.64}};
    motion.angle = make("0.3*t^2 + 0.2*t");
    motion.displacement[0] = make("0.1*sin(3*t)");
    motion.displacement[2] = make("0.05*t^3");
    assert_true(motion_moves(&motion));
    const double X[3] = {1.2, 0.4, -0.9}, t = 0.7, *e = motion.axis;
    const double angle = 0.3 * t * t + 0.2 * t, rate = 0.6 * t + 0.2, rate2 = 0.6;
    double r0[3], r[3], along = 0.0, x[3], v[3], a[3];
    for (int k = 0; k < 3; ++k) {
        r0[k] = X[k] - motion.centre[k];
        along += e[k] * r0[k];
    }
    const double d[3] = {0.1 * sin(3 * t), 0.0, 0.05 * t * t * t},
                 dv[3] = {0.3 * cos(3 * t), 0.0, 0.15 * t * t}, da[3] = {-0.9 * sin(3 * t), 0.0, 0.3 * t};
    motion_at(&motion, X, t, x, v, a);
    for (int k = 0; k < 3; ++k) { // Rodrigues
        int i = (k + 1) % 3, j = (k + 2) % 3;
        r[k] =
            cos(angle) * r0[k] + sin(angle) * (e[i] * r0[j] - e[j] * r0[i]) + (1 - cos(angle)) * along * e[k];
    }
    for (int k = 0; k < 3; ++k) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        double cross = e[i] * r[j] - e[j] * r[i], inward = along * e[k] - r[k];
        close_to(x[k], motion.centre[k] + r[k] + d[k], 1e-14);
        close_to(v[k], dv[k] + rate * cross, 1e-8);
        close_to(a[k], da[k] + rate2 * cross + rate * rate * inward, 1e-5);
    }
    double v2[3], a2[3];
    motion_at_place(&motion, x, t, v2, a2);
    for (int k = 0; k < 3; ++k) {
        close_to(v2[k], v[k], 1e-13);
        close_to(a2[k], a[k], 1e-13);
    }
    motion_reset(&motion);
    assert_null(motion.angle);
}

/** Rates that are given are used as they are, and the next one derives from them. */
static void test_given_rates(void **state)
{
    (void)state;
    struct motion motion = {.kind = MOTION_RIGID, .axis = {0, 0, 1}};
    const double x[3] = {0.3, 0.4, 0.0};
    double v[3], a[3];
    motion.angular_velocity = make("2*t");
    motion.velocity[1] = make("cos(t)");
    assert_true(motion_moves(&motion)); // although nothing changes its place
    motion_at_place(&motion, x, 0.5, v, a);
    close_to(v[0], -0.4, 1e-15);
    close_to(v[1], 0.3 + cos(0.5), 1e-15);
    close_to(a[0], -2.0 * 0.4 - 0.3, 1e-8);
    close_to(a[1], 2.0 * 0.3 - 0.4 - sin(0.5), 1e-8);
    motion.angular_acceleration = make("7");
    motion_at_place(&motion, x, 0.5, v, a);
    close_to(a[0], -7.0 * 0.4 - 0.3, 1e-14);
    motion_reset(&motion);
}

static void test_field(void **state)
{
    (void)state;
    struct motion motion = {.kind = MOTION_FIELD};
    motion.displacement[0] = make("0.2*x*y*sin(t)");
    const double X[3] = {1.3, 0.7, 0.0};
    double x[3], v[3], a[3];
    assert_true(motion_moves(&motion));
    motion_at(&motion, X, 0.9, x, v, a);
    close_to(x[0], 1.3 + 0.2 * 0.91 * sin(0.9), 1e-15);
    close_to(v[0], 0.2 * 0.91 * cos(0.9), 1e-9);
    close_to(a[0], -0.2 * 0.91 * sin(0.9), 1e-6);
    assert_true(x[1] == X[1] && v[1] == 0.0);
    motion_reset(&motion);
}

/** A kink gives no impulse: the derivatives are those after it, also at the kink itself. */
static void test_kink(void **state)
{
    (void)state;
    struct motion motion = {.kind = MOTION_RIGID, .axis = {0, 0, 1}};
    motion.displacement[0] = make("t < 0.25 ? 0 : 3*(t - 0.25)");
    const double X[3] = {0, 0, 0};
    double x[3], v[3], a[3];
    for (int n = 0; n < 1000; ++n) {
        double t = n / 1024.0;
        motion_at(&motion, X, t, x, v, a);
        close_to(v[0], t < 0.25 ? 0.0 : 3.0, 1e-8);
        close_to(a[0], 0.0, 1e-4);
    }
    motion_reset(&motion);
}

static void test_moves(void **state)
{
    (void)state;
    struct motion motion = {.kind = MOTION_RIGID, .axis = {0, 0, 1}};
    assert_false(motion_moves(&motion));
    motion.displacement[1] = make("0.3"); // displaced, but at rest
    motion.velocity[1] = make("0");
    assert_false(motion_moves(&motion));
    double x[3], v[3], a[3];
    motion_at(&motion, (double[3]){1, 2, 3}, 5.0, x, v, a);
    close_to(x[1], 2.3, 1e-15);
    motion.angular_velocity = make("0.1"); // a rotating circle keeps its shape
    assert_true(motion_moves(&motion));
    motion_reset(&motion);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_none),  cmocka_unit_test(test_rigid), cmocka_unit_test(test_given_rates),
        cmocka_unit_test(test_field), cmocka_unit_test(test_kink),  cmocka_unit_test(test_moves),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

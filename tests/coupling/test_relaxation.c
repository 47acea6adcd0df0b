// SPDX-License-Identifier: GPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/error.h"
#include "base/log.h"
#include "coupling/relaxation.h"

#include <math.h>
#include <string.h>

static struct relaxation *create(enum relaxation_kind kind, double first, size_t n)
{
    struct relaxation *relaxation;
    assert_int_equal(relaxation_create(&relaxation, kind, first, n), 0);
    return relaxation;
}

static void test_factors_that_stay(void **state)
{
    (void)state;
    static const double residuals[3][2] = {{0.7, -1.3}, {0.2, 0.9}, {-3.1, 0.4}};
    struct relaxation *none = create(RELAXATION_NONE, 0.37, 2);
    struct relaxation *constant = create(RELAXATION_CONSTANT, 0.37, 2);
    for (int k = 0; k < 3; ++k) {
        assert_true(relaxation_factor(none, residuals[k]) == 1.0);
        assert_true(relaxation_factor(constant, residuals[k]) == 0.37);
    }
    relaxation_destroy(none);
    relaxation_destroy(constant);
    relaxation_destroy(NULL);
}

/** Kuettler and Wall (2008), by hand: w' = -w r.(r' - r) / |r' - r|^2. */
static void test_aitken_by_hand(void **state)
{
    (void)state;
    static const double first[3] = {2.0, -1.0, 0.5}, second[3] = {1.5, -0.5, 1.0},
                        third[3] = {0.25, 0.5, -1.0};
    struct relaxation *r = create(RELAXATION_AITKEN, 0.4, 3);
    assert_true(relaxation_factor(r, first) == 0.4);
    // r' - r = (-0.5, 0.5, 0.5): the product with r is -1 - 0.5 + 0.25 = -1.25, its square 0.75
    const double w = 0.4 * 1.25 / 0.75;
    assert_true(fabs(relaxation_factor(r, second) - w) < 1e-15);
    // r'' - r' = (-1.25, 1, -2): -1.875 - 0.5 - 2 = -4.375, square 1.5625 + 1 + 4
    assert_true(fabs(relaxation_factor(r, third) - w * 4.375 / 6.5625) < 1e-15);
    // the same residual again says nothing: the factor stays
    const double last = r->factor;
    assert_true(relaxation_factor(r, third) == last);
    // a new step forgets
    relaxation_restart(r);
    assert_true(relaxation_factor(r, second) == 0.4);
    relaxation_destroy(r);
}

/** Iterations x += w (A x + b - x) until the residual is below 1e-12; 200: never. A is diagonal. */
static int iterations(enum relaxation_kind kind, double first, const double *a, size_t n)
{
    double x[3] = {0.3, -0.8, 1.7}, residual[3];
    struct relaxation *relaxation = create(kind, first, n);
    int k = 0;
    for (double norm = 1.0; k < 200 && norm < 1e6; ++k) {
        norm = 0.0;
        for (size_t i = 0; i < n; ++i) {
            residual[i] = a[i] * x[i] + 0.9 - 0.4 * (double)i - x[i];
            norm = fmax(norm, fabs(residual[i]));
        }
        if (norm < 1e-12)
            break;
        const double factor = relaxation_factor(relaxation, residual);
        for (size_t i = 0; i < n; ++i)
            x[i] += factor * residual[i];
        if (norm >= 1e6)
            k = 199;
    }
    relaxation_destroy(relaxation);
    return k;
}

/** With one unknown the second factor is exact: two corrections, and the third residual is 0, also where the
 * plain iteration diverges or creeps. */
static void test_linear_fixed_point(void **state)
{
    (void)state;
    static const double one[][1] = {{-3.0}, {0.99}, {0.5}, {-0.9}, {2.5}};
    for (size_t k = 0; k < sizeof one / sizeof *one; ++k)
        assert_int_equal(iterations(RELAXATION_AITKEN, 0.3, one[k], 1), 2);
    assert_int_equal(iterations(RELAXATION_NONE, 1.0, one[0], 1), 200);
    assert_int_equal(iterations(RELAXATION_NONE, 1.0, one[1], 1), 200);
    // a factor of 1/(1 - a) is exact at once
    assert_int_equal(iterations(RELAXATION_CONSTANT, 0.25, one[0], 1), 1);
    static const double three[3] = {-2.5, -1.6, 0.3};
    const int aitken = iterations(RELAXATION_AITKEN, 0.3, three, 3);
    const int constant = iterations(RELAXATION_CONSTANT, 0.3, three, 3);
    assert_int_equal(iterations(RELAXATION_NONE, 1.0, three, 3), 200);
    print_message("three unknowns: Aitken %d, constant %d iterations\n", aitken, constant);
    assert_true(aitken < constant && constant < 200);
}

static void test_memory(void **state)
{
    (void)state;
    struct relaxation *relaxation;
    log_set_level(LOG_ERROR);
    assert_int_equal(relaxation_create(&relaxation, RELAXATION_AITKEN, 0.5, SIZE_MAX / 4), STATUS_MEMORY);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_factors_that_stay),
        cmocka_unit_test(test_aitken_by_hand),
        cmocka_unit_test(test_linear_fixed_point),
        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/error.h"
#include "deck/unit.h"

#include <math.h>
#include <string.h>

static void convert(struct unit_system *system, double value, const char *unit, const char *target,
                    double wanted)
{
    char message[256] = "";
    double result = -1.0;
    assert_int_equal(unit_convert(system, value, unit, target, &result, message, sizeof message), 0);
    if (fabs(result - wanted) > 1e-14 * fabs(wanted))
        fail_msg("%.17g %s is %.17g, not %.17g", value, unit, result, wanted);
}

static void refuse(struct unit_system *system, const char *unit, const char *target, const char *wanted)
{
    char message[256] = "";
    double result;
    assert_int_equal(unit_convert(system, 1.0, unit, target, &result, message, sizeof message), STATUS_DECK);
    assert_string_equal(message, wanted);
}

static void test_targets(void **state)
{
    (void)state;
    struct unit_system system = {0};
    convert(&system, 6.5, "MPa", "Pa", 6.5e6);
    convert(&system, 4.0, "mm", "m", 4e-3);
    convert(&system, 11.54, "deg", "rad", 11.54 * acos(-1.0) / 180.0);
    convert(&system, 0.9, "g/cm3", "kg/m3", 900.0);
    convert(&system, 1.0, "mm^2/s", "m2/s", 1e-6);
    convert(&system, 3.0, "bar", "Pa", 3e5);
    convert(&system, 25.0, "%", "1", 0.25);
    convert(&system, 60.0, "rpm", "rad/s", 2.0 * acos(-1.0));
    convert(&system, 20.0, "degC", "K", 293.15);
    unit_system_reset(&system);
}

static void test_coherent(void **state)
{
    (void)state;
    struct unit_system system = {0};
    convert(&system, 6.5, "MPa", NULL, 6.5e6);
    convert(&system, 10.0, "mm", NULL, 0.01);
    convert(&system, 36.0, "km/h", NULL, 10.0);
    convert(&system, 180.0, "degree", NULL, acos(-1.0));
    convert(&system, 20.0, "degC", NULL, 293.15);
    convert(&system, 5.0, "%", NULL, 0.05);
    convert(&system, 2.0, "kg", NULL, 2.0);
    unit_system_reset(&system);
}

static void test_mistakes(void **state)
{
    (void)state;
    struct unit_system system = {0};
    char longest[80];
    memset(longest, 'm', 65);
    longest[65] = '\0';
    refuse(&system, "MPaa", "Pa", "unknown unit \"MPaa\"");
    refuse(&system, "mm", "Pa", "unit \"mm\" does not fit: it cannot be converted to Pa");
    refuse(&system, "mm", "1", "unit \"mm\" does not fit: a number without dimension is wanted");
    refuse(&system, longest, "m", "a unit has at most 64 characters");
    unit_system_reset(&system);
    unit_system_reset(&system);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_targets), cmocka_unit_test(test_coherent),
                                       cmocka_unit_test(test_mistakes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

// SPDX-License-Identifier: GPL-3.0-or-later
// When frames and rows of histories are due.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "run/monitor.h"

#include <stdbool.h>

/** Events of a schedule over @p steps steps. */
static long events(double every, double step, long steps)
{
    long count = 0, n = 0;
    for (long k = 0; k <= steps; ++k)
        n += schedule_due(every, (double)k * step, step, &count);
    return n;
}

/** The first step that reaches a multiple has it, also where steps and multiples meet to rounding only. */
static void test_events(void **state)
{
    (void)state;
    assert_int_equal(events(0.1, 0.01, 100), 11);
    assert_int_equal(events(0.3, 0.1, 30), 11);
    assert_int_equal(events(1.0 / 3.0, 1.0 / 30.0, 90), 10);
    assert_int_equal(events(0.07, 0.02, 7), 3);    // at 0, 0.08, 0.14
    assert_int_equal(events(0.001, 0.02, 50), 51); // never more than one a step
    assert_int_equal(events(0.0, 0.02, 50), 51);
    long count = 0;
    assert_true(schedule_due(0.07, 0.0, 0.02, &count));
    assert_false(schedule_due(0.07, 0.06, 0.02, &count));
    assert_true(schedule_due(0.07, 0.08, 0.02, &count));
    assert_false(schedule_due(0.07, 0.08, 0.02, &count));
}

/** Whoever comes in at some time knows what has been due: a resumed run needs nothing but the time. */
static void test_time_tells_all(void **state)
{
    (void)state;
    const double steps[] = {0.01, 1.0 / 3.0, 2.385e-5, 0.1}, parts[] = {1.0, 3.0, 7.3, 0.4, 10.0 / 3.0};
    for (size_t s = 0; s < sizeof steps / sizeof *steps; ++s)
        for (size_t p = 0; p < sizeof parts / sizeof *parts; ++p) {
            const double every = parts[p] * steps[s];
            long count = 0;
            for (long k = 0; k < 2000; ++k) {
                const double t = (double)k * steps[s];
                schedule_due(every, t, steps[s], &count);
                assert_int_equal(schedule_count(every, t, steps[s]), count);
            }
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_events), cmocka_unit_test(test_time_tells_all)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

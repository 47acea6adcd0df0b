// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/parallel.h"
#include "base/timer.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <omp.h>
#include <sched.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static int team(void)
{
    int size = 0;

#pragma omp parallel
#pragma omp single
    size = omp_get_num_threads();
    return size;
}

static void setup_sets_the_number_of_threads(void **state)
{
    (void)state;
    parallel_setup(3);
    assert_int_equal(parallel_threads(), 3);
    assert_int_equal(team(), 3);
    parallel_setup(1);
    assert_int_equal(team(), 1);
}

static void setup_obeys_the_affinity_mask(void **state)
{
    cpu_set_t all, one, now;
    int first = 0;

    (void)state;
    assert_int_equal(sched_getaffinity(0, sizeof all, &all), 0);
    while (!CPU_ISSET(first, &all))
        first++;
    parallel_setup(0);
    assert_int_equal(parallel_threads(), CPU_COUNT(&all));

    CPU_ZERO(&one);
    CPU_SET(first, &one);
    assert_int_equal(sched_setaffinity(0, sizeof one, &one), 0);
    parallel_setup(0);
    assert_int_equal(parallel_threads(), 1);
    assert_int_equal(sched_setaffinity(0, sizeof all, &all), 0);

    // The calling thread keeps its mask: a second set-up sees all CPUs again.
    parallel_setup(0);
    assert_int_equal(team(), CPU_COUNT(&all));
    assert_int_equal(sched_getaffinity(0, sizeof now, &now), 0);
    assert_true(CPU_EQUAL(&all, &now));
}

static void too_many_threads_are_never_bound(void **state)
{
    cpu_set_t all;
    bool free_to_move = true;

    (void)state;
    assert_int_equal(sched_getaffinity(0, sizeof all, &all), 0);
    parallel_setup(CPU_COUNT(&all) + 1);
#pragma omp parallel reduction(&& : free_to_move)
    {
        cpu_set_t own;
        sched_getaffinity(0, sizeof own, &own);
        free_to_move = CPU_COUNT(&own) >= 1 && (omp_get_thread_num() > 0 || CPU_EQUAL(&own, &all));
    }
    assert_true(free_to_move);
}

static void timer_splits_the_time(void **state)
{
    struct timer timer = {{0.0}};
    const struct timespec nap = {0, 20000000};
    const double start = timer_now();
    double since = start;

    (void)state;
    nanosleep(&nap, NULL);
    timer_lap(&timer, TIMER_FLUID, &since);
    nanosleep(&nap, NULL);
    timer_lap(&timer, TIMER_FLUID, &since);
    timer_lap(&timer, TIMER_OUTPUT, &since);
    assert_true(timer.seconds[TIMER_FLUID] >= 0.04);
    assert_true(timer.seconds[TIMER_OUTPUT] < timer.seconds[TIMER_FLUID]);
    assert_true(timer.seconds[TIMER_SOLID] == 0.0);
    const double sum = timer.seconds[TIMER_FLUID] + timer.seconds[TIMER_OUTPUT];
    assert_true(sum - (since - start) < 1e-9 && (since - start) - sum < 1e-9);
    for (int i = 0; i < TIMER_PHASES; i++)
        assert_true(strlen(timer_phase_name((enum timer_phase)i)) > 0);
    assert_string_equal(timer_phase_name(TIMER_NEIGHBOURS), "neighbours");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(setup_sets_the_number_of_threads),
        cmocka_unit_test(setup_obeys_the_affinity_mask),
        cmocka_unit_test(too_many_threads_are_never_bound),
        cmocka_unit_test(timer_splits_the_time),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

// SPDX-License-Identifier: GPL-3.0-or-later
// The quasi-Newton method on linear fixed points with three unknowns, where it has to be exact.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/error.h"
#include "base/log.h"
#include "base/memory.h"
#include "coupling/quasi_newton.h"

#include <math.h>
#include <string.h>

enum { N = 3, LEVELS = 3 };

/** S(x) = A x + b: eigenvalues of A far beyond 1, so that the plain iteration diverges. */
static const double A[N][N] = {{-3.1, 0.7, 0.4}, {1.2, -2.6, -0.9}, {0.3, 1.7, -4.4}};

/** Velocity and acceleration go with the displacement as in Newmark's method. */
static const double velocity_factor = 37.5, acceleration_factor = 2210.25;

static struct quasi_newton *create(int reused_steps, double filter)
{
    struct quasi_newton *q;
    assert_int_equal(quasi_newton_create(&q, N, 0.17, reused_steps, filter), 0);
    return q;
}

/** Residual and answer of the iterate @p x; returns the size of the residual. */
static double evaluate(const double *x, const double *b, double *residual, double *answer)
{
    double square = 0.0;
    for (int i = 0; i < N; ++i) {
        answer[i] = b[i];
        for (int j = 0; j < N; ++j)
            answer[i] += A[i][j] * x[j];
        answer[N + i] = velocity_factor * answer[i];
        answer[2 * N + i] = acceleration_factor * answer[i];
        residual[i] = answer[i] - x[i];
        square += residual[i] * residual[i];
    }
    return sqrt(square);
}

/** Corrections until the residual is 1e-11 of the first one; x: iterate. */
static int solve(struct quasi_newton *q, const double *b, double x[LEVELS * N])
{
    double residual[N], answer[LEVELS * N], first = 0.0;
    quasi_newton_restart(q);
    for (int k = 0; k < 30; ++k) {
        const double size = evaluate(x, b, residual, answer);
        first = k == 0 ? size : first;
        if (size <= 1e-11 * first)
            return k;
        quasi_newton_next(q, residual, answer, x);
    }
    return 30;
}

static const double loads[][N] = {{0.9, -1.3, 0.35}, {1.1, -1.15, 0.6}, {1.45, -0.85, 0.3}, {2.1, 0.2, -0.7}};

/** As many corrections as unknowns and one: the relaxed one, and one for each direction. */
static void test_linear(void **state)
{
    (void)state;
    struct quasi_newton *q = create(5, 1e-8);
    double x[LEVELS * N] = {0.0}, plain[N] = {0.0}, residual[N], answer[LEVELS * N];
    const int corrections = solve(q, loads[0], x);
    print_message("%d corrections for %d unknowns\n", corrections, N);
    assert_true(corrections <= N + 1);
    assert_true(evaluate(x, loads[0], residual, answer) < 1e-10);
    for (int i = 0; i < N; ++i) { // the same coefficients for all levels
        assert_true(fabs(x[N + i] - velocity_factor * x[i]) < 1e-12 * velocity_factor);
        assert_true(fabs(x[2 * N + i] - acceleration_factor * x[i]) < 1e-12 * acceleration_factor);
    }
    for (int k = 0; k < 4; ++k) { // without it
        evaluate(plain, loads[0], residual, answer);
        memcpy(plain, answer, sizeof plain);
    }
    assert_true(evaluate(plain, loads[0], residual, answer) > 100.0);
    quasi_newton_destroy(q);
    quasi_newton_destroy(NULL);
}

/** The first correction is relaxed, by hand: 0.17 of the residual. */
static void test_first(void **state)
{
    (void)state;
    struct quasi_newton *q = create(5, 1e-8);
    double x[LEVELS * N] = {0.25, -0.5, 1.5, 2.0, 3.0, -4.0, 5.5, 6.0, 7.0}, residual[N], answer[LEVELS * N],
                      before[LEVELS * N];
    memcpy(before, x, sizeof x);
    evaluate(x, loads[0], residual, answer);
    quasi_newton_next(q, residual, answer, x);
    for (int k = 0; k < LEVELS * N; ++k)
        assert_true(fabs(x[k] - (before[k] + 0.17 * (answer[k] - before[k]))) <= 1e-15 * fabs(answer[k]));
    assert_int_equal(q->n_columns, 0);
    quasi_newton_destroy(q);
}

/** What earlier steps taught makes the first correction of the next exact; it is forgotten in time. */
static void test_reuse(void **state)
{
    (void)state;
    for (int reused = 0; reused < 3; ++reused) {
        struct quasi_newton *q = create(reused, 1e-8);
        double x[LEVELS * N] = {0.0};
        assert_int_equal(solve(q, loads[0], x), N + 1);
        const int second = solve(q, loads[1], x), third = solve(q, loads[2], x);
        print_message("%d steps reused: %d, %d corrections, %zu columns\n", reused, second, third,
                      q->n_columns);
        assert_int_equal(second, reused > 0 ? 1 : N + 1);
        // with one step there are only those of the second left, which had none of its own
        assert_int_equal(third, reused == 2 ? 1 : N + 1);
        assert_int_equal(q->n_columns, N);
        quasi_newton_destroy(q);
    }
}

/** By hand: changes (1, 0, 0), then (1, e, 0): e/sqrt(1 + e^2) of the older is new to the newer. */
static void test_filter(void **state)
{
    (void)state;
    static const double e = 0.02;
    static const double residuals[][N] = {{0.5, 0.25, -0.75}, {1.5, 0.25, -0.75}, {2.5, 0.25 + e, -0.75}};
    for (int strict = 0; strict < 2; ++strict) {
        struct quasi_newton *q = create(5, strict ? 0.021 : 0.019);
        double answer[LEVELS * N] = {0.0}, x[LEVELS * N] = {0.0};
        for (int k = 0; k < 3; ++k) {
            answer[0] = k;
            quasi_newton_next(q, residuals[k], answer, x);
        }
        assert_int_equal(q->n_columns, strict ? 1 : 2);
        assert_true(q->residual_changes[N * (q->n_columns - 1) + 1] == 0.25 + e - 0.25); // the newest stays
        if (strict) { // c = -(2.5 + e (0.25 + e)) / (1 + e^2), the answer changed by 1
            const double change[2] = {1.0, 0.25 + e - 0.25};
            const double c =
                -(2.5 * change[0] + (0.25 + e) * change[1]) / (change[0] * change[0] + change[1] * change[1]);
            assert_true(fabs(x[0] - (2.0 + c)) < 1e-14);
        } else { // both directions are removed: c1 + c2 = -2.5, e c2 = -(0.25 + e)
            assert_true(fabs(x[0] - (2.0 - 2.5)) < 1e-12);
        }
        // the same residual again teaches nothing
        const size_t columns = q->n_columns;
        quasi_newton_next(q, residuals[2], answer, x);
        assert_int_equal(q->n_columns, columns);
        quasi_newton_destroy(q);
    }
}

/** Never more columns than unknowns: the oldest makes room. */
static void test_capacity(void **state)
{
    (void)state;
    struct quasi_newton *q = create(9, 1e-8);
    double x[LEVELS * N] = {0.0};
    for (int step = 0; step < 4; ++step)
        solve(q, loads[step], x);
    assert_int_equal(q->capacity, N);
    assert_true(q->n_columns <= N);
    quasi_newton_destroy(q);
}

/** State fields carry everything from step to step: the bytes of a copy that goes on are the same. */
static void test_state(void **state)
{
    (void)state;
    struct quasi_newton *q = create(4, 1e-8), *copy = create(4, 1e-8);
    double x[LEVELS * N] = {0.0}, y[LEVELS * N];
    solve(q, loads[0], x);
    assert_true(q->n_columns > 0);
    memcpy(y, x, sizeof x);
    assert_int_equal(field_count_state(&q->state), 3);
    assert_int_equal(copy->state.resize(copy, q->n_columns), 0);
    for (size_t f = 0; f < q->state.n_fields; ++f) {
        double values[LEVELS * N * N];
        assert_int_equal(field_read(&q->state, &q->state.fields[f], values), 0);
        field_write(&copy->state, &copy->state.fields[f], values);
    }
    for (int step = 1; step < 4; ++step) {
        assert_int_equal(solve(q, loads[step], x), solve(copy, loads[step], y));
        assert_memory_equal(x, y, sizeof x);
    }
    log_set_level(LOG_ERROR);
    assert_int_equal(copy->state.resize(copy, N + 1), STATUS_IO);
    quasi_newton_destroy(q);
    quasi_newton_destroy(copy);
}

static void test_memory(void **state)
{
    (void)state;
    struct quasi_newton *q;
    log_set_level(LOG_ERROR);
    assert_int_equal(quasi_newton_create(&q, SIZE_MAX / 4096, 0.5, 5, 0.01), STATUS_MEMORY);
    assert_null(q);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_linear), cmocka_unit_test(test_first),    cmocka_unit_test(test_reuse),
        cmocka_unit_test(test_filter), cmocka_unit_test(test_capacity), cmocka_unit_test(test_state),
        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

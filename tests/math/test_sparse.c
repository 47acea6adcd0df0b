// SPDX-License-Identifier: GPL-3.0-or-later
// clang-format off
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>
// clang-format on

#include "base/error.h"
#include "math/gmres.h"
#include "math/sparse.h"

#include <math.h>
#include <string.h>

/* Upper triangle of [[4 -1 0 0.5] [-1 3 -2 0] [0 -2 5 1] [0.5 0 1 2]] in compressed columns. */
static const long columns[5] = {0, 1, 3, 5, 8};
static const long rows[8] = {0, 0, 1, 1, 2, 0, 2, 3};
static const double values[8] = {4, -1, 3, -2, 5, 0.5, 1, 2};

static void multiply(const double *a, const double *x, double *y)
{
    memset(y, 0, 4 * sizeof *y);
    for (long j = 0; j < 4; j++)
        for (long k = columns[j]; k < columns[j + 1]; k++) {
            y[rows[k]] += a[k] * x[j];
            if (rows[k] != j)
                y[j] += a[k] * x[rows[k]];
        }
}

static void check_solution(struct sparse_solver *solver, const double *a)
{
    const double expected[4] = {1.25, -0.75, 3.5, -2.125};
    double b[4];
    multiply(a, expected, b);
    assert_int_equal(sparse_solver_factor(solver, a), 0);
    assert_int_equal(sparse_solver_solve(solver, b, b), 0);
    for (int i = 0; i < 4; i++)
        assert_true(fabs(b[i] - expected[i]) < 1e-14);
}

static void test_cholesky_and_lu(void **state)
{
    (void)state;
    struct sparse_solver *solver;
    double indefinite[8];
    memcpy(indefinite, values, sizeof values);
    indefinite[4] = -5;
    assert_int_equal(sparse_solver_create(&solver, 4, columns, rows), 0);
    check_solution(solver, values);
    assert_true(sparse_solver_is_positive(solver));
    check_solution(solver, indefinite);
    assert_false(sparse_solver_is_positive(solver));
    check_solution(solver, values); /* and back */
    assert_true(sparse_solver_is_positive(solver));
    check_solution(solver, indefinite);
    sparse_solver_destroy(solver);
    sparse_solver_destroy(NULL);
}

static void test_singular_and_nan(void **state)
{
    (void)state;
    struct sparse_solver *solver;
    double bad[8];
    assert_int_equal(sparse_solver_create(&solver, 4, columns, rows), 0);
    memcpy(bad, values, sizeof values);
    bad[0] = bad[1] = bad[5] = 0; /* an empty row and column */
    assert_int_equal(sparse_solver_factor(solver, bad), STATUS_NUMERICAL);
    memcpy(bad, values, sizeof values);
    bad[3] = NAN;
    assert_int_equal(sparse_solver_factor(solver, bad), STATUS_NUMERICAL);
    check_solution(solver, values);
    sparse_solver_destroy(solver);
}

/** A chain of springs without supports: singular only to rounding. */
static void test_floating_chain_is_singular(void **state)
{
    (void)state;
    enum { N = 30 };
    long chain_columns[N + 1] = {0}, chain_rows[2 * N];
    double chain_values[2 * N];
    long count = 0;
    for (long j = 0; j < N; j++) {
        if (j > 0) {
            chain_rows[count] = j - 1;
            chain_values[count++] = -(1.7 + 0.1 * (double)j);
        }
        chain_rows[count] = j;
        chain_values[count++] = (j > 0 ? 1.7 + 0.1 * (double)j : 0) + (j < N - 1 ? 1.8 + 0.1 * (double)j : 0);
        chain_columns[j + 1] = count;
    }
    struct sparse_solver *solver;
    assert_int_equal(sparse_solver_create(&solver, N, chain_columns, chain_rows), 0);
    assert_int_equal(sparse_solver_factor(solver, chain_values), STATUS_NUMERICAL);
    chain_values[0] += 1e-3;
    assert_int_equal(sparse_solver_factor(solver, chain_values), 0);
    sparse_solver_destroy(solver);
}

struct sum {
    struct sparse_solver *preconditioner;
    double added[4][4]; /* not symmetric */
};

static int apply(void *context, const double *v, double *z, double *w)
{
    struct sum *sum = context;
    CALL(sparse_solver_solve(sum->preconditioner, v, z));
    for (int i = 0; i < 4; i++) {
        w[i] = v[i];
        for (int j = 0; j < 4; j++)
            w[i] += sum->added[i][j] * z[j];
    }
    return 0;
}

static void test_gmres_against_direct(void **state)
{
    (void)state;
    struct sum sum = {.added = {{0.7, 0.2, 0, 0}, {-0.1, 1.9, 0, 0.3}, {0, 0, 0, 0}, {0.4, 0, 0, 0.6}}};
    const double expected[4] = {-0.625, 2.5, 1.375, 0.5};
    double b[4], x[4], residual;
    int iterations;
    struct gmres *gmres;
    multiply(values, expected, b);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            b[i] += sum.added[i][j] * expected[j];
    assert_int_equal(sparse_solver_create(&sum.preconditioner, 4, columns, rows), 0);
    assert_int_equal(sparse_solver_factor(sum.preconditioner, values), 0);
    assert_int_equal(gmres_create(&gmres, 4, 6), 0);
    assert_int_equal(gmres_solve(gmres, apply, &sum, b, x, 1e-13, &iterations, &residual), 0);
    assert_in_range(iterations, 1, 4);
    assert_true(residual <= 1e-13);
    for (int i = 0; i < 4; i++)
        assert_true(fabs(x[i] - expected[i]) < 1e-12);

    /* the estimate is the true residual when stopped early */
    assert_int_equal(gmres_solve(gmres, apply, &sum, b, x, 0.05, &iterations, &residual), 0);
    double r[4], norm = 0, size = 0;
    multiply(values, x, r);
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++)
            r[i] += sum.added[i][j] * x[j];
        norm += (b[i] - r[i]) * (b[i] - r[i]);
        size += b[i] * b[i];
    }
    assert_true(iterations < 4 && residual <= 0.05);
    assert_true(fabs(sqrt(norm / size) - residual) < 1e-14);

    memset(b, 0, sizeof b);
    assert_int_equal(gmres_solve(gmres, apply, &sum, b, x, 1e-2, &iterations, &residual), 0);
    assert_true(iterations == 0 && x[0] == 0 && x[3] == 0);
    b[1] = NAN;
    assert_int_equal(gmres_solve(gmres, apply, &sum, b, x, 1e-2, NULL, NULL), STATUS_NUMERICAL);
    gmres_destroy(gmres);
    sparse_solver_destroy(sum.preconditioner);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cholesky_and_lu),
        cmocka_unit_test(test_singular_and_nan),
        cmocka_unit_test(test_floating_chain_is_singular),
        cmocka_unit_test(test_gmres_against_direct),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

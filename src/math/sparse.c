// SPDX-License-Identifier: GPL-3.0-or-later
#include "math/sparse.h"

#include "base/error.h"
#include "base/log.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>
#include <suitesparse/cholmod.h>
#include <suitesparse/umfpack.h>
#ifdef _OPENMP
#include <omp.h>
#endif

_Static_assert(sizeof(SuiteSparse_long) == sizeof(long), "SuiteSparse's long integers are C's");

/** Ratio of smallest to largest pivot below which a matrix counts as singular: what rounding leaves of a
 * pivot that is 0. */
static const double singular_ratio = 1e-14;

struct sparse_solver {
    size_t n, nonzeros;
    long *columns, *rows; /**< upper triangle */
    bool positive;        /**< the newest factor is Cholesky's */
    cholmod_common common;
    cholmod_factor *factor;
    cholmod_dense *solution, *work_y, *work_e; /**< reused by cholmod_l_solve2 */
    /* LU of the whole matrix; made when first needed */
    long *full_columns, *full_rows, *full_from; /**< full_from: index into the upper triangle's values */
    double *full_values, *work_w, *right;
    long *work_i;
    void *symbolic, *numeric;
};

#ifdef HAVE_OPENBLAS_SET_NUM_THREADS
void openblas_set_num_threads(int threads);
#endif

/** One thread inside BLAS: OpenBLAS splits sums by thread. Its OpenMP build also changes the program's number
 * of threads, which is put back. */
static void pin_blas(void)
{
#ifdef HAVE_OPENBLAS_SET_NUM_THREADS
#ifdef _OPENMP
    const int threads = omp_get_max_threads();
#endif
    openblas_set_num_threads(1);
#ifdef _OPENMP
    omp_set_num_threads(threads);
#endif
#endif
}

/** CHOLMOD's view of the upper triangle. */
static cholmod_sparse view(const struct sparse_solver *solver, const double *values)
{
    return (cholmod_sparse){.nrow = solver->n,
                            .ncol = solver->n,
                            .nzmax = solver->nonzeros,
                            .p = solver->columns,
                            .i = solver->rows,
                            .x = (void *)values,
                            .stype = 1,
                            .itype = CHOLMOD_LONG,
                            .xtype = values ? CHOLMOD_REAL : CHOLMOD_PATTERN,
                            .dtype = CHOLMOD_DOUBLE,
                            .sorted = 1,
                            .packed = 1};
}

int sparse_solver_create(struct sparse_solver **created, size_t n, const long *columns, const long *rows)
{
    *created = NULL;
    struct sparse_solver *solver = memory_create(1, sizeof *solver);
    CHECK_MEMORY(solver);
    solver->n = n;
    solver->nonzeros = (size_t)columns[n];
    cholmod_l_start(&solver->common);
    solver->common.print = 0; /* what goes wrong is reported here */
    solver->common.final_ll = 1;
    solver->common.quick_return_if_not_posdef = 1;
    pin_blas();
    solver->columns = memory_create(n + 1, sizeof *solver->columns);
    solver->rows = memory_create(solver->nonzeros, sizeof *solver->rows);
    if (!solver->columns || !solver->rows) {
        sparse_solver_destroy(solver);
        return STATUS_MEMORY;
    }
    memcpy(solver->columns, columns, (n + 1) * sizeof *columns);
    memcpy(solver->rows, rows, solver->nonzeros * sizeof *rows);
    cholmod_sparse pattern = view(solver, NULL);
    solver->factor = cholmod_l_analyze(&pattern, &solver->common);
    if (!solver->factor) {
        const int status = solver->common.status == CHOLMOD_OUT_OF_MEMORY ? STATUS_MEMORY : STATUS_NUMERICAL;
        const int code = solver->common.status;
        sparse_solver_destroy(solver);
        return error_report(status, "sparse matrix: the analysis of %zu equations failed (CHOLMOD status %d)",
                            n, code);
    }
    *created = solver;
    return 0;
}

void sparse_solver_destroy(struct sparse_solver *solver)
{
    if (!solver)
        return;
    cholmod_l_free_factor(&solver->factor, &solver->common);
    cholmod_l_free_dense(&solver->solution, &solver->common);
    cholmod_l_free_dense(&solver->work_y, &solver->common);
    cholmod_l_free_dense(&solver->work_e, &solver->common);
    cholmod_l_finish(&solver->common);
    umfpack_dl_free_symbolic(&solver->symbolic);
    umfpack_dl_free_numeric(&solver->numeric);
    memory_free(solver->columns);
    memory_free(solver->rows);
    memory_free(solver->full_columns);
    memory_free(solver->full_rows);
    memory_free(solver->full_from);
    memory_free(solver->full_values);
    memory_free(solver->work_w);
    memory_free(solver->right);
    memory_free(solver->work_i);
    memory_free(solver);
}

/** Both triangles in compressed columns, rows ascending: those above the diagonal come from the column
 * itself, those below from the columns to its right, in their order. */
static void fill_full_pattern(struct sparse_solver *solver)
{
    long *next = solver->work_i; /* n entries of scratch */
    for (size_t j = 0; j < solver->n; j++)
        for (long k = solver->columns[j]; k < solver->columns[j + 1]; k++) {
            solver->full_columns[j + 1]++;
            if ((size_t)solver->rows[k] != j)
                solver->full_columns[solver->rows[k] + 1]++;
        }
    for (size_t j = 0; j < solver->n; j++) {
        solver->full_columns[j + 1] += solver->full_columns[j];
        next[j] = solver->full_columns[j];
    }
    for (size_t j = 0; j < solver->n; j++)
        for (long k = solver->columns[j]; k < solver->columns[j + 1]; k++) {
            const long i = solver->rows[k];
            solver->full_rows[next[j]] = i;
            solver->full_from[next[j]++] = k;
            if ((size_t)i == j)
                continue;
            solver->full_rows[next[i]] = (long)j;
            solver->full_from[next[i]++] = k;
        }
}

static int prepare_lu(struct sparse_solver *solver)
{
    const size_t n = solver->n, full = 2 * solver->nonzeros;
    if (!solver->right) {
        solver->full_columns = memory_create(n + 1, sizeof *solver->full_columns);
        solver->full_rows = memory_create(full, sizeof *solver->full_rows);
        solver->full_from = memory_create(full, sizeof *solver->full_from);
        solver->full_values = memory_create(full, sizeof *solver->full_values);
        solver->work_w = memory_create(5 * n, sizeof *solver->work_w); /* what umfpack_dl_wsolve asks for */
        solver->work_i = memory_create(n, sizeof *solver->work_i);
        solver->right = memory_create(n, sizeof *solver->right);
        if (!solver->full_columns || !solver->full_rows || !solver->full_from || !solver->full_values ||
            !solver->work_w || !solver->work_i || !solver->right)
            return STATUS_MEMORY;
        fill_full_pattern(solver);
    }
    if (solver->symbolic)
        return 0;
    const long status = umfpack_dl_symbolic((long)n, (long)n, solver->full_columns, solver->full_rows, NULL,
                                            &solver->symbolic, NULL, NULL);
    CHECK(status != UMFPACK_ERROR_out_of_memory, STATUS_MEMORY, "out of memory in UMFPACK's analysis");
    CHECK(status == UMFPACK_OK, STATUS_NUMERICAL, "sparse matrix: UMFPACK's analysis failed (status %ld)",
          status);
    return 0;
}

static int factor_lu(struct sparse_solver *solver, const double *values)
{
    CALL(prepare_lu(solver));
    for (long k = 0; k < solver->full_columns[solver->n]; k++)
        solver->full_values[k] = values[solver->full_from[k]];
    umfpack_dl_free_numeric(&solver->numeric);
    double information[UMFPACK_INFO];
    const long status = umfpack_dl_numeric(solver->full_columns, solver->full_rows, solver->full_values,
                                           solver->symbolic, &solver->numeric, NULL, information);
    CHECK(status != UMFPACK_ERROR_out_of_memory, STATUS_MEMORY, "out of memory in UMFPACK's factorisation");
    CHECK(status == UMFPACK_OK && information[UMFPACK_RCOND] > singular_ratio, STATUS_NUMERICAL,
          "the system of %zu equations is singular (ratio of pivots %.1e): is a body without supports, or an "
          "element degenerate?",
          solver->n, information[UMFPACK_RCOND]);
    return 0;
}

int sparse_solver_factor(struct sparse_solver *solver, const double *values)
{
    for (size_t k = 0; k < solver->nonzeros; k++)
        CHECK(isfinite(values[k]), STATUS_NUMERICAL, "sparse matrix: entry (%ld, .) is %g; it must be finite",
              solver->rows[k], values[k]);
    if (solver->n == 0)
        return 0;
    cholmod_sparse matrix = view(solver, values);
    const int good = cholmod_l_factorize(&matrix, solver->factor, &solver->common);
    CHECK(solver->common.status != CHOLMOD_OUT_OF_MEMORY, STATUS_MEMORY,
          "out of memory in CHOLMOD's factorisation");
    solver->positive = good && solver->common.status == CHOLMOD_OK && solver->factor->minor == solver->n &&
                       cholmod_l_rcond(solver->factor, &solver->common) > singular_ratio;
    if (solver->positive)
        return 0;
    log_message(LOG_DETAIL, "matrix of %zu equations is not positive definite: UMFPACK takes over",
                solver->n);
    return factor_lu(solver, values);
}

static int solve_lu(struct sparse_solver *solver, const double *b, double *x)
{
    memcpy(solver->right, b, solver->n * sizeof *b);
    const long status =
        umfpack_dl_wsolve(UMFPACK_A, solver->full_columns, solver->full_rows, solver->full_values, x,
                          solver->right, solver->numeric, NULL, NULL, solver->work_i, solver->work_w);
    CHECK(status == UMFPACK_OK, STATUS_NUMERICAL, "sparse matrix: UMFPACK's solution failed (status %ld)",
          status);
    return 0;
}

int sparse_solver_solve(struct sparse_solver *solver, const double *b, double *x)
{
    if (solver->n == 0)
        return 0;
    if (!solver->positive)
        return solve_lu(solver, b, x);
    cholmod_dense right = {.nrow = solver->n,
                           .ncol = 1,
                           .nzmax = solver->n,
                           .d = solver->n,
                           .x = (void *)b,
                           .xtype = CHOLMOD_REAL,
                           .dtype = CHOLMOD_DOUBLE};
    const int good = cholmod_l_solve2(CHOLMOD_A, solver->factor, &right, NULL, &solver->solution, NULL,
                                      &solver->work_y, &solver->work_e, &solver->common);
    CHECK(good, solver->common.status == CHOLMOD_OUT_OF_MEMORY ? STATUS_MEMORY : STATUS_NUMERICAL,
          "sparse matrix: CHOLMOD's solution failed (status %d)", solver->common.status);
    memcpy(x, solver->solution->x, solver->n * sizeof *x);
    return 0;
}

bool sparse_solver_is_positive(const struct sparse_solver *solver)
{
    return solver->positive;
}

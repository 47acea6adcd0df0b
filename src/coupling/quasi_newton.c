// SPDX-License-Identifier: GPL-3.0-or-later
/* IQN-ILS. The least-squares problem is small and solved by QR factorisation with columns from the newest to
 * the oldest, each made orthogonal twice, which is as good as Householder's method and tells on the way what
 * is new in a column (the filter of Haelterman et al. 2016). Sums are serial: the same bytes for any number
 * of threads. */
#include "coupling/quasi_newton.h"

#include "base/error.h"
#include "base/memory.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { MOST_COLUMNS = 100, LEVELS = 3 };

static int columns_resize(void *owner, size_t count)
{
    struct quasi_newton *q = owner;
    CHECK(count <= q->capacity, STATUS_IO,
          "the checkpoint does not fit the deck: it has %zu columns of the quasi-Newton method, at most %zu "
          "are possible",
          count, q->capacity);
    q->n_columns = count;
    return 0;
}

static void state_register(struct quasi_newton *q)
{
    const struct field fields[] = {
        {"Age", "-", FIELD_INT64, 1, FIELD_STATE, {q->ages}, NULL},
        {"ResidualChange", "m", FIELD_DOUBLE, (int)q->n, FIELD_STATE, {q->residual_changes}, NULL},
        {"AnswerChange", "-", FIELD_DOUBLE, LEVELS * (int)q->n, FIELD_STATE, {q->answer_changes}, NULL},
    };
    memcpy(q->state_fields, fields, sizeof fields);
    q->state = (struct field_group){.name = "coupling:columns",
                                    .owner = q,
                                    .count = &q->n_columns,
                                    .fields = q->state_fields,
                                    .n_fields = sizeof fields / sizeof *fields,
                                    .resize = columns_resize};
}

static int allocate(struct quasi_newton *q)
{
    const size_t columns = q->capacity, values = q->capacity * q->n;
    CHECK_MEMORY(q->ages = memory_create(columns, sizeof *q->ages));
    CHECK_MEMORY(q->residual_changes = memory_create(values, sizeof(double)));
    CHECK_MEMORY(q->answer_changes = memory_create(LEVELS * values, sizeof(double)));
    CHECK_MEMORY(q->residual = memory_create(q->n, sizeof(double)));
    CHECK_MEMORY(q->answer = memory_create(LEVELS * q->n, sizeof(double)));
    CHECK_MEMORY(q->basis = memory_create(values, sizeof(double)));
    CHECK_MEMORY(q->triangle = memory_create(columns * columns, sizeof(double)));
    CHECK_MEMORY(q->coefficients = memory_create(columns, sizeof(double)));
    CHECK_MEMORY(q->chosen = memory_create(columns, sizeof *q->chosen));
    return 0;
}

int quasi_newton_create(struct quasi_newton **quasi_newton, size_t n, double first, int reused_steps,
                        double filter)
{
    struct quasi_newton *q = memory_create(1, sizeof *q);
    *quasi_newton = NULL;
    CHECK_MEMORY(q);
    *q = (struct quasi_newton){
        .n = n, .first = first, .reused_steps = reused_steps, .filter = filter, .capacity = n};
    if (q->capacity > MOST_COLUMNS)
        q->capacity = MOST_COLUMNS;
    const int status = allocate(q);
    if (status) {
        quasi_newton_destroy(q);
        return status;
    }
    state_register(q);
    *quasi_newton = q;
    return 0;
}

void quasi_newton_destroy(struct quasi_newton *quasi_newton)
{
    if (!quasi_newton)
        return;
    memory_free(quasi_newton->ages);
    memory_free(quasi_newton->residual_changes);
    memory_free(quasi_newton->answer_changes);
    memory_free(quasi_newton->residual);
    memory_free(quasi_newton->answer);
    memory_free(quasi_newton->basis);
    memory_free(quasi_newton->triangle);
    memory_free(quasi_newton->coefficients);
    memory_free(quasi_newton->chosen);
    memory_free(quasi_newton);
}

/** Keep the columns that are marked in @p kept, in their order. */
static void columns_keep(struct quasi_newton *q, const bool *kept)
{
    size_t count = 0;
    for (size_t c = 0; c < q->n_columns; ++c) {
        if (!kept[c])
            continue;
        if (c != count) {
            q->ages[count] = q->ages[c];
            memcpy(q->residual_changes + count * q->n, q->residual_changes + c * q->n, q->n * sizeof(double));
            memcpy(q->answer_changes + count * LEVELS * q->n, q->answer_changes + c * LEVELS * q->n,
                   LEVELS * q->n * sizeof(double));
        }
        ++count;
    }
    q->n_columns = count;
}

void quasi_newton_restart(struct quasi_newton *quasi_newton)
{
    bool kept[MOST_COLUMNS] = {false};
    for (size_t c = 0; c < quasi_newton->n_columns; ++c)
        kept[c] = ++quasi_newton->ages[c] <= quasi_newton->reused_steps;
    columns_keep(quasi_newton, kept);
    quasi_newton->iteration = 0;
}

static void column_add(struct quasi_newton *q, const double *residual, const double *answer)
{
    bool kept[MOST_COLUMNS];
    if (q->n_columns == q->capacity) { /* the oldest makes room */
        for (size_t c = 0; c < q->n_columns; ++c)
            kept[c] = c > 0;
        columns_keep(q, kept);
    }
    double *residual_change = q->residual_changes + q->n_columns * q->n;
    double *answer_change = q->answer_changes + q->n_columns * LEVELS * q->n;
    for (size_t k = 0; k < q->n; ++k)
        residual_change[k] = residual[k] - q->residual[k];
    for (size_t k = 0; k < LEVELS * q->n; ++k)
        answer_change[k] = answer[k] - q->answer[k];
    q->ages[q->n_columns++] = 0;
}

static double product(const double *a, const double *b, size_t n)
{
    double sum = 0.0;
    for (size_t k = 0; k < n; ++k)
        sum += a[k] * b[k];
    return sum;
}

/** Take the first @p size vectors of the basis out of @p v; what they had in it is added to column @p size of
 * R. */
static void orthogonalise(struct quasi_newton *q, double *v, size_t size)
{
    for (size_t i = 0; i < size; ++i) {
        const double *e = q->basis + i * q->n, part = product(e, v, q->n);
        q->triangle[i * q->capacity + size] += part;
        for (size_t k = 0; k < q->n; ++k)
            v[k] -= part * e[k];
    }
}

/** QR factors of the changes of the residual, newest first; columns with little that is new are dropped for
 * good. Returns the size of the basis. */
static size_t factor(struct quasi_newton *q)
{
    bool kept[MOST_COLUMNS] = {false};
    size_t size = 0, below = 0;
    for (size_t c = q->n_columns; c-- > 0;) {
        double *v = q->basis + size * q->n;
        memcpy(v, q->residual_changes + c * q->n, q->n * sizeof *v);
        for (size_t i = 0; i < size; ++i)
            q->triangle[i * q->capacity + size] = 0.0;
        const double whole = sqrt(product(v, v, q->n));
        orthogonalise(q, v, size);
        orthogonalise(q, v, size);
        const double left = sqrt(product(v, v, q->n));
        if (!(left > q->filter * whole))
            continue;
        for (size_t k = 0; k < q->n; ++k)
            v[k] /= left;
        q->triangle[size * q->capacity + size] = left;
        q->chosen[size++] = c;
        kept[c] = true;
    }
    /* their numbers once those that are dropped are gone */
    for (size_t i = size; i-- > 0;)
        q->chosen[i] = below++;
    columns_keep(q, kept);
    return size;
}

/** Coefficients c with the least |residual + sum of c times changes|. */
static void solve(struct quasi_newton *q, size_t size, const double *residual)
{
    for (size_t i = size; i-- > 0;) {
        double sum = -product(q->basis + i * q->n, residual, q->n);
        for (size_t j = i + 1; j < size; ++j)
            sum -= q->triangle[i * q->capacity + j] * q->coefficients[j];
        q->coefficients[i] = sum / q->triangle[i * q->capacity + i];
    }
}

void quasi_newton_next(struct quasi_newton *quasi_newton, const double *residual, const double *answer,
                       double *iterate)
{
    struct quasi_newton *q = quasi_newton;
    const size_t n = LEVELS * q->n;
    if (q->iteration++ > 0)
        column_add(q, residual, answer);
    memcpy(q->residual, residual, q->n * sizeof *residual);
    memcpy(q->answer, answer, n * sizeof *answer);
    const size_t size = factor(q);
    if (size == 0) {
        for (size_t k = 0; k < n; ++k)
            iterate[k] += q->first * (answer[k] - iterate[k]);
        return;
    }
    solve(q, size, residual);
    memcpy(iterate, answer, n * sizeof *iterate);
    for (size_t i = 0; i < size; ++i) {
        const double *change = q->answer_changes + q->chosen[i] * n;
        for (size_t k = 0; k < n; ++k)
            iterate[k] += q->coefficients[i] * change[k];
    }
}

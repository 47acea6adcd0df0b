// SPDX-License-Identifier: GPL-3.0-or-later
#include "math/gmres.h"

#include "base/error.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

struct gmres {
    size_t n;
    int room;              /**< directions */
    double *basis;         /**< room + 1 vectors, orthonormal */
    double *directions;    /**< room preconditioned vectors */
    double *hessenberg;    /**< room columns of room + 1, made triangular by rotations */
    double *cosine, *sine; /**< rotations */
    double *right;         /**< rotated right-hand side, room + 1 */
};

int gmres_create(struct gmres **created, size_t n, int iterations)
{
    *created = NULL;
    struct gmres *gmres = memory_create(1, sizeof *gmres);
    CHECK_MEMORY(gmres);
    const size_t room = (size_t)iterations;
    gmres->n = n;
    gmres->room = iterations;
    gmres->basis = memory_create((room + 1) * n, sizeof(double));
    gmres->directions = memory_create(room * n, sizeof(double));
    gmres->hessenberg = memory_create(room * (room + 1), sizeof(double));
    gmres->cosine = memory_create(room, sizeof(double));
    gmres->sine = memory_create(room, sizeof(double));
    gmres->right = memory_create(room + 1, sizeof(double));
    if (!gmres->basis || !gmres->directions || !gmres->hessenberg || !gmres->cosine || !gmres->sine ||
        !gmres->right) {
        gmres_destroy(gmres);
        return STATUS_MEMORY;
    }
    *created = gmres;
    return 0;
}

void gmres_destroy(struct gmres *gmres)
{
    if (!gmres)
        return;
    memory_free(gmres->basis);
    memory_free(gmres->directions);
    memory_free(gmres->hessenberg);
    memory_free(gmres->cosine);
    memory_free(gmres->sine);
    memory_free(gmres->right);
    memory_free(gmres);
}

static double dot(size_t n, const double *a, const double *b)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += a[i] * b[i];
    return sum;
}

/** Make @p w orthogonal to the first @p k + 1 basis vectors (modified Gram-Schmidt) and normalise it; @p
 * column gets the coefficients. */
static void orthogonalise(const struct gmres *gmres, int k, double *w, double *column)
{
    for (int i = 0; i <= k; i++) {
        const double *v = gmres->basis + (size_t)i * gmres->n;
        column[i] = dot(gmres->n, v, w);
        for (size_t j = 0; j < gmres->n; j++)
            w[j] -= column[i] * v[j];
    }
    column[k + 1] = sqrt(dot(gmres->n, w, w));
    if (column[k + 1] > 0)
        for (size_t j = 0; j < gmres->n; j++)
            w[j] /= column[k + 1];
}

/** Apply the rotations so far to the new column and make the one that clears its last entry. */
static void rotate(struct gmres *gmres, int k, double *column)
{
    for (int i = 0; i < k; i++) {
        const double upper = column[i], lower = column[i + 1];
        column[i] = gmres->cosine[i] * upper + gmres->sine[i] * lower;
        column[i + 1] = gmres->cosine[i] * lower - gmres->sine[i] * upper;
    }
    const double length = hypot(column[k], column[k + 1]);
    gmres->cosine[k] = length > 0 ? column[k] / length : 1;
    gmres->sine[k] = length > 0 ? column[k + 1] / length : 0;
    column[k] = length;
    column[k + 1] = 0;
    gmres->right[k + 1] = -gmres->sine[k] * gmres->right[k];
    gmres->right[k] *= gmres->cosine[k];
}

/** x := sum of the first @p used directions with the coefficients of the triangular system. */
static void combine(struct gmres *gmres, int used, double *x)
{
    const size_t height = (size_t)gmres->room + 1;
    for (int k = used - 1; k >= 0; k--) {
        for (int j = k + 1; j < used; j++)
            gmres->right[k] -= gmres->hessenberg[(size_t)j * height + (size_t)k] * gmres->right[j];
        const double pivot = gmres->hessenberg[(size_t)k * height + (size_t)k];
        gmres->right[k] = fabs(pivot) > 0 ? gmres->right[k] / pivot : 0;
    }
    memset(x, 0, gmres->n * sizeof *x);
    for (int k = 0; k < used; k++) {
        const double *z = gmres->directions + (size_t)k * gmres->n;
        for (size_t i = 0; i < gmres->n; i++)
            x[i] += gmres->right[k] * z[i];
    }
}

int gmres_solve(struct gmres *gmres, gmres_apply apply, void *context, const double *b, double *x,
                double tolerance, int *iterations, double *residual)
{
    const size_t n = gmres->n;
    const double norm = sqrt(dot(n, b, b));
    int used = 0;
    CHECK(isfinite(norm), STATUS_NUMERICAL, "GMRES: the right-hand side is not finite");
    gmres->right[0] = norm;
    for (size_t i = 0; norm > 0 && i < n; i++)
        gmres->basis[i] = b[i] / norm;
    while (used < gmres->room && fabs(gmres->right[used]) > tolerance * norm) {
        double *w = gmres->basis + (size_t)(used + 1) * n;
        double *column = gmres->hessenberg + (size_t)used * ((size_t)gmres->room + 1);
        CALL(apply(context, gmres->basis + (size_t)used * n, gmres->directions + (size_t)used * n, w));
        orthogonalise(gmres, used, w, column);
        CHECK(isfinite(column[used + 1]), STATUS_NUMERICAL, "GMRES: direction %d is not finite", used + 1);
        rotate(gmres, used, column);
        used++;
    }
    if (residual)
        *residual = norm > 0 ? fabs(gmres->right[used]) / norm : 0;
    if (iterations)
        *iterations = used;
    combine(gmres, used, x);
    return 0;
}

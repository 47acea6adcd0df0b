// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TESTS_SPH_POINTS_H
#define TESTS_SPH_POINTS_H

#include "sph/cell_grid.h"

#include <math.h>
#include <string.h>

/** Points to search among. Include after cmocka.h. */

enum points_kind {
    POINTS_RANDOM,    /**< anywhere in the domain */
    POINTS_CLUSTERED, /**< most of them in a corner */
    POINTS_PERIODIC,  /**< anywhere, periodic in the directions y and z (1-D: x) */
    POINTS_OUTSIDE,   /**< a fifth of them outside the domain */
    POINTS_KINDS
};

enum { POINTS_MOST = 1000 };

struct points {
    int dim;
    size_t n;
    double lower[3], upper[3];
    bool periodic[3];
    double x[3][POINTS_MOST];
    uint64_t seed;
};

/** A repeatable number in [-1, 1). */
static inline double points_random(struct points *points)
{
    points->seed = points->seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(points->seed >> 11) / 4503599627370496.0 - 1.0;
}

static inline void points_make(struct points *points, int dim, int kind, size_t n)
{
    static const double lower[3] = {-0.7, -0.3, 1.1}, upper[3] = {1.6, 0.9, 2.4};
    memset(points, 0, sizeof *points);
    points->dim = dim;
    points->n = n;
    points->seed = 77 + (uint64_t)(4 * dim + kind);
    for (int k = 0; k < 3; ++k) {
        points->lower[k] = lower[k];
        points->upper[k] = upper[k];
        points->periodic[k] = kind == POINTS_PERIODIC && k < dim && (k > 0 || dim == 1);
    }
    for (size_t i = 0; i < n; ++i)
        for (int k = 0; k < dim; ++k) {
            double s = 0.5 + 0.5 * points_random(points);
            if (kind == POINTS_CLUSTERED && i % 8 != 0)
                s = 0.1 * s * s;
            if (kind == POINTS_OUTSIDE && i % 5 == 0)
                s = 2.0 * s - 0.5;
            points->x[k][i] = lower[k] + s * (upper[k] - lower[k]);
        }
}

/** A grid with rows of at least 0.37 and cells of at least 0.11 along x. */
static inline void points_grid(const struct points *points, struct cell_grid *grid)
{
    assert_int_equal(
        cell_grid_create(grid, points->dim, points->lower, points->upper, points->periodic, 0.37, 0.37, 0.11),
        0);
}

/** Put the points in the order of the grid. */
static inline void points_sort(struct points *points, struct cell_grid *grid)
{
    static uint32_t order[POINTS_MOST];
    static double copy[POINTS_MOST];
    const double *const x[3] = {points->x[0], points->x[1], points->x[2]};
    assert_int_equal(cell_grid_sort(grid, x, points->n, order), 0);
    for (int k = 0; k < 3; ++k) {
        memcpy(copy, points->x[k], sizeof copy);
        for (size_t i = 0; i < points->n; ++i)
            points->x[k][i] = copy[order[i]];
    }
}

/** Shift of periodic image @p image (0..26); false when there is no such image. */
static inline bool points_image(const struct points *points, int image, double shift[3])
{
    for (int k = 0; k < 3; ++k, image /= 3) {
        const int times = image % 3 - 1;
        if (times && !points->periodic[k])
            return false;
        shift[k] = times * (points->upper[k] - points->lower[k]);
    }
    return true;
}

/** Distance of @p x from @p y, moved by @p shift. */
static inline double points_distance(const double x[3], const double y[3], const double shift[3])
{
    double r2 = 0.0;
    for (int k = 0; k < 3; ++k)
        r2 += (x[k] - y[k] - shift[k]) * (x[k] - y[k] - shift[k]);
    return sqrt(r2);
}

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "points.h"

#include "base/error.h"
#include "base/log.h"
#include "base/parallel.h"

#include <stdlib.h>
#include <string.h>

/** Cell of a point by its definition: along x within the row, rows counted in y, then z. */
static size_t cell_of(const struct cell_grid *grid, const struct points *points, size_t i)
{
    size_t cell = 0;
    for (int k = grid->dim - 1; k >= 0; --k) {
        int c = (int)floor((points->x[k][i] - grid->lower[k]) / grid->row_width[k]);
        c = c < 0 ? 0 : c >= grid->cells[k] ? grid->cells[k] - 1 : c;
        cell = cell * (size_t)grid->cells[k] + (size_t)c;
    }
    return cell;
}

static void test_sort(void **state)
{
    (void)state;
    for (int dim = 1; dim <= 3; ++dim)
        for (int kind = 0; kind < POINTS_KINDS; ++kind) {
            struct points points;
            struct cell_grid grid;
            uint32_t order[POINTS_MOST], other[POINTS_MOST];
            bool seen[POINTS_MOST] = {false};
            points_make(&points, dim, kind, 900);
            points_grid(&points, &grid);
            const double *const x[3] = {points.x[0], points.x[1], points.x[2]};
            grid.moved = 7.0;
            assert_int_equal(cell_grid_sort(&grid, x, points.n, order), 0);
            assert_true(grid.moved == 0.0);
            for (size_t i = 0; i < points.n; ++i) {
                assert_true(order[i] < points.n && !seen[order[i]]);
                seen[order[i]] = true;
                const size_t cell = cell_of(&grid, &points, order[i]);
                assert_in_range(i, grid.start[cell], grid.start[cell + 1] - 1);
                if (i > 0) {
                    const size_t before = cell_of(&grid, &points, order[i - 1]);
                    assert_true(before < cell || (before == cell && order[i - 1] < order[i]));
                }
            }
            static const int threads[] = {2, 3, 7, 1};
            for (int t = 0; t < 4; ++t) {
                parallel_setup(threads[t]);
                assert_int_equal(cell_grid_sort(&grid, x, points.n, other), 0);
                assert_memory_equal(order, other, points.n * sizeof *order);
            }
            cell_grid_reset(&grid);
        }
}

/** How often the ranges hold sorted point @p i in the image @p shift. */
static int times_found(const struct cell_range *ranges, size_t n, size_t i, const double shift[3])
{
    int times = 0;
    for (size_t r = 0; r < n; ++r) {
        bool same = i >= ranges[r].begin && i < ranges[r].end;
        for (int k = 0; k < 3; ++k)
            same = same && fabs(ranges[r].shift[k] - shift[k]) < 1e-12;
        times += same;
    }
    return times;
}

/** All points and images within @p radius of @p x are found, once; returns their number. */
static size_t search_check(const struct points *points, const struct cell_grid *grid, const double x[3],
                           double radius)
{
    struct cell_range ranges[CELL_GRID_RANGES];
    const size_t n = cell_grid_ranges(grid, x, radius, ranges);
    size_t found = 0;
    for (size_t r = 0; r < n; ++r)
        assert_true(ranges[r].begin < ranges[r].end && ranges[r].end <= points->n);
    for (int image = 0; image < 27; ++image) {
        double shift[3];
        if (!points_image(points, image, shift))
            continue;
        for (size_t i = 0; i < points->n; ++i) {
            const int times = times_found(ranges, n, i, shift);
            const double y[3] = {points->x[0][i], points->x[1][i], points->x[2][i]};
            assert_true(times <= 1);
            if (points_distance(x, y, shift) <= radius) {
                assert_int_equal(times, 1);
                ++found;
            }
        }
    }
    return found;
}

static void test_search(void **state)
{
    (void)state;
    for (int dim = 1; dim <= 3; ++dim)
        for (int kind = 0; kind < POINTS_KINDS; ++kind) {
            struct points points;
            struct cell_grid grid;
            size_t found = 0;
            points_make(&points, dim, kind, 700);
            points_grid(&points, &grid);
            points_sort(&points, &grid);
            for (int q = 0; q < 60; ++q) {
                double x[3] = {0.0, 0.0, 0.0};
                for (int k = 0; k < dim; ++k) // also beyond the sides
                    x[k] = points.lower[k] +
                           (0.5 + 0.55 * points_random(&points)) * (points.upper[k] - points.lower[k]);
                found += search_check(&points, &grid, x, 0.31);
            }
            assert_true(found > 30);
            // points that have moved since are found when the grid knows how far they may have
            for (int k = 0; k < dim; ++k)
                for (size_t i = 0; i < points.n; ++i)
                    points.x[k][i] += 0.05 * points_random(&points);
            grid.moved = 0.05 * sqrt(dim);
            for (size_t i = 0; i < points.n; i += 30) {
                const double x[3] = {points.x[0][i], points.x[1][i], points.x[2][i]};
                assert_true(search_check(&points, &grid, x, 0.2) > 0);
            }
            cell_grid_reset(&grid);
        }
}

static void test_empty_and_lost(void **state)
{
    (void)state;
    struct points points;
    struct cell_grid grid;
    struct cell_range ranges[CELL_GRID_RANGES];
    const double middle[3] = {0.1, 0.2, 0.0}, nowhere[3] = {0.1, NAN, 0.0}, far[3] = {INFINITY, 0.0, 0.0};
    points_make(&points, 2, POINTS_RANDOM, 50);
    points_grid(&points, &grid);
    points_sort(&points, &grid);
    assert_true(cell_grid_ranges(&grid, middle, 0.5, ranges) > 0);
    assert_int_equal(cell_grid_ranges(&grid, nowhere, 0.5, ranges), 0);
    assert_int_equal(cell_grid_ranges(&grid, far, 0.5, ranges), 0);
    points.n = 0;
    points_sort(&points, &grid);
    assert_int_equal(cell_grid_ranges(&grid, middle, 0.5, ranges), 0);
    cell_grid_reset(&grid);
    cell_grid_reset(&grid);
}

static void test_errors(void **state)
{
    (void)state;
    static const double lower[3] = {-1.0, 0.0, 2.0}, upper[3] = {1.0, 1.1, 3.0};
    static const bool wraps[3] = {false, true, false}, none[3] = {false, false, false};
    struct cell_grid grid;
    uint32_t order[1];
    const double *const x[3] = {lower, lower, lower};
    // periodic sides must be further apart than twice the reach
    assert_int_equal(cell_grid_create(&grid, 2, lower, upper, wraps, 0.55, 0.4, 0.1), STATUS_DECK);
    cell_grid_reset(&grid);
    assert_int_equal(cell_grid_create(&grid, 2, lower, upper, wraps, 0.54, 0.4, 0.1), 0);
    assert_int_equal(grid.cells[0], 20);
    assert_int_equal(grid.cells[1], 2);
    assert_int_equal(grid.cells[2], 1);
    assert_int_equal(cell_grid_sort(&grid, x, UINT32_MAX, order), STATUS_MEMORY);
    cell_grid_reset(&grid);
    assert_int_equal(cell_grid_create(&grid, 3, lower, upper, none, 1e-4, 1e-4, 1e-4), STATUS_DECK);
    cell_grid_reset(&grid);
}

static int quiet(void **state)
{
    (void)state;
    log_set_level(LOG_ERROR);
    parallel_setup(1);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sort),
        cmocka_unit_test(test_search),
        cmocka_unit_test(test_empty_and_lost),
        cmocka_unit_test(test_errors),
    };
    return cmocka_run_group_tests(tests, quiet, NULL);
}

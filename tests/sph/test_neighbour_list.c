// SPDX-License-Identifier: GPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "points.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "sph/neighbour_list.h"

static const double radius = 0.29;

static const double *const *place(const struct points *points)
{
    static const double *x[3];
    for (int k = 0; k < 3; ++k)
        x[k] = points->x[k];
    return x;
}

/** How often the list of a cluster names point @p j in the image @p shift. */
static int times_listed(const struct neighbour_list *list, const struct neighbour_cluster *cluster, size_t j,
                        const double shift[3])
{
    const struct neighbour_chunk *chunk = &list->chunks[cluster->chunk];
    int times = 0;
    for (uint32_t s = 0; s < cluster->n_segments; ++s) {
        const struct neighbour_segment *segment = &chunk->segments[cluster->segment + s];
        if (points_distance(segment->shift, shift, (const double[3]){0.0, 0.0, 0.0}) > 1e-12)
            continue;
        for (uint32_t k = 0; k < segment->count; ++k)
            times += segment->base + chunk->offsets[segment->offset + k] == j;
    }
    return times;
}

/** Every pair of a cluster within the radius is listed once, and nothing twice; returns the pairs. */
static size_t cluster_check(const struct points *points, const struct neighbour_list *list,
                            const struct neighbour_cluster *cluster)
{
    size_t pairs = 0;
    for (int image = 0; image < 27; ++image) {
        double shift[3];
        if (!points_image(points, image, shift))
            continue;
        for (size_t j = 0; j < points->n; ++j) {
            const double y[3] = {points->x[0][j], points->x[1][j], points->x[2][j]};
            const int times = times_listed(list, cluster, j, shift);
            assert_true(times <= 1);
            for (uint32_t i = cluster->first; i < cluster->first + cluster->count; ++i) {
                const double x[3] = {points->x[0][i], points->x[1][i], points->x[2][i]};
                if (points_distance(x, y, shift) >= radius)
                    continue;
                ++pairs;
                assert_int_equal(times, 1);
            }
        }
    }
    return pairs;
}

static void test_pairs(void **state)
{
    (void)state;
    struct neighbour_list list = {0};
    for (int dim = 1; dim <= 3; ++dim)
        for (int kind = 0; kind < POINTS_KINDS; ++kind) {
            struct points points;
            struct cell_grid grid;
            size_t next = 0, pairs = 0;
            points_make(&points, dim, kind, 400);
            points_grid(&points, &grid);
            points_sort(&points, &grid);
            // the list is used again: it must forget what it held
            assert_int_equal(neighbour_list_make(&list, &grid, place(&points), points.n, radius), 0);
            for (size_t c = 0; c < list.n_clusters; ++c) {
                const struct neighbour_cluster *cluster = &list.clusters[c];
                assert_int_equal(cluster->first, next);
                assert_in_range(cluster->count, 1, NEIGHBOUR_LANES);
                next += cluster->count;
                pairs += cluster_check(&points, &list, cluster);
            }
            assert_int_equal(next, points.n);
            assert_true(pairs > 2 * points.n);
            cell_grid_reset(&grid);
        }
    assert_true(neighbour_list_bytes(&list) > 400 / NEIGHBOUR_LANES * sizeof *list.clusters);
    neighbour_list_reset(&list);
    assert_int_equal(neighbour_list_bytes(&list), 0);
}

/** Each cluster lists the same in the same order whatever the number of threads. */
static void test_threads(void **state)
{
    (void)state;
    struct points points;
    struct cell_grid grid;
    struct neighbour_list lists[2] = {{0}};
    points_make(&points, 3, POINTS_PERIODIC, 900);
    points_grid(&points, &grid);
    points_sort(&points, &grid);
    for (int t = 0; t < 2; ++t) {
        parallel_setup(1 + 2 * t);
        assert_int_equal(neighbour_list_make(&lists[t], &grid, place(&points), points.n, radius), 0);
    }
    parallel_setup(1);
    assert_int_equal(lists[0].n_clusters, lists[1].n_clusters);
    assert_true(lists[1].clusters[lists[1].n_clusters - 1].chunk == 2);
    for (size_t c = 0; c < lists[0].n_clusters; ++c) {
        const struct neighbour_cluster *a = &lists[0].clusters[c], *b = &lists[1].clusters[c];
        const struct neighbour_chunk *from = &lists[0].chunks[a->chunk], *to = &lists[1].chunks[b->chunk];
        assert_int_equal(a->n_segments, b->n_segments);
        for (uint32_t s = 0; s < a->n_segments; ++s) {
            const struct neighbour_segment *v = &from->segments[a->segment + s],
                                           *w = &to->segments[b->segment + s];
            assert_int_equal(v->base, w->base);
            assert_int_equal(v->count, w->count);
            assert_memory_equal(v->shift, w->shift, sizeof v->shift);
            assert_memory_equal(from->offsets + v->offset, to->offsets + w->offset,
                                v->count * sizeof *from->offsets);
        }
    }
    for (int t = 0; t < 2; ++t)
        neighbour_list_reset(&lists[t]);
    cell_grid_reset(&grid);
}

/** Offsets have 16 bits: a row of more than 65536 points takes several segments. */
static void test_long_row(void **state)
{
    (void)state;
    enum { N = 66000 };
    static const double lower[3] = {0.0, 0.0, 0.0}, upper[3] = {N, 1.0, 1.0};
    static const bool none[3] = {false, false, false};
    struct cell_grid grid;
    struct neighbour_list list = {0};
    double *x = memory_create(N, sizeof *x), *zero = memory_create(N, sizeof *zero);
    uint32_t *order = memory_create(N, sizeof *order);
    assert_true(x && zero && order);
    for (size_t i = 0; i < N; ++i)
        x[i] = (double)i + 0.5;
    const double *const places[3] = {x, zero, zero};
    assert_int_equal(cell_grid_create(&grid, 1, lower, upper, none, N, N), 0);
    assert_int_equal(grid.cells[0], 1);
    assert_int_equal(cell_grid_sort(&grid, places, N, order), 0);
    assert_int_equal(neighbour_list_make(&list, &grid, places, N, 1.5), 0);
    size_t split = 0;
    for (size_t c = 0; c < list.n_clusters; ++c) {
        const struct neighbour_cluster *cluster = &list.clusters[c];
        const struct neighbour_chunk *chunk = &list.chunks[cluster->chunk];
        size_t count = 0;
        for (uint32_t s = 0; s < cluster->n_segments; ++s)
            for (uint32_t k = 0; k < chunk->segments[cluster->segment + s].count; ++k, ++count) {
                const struct neighbour_segment *segment = &chunk->segments[cluster->segment + s];
                const size_t j = segment->base + chunk->offsets[segment->offset + k];
                assert_true(j + 1 >= cluster->first && j <= cluster->first + cluster->count);
            }
        assert_int_equal(count, cluster->count + (c > 0) + (c + 1 < list.n_clusters));
        split += cluster->n_segments > 1;
    }
    assert_int_equal(split, 2); // the clusters before and behind point 65536
    neighbour_list_reset(&list);
    cell_grid_reset(&grid);
    memory_free(x);
    memory_free(zero);
    memory_free(order);
}

static void test_empty(void **state)
{
    (void)state;
    struct points points;
    struct cell_grid grid;
    struct neighbour_list list = {0};
    points_make(&points, 2, POINTS_RANDOM, 0);
    points_grid(&points, &grid);
    points_sort(&points, &grid);
    assert_int_equal(neighbour_list_make(&list, &grid, place(&points), 0, radius), 0);
    assert_int_equal(list.n_clusters, 0);
    neighbour_list_reset(&list);
    cell_grid_reset(&grid);
}

static int one_thread(void **state)
{
    (void)state;
    parallel_setup(1);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pairs),
        cmocka_unit_test(test_threads),
        cmocka_unit_test(test_long_row),
        cmocka_unit_test(test_empty),
    };
    return cmocka_run_group_tests(tests, one_thread, NULL);
}

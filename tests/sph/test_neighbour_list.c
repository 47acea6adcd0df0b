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

/** The slot of particle @p j. */
static size_t slot_of(const struct neighbour_list *list, size_t j)
{
    const struct neighbour_cluster *cluster = &list->clusters[list->cluster_of[j]];
    assert_in_range(j, cluster->first, cluster->first + cluster->count - 1);
    return cluster->slot + (j - cluster->first);
}

/** How often the list of a cluster names point @p j in the image @p shift. */
static int times_listed(const struct neighbour_list *list, const struct neighbour_cluster *cluster, size_t j,
                        const double shift[3])
{
    const struct neighbour_chunk *chunk = &list->chunks[cluster->chunk];
    const size_t couple = slot_of(list, j) / 2;
    int times = 0;
    for (uint32_t s = 0; s < cluster->n_segments; ++s) {
        const struct neighbour_segment *segment = &chunk->segments[cluster->segment + s];
        if (points_distance(list->shift[segment->image], shift, (const double[3]){0.0, 0.0, 0.0}) > 1e-12)
            continue;
        for (uint32_t k = 0; k < segment->count; ++k)
            times += segment->base + chunk->offsets[segment->offset + k] == couple;
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
            assert_int_equal(
                neighbour_list_make(&list, &grid, place(&points), points.n, radius, ISA_BASELINE), 0);
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
        assert_int_equal(
            neighbour_list_make(&lists[t], &grid, place(&points), points.n, radius, ISA_BASELINE), 0);
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
            assert_int_equal(v->image, w->image);
            assert_memory_equal(from->offsets + v->offset, to->offsets + w->offset,
                                v->count * sizeof *from->offsets);
        }
    }
    for (int t = 0; t < 2; ++t)
        neighbour_list_reset(&lists[t]);
    cell_grid_reset(&grid);
}

/** A row of @p n points at @p x in one cell of length @p length; the list for radius 1.5. */
static void row_list(struct neighbour_list *list, double *x, uint32_t n, double length, double cell)
{
    static const double lower[3] = {0.0, 0.0, 0.0};
    static const bool none[3] = {false, false, false};
    const double upper[3] = {length, 1.0, 1.0};
    struct cell_grid grid;
    double *zero = memory_create(n, sizeof *zero);
    uint32_t *order = memory_create(n, sizeof *order);
    assert_true(zero && order);
    const double *const places[3] = {x, zero, zero};
    assert_int_equal(cell_grid_create(&grid, 1, lower, upper, none, 1.5, length, cell), 0);
    assert_int_equal(cell_grid_sort(&grid, places, n, order), 0);
    assert_int_equal(neighbour_list_make(list, &grid, places, n, 1.5, isa_best()), 0);
    cell_grid_reset(&grid);
    memory_free(zero);
    memory_free(order);
}

/** Offsets have 16 bits: a row of many points takes several segments. */
static void test_long_row(void **state)
{
    (void)state;
    enum { N = 40000, CLUSTERS = N / NEIGHBOUR_LANES };
    struct neighbour_list list = {0};
    double *x = memory_create(N, sizeof *x);
    assert_non_null(x);
    for (size_t i = 0; i < N; ++i)
        x[i] = (double)i + 0.5;
    row_list(&list, x, N, N, N);
    assert_int_equal(list.n_clusters, CLUSTERS);
    size_t split = 0;
    for (size_t c = 0; c < list.n_clusters; ++c) {
        const struct neighbour_cluster *cluster = &list.clusters[c];
        const struct neighbour_chunk *chunk = &list.chunks[cluster->chunk];
        size_t count = 0;
        for (uint32_t s = 0; s < cluster->n_segments; ++s)
            for (uint32_t k = 0; k < chunk->segments[cluster->segment + s].count; ++k, ++count) {
                const struct neighbour_segment *segment = &chunk->segments[cluster->segment + s];
                const size_t couple = segment->base + chunk->offsets[segment->offset + k];
                assert_true(2 * couple + 2 >= cluster->slot && 2 * couple <= cluster->slot + cluster->count);
            }
        assert_int_equal(count, cluster->count / 2 + (c > 0) + (c + 1 < list.n_clusters));
        split += cluster->n_segments > 1;
    }
    assert_int_equal(split, 2); // the clusters before and behind point 4096 x 8
    neighbour_list_reset(&list);
    memory_free(x);
}

/** Where a row has a gap, a new cluster begins: the particles of a couple stay close to each other. */
static void test_gap(void **state)
{
    (void)state;
    enum { N = 14 };
    double x[N] = {0.5, 1.5, 2.5, 7.1, 8.1, 500.0, 500.1, 500.2, 500.3, 500.4, 500.5, 500.6, 500.7, 500.8};
    static const uint32_t first[] = {0, 3, 5, 13}, slots[] = {0, 4, 6, 14};
    struct neighbour_list list = {0};
    row_list(&list, x, N, 600.0, 1.0);
    assert_int_equal(list.n_clusters, 4);
    assert_int_equal(list.n_slots, 16);
    for (size_t c = 0; c < 4; ++c) {
        assert_int_equal(list.clusters[c].first, first[c]);
        assert_int_equal(list.clusters[c].slot, slots[c]);
    }
    neighbour_list_reset(&list);
}

/** Every instruction set finds the same. */
static void test_isas(void **state)
{
    (void)state;
    struct points points;
    struct cell_grid grid;
    struct neighbour_list lists[ISAS] = {{0}};
    points_make(&points, 3, POINTS_PERIODIC, 700);
    points_grid(&points, &grid);
    points_sort(&points, &grid);
    for (enum isa isa = ISA_BASELINE; isa <= isa_best(); ++isa) {
        struct neighbour_chunk *chunk;
        assert_int_equal(neighbour_list_make(&lists[isa], &grid, place(&points), points.n, radius, isa), 0);
        chunk = lists[isa].chunks;
        assert_int_equal(chunk->n_offsets, lists[0].chunks->n_offsets);
        assert_memory_equal(chunk->offsets, lists[0].chunks->offsets,
                            chunk->n_offsets * sizeof *chunk->offsets);
    }
    for (int isa = 0; isa < ISAS; ++isa)
        neighbour_list_reset(&lists[isa]);
    cell_grid_reset(&grid);
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
    assert_int_equal(neighbour_list_make(&list, &grid, place(&points), 0, radius, ISA_BASELINE), 0);
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
        cmocka_unit_test(test_pairs), cmocka_unit_test(test_threads), cmocka_unit_test(test_long_row),
        cmocka_unit_test(test_gap),   cmocka_unit_test(test_isas),    cmocka_unit_test(test_empty),
    };
    return cmocka_run_group_tests(tests, one_thread, NULL);
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/neighbour_list.h"

#include "base/error.h"
#include "base/memory.h"
#include "base/parallel.h"

/** Cut each row of the sorted particles into clusters. */
static int clusters_make(struct neighbour_list *list, const struct cell_grid *grid, size_t n)
{
    size_t rows = (size_t)grid->cells[1] * (size_t)grid->cells[2];
    CALL(memory_grow((void **)&list->clusters, &list->cluster_capacity, n / NEIGHBOUR_LANES + rows + 1,
                     sizeof *list->clusters));
    list->n_clusters = 0;
    for (size_t row = 0; row < rows; ++row) {
        uint32_t begin = grid->start[row * (size_t)grid->cells[0]];
        uint32_t end = grid->start[(row + 1) * (size_t)grid->cells[0]];
        for (uint32_t first = begin; first < end; first += NEIGHBOUR_LANES) {
            uint32_t count = end - first < NEIGHBOUR_LANES ? end - first : NEIGHBOUR_LANES;
            list->clusters[list->n_clusters++] =
                (struct neighbour_cluster){.first = first, .count = (uint16_t)count};
        }
    }
    return 0;
}

struct box {
    double lower[3], upper[3];
};

static struct box cluster_box(const struct neighbour_cluster *cluster, const double *const x[3])
{
    struct box box;
    for (int k = 0; k < 3; ++k) {
        box.lower[k] = box.upper[k] = x[k][cluster->first];
        for (uint32_t i = cluster->first + 1; i < cluster->first + cluster->count; ++i) {
            if (x[k][i] < box.lower[k])
                box.lower[k] = x[k][i];
            if (x[k][i] > box.upper[k])
                box.upper[k] = x[k][i];
        }
    }
    return box;
}

static double box_distance2(const struct box *box, const double x[3])
{
    double d2 = 0.0;
    for (int k = 0; k < 3; ++k) {
        double d = x[k] < box->lower[k]   ? box->lower[k] - x[k]
                   : x[k] > box->upper[k] ? x[k] - box->upper[k]
                                          : 0.0;
        d2 += d * d;
    }
    return d2;
}

static int segment_add(struct neighbour_chunk *chunk, struct neighbour_cluster *cluster,
                       const struct box *box, const double *const x[3], const struct cell_range *range,
                       double radius2)
{
    for (uint32_t base = range->begin; base < range->end; base += 65536) {
        uint32_t end = range->end - base > 65536 ? base + 65536 : range->end;
        CALL(memory_grow((void **)&chunk->offsets, &chunk->offset_capacity, chunk->n_offsets + (end - base),
                         sizeof *chunk->offsets));
        size_t offset = chunk->n_offsets;
        for (uint32_t j = base; j < end; ++j) {
            double y[3];
            for (int k = 0; k < 3; ++k)
                y[k] = x[k][j] + range->shift[k];
            if (box_distance2(box, y) < radius2)
                chunk->offsets[chunk->n_offsets++] = (uint16_t)(j - base);
        }
        if (chunk->n_offsets == offset)
            continue;
        CALL(memory_grow((void **)&chunk->segments, &chunk->segment_capacity, chunk->n_segments + 1,
                         sizeof *chunk->segments));
        chunk->segments[chunk->n_segments++] =
            (struct neighbour_segment){base,
                                       (uint32_t)(chunk->n_offsets - offset),
                                       offset,
                                       {range->shift[0], range->shift[1], range->shift[2]}};
        ++cluster->n_segments;
    }
    return 0;
}

static int cluster_list(struct neighbour_chunk *chunk, struct neighbour_cluster *cluster,
                        const struct cell_grid *grid, const double *const x[3], double radius)
{
    struct box box = cluster_box(cluster, x);
    struct cell_range ranges[CELL_GRID_RANGES];
    double lower[3], upper[3];
    for (int k = 0; k < 3; ++k) {
        cluster->centre[k] = 0.5 * (box.lower[k] + box.upper[k]);
        lower[k] = box.lower[k] - radius;
        upper[k] = box.upper[k] + radius;
    }
    size_t n = cell_grid_box_ranges(grid, lower, upper, ranges);
    cluster->segment = (uint32_t)chunk->n_segments;
    cluster->n_segments = 0;
    for (size_t r = 0; r < n; ++r)
        CALL(segment_add(chunk, cluster, &box, x, &ranges[r], radius * radius));
    return 0;
}

int neighbour_list_make(struct neighbour_list *list, const struct cell_grid *grid, const double *const x[3],
                        size_t n, double radius)
{
    size_t threads = (size_t)parallel_threads();
    if (list->n_chunks < threads) {
        CALL(memory_grow((void **)&list->chunks, &list->n_chunks, threads, sizeof *list->chunks));
    }
    CALL(clusters_make(list, grid, n));
    int status = 0;
#pragma omp parallel for schedule(static) reduction(| : status)
    for (size_t c = 0; c < threads; ++c) {
        struct neighbour_chunk *chunk = &list->chunks[c];
        size_t first = list->n_clusters * c / threads, last = list->n_clusters * (c + 1) / threads;
        chunk->n_segments = chunk->n_offsets = 0;
        for (size_t k = first; k < last && !status; ++k) {
            list->clusters[k].chunk = (uint16_t)c;
            status = cluster_list(chunk, &list->clusters[k], grid, x, radius);
        }
    }
    return status;
}

void neighbour_list_reset(struct neighbour_list *list)
{
    for (size_t c = 0; c < list->n_chunks; ++c) {
        memory_free(list->chunks[c].segments);
        memory_free(list->chunks[c].offsets);
    }
    memory_free(list->chunks);
    memory_free(list->clusters);
    *list = (struct neighbour_list){0};
}

size_t neighbour_list_bytes(const struct neighbour_list *list)
{
    size_t bytes = list->cluster_capacity * sizeof *list->clusters;
    for (size_t c = 0; c < list->n_chunks; ++c)
        bytes += list->chunks[c].segment_capacity * sizeof *list->chunks[c].segments +
                 list->chunks[c].offset_capacity * sizeof *list->chunks[c].offsets;
    return bytes;
}

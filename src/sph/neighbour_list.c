// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/neighbour_list.h"

#include "base/error.h"
#include "base/memory.h"
#include "base/parallel.h"

#include <math.h>

static neighbour_filter *const filters[ISAS] = ISA_TABLE(neighbour_filter, mixed);

/** Cut one row of the sorted particles into clusters that extend over at most @p span cells. */
static void row_cut(struct neighbour_list *list, const uint32_t *start, size_t cells, size_t span)
{
    size_t cell = 0;
    for (uint32_t first = start[0], end = start[cells]; first < end;) {
        while (start[cell + 1] <= first)
            ++cell;
        uint32_t next = start[cell + span < cells ? cell + span : cells];
        if (next > first + NEIGHBOUR_LANES)
            next = first + NEIGHBOUR_LANES;
        for (uint32_t i = first; i < next; ++i)
            list->cluster_of[i] = (uint32_t)list->n_clusters;
        list->clusters[list->n_clusters++] = (struct neighbour_cluster){
            .first = first, .slot = (uint32_t)list->n_slots, .count = (uint16_t)(next - first)};
        list->n_slots += (next - first + 1) & ~1u;
        first = next;
    }
}

static int clusters_make(struct neighbour_list *list, const struct cell_grid *grid, size_t n, double radius)
{
    const size_t rows = (size_t)grid->cells[1] * (size_t)grid->cells[2], cells = (size_t)grid->cells[0];
    const double reach = 2.0 * radius / grid->row_width[0];
    const size_t span = reach < 1.0 ? 1 : reach < 1e9 ? (size_t)reach : (size_t)1e9;
    CALL(memory_grow((void **)&list->cluster_of, &list->cluster_of_capacity, n, sizeof *list->cluster_of));
    list->n_clusters = list->n_slots = 0;
    for (size_t row = 0; row < rows; ++row) {
        const uint32_t *start = grid->start + row * cells;
        /* at most one more for each stretch of cells */
        const size_t most = (start[cells] - start[0]) / NEIGHBOUR_LANES + cells / span + 2;
        CALL(memory_grow((void **)&list->clusters, &list->cluster_capacity, list->n_clusters + most,
                         sizeof *list->clusters));
        row_cut(list, start, cells, span);
    }
    return 0;
}

static void query_make(struct neighbour_query *query, const struct neighbour_cluster *cluster)
{
    for (int k = 0; k < query->dim; ++k) {
        const double *x = query->x[k] + cluster->first;
        query->lower[k] = query->upper[k] = x[0];
        for (int i = 1; i < cluster->count; ++i) {
            query->lower[k] = x[i] < query->lower[k] ? x[i] : query->lower[k];
            query->upper[k] = x[i] > query->upper[k] ? x[i] : query->upper[k];
        }
    }
}

/** The candidates among clusters @p first to @p last - 1. */
static int segment_add(struct neighbour_chunk *chunk, struct neighbour_cluster *cluster,
                       const struct neighbour_list *list, const struct neighbour_query *query, size_t first,
                       size_t last, unsigned image, neighbour_filter *filter)
{
    enum { MOST = 4096 }; /* clusters; 16 bits can tell the couples of 16384 apart */
    const double *shift = list->shift[image];
    for (size_t end; first < last; first = end) {
        end = last - first > MOST ? first + MOST : last;
        const uint32_t base = list->clusters[first].slot / 2;
        CALL(memory_grow((void **)&chunk->offsets, &chunk->offset_capacity,
                         chunk->n_offsets + (end - first) * (NEIGHBOUR_LANES / 2), sizeof *chunk->offsets));
        const size_t found = filter(query, list->clusters + first, end - first, shift, base,
                                    chunk->offsets + chunk->n_offsets);
        if (!found)
            continue;
        CALL(memory_grow((void **)&chunk->segments, &chunk->segment_capacity, chunk->n_segments + 1,
                         sizeof *chunk->segments));
        chunk->segments[chunk->n_segments++] =
            (struct neighbour_segment){base, (uint32_t)chunk->n_offsets, (uint16_t)found, (uint8_t)image};
        chunk->n_offsets += found;
        CHECK(chunk->n_offsets < UINT32_MAX - 16, STATUS_MEMORY,
              "a thread would have more than 4e9 candidates of neighbours in its list; use more threads");
        ++cluster->n_segments;
    }
    return 0;
}

/** Number of the periodic image that a range of cells belongs to: as many lengths of the domain along x, y, z
 * as its digits to the base 3, less one each. */
static unsigned image_of(const struct cell_grid *grid, const double shift[3])
{
    unsigned image = 0;
    for (int k = 2; k >= 0; --k)
        image = 3 * image + 1 + (unsigned)(int)lround(shift[k] / (grid->upper[k] - grid->lower[k]));
    return image;
}

static void images_make(struct neighbour_list *list, const struct cell_grid *grid)
{
    for (int image = 0; image < NEIGHBOUR_IMAGES; ++image)
        for (int k = 0, rest = image; k < 3; ++k, rest /= 3)
            list->shift[image][k] = (rest % 3 - 1) * (grid->upper[k] - grid->lower[k]);
}

static int cluster_list(struct neighbour_chunk *chunk, struct neighbour_cluster *cluster,
                        const struct neighbour_list *list, const struct cell_grid *grid,
                        struct neighbour_query *query, neighbour_filter *filter)
{
    struct cell_range ranges[CELL_GRID_RANGES];
    double lower[3] = {0}, upper[3] = {0};
    query_make(query, cluster);
    for (int k = 0; k < query->dim; ++k) {
        lower[k] = query->lower[k] - query->radius;
        upper[k] = query->upper[k] + query->radius;
    }
    size_t n = cell_grid_box_ranges(grid, lower, upper, ranges);
    CALL(memory_grow((void **)&chunk->offsets, &chunk->offset_capacity, chunk->n_offsets + 7,
                     sizeof *chunk->offsets));
    while (chunk->n_offsets & 7)
        chunk->offsets[chunk->n_offsets++] = 0;
    cluster->segment = (uint32_t)chunk->n_segments;
    cluster->n_segments = 0;
    for (size_t r = 0; r < n; ++r)
        CALL(segment_add(chunk, cluster, list, query, list->cluster_of[ranges[r].begin],
                         list->cluster_of[ranges[r].end - 1] + 1, image_of(grid, ranges[r].shift), filter));
    return 0;
}

int neighbour_list_make(struct neighbour_list *list, const struct cell_grid *grid, const double *const x[3],
                        size_t n, double radius, enum isa isa)
{
    size_t threads = (size_t)parallel_threads();
    if (list->n_chunks < threads)
        CALL(memory_grow((void **)&list->chunks, &list->n_chunks, threads, sizeof *list->chunks));
    CALL(clusters_make(list, grid, n, radius));
    images_make(list, grid);
    list->radius = radius;
    list->length = grid->periodic[0] ? grid->upper[0] - grid->lower[0] : 0.0;
    list->fresh = true;
    int status = 0;
#pragma omp parallel for schedule(static) reduction(| : status)
    for (size_t c = 0; c < threads; ++c) {
        struct neighbour_chunk *chunk = &list->chunks[c];
        struct neighbour_query query = {.dim = grid->dim, .x = {x[0], x[1], x[2]}, .radius = radius};
        size_t first = list->n_clusters * c / threads, last = list->n_clusters * (c + 1) / threads;
        chunk->n_segments = chunk->n_offsets = 0;
        for (size_t k = first; k < last && !status; ++k) {
            list->clusters[k].chunk = (uint16_t)c;
            status = cluster_list(chunk, &list->clusters[k], list, grid, &query, filters[isa]);
        }
        if (!status) /* whole words can be read behind the last bit */
            status = memory_grow((void **)&chunk->near, &chunk->near_capacity, chunk->n_offsets / 8 + 9, 1);
    }
    return status;
}

void neighbour_list_reset(struct neighbour_list *list)
{
    for (size_t c = 0; c < list->n_chunks; ++c) {
        memory_free(list->chunks[c].segments);
        memory_free(list->chunks[c].offsets);
        memory_free(list->chunks[c].near);
    }
    memory_free(list->chunks);
    memory_free(list->clusters);
    memory_free(list->cluster_of);
    *list = (struct neighbour_list){0};
}

size_t neighbour_list_bytes(const struct neighbour_list *list)
{
    size_t bytes = list->cluster_capacity * sizeof *list->clusters +
                   list->cluster_of_capacity * sizeof *list->cluster_of;
    for (size_t c = 0; c < list->n_chunks; ++c)
        bytes += list->chunks[c].segment_capacity * sizeof *list->chunks[c].segments +
                 list->chunks[c].offset_capacity * sizeof *list->chunks[c].offsets +
                 list->chunks[c].near_capacity;
    return bytes;
}

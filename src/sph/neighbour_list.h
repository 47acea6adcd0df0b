// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef SPH_NEIGHBOUR_LIST_H
#define SPH_NEIGHBOUR_LIST_H

#include "sph/cell_grid.h"

enum { NEIGHBOUR_LANES = 16 };

/** Candidates of a cluster in one run of sorted particles: indices base + offset[k]. */
struct neighbour_segment {
    uint32_t base, count;
    size_t offset;   /**< of its first entry in the chunk's offsets */
    double shift[3]; /**< periodic image: add to the candidates' coordinates */
};

/** Up to NEIGHBOUR_LANES consecutive particles of a row that share one candidate list: everything that may
 * come within the support of any of them before the next rebuild, themselves included. */
struct neighbour_cluster {
    uint32_t first;
    uint16_t count, chunk;
    uint32_t segment, n_segments; /**< in its chunk */
    double centre[3];             /**< of the bounding box when the list was made */
};

/** What one thread built: segments and 16-bit offsets. */
struct neighbour_chunk {
    struct neighbour_segment *segments;
    uint16_t *offsets;
    size_t n_segments, segment_capacity, n_offsets, offset_capacity;
};

/** Verlet list over clusters, in gather form: each particle's sums are made by one lane in the order of the
 * list, so results do not depend on the number of threads. */
struct neighbour_list {
    size_t n_clusters, cluster_capacity;
    struct neighbour_cluster *clusters;
    size_t n_chunks;
    struct neighbour_chunk *chunks;
};

/** Make the list for @p n particles at @p x, sorted by @p grid: all pairs within @p radius. Returns a status.
 */
int neighbour_list_make(struct neighbour_list *list, const struct cell_grid *grid, const double *const x[3],
                        size_t n, double radius);
void neighbour_list_reset(struct neighbour_list *list);

/** Memory held, bytes. */
size_t neighbour_list_bytes(const struct neighbour_list *list);

#endif

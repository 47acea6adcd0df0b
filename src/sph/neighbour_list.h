// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef SPH_NEIGHBOUR_LIST_H
#define SPH_NEIGHBOUR_LIST_H

#include "sph/cell_grid.h"
#include "sph/isa.h"

enum { NEIGHBOUR_LANES = 8 };

enum { NEIGHBOUR_IMAGES = 27 };

/** Candidates of a cluster in one run of sorted particles: the couples base + offset[k]. */
struct neighbour_segment {
    uint32_t base, offset; /**< offset: of its first entry in the chunk's offsets */
    uint16_t count;
    uint8_t image; /**< periodic image: the list's shift is added to the candidates' coordinates */
};

/** Up to NEIGHBOUR_LANES consecutive particles of a row, close to each other, that share one candidate list:
 * everything that may come within the support of any of them before the next rebuild, themselves included.
 * Candidates come in couples: the particles of all clusters are numbered in slots, each cluster beginning
 * with an even one, and slots 2 c and 2 c + 1 are couple c. The last slot of an odd cluster has no particle.
 */
struct neighbour_cluster {
    uint32_t first, slot;
    uint16_t count, chunk;
    uint32_t segment, n_segments; /**< in its chunk */
};

/** What one thread built: segments and 16-bit offsets; a cluster's first offset has a number that 8 divides.
 */
struct neighbour_chunk {
    struct neighbour_segment *segments;
    uint16_t *offsets;
    uint8_t *near; /**< a bit per offset, for sweeps: whether the couple was within the support lately */
    size_t n_segments, segment_capacity, n_offsets, offset_capacity, near_capacity;
};

/** Verlet list over clusters, in gather form: each particle's sums are made by its own lanes in the order of
 * the list, so results do not depend on the number of threads. Along a row, the particles of a listed couple
 * are at most five radii and three cells away from each one of the cluster. */
struct neighbour_list {
    size_t n_clusters, cluster_capacity;
    struct neighbour_cluster *clusters;
    size_t n_slots;
    double shift[NEIGHBOUR_IMAGES][3];
    double radius, length; /**< of the pairs; of the domain along x where that is periodic, else 0 */
    bool fresh; /**< the particles are where they were when the list was made: sweeps may shorten it */
    uint32_t *cluster_of; /**< of each particle */
    size_t cluster_of_capacity;
    size_t n_chunks;
    struct neighbour_chunk *chunks;
};

/** Make the list for @p n particles at @p x, sorted by @p grid: all pairs within @p radius; @p isa: how fast,
 * not what. Returns a status. */
int neighbour_list_make(struct neighbour_list *list, const struct cell_grid *grid, const double *const x[3],
                        size_t n, double radius, enum isa isa);
void neighbour_list_reset(struct neighbour_list *list);

/** Memory held, bytes. */
size_t neighbour_list_bytes(const struct neighbour_list *list);

/** What a cluster's candidates are chosen by: the places of all particles, the bounding box of the cluster.
 */
struct neighbour_query {
    int dim;
    const double *x[3];
    double lower[3], upper[3], radius;
};

/** Of the couples of @p n clusters the ones with a particle that, moved by @p shift, lies within the radius
 * of the box: their numbers minus @p base into @p offsets (room for NEIGHBOUR_LANES / 2 per cluster). Returns
 * how many. Compiled once per instruction set. */
typedef size_t neighbour_filter(const struct neighbour_query *query, const struct neighbour_cluster *clusters,
                                size_t n, const double shift[3], uint32_t base, uint16_t *offsets);

neighbour_filter neighbour_filter_baseline_mixed, neighbour_filter_v3_mixed, neighbour_filter_v4_mixed;

#endif

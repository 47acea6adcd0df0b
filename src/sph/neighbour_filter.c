// SPDX-License-Identifier: GPL-3.0-or-later
/* The innermost loop of making lists, compiled once per instruction set. */
#include "sph/neighbour_list.h"

#include "sph/sweep_vector.h"

#include <string.h>

/** The places of a cluster's particles; where it is not full, the first one again. */
SWEEP_INLINE const double *places(const double *x, const struct neighbour_cluster *cluster,
                                  double copy[NEIGHBOUR_LANES])
{
    x += cluster->first;
    if (cluster->count == NEIGHBOUR_LANES)
        return x;
    for (int l = 0; l < NEIGHBOUR_LANES; ++l)
        copy[l] = x[l < cluster->count ? l : 0];
    return copy;
}

size_t SWEEP_NAME(neighbour_filter)(const struct neighbour_query *query,
                                    const struct neighbour_cluster *clusters, size_t n, const double shift[3],
                                    uint32_t base, uint16_t *offsets)
{
    const double radius2 = query->radius * query->radius;
    size_t found = 0;
    for (const struct neighbour_cluster *cluster = clusters; cluster < clusters + n; ++cluster) {
        double far2[NEIGHBOUR_LANES] = {0}, copy[NEIGHBOUR_LANES];
        for (int k = 0; k < query->dim; ++k) {
            const double *x = places(query->x[k], cluster, copy);
            const double lower = query->lower[k] - shift[k], upper = query->upper[k] - shift[k];
#pragma omp simd
            for (int l = 0; l < NEIGHBOUR_LANES; ++l) {
                const double below_box = lower - x[l], above_box = x[l] - upper;
                const double nearer = below_box > above_box ? below_box : above_box;
                const double beyond = nearer > 0.0 ? nearer : 0.0;
                far2[l] += beyond * beyond;
            }
        }
        for (int l = 0; l < cluster->count; l += 2) {
            offsets[found] = (uint16_t)(cluster->slot / 2 + (uint32_t)l / 2 - base);
            found += far2[l] < radius2 || far2[l + 1] < radius2;
        }
    }
    return found;
}

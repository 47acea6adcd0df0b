// SPDX-License-Identifier: GPL-3.0-or-later
/* The innermost loop of making lists, compiled once per instruction set: in single precision with a margin,
 * since couples that are listed in vain do no harm. */
#include "sph/neighbour_list.h"

#include "sph/sweep_vector.h"

#include <string.h>

typedef float eight __attribute__((vector_size(32)));
typedef double eight_wide __attribute__((vector_size(64)));
_Static_assert(NEIGHBOUR_LANES == 8, "a cluster is a vector");

/** For each set of 4 couples (a bit each): which are in it, in order, and how many. */
static const struct {
    uint16_t which[4];
    int count;
} couples[16] = {
    {{0}, 0},    {{0}, 1},       {{1}, 1},       {{0, 1}, 2},       {{2}, 1},    {{0, 2}, 2},
    {{1, 2}, 2}, {{0, 1, 2}, 3}, {{3}, 1},       {{0, 3}, 2},       {{1, 3}, 2}, {{0, 1, 3}, 3},
    {{2, 3}, 2}, {{0, 2, 3}, 3}, {{1, 2, 3}, 3}, {{0, 1, 2, 3}, 4},
};

/** Bit l: whether x[l] < limit. */
SWEEP_INLINE unsigned eight_below(eight x, float limit)
{
#if defined __AVX__
    return (unsigned)_mm256_movemask_ps(_mm256_cmp_ps((__m256)x, _mm256_set1_ps(limit), _CMP_LT_OQ));
#elif defined __SSE2__
    __m128 half[2];
    memcpy(half, &x, sizeof half);
    return (unsigned)_mm_movemask_ps(_mm_cmplt_ps(half[0], _mm_set1_ps(limit))) |
           (unsigned)_mm_movemask_ps(_mm_cmplt_ps(half[1], _mm_set1_ps(limit))) << 4;
#else
    unsigned bits = 0;
    for (int l = 0; l < 8; ++l)
        bits |= (unsigned)(x[l] < limit) << l;
    return bits;
#endif
}

/** How far along one direction particles are beyond a box of half width @p half around @p middle. */
SWEEP_INLINE eight beyond(const double *x, const struct neighbour_cluster *cluster, double middle, float half)
{
    typedef int32_t bits __attribute__((vector_size(32)));
    eight_wide wide;
    if (cluster->count == NEIGHBOUR_LANES)
        memcpy(&wide, x + cluster->first, sizeof wide);
    else
        for (int l = 0; l < NEIGHBOUR_LANES; ++l)
            wide[l] = x[cluster->first + (uint32_t)(l < cluster->count ? l : 0)];
    const eight distance = (eight)((bits) __builtin_convertvector(wide - middle, eight) & 0x7fffffff) - half;
    return (eight)((bits)distance & (distance > 0.0f));
}

size_t SWEEP_NAME(neighbour_filter)(const struct neighbour_query *query,
                                    const struct neighbour_cluster *clusters, size_t n, const double shift[3],
                                    uint32_t base, uint16_t *offsets)
{
    const double radius = 1.00001 * query->radius;
    const float limit = (float)(radius * radius);
    double middle[3];
    float half[3];
    size_t found = 0;
    for (int k = 0; k < query->dim; ++k) {
        middle[k] = 0.5 * (query->lower[k] + query->upper[k]) - shift[k];
        half[k] = (float)(0.5 * (query->upper[k] - query->lower[k]));
    }
    for (const struct neighbour_cluster *cluster = clusters; cluster < clusters + n; ++cluster) {
        eight far2 = {0};
        for (int k = 0; k < query->dim; ++k) {
            const eight far = beyond(query->x[k], cluster, middle[k], half[k]);
            far2 += far * far;
        }
        unsigned near = eight_below(far2, limit) & ((1u << cluster->count) - 1);
        /* either of a couple, then every second bit moved together */
        near = (near | near >> 1) & 0x55;
        near = (near | near >> 1) & 0x33;
        near = (near | near >> 2) & 0x0f;
        const uint16_t first = (uint16_t)(cluster->slot / 2 - base);
        for (int c = 0; c < 4; ++c)
            offsets[found + (size_t)c] = (uint16_t)(first + couples[near].which[c]);
        found += (size_t)couples[near].count;
    }
    return found;
}

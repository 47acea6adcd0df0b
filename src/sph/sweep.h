// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef SPH_SWEEP_H
#define SPH_SWEEP_H

/* The frame of every sweep over pairs, for files that are compiled once per instruction set and precision
 * (sweep_vector.h). What a sweep reads of a candidate is written once per sweep, in the order of the list's
 * slots and in the precision of the pair arithmetic; then each candidate of a cluster meets all its particles
 * at once. Pair functions have to be exactly zero beyond the support, so that no pair needs a branch. Sums
 * are gathered per particle in the order of the list: no particle is written by two threads, and the result
 * does not depend on their number.
 *
 * Small clusters test fewer candidates in vain. Where a vector has 16 lanes, a cluster of 8 particles fills
 * it twice: even lanes meet the first candidate of a couple, odd lanes the second. The numbers of a couple
 * therefore lie side by side, and one load that repeats two neighbouring numbers serves all lanes.
 *
 * With float, places are whole numbers of h/2^21 that wrap around at 2048 h: differences between neighbours
 * are exact and antisymmetric however large the domain is, and nothing has to be moved to the cluster first.
 * Distances stay in this unit; what is computed of them is scaled back with the sums. */

#include "sph/neighbour_list.h"
#include "sph/sweep_vector.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

enum {
    SWEEP_AT_ONCE = SWEEP_WIDTH == 16 ? 2 : 1,                                /**< candidates in a vector */
    SWEEP_PARTS = SWEEP_WIDTH == 16 ? 1 : NEIGHBOUR_LANES / (int)SWEEP_WIDTH, /**< vectors of a cluster */
};

/** Places are kept in units of h/SWEEP_UNITS. In float the fifth power of the support must not overflow. */
#if SWEEP_SINGLE
typedef uint32_t place;
#define SWEEP_UNITS 2097152.0
#else
typedef double place;
#define SWEEP_UNITS 1.0
#endif
typedef place vplace __attribute__((vector_size(SWEEP_BYTES)));

/** Added to squared distances, so that a particle meets itself without a division by zero: below the
 * rounding of any other pair's. */
#define SWEEP_LEAST ((real)((SWEEP_SINGLE ? 1e-8 : 1e-16) * SWEEP_UNITS * SWEEP_UNITS))

/** A coordinate (m) as a place. */
SWEEP_INLINE place sweep_place(double x, double units_per_metre)
{
#if SWEEP_SINGLE
    /* to the next whole number, modulo 2^32: what a double holds in its low bits when 1.5 2^52 is added */
    const double shifted = x * units_per_metre + 6755399441055744.0;
    uint64_t bits;
    __builtin_memcpy(&bits, &shifted, sizeof bits);
    return (place)(uint32_t)bits;
#else
    return x * units_per_metre;
#endif
}

/** What the sweeps over one list share. */
struct sweep {
    struct neighbour_list *list;
    double units;  /**< per metre */
    place *places; /**< of all slots */
};

/** Number @p k of slot @p slot when each has @p size numbers. */
SWEEP_INLINE size_t sweep_at(size_t slot, int k, int size)
{
    return (slot & ~(size_t)1) * (size_t)size + 2 * (size_t)k + (slot & 1);
}

/** The number of the candidates that are met at once, for all lanes. */
SWEEP_INLINE vreal sweep_spread(const real *from)
{
#ifdef __AVX512F__
    if (SWEEP_AT_ONCE == 2) {
        double two;
        __builtin_memcpy(&two, from, sizeof two);
        return (vreal)_mm512_set1_pd(two);
    }
#endif
    return *from + (vreal){0};
}

SWEEP_INLINE vplace sweep_spread_place(const place *from)
{
#ifdef __AVX512F__
    if (SWEEP_AT_ONCE == 2) {
        long long two;
        __builtin_memcpy(&two, from, sizeof two);
        return (vplace)_mm512_set1_epi64(two);
    }
#endif
    return *from + (vplace){0};
}

/** Where along x the idle slot of a couple is put, from its other one: so that neither it nor an image of it
 * comes near anybody who meets the couple. */
static inline place sweep_idle(const struct sweep *sweep)
{
    const double clear = 8.0 * sweep->list->radius * sweep->units, wrap = 4294967296.0;
    for (double away = clear;; away += clear) {
        bool good = true;
        for (int image = -1; image <= 1; ++image) {
            const double distance = away + image * sweep->list->length * sweep->units;
            good &= fabs(SWEEP_SINGLE ? remainder(distance, wrap) : distance) >= clear;
        }
        if (good)
            return sweep_place(away, 1.0);
    }
}

/** Write the places of all particles. */
SWEEP_INLINE void sweep_places(const struct sweep *sweep, const double *const x[3], int dim)
{
    const struct neighbour_list *list = sweep->list;
    const place idle = sweep_idle(sweep);
#pragma omp parallel for schedule(static)
    for (size_t c = 0; c < list->n_clusters; ++c) {
        const struct neighbour_cluster *cluster = &list->clusters[c];
        for (int k = 0; k < dim; ++k) {
            const double *from = x[k] + cluster->first;
            place *to = sweep->places + sweep_at(cluster->slot, k, dim);
            for (int l = 0; l < cluster->count; ++l)
                to[sweep_at((size_t)l, 0, dim)] = sweep_place(from[l], sweep->units);
            if (cluster->count & 1)
                to[sweep_at(cluster->count, 0, dim)] =
                    to[sweep_at(cluster->count - 1u, 0, dim)] + (k == 0 ? idle : 0);
        }
    }
}

/** Places of the lanes of a cluster; where it is not full, of any other particle (their sums are not read).
 */
SWEEP_INLINE void sweep_lane_places(vplace lanes[3][SWEEP_PARTS], const struct sweep *sweep,
                                    const struct neighbour_cluster *cluster, int dim)
{
    for (int k = 0; k < dim; ++k) {
        place all[SWEEP_PARTS * SWEEP_WIDTH];
        for (int l = 0; l < SWEEP_PARTS * (int)SWEEP_WIDTH; ++l) {
            const int own = l / SWEEP_AT_ONCE < cluster->count ? l / SWEEP_AT_ONCE : 0;
            all[l] = sweep->places[sweep_at(cluster->slot + (size_t)own, k, dim)];
        }
        __builtin_memcpy(lanes[k], all, sizeof all);
    }
}

/** Number @p k of the lanes of a cluster, from records of @p size numbers. */
SWEEP_INLINE void sweep_lanes(vreal lanes[SWEEP_PARTS], const real *records,
                              const struct neighbour_cluster *cluster, int k, int size)
{
    real all[SWEEP_PARTS * SWEEP_WIDTH];
    for (int l = 0; l < SWEEP_PARTS * (int)SWEEP_WIDTH; ++l) {
        const int own = l / SWEEP_AT_ONCE < cluster->count ? l / SWEEP_AT_ONCE : 0;
        all[l] = records[sweep_at(cluster->slot + (size_t)own, k, size)];
    }
    __builtin_memcpy(lanes, all, sizeof all);
}

/** The sums of a cluster's particles. */
SWEEP_INLINE void sweep_gather(double sums[NEIGHBOUR_LANES], const vreal lanes[SWEEP_PARTS])
{
    real all[SWEEP_PARTS * SWEEP_WIDTH];
    __builtin_memcpy(all, lanes, sizeof all);
    for (int l = 0; l < NEIGHBOUR_LANES; ++l) {
        sums[l] = (double)all[l * SWEEP_AT_ONCE];
        if (SWEEP_AT_ONCE == 2)
            sums[l] += (double)all[l * SWEEP_AT_ONCE + 1];
    }
}

/** From candidates to lanes: differences of places. */
SWEEP_INLINE vreal sweep_difference(vplace lanes, const place *candidates)
{
    const vplace difference = lanes - sweep_spread_place(candidates);
#if SWEEP_SINGLE
    typedef int32_t vsigned __attribute__((vector_size(SWEEP_BYTES)));
    return __builtin_convertvector((vsigned)difference, vreal);
#else
    return difference;
#endif
}

/** The candidates met at once, slot @p slot (and the next) with places from @p candidates on, meet lanes:
 * adds to @p sums, the caller's. Returns through @p q2 the squared distances. */
typedef void sweep_pair(void *sums, const vplace lanes[3], const place *candidates, size_t slot, vreal *q2);

/** A couple meets all lanes of a cluster; @p sums: SWEEP_PARTS objects of @p size bytes. Whether any pair is
 * closer than the root of @p limit2 (in both, the nearer and the further). */
SWEEP_INLINE void sweep_meet(const struct sweep *sweep, vplace lanes[SWEEP_PARTS][3], size_t couple, int dim,
                             sweep_pair *pair, void *sums, size_t size, const real limit2[2],
                             unsigned near[2])
{
    const place *candidates = sweep->places + 2 * couple * (size_t)dim;
    unsigned any[2] = {0};
    for (int part = 0; part < SWEEP_PARTS; ++part)
        for (int e = 0; e < 2; e += SWEEP_AT_ONCE) {
            vreal q2;
            pair((char *)sums + (size_t)part * size, lanes[part], candidates + e, 2 * couple + (size_t)e,
                 &q2);
            for (int k = 0; near && k < 2; ++k)
                any[k] |= below(q2, limit2[k]);
        }
    for (int k = 0; near && k < 2; ++k)
        near[k] = any[k] != 0;
}

SWEEP_INLINE void sweep_image(vplace lanes[SWEEP_PARTS][3], vplace own[3][SWEEP_PARTS], const double shift[3],
                              double units, int dim)
{
    for (int part = 0; part < SWEEP_PARTS; ++part)
        for (int k = 0; k < dim; ++k)
            lanes[part][k] = own[k][part] - sweep_place(shift[k], units);
}

/** All candidates of a cluster; @p sums: SWEEP_PARTS objects of @p size bytes. Notes which couples are within
 * @p support; from a @p fresh list it takes the couples out that will not come there before the next one. */
SWEEP_INLINE void sweep_cluster(const struct sweep *sweep, const struct neighbour_cluster *cluster, int dim,
                                double support, bool fresh, sweep_pair *pair, void *sums, size_t size)
{
    struct neighbour_chunk *chunk = &sweep->list->chunks[cluster->chunk];
    const double reach[2] = {support * sweep->units, 1.00001 * sweep->list->radius * sweep->units};
    const real limit2[2] = {(real)(reach[0] * reach[0]), (real)(reach[1] * reach[1])};
    vplace own[3][SWEEP_PARTS], lanes[SWEEP_PARTS][3];
    sweep_lane_places(own, sweep, cluster, dim);
    for (uint32_t s = 0; s < cluster->n_segments; ++s) {
        struct neighbour_segment *segment = &chunk->segments[cluster->segment + s];
        uint16_t *offsets = chunk->offsets + segment->offset;
        uint8_t *to = chunk->near + segment->offset / 8;
        unsigned bit = 1u << segment->offset % 8, bits = *to & (bit - 1);
        uint32_t kept = 0;
        sweep_image(lanes, own, sweep->list->shift[segment->image], sweep->units, dim);
        for (uint32_t c = 0; c < segment->count; ++c) {
            unsigned near[2];
            sweep_meet(sweep, lanes, (size_t)segment->base + offsets[c], dim, pair, sums, size, limit2, near);
            if (fresh) {
                offsets[kept] = offsets[c];
                if (!near[1])
                    continue;
                ++kept;
            }
            bits |= near[0] ? bit : 0;
            bit <<= 1;
            if (bit > 255) {
                *to++ = (uint8_t)bits;
                bits = 0;
                bit = 1;
            }
        }
        if (bit > 1) /* else this byte may be the next cluster's, and another thread's */
            *to = (uint8_t)bits;
        if (fresh)
            segment->count = (uint16_t)kept;
    }
}

/** The candidates of a cluster that the last sweep_cluster found within the support. */
SWEEP_INLINE void sweep_near(const struct sweep *sweep, const struct neighbour_cluster *cluster, int dim,
                             sweep_pair *pair, void *sums, size_t size)
{
    enum { PIECE = 56 }; /* couples whose bits an unaligned word has in any case */
    const struct neighbour_chunk *chunk = &sweep->list->chunks[cluster->chunk];
    vplace own[3][SWEEP_PARTS], lanes[SWEEP_PARTS][3];
    sweep_lane_places(own, sweep, cluster, dim);
    for (uint32_t s = 0; s < cluster->n_segments; ++s) {
        const struct neighbour_segment *segment = &chunk->segments[cluster->segment + s];
        sweep_image(lanes, own, sweep->list->shift[segment->image], sweep->units, dim);
        for (uint32_t done = 0; done < segment->count; done += PIECE) {
            const uint32_t count = segment->count - done < PIECE ? segment->count - done : PIECE;
            const size_t first = segment->offset + done;
            const uint16_t *offsets = chunk->offsets + first;
            uint64_t bits;
            __builtin_memcpy(&bits, chunk->near + first / 8, sizeof bits);
            bits = bits >> first % 8 & (((uint64_t)1 << count) - 1);
            for (; bits; bits &= bits - 1)
                sweep_meet(sweep, lanes, (size_t)segment->base + offsets[__builtin_ctzll(bits)], dim, pair,
                           sums, size, NULL, NULL);
        }
    }
}

#endif

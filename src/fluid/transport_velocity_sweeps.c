// SPDX-License-Identifier: GPL-3.0-or-later
/* Pair sums of the transport-velocity formulation: density summation (Fuchs et al. 2021, eq. 15) and momentum
 * (eq. 16, with the convective stress and the background pressure of Adami, Hu and Adams 2013), quintic
 * spline. Wall terms are a sweep of their own (transport_velocity.c).
 *
 * Compiled once per instruction set (SWEEP_ISA) and precision of the pair arithmetic (SWEEP_REAL). A cluster
 * of NEIGHBOUR_LANES particles shares one candidate list: candidates are packed relative to the cluster's
 * centre in units of h, then each is met by all lanes at once. Beyond the support every term is exactly zero,
 * so no candidate needs a branch. */
#include "fluid/transport_velocity.h"

#include "fluid/sweep_vector.h"

#define SWEEP_JOIN_(a, isa, precision) a##_##isa##_##precision
#define SWEEP_JOIN(a, isa, precision) SWEEP_JOIN_(a, isa, precision)

enum { PARTS = NEIGHBOUR_LANES / SWEEP_WIDTH, TILE = 256 };

/** Candidates of one tile: places relative to the cluster's centre, in units of h, and which particles they
 * are. */
struct packed {
    _Alignas(64) real x[3][TILE];
    uint32_t index[TILE];
};

/** What the force sweep reads of a candidate, in the precision of the pair arithmetic, together in memory. */
enum record {
    RECORD_U,
    RECORD_W = 3,
    RECORD_RHO = 6,
    RECORD_P,
    RECORD_V2,
    RECORD_SIZE = TRANSPORT_VELOCITY_RECORD
};

/** One vector's worth of a cluster's particles. */
struct lanes {
    vreal x[3], rho, p, v2;
};

SWEEP_INLINE void lanes_load(struct lanes lanes[PARTS], const struct neighbour_cluster *cluster,
                             const struct transport_velocity_arrays *arrays, int dim, int force)
{
    const double scale = 1.0 / arrays->h;
    const real *records = arrays->records;
    for (int all = 0; all < NEIGHBOUR_LANES; ++all) {
        /* lanes without a particle repeat the last one; their sums are not read */
        const size_t i = cluster->first + (uint32_t)(all < cluster->count ? all : cluster->count - 1);
        struct lanes *part = &lanes[all / SWEEP_WIDTH];
        const int l = all % SWEEP_WIDTH;
        for (int k = 0; k < dim; ++k)
            part->x[k][l] = (real)((arrays->x[k][i] - cluster->centre[k]) * scale);
        if (!force)
            continue;
        part->rho[l] = records[i * RECORD_SIZE + RECORD_RHO];
        part->p[l] = records[i * RECORD_SIZE + RECORD_P];
        part->v2[l] = records[i * RECORD_SIZE + RECORD_V2];
    }
}

SWEEP_INLINE int segment_pack(struct packed *packed, int n, const struct neighbour_segment *segment,
                              const uint16_t *offsets, int count, const double centre[3],
                              const struct transport_velocity_arrays *arrays, int dim)
{
    const double scale = 1.0 / arrays->h;
    for (int k = 0; k < dim; ++k) {
        const double *x = arrays->x[k] + segment->base;
        const double shift = segment->shift[k] - centre[k];
        for (int c = 0; c < count; ++c)
            packed->x[k][n + c] = (real)((x[offsets[c]] + shift) * scale);
    }
    for (int c = 0; c < count; ++c)
        packed->index[n + c] = segment->base + offsets[c];
    return n + count;
}

/** Quintic spline and its derivative by q, without the normalisation, from q in units of h: 32 and 16 times
 * the published polynomials, because twice_positive is twice the bracket. */
SWEEP_INLINE vreal quintic(vreal q)
{
    const vreal a = twice_positive((real)3 - q), b = twice_positive((real)2 - q),
                c = twice_positive((real)1 - q);
    const vreal a2 = a * a, b2 = b * b, c2 = c * c;
    return a2 * a2 * a - (real)6 * (b2 * b2 * b) + (real)15 * (c2 * c2 * c);
}

SWEEP_INLINE vreal quintic_derivative(vreal q)
{
    const vreal a = twice_positive((real)3 - q), b = twice_positive((real)2 - q),
                c = twice_positive((real)1 - q);
    const vreal a2 = a * a, b2 = b * b, c2 = c * c;
    return (real)30 * (b2 * b2) - (real)5 * (a2 * a2) - (real)75 * (c2 * c2);
}

/** Added to squared distances (in h^2), so that a particle meets itself without a division by zero; in double
 * it is far below rounding, in float below 1e-9 of the nearest neighbour's. */
#define SWEEP_LEAST ((real)(sizeof(real) == sizeof(float) ? 1e-12 : 1e-24))

SWEEP_INLINE void density_part(const struct lanes *lanes, const struct packed *packed, int n, int dim,
                               vreal *sum)
{
    vreal total = *sum;
    for (int c = 0; c < n; ++c) {
        vreal q2 = {0};
        for (int k = 0; k < dim; ++k) {
            const vreal d = lanes->x[k] - packed->x[k][c];
            q2 += d * d;
        }
        total += quintic(q2 * inverse_root(q2 + SWEEP_LEAST));
    }
    *sum = total;
}

SWEEP_INLINE void density_tile(const struct lanes lanes[PARTS], const struct packed *packed, int n, int dim,
                               vreal sums[PARTS])
{
    for (int part = 0; part < PARTS; ++part)
        density_part(&lanes[part], packed, n, dim, &sums[part]);
}

/** g: sum of (V_i^2 + V_j^2) W'/r (r_i - r_j); s: without the vector, for the velocity of i in the viscous
 * term; a: the rest. */
struct force_sums {
    vreal a[3], g[3], s;
};

SWEEP_INLINE void force_part(const struct lanes *lanes, const struct packed *packed, int n, int dim,
                             const real *records, real viscosity_over_h, struct force_sums *sums)
{
    vreal a[3] = {sums->a[0], sums->a[1], sums->a[2]}, g[3] = {sums->g[0], sums->g[1], sums->g[2]};
    vreal s = sums->s;
    for (int c = 0; c < n; ++c) {
        const real *record = records + (size_t)packed->index[c] * RECORD_SIZE;
        const real rho = record[RECORD_RHO], p = record[RECORD_P];
        vreal d[3], q2 = {0}, we = {0};
        for (int k = 0; k < dim; ++k) {
            d[k] = lanes->x[k] - packed->x[k][c];
            q2 += d[k] * d[k];
            we += record[RECORD_W + k] * d[k];
        }
        const vreal inverse = inverse_root(q2 + SWEEP_LEAST);
        const vreal fe = (lanes->v2 + record[RECORD_V2]) * quintic_derivative(q2 * inverse) * inverse;
        const vreal pressure = fe * (rho * lanes->p + lanes->rho * p) / (lanes->rho + rho);
        /* convective stress of j and velocity of j in the viscous term */
        const vreal momentum = fe * ((real)0.5 * rho * we - viscosity_over_h);
        s += fe;
        for (int k = 0; k < dim; ++k) {
            g[k] += fe * d[k];
            a[k] += momentum * record[RECORD_U + k] - pressure * d[k];
        }
    }
    sums->s = s;
    for (int k = 0; k < dim; ++k) {
        sums->a[k] = a[k];
        sums->g[k] = g[k];
    }
}

SWEEP_INLINE void force_tile(const struct lanes lanes[PARTS], const struct packed *packed, int n, int dim,
                             const real *records, real viscosity_over_h, struct force_sums sums[PARTS])
{
    for (int part = 0; part < PARTS; ++part)
        force_part(&lanes[part], packed, n, dim, records, viscosity_over_h, &sums[part]);
}

SWEEP_INLINE void cluster_density(const struct neighbour_list *list, const struct neighbour_cluster *cluster,
                                  const struct transport_velocity_arrays *arrays, int dim)
{
    const struct neighbour_chunk *chunk = &list->chunks[cluster->chunk];
    struct lanes lanes[PARTS];
    struct packed packed;
    vreal sums[PARTS] = {{0}};
    lanes_load(lanes, cluster, arrays, dim, 0);
    int n = 0;
    for (uint32_t s = 0; s < cluster->n_segments; ++s) {
        const struct neighbour_segment *segment = &chunk->segments[cluster->segment + s];
        for (uint32_t done = 0; done < segment->count;) {
            int count = (int)(segment->count - done) < TILE - n ? (int)(segment->count - done) : TILE - n;
            n = segment_pack(&packed, n, segment, chunk->offsets + segment->offset + done, count,
                             cluster->centre, arrays, dim);
            done += (uint32_t)count;
            if (n == TILE) {
                density_tile(lanes, &packed, n, dim, sums);
                n = 0;
            }
        }
    }
    density_tile(lanes, &packed, n, dim, sums);
    for (int l = 0; l < cluster->count; ++l)
        arrays->kernel_sum[cluster->first + (uint32_t)l] =
            arrays->constant / 32.0 * (double)sums[l / SWEEP_WIDTH][l % SWEEP_WIDTH];
}

SWEEP_INLINE void cluster_force(const struct neighbour_list *list, const struct neighbour_cluster *cluster,
                                const struct transport_velocity_arrays *arrays, int dim)
{
    const struct neighbour_chunk *chunk = &list->chunks[cluster->chunk];
    struct lanes lanes[PARTS];
    struct packed packed;
    struct force_sums sums[PARTS] = {{{{0}}, {{0}}, {0}}};
    const real viscosity = (real)(arrays->viscosity / arrays->h);
    lanes_load(lanes, cluster, arrays, dim, 1);
    int n = 0;
    for (uint32_t s = 0; s < cluster->n_segments; ++s) {
        const struct neighbour_segment *segment = &chunk->segments[cluster->segment + s];
        for (uint32_t done = 0; done < segment->count;) {
            int count = (int)(segment->count - done) < TILE - n ? (int)(segment->count - done) : TILE - n;
            n = segment_pack(&packed, n, segment, chunk->offsets + segment->offset + done, count,
                             cluster->centre, arrays, dim);
            done += (uint32_t)count;
            if (n == TILE) {
                force_tile(lanes, &packed, n, dim, arrays->records, viscosity, sums);
                n = 0;
            }
        }
    }
    force_tile(lanes, &packed, n, dim, arrays->records, viscosity, sums);
    for (int l = 0; l < cluster->count; ++l) {
        size_t i = cluster->first + (uint32_t)l;
        const struct force_sums *part = &sums[l / SWEEP_WIDTH];
        double scale = arrays->constant / (16.0 * arrays->h * arrays->m[i]), wg = 0.0;
        const double moving = viscosity * (double)part->s[l % SWEEP_WIDTH];
        for (int k = 0; k < dim; ++k)
            wg += arrays->w[k][i] * (double)part->g[k][l % SWEEP_WIDTH];
        /* the i-parts of the convective stress and of the viscous term factor out of the sums */
        for (int k = 0; k < dim; ++k) {
            arrays->a[k][i] =
                scale * ((double)part->a[k][l % SWEEP_WIDTH] + moving * (double)(real)arrays->u[k][i] +
                         0.5 * arrays->rho[i] * arrays->u[k][i] * wg);
            arrays->a_background[k][i] =
                -arrays->background_pressure * scale * (double)part->g[k][l % SWEEP_WIDTH];
        }
    }
}

typedef void cluster_sweep(const struct neighbour_list *list, const struct neighbour_cluster *cluster,
                           const struct transport_velocity_arrays *arrays);

/* One function per dimension, so that the dimension is a constant inside. */
#define CLUSTER_SWEEP(what, dimension)                                                                       \
    static __attribute__((noinline)) void cluster_##what##_##dimension(                                      \
        const struct neighbour_list *list, const struct neighbour_cluster *cluster,                          \
        const struct transport_velocity_arrays *arrays)                                                      \
    {                                                                                                        \
        cluster_##what(list, cluster, arrays, dimension);                                                    \
    }
CLUSTER_SWEEP(density, 1)
CLUSTER_SWEEP(density, 2)
CLUSTER_SWEEP(density, 3)
CLUSTER_SWEEP(force, 1)
CLUSTER_SWEEP(force, 2)
CLUSTER_SWEEP(force, 3)
#undef CLUSTER_SWEEP

static cluster_sweep *const density_sweeps[] = {cluster_density_1, cluster_density_2, cluster_density_3};
static cluster_sweep *const force_sweeps[] = {cluster_force_1, cluster_force_2, cluster_force_3};

static void sweep_clusters(const struct neighbour_list *list, const struct transport_velocity_arrays *arrays,
                           cluster_sweep *sweep)
{
#pragma omp parallel for schedule(dynamic, 64)
    for (size_t c = 0; c < list->n_clusters; ++c)
        sweep(list, &list->clusters[c], arrays);
}

static void sweep_density(const struct neighbour_list *list, const struct transport_velocity_arrays *arrays)
{
    sweep_clusters(list, arrays, density_sweeps[arrays->dim - 1]);
}

static void records_fill(const struct transport_velocity_arrays *arrays)
{
    real *records = arrays->records;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < arrays->n; ++i) {
        real *record = records + i * RECORD_SIZE;
        double volume = arrays->m[i] / arrays->rho[i];
        for (int k = 0; k < 3; ++k) {
            record[RECORD_U + k] = (real)arrays->u[k][i];
            record[RECORD_W + k] = (real)arrays->w[k][i];
        }
        record[RECORD_RHO] = (real)arrays->rho[i];
        record[RECORD_P] = (real)arrays->p[i];
        record[RECORD_V2] = (real)(volume * volume);
    }
}

static void sweep_force(const struct neighbour_list *list, const struct transport_velocity_arrays *arrays)
{
    records_fill(arrays);
    sweep_clusters(list, arrays, force_sweeps[arrays->dim - 1]);
}

const struct transport_velocity_sweeps SWEEP_JOIN(transport_velocity_sweeps, SWEEP_ISA,
                                                  SWEEP_PRECISION) = {sweep_density, sweep_force};

// SPDX-License-Identifier: GPL-3.0-or-later
/* Pair sums of the transport-velocity formulation: density summation (Fuchs et al. 2021, eq. 15) and momentum
 * (eq. 16, with the background pressure and, on request, the convective stress of Adami, Hu and Adams 2013),
 * quintic spline. Wall terms are a sweep of their own (transport_velocity.c). Compiled once per instruction
 * set and precision of the pair arithmetic (sph/sweep.h). */
#include "fluid/transport_velocity.h"

#include "sph/sweep.h"

/* The brackets of the quintic spline, of twice their size, carry the weights of their powers: with k^n = 6
 * and l^n = 15, the sums are a^n - (k b)^n + (l c)^n. */
#define FIFTH_ROOT_6 1.4309690811052556
#define FIFTH_ROOT_15 1.7187719275874789
#define FOURTH_ROOT_6 1.5650845800732873
#define FOURTH_ROOT_15 1.9679896712654303

/** W without the normalisation, times (2 SWEEP_UNITS)^5, added to @p sum. */
SWEEP_INLINE vreal quintic_add(vreal sum, vreal twice_q)
{
    const real k = (real)FIFTH_ROOT_6, l = (real)FIFTH_ROOT_15, unit = (real)SWEEP_UNITS;
    const vreal a = positive((real)6 * unit - twice_q), b = positive((real)4 * k * unit - k * twice_q),
                c = positive((real)2 * l * unit - l * twice_q);
    const vreal a2 = a * a, b2 = b * b, c2 = c * c;
    const vreal a4 = a2 * a2, b4 = b2 * b2, c4 = c2 * c2;
    sum += a4 * a;
    sum -= b4 * b;
    sum += c4 * c;
    return sum;
}

/** -1/5 of dW/dq without the normalisation, times (2 SWEEP_UNITS)^4. */
SWEEP_INLINE vreal quintic_slope(vreal twice_q)
{
    const real k = (real)FOURTH_ROOT_6, l = (real)FOURTH_ROOT_15, unit = (real)SWEEP_UNITS;
    const vreal a = positive((real)6 * unit - twice_q), b = positive((real)4 * k * unit - k * twice_q),
                c = positive((real)2 * l * unit - l * twice_q);
    const vreal a2 = a * a, b2 = b * b, c2 = c * c;
    vreal slope = a2 * a2;
    slope -= b2 * b2;
    slope += c2 * c2;
    return slope;
}

SWEEP_INLINE void density_pair(vreal *sum, const vplace lanes[3], const place *candidates, int dim,
                               vreal *distance2)
{
    vreal q2 = SWEEP_LEAST + (vreal){0}, twice_q, unused;
    for (int k = 0; k < dim; ++k) {
        const vreal d = sweep_difference(lanes[k], candidates + 2 * k);
        q2 += d * d;
    }
    *distance2 = q2;
    twice_root(q2, &twice_q, &unused);
    *sum = quintic_add(*sum, twice_q);
}

SWEEP_INLINE void density_cluster(const struct sweep *sweep, const struct neighbour_cluster *cluster,
                                  const struct transport_velocity_arrays *arrays, int dim, sweep_pair *pair)
{
    vreal lanes[SWEEP_PARTS];
    double sum[NEIGHBOUR_LANES];
    for (int part = 0; part < SWEEP_PARTS; ++part)
        lanes[part] = (vreal){0};
    if (sweep->list->fresh)
        sweep_cluster(sweep, cluster, dim, 3.0 * arrays->h, true, pair, lanes, sizeof *lanes);
    else
        sweep_cluster(sweep, cluster, dim, 3.0 * arrays->h, false, pair, lanes, sizeof *lanes);
    sweep_gather(sum, lanes);
    const double scale = arrays->constant / (32.0 * pow(SWEEP_UNITS, 5.0));
    for (int l = 0; l < cluster->count; ++l)
        arrays->kernel_sum[cluster->first + (uint32_t)l] = scale * sum[l];
}

/** What the force sweep reads of a candidate, in the precision of the pair arithmetic: velocity u, density,
 * half of the pressure, squared volume and, for the convective stress, half of the density times the shift w.
 */
SWEEP_INLINE int record_size(int dim, bool stress)
{
    return dim + 3 + (stress ? dim : 0);
}

SWEEP_INLINE int record_rho(int dim)
{
    return dim;
}

SWEEP_INLINE int record_p(int dim)
{
    return dim + 1;
}

SWEEP_INLINE int record_v2(int dim)
{
    return dim + 2;
}

SWEEP_INLINE int record_w(int dim)
{
    return dim + 3;
}

/** s: sum of (V_i^2 + V_j^2) slope/q over the candidates, g: the same times r_i - r_j, a: times the rest of
 * the momentum equation but what i's velocity factors out of. */
struct force_sums {
    vreal rho, p, v2;
    vreal a[3], g[3], s;
    const real *records;
    real viscosity;
};

SWEEP_INLINE void force_pair(struct force_sums *own, const vplace lanes[3], const place *candidates,
                             size_t slot, int dim, bool stress)
{
    const int size = record_size(dim, stress);
    const real *record = own->records + sweep_at(slot, 0, size);
    vreal d[3], q2 = SWEEP_LEAST + (vreal){0}, momentum = own->viscosity + (vreal){0}, twice_q, twice_inverse;
    for (int k = 0; k < dim; ++k) {
        d[k] = sweep_difference(lanes[k], candidates + 2 * k);
        q2 += d[k] * d[k];
        if (stress)
            momentum -= sweep_spread(record + 2 * (record_w(dim) + k)) * d[k];
    }
    twice_root(q2, &twice_q, &twice_inverse);
    const vreal rho = sweep_spread(record + 2 * record_rho(dim)),
                p = sweep_spread(record + 2 * record_p(dim)), v2 = sweep_spread(record + 2 * record_v2(dim));
    const vreal fe = (own->v2 + v2) * (quintic_slope(twice_q) * twice_inverse);
    /* (rho_j p_i + rho_i p_j) / (rho_i + rho_j): the mean and a small correction */
    const vreal skew = (own->p - p) * (rho - own->rho);
    const vreal along = fe * (own->p + p + skew * inverse_estimate(own->rho + rho));
    momentum *= fe;
    own->s += fe;
    for (int k = 0; k < dim; ++k) {
        own->g[k] += fe * d[k];
        own->a[k] += along * d[k];
        own->a[k] += momentum * sweep_spread(record + 2 * k);
    }
}

SWEEP_INLINE void force_store(const struct force_sums sums[SWEEP_PARTS],
                              const struct neighbour_cluster *cluster,
                              const struct transport_velocity_arrays *arrays, int dim, bool stress)
{
    double a[3][NEIGHBOUR_LANES], g[3][NEIGHBOUR_LANES], s[NEIGHBOUR_LANES], wg[NEIGHBOUR_LANES] = {0};
    vreal lanes[SWEEP_PARTS];
    for (int part = 0; part < SWEEP_PARTS; ++part)
        lanes[part] = sums[part].s;
    sweep_gather(s, lanes);
    for (int k = 0; k < dim; ++k) {
        for (int part = 0; part < SWEEP_PARTS; ++part)
            lanes[part] = sums[part].a[k];
        sweep_gather(a[k], lanes);
        for (int part = 0; part < SWEEP_PARTS; ++part)
            lanes[part] = sums[part].g[k];
        sweep_gather(g[k], lanes);
    }
    const double scale = 5.0 / 32.0 * arrays->constant / (arrays->h * pow(SWEEP_UNITS, 4.0));
    const double viscosity = (double)sums->viscosity, background = arrays->background_pressure;
    const size_t first = cluster->first;
    const double *m = arrays->m + first, *rho = arrays->rho + first;
    for (int k = 0; k < dim && stress; ++k) {
        const double *w = arrays->w[k] + first;
        for (int l = 0; l < cluster->count; ++l)
            wg[l] += w[l] * g[k][l];
    }
    /* the i-parts of the convective stress and of the viscous term factor out of the sums */
    for (int k = 0; k < dim; ++k) {
        const double *u = arrays->u[k] + first;
        double *to = arrays->a[k] + first, *to_background = arrays->a_background[k] + first;
#pragma omp simd
        for (int l = 0; l < cluster->count; ++l) {
            const double over_m = scale / m[l];
            to[l] = over_m * (a[k][l] - viscosity * s[l] * (double)(real)u[l] - 0.5 * rho[l] * u[l] * wg[l]);
            to_background[l] = background * over_m * g[k][l];
        }
    }
}

SWEEP_INLINE void force_cluster(const struct sweep *sweep, const struct neighbour_cluster *cluster,
                                const struct transport_velocity_arrays *arrays, int dim, bool stress,
                                sweep_pair *pair)
{
    const int size = record_size(dim, stress);
    struct force_sums sums[SWEEP_PARTS];
    vreal rho[SWEEP_PARTS], p[SWEEP_PARTS], v2[SWEEP_PARTS];
    const vreal zero = {0};
    sweep_lanes(rho, arrays->records, cluster, record_rho(dim), size);
    sweep_lanes(p, arrays->records, cluster, record_p(dim), size);
    sweep_lanes(v2, arrays->records, cluster, record_v2(dim), size);
    for (int part = 0; part < SWEEP_PARTS; ++part)
        sums[part] = (struct force_sums){
            rho[part],          p[part], v2[part],        {zero, zero, zero},
            {zero, zero, zero}, zero,    arrays->records, (real)(arrays->viscosity * sweep->units)};
    sweep_near(sweep, cluster, dim, pair, sums, sizeof *sums);
    force_store(sums, cluster, arrays, dim, stress);
}

/* One function per dimension and kind, so that they are constants inside. */
#define DENSITY_SWEEP(dim)                                                                                   \
    SWEEP_INLINE void density_pair_##dim(void *sums, const vplace lanes[3], const place *candidates,         \
                                         size_t slot, vreal *q2)                                             \
    {                                                                                                        \
        (void)slot;                                                                                          \
        density_pair(sums, lanes, candidates, dim, q2);                                                      \
    }                                                                                                        \
    static void density_cluster_##dim(const struct sweep *sweep, const struct neighbour_cluster *cluster,    \
                                      const struct transport_velocity_arrays *arrays)                        \
    {                                                                                                        \
        density_cluster(sweep, cluster, arrays, dim, density_pair_##dim);                                    \
    }
DENSITY_SWEEP(1)
DENSITY_SWEEP(2)
DENSITY_SWEEP(3)
#undef DENSITY_SWEEP

#define FORCE_SWEEP(dim, kind, stress)                                                                       \
    SWEEP_INLINE void force_pair_##kind##_##dim(void *sums, const vplace lanes[3], const place *candidates,  \
                                                size_t slot, vreal *q2)                                      \
    {                                                                                                        \
        *q2 = (vreal){0};                                                                                    \
        force_pair(sums, lanes, candidates, slot, dim, stress);                                              \
    }                                                                                                        \
    static void force_cluster_##kind##_##dim(const struct sweep *sweep,                                      \
                                             const struct neighbour_cluster *cluster,                        \
                                             const struct transport_velocity_arrays *arrays)                 \
    {                                                                                                        \
        force_cluster(sweep, cluster, arrays, dim, stress, force_pair_##kind##_##dim);                       \
    }
FORCE_SWEEP(1, plain, false)
FORCE_SWEEP(2, plain, false)
FORCE_SWEEP(3, plain, false)
FORCE_SWEEP(1, stress, true)
FORCE_SWEEP(2, stress, true)
FORCE_SWEEP(3, stress, true)
#undef FORCE_SWEEP

typedef void cluster_sweep(const struct sweep *sweep, const struct neighbour_cluster *cluster,
                           const struct transport_velocity_arrays *arrays);

static cluster_sweep *const density_sweeps[] = {density_cluster_1, density_cluster_2, density_cluster_3};
static cluster_sweep *const force_sweeps[2][3] = {
    {force_cluster_plain_1, force_cluster_plain_2, force_cluster_plain_3},
    {force_cluster_stress_1, force_cluster_stress_2, force_cluster_stress_3}};

static void sweep_clusters(struct neighbour_list *list, const struct transport_velocity_arrays *arrays,
                           cluster_sweep *cluster_sweep)
{
    const struct sweep sweep = {list, SWEEP_UNITS / arrays->h, arrays->places};
#pragma omp parallel for schedule(dynamic, 64)
    for (size_t c = 0; c < list->n_clusters; ++c)
        cluster_sweep(&sweep, &list->clusters[c], arrays);
}

static void sweep_density(struct neighbour_list *list, const struct transport_velocity_arrays *arrays)
{
    const struct sweep sweep = {list, SWEEP_UNITS / arrays->h, arrays->places};
    if (arrays->dim == 1)
        sweep_places(&sweep, arrays->x, 1);
    else if (arrays->dim == 2)
        sweep_places(&sweep, arrays->x, 2);
    else
        sweep_places(&sweep, arrays->x, 3);
    sweep_clusters(list, arrays, density_sweeps[arrays->dim - 1]);
    list->fresh = false;
}

SWEEP_INLINE void records_fill(const struct neighbour_list *list,
                               const struct transport_velocity_arrays *arrays, int dim, bool stress)
{
    const int size = record_size(dim, stress);
    real *records = arrays->records;
#pragma omp parallel for schedule(static)
    for (size_t c = 0; c < list->n_clusters; ++c) {
        const struct neighbour_cluster *cluster = &list->clusters[c];
        /* an idle slot repeats the last particle: its values have to be numbers */
        for (int l = 0; l < ((cluster->count + 1) & ~1); ++l) {
            const size_t i = cluster->first + (size_t)(l < cluster->count ? l : l - 1);
            real *record = records + sweep_at(cluster->slot + (size_t)l, 0, size);
            const double rho = arrays->rho[i], volume = arrays->m[i] / rho;
            for (int k = 0; k < dim; ++k) {
                record[2 * k] = (real)arrays->u[k][i];
                if (stress)
                    record[2 * (record_w(dim) + k)] = (real)(0.5 * rho * arrays->w[k][i]);
            }
            record[2 * record_rho(dim)] = (real)rho;
            record[2 * record_p(dim)] = (real)(0.5 * arrays->p[i]);
            record[2 * record_v2(dim)] = (real)(volume * volume);
        }
    }
}

static void sweep_force(struct neighbour_list *list, const struct transport_velocity_arrays *arrays)
{
    const bool stress = arrays->convective_stress;
    if (arrays->dim == 1)
        records_fill(list, arrays, 1, stress);
    else if (arrays->dim == 2)
        records_fill(list, arrays, 2, stress);
    else
        records_fill(list, arrays, 3, stress);
    sweep_clusters(list, arrays, force_sweeps[stress][arrays->dim - 1]);
}

const struct transport_velocity_sweeps SWEEP_NAME(transport_velocity_sweeps) = {sweep_density, sweep_force};

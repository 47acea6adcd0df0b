// SPDX-License-Identifier: GPL-3.0-or-later
/* One evaluation of a weakly compressible free-surface formulation on the frame of sph/sweep.h. */
#include "pass.h"

#include "sph/sweep.h"

struct pass_sums {
    vreal u[3], rho, p;
    vreal drho, a[3];
    const real *records;
    real continuity, diffusion, viscosity; /**< factors of the pair terms */
};

enum { RECORD_RHO, RECORD_P, RECORD_V, RECORD_U };

SWEEP_INLINE void pass_pair(struct pass_sums *own, const vplace lanes[3], const place *candidates,
                            size_t slot, vreal *distance2, int dim)
{
    const real *record = own->records + sweep_at(slot, 0, dim + RECORD_U);
    const real unit = (real)SWEEP_UNITS;
    vreal d[3], u[3], q2 = SWEEP_LEAST + (vreal){0}, along = {0}, twice_q, unused;
    for (int k = 0; k < dim; ++k) {
        d[k] = sweep_difference(lanes[k], candidates + 2 * k);
        u[k] = own->u[k] - sweep_spread(record + 2 * (RECORD_U + k));
        q2 += d[k] * d[k];
        along += u[k] * d[k];
    }
    *distance2 = q2;
    twice_root(q2, &twice_q, &unused);
    const vreal b = positive((real)4 * unit - twice_q);
    const vreal slope = b * b * b; /* -W'/(5 r) without the normalisation */
    const vreal rho = sweep_spread(record + 2 * RECORD_RHO), p = sweep_spread(record + 2 * RECORD_P),
                v = sweep_spread(record + 2 * RECORD_V);
    own->drho += slope * (own->diffusion * (rho - own->rho) * v - own->continuity * along);
    const vreal pressure = slope * (own->p + p) * v;
    const vreal friction = slope * own->viscosity * own->rho * q2 *
                           inverse_estimate((own->rho + rho) * (q2 + (real)0.01 * unit * unit));
    for (int k = 0; k < dim; ++k) {
        own->a[k] += pressure * d[k];
        own->a[k] -= friction * u[k];
    }
}

SWEEP_INLINE void pass_cluster(const struct sweep *sweep, const struct neighbour_cluster *cluster,
                               const struct pass_arrays *arrays, int dim, sweep_pair *pair)
{
    const int size = dim + RECORD_U;
    const real *records = arrays->records;
    struct pass_sums sums[SWEEP_PARTS];
    vreal lanes[RECORD_U + 3][SWEEP_PARTS];
    for (int k = 0; k < size; ++k)
        sweep_lanes(lanes[k], records, cluster, k, size);
    for (int part = 0; part < SWEEP_PARTS; ++part) {
        struct pass_sums *own = &sums[part];
        own->rho = lanes[RECORD_RHO][part];
        own->p = lanes[RECORD_P][part];
        own->drho = (vreal){0};
        for (int k = 0; k < dim; ++k) {
            own->u[k] = lanes[RECORD_U + k][part];
            own->a[k] = (vreal){0};
        }
        own->records = records;
        own->continuity = (real)(arrays->mass / sweep->units);
        own->diffusion = (real)arrays->diffusion;
        own->viscosity = (real)(4.0 * arrays->viscosity * arrays->mass * sweep->units);
    }
    if (sweep->list->fresh)
        sweep_cluster(sweep, cluster, dim, 2.0 * arrays->h, true, pair, sums, sizeof *sums);
    else
        sweep_cluster(sweep, cluster, dim, 2.0 * arrays->h, false, pair, sums, sizeof *sums);
    const double scale =
        5.0 * arrays->kernel_constant / (arrays->h * arrays->h) / pow(4.0 * SWEEP_UNITS, 3.0);
    double gathered[NEIGHBOUR_LANES];
    for (int k = -1; k < dim; ++k) {
        vreal all[SWEEP_PARTS];
        for (int part = 0; part < SWEEP_PARTS; ++part)
            all[part] = k < 0 ? sums[part].drho : sums[part].a[k];
        sweep_gather(gathered, all);
        double *to = (k < 0 ? arrays->drho : arrays->a[k]) + cluster->first;
        for (int l = 0; l < cluster->count; ++l)
            to[l] = scale * gathered[l] /
                    (k < 0 ? 1.0 : sweep->units * arrays->rho[cluster->first + (uint32_t)l]);
    }
}

SWEEP_INLINE void records_fill(const struct neighbour_list *list, const struct pass_arrays *arrays, int dim)
{
    const int size = dim + RECORD_U;
    real *records = arrays->records;
#pragma omp parallel for schedule(static)
    for (size_t c = 0; c < list->n_clusters; ++c) {
        const struct neighbour_cluster *cluster = &list->clusters[c];
        for (int l = 0; l < ((cluster->count + 1) & ~1); ++l) {
            const size_t i = cluster->first + (size_t)(l < cluster->count ? l : l - 1);
            real *record = records + sweep_at(cluster->slot + (size_t)l, 0, size);
            record[2 * RECORD_RHO] = (real)arrays->rho[i];
            record[2 * RECORD_P] = (real)arrays->p[i];
            record[2 * RECORD_V] = (real)(arrays->mass / arrays->rho[i]);
            for (int k = 0; k < dim; ++k)
                record[2 * (RECORD_U + k)] = (real)arrays->u[k][i];
        }
    }
}

#define PASS(dim)                                                                                            \
    SWEEP_INLINE void pass_pair_##dim(void *sums, const vplace lanes[3], const place *candidates,            \
                                      size_t slot, vreal *q2)                                                \
    {                                                                                                        \
        pass_pair(sums, lanes, candidates, slot, q2, dim);                                                   \
    }                                                                                                        \
    static void pass_##dim(const struct sweep *sweep, const struct pass_arrays *arrays)                      \
    {                                                                                                        \
        sweep_places(sweep, arrays->x, dim);                                                                 \
        records_fill(sweep->list, arrays, dim);                                                              \
        _Pragma("omp parallel for schedule(dynamic, 64)") for (size_t c = 0; c < sweep->list->n_clusters;    \
                                                               ++c)                                          \
            pass_cluster(sweep, &sweep->list->clusters[c], arrays, dim, pass_pair_##dim);                    \
    }
PASS(2)
PASS(3)
#undef PASS

void SWEEP_NAME(pass_sweep)(struct neighbour_list *list, const struct pass_arrays *arrays)
{
    const struct sweep sweep = {list, SWEEP_UNITS / arrays->h, arrays->places};
    (arrays->dim == 2 ? pass_2 : pass_3)(&sweep, arrays);
    list->fresh = false;
}

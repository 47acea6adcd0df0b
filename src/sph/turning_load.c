// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/turning_load.h"

#include "base/error.h"
#include "base/memory.h"
#include "model/surface_rims.h"

#include <math.h>
#include <string.h>

/** Facets of this many smoothing lengths are seen one by one. */
#define LONG_EDGE 3.0

static int corners_of(const struct surface *surface, size_t f)
{
    const int32_t *nodes = surface->nodes[f];
    return nodes[2] < 0 ? 2 : nodes[3] < 0 ? 3 : 4;
}

/** Averaging with weights 1/2 and 1/4 over edges of length l spreads by l^2/2; that of the kernel is h^2. */
static size_t passes_of(const struct surface *surface, double h)
{
    double sum = 0.0;
    size_t n = 0;
    for (size_t f = 0; f < surface->n_facets; ++f) {
        const int corners = corners_of(surface, f), edges = corners == 2 ? 1 : corners;
        for (int c = 0; c < edges; ++c) {
            const double *a = surface->X[surface->nodes[f][c]],
                         *b = surface->X[surface->nodes[f][(c + 1) % corners]];
            double length2 = 0.0;
            for (int k = 0; k < 3; ++k)
                length2 += (b[k] - a[k]) * (b[k] - a[k]);
            if (length2 > 0.0) {
                sum += 1.0 / length2;
                ++n;
            }
        }
    }
    const double per_length2 = n > 0 ? h * h * sum / (double)n : 0.0;
    return per_length2 * LONG_EDGE * LONG_EDGE <= 1.0 ? 0 : (size_t)ceil(2.0 * per_length2);
}

/** Find the rim, and count what each point averages over. */
static int neighbours_count(struct turning_load *load)
{
    const struct surface *surface = load->surface;
    const struct facets facets = {.dim = surface->dim,
                                  .n_points = surface->n_points,
                                  .n_facets = surface->n_facets,
                                  .points = surface->X,
                                  .nodes = surface->nodes};
    CHECK_MEMORY(load->n_means = memory_create(load->n_points, sizeof *load->n_means));
    CHECK_MEMORY(load->on_rim = memory_create(load->n_points, sizeof *load->on_rim));
    CALL(surface_rims_edges(&facets, &load->rim, &load->n_rim));
    for (size_t e = 0; e < load->n_rim; ++e)
        for (int c = 0; c < 2; ++c) {
            load->on_rim[load->rim[e][c]] = true;
            ++load->n_means[load->rim[e][c]];
        }
    for (size_t f = 0; f < surface->n_facets; ++f)
        for (int c = 0; c < corners_of(surface, f); ++c)
            if (!load->on_rim[surface->nodes[f][c]])
                ++load->n_means[surface->nodes[f][c]];
    return 0;
}

int turning_load_create(struct turning_load *load, const struct surface *surface, double h)
{
    *load = (struct turning_load){
        .surface = surface, .n_points = surface->n_points, .passes = passes_of(surface, h)};
    CHECK_MEMORY(load->v = memory_create(surface->n_points, sizeof *load->v));
    CHECK_MEMORY(load->sum = memory_create(surface->n_points, sizeof *load->sum));
    return neighbours_count(load);
}

void turning_load_reset(struct turning_load *load)
{
    memory_free(load->v);
    memory_free(load->sum);
    memory_free(load->rim);
    memory_free(load->on_rim);
    memory_free(load->n_means);
    *load = (struct turning_load){0};
}

/** Solve A x = b for a symmetric A (3 x 3); x = 0 if A is singular. */
static void solve_symmetric(const double A[3][3], const double b[3], double x[3])
{
    double cofactor[3][3], trace = A[0][0] + A[1][1] + A[2][2];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            cofactor[i][j] = A[(i + 1) % 3][(j + 1) % 3] * A[(i + 2) % 3][(j + 2) % 3] -
                             A[(i + 1) % 3][(j + 2) % 3] * A[(i + 2) % 3][(j + 1) % 3];
    const double determinant = A[0][0] * cofactor[0][0] + A[0][1] * cofactor[0][1] + A[0][2] * cofactor[0][2];
    for (int i = 0; i < 3; ++i)
        x[i] = fabs(determinant) > 1e-12 * trace * trace * trace
                   ? (cofactor[0][i] * b[0] + cofactor[1][i] * b[1] + cofactor[2][i] * b[2]) / determinant
                   : 0.0;
}

struct rigid_motion {
    double centre[3], velocity[3], omega[3];
};

/** Whether point @p i is one of the facets' that lie on the rim (@p rim), or of all that facets have. */
static bool belongs(const struct turning_load *load, size_t i, bool rim)
{
    return rim ? load->on_rim[i] : load->n_means[i] > 0;
}

/** Motion of the rigid body that is nearest to load->v by least squares over all points, or those of the rim.
 */
static struct rigid_motion rigid_fit(const struct turning_load *load, bool rim)
{
    const struct surface *surface = load->surface;
    const double(*x)[3] = (const double(*)[3])surface->now.x, (*v)[3] = (const double(*)[3])load->v;
    struct rigid_motion motion = {{0.0}};
    double n = 0.0, inertia[3][3] = {{0.0}}, moment[3] = {0.0, 0.0, 0.0};
    for (size_t i = 0; i < load->n_points; ++i)
        for (int k = 0; k < 3 && belongs(load, i, rim); ++k) {
            motion.centre[k] += x[i][k];
            motion.velocity[k] += v[i][k];
            n += k == 0;
        }
    for (int k = 0; k < 3 && n > 0.0; ++k) {
        motion.centre[k] /= n;
        motion.velocity[k] /= n;
    }
    for (size_t i = 0; i < load->n_points; ++i) {
        if (!belongs(load, i, rim))
            continue;
        const double r[3] = {x[i][0] - motion.centre[0], x[i][1] - motion.centre[1],
                             x[i][2] - motion.centre[2]};
        const double r2 = r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
        for (int k = 0; k < 3; ++k) {
            moment[k] += r[(k + 1) % 3] * v[i][(k + 2) % 3] - r[(k + 2) % 3] * v[i][(k + 1) % 3];
            for (int l = 0; l < 3; ++l)
                inertia[k][l] += (k == l ? r2 : 0.0) - r[k] * r[l];
        }
    }
    if (surface->dim == 3)
        solve_symmetric((const double(*)[3])inertia, moment, motion.omega);
    else if (inertia[2][2] > 0.0)
        motion.omega[2] = moment[2] / inertia[2][2];
    return motion;
}

/** Add @p times a rigid motion to load->v of all points, or of those on the rim. */
static void rigid_add(struct turning_load *load, const struct rigid_motion *motion, bool rim, double times)
{
    for (size_t i = 0; i < load->n_points; ++i) {
        if (!belongs(load, i, rim))
            continue;
        const double *x = load->surface->now.x[i], *c = motion->centre, *omega = motion->omega,
                     r[3] = {x[0] - c[0], x[1] - c[1], x[2] - c[2]};
        for (int k = 0; k < 3; ++k)
            load->v[i][k] += times * (motion->velocity[k] + omega[(k + 1) % 3] * r[(k + 2) % 3] -
                                      omega[(k + 2) % 3] * r[(k + 1) % 3]);
    }
}

/** Add the mean of load->v over some points to the sum of each. */
static void mean_add(struct turning_load *load, const int32_t *points, int n)
{
    double mean[3] = {0.0, 0.0, 0.0};
    for (int c = 0; c < n; ++c)
        for (int k = 0; k < 3; ++k)
            mean[k] += load->v[points[c]][k] / n;
    for (int c = 0; c < n; ++c)
        for (int k = 0; k < 3; ++k)
            load->sum[points[c]][k] += mean[k];
}

/** One average of load->v on the rim: over the edges at each point; or elsewhere: over the facets. */
static void average(struct turning_load *load, bool rim)
{
    const struct surface *surface = load->surface;
    memset(load->sum, 0, load->n_points * sizeof *load->sum);
    for (size_t e = 0; e < load->n_rim && rim; ++e)
        mean_add(load, load->rim[e], 2);
    for (size_t f = 0; f < surface->n_facets && !rim; ++f)
        mean_add(load, surface->nodes[f], corners_of(surface, f));
    for (size_t i = 0; i < load->n_points; ++i)
        for (int k = 0; k < 3 && load->n_means[i] > 0 && load->on_rim[i] == rim; ++k)
            load->v[i][k] = load->sum[i][k] / load->n_means[i];
}

/** load->v := what the fluid can follow of the surface's velocity: first on the rim, then between. */
static void velocity_average(struct turning_load *load)
{
    memcpy(load->v, load->surface->now.v, load->n_points * sizeof *load->v);
    for (int rim = load->n_rim > 0; rim >= 0 && load->passes > 0; --rim) {
        const struct rigid_motion motion = rigid_fit(load, rim);
        rigid_add(load, &motion, rim, -1.0);
        for (size_t p = 0; p < load->passes; ++p)
            average(load, rim);
        rigid_add(load, &motion, rim, 1.0);
    }
}

/** Integral of (grad v)^T n over facet @p f of a surface as it is now: that of dl x v along its edges
 * (Stokes), in which only values on the facet occur. In 2-D, per depth: e_z x (v_end - v_begin). */
static void facet_turning(const struct surface *surface, const double (*v)[3], size_t f, double integral[3])
{
    const int32_t *nodes = surface->nodes[f];
    const double(*x)[3] = (const double(*)[3])surface->now.x;
    integral[0] = integral[1] = integral[2] = 0.0;
    if (surface->dim == 2) {
        integral[0] = v[nodes[0]][1] - v[nodes[1]][1];
        integral[1] = v[nodes[1]][0] - v[nodes[0]][0];
        return;
    }
    const int corners = corners_of(surface, f);
    for (int c = 0; c < corners; ++c) {
        const int32_t from = nodes[c], to = nodes[(c + 1) % corners];
        double edge[3], mean[3];
        for (int k = 0; k < 3; ++k) {
            edge[k] = x[to][k] - x[from][k];
            mean[k] = 0.5 * (v[from][k] + v[to][k]);
        }
        integral[0] += edge[1] * mean[2] - edge[2] * mean[1];
        integral[1] += edge[2] * mean[0] - edge[0] * mean[2];
        integral[2] += edge[0] * mean[1] - edge[1] * mean[0];
    }
}

void turning_load_add(struct turning_load *load, double viscosity, double (*to)[3])
{
    const struct surface *surface = load->surface;
    velocity_average(load);
    for (size_t f = 0; f < surface->n_facets; ++f) {
        const int32_t *nodes = surface->nodes[f];
        const int corners = corners_of(surface, f);
        double integral[3];
        facet_turning(surface, (const double(*)[3])load->v, f, integral);
        for (int c = 0; c < corners; ++c)
            for (int k = 0; k < 3; ++k)
                to[nodes[c]][k] += viscosity * integral[k] / corners;
    }
}

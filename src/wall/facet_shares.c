// SPDX-License-Identifier: GPL-3.0-or-later
// Closed formulas: 2 pi share = 2 pi [foot point inside] - sum over edges of the integral of f over the
// in-plane angle, with f = a F(R) / (R F(a)) for S and V, f = G(R) / G(a) for G, R the distance from the
// particle to the point of the edge. The part alpha a/R + beta of f, which carries the singularity at small a
// and R, is integrated in closed form.
#include "wall/facet_shares.h"

#include "base/error.h"
#include "base/memory.h"
#include "wall/facet_shares_sweeps.h"

#include <string.h>

enum { PROFILE_STEPS = 512, LAYER_STEPS = 512, TABLE_STEPS = 96, GAUSS_HALF = 6, GRADED_PANELS = 16 };

#define PI 3.14159265358979323846
/** Least distance, and least distance of the foot point from an edge line, in lattice spacings. */
#define LEAST_DISTANCE 1e-9
/** Part of the range up to which shares are evaluated. */
#define LAST_PART 0.98

static const double gauss_x[GAUSS_HALF] = {0.12523340851146891, 0.36783149899818018, 0.58731795428661748,
                                           0.76990267419430469, 0.90411725637047491, 0.98156063424671924};
static const double gauss_w[GAUSS_HALF] = {0.24914704581340277, 0.23349253653835481, 0.20316742672306592,
                                           0.16007832854334622, 0.10693932599531843, 0.047175336386511828};

#define EDGES_DECLARE(isa) facet_shares_edges facet_shares_edges_##isa##_double;
EDGES_DECLARE(baseline)
EDGES_DECLARE(v3)
EDGES_DECLARE(v4)
#undef EDGES_DECLARE

facet_shares_edges *facet_shares_edges_of(enum isa isa)
{
    static facet_shares_edges *const all[ISAS] = ISA_TABLE(facet_shares_edges, double);
    return all[isa];
}

static double block_volume(const struct facet_shares *shares)
{
    double volume = 1.0;
    for (int k = 0; k < shares->kernel.dim; ++k)
        volume *= shares->dx;
    return volume;
}

/** The sums are analytic down to d > -dx/2, which the slopes of the table use. */
void facet_shares_block(const struct facet_shares *shares, double d, double sums[SHARES])
{
    const int q = shares->layers, dim = shares->kernel.dim;
    const double dx = shares->dx, volume = block_volume(shares);
    sums[SHARE_DENSITY] = sums[SHARE_PRESSURE] = sums[SHARE_VISCOUS] = 0.0;
    for (int m = 0; m < q; ++m) {
        double y = d + (m + 0.5) * dx;
        for (int s = 0; s < (dim > 1 ? q : 1); ++s)
            for (int t = 0; t < (dim > 2 ? q : 1); ++t) {
                double count = (s ? 2.0 : 1.0) * (t ? 2.0 : 1.0) * volume;
                double r = sqrt(y * y + (double)(s * s + t * t) * dx * dx);
                double slope = -count * kernel_dw(&shares->kernel, r) / r;
                sums[SHARE_DENSITY] += count * kernel_w(&shares->kernel, r);
                sums[SHARE_PRESSURE] += slope * y;
                sums[SHARE_VISCOUS] += slope;
            }
    }
}

void facet_shares_layer_exact(const struct facet_shares *shares, double y, double moments[LAYER_MOMENTS])
{
    const int q = shares->layers;
    const double dx2 = shares->dx * shares->dx;
    for (int k = 0; k < LAYER_MOMENTS; ++k)
        moments[k] = 0.0;
    for (int s = 0; s < q; ++s)
        for (int t = 0; t < q; ++t) {
            const double count = (s ? 2.0 : 1.0) * (t ? 2.0 : 1.0);
            const double r = sqrt(y * y + (double)(s * s + t * t) * dx2);
            const double slope = r > 0.0 ? count * kernel_dw(&shares->kernel, r) / r : 0.0;
            moments[LAYER_W] += count * kernel_w(&shares->kernel, r);
            moments[LAYER_NORMAL] += slope * y;
            moments[LAYER_VISCOUS] += slope;
            moments[LAYER_TANGENT] += slope * (double)(s * s) * dx2;
        }
}

/** Layers begin at half a spacing: nearer ones are not tabulated. */
static double layer_begin(const struct facet_shares *shares)
{
    return 0.5 * shares->dx;
}

/** Cubics through values and slopes at equal steps; functions[k] has those of function k at points -2 ..
 * steps + 2: slopes are of fourth order. */
static void cubics_fill(struct share_cubics *cubics, int steps, const double *const functions[4])
{
    for (int i = 0; i < steps; ++i)
        for (int k = 0; k < 4; ++k) {
            const double *f = functions[k] + i + 2;
            const double from = (f[-2] - 8.0 * f[-1] + 8.0 * f[1] - f[2]) / 12.0,
                         to = (f[-1] - 8.0 * f[0] + 8.0 * f[2] - f[3]) / 12.0;
            cubics[i].c[0][k] = f[0];
            cubics[i].c[1][k] = from;
            cubics[i].c[2][k] = 3.0 * (f[1] - f[0]) - 2.0 * from - to;
            cubics[i].c[3][k] = 2.0 * (f[0] - f[1]) + from + to;
        }
}

/** Cubics of the functions that @p at gives at a distance, over @p steps from @p begin on. */
static int cubics_create(struct share_cubics **cubics, const struct facet_shares *shares, int steps,
                         double begin, void (*at)(const struct facet_shares *shares, double d, double f[4]))
{
    const size_t n = (size_t)steps + 5;
    CHECK_MEMORY(*cubics = memory_create((size_t)steps, sizeof **cubics));
    double *values = memory_create(4 * n, sizeof *values);
    CHECK_MEMORY(values);
    for (size_t i = 0; i < n; ++i) {
        double f[4] = {0.0, 0.0, 0.0, 0.0};
        at(shares, begin + ((double)i - 2.0) * shares->range / steps, f);
        for (size_t k = 0; k < 4; ++k)
            values[k * n + i] = f[k];
    }
    cubics_fill(*cubics, steps, (const double *const[4]){values, values + n, values + 2 * n, values + 3 * n});
    memory_free(values);
    return 0;
}

void facet_shares_layer(const struct facet_shares *shares, double y, double moments[LAYER_MOMENTS])
{
    const double u = (y - layer_begin(shares)) * (LAYER_STEPS / shares->range);
    if (u >= LAYER_STEPS) {
        memset(moments, 0, LAYER_MOMENTS * sizeof *moments);
        return;
    }
    const int i = u > 0.0 ? (int)u : 0;
    const double x = u - i;
    const share_lanes *c = shares->layer[i].c;
    for (int k = 0; k < LAYER_MOMENTS; ++k)
        moments[k] = c[0][k] + x * (c[1][k] + x * (c[2][k] + x * c[3][k]));
}

/** S, G, V and, unless NULL, their slopes from the cubics. */
static void profile_at(const struct facet_shares *shares, double d, double f[SHARES], double slope[SHARES])
{
    const double per_step = PROFILE_STEPS / shares->range, u = d * per_step;
    const bool within = u < PROFILE_STEPS;
    const int i = within ? (int)u : 0;
    const double x = u - i;
    const share_lanes *c = shares->profile[i].c;
    for (int k = 0; k < SHARES; ++k) {
        f[k] = within ? c[0][k] + x * (c[1][k] + x * (c[2][k] + x * c[3][k])) : 0.0;
        if (slope)
            slope[k] = within ? per_step * (c[1][k] + x * (2.0 * c[2][k] + 3.0 * x * c[3][k])) : 0.0;
    }
}

/** @p exact: sum the block instead of using the table. */
static void plane_at(const struct facet_shares *shares, double a, bool exact, struct share_plane *plane)
{
    double slope[SHARES];
    plane->a = a;
    profile_at(shares, a, plane->f, slope);
    if (exact)
        facet_shares_block(shares, a, plane->f);
    slope[SHARE_DENSITY] = -plane->f[SHARE_PRESSURE];
    for (int k = 0; k < SHARES; ++k) {
        plane->beta[k] = k == SHARE_PRESSURE ? 1.0 : a * slope[k] / plane->f[k];
        plane->alpha[k] = 1.0 - plane->beta[k];
    }
}

/** Add the Gauss sum of |h| (f - alpha a/R - beta) / (h^2 + s^2) over s0 .. s1. */
static void add_panel(const struct facet_shares *shares, const struct share_plane *plane, bool exact,
                      double h, double s0, double s1, double integral[SHARES])
{
    const double centre = 0.5 * (s0 + s1), half = 0.5 * (s1 - s0), a = plane->a;
    double sum[SHARES] = {0.0, 0.0, 0.0}, f[SHARES];
    for (int g = -GAUSS_HALF; g < GAUSS_HALF; ++g) {
        double x = g < 0 ? -gauss_x[-1 - g] : gauss_x[g], w = g < 0 ? gauss_w[-1 - g] : gauss_w[g];
        double s = centre + half * x, t = h * h + s * s, R = sqrt(a * a + t);
        if (t == 0.0)
            continue;
        if (exact)
            facet_shares_block(shares, R, f);
        else
            profile_at(shares, R, f, NULL);
        double aR = a / R, weight = w / t;
        sum[SHARE_DENSITY] +=
            weight * (aR * (f[SHARE_DENSITY] / plane->f[SHARE_DENSITY] - plane->alpha[SHARE_DENSITY]) -
                      plane->beta[SHARE_DENSITY]);
        sum[SHARE_PRESSURE] += weight * (f[SHARE_PRESSURE] / plane->f[SHARE_PRESSURE] - 1.0);
        sum[SHARE_VISCOUS] +=
            weight * (aR * (f[SHARE_VISCOUS] / plane->f[SHARE_VISCOUS] - plane->alpha[SHARE_VISCOUS]) -
                      plane->beta[SHARE_VISCOUS]);
    }
    for (int k = 0; k < SHARES; ++k)
        integral[k] += h * half * sum[k];
}

/** Cut an edge to the range; false if nothing is left. */
static bool edge_cut(const struct facet_shares *shares, double a, double h, double *s0, double *s1)
{
    const double left = shares->range * shares->range - a * a - h * h;
    if (left <= 0.0)
        return false;
    *s0 = fmax(*s0, -sqrt(left));
    *s1 = fmin(*s1, sqrt(left));
    return *s1 > *s0;
}

/** Integral of f over the angle along one edge at distance @p h >= 0, from @p s0 to @p s1 (from the foot
 * point of the edge), by many panels that shrink towards the foot point. */
static void edge_integral(const struct facet_shares *shares, const struct share_plane *plane, bool exact,
                          double h, double s0, double s1, double integral[SHARES])
{
    const double a = plane->a;
    double low[SHARES] = {0.0, 0.0, 0.0};
    for (int k = 0; k < SHARES; ++k)
        integral[k] = 0.0;
    if (!edge_cut(shares, a, h, &s0, &s1))
        return;
    for (int p = 0; p < GRADED_PANELS; ++p) {
        double inner = p + 1 < GRADED_PANELS ? ldexp(1.0, -p - 1) : 0.0, outer = ldexp(1.0, -p);
        add_panel(shares, plane, exact, h, inner * s1, outer * s1, integral);
        add_panel(shares, plane, exact, h, inner * s0, outer * s0, low);
    }
    const double w1 = atan2(a * s1, h * sqrt(a * a + h * h + s1 * s1)),
                 w0 = atan2(a * s0, h * sqrt(a * a + h * h + s0 * s0)),
                 angle = atan2(h * (s1 - s0), h * h + s0 * s1);
    for (int k = 0; k < SHARES; ++k)
        integral[k] += plane->alpha[k] * (w1 - w0) + plane->beta[k] * angle - low[k];
}

/** C(a, s) for s > 0: odd in s, 1 beyond the range. */
static void cut(const struct facet_shares *shares, const struct share_plane *plane, bool exact, double s,
                double c[SHARES])
{
    double integral[SHARES];
    edge_integral(shares, plane, exact, s, 0.0, shares->range, integral);
    for (int k = 0; k < SHARES; ++k)
        c[k] = 1.0 - 2.0 / PI * integral[k];
}

/** Coefficient of the part atan(s/a) that the table leaves out; bounded up to the range, where alpha is not.
 */
static double singular_part(const struct facet_shares *shares, const struct share_plane *plane, int k)
{
    double x = plane->a / shares->range;
    return (1.0 - x * x) * (1.0 - x * x) * plane->alpha[k];
}

/** Rows: sqrt(a / last), columns: sqrt(s / sqrt(range^2 - a^2)): fine where C is steep. */
static void fill_table(struct facet_shares *shares)
{
    for (int i = 0; i <= TABLE_STEPS; ++i) {
        double x = (double)i / TABLE_STEPS;
        struct share_plane plane;
        plane_at(shares, fmax(x * x * shares->last, LEAST_DISTANCE * shares->dx), false, &plane);
        double width = sqrt(shares->range * shares->range - plane.a * plane.a);
        for (int j = 0; j <= TABLE_STEPS; ++j) {
            double y = (double)j / TABLE_STEPS, s = y * y * width, c[SHARES] = {0.0, 0.0, 0.0};
            if (j > 0)
                cut(shares, &plane, false, s, c);
            for (int k = 0; k < SHARES; ++k)
                shares->table[i * (TABLE_STEPS + 1) + j][k] =
                    c[k] - singular_part(shares, &plane, k) * 2.0 / PI * atan2(s, plane.a);
        }
    }
}

int facet_shares_create(struct facet_shares *shares, struct kernel kernel, double dx, enum isa isa)
{
    *shares = (struct facet_shares){.kernel = kernel, .dx = dx, .profile_steps = PROFILE_STEPS, .isa = isa};
    shares->layers = (int)ceil(kernel.support / dx - 1e-6);
    shares->range = kernel.support - 0.5 * dx;
    shares->last = LAST_PART * shares->range;
    CALL(cubics_create(&shares->profile, shares, PROFILE_STEPS, 0.0, facet_shares_block));
    if (kernel.dim == 3)
        CALL(cubics_create(&shares->layer, shares, LAYER_STEPS, layer_begin(shares),
                           facet_shares_layer_exact));
    if (kernel.dim == 2) {
        size_t n = (size_t)(TABLE_STEPS + 1) * (TABLE_STEPS + 1);
        shares->table = memory_create(n, sizeof *shares->table);
        CHECK_MEMORY(shares->table);
        fill_table(shares);
    }
    return 0;
}

void facet_shares_reset(struct facet_shares *shares)
{
    memory_free(shares->profile);
    memory_free(shares->table);
    memory_free(shares->layer);
    *shares = (struct facet_shares){0};
}

double facet_shares_viscous(const struct facet_shares *shares, double d)
{
    double f[SHARES];
    profile_at(shares, d, f, NULL);
    return f[SHARE_VISCOUS];
}

/** First node and weights of the cubic through four nodes around @p x in 0 .. TABLE_STEPS. */
static int cubic_weights(double x, double weight[4])
{
    int i = (int)x - 1;
    i = i < 0 ? 0 : i > TABLE_STEPS - 3 ? TABLE_STEPS - 3 : i;
    double t = x - i, t1 = t - 1.0, t2 = t - 2.0, t3 = t - 3.0;
    weight[0] = -t1 * t2 * t3 / 6.0;
    weight[1] = t * t2 * t3 / 2.0;
    weight[2] = -t * t1 * t3 / 2.0;
    weight[3] = t * t1 * t2 / 6.0;
    return i;
}

void facet_shares_segment(const struct facet_shares *shares, double d, double s0, double s1,
                          double share[SHARES])
{
    const double a = fmax(fabs(d), LEAST_DISTANCE * shares->dx), ends[2] = {s0, s1};
    for (int k = 0; k < SHARES; ++k)
        share[k] = 0.0;
    if (a >= shares->last)
        return;
    const double width = sqrt(shares->range * shares->range - a * a), half = d < 0.0 ? -0.5 : 0.5;
    struct share_plane plane;
    double wa[4], ws[4];
    plane_at(shares, a, false, &plane);
    int ia = cubic_weights(sqrt(a / shares->last) * TABLE_STEPS, wa);
    for (int e = 0; e < 2; ++e) {
        double s = fabs(ends[e]), sign = (e ? half : -half) * (ends[e] < 0.0 ? -1.0 : 1.0);
        if (s >= width) {
            for (int k = 0; k < SHARES; ++k)
                share[k] += sign;
            continue;
        }
        int is = cubic_weights(sqrt(s / width) * TABLE_STEPS, ws);
        double c[SHARES] = {0.0, 0.0, 0.0}, angle = 2.0 / PI * atan2(s, a);
        for (int i = 0; i < 4; ++i) {
            const double(*row)[3] = (const double(*)[3])shares->table + (ia + i) * (TABLE_STEPS + 1) + is;
            for (int j = 0; j < 4; ++j)
                for (int k = 0; k < SHARES; ++k)
                    c[k] += wa[i] * ws[j] * row[j][k];
        }
        for (int k = 0; k < SHARES; ++k)
            share[k] += sign * (c[k] + singular_part(shares, &plane, k) * angle);
    }
}

void facet_shares_segment_exact(const struct facet_shares *shares, double d, double s0, double s1,
                                double share[SHARES])
{
    const double a = fmax(fabs(d), LEAST_DISTANCE * shares->dx);
    const double sign0 = s0 < 0.0 ? -0.5 : 0.5, sign1 = s1 < 0.0 ? -0.5 : 0.5, sign = d < 0.0 ? -1.0 : 1.0;
    double c0[SHARES] = {0.0, 0.0, 0.0}, c1[SHARES] = {0.0, 0.0, 0.0};
    struct share_plane plane;
    plane_at(shares, a, true, &plane);
    if (s0 != 0.0)
        cut(shares, &plane, true, fabs(s0), c0);
    if (s1 != 0.0)
        cut(shares, &plane, true, fabs(s1), c1);
    for (int k = 0; k < SHARES; ++k)
        share[k] = a < shares->last ? sign * (sign1 * c1[k] - sign0 * c0[k]) : 0.0;
}

/** Edges of a polygon that lie off the foot point, cut to the range; returns the angle that the others leave:
 * 2 pi if the foot point is inside, and on an edge line the sum of the angles under the uncut edges, in which
 * that under its own cancels. */
static double polygon_edges(const struct facet_shares *shares, double a,
                            const struct projection_edges *polygon, struct share_edges *edges)
{
    double under[4][3];
    bool inside = true, on_line = false;
    int n_under = 0;
    edges->n = 0;
    for (int e = 0; e < polygon->n; ++e) {
        double s0 = polygon->s0[e], s1 = polygon->s1[e], h = polygon->h[e], side = h < 0.0 ? -1.0 : 1.0;
        if (s1 <= s0)
            continue;
        inside = inside && h > 0.0;
        h = fabs(h);
        if (h < LEAST_DISTANCE * shares->dx) {
            on_line = true;
            continue;
        }
        under[n_under][0] = side;
        under[n_under][1] = h * (s1 - s0);
        under[n_under++][2] = h * h + s0 * s1;
        if (edge_cut(shares, a, h, &s0, &s1)) {
            edges->h[edges->n] = h;
            edges->s0[edges->n] = s0;
            edges->s1[edges->n] = s1;
            edges->side[edges->n++] = side;
        }
    }
    double angle = inside && !on_line ? 2.0 * PI : 0.0;
    for (int e = 0; e < n_under && on_line; ++e)
        angle += under[e][0] * atan2(under[e][1], under[e][2]);
    return angle;
}

static void polygon(const struct facet_shares *shares, double d, const struct projection_edges *all,
                    bool exact, double share[SHARES])
{
    const double a = fmax(fabs(d), LEAST_DISTANCE * shares->dx), sign = d < 0.0 ? -1.0 : 1.0;
    for (int k = 0; k < SHARES; ++k)
        share[k] = 0.0;
    if (a >= shares->last)
        return;
    struct share_edges edges = {0};
    struct share_plane plane;
    double sum[SHARES] = {0.0, 0.0, 0.0};
    const double whole = polygon_edges(shares, a, all, &edges);
    if (edges.n > 0) {
        plane_at(shares, a, exact, &plane);
        if (!exact)
            facet_shares_edges_of(shares->isa)(shares, &plane, &edges, sum);
        for (int e = 0; e < edges.n && exact; ++e) {
            double integral[SHARES];
            edge_integral(shares, &plane, true, edges.h[e], edges.s0[e], edges.s1[e], integral);
            for (int k = 0; k < SHARES; ++k)
                sum[k] += edges.side[e] * integral[k];
        }
    }
    for (int k = 0; k < SHARES; ++k)
        share[k] = sign * (whole - sum[k]) / (2.0 * PI);
}

void facet_shares_polygon(const struct facet_shares *shares, double d, const struct projection_edges *edges,
                          double share[SHARES])
{
    polygon(shares, d, edges, false, share);
}

void facet_shares_polygon_exact(const struct facet_shares *shares, double d,
                                const struct projection_edges *edges, double share[SHARES])
{
    polygon(shares, d, edges, true, share);
}

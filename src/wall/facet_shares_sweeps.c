// SPDX-License-Identifier: GPL-3.0-or-later
/* Integrals along the edges of a facet (facet_shares.c), compiled once per instruction set: all Gauss points
 * of an edge, and all angles of a polygon, are lanes of loops without branches. */
#include "wall/facet_shares_sweeps.h"

#include "sph/sweep_vector.h"

enum { SHORT_POINTS = 8, LONG_POINTS = 16, MOST_EDGES = 4, ANGLES = 2 * MOST_EDGES };

#define PI 3.14159265358979323846

static const double short_x[SHORT_POINTS] = {-0.96028985649753629, -0.79666647741362684, -0.52553240991632899,
                                             -0.18343464249564981, 0.18343464249564981,  0.52553240991632899,
                                             0.79666647741362684,  0.96028985649753629};
static const double short_w[SHORT_POINTS] = {0.10122853629037618, 0.22238103445337445, 0.31370664587788738,
                                             0.36268378337836199, 0.36268378337836199, 0.31370664587788738,
                                             0.22238103445337445, 0.10122853629037618};
static const double long_x[LONG_POINTS] = {
    -0.98940093499164994, -0.9445750230732326,  -0.86563120238783176, -0.755404408355003,
    -0.61787624440264377, -0.45801677765722737, -0.28160355077925892, -0.095012509837637441,
    0.095012509837637441, 0.28160355077925892,  0.45801677765722737,  0.61787624440264377,
    0.755404408355003,    0.86563120238783176,  0.9445750230732326,   0.98940093499164994};
static const double long_w[LONG_POINTS] = {
    0.027152459411754058, 0.062253523938647776, 0.095158511682492897, 0.12462897125553395,
    0.14959598881657682,  0.16915651939500256,  0.18260341504492361,  0.18945061045506847,
    0.18945061045506847,  0.18260341504492361,  0.16915651939500256,  0.14959598881657682,
    0.12462897125553395,  0.095158511682492897, 0.062253523938647776, 0.027152459411754058};

/** Angles of the directions (x, y), as atan2 to rounding: the angle from the nearer axis or, where that is
 * smaller, from the diagonal has a tangent below tan(pi/8), where a rational approximation (coefficients of
 * Cephes, S. Moshier) holds. */
SWEEP_INLINE void angles(const double *y, const double *x, double *angle)
{
#pragma omp simd
    for (int k = 0; k < ANGLES; ++k) {
        const double ax = fabs(x[k]), ay = fabs(y[k]), high = ax > ay ? ax : ay, low = ax > ay ? ay : ax;
        const bool steeper = low > 0.41421356237309503 * high;
        const double over = steeper ? low - high : low, under = steeper ? low + high : high;
        const double r = over / (under > 0.0 ? under : 1.0), z = r * r;
        const double p = ((((-8.750608600031904122785e-1 * z - 1.615753718733365076637e1) * z -
                            7.500855792314704667340e1) *
                               z -
                           1.228866684490136173410e2) *
                              z -
                          6.485021904942025371773e1) *
                         z;
        const double d = ((((z + 2.485846490142306297962e1) * z + 1.650270098316988542046e2) * z +
                           4.328810604912902668951e2) *
                              z +
                          4.853903996359136964868e2) *
                             z +
                         1.945506571482613964425e2;
        const double within = r + r * p / d + (steeper ? 0.25 * PI : 0.0);
        const double steep = ay > ax ? 0.5 * PI - within : within, wide = x[k] < 0.0 ? PI - steep : steep;
        angle[k] = y[k] < 0.0 ? -wide : wide;
    }
}

/** What the lanes S, G, V of a plane are multiplied with. */
struct plane_lanes {
    share_lanes factor, alpha, beta, per_R, constant;
};

SWEEP_INLINE share_lanes lanes_of(const double f[SHARES])
{
    const share_lanes lanes = {f[SHARE_DENSITY], f[SHARE_PRESSURE], f[SHARE_VISCOUS], 0.0};
    return lanes;
}

/** Gauss sum of h (f - alpha a/R - beta) / (h^2 + s^2) over an edge: the points are lanes of what they have
 * of their own, then each takes its step of the table with S, G and V as lanes. */
SWEEP_INLINE share_lanes panel(const struct facet_shares *shares, double a, const struct plane_lanes *plane,
                               double h, double s0, double s1, const double *xi, const double *weights,
                               int points)
{
    const double centre = 0.5 * (s0 + s1), half = 0.5 * (s1 - s0);
    const double per_step = shares->profile_steps / shares->range;
    const int last = shares->profile_steps - 1;
    double part[LONG_POINTS], aR[LONG_POINTS], weight[LONG_POINTS];
    int step[LONG_POINTS];
    share_lanes sum = {0.0, 0.0, 0.0, 0.0};
#pragma omp simd
    for (int g = 0; g < points; ++g) {
        const double s = centre + half * xi[g], t = h * h + s * s, R = sqrt(a * a + t), u = R * per_step;
        const double shared = 1.0 / (R * t);
        const int whole = (int)u, i = whole < last ? whole : last;
        step[g] = i;
        part[g] = u - i < 1.0 ? u - i : 1.0; /* at the end of the range all are 0 */
        aR[g] = a * t * shared;
        weight[g] = weights[g] * R * shared;
    }
    for (int g = 0; g < points; ++g) {
        const share_lanes *c = shares->profile[step[g]].c;
        const double x = part[g];
        const share_lanes f = c[0] + x * (c[1] + x * (c[2] + x * c[3]));
        sum += weight[g] *
               ((aR[g] * plane->per_R + plane->constant) * (f * plane->factor - plane->alpha) - plane->beta);
    }
    return h * half * sum;
}

facet_shares_edges SWEEP_NAME(facet_shares_edges);

void SWEEP_NAME(facet_shares_edges)(const struct facet_shares *shares, const struct share_plane *plane,
                                    const struct share_edges *edges, double sum[SHARES])
{
    const double a = plane->a;
    double x[ANGLES], y[ANGLES], angle[ANGLES];
    const struct plane_lanes lanes = {.factor =
                                          1.0 / (lanes_of(plane->f) + (share_lanes){0.0, 0.0, 0.0, 1.0}),
                                      .alpha = lanes_of(plane->alpha),
                                      .beta = lanes_of(plane->beta),
                                      .per_R = {1.0, 0.0, 1.0, 0.0},
                                      .constant = {0.0, 1.0, 0.0, 0.0}};
    share_lanes total = {0.0, 0.0, 0.0, 0.0};
#pragma omp simd
    for (int e = 0; e < MOST_EDGES; ++e) { /* edges that are not there have h = s0 = s1 = 0 */
        const double h = edges->h[e], s0 = edges->s0[e], s1 = edges->s1[e], a2h2 = a * a + h * h;
        const double y0 = a * s0, y1 = a * s1, x0 = h * sqrt(a2h2 + s0 * s0), x1 = h * sqrt(a2h2 + s1 * s1);
        y[e] = y1 * x0 - x1 * y0; /* the difference of the two angles, each less than pi/2 */
        x[e] = x1 * x0 + y1 * y0;
        y[MOST_EDGES + e] = h * (s1 - s0);
        x[MOST_EDGES + e] = h * h + s0 * s1;
    }
    angles(y, x, angle);
    for (int e = 0; e < edges->n; ++e) {
        const double h = edges->h[e], s0 = edges->s0[e], s1 = edges->s1[e], half = 0.5 * (s1 - s0);
        /* the integrand is smooth up to R = 0, which lies this far from the edge: 8 points will do if that is
         * further than the edge is half long */
        const double beside = fmax(0.0, fabs(0.5 * (s0 + s1)) - half),
                     apart2 = a * a + h * h + beside * beside;
        const share_lanes integral = apart2 > half * half
                                         ? panel(shares, a, &lanes, h, s0, s1, short_x, short_w, SHORT_POINTS)
                                         : panel(shares, a, &lanes, h, s0, s1, long_x, long_w, LONG_POINTS);
        total += edges->side[e] * (integral + angle[e] * lanes.alpha + angle[MOST_EDGES + e] * lanes.beta);
    }
    for (int k = 0; k < SHARES; ++k)
        sum[k] = total[k];
}

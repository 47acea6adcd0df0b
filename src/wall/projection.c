// SPDX-License-Identifier: GPL-3.0-or-later
#include "wall/projection.h"

#include <math.h>
#include <string.h>

enum { NEWTON_STEPS = 20 };

/** After a correction below this the next one would be rounding: they square. */
#define NEWTON_LAST 1e-8

#define PI 3.14159265358979323846

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double c[3])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

/** Scale to length 1; returns the length before. */
static double normalise(double a[3])
{
    double length = sqrt(dot(a, a));
    if (length > 0.0)
        for (int k = 0; k < 3; ++k)
            a[k] /= length;
    return length;
}

static void difference(const double a[3], const double b[3], double c[3])
{
    for (int k = 0; k < 3; ++k)
        c[k] = a[k] - b[k];
}

/** A segment: the solid lies to the left of its direction, the normal points to the right. */
static void cut_segment(struct piece *piece, const double (*x)[3])
{
    double *t = piece->axis[0];
    difference(x[1], x[0], t);
    double length = normalise(t);
    piece->n = length > 0.0 ? 2 : 0;
    memcpy(piece->origin, x[0], sizeof piece->origin);
    piece->normal[0] = t[1];
    piece->normal[1] = -t[0];
    piece->corner[1][0] = length;
}

/** A plane polygon with unit @p normal through @p centre; corners are moved along the normal into the plane.
 */
static void cut_polygon(struct piece *piece, int n, const double (*x)[3], const double normal[3],
                        const double centre[3])
{
    double r[3], side[3];
    difference(x[1], x[0], side);
    difference(x[0], centre, r);
    memcpy(piece->normal, normal, sizeof piece->normal);
    double off = dot(r, normal), along = dot(side, normal);
    for (int k = 0; k < 3; ++k) {
        piece->origin[k] = x[0][k] - off * normal[k];
        piece->axis[0][k] = side[k] - along * normal[k];
    }
    piece->n = normalise(piece->axis[0]) > 0.0 ? n : 0;
    cross(normal, piece->axis[0], piece->axis[1]);
    for (int c = 0; c < n; ++c) {
        difference(x[c], piece->origin, r);
        piece->corner[c][0] = c ? dot(r, piece->axis[0]) : 0.0;
        piece->corner[c][1] = c > 1 ? dot(r, piece->axis[1]) : 0.0;
    }
    for (int c = 0; c < n; ++c) {
        const double *a = piece->corner[c], *b = piece->corner[c + 1 < n ? c + 1 : 0];
        const double t[2] = {b[0] - a[0], b[1] - a[1]}, length = sqrt(t[0] * t[0] + t[1] * t[1]);
        piece->length[c] = length;
        for (int k = 0; k < 2; ++k)
            piece->tangent[c][k] = length > 0.0 ? t[k] / length : 0.0;
    }
}

static void cut_triangle(struct piece *piece, const double (*x)[3])
{
    double a[3], b[3], normal[3];
    difference(x[1], x[0], a);
    difference(x[2], x[0], b);
    cross(a, b, normal);
    if (normalise(normal) > 0.0)
        cut_polygon(piece, 3, x, normal, x[0]);
}

int piece_cut(struct piece pieces[4], int32_t facet, int dim, int n, const double (*x)[3], double flat,
              int before)
{
    for (int k = 0; k < (n == 4 ? 4 : 1); ++k)
        pieces[k] = (struct piece){.facet = facet, .quarter = -1};
    if (dim < 3) {
        cut_segment(&pieces[0], x);
        return 1;
    }
    if (n == 3) {
        cut_triangle(&pieces[0], x);
        return 1;
    }
    double centre[3], a[3], b[3], normal[3], height[4], off = 0.0;
    for (int k = 0; k < 3; ++k)
        centre[k] = 0.25 * (x[0][k] + x[1][k] + x[2][k] + x[3][k]);
    difference(x[2], x[0], a);
    difference(x[3], x[1], b);
    cross(a, b, normal);
    if (normalise(normal) <= 0.0)
        return 1;
    for (int c = 0; c < 4; ++c) {
        difference(x[c], centre, a);
        height[c] = dot(a, normal);
        off = fmax(off, fabs(height[c]));
    }
    if (before ? before == 1 : off <= flat) {
        cut_polygon(&pieces[0], 4, x, normal, centre);
        return 1;
    }
    const double turned = off < 2.0 * flat ? fmax(0.0, off / flat - 1.0) : 1.0;
    for (int c = 0; c < 4; ++c) {
        const int next = (c + 1) % 4;
        double corners[3][3];
        for (int k = 0; k < 3; ++k) {
            corners[0][k] = x[c][k] - (1.0 - turned) * height[c] * normal[k];
            corners[1][k] = x[next][k] - (1.0 - turned) * height[next] * normal[k];
            corners[2][k] = centre[k];
        }
        cut_triangle(&pieces[c], (const double(*)[3])corners);
        pieces[c].quarter = c;
    }
    return 4;
}

static void find_segment(struct projection *p, const struct piece *piece, double snap)
{
    double length = piece->corner[1][0], s = p->foot[0];
    p->feature = PROJECTION_NODE;
    p->closest[1] = 0.0;
    if (s <= snap) {
        p->closest[0] = 0.0;
    } else if (s >= length - snap) {
        p->closest[0] = length;
    } else {
        p->closest[0] = s;
        p->feature = PROJECTION_INTERIOR;
    }
    p->distance = sqrt(p->d * p->d + (s - p->closest[0]) * (s - p->closest[0]));
}

static void find_polygon(struct projection *p, const struct piece *piece, double snap)
{
    struct projection_edges *edges = &p->edges;
    bool inside = true;
    double best = INFINITY;
    int best_edge = 0, best_corner = -1;
    edges->n = piece->n;
    for (int e = 0; e < piece->n; ++e) {
        const int f = e + 1 < piece->n ? e + 1 : 0;
        const double *a = piece->corner[e], *b = piece->corner[f], *t = piece->tangent[e],
                     length = piece->length[e];
        const double from_a[2] = {p->foot[0] - a[0], p->foot[1] - a[1]},
                     from_b[2] = {p->foot[0] - b[0], p->foot[1] - b[1]};
        const double s = from_a[0] * t[0] + from_a[1] * t[1];
        const bool second = s > 0.5 * length;
        const double *from = second ? from_b : from_a; /* the nearer end has the smaller rounding error */
        const double h = t[0] * from[1] - t[1] * from[0];
        edges->h[e] = h;
        edges->s0[e] = -s;
        edges->s1[e] = second ? -(from_b[0] * t[0] + from_b[1] * t[1]) : length - s;
        inside = inside && h >= 0.0;
        const int corner = s <= snap ? e : s >= length - snap ? f : -1;
        const double *to = corner == f ? from_b : from_a;
        const double r2 = corner >= 0 ? to[0] * to[0] + to[1] * to[1] : h * h;
        if (r2 < best || (r2 == best && corner >= 0)) {
            best = r2;
            best_edge = e;
            best_corner = corner;
        }
    }
    if (inside && best > snap * snap) {
        memcpy(p->closest, p->foot, sizeof p->closest);
        p->feature = PROJECTION_INTERIOR;
        p->distance = fabs(p->d);
        return;
    }
    p->feature = best_corner >= 0 ? PROJECTION_NODE : PROJECTION_EDGE;
    p->at = best_corner >= 0 ? best_corner : best_edge;
    for (int k = 0; k < 2; ++k)
        p->closest[k] = piece->corner[p->at][k] -
                        (best_corner >= 0 ? 0.0 : edges->s0[best_edge] * piece->tangent[best_edge][k]);
    p->distance = sqrt(p->d * p->d + best);
}

void projection_find(struct projection *projection, const struct piece *piece, const double x[3], double snap)
{
    double r[3];
    difference(x, piece->origin, r);
    projection->d = dot(r, piece->normal);
    projection->foot[0] = dot(r, piece->axis[0]);
    projection->foot[1] = piece->n > 2 ? dot(r, piece->axis[1]) : 0.0;
    if (piece->n > 2)
        find_polygon(projection, piece, snap);
    else
        find_segment(projection, piece, snap);
}

double projection_angle(const struct projection *projection, const struct piece *piece)
{
    if (piece->n < 3)
        return 1.0;
    if (projection->feature != PROJECTION_NODE)
        return projection->feature == PROJECTION_EDGE ? PI : 2.0 * PI;
    const int c = projection->at;
    const double *u = piece->tangent[c], *back = piece->tangent[c > 0 ? c - 1 : piece->n - 1];
    return fabs(atan2(u[1] * back[0] - u[0] * back[1], -u[0] * back[0] - u[1] * back[1]));
}

void piece_place(const struct piece *piece, const double local[2], double x[3])
{
    for (int k = 0; k < 3; ++k)
        x[k] = piece->origin[k] + local[0] * piece->axis[0][k] + local[1] * piece->axis[1][k];
}

/** Barycentric coordinates in a triangle. */
static void triangle_weights(const struct piece *piece, const double local[2], double weights[4])
{
    const double *b = piece->corner[1], *c = piece->corner[2];
    double area = b[0] * c[1] - b[1] * c[0];
    weights[1] = (local[0] * c[1] - local[1] * c[0]) / area;
    weights[2] = (b[0] * local[1] - b[1] * local[0]) / area;
    weights[0] = 1.0 - weights[1] - weights[2];
}

static void bilinear(double xi, double eta, double weights[4])
{
    weights[0] = 0.25 * (1.0 - xi) * (1.0 - eta);
    weights[1] = 0.25 * (1.0 + xi) * (1.0 - eta);
    weights[2] = 0.25 * (1.0 + xi) * (1.0 + eta);
    weights[3] = 0.25 * (1.0 - xi) * (1.0 + eta);
}

/** Natural coordinates of a point in a plane quad by Newton's method from the centre. */
static void quad_weights(const struct piece *piece, const double local[2], double weights[4])
{
    double xi = 0.0, eta = 0.0, centre[2], along_xi[2], along_eta[2], twist[2];
    for (int k = 0; k < 2; ++k) { /* place = centre + xi along_xi + eta along_eta + xi eta twist */
        const double c0 = piece->corner[0][k], c1 = piece->corner[1][k], c2 = piece->corner[2][k],
                     c3 = piece->corner[3][k];
        centre[k] = 0.25 * (c0 + c1 + c2 + c3);
        along_xi[k] = 0.25 * (c1 - c0 + c2 - c3);
        along_eta[k] = 0.25 * (c3 - c0 + c2 - c1);
        twist[k] = 0.25 * (c0 - c1 + c2 - c3);
    }
    for (int step = 0; step < NEWTON_STEPS; ++step) {
        double r[2], j[2][2];
        for (int k = 0; k < 2; ++k) {
            r[k] = local[k] - centre[k] - xi * along_xi[k] - eta * (along_eta[k] + xi * twist[k]);
            j[k][0] = along_xi[k] + eta * twist[k];
            j[k][1] = along_eta[k] + xi * twist[k];
        }
        const double det = j[0][0] * j[1][1] - j[0][1] * j[1][0];
        if (det == 0.0)
            break;
        const double a = (r[0] * j[1][1] - r[1] * j[0][1]) / det, b = (j[0][0] * r[1] - j[1][0] * r[0]) / det;
        xi = fmax(-1.0, fmin(1.0, xi + a));
        eta = fmax(-1.0, fmin(1.0, eta + b));
        if (fabs(a) + fabs(b) < NEWTON_LAST)
            break;
    }
    bilinear(xi, eta, weights);
}

void piece_weights(const struct piece *piece, int n, const double local[2], double weights[4])
{
    weights[0] = weights[1] = weights[2] = weights[3] = 0.0;
    if (n == 2) {
        weights[1] = local[0] / piece->corner[1][0];
        weights[0] = 1.0 - weights[1];
    } else if (n == 3) {
        triangle_weights(piece, local, weights);
    } else if (piece->quarter < 0) {
        quad_weights(piece, local, weights);
    } else {
        static const double xi[5] = {-1.0, 1.0, 1.0, -1.0, -1.0}, eta[5] = {-1.0, -1.0, 1.0, 1.0, -1.0};
        double part[4];
        const int q = piece->quarter;
        triangle_weights(piece, local, part);
        bilinear(part[0] * xi[q] + part[1] * xi[q + 1], part[0] * eta[q] + part[1] * eta[q + 1], weights);
    }
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/surface_rims.h"

#include "base/error.h"
#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/** An edge with its lower end first; direction: +1 walked upwards, -1 downwards. In 2-D both ends are one
 * point, direction: +1 left, -1 arrived at. */
struct edge {
    size_t surface;
    int32_t low, high;
    int direction;
};

/** An edge that its own surface leaves open, as it is walked; in 2-D direction tells it apart. */
struct rim {
    double from[3], to[3];
    int direction;
};

static int edge_compare(const void *left, const void *right)
{
    const struct edge *a = left, *b = right;
    if (a->surface != b->surface)
        return a->surface < b->surface ? -1 : 1;
    if (a->low != b->low)
        return a->low < b->low ? -1 : 1;
    return a->high < b->high ? -1 : a->high > b->high;
}

static size_t edges_list(const struct facets *facets, size_t surface, struct edge *edges)
{
    size_t count = 0;
    for (size_t f = 0; f < facets->n_facets; f++) {
        const int32_t *nodes = facets->nodes[f];
        int corners = 0;
        while (corners < 4 && nodes[corners] >= 0)
            corners++;
        for (int k = 0; k < corners; k++) {
            int32_t a = nodes[k], b = nodes[(k + 1) % corners];
            if (facets->dim == 2) // a segment leaves its first point and arrives at its second
                edges[count++] = (struct edge){surface, a, a, k == 0 ? 1 : -1};
            else
                edges[count++] = a < b ? (struct edge){surface, a, b, 1} : (struct edge){surface, b, a, -1};
        }
    }
    return count;
}

/** How often the edges beginning with @p edges (sorted) that are one are walked upwards less downwards; @p
 * next: the first that is another. */
static int edge_excess(const struct edge *edges, size_t count, size_t *next)
{
    int sum = 0;
    for (*next = 0; *next < count && edge_compare(edges, &edges[*next]) == 0; ++*next)
        sum += edges[*next].direction;
    return sum;
}

/** Edges of which the directions do not cancel, as often as is left, into @p rims; returns their number. */
static size_t rims_list(const struct facets *const *surfaces, const struct edge *edges, size_t count,
                        struct rim *rims)
{
    size_t n = 0;
    for (size_t i = 0, same; i < count; i += same) {
        const int sum = edge_excess(edges + i, count - i, &same);
        const double(*points)[3] = (const double(*)[3])surfaces[edges[i].surface]->points;
        const int32_t from = sum > 0 ? edges[i].low : edges[i].high,
                      to = sum > 0 ? edges[i].high : edges[i].low;
        for (int k = 0; k < abs(sum); k++) {
            memcpy(rims[n].from, points[from], sizeof rims[n].from);
            memcpy(rims[n].to, points[to], sizeof rims[n].to);
            rims[n++].direction = sum > 0 ? 1 : -1;
        }
    }
    return n;
}

int surface_rims_edges(const struct facets *facets, int32_t (**open)[2], size_t *n)
{
    *n = 0;
    struct edge *edges = memory_create(4 * facets->n_facets, sizeof *edges);
    *open = memory_create(4 * facets->n_facets, sizeof **open);
    if (!edges || !*open) {
        memory_free(edges);
        return STATUS_MEMORY;
    }
    const size_t count = edges_list(facets, 0, edges);
    if (count)
        qsort(edges, count, sizeof *edges, edge_compare);
    for (size_t i = 0, same; i < count; i += same) {
        const int sum = edge_excess(edges + i, count - i, &same);
        for (int k = 0; k < abs(sum); k++) {
            (*open)[*n][0] = sum > 0 ? edges[i].low : edges[i].high;
            (*open)[(*n)++][1] = sum > 0 ? edges[i].high : edges[i].low;
        }
    }
    memory_free(edges);
    return 0;
}

static bool rim_is_inside(const struct rim *rim, int dim, const double lower[3], const double upper[3])
{
    for (int d = 0; d < dim; d++) {
        const double x = 0.5 * (rim->from[d] + rim->to[d]);
        if (!(x > lower[d] && x < upper[d]))
            return false;
    }
    return true;
}

static double length_of(const double a[3], const double b[3])
{
    return sqrt((b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]) +
                (b[2] - a[2]) * (b[2] - a[2]));
}

/** Distance along @p rim of the foot of @p x, and the distance of @p x from the line. */
static double foot_on(const struct rim *rim, double length, const double x[3], double *distance)
{
    double along = 0.0, r2 = 0.0;
    for (int d = 0; d < 3; d++) {
        along += (x[d] - rim->from[d]) * (rim->to[d] - rim->from[d]) / length;
        r2 += (x[d] - rim->from[d]) * (x[d] - rim->from[d]);
    }
    *distance = sqrt(fmax(0.0, r2 - along * along));
    return along;
}

/** How much of @p rim @p other runs along in the opposite direction, and how far from it at most there. In
 * 2-D: 1 if one leaves where the other arrives. */
static double runs_along(const struct rim *rim, const struct rim *other, int dim, double length,
                         double *distance)
{
    if (dim == 2) {
        *distance = length_of(rim->from, other->from);
        return rim->direction != other->direction ? 1.0 : 0.0;
    }
    double off[2],
        end[2] = {foot_on(rim, length, other->to, &off[0]), foot_on(rim, length, other->from, &off[1])};
    const double part = fmin(end[1], length) - fmax(end[0], 0.0);
    *distance = INFINITY;
    if (!(part > 0.0) || !(end[1] > end[0]))
        return 0.0;
    *distance = 0.0;
    for (int k = 0; k < 2; k++) { // where the common part begins and ends
        const double at = fmin(fmax(end[k], 0.0), length), s = (at - end[0]) / (end[1] - end[0]);
        double x[3], here;
        for (int d = 0; d < 3; d++)
            x[d] = other->to[d] + s * (other->from[d] - other->to[d]);
        foot_on(rim, length, x, &here);
        *distance = fmax(*distance, here);
    }
    return part;
}

static void rim_examine(const struct rim *rims, size_t n, size_t which, int dim, double tolerance,
                        double reach, struct surface_rims *found)
{
    const struct rim *rim = &rims[which];
    const double length = dim == 2 ? 1.0 : length_of(rim->from, rim->to);
    double left = length, gap = INFINITY;
    for (size_t k = 0; k < n && length > 0.0; k++) {
        double distance = INFINITY;
        const double part = k == which ? 0.0 : runs_along(rim, &rims[k], dim, length, &distance);
        if (part > 0.0 && distance <= tolerance)
            left -= part;
        else if (part > fmin(tolerance, 0.5 * length) && distance < reach)
            gap = fmin(gap, distance);
    }
    if (left <= (dim == 2 ? 0.5 : tolerance))
        return;
    found->n_open++;
    if (gap < reach && (found->gap == 0.0 || gap < found->gap)) {
        found->gap = gap;
        for (int d = 0; d < 3; d++)
            found->place[d] = 0.5 * (rim->from[d] + rim->to[d]);
    }
}

/** What rounding may do to points of surfaces of this size. */
static double rounding_of(const struct facets *const *surfaces, size_t n)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t s = 0; s < n; s++)
        for (size_t i = 0; i < surfaces[s]->n_points; i++)
            for (int d = 0; d < 3; d++) {
                low[d] = fmin(low[d], surfaces[s]->points[i][d]);
                high[d] = fmax(high[d], surfaces[s]->points[i][d]);
            }
    return 1e-9 * length_of(low, high);
}

int surface_rims_find(const struct facets *const *surfaces, size_t n, double tolerance, double reach,
                      const double lower[3], const double upper[3], struct surface_rims *rims)
{
    size_t count = 0;
    *rims = (struct surface_rims){0};
    for (size_t s = 0; s < n; s++)
        count += 4 * surfaces[s]->n_facets;
    struct edge *edges = memory_create(count, sizeof *edges);
    struct rim *open = memory_create(count, sizeof *open);
    if (!edges || !open) {
        memory_free(edges);
        memory_free(open);
        return STATUS_MEMORY;
    }
    count = 0;
    for (size_t s = 0; s < n; s++)
        count += edges_list(surfaces[s], s, edges + count);
    if (count)
        qsort(edges, count, sizeof *edges, edge_compare);
    if (count)
        tolerance = fmax(tolerance, rounding_of(surfaces, n));
    const size_t n_open = rims_list(surfaces, edges, count, open);
    for (size_t k = 0; k < n_open; k++)
        if (rim_is_inside(&open[k], surfaces[0]->dim, lower, upper))
            rim_examine(open, n_open, k, surfaces[0]->dim, tolerance, reach, rims);
    memory_free(edges);
    memory_free(open);
    return 0;
}

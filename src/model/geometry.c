// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes by their signed distance, and lattices of points inside them.

#include "model/geometry.h"

#include "base/error.h"
#include "base/memory.h"
#include "model/mesh.h"

#include <math.h>
#include <stdint.h>

/** Part of a spacing by which a point must be further inside than asked, so that rounding cannot gain or lose
 * a row of points that lies exactly on the limit. */
#define FILL_TOLERANCE 1e-9
#define FILL_MOST 2e9

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void subtract(const double a[3], const double b[3], double result[3])
{
    for (int k = 0; k < 3; k++)
        result[k] = a[k] - b[k];
}

static void cross(const double a[3], const double b[3], double result[3])
{
    result[0] = a[1] * b[2] - a[2] * b[1];
    result[1] = a[2] * b[0] - a[0] * b[2];
    result[2] = a[0] * b[1] - a[1] * b[0];
}

/** Vector from the closest point of the segment ab to x. */
static void from_segment(const double a[3], const double b[3], const double x[3], double away[3])
{
    double along[3], offset[3];

    subtract(b, a, along);
    subtract(x, a, offset);
    double length2 = dot(along, along);
    double s = length2 > 0.0 ? dot(offset, along) / length2 : 0.0;
    s = fmin(1.0, fmax(0.0, s));
    for (int k = 0; k < 3; k++)
        away[k] = offset[k] - s * along[k];
}

/** Vector from the closest point of the triangle abc to x. */
static void from_triangle(const double a[3], const double b[3], const double c[3], const double x[3],
                          double away[3])
{
    double ab[3], ac[3], bc[3], normal[3], offset[3], offset_b[3], side[3];

    subtract(b, a, ab);
    subtract(c, a, ac);
    subtract(c, b, bc);
    subtract(x, a, offset);
    subtract(x, b, offset_b);
    cross(ab, ac, normal);
    double area2 = dot(normal, normal);
    cross(normal, ab, side);
    bool inside = area2 > 0.0 && dot(side, offset) >= 0.0;
    cross(normal, bc, side);
    inside = inside && dot(side, offset_b) >= 0.0;
    cross(ac, normal, side);
    inside = inside && dot(side, offset) >= 0.0;
    if (inside) {
        double height = dot(offset, normal) / area2;
        for (int k = 0; k < 3; k++)
            away[k] = height * normal[k];
        return;
    }
    const double *ends[3][2] = {{a, b}, {b, c}, {c, a}};
    double best = INFINITY;
    for (int e = 0; e < 3; e++) {
        double trial[3];
        from_segment(ends[e][0], ends[e][1], x, trial);
        double distance2 = dot(trial, trial);
        if (distance2 < best) {
            best = distance2;
            for (int k = 0; k < 3; k++)
                away[k] = trial[k];
        }
    }
}

/** Turns of the way a -> b about x, by crossings of the ray to the right of x: +1, 0 or -1. Half-open in y,
 * so that a ray through a corner counts once. */
static int crossing(const double a[3], const double b[3], const double x[3])
{
    bool a_below = a[1] <= x[1], b_below = b[1] <= x[1];

    if (a_below == b_below)
        return 0;
    double left = (b[0] - a[0]) * (x[1] - a[1]) - (x[0] - a[0]) * (b[1] - a[1]);
    if (a_below)
        return left > 0.0 ? 1 : 0;
    return left < 0.0 ? -1 : 0;
}

/** Solid angle under which x sees the triangle (van Oosterom and Strackee 1983), positive from behind. */
static double solid_angle(const double *const corner[3], const double x[3])
{
    double a[3], b[3], c[3], bc[3];

    subtract(corner[0], x, a);
    subtract(corner[1], x, b);
    subtract(corner[2], x, c);
    cross(b, c, bc);
    double la = sqrt(dot(a, a)), lb = sqrt(dot(b, b)), lc = sqrt(dot(c, c));
    double denominator = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    return 2.0 * atan2(dot(a, bc), denominator);
}

static int facet_size(const int32_t nodes[4])
{
    return nodes[2] < 0 ? 2 : nodes[3] < 0 ? 3 : 4;
}

/** Corners of triangle @p part of a facet; a quad is split along its diagonal 0-2. */
static void facet_triangle(const struct facets *facets, size_t facet, int part, const double *corner[3])
{
    const int32_t *nodes = facets->nodes[facet];

    corner[0] = facets->points[nodes[0]];
    corner[1] = facets->points[nodes[part + 1]];
    corner[2] = facets->points[nodes[part + 2]];
}

static uint64_t scramble(uint64_t z)
{
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

/** Whether the facets have no boundary: every node (2-D) or edge (3-D) is left as often as it is reached. A
 * sum of hashes vanishes exactly then (but for one chance in 2^64), without any memory. */
static bool facets_closed(const struct facets *facets)
{
    uint64_t sum = 0;

    for (size_t f = 0; f < facets->n_facets; f++) {
        const int32_t *nodes = facets->nodes[f];
        int size = facet_size(nodes);
        if (size == 2) {
            sum += scramble((uint64_t)nodes[1] + 1) - scramble((uint64_t)nodes[0] + 1);
            continue;
        }
        for (int e = 0; e < size; e++) {
            uint64_t from = (uint64_t)nodes[e] + 1, to = (uint64_t)nodes[(e + 1) % size] + 1;
            if (from < to)
                sum += scramble(from << 32 | to);
            else
                sum -= scramble(to << 32 | from);
        }
    }
    return facets->n_facets > 0 && sum == 0;
}

/** Area (2-D) or volume (3-D) enclosed by closed facets; negative when the solid is outside. */
static double facets_volume(const struct facets *facets)
{
    const double *base = facets->points[facets->nodes[0][0]];
    double volume = 0.0;

    for (size_t f = 0; f < facets->n_facets; f++) {
        const int32_t *nodes = facets->nodes[f];
        double a[3], b[3], c[3], bc[3];
        subtract(facets->points[nodes[0]], base, a);
        subtract(facets->points[nodes[1]], base, b);
        if (facets->dim == 2) {
            volume += (a[0] * b[1] - a[1] * b[0]) / 2.0;
            continue;
        }
        for (int part = 1; part + 1 < facet_size(nodes); part++) {
            subtract(facets->points[nodes[part]], base, b);
            subtract(facets->points[nodes[part + 1]], base, c);
            cross(b, c, bc);
            volume += dot(a, bc) / 6.0;
        }
    }
    return volume;
}

/** How often the facets wind around x; +1 in a solid whose surroundings are fluid. */
static int facets_winding(const struct facets *facets, const double x[3])
{
    int turns = 0;
    double angle = 0.0;

    for (size_t f = 0; f < facets->n_facets; f++) {
        const int32_t *nodes = facets->nodes[f];
        if (facets->dim == 2) {
            turns += crossing(facets->points[nodes[0]], facets->points[nodes[1]], x);
            continue;
        }
        for (int part = 0; part + 2 < facet_size(nodes); part++) {
            const double *corner[3];
            facet_triangle(facets, f, part, corner);
            angle += solid_angle(corner, x);
        }
    }
    return facets->dim == 2 ? turns : (int)lround(angle / (4.0 * M_PI));
}

/** The nearest facet so far. */
struct nearest {
    double distance2;
    double side; /**< cosine between the facet's normal and the way to x */
};

/** Facets that share the closest point are equally near: the one that is seen most squarely tells the side.
 */
static void nearest_offer(struct nearest *nearest, const double away[3], const double normal[3])
{
    double distance2 = dot(away, away);
    double scale = sqrt(distance2 * dot(normal, normal));
    double side = scale > 0.0 ? dot(away, normal) / scale : 0.0;
    double limit = 1e-12 * nearest->distance2;

    if (nearest->distance2 == INFINITY || distance2 < nearest->distance2 - limit ||
        (distance2 <= nearest->distance2 + limit && fabs(side) > fabs(nearest->side))) {
        nearest->distance2 = fmin(distance2, nearest->distance2);
        nearest->side = side;
    }
}

/** Whether all of a facet is further from x than what has been found: its bounding box is. */
static bool facet_beyond(const struct facets *facets, size_t facet, const double x[3], double distance2)
{
    const int32_t *nodes = facets->nodes[facet];
    double away2 = 0.0;

    for (int k = 0; k < facets->dim; k++) {
        double low = facets->points[nodes[0]][k], high = low;
        for (int i = 1; i < facet_size(nodes); i++) {
            double place = facets->points[nodes[i]][k];
            low = place < low ? place : low;
            high = place > high ? place : high;
        }
        double away = x[k] < low ? low - x[k] : x[k] > high ? x[k] - high : 0.0;
        away2 += away * away;
    }
    return away2 > distance2 * (1.0 + 1e-12);
}

static struct nearest facets_nearest(const struct facets *facets, const double x[3])
{
    struct nearest nearest = {INFINITY, 1.0};

    for (size_t f = 0; f < facets->n_facets; f++) {
        const int32_t *nodes = facets->nodes[f];
        double away[3];
        if (facet_beyond(facets, f, x, nearest.distance2))
            continue;
        if (facets->dim == 2) {
            const double *a = facets->points[nodes[0]], *b = facets->points[nodes[1]];
            const double normal[3] = {b[1] - a[1], a[0] - b[0], 0.0};
            from_segment(a, b, x, away);
            nearest_offer(&nearest, away, normal);
            continue;
        }
        for (int part = 0; part + 2 < facet_size(nodes); part++) {
            const double *corner[3];
            double ab[3], ac[3], normal[3];
            facet_triangle(facets, f, part, corner);
            subtract(corner[1], corner[0], ab);
            subtract(corner[2], corner[0], ac);
            cross(ab, ac, normal);
            from_triangle(corner[0], corner[1], corner[2], x, away);
            nearest_offer(&nearest, away, normal);
        }
    }
    return nearest;
}

double facets_distance(const struct facets *facets, const double x[3])
{
    struct nearest nearest = facets_nearest(facets, x);
    double distance = sqrt(nearest.distance2);

    // Straight above a facet its normal tells the side; at edges and corners of closed surfaces the winding
    // does.
    if (fabs(nearest.side) > 1.0 - 1e-12 || !facets_closed(facets))
        return nearest.side < 0.0 ? -distance : distance;
    int limit = facets_volume(facets) < 0.0 ? 0 : 1; // fluid or solid far away
    return facets_winding(facets, x) >= limit ? -distance : distance;
}

static double box_distance(const struct shape *shape, int dim, const double x[3])
{
    double outside2 = 0.0, inside = -INFINITY;

    for (int k = 0; k < dim; k++) {
        double q = fmax(shape->a[k] - x[k], x[k] - shape->b[k]);
        outside2 += q > 0.0 ? q * q : 0.0;
        inside = fmax(inside, q);
    }
    return outside2 > 0.0 ? sqrt(outside2) : inside;
}

static double centre_distance(const double centre[3], int dim, const double x[3])
{
    double r2 = 0.0;

    for (int k = 0; k < dim; k++)
        r2 += (x[k] - centre[k]) * (x[k] - centre[k]);
    return sqrt(r2);
}

static double cylinder_distance(const struct shape *shape, int dim, const double x[3])
{
    double axis[3], offset[3], radial, ends = -INFINITY;

    if (dim < 3) {
        radial = centre_distance(shape->a, dim, x);
    } else {
        subtract(shape->b, shape->a, axis);
        subtract(x, shape->a, offset);
        double length = sqrt(dot(axis, axis)), s = dot(offset, axis) / length;
        for (int k = 0; k < 3; k++)
            offset[k] -= s * axis[k] / length;
        radial = sqrt(dot(offset, offset));
        ends = fmax(-s, s - length);
    }
    double around = radial - shape->radius;
    if (shape->inner_radius > 0.0)
        around = fmax(around, shape->inner_radius - radial);
    return around > 0.0 && ends > 0.0 ? hypot(around, ends) : fmax(around, ends);
}

static double polygon_distance(const struct shape *shape, const double x[3])
{
    double best = INFINITY;
    int turns = 0;

    for (size_t i = 0; i < shape->n_points; i++) {
        const double *a = shape->points[i], *b = shape->points[(i + 1) % shape->n_points];
        double away[3];
        from_segment(a, b, x, away);
        best = fmin(best, dot(away, away));
        turns += crossing(a, b, x);
    }
    return turns ? -sqrt(best) : sqrt(best);
}

double shape_distance(const struct shape *shape, int dim, const double x[3])
{
    double offset[3], distance;

    switch (shape->kind) {
    case SHAPE_BOX:
        return box_distance(shape, dim, x);
    case SHAPE_BALL:
        return centre_distance(shape->a, dim, x) - shape->radius;
    case SHAPE_CYLINDER:
        return cylinder_distance(shape, dim, x);
    case SHAPE_POLYGON:
        return polygon_distance(shape, x);
    case SHAPE_HALF_SPACE:
        subtract(x, shape->a, offset);
        return dot(offset, shape->b) / sqrt(dot(shape->b, shape->b));
    case SHAPE_FACETS:
        return facets_distance(shape->facets, x);
    case SHAPE_UNION:
        distance = INFINITY;
        for (size_t i = 0; i < shape->n_children; i++)
            distance = fmin(distance, shape_distance(&shape->children[i], dim, x));
        return distance;
    case SHAPE_INTERSECTION:
        distance = -INFINITY;
        for (size_t i = 0; i < shape->n_children; i++)
            distance = fmax(distance, shape_distance(&shape->children[i], dim, x));
        return distance;
    case SHAPE_DIFFERENCE:
        distance = shape_distance(&shape->children[0], dim, x);
        for (size_t i = 1; i < shape->n_children; i++)
            distance = fmax(distance, -shape_distance(&shape->children[i], dim, x));
        return distance;
    }
    return INFINITY;
}

static void bounds_of_points(const double (*points)[3], size_t n, int dim, double lower[3], double upper[3])
{
    for (int k = 0; k < dim; k++) {
        lower[k] = INFINITY;
        upper[k] = -INFINITY;
    }
    for (size_t i = 0; i < n; i++)
        for (int k = 0; k < dim; k++) {
            lower[k] = fmin(lower[k], points[i][k]);
            upper[k] = fmax(upper[k], points[i][k]);
        }
}

static void bounds_infinite(int dim, double lower[3], double upper[3])
{
    for (int k = 0; k < dim; k++) {
        lower[k] = -INFINITY;
        upper[k] = INFINITY;
    }
}

static void bounds_of_facets(const struct facets *facets, int dim, double lower[3], double upper[3])
{
    if (facets_closed(facets) && facets_volume(facets) < 0.0) {
        bounds_infinite(dim, lower, upper);
        return;
    }
    bounds_of_points(NULL, 0, dim, lower, upper);
    for (size_t f = 0; f < facets->n_facets; f++)
        for (int i = 0; i < facet_size(facets->nodes[f]); i++)
            for (int k = 0; k < dim; k++) {
                double x = facets->points[facets->nodes[f][i]][k];
                lower[k] = fmin(lower[k], x);
                upper[k] = fmax(upper[k], x);
            }
}

static void bounds_of_cylinder(const struct shape *shape, int dim, double lower[3], double upper[3])
{
    double axis[3] = {0.0, 0.0, 1.0}, length = 1.0;

    if (dim == 3) {
        subtract(shape->b, shape->a, axis);
        length = sqrt(dot(axis, axis));
    }
    for (int k = 0; k < dim; k++) {
        double sine = dim == 3 ? sqrt(fmax(0.0, 1.0 - axis[k] * axis[k] / (length * length))) : 1.0;
        double other = dim == 3 ? shape->b[k] : shape->a[k];
        lower[k] = fmin(shape->a[k], other) - shape->radius * sine;
        upper[k] = fmax(shape->a[k], other) + shape->radius * sine;
    }
}

static void bounds_of_children(const struct shape *shape, int dim, double lower[3], double upper[3])
{
    size_t n = shape->kind == SHAPE_DIFFERENCE ? 1 : shape->n_children;
    bool all = shape->kind == SHAPE_INTERSECTION;

    for (size_t i = 0; i < n; i++) {
        double low[3], high[3];
        shape_bounds(&shape->children[i], dim, low, high);
        for (int k = 0; k < dim; k++) {
            lower[k] = i == 0 ? low[k] : all ? fmax(lower[k], low[k]) : fmin(lower[k], low[k]);
            upper[k] = i == 0 ? high[k] : all ? fmin(upper[k], high[k]) : fmax(upper[k], high[k]);
        }
    }
}

void shape_bounds(const struct shape *shape, int dim, double lower[3], double upper[3])
{
    for (int k = 0; k < 3; k++)
        lower[k] = upper[k] = 0.0;
    switch (shape->kind) {
    case SHAPE_BOX:
    case SHAPE_BALL:
        for (int k = 0; k < dim; k++) {
            bool box = shape->kind == SHAPE_BOX;
            lower[k] = box ? shape->a[k] : shape->a[k] - shape->radius;
            upper[k] = box ? shape->b[k] : shape->a[k] + shape->radius;
        }
        break;
    case SHAPE_CYLINDER:
        bounds_of_cylinder(shape, dim, lower, upper);
        break;
    case SHAPE_POLYGON:
        bounds_of_points((const double(*)[3])shape->points, shape->n_points, dim, lower, upper);
        break;
    case SHAPE_HALF_SPACE:
        bounds_infinite(dim, lower, upper);
        break;
    case SHAPE_FACETS:
        bounds_of_facets(shape->facets, dim, lower, upper);
        break;
    case SHAPE_UNION:
    case SHAPE_INTERSECTION:
    case SHAPE_DIFFERENCE:
        bounds_of_children(shape, dim, lower, upper);
        break;
    }
}

void shape_reset(struct shape *shape)
{
    for (size_t i = 0; i < shape->n_children; i++)
        shape_reset(&shape->children[i]);
    memory_free(shape->children);
    memory_free(shape->points);
    *shape = (struct shape){0};
}

/** Whether the sign of the distance can jump away from the surface (open facets). */
static bool shape_jumps(const struct shape *shape)
{
    if (shape->kind == SHAPE_FACETS)
        return !facets_closed(shape->facets);
    for (size_t i = 0; i < shape->n_children; i++)
        if (shape_jumps(&shape->children[i]))
            return true;
    return false;
}

/** First and one past the last lattice number of each direction that can hold points. */
struct lattice {
    long first[3], end[3];
    double spacing, origin[3];
};

static int lattice_init(struct lattice *lattice, const struct shape *shape, int dim, double spacing,
                        const double origin[3])
{
    double lower[3], upper[3], count = 1.0;

    CHECK(spacing > 0.0, STATUS_DECK, "particle spacing is %g, but it must be positive", spacing);
    *lattice = (struct lattice){.end = {1, 1, 1}, .spacing = spacing};
    shape_bounds(shape, dim, lower, upper);
    for (int k = 0; k < dim; k++) {
        CHECK(isfinite(lower[k]) && isfinite(upper[k]), STATUS_DECK,
              "the region has no end in direction %c; intersect it with a box", "xyz"[k]);
        lattice->origin[k] = origin[k];
        // A point more on each side than fits: the distance decides, not the rounding of this quotient.
        double first = floor((lower[k] - origin[k]) / spacing) - 1.0;
        double end = fmax(first, ceil((upper[k] - origin[k]) / spacing) + 1.0);
        count *= fmax(0.0, end - first - 2.0);
        CHECK(count <= FILL_MOST && fabs(first) < 1e15 && fabs(end) < 1e15, STATUS_DECK,
              "the region has room for %.3g particles of spacing %g, but at most %.0g are possible", count,
              spacing, FILL_MOST);
        lattice->first[k] = (long)first;
        lattice->end[k] = (long)end;
    }
    return 0;
}

static double lattice_place(const struct lattice *lattice, int k, long number)
{
    return lattice->origin[k] + ((double)number + 0.5) * lattice->spacing;
}

/** The growing list of points. */
struct filling {
    double (*points)[3];
    size_t n, capacity;
};

static int filling_add(struct filling *filling, const double x[3])
{
    if (filling->n == filling->capacity) {
        void *memory = filling->points;
        CALL(memory_grow(&memory, &filling->capacity, filling->n + 1, sizeof *filling->points));
        filling->points = memory;
    }
    for (int k = 0; k < 3; k++)
        filling->points[filling->n][k] = x[k];
    filling->n++;
    return 0;
}

/** Walk along one row. The distance changes by no more than the way walked, so that after a value g all
 * points nearer than |g| are on the same side: only points near the boundary are looked at. */
static int fill_row(const struct lattice *lattice, const struct shape *shape, int dim, double margin,
                    bool jumps, double x[3], struct filling *filling)
{
    double limit = margin + FILL_TOLERANCE * lattice->spacing;

    for (long i = lattice->first[0]; i < lattice->end[0];) {
        x[0] = lattice_place(lattice, 0, i);
        double g = shape_distance(shape, dim, x) + limit;
        double steps = jumps ? 1.0 : floor(fabs(g) / lattice->spacing * (1.0 - FILL_TOLERANCE));
        double left = (double)(lattice->end[0] - i);
        long next = i + (long)fmin(fmax(1.0, steps), left);
        for (; i < next; i++) {
            x[0] = lattice_place(lattice, 0, i);
            if (g < 0.0)
                CALL(filling_add(filling, x));
        }
    }
    return 0;
}

int geometry_fill(const struct shape *shape, int dim, double spacing, const double origin[3], double margin,
                  double (**points)[3], size_t *n)
{
    struct lattice lattice = {0};
    struct filling filling = {0};
    bool jumps = shape_jumps(shape);

    CALL(lattice_init(&lattice, shape, dim, spacing, origin));
    filling.points = memory_create(64, sizeof *filling.points);
    CHECK_MEMORY(filling.points);
    filling.capacity = 64;
    int status = 0;
    for (long k = lattice.first[2]; !status && k < lattice.end[2]; k++)
        for (long j = lattice.first[1]; !status && j < lattice.end[1]; j++) {
            double x[3] = {0.0, dim > 1 ? lattice_place(&lattice, 1, j) : 0.0,
                           dim > 2 ? lattice_place(&lattice, 2, k) : 0.0};
            status = fill_row(&lattice, shape, dim, margin, jumps, x, &filling);
        }
    if (status) {
        memory_free(filling.points);
        return status;
    }
    *points = filling.points;
    *n = filling.n;
    return 0;
}

double geometry_line(const double from[3], const double to[3], int n, int i, double x[3])
{
    const double s = n > 1 ? (double)i / (n - 1) : 0.0;
    double length2 = 0.0;
    for (int k = 0; k < 3; ++k) {
        length2 += (to[k] - from[k]) * (to[k] - from[k]);
        x[k] = (1.0 - s) * from[k] + s * to[k];
    }
    return s * sqrt(length2);
}

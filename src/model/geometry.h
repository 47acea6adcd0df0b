// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef MODEL_GEOMETRY_H
#define MODEL_GEOMETRY_H

#include <stdbool.h>
#include <stddef.h>

struct facets;

enum shape_kind {
    SHAPE_BOX,          /**< a = lower, b = upper corner */
    SHAPE_BALL,         /**< disc in 2-D; a = centre, radius */
    SHAPE_CYLINDER,     /**< annulus in 2-D; a = one end of the axis, b = other end, inner_radius (0: full),
                           radius */
    SHAPE_POLYGON,      /**< 2-D; closed, points */
    SHAPE_HALF_SPACE,   /**< a = a point of the plane, b = normal out of the half-space */
    SHAPE_FACETS,       /**< solid side of a facet surface, see facets_distance */
    SHAPE_UNION,        /**< of the children */
    SHAPE_INTERSECTION, /**< of the children */
    SHAPE_DIFFERENCE    /**< first child minus the others */
};

/** A region of space: a tree of simple shapes. */
struct shape {
    enum shape_kind kind;
    double a[3], b[3], radius, inner_radius;
    size_t n_points;
    double (*points)[3];
    const struct facets *facets; /**< not owned */
    size_t n_children;
    struct shape *children;
};

/** Signed distance from @p x to the boundary of the shape, negative inside; exact for simple shapes, a lower
 * bound of the magnitude for combinations. */
double shape_distance(const struct shape *shape, int dim, const double x[3]);

/** Bounding box of the shape in the first @p dim directions (half-spaces and solids
 * outside of a closed facet surface: +-infinity). */
void shape_bounds(const struct shape *shape, int dim, double lower[3], double upper[3]);

/** Free what the shape owns (not the shape itself). */
void shape_reset(struct shape *shape);

/** Signed distance to a facet surface, negative on the side the normals point away from (inside the solid),
 * positive on the fluid side. Facets in 2-D: segments; in 3-D: triangles and quads. For open surfaces the
 * sign is that of the nearest facet. */
double facets_distance(const struct facets *facets, const double x[3]);

/** Fill a region with the points of a cubic lattice of cell size @p spacing whose cells start at @p origin
 * (points sit at cell centres); a point is kept if it lies further than @p margin inside the shape. Points
 * are ordered x fastest.
 * *@p points (memory_free) gets *@p n rows of 3. Refuses (STATUS_DECK) more than 2e9 points before
 * allocating. */
int geometry_fill(const struct shape *shape, int dim, double spacing, const double origin[3], double margin,
                  double (**points)[3], size_t *n);

/** Place @p x of point @p i of @p n (at least 1), evenly spaced from @p from to @p to. Returns its distance
 * from the first. */
double geometry_line(const double from[3], const double to[3], int n, int i, double x[3]);

#endif

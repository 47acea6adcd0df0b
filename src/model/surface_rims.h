// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef MODEL_SURFACE_RIMS_H
#define MODEL_SURFACE_RIMS_H

#include "model/model.h"

/** Where facets end. */
struct surface_rims {
    size_t n_open;   /**< ends (2-D) or edges (3-D) from which no other facet goes on, at least in part */
    double gap;      /**< least distance to an end or edge that could have gone on, m; 0: there is none */
    double place[3]; /**< where that is, m */
};

/** Find the ends of the facets of @p n surfaces (of one dimension) taken together: points (2-D) or edges
 * (3-D, counted by their middle) inside a box that are not walked as often in one direction as in the other.
 * Edges need not have the same nodes: one long edge may lie along several short ones. Ends and edges closer
 * than @p tolerance (m; at least what rounding does to coordinates) join; others closer than @p reach (m) are
 * gaps. n_open = 0: closed, or it ends on the sides of the box or beyond. Returns 0 or STATUS_MEMORY. */
int surface_rims_find(const struct facets *const *surfaces, size_t n, double tolerance, double reach,
                      const double lower[3], const double upper[3], struct surface_rims *rims);

/** Edges of a surface (3-D: first and last point as they are walked; 2-D: an end's point, twice) that its own
 * facets do not walk as often in one direction as in the other: an array of @p n pairs of points in @p edges,
 * to be freed by memory_free. Returns 0 or STATUS_MEMORY. */
int surface_rims_edges(const struct facets *facets, int32_t (**edges)[2], size_t *n);

#endif

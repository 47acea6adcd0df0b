// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef WALL_PROJECTION_H
#define WALL_PROJECTION_H

#include <stdbool.h>
#include <stdint.h>

/** Where the closest point of a facet lies (paper 000 section 3.3.2). */
enum projection_feature { PROJECTION_NODE, PROJECTION_EDGE, PROJECTION_INTERIOR };

/** A plane piece of a facet: a segment (2-D), a triangle, a quad whose corners lie in one plane, or a quarter
 * of a warped quad: the triangle of corners k, k + 1 and the centre. */
struct piece {
    int32_t facet;
    int n;             /**< corners: 2, 3, 4; 0: the facet has shrunk to nothing */
    int quarter;       /**< k of a quarter, or -1: the whole facet */
    double origin[3];  /**< first corner, in the plane */
    double normal[3];  /**< into the fluid */
    double axis[2][3]; /**< in the plane; 2-D: [0] = tangent */
    double corner[4]
                 [2]; /**< in these axes, counter-clockwise seen from the fluid; 2-D: (0, 0), (length, 0) */
    double tangent[4][2], length[4]; /**< 3-D: of the edge from each corner to the next, in these axes */
};

/** Edges of a plane polygon, in order, as seen from the foot point of a place: the distance of each edge's
 * line (> 0: the foot point is on its inner side), and where the edge begins and ends on it, measured from
 * the place closest to the foot point. One that has no length has s0 = s1. */
struct projection_edges {
    int n;
    double h[4], s0[4], s1[4];
};

/** The closest point of a piece to a place. */
struct projection {
    double d;          /**< signed distance from the plane, positive on the fluid side */
    double foot[2];    /**< foot point on the plane, in the piece's axes */
    double closest[2]; /**< closest point of the piece, in the same */
    double distance;   /**< from the place to the closest point */
    enum projection_feature feature;
    int at;                        /**< the corner or edge on which the closest point lies (3-D) */
    struct projection_edges edges; /**< 3-D */
};

/** Cut the facet with corner places @p x (rows) into 1 or 4 pieces; a quad is cut where its corners lie
 * further than @p flat from its mean plane. From there to twice as far its pieces turn out of that plane
 * little by little, so that what they do has no jump. @p before, unless 0, is the number of pieces to keep.
 * Returns their number. */
int piece_cut(struct piece pieces[4], int32_t facet, int dim, int n, const double (*x)[3], double flat,
              int before);

/** Signed distance of @p x from the plane of a piece. */
static inline double piece_plane_distance(const struct piece *piece, const double x[3])
{
    return (x[0] - piece->origin[0]) * piece->normal[0] + (x[1] - piece->origin[1]) * piece->normal[1] +
           (x[2] - piece->origin[2]) * piece->normal[2];
}

/** Closest point of @p piece to @p x; points closer than @p snap to a corner or edge are on it. */
void projection_find(struct projection *projection, const struct piece *piece, const double x[3],
                     double snap);

/** Angle of the piece about the closest point, rad (2-D: 1): weight of its normal there. */
double projection_angle(const struct projection *projection, const struct piece *piece);

/** Place of the in-plane coordinates @p local. */
void piece_place(const struct piece *piece, const double local[2], double x[3]);

/** Values of the shape functions of the whole facet (@p n nodes) at the in-plane coordinates @p local of a
 * piece; they add up to 1. */
void piece_weights(const struct piece *piece, int n, const double local[2], double weights[4]);

#endif

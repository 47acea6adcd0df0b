// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef WALL_FACET_SHARES_H
#define WALL_FACET_SHARES_H

#include "sph/isa.h"
#include "sph/kernel.h"
#include "wall/projection.h"

/** Shares of plane facets in the full block of virtual boundary particles behind their plane, measured with
 * the block's own sums. For a plane at distance d from the particle and the full block k of paper 000 eq. 30
 *     S(d) = sum V0 W(r_k),   G(d) = sum -V0 W'(r_k) y_k/r_k = -S'(d),   V(d) = sum -V0 W'(r_k)/r_k
 * weigh density, pressure and viscosity. A facet's share of each is a closed integral along its edges; shares
 * of the parts of a plane add up to 1, so that a plane cut into facets is the paper's method, and sum -n w_G
 * G is the exact gradient of sum w_S S: conservative and continuous at corners of any angle. Shares carry the
 * sign of d. */
enum facet_share { SHARE_DENSITY, SHARE_PRESSURE, SHARE_VISCOUS, SHARES };

/** Sums over the virtual particles of one layer at distance y from the particle, at in-plane offsets s, t
 * from its middle: W, W' y/r, W'/r, W' s^2/r (= W' t^2/r). */
enum layer_moment { LAYER_W, LAYER_NORMAL, LAYER_VISCOUS, LAYER_TANGENT, LAYER_MOMENTS };

/** Four functions side by side: a vector of the compiler's extension. */
typedef double share_lanes __attribute__((vector_size(4 * sizeof(double))));

/** Cubics c[0] + c[1] x + c[2] x^2 + c[3] x^3 of four functions over one step of a table, 0 <= x <= 1. */
struct share_cubics {
    share_lanes c[4];
};

struct facet_shares {
    struct kernel kernel;
    double dx;
    int layers;                   /**< q = ceil(r_c / dx): layers of a block; it is 2 q - 1 wide */
    double range;                 /**< r_c - dx/2: where S, G and V vanish */
    double last;                  /**< largest distance at which shares are evaluated (beyond: 0/0) */
    int profile_steps;            /**< over the range */
    struct share_cubics *profile; /**< S, G, V (and 0) in equal steps of d */
    double (*table)[3];           /**< 2-D: C(a, s) without its singular part */
    struct share_cubics *layer;   /**< 3-D: the moments in equal steps of y */
    enum isa isa;                 /**< instruction set of polygons' integrals */
};

/** Make the tables for lattice spacing @p dx (1-D needs none but has S, G, V), for sums in the instruction
 * set
 * @p isa. Free with facet_shares_reset. */
int facet_shares_create(struct facet_shares *shares, struct kernel kernel, double dx, enum isa isa);
void facet_shares_reset(struct facet_shares *shares);

/** S, G, V at distance @p d >= 0 by summing the block. */
void facet_shares_block(const struct facet_shares *shares, double d, double sums[SHARES]);

/** 3-D: moments of a layer at distance @p y >= 0, from a table good to 1e-8 of their values at dx/2. */
void facet_shares_layer(const struct facet_shares *shares, double y, double moments[LAYER_MOMENTS]);

/** The same by summing. */
void facet_shares_layer_exact(const struct facet_shares *shares, double y, double moments[LAYER_MOMENTS]);

/** V from the table; 0 <= d, 0 beyond the range. */
double facet_shares_viscous(const struct facet_shares *shares, double d);

/** 2-D: shares of the segment from @p s0 to @p s1 along its line, measured from the foot point, at signed
 * distance @p d. From the table, good to 1e-5. 0 where |d| >= last. */
void facet_shares_segment(const struct facet_shares *shares, double d, double s0, double s1,
                          double share[SHARES]);

/** 3-D: shares of the plane polygon with the @p edges (counter-clockwise seen from the fluid) at signed
 * distance @p d, by a closed form and 8 or 16 Gauss points an edge; share times S(d) good to 1e-5. */
void facet_shares_polygon(const struct facet_shares *shares, double d, const struct projection_edges *edges,
                          double share[SHARES]);

/** The same by direct quadrature with summed blocks, to 1e-9: for tests. */
void facet_shares_segment_exact(const struct facet_shares *shares, double d, double s0, double s1,
                                double share[SHARES]);
void facet_shares_polygon_exact(const struct facet_shares *shares, double d,
                                const struct projection_edges *edges, double share[SHARES]);

#endif

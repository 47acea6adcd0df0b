// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef WALL_FACET_SHARES_SWEEPS_H
#define WALL_FACET_SHARES_SWEEPS_H

#include "sph/isa.h"
#include "wall/facet_shares.h"

/** A plane at distance a from the particle, with the sums S, G, V of its block there, and the coefficients of
 * the closed part of the integrals along edges (facet_shares.c). */
struct share_plane {
    double a, f[SHARES], alpha[SHARES], beta[SHARES];
};

/** Edges of a polygon cut to the range: distance h > 0 from the foot point, from s0 to s1 along it, and the
 * sign of the side on which the foot point lies. */
struct share_edges {
    int n;
    double h[4], s0[4], s1[4], side[4];
};

/** sum := over the edges of side times the integral of f over the in-plane angle; Gauss points in vectors. */
typedef void facet_shares_edges(const struct facet_shares *shares, const struct share_plane *plane,
                                const struct share_edges *edges, double sum[SHARES]);

/** The same for each instruction set. */
facet_shares_edges *facet_shares_edges_of(enum isa isa);

#endif

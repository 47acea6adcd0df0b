// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef SPH_TURNING_LOAD_H
#define SPH_TURNING_LOAD_H

#include "model/surface.h"

/** The part of the viscous stress at a turned or stretched wall that the forces between particles have not.
 * Their sum is eta laplace(u), with the traction eta du/dn; a Newtonian fluid's has eta (grad u)^T n besides.
 * Over a closed surface that adds up to no force, but to a moment of -2 eta volume x angular velocity:
 * without it a cylinder that turns freely in a shear flow turns 1.6 times too fast.
 *
 * On facets grad u is that of the surface's own velocity, as far as the fluid can follow it: the motion of a
 * rigid body that is nearest to it, plus the rest averaged over about a smoothing length. Waves of shorter
 * facets, which particles do not see and hence do not damp, would feed themselves otherwise. Where a surface
 * ends, the velocities along its rim are all that the sum of the loads depends on: they are averaged along
 * the rim only, so that a held rim stays held, and the sum zero. */
struct turning_load {
    const struct surface *surface; /**< of facets */
    size_t n_points;               /**< those there were at first: walls of material points append theirs */
    size_t passes;                 /**< each averages over the facets around a point */
    double (*v)[3];                /**< velocity of the points, averaged */
    double (*sum)[3];
    int32_t (*rim)[2]; /**< points of edges where the surface ends (2-D: a point, twice) */
    size_t n_rim;
    bool *on_rim;
    uint32_t *n_means; /**< facets around each point, or ends of edges of the rim there; 0: in no facet */
};

/** For a surface of facets in a fluid of smoothing length @p h. Free with turning_load_reset. */
int turning_load_create(struct turning_load *load, const struct surface *surface, double h);
void turning_load_reset(struct turning_load *load);

/** Add the loads of a fluid of dynamic viscosity @p viscosity for the surface's motion now. */
void turning_load_add(struct turning_load *load, double viscosity, double (*to)[3]);

#endif

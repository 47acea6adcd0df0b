// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef WALL_MATERIAL_POINTS_H
#define WALL_MATERIAL_POINTS_H

#include "sph/boundary.h"
#include "wall/wall_places.h"

/** Particles of a wall that are material points of meshes. Each follows the nodes of the element it lies in
 * by the element's shape functions; the nodes are points of the surface, and what acts on the particle goes
 * back to them with the same weights, so that force, moment and power are those of the particle. */
struct material_points {
    size_t n;
    uint32_t *particle; /**< number of each in the wall, ascending */
    int32_t *surface;   /**< which of the boundary's surfaces */
    uint32_t *start;    /**< n + 1: where its nodes begin */
    int32_t *points;    /**< of the surface */
    double *weights;    /**< shape functions */
};

/** Pick the particles of @p places that meshes move, and let the boundary's surfaces follow the nodes of
 * their elements (surface_add_nodes). Returns a status; free with material_points_reset. */
int material_points_init(struct material_points *material, struct boundary *boundary,
                         const struct model *model, const struct wall_places *places);
void material_points_reset(struct material_points *material);

/** Place, velocity and acceleration of material point @p k as its surface is @c now. */
void material_points_motion(const struct material_points *material, const struct boundary *boundary, size_t k,
                            double x[3], double v[3], double a[3]);

/** Add a force on material point @p k to the loads of its nodes. */
void material_points_load(const struct material_points *material, struct boundary *boundary, size_t k,
                          const double force[3]);

/** Rows and columns of the added mass of material point @p k: its nodes. They stand in the anchors of
 * the surface, which has room for those of all material points. */
void material_points_contact(const struct material_points *material, const struct boundary *boundary,
                             size_t k, struct added_mass_contact *contact);

#endif

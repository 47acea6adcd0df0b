// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef WALL_WALL_PLACES_H
#define WALL_WALL_PLACES_H

#include "model/model.h"

/** Where the particles of a wall stand in the reference configuration, and what moves each of them. */
struct wall_places {
    size_t n;
    double (*X)[3];
    int32_t *surface; /**< which of the wall's surfaces it stands behind; -1: the wall moves it */
    int32_t *mesh;    /**< of the model, whose material point it is; -1: motion is prescribed */
    uint32_t *element;
    double (*xi)[3]; /**< natural coordinates in the element */
};

/** The places that the deck lists or fills, or else the lattice of the fluid behind the wall's surfaces, up
 * to @p support deep: particles inside a mesh that a surface is the skin of are its material points, the
 * others stand behind what is not skin. @p spacing of the lattice, m. n = 0 when there are none. Returns a
 * status; free with wall_places_reset. */
int wall_places_init(struct wall_places *places, const struct model *model, const struct model_wall *wall,
                     double spacing, double support);
void wall_places_reset(struct wall_places *places);

/** Whether mesh @p mesh moves a part of a surface. */
bool wall_places_has_mesh(const struct model_surface *surface, int mesh);

#endif

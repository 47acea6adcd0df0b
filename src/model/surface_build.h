// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef MODEL_SURFACE_BUILD_H
#define MODEL_SURFACE_BUILD_H

#include "model/model.h"

/** Merge all parts of a facet surface in the reference configuration into @p surface ->built, ->built_mesh
 * and
 * ->built_node (what was there is freed first); analytic surfaces get empty arrays. Only points that a facet
 * uses are kept. Points of different parts closer than 1e-4 of the diagonal of the surface's bounding box are
 * one point, those of the same own part closer than 1e-9 of it; a point of a mesh goes before others, so that
 * the surface follows the mesh. Nodes of one mesh are never merged. Facets that shrink to less than a segment
 * (2-D) or triangle (3-D) vanish. Deterministic. Free with surface_build_reset (model_destroy does). Returns
 * 0, STATUS_DECK (a part without facets) or STATUS_MEMORY. */
int surface_build(const struct model *model, struct model_surface *surface);

/** Free what surface_build made. */
void surface_build_reset(struct model_surface *surface);

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RUN_PREVIEW_PHYSICS_H
#define RUN_PREVIEW_PHYSICS_H

#include "model/model.h"

/** Physical plausibility of a deck, for preview_print. */

/** What limits the time step (paper 000 eq. 25), s; infinite where there is no such limit. */
struct preview_limits {
    double
        speed; /**< highest prescribed or initial speed, m/s: openings, walls, regions, over the whole time */
    double sound, viscosity, body_force;
};

/** Sample all prescribed velocities and body forces. Needs a fluid. */
void preview_find_limits(const struct model *model, struct preview_limits *limits);

/** Log warnings with their line: sound speed, time step, spacing against lengths, thin walls, short facets.
 */
void preview_warn(const struct model *model, const struct preview_limits *limits);

/** Least thickness of the solid behind a closed facet surface, m, sampled by rays from (at most 400) facet
 * centres against the normal; infinite if the surface is open. @p where: the facet's centre. */
double preview_thickness(const struct facets *facets, double where[3]);

#endif

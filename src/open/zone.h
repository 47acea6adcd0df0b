// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef OPEN_ZONE_H
#define OPEN_ZONE_H

#include "sph/open_boundary.h"

#include <math.h>
#include <string.h>

/** Distance of place @p x from the plane of an opening, positive inside the fluid domain. */
static inline double zone_inside(const struct model_open *definition, const double x[3])
{
    return definition->into * (x[definition->axis] - definition->at);
}

/** Whether @p x lies in front of the opening: within its extent (and half a spacing) across the axis. */
static inline bool zone_across(const struct model_open *definition, int dim, const double x[3], double margin)
{
    for (int k = 0; k < dim; ++k)
        if (k != definition->axis &&
            (x[k] < definition->lower[k] - margin || x[k] > definition->upper[k] + margin))
            return false;
    return true;
}

/** A zone particle that came further than a tenth of a spacing inside becomes fluid, and its copy is born one
 * zone depth behind it. Only within a sort. */
int zone_release(struct open_boundary *open, const struct fluid_view *view, struct particles *particles);

/** Indices of the zone's particles into open->zone. */
int zone_list(struct open_boundary *open, const struct fluid_view *view);

#endif

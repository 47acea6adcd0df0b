// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef WALL_WALL_LIST_H
#define WALL_WALL_LIST_H

#include "sph/boundary.h"

/** The wall treatments there are. */
extern const struct boundary_type boundary_fixed_particles;
extern const struct boundary_type boundary_sliding_particles;

static const struct boundary_type *const wall_types[] = {
    &boundary_fixed_particles,
    &boundary_sliding_particles,
};

enum { WALL_TYPES = sizeof wall_types / sizeof *wall_types };

#endif

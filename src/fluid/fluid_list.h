// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FLUID_FLUID_LIST_H
#define FLUID_FLUID_LIST_H

#include "fluid/fluid_internal.h"

/** Every formulation once. */
static const struct fluid_type *const fluid_types[] = {&fluid_transport_velocity};

enum { FLUID_TYPES = sizeof fluid_types / sizeof *fluid_types };

#endif

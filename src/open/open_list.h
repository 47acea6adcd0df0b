// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef OPEN_OPEN_LIST_H
#define OPEN_OPEN_LIST_H

#include "sph/open_boundary.h"

extern const struct open_boundary_type open_boundary_inflow, open_boundary_outflow;

/** Every kind of open boundary once, by enum open_kind. */
static const struct open_boundary_type *const open_boundary_types[] = {&open_boundary_inflow,
                                                                       &open_boundary_outflow};

#endif

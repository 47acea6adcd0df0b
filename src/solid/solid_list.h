// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef SOLID_SOLID_LIST_H
#define SOLID_SOLID_LIST_H

#include "solid/solid_type.h"

extern const struct solid_type continuum_type, rigid_body_type;

/** All discretisations of solids: one line each. */
static const struct solid_type *const solid_list[] = {
    &continuum_type,
    &rigid_body_type,
};

enum { SOLID_LIST_SIZE = sizeof solid_list / sizeof solid_list[0] };

#endif

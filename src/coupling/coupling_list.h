// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef COUPLING_COUPLING_LIST_H
#define COUPLING_COUPLING_LIST_H

#include "coupling/coupling.h"

extern const struct coupling_type coupling_fixed_point, coupling_sub_cycled, coupling_one_field;

/** Every scheme once; the first is the default when fluid and solids meet. */
static const struct coupling_type *const coupling_types[] = {&coupling_fixed_point, &coupling_sub_cycled,
                                                             &coupling_one_field};

enum { COUPLING_TYPES = sizeof coupling_types / sizeof *coupling_types };

#endif

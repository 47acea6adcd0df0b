// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef SOLID_CONSTITUTIVE_CONSTITUTIVE_LIST_H
#define SOLID_CONSTITUTIVE_CONSTITUTIVE_LIST_H

#include "solid/constitutive/constitutive.h"

extern const struct constitutive_law saint_venant_kirchhoff_law, neo_hookean_law;

/** All constitutive laws: one line each. */
static const struct constitutive_law *const constitutive_list[] = {
    &saint_venant_kirchhoff_law,
    &neo_hookean_law,
};

enum { CONSTITUTIVE_LIST_SIZE = sizeof constitutive_list / sizeof constitutive_list[0] };

#endif

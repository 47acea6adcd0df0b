// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef SOLID_ELEMENT_ELEMENT_LIST_H
#define SOLID_ELEMENT_ELEMENT_LIST_H

#include "solid/element/element.h"

extern const struct element_kernel quad4_full, quad4_f_bar, quad4_eas, hex8_full, hex8_f_bar, hex8_eas,
    tri3_full, tet4_full, tri6_full, quad8_full, quad9_full, tet10_full, hex20_full, hex27_full;

/** All element kernels: one line per element type. */
static const struct element_kernel *const element_list[] = {
    &tri3_full, &quad4_full, &quad4_f_bar, &quad4_eas,  &tet4_full,  &hex8_full,  &hex8_f_bar,
    &hex8_eas,  &tri6_full,  &quad8_full,  &quad9_full, &tet10_full, &hex20_full, &hex27_full,
};

enum { ELEMENT_LIST_SIZE = sizeof element_list / sizeof element_list[0] };

#endif

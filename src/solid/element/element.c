// SPDX-License-Identifier: GPL-3.0-or-later
#include "solid/element/element.h"

#include "solid/element/element_list.h"

const struct element_kernel *element_kernel_find(enum element_type type, enum solid_formulation formulation,
                                                 const char **reason)
{
    *reason = "this element type has no continuum formulation; use triangles, quads, tetrahedra or hexahedra";
    for (int k = 0; k < ELEMENT_LIST_SIZE; k++) {
        if (element_list[k]->type != type)
            continue;
        if (element_list[k]->formulation == formulation)
            return element_list[k];
        *reason =
            element_is_quadratic(type)
                ? "quadratic elements bend without locking; use formulation=\"full\", or quad4 and hex8 "
                  "elements"
                : "linear triangles and tetrahedra have constant strain, nothing is left to enhance or "
                  "to average; use formulation=\"full\" or quad4 and hex8 elements";
    }
    return NULL;
}

const char *element_formulation_name(enum solid_formulation formulation)
{
    switch (formulation) {
    case SOLID_F_BAR:
        return "f-bar";
    case SOLID_EAS:
        return "eas";
    case SOLID_FULL:
        break;
    }
    return "full";
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "solid/constitutive/constitutive.h"

#include "solid/constitutive/constitutive_list.h"

#include <string.h>

const struct constitutive_law *constitutive_find(const char *name)
{
    for (int l = 0; l < CONSTITUTIVE_LIST_SIZE; l++)
        if (!strcmp(constitutive_list[l]->name, name))
            return constitutive_list[l];
    return NULL;
}

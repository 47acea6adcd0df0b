// SPDX-License-Identifier: GPL-3.0-or-later
#include "solid/constitutive/constitutive.h"

#include "solid/constitutive/constitutive_list.h"

#include <string.h>

const char *constitutive_check_elastic(const struct solid_material *material)
{
    if (!(material->young > 0))
        return "Young's modulus must be positive";
    if (!(material->poisson > -1 && material->poisson < 0.5))
        return "Poisson's ratio must lie between -1 and 0.5";
    return NULL;
}

void constitutive_lame(const struct solid_material *material, double *parameters)
{
    const double nu = material->poisson;
    parameters[CONSTITUTIVE_LAMBDA] = material->young * nu / ((1 + nu) * (1 - 2 * nu));
    parameters[CONSTITUTIVE_MU] = material->young / (2 * (1 + nu));
}

const struct constitutive_law *constitutive_find(const char *name)
{
    for (int l = 0; l < CONSTITUTIVE_LIST_SIZE; l++)
        if (!strcmp(constitutive_list[l]->name, name))
            return constitutive_list[l];
    return NULL;
}

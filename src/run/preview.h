// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RUN_PREVIEW_H
#define RUN_PREVIEW_H

#include "model/model.h"

#include <stdio.h>

/** What "skerry check" prints: particles per region, nodes and degrees of freedom, surfaces, step size and
 * what limits it, memory, free disk against the expected output, an estimate of the run time; and physical
 * warnings (as log warnings with their line): sound speed under 10 u_max, step against its limits (paper 000
 * eq. 25), spacing that does not divide the domain, walls thinner than 2 spacings (sliding) or than the
 * support (fixed particles), facets shorter than one spacing. Writes nothing. Returns a status. */
int preview_print(const struct model *model, const char *output, FILE *stream);

#endif

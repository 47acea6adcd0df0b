// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RUN_PROBE_PLACES_H
#define RUN_PROBE_PLACES_H

#include "run/probe.h"

#include <stdbool.h>

/** Places to probe; those of a grid are numbered with x fastest. */
struct probe_places {
    size_t n, x_capacity, s_capacity;
    double (*x)[3]; /**< m; beyond the dimension of the problem: 0 */
    double *s;      /**< way along the line, or from point to point, m; not for a grid */
    bool grid;
    size_t size[3]; /**< of the grid, points */
    double lower[3], spacing[3];
};

/** Read what the command line says for a problem of the model's dimension. Returns 0, STATUS_USAGE,
 * STATUS_DECK (the content of a file of points), STATUS_NO_INPUT, STATUS_IO or STATUS_MEMORY, reported; reset
 * it in any case. */
int probe_places_create(struct probe_places *places, const struct model *model, size_t n,
                        const struct probe_place *given);
void probe_places_reset(struct probe_places *places);

#endif

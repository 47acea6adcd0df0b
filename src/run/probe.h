// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RUN_PROBE_H
#define RUN_PROBE_H

#include "model/model.h"

#include <stddef.h>

enum probe_kind { PROBE_POINT, PROBE_POINTS, PROBE_LINE, PROBE_GRID };

/** Where to probe, as given on the command line. */
struct probe_place {
    enum probe_kind kind;
    const char *text; /**< "x,y,z"; a CSV file; "x0,y0,z0:x1,y1,z1:N"; "[lower:upper:]NXxNYxNZ" */
};

/** Options of "skerry probe". */
struct probe {
    const char *output; /**< folder of a run */
    size_t n_places;
    const struct probe_place *places;
    const char *fields; /**< point arrays of the fluid, separated by commas; NULL: pressure, velocity, density
                         */
    const char *frames; /**< see series_choose_several; NULL: the last one */
    const char *time;   /**< the frame nearest to this time instead, s; or NULL */
    const char *file; /**< to write; NULL: a table to standard output, a grid into OUTPUT/probe; "-": a table
                         to standard output in any case */
    int threads;      /**< 0: the CPUs this process may use */
};

/** Fields of the fluid by Shepard-corrected sums over its particles (paper 000 eq. 14) in frames of a run of
 * @p model: at points and along lines as CSV, on a grid as .vti or CSV. Returns 0, STATUS_USAGE, STATUS_DECK
 * (a file of points is wrong), STATUS_NO_INPUT, STATUS_CREATE, STATUS_IO or STATUS_MEMORY. */
int probe_write(const struct probe *probe, const struct model *model);

#endif

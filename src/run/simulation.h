// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RUN_SIMULATION_H
#define RUN_SIMULATION_H

#include "model/model.h"

#include <stdbool.h>
#include <stdio.h>

/** Options of "skerry run". */
struct run_options {
    const char *output; /**< folder; NULL: the deck's base name + ".out" in the current folder */
    int threads;        /**< 0: the CPUs this process may use */
    bool has_until;
    double until;       /**< stop after the first step that reaches it, s */
    long steps;         /**< stop when the step counter reaches it; < 0: no limit */
    bool force;         /**< empty the folder of what skerry wrote there before */
    bool quiet, json;   /**< no progress line; JSON lines on stdout */
    const char *isa;    /**< "auto", "baseline", "v3", "v4" */
    size_t n_overrides; /**< --set, as given ("dx=0.01"), for the summary */
    const char *const *overrides;
};

/** Run a model whole and write its output folder. Returns 0, STATUS_NUMERICAL, STATUS_CREATE, STATUS_IO,
 * STATUS_MEMORY, or 128 + signal when SIGINT or SIGTERM ended it (output intact). */
int simulation_run(const struct model *model, const struct run_options *options);

/** Check that the parts of the model go together (formulation x walls x solids x coupling); reports each
 * reason. Returns 0 or STATUS_DECK. */
int simulation_check(const struct model *model);

#endif

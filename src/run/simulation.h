// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RUN_SIMULATION_H
#define RUN_SIMULATION_H

#include "model/model.h"

#include <stdbool.h>
#include <stdio.h>

/** Options of "skerry run" and "skerry resume". */
struct run_options {
    const char *output; /**< folder; NULL: the deck's base name + ".out" in the current folder */
    bool resume;        /**< go on from the newest checkpoint in it */
    int threads;        /**< 0: the CPUs this process may use */
    bool has_until;
    double until; /**< stop after the first step that reaches it, s; resume: also beyond the deck's end */
    long steps; /**< stop when the step counter reaches it, resume: also beyond the deck's end; < 0: no limit
                 */
    double started;  /**< wall clock (timer_now) when the program started */
    double max_wall; /**< stop with a checkpoint before the program has run so long, s; < 0: no limit */
    double checkpoint_every; /**< wall clock between checkpoints, s; < 0: as the deck says */
    bool force;              /**< empty the folder of what skerry wrote there before */
    bool quiet, json;        /**< no progress line; JSON lines on stdout */
    const char *isa;         /**< "auto", "baseline", "v3", "v4" */
    const char *isa_before;  /**< resume: what "auto" means if this machine has it */
    size_t n_overrides;      /**< --set, as given ("dx=0.01"), of all processes of the run, oldest first */
    const char *const *overrides;
    size_t n_overrides_before; /**< those that the output folder knows already */
};

/** Run a model, or go on with it, and write its output folder. Returns 0, STATUS_NUMERICAL, STATUS_CREATE,
 * STATUS_IO, STATUS_NO_INPUT (nothing to resume), STATUS_MEMORY, or STATUS_STOPPED: a signal, the file "stop"
 * or max_wall ended it early, with a checkpoint. */
int simulation_run(const struct model *model, const struct run_options *options);

/** Check that the parts of the model go together (formulation x walls x solids x coupling); reports each
 * reason. Returns 0 or STATUS_DECK. */
int simulation_check(const struct model *model);

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RUN_SUMMARY_H
#define RUN_SUMMARY_H

#include "base/timer.h"

#include <stddef.h>
#include <stdint.h>

/** A named number: a parameter of the deck, a balance. */
struct summary_pair {
    const char *name; /**< "dx", "fluid mass" */
    double value;
    const char *unit; /**< "kg"; NULL: not written */
};

/** What a run leaves behind in summary.json and tells at its end. Nothing is owned. */
struct summary {
    const char *version, *revision; /**< of the program */
    const char *deck;               /**< path of the deck */
    uint64_t deck_hash;             /**< of its bytes (base/hash.h) */
    const char *isa;                /**< instruction set of the sweeps; NULL: no fluid */
    int dim, threads, status;       /**< status: what the program returns */
    size_t particles;
    long steps;
    double t;               /**< simulated time reached, s */
    double wall_s;          /**< of the time loop, s */
    double updates;         /**< particle updates in all */
    double iterations_mean; /**< coupling iterations per step; 0: nothing is coupled */
    long files;             /**< written */
    size_t n_parameters, n_overrides, n_balances, n_numbers;
    const struct summary_pair *parameters; /**< as used */
    const char *const *overrides;          /**< --set, as given */
    const struct summary_pair *balances;   /**< mass, momentum, energy */
    const struct summary_pair *numbers;    /**< further keys of the top level */
    const struct timer *timer;             /**< wall time by phase */
};

/** Write summary.json at @p path, atomically. Returns 0, STATUS_IO or STATUS_MEMORY. */
int summary_write(const struct summary *summary, const char *path);

/** Tell the user: log messages of level LOG_INFO. */
void summary_print(const struct summary *summary);

#endif

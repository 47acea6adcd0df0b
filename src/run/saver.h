// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RUN_SAVER_H
#define RUN_SAVER_H

#include "base/field.h"
#include "output/checkpoint.h"

#include <stdbool.h>

/** The checkpoints of a run: when one is due, what it costs, which two are kept. */
struct saver {
    char *folder;            /**< OUTPUT/checkpoint */
    struct field_list state; /**< of the whole run; filled by the owner, in a fixed order */
    double every;            /**< s of wall clock between checkpoints; 0: after every step */
    int64_t step;            /**< of the newest good checkpoint; -1: none */
    double t;                /**< and its time, s */
    double saved_at;         /**< wall clock (timer_now) when it was written or read */
    double cost;             /**< longest time that writing one took, s */
};

/** For the output folder @p output; the clock starts now. Returns 0 or STATUS_MEMORY. */
int saver_create(struct saver *saver, const char *output, double every);
void saver_reset(struct saver *saver);

/** Whether the interval has passed. */
bool saver_due(const struct saver *saver);

/** Write a checkpoint of the state unless there is one of this step already. Returns a status (reported). */
int saver_write(struct saver *saver, const struct checkpoint_note *note);

/** Fill the state from the newest good checkpoint. Returns a status (reported). */
int saver_read(struct saver *saver, struct checkpoint_note *note);

/** How long writing one may take, s: as before, or by the size of the state. */
double saver_cost(const struct saver *saver);

#endif

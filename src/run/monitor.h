// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RUN_MONITOR_H
#define RUN_MONITOR_H

#include "coupling/coupling.h"
#include "model/model.h"

/** The histories of a run. */
struct monitors;

/** Open history/NAME.csv in @p folder for every history of the model. Returns a status (STATUS_DECK when a
 * point lies outside its mesh). */
int monitors_create(struct monitors **monitors, const struct model *model, const struct coupling *coupling,
                    const char *folder);

/** Write the rows that are due at time @p t: the first step that reaches a multiple of "every" writes it; @p
 * step is the length of a time step, for rounding. */
int monitors_sample(struct monitors *monitors, double t, double step);

/** Flush and close. Returns a status. */
int monitors_close(struct monitors *monitors);
void monitors_destroy(struct monitors *monitors);

/** Whether a schedule of interval @p every (0: every step) has its event number @p *next at or before @p t;
 * if so *next moves past @p t. */
bool schedule_due(double every, double t, double step, long *next);

#endif

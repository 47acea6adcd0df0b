// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RUN_MONITOR_H
#define RUN_MONITOR_H

#include "coupling/coupling.h"
#include "model/model.h"

/** The histories of a run. */
struct monitors;

/** For the histories of the model, in history/NAME.csv of @p folder. Returns a status (STATUS_DECK when a
 * point lies outside its mesh). */
int monitors_create(struct monitors **monitors, const struct model *model, const struct coupling *coupling,
                    const char *folder);

/** Begin all files. */
int monitors_start(struct monitors *monitors);

/** Whether monitors_resume could go on with all files, before it cuts any. Returns a status (reported). */
int monitors_check(const struct monitors *monitors);

/** Go on with the files of a run after their rows of time @p t, where a step of length @p step ended. */
int monitors_resume(struct monitors *monitors, double t, double step);

/** Write the rows that are due at time @p t: the first step that reaches a multiple of "every" writes it; @p
 * step is the length of a time step, for rounding. */
int monitors_sample(struct monitors *monitors, double t, double step);

/** Make all rows so far last through a power cut. Returns a status. */
int monitors_sync(const struct monitors *monitors);

/** Flush and close. Returns a status. */
int monitors_close(struct monitors *monitors);
void monitors_destroy(struct monitors *monitors);

/** Number of events of a schedule of interval @p every (> 0) at or before @p t, that at time 0 counted; a
 * millionth of @p step is forgiven. */
long schedule_count(double every, double t, double step);

/** Whether a schedule (every = 0: every step) has had more than *@p count events at @p t; *count becomes
 * their number. What is due depends on the time alone, so that a resumed run needs to know no more. */
bool schedule_due(double every, double t, double step, long *count);

#endif

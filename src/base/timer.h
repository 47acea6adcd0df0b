// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef BASE_TIMER_H
#define BASE_TIMER_H

/** What wall time is spent on; the summary prints it split so. */
enum timer_phase {
    TIMER_NEIGHBOURS,
    TIMER_FLUID,
    TIMER_WALLS,
    TIMER_SOLID,
    TIMER_COUPLING,
    TIMER_OUTPUT,
    TIMER_PHASES
};

struct timer {
    double seconds[TIMER_PHASES];
};

/** Wall clock in seconds (monotonic). */
double timer_now(void);

/** Add the time since *@p since to @p phase and set *@p since to now. */
void timer_lap(struct timer *timer, enum timer_phase phase, double *since);

/** Name of a phase ("neighbours"). */
const char *timer_phase_name(enum timer_phase phase);

#endif

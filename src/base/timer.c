// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/timer.h"

#include <time.h>

double timer_now(void)
{
    struct timespec now;

    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void timer_lap(struct timer *timer, enum timer_phase phase, double *since)
{
    const double now = timer_now();

    timer->seconds[phase] += now - *since;
    *since = now;
}

const char *timer_phase_name(enum timer_phase phase)
{
    static const char *const names[TIMER_PHASES] = {
        [TIMER_NEIGHBOURS] = "neighbours", [TIMER_FLUID] = "fluid",       [TIMER_WALLS] = "walls",
        [TIMER_SOLID] = "solid",           [TIMER_COUPLING] = "coupling", [TIMER_OUTPUT] = "output",
    };

    return names[phase];
}

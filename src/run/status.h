// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RUN_STATUS_H
#define RUN_STATUS_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/** Where a run is, for programs that look from outside. */
struct status_report {
    const char *state; /**< "running", "done", "failed", "stopped" */
    long step;
    double t, t_end, dt;
    double fraction, wall_s, eta_s; /**< eta_s < 0: unknown (null) */
    double updates_per_s;
    size_t particles;
    int64_t checkpoint_step; /**< of the newest checkpoint; < 0: none (null) */
    double checkpoint_t;
};

/** Write status.json at @p path, atomically, with the process and the machine. Returns 0, STATUS_IO or
 * STATUS_MEMORY. */
int status_write(const struct status_report *report, const char *path);

/** "skerry status OUTPUT": tell where the run of an output folder is: what status.json says (or that it is
 * damaged), whether a process still has the folder, and how to go on. Returns 0, STATUS_NO_INPUT (no output
 * of a run; reported) or STATUS_MEMORY. */
int status_print(const char *output, FILE *stream);

#endif

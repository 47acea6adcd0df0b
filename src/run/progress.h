// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RUN_PROGRESS_H
#define RUN_PROGRESS_H

#include <stdbool.h>
#include <stddef.h>

/** Tells the user where a run is: on a terminal one line on stderr, redrawn at most 5 times a second;
 * otherwise a plain line every minute or 5 %, which also goes to the log file in both cases. With @c json one
 * JSON object a line on stdout:
 * {"ev": "start" | "progress" | "event" | "end", ...}. Holds no memory. */

/** What is known before the first step. */
struct progress_setup {
    bool quiet, json;
    double t, t_end; /**< simulated time now and at the end, s */
    long step;       /**< steps taken before */
    long step_end;   /**< the run stops there; < 0: no limit */
};

/** Where the run was at some instant. */
struct progress_sample {
    double wall, fraction; /**< s; 0..1 of the run */
    double updates;        /**< particle updates since the start */
    long step, iterations; /**< coupling iterations since the start */
};

enum {
    PROGRESS_SAMPLES = 64
}; /**< one a second: rates and the remaining time are those of the last minute */

struct progress {
    struct progress_setup setup;
    bool terminal, colour;
    double started, drawn, told,
        reported;   /**< wall time of the start, the last redraw, plain line, JSON line */
    long told_part; /**< twentieth of the run of the last plain line */
    struct progress_sample now;
    struct progress_sample samples[PROGRESS_SAMPLES]; /**< ring */
    size_t n_samples;                                 /**< ever taken */
    double t, dt;
};

/** Begin. On a terminal (stderr, TERM is not "dumb") it registers the hook that clears the line before
 * messages. */
void progress_start(struct progress *progress, const struct progress_setup *setup);

/** After each step: steps taken so far, time reached, length of the step, particles moved in it, coupling
 * iterations of it (0: nothing is coupled). Cheap. */
void progress_update(struct progress *progress, long step, double t, double dt, size_t particles,
                     int iterations);

/** Something worth telling a program that follows: @p kind ("frame", "warning"), @p text. JSON only. */
void progress_event(const struct progress *progress, const char *kind, const char *text);

/** End with the status that the program will return; leaves the terminal clean and unregisters the hook. */
void progress_end(struct progress *progress, int status);

/** Estimated wall time to the end, s; negative: not known yet. */
double progress_remaining(const struct progress *progress);

/** Of the last minute: steps and particle updates per second, coupling iterations per step. */
void progress_rates(const struct progress *progress, double *steps, double *updates, double *iterations);

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/progress.h"

#include "base/log.h"
#include "base/timer.h"
#include "run/json.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

static const double redraw_seconds = 0.2, sample_seconds = 1.0, told_seconds = 60.0, told_parts = 20.0,
                    report_seconds = 1.0;

#define CLEAR_LINE "\r\033[K"

// Clears whatever stands on the terminal's line; the next redraw brings the progress back. It needs to know
// nothing of the run, and so no global.
static void line_clear(void)
{
    fputs(CLEAR_LINE, stderr);
    fflush(stderr);
}

static double fraction_at(const struct progress_setup *setup, long step, double t)
{
    double time = setup->t_end > setup->t ? (t - setup->t) / (setup->t_end - setup->t) : 0.0;
    double steps = setup->step_end > setup->step
                       ? (double)(step - setup->step) / (double)(setup->step_end - setup->step)
                       : 0.0;
    return fmin(1.0, fmax(0.0, fmax(time, steps)));
}

void progress_start(struct progress *progress, const struct progress_setup *setup)
{
    const char *term = getenv("TERM"), *no_colour = getenv("NO_COLOR");
    memset(progress, 0, sizeof *progress);
    progress->setup = *setup;
    progress->terminal = !setup->quiet && isatty(STDERR_FILENO) && term && strcmp(term, "dumb") != 0;
    progress->colour = progress->terminal && !(no_colour && no_colour[0]);
    progress->started = progress->told = progress->reported = timer_now();
    progress->drawn = progress->started - redraw_seconds;
    progress->t = setup->t;
    progress->now = (struct progress_sample){.wall = progress->started, .step = setup->step};
    progress->samples[0] = progress->now;
    progress->n_samples = 1;
    if (progress->terminal)
        log_set_hook(line_clear);
    if (setup->json) {
        fputs("{\"ev\": \"start\", \"t\": ", stdout);
        json_number(stdout, setup->t);
        fputs(", \"t_end\": ", stdout);
        json_number(stdout, setup->t_end);
        printf(", \"step\": %ld}\n", setup->step);
        fflush(stdout);
    }
}

static const struct progress_sample *oldest(const struct progress *progress)
{
    size_t n = progress->n_samples;
    return &progress->samples[n <= PROGRESS_SAMPLES ? 0 : n % PROGRESS_SAMPLES];
}

double progress_remaining(const struct progress *progress)
{
    const struct progress_sample *old = oldest(progress);
    double done = progress->now.fraction - old->fraction, wall = progress->now.wall - old->wall;
    return done > 0.0 && wall > 0.0 ? (1.0 - progress->now.fraction) * wall / done : -1.0;
}

void progress_rates(const struct progress *progress, double *steps, double *updates, double *iterations)
{
    const struct progress_sample *old = oldest(progress), *now = &progress->now;
    double wall = fmax(now->wall - old->wall, 1e-9), n = (double)(now->step - old->step);
    *steps = n / wall;
    *updates = (now->updates - old->updates) / wall;
    *iterations = n > 0.0 ? (double)(now->iterations - old->iterations) / n : 0.0;
}

static void duration_print(char *text, size_t size, double seconds)
{
    if (seconds < 0.0) {
        snprintf(text, size, "-:--");
        return;
    }
    long s = lround(fmin(seconds, 3.6e9));
    if (s < 3600)
        snprintf(text, size, "%ld:%02ld", s / 60, s % 60);
    else
        snprintf(text, size, "%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
}

static void line_print(const struct progress *progress, char *text, size_t size)
{
    char left[32], coupling[40] = "";
    double steps, updates, iterations;
    progress_rates(progress, &steps, &updates, &iterations);
    duration_print(left, sizeof left, progress_remaining(progress));
    if (iterations > 0.0)
        snprintf(coupling, sizeof coupling, "  %.2f iterations", iterations);
    snprintf(text, size,
             "%5.1f %%  t = %.4g of %.4g s  step %ld  dt = %.3g s  %.4g steps/s  %.3g M updates/s%s  ETA %s",
             100.0 * progress->now.fraction, progress->t, progress->setup.t_end, progress->now.step,
             progress->dt, steps, 1e-6 * updates, coupling, left);
}

// One line, never longer than the terminal is wide: a wrapped line could not be cleared.
static void line_draw(struct progress *progress)
{
    enum { PERCENT = 7 }; // letters of the percentage, which is bold
    char text[256];
    struct winsize window;
    size_t width = ioctl(STDERR_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col > 0 ? window.ws_col : 80;
    line_print(progress, text, sizeof text);
    if (strlen(text) >= width)
        text[width - 1] = '\0';
    if (progress->colour && strlen(text) > PERCENT)
        fprintf(stderr, CLEAR_LINE "\033[1m%.*s\033[0m%s", PERCENT, text, text + PERCENT);
    else
        fprintf(stderr, CLEAR_LINE "%s", text);
    fflush(stderr);
    progress->drawn = progress->now.wall;
}

// Which twentieth of the run has been reached.
static long part_reached(const struct progress *progress)
{
    return (long)floor(progress->now.fraction * told_parts + 1e-9);
}

static void line_tell(struct progress *progress)
{
    char text[256];
    line_print(progress, text, sizeof text);
    log_message(progress->terminal || progress->setup.quiet ? LOG_DETAIL : LOG_INFO, "%s", text);
    progress->told = progress->now.wall;
    progress->told_part = part_reached(progress);
}

static void json_state(const struct progress *progress, const char *event)
{
    double steps, updates, iterations;
    progress_rates(progress, &steps, &updates, &iterations);
    const struct {
        const char *name;
        double value;
    } pairs[] = {{"t", progress->t},
                 {"dt", progress->dt},
                 {"fraction", progress->now.fraction},
                 {"steps_per_s", steps},
                 {"updates_per_s", updates},
                 {"iterations", iterations},
                 {"wall_s", progress->now.wall - progress->started},
                 {"eta_s", progress_remaining(progress) < 0.0 ? NAN : progress_remaining(progress)}};
    printf("{\"ev\": \"%s\", \"step\": %ld", event, progress->now.step);
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; ++i) {
        printf(", \"%s\": ", pairs[i].name);
        json_number(stdout, pairs[i].value);
    }
}

static void json_progress(struct progress *progress)
{
    json_state(progress, "progress");
    fputs("}\n", stdout);
    fflush(stdout);
    progress->reported = progress->now.wall;
}

void progress_update(struct progress *progress, long step, double t, double dt, size_t particles,
                     int iterations)
{
    struct progress_sample *now = &progress->now;
    now->wall = timer_now();
    now->fraction = fraction_at(&progress->setup, step, t);
    now->updates += (double)particles * (double)(step - now->step);
    now->iterations += iterations;
    now->step = step;
    progress->t = t;
    progress->dt = dt;
    if (progress->terminal && now->wall - progress->drawn >= redraw_seconds)
        line_draw(progress);
    if (now->wall - progress->told >= told_seconds || part_reached(progress) > progress->told_part)
        line_tell(progress);
    if (progress->setup.json && now->wall - progress->reported >= report_seconds)
        json_progress(progress);
    if (now->wall - progress->samples[(progress->n_samples - 1) % PROGRESS_SAMPLES].wall >= sample_seconds)
        progress->samples[progress->n_samples++ % PROGRESS_SAMPLES] = *now;
}

void progress_event(const struct progress *progress, const char *kind, const char *text)
{
    if (!progress->setup.json)
        return;
    fputs("{\"ev\": \"event\", \"kind\": ", stdout);
    json_text(stdout, kind);
    fputs(", \"text\": ", stdout);
    json_text(stdout, text);
    fputs(", \"t\": ", stdout);
    json_number(stdout, progress->t);
    printf(", \"step\": %ld}\n", progress->now.step);
    fflush(stdout);
}

void progress_end(struct progress *progress, int status)
{
    progress->now.wall = timer_now();
    if (progress->terminal) {
        line_clear();
        log_set_hook(NULL);
    }
    if (progress->setup.json) {
        json_state(progress, "end");
        printf(", \"status\": %d}\n", status);
        fflush(stdout);
    }
    progress->terminal = false;
}

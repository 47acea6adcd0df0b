// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/summary.h"

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/log.h"
#include "base/memory.h"
#include "run/json.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

static double rate(const struct summary *summary)
{
    return summary->wall_s > 0.0 ? summary->updates / summary->wall_s : 0.0;
}

static void text_pair(FILE *stream, const char *name, const char *text)
{
    fputs(",\n  ", stream);
    json_text(stream, name);
    fputs(": ", stream);
    json_text(stream, text);
}

static void number_pair(FILE *stream, const char *name, double value)
{
    fputs(",\n  ", stream);
    json_text(stream, name);
    fputs(": ", stream);
    json_number(stream, value);
}

// An object of pairs; a unit makes the value an object of its own.
static void pairs_write(FILE *stream, const char *name, const struct summary_pair *pairs, size_t n)
{
    fputs(",\n  ", stream);
    json_text(stream, name);
    fputs(": {", stream);
    for (size_t i = 0; i < n; ++i) {
        fputs(i > 0 ? ",\n    " : "\n    ", stream);
        json_text(stream, pairs[i].name);
        fputs(pairs[i].unit ? ": {\"value\": " : ": ", stream);
        json_number(stream, pairs[i].value);
        if (pairs[i].unit) {
            fputs(", \"unit\": ", stream);
            json_text(stream, pairs[i].unit);
            fputc('}', stream);
        }
    }
    fputs(n > 0 ? "\n  }" : "}", stream);
}

// The model name of the first processor, or "unknown".
static void processor_read(char *name, size_t size)
{
    char line[256];
    FILE *stream = fopen("/proc/cpuinfo", "r");
    snprintf(name, size, "unknown");
    while (stream && fgets(line, sizeof line, stream)) {
        const char *colon = strchr(line, ':');
        if (colon && strncmp(line, "model name", 10) == 0) {
            line[strcspn(line, "\n")] = '\0';
            snprintf(name, size, "%s", colon[1] == ' ' ? colon + 2 : colon + 1);
            break;
        }
    }
    if (stream)
        fclose(stream);
}

static void machine_write(FILE *stream)
{
    char processor[256], host[256] = "";
    processor_read(processor, sizeof processor);
    if (gethostname(host, sizeof host - 1) != 0)
        host[0] = '\0';
    fputs(",\n  \"machine\": {\n    \"processor\": ", stream);
    json_text(stream, processor);
    fprintf(stream, ",\n    \"cores\": %ld,\n    \"host\": ", sysconf(_SC_NPROCESSORS_ONLN));
    json_text(stream, host);
    fputs("\n  }", stream);
}

static void phases_write(FILE *stream, const struct timer *timer)
{
    struct summary_pair pairs[TIMER_PHASES];
    for (int p = 0; p < TIMER_PHASES; ++p)
        pairs[p] = (struct summary_pair){timer_phase_name((enum timer_phase)p), timer->seconds[p], NULL};
    pairs_write(stream, "phases_s", pairs, TIMER_PHASES);
}

static void json_write(FILE *stream, const struct summary *summary)
{
    fputs("{\n  \"program\": \"skerry\"", stream);
    text_pair(stream, "version", summary->version);
    text_pair(stream, "revision", summary->revision);
    text_pair(stream, "deck", summary->deck);
    char hash[HASH_TEXT];
    hash_print(summary->deck_hash, hash);
    text_pair(stream, "deck_hash", hash);
    machine_write(stream);
    fprintf(stream, ",\n  \"status\": %d,\n  \"particles\": %zu,\n  \"dim\": %d,\n  \"threads\": %d",
            summary->status, summary->particles, summary->dim, summary->threads);
    text_pair(stream, "isa", summary->isa ? summary->isa : "none");
    fprintf(stream, ",\n  \"steps\": %ld,\n  \"files\": %ld", summary->steps, summary->files);
    number_pair(stream, "t", summary->t);
    number_pair(stream, "wall_s", summary->wall_s);
    number_pair(stream, "updates_per_s", rate(summary));
    number_pair(stream, "iterations_mean", summary->iterations_mean);
    for (size_t i = 0; i < summary->n_numbers; ++i)
        number_pair(stream, summary->numbers[i].name, summary->numbers[i].value);
    fprintf(stream, ",\n  \"warnings\": %ld", log_warnings());
    pairs_write(stream, "parameters", summary->parameters, summary->n_parameters);
    fputs(",\n  \"overrides\": [", stream);
    for (size_t i = 0; i < summary->n_overrides; ++i) {
        fputs(i > 0 ? ", " : "", stream);
        json_text(stream, summary->overrides[i]);
    }
    fputc(']', stream);
    pairs_write(stream, "balances", summary->balances, summary->n_balances);
    phases_write(stream, summary->timer);
    fputs("\n}\n", stream);
}

int summary_write(const struct summary *summary, const char *path)
{
    struct file_atomic file;
    CALL(file_atomic_open(&file, path));
    json_write(file.stream, summary);
    return file_atomic_commit(&file);
}

void summary_print(const struct summary *summary)
{
    double all = fmax(summary->wall_s, 1e-9), known = 0.0;
    char iterations[64] = "";
    if (summary->iterations_mean > 0.0)
        snprintf(iterations, sizeof iterations, ", %.2f coupling iterations a step",
                 summary->iterations_mean);
    log_message(LOG_INFO, "reached t = %.6g s after %ld steps in %.1f s%s", summary->t, summary->steps,
                summary->wall_s, iterations);
    if (summary->particles > 0)
        log_message(LOG_INFO, "%zu particles, %.3g M updates/s on %d thread%s, instruction set %s",
                    summary->particles, 1e-6 * rate(summary), summary->threads,
                    summary->threads == 1 ? "" : "s", summary->isa ? summary->isa : "none");
    log_message(LOG_INFO, "wall time by phase:");
    for (int p = 0; p < TIMER_PHASES; ++p) {
        double seconds = summary->timer->seconds[p];
        known += seconds;
        log_message(LOG_INFO, "  %-12s %10.2f s %6.1f %%", timer_phase_name((enum timer_phase)p), seconds,
                    100.0 * seconds / all);
    }
    double rest = fmax(0.0, summary->wall_s - known);
    log_message(LOG_INFO, "  %-12s %10.2f s %6.1f %%", "other", rest, 100.0 * rest / all);
    if (summary->n_balances > 0)
        log_message(LOG_INFO, "balances:");
    for (size_t i = 0; i < summary->n_balances; ++i)
        log_message(LOG_INFO, "  %-32s %.9g %s", summary->balances[i].name, summary->balances[i].value,
                    summary->balances[i].unit ? summary->balances[i].unit : "");
    if (log_warnings() > 0)
        log_message(LOG_INFO, "%ld warnings", log_warnings());
    log_message(LOG_INFO, "%ld files written", summary->files);
}

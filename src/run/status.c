// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/status.h"

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"
#include "output/checkpoint.h"
#include "run/json.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { STATUS_LIMIT = 1 << 16 }; // bytes of status.json

static void number_pair(FILE *stream, const char *name, double value)
{
    fprintf(stream, ",\n  \"%s\": ", name);
    json_number(stream, value);
}

int status_write(const struct status_report *report, const char *path)
{
    struct file_atomic file;
    char host[256] = "";
    CALL(file_atomic_open(&file, path));
    FILE *stream = file.stream;
    const bool saved = report->checkpoint_step >= 0;
    if (gethostname(host, sizeof host - 1) != 0)
        host[0] = '\0';
    fputs("{\n  \"state\": ", stream);
    json_text(stream, report->state);
    fprintf(stream, ",\n  \"pid\": %ld,\n  \"host\": ", (long)getpid());
    json_text(stream, host);
    fprintf(stream, ",\n  \"step\": %ld,\n  \"particles\": %zu", report->step, report->particles);
    number_pair(stream, "t", report->t);
    number_pair(stream, "t_end", report->t_end);
    number_pair(stream, "dt", report->dt);
    number_pair(stream, "fraction", report->fraction);
    number_pair(stream, "wall_s", report->wall_s);
    number_pair(stream, "eta_s", report->eta_s < 0.0 ? NAN : report->eta_s);
    number_pair(stream, "updates_per_s", report->updates_per_s);
    number_pair(stream, "checkpoint_step", saved ? (double)report->checkpoint_step : NAN);
    number_pair(stream, "checkpoint_t", saved ? report->checkpoint_t : NAN);
    fputs("\n}\n", stream);
    return file_atomic_commit(&file);
}

/** "3 s", "12 min", "4.5 h" */
static void age_print(FILE *stream, double seconds)
{
    if (seconds < 120.0)
        fprintf(stream, "%.0f s", fmax(seconds, 0.0));
    else if (seconds < 7200.0)
        fprintf(stream, "%.0f min", seconds / 60.0);
    else
        fprintf(stream, "%.1f h", seconds / 3600.0);
}

/** How many seconds ago a file was written; < 0: it is not there. */
static double file_age(const char *path)
{
    struct stat about;
    struct timespec now;
    if (stat(path, &about) || clock_gettime(CLOCK_REALTIME, &now))
        return -1.0;
    return (double)(now.tv_sec - about.st_mtim.tv_sec) + 1e-9 * (double)(now.tv_nsec - about.st_mtim.tv_nsec);
}

/** Whether a process of this machine has the folder of a run that has not ended itself. */
static bool folder_taken(const char *output)
{
    int lock;
    const bool taken = file_lock_folder(output, &lock) != 0;
    if (lock >= 0)
        close(lock);
    return taken;
}

static void state_print(const char *text, const char *output, FILE *stream)
{
    char state[32] = "in an unknown state", host[256] = "";
    double pid = 0.0;
    json_find_text(text, "state", state, sizeof state);
    json_find_text(text, "host", host, sizeof host);
    json_find_number(text, "pid", &pid);
    fprintf(stream, "%s: ", output);
    if (strcmp(state, "running") != 0)
        fprintf(stream, "%s\n", state);
    else if (folder_taken(output))
        fprintf(stream, "running (process %.0f on %s)\n", pid, host);
    else
        fprintf(
            stream,
            "ended from outside (process %.0f on %s was killed, or the machine went down), unless it runs on "
            "another machine\n",
            pid, host);
}

static void progress_print(const char *text, FILE *stream)
{
    double fraction, t, t_end, step, particles = 0.0, rate = 0.0, wall = 0.0, eta = -1.0;
    if (!json_find_number(text, "fraction", &fraction) || !json_find_number(text, "t", &t) ||
        !json_find_number(text, "t_end", &t_end) || !json_find_number(text, "step", &step)) {
        fputs("  status.json is damaged\n", stream);
        return;
    }
    json_find_number(text, "particles", &particles);
    json_find_number(text, "updates_per_s", &rate);
    json_find_number(text, "wall_s", &wall);
    fprintf(stream, "  %.1f %%: t = %.6g of %.6g s, step %.0f\n", 100.0 * fraction, t, t_end, step);
    if (particles > 0.0)
        fprintf(stream, "  %.0f particles, %.3g M updates/s\n", particles, 1e-6 * rate);
    fputs("  wall time ", stream);
    age_print(stream, wall);
    if (json_find_number(text, "eta_s", &eta) && eta > 0.0) {
        fputs(", to go ", stream);
        age_print(stream, eta);
    }
    fputc('\n', stream);
}

static void checkpoint_print(const char *text, const char *output, FILE *stream)
{
    char state[32] = "";
    const bool done = json_find_text(text, "state", state, sizeof state) && strcmp(state, "done") == 0;
    double t = NAN, step = -1.0;
    char *folder = memory_print("%s/checkpoint", output);
    const int64_t newest = folder ? checkpoint_newest(folder) : -1;
    char *path = folder ? memory_print("%s/step_%09" PRId64 ".manifest", folder, newest) : NULL;
    if (newest < 0) {
        fputs("  no checkpoint\n", stream);
    } else {
        fprintf(stream, "  newest checkpoint: step %" PRId64, newest);
        if (json_find_number(text, "checkpoint_step", &step) && step == (double)newest &&
            json_find_number(text, "checkpoint_t", &t))
            fprintf(stream, ", t = %.6g s", t);
        fputs(", ", stream);
        age_print(stream, path ? file_age(path) : 0.0);
        fprintf(stream, " ago; to go %s: skerry resume %s\n", done ? "further" : "on", output);
    }
    memory_free(path);
    memory_free(folder);
}

int status_print(const char *output, FILE *stream)
{
    char *path = memory_print("%s/status.json", output), *text = NULL;
    size_t size;
    CHECK_MEMORY(path);
    if (access(path, R_OK)) {
        memory_free(path);
        return error_report(STATUS_NO_INPUT, "%s: is not the output folder of a run (it has no status.json)",
                            output);
    }
    const int status = file_read(path, STATUS_LIMIT, &text, &size);
    if (!status) {
        state_print(text, output, stream);
        progress_print(text, stream);
        checkpoint_print(text, output, stream);
        fputs("  status written ", stream);
        age_print(stream, file_age(path));
        fputs(" ago\n", stream);
    }
    memory_free(text);
    memory_free(path);
    return status;
}

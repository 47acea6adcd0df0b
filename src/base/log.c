// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/log.h"

#include "base/error.h"

#include <errno.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

// The process's one global: the sink of all messages.
static struct {
    pthread_mutex_t lock;
    enum log_level level;
    FILE *files[4]; // the log of a run, and those that the user asked for
    size_t n_files;
    long warnings;
    void (*hook)(void);
} sink = {.lock = PTHREAD_MUTEX_INITIALIZER, .level = LOG_INFO};

void log_set_level(enum log_level level)
{
    pthread_mutex_lock(&sink.lock);
    sink.level = level;
    pthread_mutex_unlock(&sink.lock);
}

int log_open(const char *path)
{
    FILE *file = fopen(path, "ae");

    CHECK(file, STATUS_IO, "%s: cannot open the log file: %s", path, strerror(errno));
    pthread_mutex_lock(&sink.lock);
    const bool room = sink.n_files < sizeof sink.files / sizeof *sink.files;
    if (room)
        sink.files[sink.n_files++] = file;
    pthread_mutex_unlock(&sink.lock);
    if (!room)
        fclose(file);
    CHECK(room, STATUS_IO, "%s: too many log files are open", path);
    return STATUS_OK;
}

void log_close(void)
{
    pthread_mutex_lock(&sink.lock);
    while (sink.n_files > 0)
        fclose(sink.files[--sink.n_files]);
    pthread_mutex_unlock(&sink.lock);
}

static void print_line(FILE *stream, const char *prefix, const char *format, va_list arguments)
{
    va_list copy;

    va_copy(copy, arguments);
    fputs(prefix, stream);
    vfprintf(stream, format, copy);
    fputc('\n', stream);
    fflush(stream);
    va_end(copy);
}

void log_message_v(enum log_level level, const char *format, va_list arguments)
{
    const char *prefix = level == LOG_ERROR     ? "skerry: error: "
                         : level == LOG_WARNING ? "skerry: warning: "
                                                : "";

    pthread_mutex_lock(&sink.lock);
    if (level == LOG_WARNING)
        sink.warnings++;
    if (level <= sink.level) {
        if (sink.hook)
            sink.hook();
        print_line(stderr, prefix, format, arguments);
    }
    for (size_t i = 0; i < sink.n_files; i++)
        print_line(sink.files[i], prefix, format, arguments);
    pthread_mutex_unlock(&sink.lock);
}

void log_message(enum log_level level, const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    log_message_v(level, format, arguments);
    va_end(arguments);
}

long log_warnings(void)
{
    pthread_mutex_lock(&sink.lock);
    const long warnings = sink.warnings;
    pthread_mutex_unlock(&sink.lock);
    return warnings;
}

void log_set_hook(void (*hook)(void))
{
    pthread_mutex_lock(&sink.lock);
    sink.hook = hook;
    pthread_mutex_unlock(&sink.lock);
}

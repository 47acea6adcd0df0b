// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/history.h"

#include "base/error.h"
#include "base/log.h"
#include "base/memory.h"

#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static int row_end(struct history *history)
{
    fputc('\n', history->stream);
    CHECK(fflush(history->stream) == 0 && !ferror(history->stream), STATUS_IO, "%s: cannot write: %s",
          history->path, strerror(errno));
    return 0;
}

// A name with a comma or a quotation mark is quoted (RFC 4180).
static void name_write(FILE *stream, const char *name)
{
    bool quote = strpbrk(name, ",\"\n") != NULL;
    if (quote)
        fputc('"', stream);
    for (; *name; ++name) {
        if (*name == '"')
            fputc('"', stream);
        fputc(*name, stream);
    }
    if (quote)
        fputc('"', stream);
}

// The first line: names with units.
static void header_write(FILE *stream, const char *const *columns, int n)
{
    for (int i = 0; i < n; ++i) {
        if (i > 0)
            fputc(',', stream);
        name_write(stream, columns[i]);
    }
}

static int history_open(struct history *history, const char *path, const char *mode, int n)
{
    memset(history, 0, sizeof *history);
    FILE *stream = fopen(path, mode);
    CHECK(stream, STATUS_IO, "%s: cannot open for writing: %s", path, strerror(errno));
    history->path = memory_text(path);
    if (!history->path) {
        fclose(stream);
        return STATUS_MEMORY;
    }
    history->stream = stream;
    history->columns = n;
    return 0;
}

int history_create(struct history *history, const char *path, const char *const *columns, int n)
{
    CALL(history_open(history, path, "we", n));
    header_write(history->stream, columns, n);
    int status = row_end(history);
    if (status)
        (void)history_close(history);
    return status;
}

// Whether a line is the header that history_create would write.
static bool header_good(const char *line, const char *const *columns, int n)
{
    char *header = NULL;
    size_t size;
    FILE *stream = open_memstream(&header, &size);
    if (!stream)
        return false;
    header_write(stream, columns, n);
    fputc('\n', stream);
    const bool good = fclose(stream) == 0 && strcmp(header, line) == 0;
    free(header);
    return good;
}

// Bytes up to the first row that does not count: later than t, or torn.
static int rows_measure(FILE *stream, const char *path, const char *const *columns, int n, double t,
                        off_t *size)
{
    char *line = NULL;
    size_t capacity = 0;
    ssize_t length = getline(&line, &capacity, stream);
    const bool good = length > 0 && header_good(line, columns, n);
    *size = good ? length : 0;
    while (good && (length = getline(&line, &capacity, stream)) > 0 && line[length - 1] == '\n' &&
           strtod(line, NULL) <= t)
        *size += length;
    free(line);
    CHECK(good, STATUS_IO,
          "%s: its first line is not that of this history: move the file away, and a new one is begun", path);
    return 0;
}

int history_check(const char *path, const char *const *columns, int n)
{
    off_t size;
    FILE *stream = fopen(path, "re");
    if (!stream && errno == ENOENT)
        return 0;
    CHECK(stream, STATUS_IO, "%s: cannot open: %s", path, strerror(errno));
    const int status = rows_measure(stream, path, columns, n, -INFINITY, &size);
    fclose(stream);
    return status;
}

int history_resume(struct history *history, const char *path, const char *const *columns, int n, double t)
{
    off_t size;
    FILE *stream = fopen(path, "re");
    if (!stream && errno == ENOENT) {
        log_message(LOG_WARNING, "%s: is missing: the history begins anew", path);
        return history_create(history, path, columns, n);
    }
    CHECK(stream, STATUS_IO, "%s: cannot open: %s", path, strerror(errno));
    const int status = rows_measure(stream, path, columns, n, t, &size);
    fclose(stream);
    CALL(status);
    CHECK(truncate(path, size) == 0, STATUS_IO, "%s: cannot cut off later rows: %s", path, strerror(errno));
    return history_open(history, path, "ae", n);
}

int history_sync(const struct history *history)
{
    CHECK(fsync(fileno(history->stream)) == 0, STATUS_IO, "%s: cannot sync: %s", history->path,
          strerror(errno));
    return 0;
}

int history_row(struct history *history, const double *values)
{
    for (int i = 0; i < history->columns; ++i)
        fprintf(history->stream, i > 0 ? ",%.17g" : "%.17g", values[i]);
    return row_end(history);
}

int history_close(struct history *history)
{
    int status = 0;
    if (history->stream && fclose(history->stream) != 0)
        status = error_report(STATUS_IO, "%s: cannot write: %s", history->path, strerror(errno));
    memory_free(history->path);
    memset(history, 0, sizeof *history);
    return status;
}

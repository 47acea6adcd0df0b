// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/history.h"

#include "base/error.h"
#include "base/memory.h"

#include <errno.h>
#include <stdbool.h>
#include <string.h>

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

int history_create(struct history *history, const char *path, const char *const *columns, int n)
{
    memset(history, 0, sizeof *history);
    FILE *stream = fopen(path, "w");
    CHECK(stream, STATUS_IO, "%s: cannot create: %s", path, strerror(errno));
    history->path = memory_text(path);
    if (!history->path) {
        fclose(stream);
        return STATUS_MEMORY;
    }
    history->stream = stream;
    history->columns = n;
    for (int i = 0; i < n; ++i) {
        if (i > 0)
            fputc(',', stream);
        name_write(stream, columns[i]);
    }
    int status = row_end(history);
    if (status)
        (void)history_close(history);
    return status;
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

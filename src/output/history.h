// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef OUTPUT_HISTORY_H
#define OUTPUT_HISTORY_H

#include <stdio.h>

/** A CSV file that grows by rows: header "t [s],name [unit],...", %.17g values, flushed every row. */
struct history {
    FILE *stream;
    char *path;
    int columns;
};

/** @p columns: names with units, e.g. "t [s]". Returns a status. */
int history_create(struct history *history, const char *path, const char *const *columns, int n);

/** Whether history_resume could go on with the file @p path. Returns a status (STATUS_IO, reported: its first
 * line is another). */
int history_check(const char *path, const char *const *columns, int n);

/** Go on with a file of history_create after its last row of time (first column) @p t or before; rows behind
 * it, and a torn last line, are cut off. A file that is missing is begun anew with a warning. Returns a
 * status (STATUS_IO, reported: its first line is another). */
int history_resume(struct history *history, const char *path, const char *const *columns, int n, double t);

/** Make all rows so far last through a power cut. Returns a status. */
int history_sync(const struct history *history);

int history_row(struct history *history, const double *values);
int history_close(struct history *history);

#endif

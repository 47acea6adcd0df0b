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
int history_row(struct history *history, const double *values);
int history_close(struct history *history);

#endif

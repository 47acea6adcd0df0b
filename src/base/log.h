// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef BASE_LOG_H
#define BASE_LOG_H

#include <stdarg.h>

/** What a message is; those below the level of the terminal go to the log file only. */
enum log_level { LOG_ERROR, LOG_WARNING, LOG_INFO, LOG_DETAIL };

/** The log is the process's one deliberate global: messages go to stderr and, once opened, to a file.
 * Thread-safe (one line at a time). */

/** Print messages up to @p level on stderr (default LOG_INFO; -q: LOG_WARNING, -v: LOG_DETAIL). */
void log_set_level(enum log_level level);

/** Also append every message to @p path from now on, beside the files opened before (at most 4). Returns 0 or
 * STATUS_IO. */
int log_open(const char *path);

/** Close all log files. */
void log_close(void);

/** One line, without newline; errors and warnings get "skerry: error: " / "skerry: warning: " in front. */
void log_message(enum log_level level, const char *format, ...) __attribute__((format(printf, 2, 3)));
void log_message_v(enum log_level level, const char *format, va_list arguments);

/** Number of warnings since the start of the process. */
long log_warnings(void);

/** Called before a line is printed on stderr (the progress line clears itself); NULL: none. */
void log_set_hook(void (*hook)(void));

#endif

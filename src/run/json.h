// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RUN_JSON_H
#define RUN_JSON_H

#include <stdio.h>

/** Values of JSON; what stands between them the caller writes. */

/** @p text in quotation marks, escaped; bytes that are not UTF-8 become '?'. */
void json_text(FILE *stream, const char *text);

/** A number with 17 digits; null for what JSON cannot say (NaN, infinity). */
void json_number(FILE *stream, double value);

#endif

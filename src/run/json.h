// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RUN_JSON_H
#define RUN_JSON_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/** Values of JSON; what stands between them the caller writes. */

/** @p text in quotation marks, escaped; bytes that are not UTF-8 become '?'. */
void json_text(FILE *stream, const char *text);

/** A number with 17 digits; null for what JSON cannot say (NaN, infinity). */
void json_number(FILE *stream, double value);

/** Find the value of @p key in the flat object @p text that was written with these functions. False (then the
 * value is as it was) when it is missing or of another kind; texts are not unescaped. */
bool json_find_number(const char *text, const char *key, double *value);
bool json_find_text(const char *text, const char *key, char *value, size_t size);

#endif

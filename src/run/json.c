// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/json.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

// Length of the UTF-8 sequence at @p text, 0 if it is none.
static size_t sequence(const unsigned char *text)
{
    size_t n = text[0] < 0x80 ? 1 : text[0] < 0xC2 ? 0 : text[0] < 0xE0 ? 2 : text[0] < 0xF0 ? 3 : 4;
    if (text[0] > 0xF4)
        return 0;
    for (size_t i = 1; i < n; ++i)
        if ((text[i] & 0xC0) != 0x80)
            return 0;
    bool overlong = (text[0] == 0xE0 && text[1] < 0xA0) || (text[0] == 0xF0 && text[1] < 0x90);
    bool surrogate = text[0] == 0xED && text[1] > 0x9F;
    bool beyond = text[0] == 0xF4 && text[1] > 0x8F;
    return overlong || surrogate || beyond ? 0 : n;
}

void json_text(FILE *stream, const char *text)
{
    const unsigned char *at = (const unsigned char *)text;
    fputc('"', stream);
    while (*at) {
        size_t n = sequence(at);
        if (*at == '"' || *at == '\\')
            fprintf(stream, "\\%c", *at);
        else if (*at < 0x20)
            fprintf(stream, "\\u%04x", *at);
        else if (n == 0)
            fputc('?', stream);
        else
            fwrite(at, 1, n, stream);
        at += n > 0 ? n : 1;
    }
    fputc('"', stream);
}

void json_number(FILE *stream, double value)
{
    if (isfinite(value))
        fprintf(stream, "%.17g", value);
    else
        fputs("null", stream);
}

// Behind "key": and blanks, or NULL.
static const char *value_of(const char *text, const char *key)
{
    const size_t length = strlen(key);
    for (const char *at = text; (at = strchr(at, '"')); ++at)
        if (strncmp(at + 1, key, length) == 0 && strncmp(at + 1 + length, "\":", 2) == 0)
            return at + length + 3 + strspn(at + length + 3, " ");
    return NULL;
}

bool json_find_number(const char *text, const char *key, double *value)
{
    const char *found = value_of(text, key);
    char *end;
    const double number = found ? strtod(found, &end) : 0.0;
    if (!found || end == found)
        return false;
    *value = number;
    return true;
}

bool json_find_text(const char *text, const char *key, char *value, size_t size)
{
    const char *found = value_of(text, key);
    const size_t length = found && *found == '"' ? strcspn(found + 1, "\"") : size;
    if (length >= size)
        return false;
    memcpy(value, found + 1, length);
    value[length] = '\0';
    return true;
}

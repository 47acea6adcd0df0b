// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/xml.h"

#include <string.h>

static const struct {
    char letter;
    const char *entity;
} escapes[] = {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};

enum { N_ESCAPES = sizeof escapes / sizeof escapes[0] };

void xml_write(FILE *stream, const char *text)
{
    for (; *text; ++text) {
        int e = 0;
        while (e < N_ESCAPES && escapes[e].letter != *text)
            ++e;
        if (e < N_ESCAPES)
            fputs(escapes[e].entity, stream);
        else
            fputc(*text, stream);
    }
}

bool xml_next(struct xml_span *rest, struct xml_span *tag)
{
    const char *open = memchr(rest->begin, '<', (size_t)(rest->end - rest->begin));
    const char *close = open ? memchr(open, '>', (size_t)(rest->end - open)) : NULL;
    if (!close)
        return false;
    *tag = (struct xml_span){open + 1, close};
    rest->begin = close + 1;
    return true;
}

bool xml_is(const struct xml_span *tag, const char *name)
{
    size_t n = strlen(name), length = (size_t)(tag->end - tag->begin);
    return length >= n && memcmp(tag->begin, name, n) == 0 &&
           (length == n || strchr(" \t\r\n/", tag->begin[n]) != NULL);
}

static bool value_copy(const char *from, const char *end, char *value, size_t size)
{
    size_t n = 0;
    while (from < end) {
        char letter = *from;
        size_t skip = 1;
        for (int e = 0; e < N_ESCAPES; ++e) {
            size_t length = strlen(escapes[e].entity);
            if ((size_t)(end - from) >= length && memcmp(from, escapes[e].entity, length) == 0) {
                letter = escapes[e].letter;
                skip = length;
            }
        }
        if (n + 1 >= size || letter == '\0')
            return false;
        value[n++] = letter;
        from += skip;
    }
    value[n] = '\0';
    return true;
}

bool xml_attribute(const struct xml_span *tag, const char *name, char *value, size_t size)
{
    size_t n = strlen(name);
    const char *at = memchr(tag->begin, ' ', (size_t)(tag->end - tag->begin));
    while (at && at < tag->end) {
        while (at < tag->end && *at == ' ')
            ++at;
        const char *open = memchr(at, '"', (size_t)(tag->end - at));
        const char *close = open ? memchr(open + 1, '"', (size_t)(tag->end - open - 1)) : NULL;
        if (!close)
            return false;
        if ((size_t)(open - at) == n + 1 && memcmp(at, name, n) == 0 && at[n] == '=')
            return value_copy(open + 1, close, value, size);
        at = close + 1;
    }
    return false;
}

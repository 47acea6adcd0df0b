// SPDX-License-Identifier: GPL-3.0-or-later
#include "deck/deck_position.h"

#include "base/error.h"
#include "base/memory.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

/** A place in the text. */
struct cursor {
    const char *at;
    struct location where;
};

static void cursor_step(struct cursor *cursor)
{
    if (*cursor->at == '\n') {
        cursor->where.line++;
        cursor->where.column = 1;
    } else if ((cursor->at[1] & 0xC0) != 0x80) { // the bytes that continue a UTF-8 character do not count
        cursor->where.column++;
    }
    cursor->at++;
}

/** Go behind the next @p end; false at the end of the text. */
static bool cursor_skip(struct cursor *cursor, const char *end)
{
    const size_t length = strlen(end);
    while (*cursor->at && strncmp(cursor->at, end, length) != 0)
        cursor_step(cursor);
    if (!*cursor->at)
        return false;
    for (size_t i = 0; i < length; i++)
        cursor_step(cursor);
    return true;
}

static bool cursor_is(const struct cursor *cursor, const char *start)
{
    return strncmp(cursor->at, start, strlen(start)) == 0;
}

static void cursor_skip_any(struct cursor *cursor, const char *characters)
{
    while (*cursor->at && strchr(characters, *cursor->at))
        cursor_step(cursor);
}

static void cursor_skip_until(struct cursor *cursor, const char *characters)
{
    while (*cursor->at && !strchr(characters, *cursor->at))
        cursor_step(cursor);
}

/** The encoding that an XML declaration names must be UTF-8 (or ASCII, which is part of it). */
static int declaration_check(const struct cursor *cursor, char *message, size_t message_size)
{
    const char *end = strstr(cursor->at, "?>"), *name = strstr(cursor->at, "encoding");
    if (!end || !name || name > end)
        return 0;
    name += strlen("encoding");
    name += strspn(name, " \t\r\n=\"'");
    const size_t length = strcspn(name, "\"' ?>");
    if ((length == 5 && strncasecmp(name, "utf-8", 5) == 0) ||
        (length == 8 && strncasecmp(name, "us-ascii", 8) == 0))
        return 0;
    snprintf(message, message_size, "encoding \"%.*s\" is not supported: write the deck in UTF-8",
             length < 40 ? (int)length : 40, name);
    return STATUS_DECK;
}

static int positions_add_attribute(struct positions *positions, struct location where)
{
    CALL(memory_grow((void **)&positions->attributes, &positions->attribute_capacity,
                     positions->n_attributes + 1, sizeof *positions->attributes));
    positions->attributes[positions->n_attributes++] = where;
    positions->tags[positions->n_tags - 1].n++;
    return 0;
}

/** Read a start tag. @p open: whether an end tag must follow; @p whole: whether the tag was complete. */
static int positions_add_tag(struct positions *positions, struct cursor *cursor, bool *open, bool *whole)
{
    *whole = false;
    CALL(memory_grow((void **)&positions->tags, &positions->tag_capacity, positions->n_tags + 1,
                     sizeof *positions->tags));
    positions->tags[positions->n_tags++] =
        (struct position_tag){.where = cursor->where, .first = positions->n_attributes};
    cursor_skip_until(cursor, " \t\r\n/>");
    for (;;) {
        cursor_skip_any(cursor, " \t\r\n");
        if (*cursor->at == '>' || cursor_is(cursor, "/>")) {
            *open = *cursor->at == '>';
            *whole = true;
            cursor_skip(cursor, ">");
            return 0;
        }
        struct location where = cursor->where;
        const char *name = cursor->at;
        cursor_skip_until(cursor, " \t\r\n=/><\"'");
        bool is_namespace = strncmp(name, "xmlns", 5) == 0 && (name[5] == ':' || name + 5 == cursor->at);
        cursor_skip_any(cursor, " \t\r\n");
        if (*cursor->at != '=')
            return 0;
        cursor_step(cursor);
        cursor_skip_any(cursor, " \t\r\n");
        const char quote[2] = {*cursor->at, '\0'};
        if (*quote != '"' && *quote != '\'')
            return 0;
        cursor_step(cursor);
        if (!cursor_skip(cursor, quote))
            return 0;
        if (!is_namespace) // the parser does not count these as attributes either
            CALL(positions_add_attribute(positions, where));
    }
}

int positions_scan(struct positions *positions, const char *text, struct location *where, char *message,
                   size_t message_size)
{
    struct cursor cursor = {text, {1, 1}};
    *positions = (struct positions){0};
    if (cursor_is(&cursor, "\xEF\xBB\xBF"))
        cursor.at += 3;
    bool whole = true;
    int depth = 0;
    while (whole && *cursor.at) {
        *where = cursor.where;
        bool open = false;
        if (*cursor.at != '<') {
            cursor_step(&cursor);
        } else if (cursor_is(&cursor, "<!--")) {
            whole = cursor_skip(&cursor, "-->");
        } else if (cursor_is(&cursor, "<![CDATA[")) {
            whole = cursor_skip(&cursor, "]]>");
        } else if (cursor_is(&cursor, "<?")) {
            if (cursor_is(&cursor, "<?xml "))
                CALL(declaration_check(&cursor, message, message_size));
            whole = cursor_skip(&cursor, "?>");
        } else if (cursor_is(&cursor, "<!")) {
            snprintf(message, message_size,
                     "a deck must not have a document type (<!DOCTYPE ...>) or entities");
            return STATUS_DECK;
        } else if (cursor_is(&cursor, "</")) {
            depth--;
            whole = cursor_skip(&cursor, ">");
        } else {
            CALL(positions_add_tag(positions, &cursor, &open, &whole));
        }
        depth += open;
        if (depth > POSITION_DEPTH) {
            snprintf(message, message_size, "elements are nested deeper than %d levels", POSITION_DEPTH);
            return STATUS_DECK;
        }
    }
    return 0;
}

void positions_reset(struct positions *positions)
{
    memory_free(positions->tags);
    memory_free(positions->attributes);
    *positions = (struct positions){0};
}

// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef OUTPUT_XML_H
#define OUTPUT_XML_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/** The little XML that ParaView's own formats need; decks are read by a real parser. */

/** Write @p text with & < > " escaped. */
void xml_write(FILE *stream, const char *text);

/** Part of a document in memory: [begin, end). */
struct xml_span {
    const char *begin, *end;
};

/** Step to the next tag in @p rest: @p tag is what stands between < and >, @p rest what follows. False: there
 * is none. */
bool xml_next(struct xml_span *rest, struct xml_span *tag);

/** True if @p tag begins with the element name @p name ("/Piece" for an end tag). */
bool xml_is(const struct xml_span *tag, const char *name);

/** Copy the value of attribute @p name, unescaped, into @p value (at most @p size bytes with the NUL). False
 * if it is absent or too long. */
bool xml_attribute(const struct xml_span *tag, const char *name, char *value, size_t size);

#endif

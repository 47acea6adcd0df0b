// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef DECK_DECK_POSITION_H
#define DECK_DECK_POSITION_H

#include "model/model.h"

#include <stddef.h>

/** Where elements and attributes of an XML text stand: libxml2 keeps lines only. */

enum { POSITION_DEPTH = 64 }; /**< deepest nesting of elements in a deck */

/** A start tag: its "<", and its attributes' names in the order of the text. */
struct position_tag {
    struct location where;
    size_t first, n; /**< into positions->attributes */
};

struct positions {
    size_t n_tags, tag_capacity, n_attributes, attribute_capacity;
    struct position_tag *tags; /**< in the order of the text */
    struct location *attributes;
};

/** Find all tags of @p text (ended by a NUL). Stops early where the text is not well-formed, which the parser
 * reports. Refuses what a deck must not have (document type, an encoding other than UTF-8, deep nesting):
 * returns STATUS_DECK with one line in @p message and its place in *@p where, nothing reported. Otherwise 0
 * or STATUS_MEMORY. Lines and columns count from 1, columns in characters; a byte order mark does not count.
 * Free with positions_reset. */
int positions_scan(struct positions *positions, const char *text, struct location *where, char *message,
                   size_t message_size);

void positions_reset(struct positions *positions);

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef BASE_TEXT_H
#define BASE_TEXT_H

#include <stddef.h>

/** The entry of @p list closest to @p word by edit distance, or NULL when none is close enough to be meant
 * (more than a third of the letters differ). */
const char *text_closest(const char *word, const char *const *list, size_t n);

#endif

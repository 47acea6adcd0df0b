// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/text.h"

#include <stdbool.h>
#include <string.h>

enum { LONGEST = 64 }; // longer words are not names of anything

static size_t minimum(size_t a, size_t b)
{
    return a < b ? a : b;
}

// Number of insertions, deletions, replacements and swaps of neighbours that make a out of b (restricted
// Damerau-Levenshtein distance); both at most LONGEST letters.
static size_t edit_distance(const char *a, size_t n_a, const char *b, size_t n_b)
{
    size_t rows[3][LONGEST + 1];
    size_t *before = rows[0], *last = rows[1], *row = rows[2];

    for (size_t j = 0; j <= n_b; j++)
        last[j] = j;
    for (size_t i = 1; i <= n_a; i++) {
        row[0] = i;
        for (size_t j = 1; j <= n_b; j++) {
            const size_t replaced = last[j - 1] + (a[i - 1] != b[j - 1]);
            const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            row[j] = minimum(replaced, minimum(last[j], row[j - 1]) + 1);
            if (swapped)
                row[j] = minimum(row[j], before[j - 2] + 1);
        }
        size_t *const oldest = before;
        before = last;
        last = row;
        row = oldest;
    }
    return last[n_b];
}

const char *text_closest(const char *word, const char *const *list, size_t n)
{
    const size_t length = strlen(word);
    const char *closest = NULL;
    size_t best = LONGEST + 1;

    if (length > LONGEST)
        return NULL;
    for (size_t i = 0; i < n; i++) {
        const size_t other = strlen(list[i]);
        if (other > LONGEST)
            continue;
        const size_t distance = edit_distance(word, length, list[i], other);
        if (distance < best && 3 * distance <= (length > other ? length : other)) {
            best = distance;
            closest = list[i];
        }
    }
    return closest;
}

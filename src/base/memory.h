// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef BASE_MEMORY_H
#define BASE_MEMORY_H

#include <stddef.h>

/** Zeroed memory for @p count items of @p size bytes, aligned to 64 bytes, never NULL for count = 0.
 * Returns NULL after reporting STATUS_MEMORY (also when the product overflows). Free with memory_free. */
void *memory_create(size_t count, size_t size);

/** Free memory of memory_create or memory_grow; NULL is fine. */
void memory_free(void *memory);

/** Make *@p memory (from memory_create, or NULL) hold at least @p needed items of @p size bytes, keeping its
 * contents; the new part is zeroed. *@p capacity is the number of items it holds. Returns 0 or STATUS_MEMORY
 * (then nothing has changed). */
int memory_grow(void **memory, size_t *capacity, size_t needed, size_t size);

/** A copy of @p text; NULL after reporting STATUS_MEMORY. Free with memory_free. */
char *memory_text(const char *text);

/** printf into new memory; NULL after reporting STATUS_MEMORY. Free with memory_free. */
char *memory_print(const char *format, ...) __attribute__((format(printf, 1, 2)));

/** Return STATUS_MEMORY from the calling function if @p pointer is NULL (it has been reported already). */
#define CHECK_MEMORY(pointer)                                                                                \
    do {                                                                                                     \
        if (!(pointer))                                                                                      \
            return STATUS_MEMORY;                                                                            \
    } while (0)

#endif

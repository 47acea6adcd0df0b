// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/memory.h"

#include "base/error.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ALIGNMENT = 64 }; // a cache line and the widest vector register

// Bytes of count items, at least one and a multiple of the alignment; 0 when they cannot be addressed.
static size_t padded_size(size_t count, size_t size)
{
    size_t bytes;

    if (__builtin_mul_overflow(count, size, &bytes) || bytes > PTRDIFF_MAX - ALIGNMENT)
        return 0;
    return bytes ? (bytes + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT : ALIGNMENT;
}

void *memory_create(size_t count, size_t size)
{
    const size_t bytes = padded_size(count, size);
    void *memory = bytes ? aligned_alloc(ALIGNMENT, bytes) : NULL;

    if (!memory) {
        error_report(STATUS_MEMORY, "out of memory: cannot get %zu items of %zu bytes", count, size);
        return NULL;
    }
    return memset(memory, 0, bytes);
}

void memory_free(void *memory)
{
    free(memory);
}

int memory_grow(void **memory, size_t *capacity, size_t needed, size_t size)
{
    if (*memory && needed <= *capacity)
        return STATUS_OK;

    // An eighth more keeps repeated growth by one item cheap without much idle memory; the exact need is the
    // fallback near the limit.
    size_t count = *capacity + *capacity / 8;
    if (count < needed || !padded_size(count, size))
        count = needed;
    void *grown = memory_create(count, size);
    CHECK_MEMORY(grown);
    if (*memory) {
        memcpy(grown, *memory, *capacity * size);
        free(*memory);
    }
    *memory = grown;
    *capacity = count;
    return STATUS_OK;
}

char *memory_text(const char *text)
{
    const size_t size = strlen(text) + 1;
    char *copy = memory_create(size, 1);

    return copy ? memcpy(copy, text, size) : NULL;
}

char *memory_print(const char *format, ...)
{
    va_list arguments, again;

    va_start(arguments, format);
    va_copy(again, arguments);
    const int length = vsnprintf(NULL, 0, format, arguments);
    char *text = length < 0 ? NULL : memory_create((size_t)length + 1, 1);
    if (text)
        vsnprintf(text, (size_t)length + 1, format, again);
    else if (length < 0)
        error_report(STATUS_MEMORY, "out of memory: cannot format a text");
    va_end(again);
    va_end(arguments);
    return text;
}

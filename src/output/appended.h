// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef OUTPUT_APPENDED_H
#define OUTPUT_APPENDED_H

#include "output/vtu.h"

#include <stdio.h>

/** Files in VTK's XML formats whose arrays are appended raw, compressed data: what .vtu and .vti files share.
 */

/** One array of the file; what has a function to make it is made block by block instead of being kept. */
struct appended_item {
    const char *name;
    int components;
    enum vtu_type type;
    const void *data;
    vtu_source *read;
    size_t bytes;
    /* from here on the writer's own */
    size_t blocks;
    int level, strategy;    /**< of zlib */
    uint64_t offset;        /**< of its data */
    uint64_t *head;         /**< number of blocks, sizes, compressed sizes */
    long place, head_place; /**< in the file, of the room for its offset and of its head */
};

/** An array of @p n tuples. */
struct appended_item appended_array(const struct vtu_array *array, size_t n);

/** Writes everything before the data: declares each item, in their order, by appended_declare. */
typedef void appended_head(FILE *stream, const void *what, struct appended_item *items);

/** The first lines: file type @p kind ("UnstructuredGrid") with the attributes @p extent, time and cycle. */
void appended_begin(FILE *stream, const char *kind, const char *extent, double time, int64_t cycle);

/** The tag that opens the point arrays, with those that colour by default, or NULL. */
void appended_point_data(FILE *stream, const char *scalars, const char *vectors);

void appended_declare(FILE *stream, struct appended_item *item);

/** Write the file: head, arrays compressed in parallel (same bytes for any thread count); through a temporary
 * name, fsync and rename. @p what goes to @p head_write. Returns 0, STATUS_IO or STATUS_MEMORY. */
int appended_write(const char *path, appended_head *head_write, const void *what, struct appended_item *items,
                   size_t n);

#endif

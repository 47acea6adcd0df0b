// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef OUTPUT_VTU_H
#define OUTPUT_VTU_H

#include <stddef.h>
#include <stdint.h>

enum vtu_type { VTU_FLOAT32, VTU_FLOAT64, VTU_INT32, VTU_INT64, VTU_UINT8 };

/** Makes numbers [@p first, first + @p n) of an array from @p data, of the array's type and interleaved;
 * several threads call it at once. */
typedef void vtu_source(const void *data, size_t first, size_t n, void *to);

/** One array of a file: @c n tuples of @c components, interleaved. */
struct vtu_array {
    char name[64];
    int components;
    enum vtu_type type;
    const void *data;
    vtu_source *read; /**< makes the numbers from data; NULL: they are the data */
};

/** An unstructured grid as written or read. */
struct vtu_grid {
    double time;
    int64_t cycle;
    size_t n_points, n_cells, n_connectivity;
    const void *points; /**< rows of 3 of points_type (float32 or float64) */
    enum vtu_type points_type;
    vtu_source *points_read;               /**< as of an array */
    const int64_t *connectivity, *offsets; /**< NULL: one vertex per point (VTK_VERTEX), n_cells = n_points */
    const uint8_t *types;
    size_t n_point_arrays, n_cell_arrays;
    const struct vtu_array *point_arrays, *cell_arrays;
    const char *scalars, *vectors; /**< default colouring, or NULL */
};

/** Write a .vtu: appended raw data, zlib blocks compressed in parallel (same bytes for any thread count),
 * through a temporary name, fsync and rename (byte layout: design of VTK XML formats). Returns 0, STATUS_IO
 * or STATUS_MEMORY. */
int vtu_write(const char *path, const struct vtu_grid *grid);

/** A file read back; owns its memory. Reads the files vtu_write makes. */
struct vtu_file {
    struct vtu_grid grid;
    void *memory[64];
    size_t n_memory;
    struct vtu_array point_arrays[32], cell_arrays[32];
};

/** Read @p path whole, checking every size. Returns 0, STATUS_NO_INPUT, STATUS_IO (damaged: reported) or
 * STATUS_MEMORY. */
int vtu_read(struct vtu_file *file, const char *path);
void vtu_file_reset(struct vtu_file *file);

#endif

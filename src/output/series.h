// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef OUTPUT_SERIES_H
#define OUTPUT_SERIES_H

#include "output/pvd.h"
#include "output/vtu.h"

#include <stdbool.h>

/** The frames in the output folder of a run, found by its .pvd, and what is in them. */
struct series {
    char *folder;
    char name[64]; /**< of the run: base name of the .pvd */
    struct pvd pvd;
    size_t n_frames;
    size_t *first; /**< n_frames + 1 entries: first entry of each frame in the .pvd */
};

/** Read the .pvd of an output folder. Returns 0, STATUS_NO_INPUT (no such folder, no .pvd, no frame yet:
 * reported), STATUS_IO or STATUS_MEMORY; reset it in any case. */
int series_open(struct series *series, const char *folder);
void series_reset(struct series *series);

/** Time of a frame, s. */
double series_time(const struct series *series, size_t frame);

/** The frame that @p text asks for: "last", "first", a number, or "t=TIME" (the nearest). Returns 0 or
 * STATUS_USAGE (reported). */
int series_choose(const struct series *series, const char *text, size_t *frame);

/** Frames *@p first to *@p last of a choice of frames: as for series_choose, "all", or "A:B" by numbers;
 * *@p several tells whether it is one of these two. Returns 0 or STATUS_USAGE (reported). */
int series_choose_several(const struct series *series, const char *text, size_t *first, size_t *last,
                          bool *several);

/** Read an entry of the .pvd; @p file is reset with vtu_file_reset. Returns what vtu_read does. */
int series_read(const struct series *series, const struct pvd_entry *entry, struct vtu_file *file);

/** The array called @p name among @p n, or NULL. */
const struct vtu_array *series_array(const struct vtu_array *arrays, size_t n, const char *name);

/** Number @p index of an array, counted over all components. */
double series_value(const struct vtu_array *array, size_t index);

/** Place of a point, m. */
void series_point(const struct vtu_grid *grid, size_t index, double x[3]);

/** Unit of an array that skerry writes, or of its component (NAME_x), in a problem of @p dim dimensions (2-D:
 * per metre of depth), or NULL. */
const char *series_unit(const char *name, int dim);

#endif

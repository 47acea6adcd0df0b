// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef OUTPUT_FRAME_H
#define OUTPUT_FRAME_H

#include "base/field.h"
#include "model/mesh.h"
#include "output/pvd.h"

#include <stdbool.h>
#include <stdint.h>

/** One part of a frame: points with fields, and cells: those of a mesh, facets, or one vertex per point. */
struct frame_part {
    const char *name;          /**< "fluid", "solid-beam", "surface-obstacle" */
    int part;                  /**< number in the .pvd */
    const double *x[3];        /**< places as separate arrays, or */
    const double (*places)[3]; /**< rows of 3 (x[0] NULL) */
    const struct field_group *points;
    const struct field_group *cells; /**< or NULL */
    const struct mesh *mesh;         /**< or NULL */
    const int32_t (*facets)[4];      /**< or NULL */
    size_t n_facets;
    const char *scalars, *vectors; /**< default colouring */
};

/** Where and how frames are written. */
struct frame_writer {
    const char *folder; /**< of the run */
    const char *label;  /**< of the frame: "000123" */
    struct pvd *pvd;
    bool float64;
    const char *const *optional; /**< names of the optional fields that are wanted */
    size_t n_optional;
    const char *const *always; /**< names written without asking; every other OUTPUT field is optional */
    size_t n_always;
};

/** Write one part of a frame as FOLDER/fields/NAME_LABEL.vtu and add it to the .pvd (in memory). Returns a
 * status. */
int frame_write_part(const struct frame_writer *writer, const struct frame_part *part, double t,
                     int64_t cycle);

/** The same into the file @p path, outside the series (blowup.vtu): all OUTPUT fields, float64. */
int frame_write_single(const char *path, const struct frame_part *part, double t, int64_t cycle);

#endif

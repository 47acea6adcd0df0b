// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef OUTPUT_VTI_H
#define OUTPUT_VTI_H

#include "output/vtu.h"

/** Fields on a regular grid; points are numbered with x fastest. */
struct vti_image {
    double time;
    int64_t cycle;
    size_t n[3]; /**< points in each direction, at least 1 and at most INT_MAX */
    double origin[3], spacing[3];
    size_t n_arrays;
    const struct vtu_array *arrays;
    const char *scalars, *vectors; /**< default colouring, or NULL */
};

/** Write a .vti as vtu_write does a .vtu. Returns 0, STATUS_IO or STATUS_MEMORY. */
int vti_write(const char *path, const struct vti_image *image);

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef OUTPUT_SCENE_H
#define OUTPUT_SCENE_H

#include "output/picture.h"
#include "output/vtu.h"

#include <stddef.h>

/** One frame of an output folder as it is to be drawn. */

struct scene_part {
    char name[96]; /**< "fluid", "solid-beam", "surface-channel" */
    struct vtu_file file;
    double *values; /**< of the field at each point; NULL: the part is not coloured */
    double size;    /**< distance of its particles, m; 0: it has none */
};

struct scene {
    size_t n_parts;
    struct scene_part *parts;
    char title[64]; /**< base name of the .pvd */
    long frame;     /**< number, from 0 */
    double time;    /**< s */
    int dim;
    double lower[3], upper[3]; /**< of everything there is */
    double range[2];           /**< of the finite values */
};

/** Read the frame that @p picture asks for, with the values of its field. */
int scene_create(struct scene *scene, const struct picture *picture);
void scene_reset(struct scene *scene);

#endif

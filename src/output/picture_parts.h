// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef OUTPUT_PICTURE_PARTS_H
#define OUTPUT_PICTURE_PARTS_H

#include "output/canvas.h"
#include "output/scene.h"

/** How metres become pixels, and values colours. */
struct picture_frame {
    double scale;     /**< pixels per metre */
    double left, top; /**< m, of the pixel */
    double x0, y0;    /**< pixel of that place */
    double letter;    /**< height of capitals: the measure of line widths */
    double range[2];  /**< values at the ends of the colours */
    double slab[2];   /**< 3-D: particles between, and what else lies not before it, are drawn; equal: all */
};

/** Draw one part: particles as discs (3-D: balls) of the size of their volume, elements filled with their
 * edges, segments as lines. In 2-D solids lie over the fluid and surfaces over both; in 3-D the nearer
 * (larger z) hides the farther. */
void picture_part_draw(struct canvas *canvas, const struct scene *scene, const struct scene_part *part,
                       const struct picture_frame *frame);

#endif

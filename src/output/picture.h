// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef OUTPUT_PICTURE_H
#define OUTPUT_PICTURE_H

#include <stdbool.h>

/** What to draw of an output folder. */
struct picture {
    const char *output; /**< folder of a run */
    const char *field;  /**< "Speed" (magnitude of Velocity), an array of the fluid (vectors: magnitude), or
                           NAME_x, _y, _z */
    const char *frame;  /**< "last", "first", a number, or "t=VALUE" */
    bool has_range;
    double range[2];
    bool has_window;
    double window[4]; /**< x0, x1, y0, y1 */
    double slab[2]; /**< 3-D: particles with slab[0] <= z <= slab[1] are drawn, and elements and facets whose
                       centres have z <= slab[1]; equal: all */
    int width;      /**< pixels */
    const char *file; /**< PNG to write; NULL: OUTPUT/FIELD_FRAME.png */
};

/** Draw particles coloured by a field, solids as their deformed outline and elements, surfaces as lines, a
 * colour bar with numbers, the time (without a fluid: the solids are coloured). Prints the path on stdout.
 * Returns 0, STATUS_USAGE (no such field, frame, range or window: the message says what there is),
 * STATUS_NO_INPUT, STATUS_IO or STATUS_MEMORY. */
int picture_draw(const struct picture *picture);

#endif

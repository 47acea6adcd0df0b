// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef OUTPUT_LETTERING_H
#define OUTPUT_LETTERING_H

#include "output/canvas.h"

/** Text drawn with a pen: a small font of strokes that is sharp at any size. ASCII; other letters are left
 * out as a gap. '^' raises the minus and digits behind it ("kg/m^3"). */

enum lettering_align { LETTERING_LEFT, LETTERING_CENTRE, LETTERING_RIGHT };

/** Width of @p text in pixels when capitals are @p size pixels high. */
double lettering_width(const char *text, double size);

/** Draw @p text in front of everything; @p y: the line it stands on. */
void lettering_draw(struct canvas *canvas, double x, double y, double size, enum lettering_align align,
                    struct colour colour, const char *text);

#endif

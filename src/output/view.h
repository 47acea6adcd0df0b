// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef OUTPUT_VIEW_H
#define OUTPUT_VIEW_H

#include <stdbool.h>

/** What view.py has to know of a run. */
struct view {
    const char *name; /**< the script opens NAME.pvd beside it */
    int dim;
    double spacing;     /**< of the particles, m; 0: there is no fluid */
    const char *colour; /**< array that colours the particles ("Velocity": its magnitude) */
};

/** Write a script for ParaView at @p path (OUTPUT/view.py): the series with particles as discs or spheres,
 * solids with edges, surfaces as lines. It uses no absolute paths. "xvfb-run -a pvbatch view.py" makes PNGs.
 * Returns 0, STATUS_IO or STATUS_MEMORY. */
int view_write(const struct view *view, const char *path);

#endif

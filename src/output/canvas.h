// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef OUTPUT_CANVAS_H
#define OUTPUT_CANVAS_H

#include "output/colour_map.h"

#include <stddef.h>

/** A picture to draw on: pixels from the upper left corner, x to the right, y down, depth towards the viewer
 * (what is nearer hides what is farther, whatever is drawn first). Every pixel is made of several samples, so
 * that all edges are smooth. */
struct canvas {
    int width, height; /**< pixels */
    int samples;       /**< per pixel and direction */
    double clip[4];    /**< drawn is only what lies in x0 <= x < x1, y0 <= y < y1 */
    float *depth;      /**< of each sample */
    struct colour *colours;
};

/** A white canvas. Returns 0 or STATUS_MEMORY. */
int canvas_create(struct canvas *canvas, int width, int height);
void canvas_reset(struct canvas *canvas);

/** Restrict drawing to a rectangle; canvas_unclip: the whole canvas again. */
void canvas_clip(struct canvas *canvas, double x0, double x1, double y0, double y1);
void canvas_unclip(struct canvas *canvas);

/** A disc that stands like a cone: where discs overlap, each sample gets the colour of the nearest centre. @p
 * depth: of the rim, the centre is @p radius nearer. */
void canvas_disc(struct canvas *canvas, double x, double y, double depth, double radius,
                 struct colour colour);

/** A ball lit from the upper left. */
void canvas_ball(struct canvas *canvas, double x, double y, double depth, double radius,
                 struct colour colour);

/** A filled triangle, corners {x, y, depth}. */
void canvas_triangle(struct canvas *canvas, const double corners[3][3], struct colour colour);

/** A line with round ends, ends {x, y, depth}. */
void canvas_line(struct canvas *canvas, const double from[3], const double to[3], double width,
                 struct colour colour);

/** A filled rectangle in front of everything. */
void canvas_rectangle(struct canvas *canvas, double x0, double x1, double y0, double y1,
                      struct colour colour);

/** Write a PNG atomically. Returns 0, STATUS_IO or STATUS_MEMORY. */
int canvas_write(const struct canvas *canvas, const char *path);

#endif

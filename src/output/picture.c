// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/picture.h"

#include "base/error.h"
#include "base/memory.h"
#include "output/canvas.h"
#include "output/lettering.h"
#include "output/picture_parts.h"
#include "output/scene.h"
#include "output/series.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const struct colour ink = {40, 44, 52}, faint = {150, 155, 162};

// Round numbers along a scale.
struct ticks {
    double first, step, factor; // the numbers are shown divided by factor
    int n, decimals, exponent;  // factor = 10^exponent
};

static struct ticks ticks_find(double low, double high, int wanted)
{
    struct ticks ticks = {.factor = 1.0};
    double largest = fmax(fabs(low), fabs(high)), raw = (high - low) / wanted;
    if (largest >= 1e5 || largest < 1e-2) {
        ticks.exponent = 3 * (int)floor(log10(largest) / 3.0);
        ticks.factor = pow(10.0, ticks.exponent);
    }
    double power = floor(log10(raw)), mantissa = raw / pow(10.0, power);
    double round = mantissa <= 1.0 ? 1.0 : mantissa <= 2.0 ? 2.0 : mantissa <= 5.0 ? 5.0 : 10.0;
    ticks.step = round * pow(10.0, power);
    ticks.first = ceil(low / ticks.step - 1e-9) * ticks.step;
    ticks.n = (int)floor((high - ticks.first) / ticks.step + 1e-9) + 1;
    ticks.decimals = (int)fmax(0.0, ceil(ticks.exponent - log10(ticks.step) - 1e-9));
    return ticks;
}

static void tick_print(const struct ticks *ticks, int index, char *text, size_t size)
{
    double value = (ticks->first + index * ticks->step) / ticks->factor;
    snprintf(text, size, "%.*f", ticks->decimals,
             fabs(value) < 1e-9 * ticks->step / ticks->factor ? 0.0 : value);
}

static void label_print(const char *name, const char *unit, const struct ticks *ticks, char *text,
                        size_t size)
{
    char power[24] = "";
    if (ticks->exponent != 0)
        snprintf(power, sizeof power, unit ? "10^%d " : "10^%d", ticks->exponent);
    if (unit || power[0])
        snprintf(text, size, "%s [%s%s]", name, power, unit ? unit : "");
    else
        snprintf(text, size, "%s", name);
}

// Sizes of everything, in pixels.
struct layout {
    double letter;         // height of capitals
    double window[4];      // m: x0, x1, y0, y1
    double x0, x1, y0, y1; // the drawing
    double bar_x0, bar_x1, bar_y0, bar_y1;
    int height;
};

static int window_find(const struct scene *scene, const struct picture *picture, double window[4])
{
    double size = 0.0;
    for (size_t p = 0; p < scene->n_parts; ++p)
        size = fmax(size, scene->parts[p].size);
    CHECK(isfinite(scene->lower[0]), STATUS_NO_INPUT, "frame %ld is empty", scene->frame);
    double length = scene->upper[0] - scene->lower[0], pad = fmax(0.5 * size, 0.005 * length);
    for (int c = 0; c < 2; ++c) {
        window[2 * c] = scene->lower[c] - pad;
        window[2 * c + 1] = scene->upper[c] + pad;
    }
    if (picture->has_window)
        memcpy(window, picture->window, 4 * sizeof *window);
    CHECK(window[1] > window[0] && window[3] >= window[2], STATUS_USAGE,
          "window %g:%g:%g:%g is empty; x0 < x1 and y0 < y1 should hold", window[0], window[1], window[2],
          window[3]);
    double least = 0.04 * (window[1] - window[0]), middle = 0.5 * (window[2] + window[3]);
    if (window[3] - window[2] < least) { // one-dimensional runs
        window[2] = middle - 0.5 * least;
        window[3] = middle + 0.5 * least;
    }
    return 0;
}

static void layout_find(struct layout *layout, int width)
{
    const double letter = fmin(40.0, fmax(8.0, width / 100.0)), highest = 1.25 * width;
    double left = 6.0 * letter, right = width - 2.5 * letter, top = 3.2 * letter;
    double scale = (right - left) / (layout->window[1] - layout->window[0]);
    double height = scale * (layout->window[3] - layout->window[2]);
    if (height > highest) {
        double unused = (right - left) * (1.0 - highest / height);
        left += 0.5 * unused;
        right -= 0.5 * unused;
        height = highest;
    }
    layout->letter = letter;
    layout->x0 = left;
    layout->x1 = right;
    layout->y0 = top;
    layout->y1 = top + height;
    double middle = 0.5 * (left + right), half = 0.25 * width;
    layout->bar_x0 = middle - half;
    layout->bar_x1 = middle + half;
    layout->bar_y0 = layout->y1 + 5.6 * letter;
    layout->bar_y1 = layout->bar_y0 + 1.1 * letter;
    layout->height = (int)ceil(layout->bar_y1 + 3.4 * letter);
}

// Numbers along the lower and left edge of the drawing.
static void axis_draw(struct canvas *canvas, const struct layout *layout, int direction)
{
    const double *range = &layout->window[2 * direction], letter = layout->letter, small = 0.8 * letter;
    double length = direction == 0 ? layout->x1 - layout->x0 : layout->y1 - layout->y0;
    int wanted = (int)fmin(10.0, fmax(2.0, length / (direction == 0 ? 10.0 * letter : 4.0 * letter)));
    struct ticks ticks = ticks_find(range[0], range[1], wanted);
    char text[64];
    for (int i = 0; i < ticks.n; ++i) {
        double s = (ticks.first + i * ticks.step - range[0]) / (range[1] - range[0]) * length;
        double width = fmax(1.0, 0.08 * letter), tick = 0.4 * letter;
        tick_print(&ticks, i, text, sizeof text);
        if (direction == 0) {
            double x = layout->x0 + s, y = layout->y1 + 0.4 * letter;
            canvas_rectangle(canvas, x - 0.5 * width, x + 0.5 * width, y, y + tick, faint);
            lettering_draw(canvas, x, y + tick + 1.4 * small, small, LETTERING_CENTRE, ink, text);
        } else {
            double x = layout->x0 - 0.4 * letter, y = layout->y1 - s;
            canvas_rectangle(canvas, x - tick, x, y - 0.5 * width, y + 0.5 * width, faint);
            lettering_draw(canvas, x - tick - 0.5 * small, y + 0.5 * small, small, LETTERING_RIGHT, ink,
                           text);
        }
    }
    label_print(direction == 0 ? "x" : "y", "m", &ticks, text, sizeof text);
    if (direction == 0)
        lettering_draw(canvas, layout->x1, layout->y1 + 4.0 * letter, small, LETTERING_RIGHT, ink, text);
    else
        lettering_draw(canvas, layout->x0 - 0.8 * letter, layout->y0 - 1.2 * letter, small, LETTERING_CENTRE,
                       ink, text);
}

static void bar_draw(struct canvas *canvas, const struct layout *layout, const double range[2],
                     const char *field, int dim)
{
    double length = layout->bar_x1 - layout->bar_x0, letter = layout->letter, small = 0.8 * letter;
    int columns = (int)ceil(length);
    for (int i = 0; i < columns; ++i) {
        double x = layout->bar_x0 + i;
        canvas_rectangle(canvas, x, fmin(x + 1.0, layout->bar_x1), layout->bar_y0, layout->bar_y1,
                         colour_map((i + 0.5) / length));
    }
    struct ticks ticks = ticks_find(range[0], range[1], 6);
    char text[128];
    double width = fmax(1.0, 0.08 * letter);
    for (int i = 0; i < ticks.n; ++i) {
        double x =
            layout->bar_x0 + (ticks.first + i * ticks.step - range[0]) / (range[1] - range[0]) * length;
        tick_print(&ticks, i, text, sizeof text);
        canvas_rectangle(canvas, x - 0.5 * width, x + 0.5 * width, layout->bar_y1,
                         layout->bar_y1 + 0.4 * letter, ink);
        lettering_draw(canvas, x, layout->bar_y1 + 0.8 * letter + 1.2 * small, small, LETTERING_CENTRE, ink,
                       text);
    }
    label_print(field, series_unit(field, dim), &ticks, text, sizeof text);
    lettering_draw(canvas, 0.5 * (layout->bar_x0 + layout->bar_x1), layout->bar_y0 - 0.8 * letter, letter,
                   LETTERING_CENTRE, ink, text);
}

static int range_find(const struct scene *scene, const struct picture *picture, double range[2])
{
    memcpy(range, picture->has_range ? picture->range : scene->range, 2 * sizeof *range);
    if (picture->has_range)
        CHECK(range[0] < range[1], STATUS_USAGE, "range %g:%g is empty; the first should be the smaller",
              range[0], range[1]);
    if (!(range[0] <= range[1])) { // no finite value at all
        range[0] = 0.0;
        range[1] = 1.0;
    }
    double least = fmax(1e-6 * fmax(fabs(range[0]), fabs(range[1])), 1e-30);
    if (range[1] - range[0] < least) { // a constant: show it in the middle of a scale
        double middle = 0.5 * (range[0] + range[1]), half = middle != 0.0 ? 0.1 * fabs(middle) : 1.0;
        range[0] = middle - half;
        range[1] = middle + half;
    }
    return 0;
}

static int path_find(const struct scene *scene, const struct picture *picture, char **path)
{
    *path = picture->file ? memory_text(picture->file)
                          : memory_print("%s/%s_%06ld.png", picture->output, picture->field, scene->frame);
    CHECK_MEMORY(*path);
    return 0;
}

static void scene_draw(struct canvas *canvas, const struct scene *scene, const struct picture *picture,
                       const struct layout *layout, const double range[2])
{
    struct picture_frame frame = {.scale =
                                      (layout->x1 - layout->x0) / (layout->window[1] - layout->window[0]),
                                  .left = layout->window[0],
                                  .top = layout->window[3],
                                  .x0 = layout->x0,
                                  .y0 = layout->y0,
                                  .letter = layout->letter,
                                  .range = {range[0], range[1]},
                                  .slab = {picture->slab[0], picture->slab[1]}};
    const double line = 0.15 * layout->letter; // lines on the border of the window are whole
    canvas_clip(canvas, layout->x0 - line, layout->x1 + line, layout->y0 - line, layout->y1 + line);
    for (size_t p = 0; p < scene->n_parts; ++p)
        picture_part_draw(canvas, scene, &scene->parts[p], &frame);
    canvas_unclip(canvas);
    char time[48];
    snprintf(time, sizeof time, "t = %.5g s", scene->time);
    lettering_draw(canvas, layout->x1, layout->y0 - 1.1 * layout->letter, layout->letter, LETTERING_RIGHT,
                   ink, time);
    axis_draw(canvas, layout, 0);
    axis_draw(canvas, layout, 1);
    bar_draw(canvas, layout, range, picture->field, scene->dim);
}

static int canvas_fill(const struct scene *scene, const struct picture *picture)
{
    struct layout layout;
    double range[2];
    CALL(window_find(scene, picture, layout.window));
    CALL(range_find(scene, picture, range));
    layout_find(&layout, picture->width);
    struct canvas canvas;
    char *path;
    CALL(canvas_create(&canvas, picture->width, layout.height));
    scene_draw(&canvas, scene, picture, &layout, range);
    int status = path_find(scene, picture, &path);
    if (!status) {
        status = canvas_write(&canvas, path);
        if (!status)
            printf("%s\n", path);
        memory_free(path);
    }
    canvas_reset(&canvas);
    return status;
}

int picture_draw(const struct picture *picture)
{
    enum { NARROWEST = 100, WIDEST = 16384 };
    CHECK(picture->width >= NARROWEST && picture->width <= WIDEST, STATUS_USAGE,
          "width %d: between %d and %d pixels are possible", picture->width, NARROWEST, WIDEST);
    CHECK(!strchr(picture->field, '/'), STATUS_USAGE, "field \"%s\": a name without / is expected",
          picture->field);
    struct scene scene;
    CALL(scene_create(&scene, picture));
    int status = canvas_fill(&scene, picture);
    scene_reset(&scene);
    return status;
}

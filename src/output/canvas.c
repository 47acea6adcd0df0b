// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/canvas.h"

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"

#include <float.h>
#include <math.h>
#include <png.h>
#include <stdbool.h>
#include <string.h>

static const double most_samples = 64e6; // 8 bytes each

int canvas_create(struct canvas *canvas, int width, int height)
{
    memset(canvas, 0, sizeof *canvas);
    canvas->width = width;
    canvas->height = height;
    canvas->samples = 4;
    while (canvas->samples > 1 && (double)width * height * canvas->samples * canvas->samples > most_samples)
        --canvas->samples;
    size_t n = (size_t)width * (size_t)height * (size_t)(canvas->samples * canvas->samples);
    canvas->depth = memory_create(n, sizeof *canvas->depth);
    canvas->colours = memory_create(n, sizeof *canvas->colours);
    if (!canvas->depth || !canvas->colours) {
        canvas_reset(canvas);
        return STATUS_MEMORY;
    }
    memset(canvas->colours, 255, n * sizeof *canvas->colours);
    for (size_t i = 0; i < n; ++i)
        canvas->depth[i] = -FLT_MAX;
    canvas_unclip(canvas);
    return 0;
}

void canvas_reset(struct canvas *canvas)
{
    memory_free(canvas->depth);
    memory_free(canvas->colours);
    memset(canvas, 0, sizeof *canvas);
}

void canvas_clip(struct canvas *canvas, double x0, double x1, double y0, double y1)
{
    canvas->clip[0] = fmax(0.0, x0);
    canvas->clip[1] = fmin(canvas->width, x1);
    canvas->clip[2] = fmax(0.0, y0);
    canvas->clip[3] = fmin(canvas->height, y1);
}

void canvas_unclip(struct canvas *canvas)
{
    canvas_clip(canvas, 0.0, canvas->width, 0.0, canvas->height);
}

// Samples whose centres lie in [low, high), cut to the clip rectangle.
struct range {
    long begin, end;
};

static struct range samples_in(const struct canvas *canvas, int direction, double low, double high)
{
    double lower = fmax(low, canvas->clip[2 * direction]);
    double upper = fmin(high, canvas->clip[2 * direction + 1]);
    if (!(lower < upper)) // also for NaN
        return (struct range){0, 0};
    return (struct range){(long)ceil(lower * canvas->samples - 0.5),
                          (long)ceil(upper * canvas->samples - 0.5)};
}

static void sample_set(struct canvas *canvas, long i, long j, double depth, struct colour colour)
{
    size_t index = (size_t)j * (size_t)(canvas->width * canvas->samples) + (size_t)i;
    if ((float)depth >= canvas->depth[index]) {
        canvas->depth[index] = (float)depth;
        canvas->colours[index] = colour;
    }
}

void canvas_disc(struct canvas *canvas, double x, double y, double depth, double radius, struct colour colour)
{
    struct range columns = samples_in(canvas, 0, x - radius, x + radius);
    struct range rows = samples_in(canvas, 1, y - radius, y + radius);
    for (long j = rows.begin; j < rows.end; ++j)
        for (long i = columns.begin; i < columns.end; ++i) {
            double dx = ((double)i + 0.5) / canvas->samples - x, dy = ((double)j + 0.5) / canvas->samples - y;
            double d = sqrt(dx * dx + dy * dy);
            if (d < radius)
                sample_set(canvas, i, j, depth + radius - d, colour);
        }
}

void canvas_ball(struct canvas *canvas, double x, double y, double depth, double radius, struct colour colour)
{
    struct range columns = samples_in(canvas, 0, x - radius, x + radius);
    struct range rows = samples_in(canvas, 1, y - radius, y + radius);
    for (long j = rows.begin; j < rows.end; ++j)
        for (long i = columns.begin; i < columns.end; ++i) {
            double dx = ((double)i + 0.5) / canvas->samples - x, dy = ((double)j + 0.5) / canvas->samples - y;
            double z2 = radius * radius - dx * dx - dy * dy;
            if (z2 <= 0.0)
                continue;
            double z = sqrt(z2),
                   light = (0.8 * z - 0.35 * dx - 0.48 * dy) / radius; // unit vector of the light
            sample_set(canvas, i, j, depth + z, colour_shade(colour, 0.55 + 0.45 * fmax(0.0, light)));
        }
}

void canvas_triangle(struct canvas *canvas, const double corners[3][3], struct colour colour)
{
    const double *a = corners[0], *b = corners[1], *c = corners[2];
    double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    struct range columns = samples_in(canvas, 0, fmin(a[0], fmin(b[0], c[0])), fmax(a[0], fmax(b[0], c[0])));
    struct range rows = samples_in(canvas, 1, fmin(a[1], fmin(b[1], c[1])), fmax(a[1], fmax(b[1], c[1])));
    if (!(fabs(area) > 0.0))
        return;
    for (long j = rows.begin; j < rows.end; ++j)
        for (long i = columns.begin; i < columns.end; ++i) {
            double x = ((double)i + 0.5) / canvas->samples, y = ((double)j + 0.5) / canvas->samples;
            double wb = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / area;
            double wc = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / area;
            if (wb >= 0.0 && wc >= 0.0 && wb + wc <= 1.0)
                sample_set(canvas, i, j, (1.0 - wb - wc) * a[2] + wb * b[2] + wc * c[2], colour);
        }
}

void canvas_line(struct canvas *canvas, const double from[3], const double to[3], double width,
                 struct colour colour)
{
    double half = 0.5 * width, ex = to[0] - from[0], ey = to[1] - from[1], length2 = ex * ex + ey * ey;
    struct range columns = samples_in(canvas, 0, fmin(from[0], to[0]) - half, fmax(from[0], to[0]) + half);
    struct range rows = samples_in(canvas, 1, fmin(from[1], to[1]) - half, fmax(from[1], to[1]) + half);
    for (long j = rows.begin; j < rows.end; ++j)
        for (long i = columns.begin; i < columns.end; ++i) {
            double x = ((double)i + 0.5) / canvas->samples - from[0],
                   y = ((double)j + 0.5) / canvas->samples - from[1];
            double s = length2 > 0.0 ? fmin(1.0, fmax(0.0, (x * ex + y * ey) / length2)) : 0.0;
            double dx = x - s * ex, dy = y - s * ey;
            if (dx * dx + dy * dy < half * half)
                sample_set(canvas, i, j, from[2] + s * (to[2] - from[2]), colour);
        }
}

void canvas_rectangle(struct canvas *canvas, double x0, double x1, double y0, double y1, struct colour colour)
{
    struct range columns = samples_in(canvas, 0, x0, x1), rows = samples_in(canvas, 1, y0, y1);
    for (long j = rows.begin; j < rows.end; ++j)
        for (long i = columns.begin; i < columns.end; ++i)
            sample_set(canvas, i, j, FLT_MAX, colour);
}

// One row of pixels: the mean of their samples.
static void row_mix(const struct canvas *canvas, int row, uint8_t *pixels)
{
    const int s = canvas->samples, n = s * s;
    for (int x = 0; x < canvas->width; ++x) {
        int r = n / 2, g = n / 2, b = n / 2;
        for (int j = 0; j < s; ++j) {
            const struct colour *colour =
                canvas->colours + (size_t)(row * s + j) * (size_t)(canvas->width * s) + (size_t)(x * s);
            for (int i = 0; i < s; ++i) {
                r += colour[i].r;
                g += colour[i].g;
                b += colour[i].b;
            }
        }
        pixels[3 * x] = (uint8_t)(r / n);
        pixels[3 * x + 1] = (uint8_t)(g / n);
        pixels[3 * x + 2] = (uint8_t)(b / n);
    }
}

static void png_failed(png_structp png, png_const_charp message)
{
    error_report(STATUS_IO, "%s: cannot write the picture: %s", (const char *)png_get_error_ptr(png),
                 message);
    png_longjmp(png, 1);
}

static void png_warned(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

// libpng leaves by longjmp; nothing that changes after setjmp is read behind it.
static int rows_write(const struct canvas *canvas, png_structp png, png_infop info, FILE *stream,
                      uint8_t *pixels)
{
    if (setjmp(png_jmpbuf(png)))
        return STATUS_IO;
    png_init_io(png, stream);
    png_set_IHDR(png, info, (png_uint_32)canvas->width, (png_uint_32)canvas->height, 8, PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    for (int row = 0; row < canvas->height; ++row) {
        row_mix(canvas, row, pixels);
        png_write_row(png, pixels);
    }
    png_write_end(png, info);
    return 0;
}

static int stream_write(const struct canvas *canvas, FILE *stream, const char *path)
{
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, (png_voidp)path, png_failed, png_warned);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    uint8_t *pixels = memory_create((size_t)canvas->width, 3);
    int status = info && pixels ? rows_write(canvas, png, info, stream, pixels) : STATUS_MEMORY;
    png_destroy_write_struct(&png, &info);
    memory_free(pixels);
    return status;
}

int canvas_write(const struct canvas *canvas, const char *path)
{
    struct file_atomic file;
    CALL(file_atomic_open(&file, path));
    int status = stream_write(canvas, file.stream, path);
    if (status) {
        file_atomic_abandon(&file);
        return status;
    }
    return file_atomic_commit(&file);
}

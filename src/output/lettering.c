// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/lettering.h"

#include <float.h>
#include <stdbool.h>
#include <string.h>

// A glyph: its width, then strokes, each a chain of points; '~' in front: a smooth curve (Catmull-Rom)
// through them. A point is a digit for x and a letter for y: 'd' is the line the text stands on, 'j' the
// height of small letters, 'm' of capitals, 'a' the depth of descenders.
static const char *const glyphs[128] = {
    [' '] = "3",
    ['%'] = "7 0d7m ~1m0l0k1j2k2l1m ~6g5f5e6d7e7f6g",
    ['\''] = "0 0m0j",
    ['('] = "2 ~2n1l0i0g1d2b",
    [')'] = "2 ~0n1l2i2g1d0b",
    ['*'] = "4 2l2h 0k4i 0i4k",
    ['+'] = "6 0h6h 3e3k",
    [','] = "1 1d0b",
    ['-'] = "4 0h4h",
    ['.'] = "0 0d0d",
    ['/'] = "4 0c4m",
    ['0'] = "6 ~3m5l6i6h5e3d1e0h0i1l3m",
    ['1'] = "6 1k3m3d 1d5d",
    ['2'] = "6 ~0k1l3m5l6k5i3g0d 0d6d",
    ['3'] = "6 ~0l2m4m6k4i2i ~2i4i6g6f4d2d0e",
    ['4'] = "6 4d4m0g6g",
    ['5'] = "6 5m1m0i ~0i2j4j6h6f4d2d0e",
    ['6'] = "6 ~5m3l1j0g1e3d5e6g5i3j1i0g",
    ['7'] = "6 0m6m2d",
    ['8'] = "6 ~3i1j1l3m5l5j3i ~3i1h0f1e3d5e6f5h3i",
    ['9'] = "6 ~1d3e5g6j5l3m1l0j1h3g5h6j",
    [':'] = "0 0d0d 0i0i",
    ['<'] = "4 4k0h4e",
    ['='] = "6 0i6i 0f6f",
    ['>'] = "4 0k4h0e",
    ['A'] = "6 0d3m6d 1g5g",
    ['B'] = "6 3d0d0m3m 0i3i ~3m5l5j3i ~3i5h6g5e3d",
    ['C'] = "6 ~6k5l3m1l0i0h1e3d5e6f",
    ['D'] = "6 2d0d0m2m ~2m5k6i6h5f2d",
    ['E'] = "5 5m0m0d5d 0i4i",
    ['F'] = "5 5m0m0d 0i4i",
    ['G'] = "6 ~6k5l3m1l0i0h1e3d5e6f 6f6h4h",
    ['H'] = "6 0d0m 6d6m 0i6i",
    ['I'] = "0 0d0m",
    ['J'] = "4 4m4f ~4f3d1d0f",
    ['K'] = "6 0m0d 6m0g 2i6d",
    ['L'] = "5 0m0d5d",
    ['M'] = "8 0d0m4e8m8d",
    ['N'] = "6 0d0m6d6m",
    ['O'] = "7 ~3m5m7j7g5d3d1d0g0j1m3m",
    ['P'] = "6 0d0m3m 0h3h ~3m5l6k5i3h",
    ['Q'] = "7 ~3m5m7j7g5d3d1d0g0j1m3m 4f7c",
    ['R'] = "6 0d0m3m 0h3h ~3m5l6k5i3h 3h6d",
    ['S'] = "6 ~6k5l3m1l0k1i5h6f5e3d1e0f",
    ['T'] = "6 0m6m 3m3d",
    ['U'] = "6 0m0g 6g6m ~0g1e3d5e6g",
    ['V'] = "6 0m3d6m",
    ['W'] = "8 0m2d4k6d8m",
    ['X'] = "6 0m6d 6m0d",
    ['Y'] = "6 0m3h6m 3h3d",
    ['Z'] = "6 0m6m0d6d",
    ['['] = "2 2n0n0b2b",
    [']'] = "2 0n2n2b0b",
    ['_'] = "6 0c6c",
    ['a'] = "5 5j5d ~5i3j1i0h0f1e3d5e",
    ['b'] = "5 0m0d ~0i2j4i5h5f4e2d0e",
    ['c'] = "5 ~5i3j1i0h0f1e3d5e",
    ['d'] = "5 5m5d ~5i3j1i0h0f1e3d5e",
    ['e'] = "5 0g5g ~5g5h4i3j1i0h0f1e3d5e",
    ['f'] = "4 ~4m3m2l1j 1j1d 0j3j",
    ['g'] = "5 5j5c ~5i3j1i0h0f1e3d5e ~5c4a2a0b",
    ['h'] = "5 0m0d ~0h2j4j5h 5h5d",
    ['i'] = "0 0j0d 0m0m",
    ['j'] = "1 1j1b0a 1m1m",
    ['k'] = "4 0m0d 4j0f 1g4d",
    ['l'] = "0 0m0d",
    ['m'] = "8 0j0d ~0h1j3j4h 4h4d ~4h5j7j8h 8h8d",
    ['n'] = "5 0j0d ~0h2j4j5h 5h5d",
    ['o'] = "5 ~2j3j5h5f3d2d0f0h2j",
    ['p'] = "5 0j0a ~0i2j4i5h5f4e2d0e",
    ['q'] = "5 5j5a ~5i3j1i0h0f1e3d5e",
    ['r'] = "3 0j0d ~0g1i3j",
    ['s'] = "4 ~4i2j1j0i1h3g4f3d1d0e",
    ['t'] = "3 1m1f ~1f2d3d 0j3j",
    ['u'] = "5 5j5d 0j0f ~0f1d3d5f",
    ['v'] = "4 0j2d4j",
    ['w'] = "6 0j1d3i5d6j",
    ['x'] = "4 0j4d 4j0d",
    ['y'] = "4 0j2d 4j2d1a0a",
    ['z'] = "4 0j4j0d4d",
    ['|'] = "0 0n0b",
};

enum { CAPITAL = 9, GAP = 3, CURVE = 6 }; // units: height, space between glyphs, parts of a curve
static const double raise = 4.5, small = 0.65,
                    thickness = 0.125; // of raised letters; of the pen, by the size

// Where the next glyph goes.
struct pen {
    double x; // units
    bool raised;
    const char *at; // rest of the text
};

static const char *glyph_next(struct pen *pen, double *scale)
{
    if (*pen->at == '^') {
        pen->raised = true;
        ++pen->at;
    }
    unsigned char letter = (unsigned char)*pen->at;
    if (pen->raised && !(letter == '-' || (letter >= '0' && letter <= '9')))
        pen->raised = false;
    const char *glyph = letter < 128 ? glyphs[letter] : NULL;
    *scale = pen->raised ? small : 1.0;
    return glyph ? glyph : "3";
}

static void glyph_skip(struct pen *pen, const char *glyph, double scale)
{
    pen->x += ((glyph[0] - '0') + GAP) * scale;
    if (*pen->at)
        ++pen->at;
}

double lettering_width(const char *text, double size)
{
    struct pen pen = {.at = text};
    while (*pen.at) {
        double scale;
        const char *glyph = glyph_next(&pen, &scale);
        if (*pen.at)
            glyph_skip(&pen, glyph, scale);
    }
    return pen.x > 0 ? (pen.x - GAP) * size / CAPITAL : 0.0;
}

static void point(const char *stroke, size_t n, long i, double p[2])
{
    size_t index = i < 0 ? 0 : (size_t)i >= n ? n - 1 : (size_t)i;
    p[0] = stroke[2 * index] - '0';
    p[1] = stroke[2 * index + 1] - 'd';
}

// Catmull-Rom: between points 1 and 2 with the slopes of their neighbours.
static double curve(double p0, double p1, double p2, double p3, double s)
{
    return p1 + 0.5 * s * (p2 - p0 + s * (2 * p0 - 5 * p1 + 4 * p2 - p3 + s * (3 * (p1 - p2) + p3 - p0)));
}

// Draw a chain of @p n points at @p origin, @p unit pixels a unit.
static void stroke_draw(struct canvas *canvas, const char *stroke, size_t n, bool smooth,
                        const double origin[2], double unit, double width, struct colour colour)
{
    double last[3] = {0, 0, FLT_MAX}, p[4][2];
    bool closed = n > 2 && memcmp(stroke, stroke + 2 * (n - 1), 2) == 0;
    for (long i = 0; i + 1 < (long)n; ++i) {
        int parts = smooth ? CURVE : 1;
        for (int k = 0; k < 4; ++k) {
            long index = i + k - 1;
            if (closed && index < 0)
                index = (long)n - 2;
            if (closed && index >= (long)n)
                index = 1;
            point(stroke, n, index, p[k]);
        }
        for (int part = i == 0 ? 0 : 1; part <= parts; ++part) {
            double s = (double)part / parts, next[3] = {0, 0, FLT_MAX};
            for (int c = 0; c < 2; ++c) {
                double value =
                    smooth ? curve(p[0][c], p[1][c], p[2][c], p[3][c], s) : (1 - s) * p[1][c] + s * p[2][c];
                next[c] = origin[c] + (c == 0 ? unit : -unit) * value;
            }
            if (part > 0)
                canvas_line(canvas, last, next, width, colour);
            memcpy(last, next, sizeof last);
        }
    }
}

static void glyph_draw(struct canvas *canvas, const char *glyph, const double origin[2], double unit,
                       double width, struct colour colour)
{
    for (const char *stroke = glyph + 1; *stroke == ' ';) {
        ++stroke;
        bool smooth = *stroke == '~';
        stroke += smooth;
        size_t letters = strcspn(stroke, " ");
        stroke_draw(canvas, stroke, letters / 2, smooth, origin, unit, width, colour);
        stroke += letters;
    }
}

void lettering_draw(struct canvas *canvas, double x, double y, double size, enum lettering_align align,
                    struct colour colour, const char *text)
{
    double unit = size / CAPITAL, start = x - 0.5 * (int)align * lettering_width(text, size);
    struct pen pen = {.at = text};
    while (*pen.at) {
        double scale;
        const char *glyph = glyph_next(&pen, &scale);
        double origin[2] = {start + pen.x * unit, y - (pen.raised ? raise * unit : 0.0)};
        if (*pen.at) {
            glyph_draw(canvas, glyph, origin, unit * scale, thickness * size, colour);
            glyph_skip(&pen, glyph, scale);
        }
    }
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/colour_map.h"

#include <math.h>

// Viridis at 16 equidistant places, from the published table of 256; between them linear interpolation is off
// by less than two of 255 levels.
static const struct colour viridis[] = {
    {0x44, 0x01, 0x54}, {0x48, 0x1A, 0x6C}, {0x47, 0x2F, 0x7D}, {0x41, 0x44, 0x87},
    {0x39, 0x56, 0x8C}, {0x31, 0x68, 0x8E}, {0x2A, 0x78, 0x8E}, {0x23, 0x88, 0x8E},
    {0x1F, 0x98, 0x8B}, {0x22, 0xA8, 0x84}, {0x35, 0xB7, 0x79}, {0x54, 0xC5, 0x68},
    {0x7A, 0xD1, 0x51}, {0xA5, 0xDB, 0x36}, {0xD2, 0xE2, 0x1B}, {0xFD, 0xE7, 0x25}};

static uint8_t level(double value)
{
    return (uint8_t)lround(fmin(255.0, fmax(0.0, value)));
}

struct colour colour_map(double value)
{
    enum { LAST = sizeof viridis / sizeof viridis[0] - 1 };
    if (isnan(value))
        return (struct colour){230, 30, 30};
    double place = fmin(1.0, fmax(0.0, value)) * LAST;
    int i = place < LAST ? (int)place : LAST - 1;
    double w = place - i;
    const struct colour *a = &viridis[i], *b = &viridis[i + 1];
    return (struct colour){level((1 - w) * a->r + w * b->r), level((1 - w) * a->g + w * b->g),
                           level((1 - w) * a->b + w * b->b)};
}

struct colour colour_shade(struct colour colour, double factor)
{
    return (struct colour){level(colour.r * factor), level(colour.g * factor), level(colour.b * factor)};
}

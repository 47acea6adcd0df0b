// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef OUTPUT_COLOUR_MAP_H
#define OUTPUT_COLOUR_MAP_H

#include <stdint.h>

/** A colour, red green blue. */
struct colour {
    uint8_t r, g, b;
};

/** The colour of @p value in [0, 1] (clamped; NaN: red) in viridis, the perceptually uniform map of N. Smith
 * and S. van der Walt (2015, CC0), which also works in grey and for colour-blind eyes. */
struct colour colour_map(double value);

/** @p colour darkened (factor < 1). */
struct colour colour_shade(struct colour colour, double factor);

#endif

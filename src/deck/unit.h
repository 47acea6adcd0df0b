// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef DECK_UNIT_H
#define DECK_UNIT_H

#include <stddef.h>

/** Conversion of units to SI by UDUNITS-2. The data base is read when the first unit is met. */
struct unit_system {
    void *handle; /**< NULL until then */
};

/** Convert @p value in @p unit ("MPa") to @p target ("Pa"; "1": dimensionless; NULL: the coherent SI unit of
 * the same dimension, whatever it is) into *@p result. On a mistake (unknown unit, wrong dimension) returns
 * STATUS_DECK and writes one line into @p message. */
int unit_convert(struct unit_system *system, double value, const char *unit, const char *target,
                 double *result, char *message, size_t message_size);

/** Free the data base. */
void unit_system_reset(struct unit_system *system);

#endif

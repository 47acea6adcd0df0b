// SPDX-License-Identifier: GPL-3.0-or-later
#include "deck/unit.h"

#include "base/error.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <udunits2.h>

enum { UNIT_LENGTH = 64 }; // longest name of a unit

/** The unit without its factor and offset: what remains of "1000 kg.m-1" is "kg.m-1". */
static ut_unit *unit_coherent(ut_system *system, const ut_unit *unit)
{
    char definition[256];
    int length = ut_format(unit, definition, sizeof definition, UT_ASCII | UT_DEFINITION);
    if (length < 0 || (size_t)length >= sizeof definition)
        return NULL;
    char *base = definition;
    strtod(definition, &base);
    base += strspn(base, " ");
    base[strcspn(base, " @")] = '\0';
    return ut_parse(system, *base ? base : "1", UT_ASCII);
}

/** The data base, with the short name of the degree, which it lacks. */
static ut_system *unit_data_base(void)
{
    ut_set_error_message_handler(ut_ignore);
    ut_system *system = ut_read_xml(NULL);
    ut_unit *degree = system ? ut_parse(system, "degree", UT_ASCII) : NULL;
    if (degree)
        ut_map_symbol_to_unit("deg", UT_ASCII, degree);
    ut_free(degree);
    return system;
}

int unit_convert(struct unit_system *system, double value, const char *unit, const char *target,
                 double *result, char *message, size_t message_size)
{
    if (!system->handle)
        system->handle = unit_data_base();
    if (!system->handle) {
        snprintf(message, message_size,
                 "the data base of units cannot be read (is libudunits2-data installed?)");
        return STATUS_DECK;
    }
    if (strlen(unit) > UNIT_LENGTH) {
        snprintf(message, message_size, "a unit has at most %d characters", UNIT_LENGTH);
        return STATUS_DECK;
    }
    ut_unit *from = ut_parse(system->handle, unit, UT_UTF8);
    ut_unit *to = !from    ? NULL
                  : target ? ut_parse(system->handle, target, UT_ASCII)
                           : unit_coherent(system->handle, from);
    cv_converter *converter = from && to ? ut_get_converter(from, to) : NULL;
    int status = STATUS_DECK;
    if (!from)
        snprintf(message, message_size, "unknown unit \"%s\"", unit);
    else if (!converter && !target)
        snprintf(message, message_size, "unit \"%s\" has no SI equivalent", unit);
    else if (!converter && strcmp(target, "1") == 0)
        snprintf(message, message_size, "unit \"%s\" does not fit: a number without dimension is wanted",
                 unit);
    else if (!converter)
        snprintf(message, message_size, "unit \"%s\" does not fit: it cannot be converted to %s", unit,
                 target);
    else
        status = STATUS_OK;
    if (converter)
        *result = cv_convert_double(converter, value);
    cv_free(converter);
    ut_free(to);
    ut_free(from);
    return status;
}

void unit_system_reset(struct unit_system *system)
{
    ut_free_system(system->handle);
    system->handle = NULL;
}

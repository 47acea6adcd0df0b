// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef MATH_EXPRESSION_H
#define MATH_EXPRESSION_H

#include <stdbool.h>
#include <stddef.h>

/** Expressions in x, y, z, t over named constants, evaluated by muParser. Its C interface aborts on very long
 * tokens and deep parentheses, so length (1024; 8192 with the functions written out) and depth (64) are
 * capped first; assignment is refused. */
struct expression;

/** The names an expression may use besides x, y, z, t and pi: constants, and functions of x, y, z, t given as
 * text (used without parentheses, e.g. "ramp"; they may use constants and functions listed before them). */
struct expression_scope {
    size_t n_constants;
    const char *const *constant_names;
    const double *constant_values;
    size_t n_functions;
    const char *const *function_names;
    const char *const *function_texts;
};

/** Compile @p text; @p scope may be NULL. On a mistake returns STATUS_DECK and writes one line into @p
 * message (nothing is reported); the caller knows the place. Free with expression_destroy. */
int expression_create(struct expression **expression, const char *text, const struct expression_scope *scope,
                      char *message, size_t message_size);

/** An expression that is a plain number. NULL after reporting STATUS_MEMORY. */
struct expression *expression_constant(double value);

/** Value at place @p x (3 entries; NULL: the origin) and time @p t. Not reentrant: one thread at a time. */
double expression_value(const struct expression *expression, const double x[3], double t);

/** Whether the expression uses none of x, y, z, t / does not use t. */
bool expression_is_constant(const struct expression *expression);
bool expression_is_steady(const struct expression *expression);

/** The text it was made from. */
const char *expression_text(const struct expression *expression);

/** NULL is fine. */
void expression_destroy(struct expression *expression);

#endif

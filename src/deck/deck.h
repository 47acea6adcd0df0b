// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef DECK_DECK_H
#define DECK_DECK_H

#include "model/model.h"

#include <stdio.h>

/** Read a deck: parse it safely, check every element and attribute against the tables of deck_schema.c,
 * evaluate units and expressions, resolve references, build the surfaces. All mistakes are printed on stderr,
 * in the order of the deck, as "PATH:LINE:COLUMN: error: WHAT"; what is odd but allowed is a log warning.
 * @param model the problem; free with model_destroy
 * @param overrides "NAME=VALUE" of --set: new values of parameters of the deck, in the deck's syntax
 * Returns 0, STATUS_USAGE (an override names no parameter, or its value is wrong), STATUS_DECK,
 * STATUS_NO_INPUT (the file cannot be read), STATUS_IO or STATUS_MEMORY. */
int deck_read(struct model **model, const char *path, size_t n_overrides, const char *const *overrides);

/** Read the deck of a run that is resumed: as deck_read does, with all overrides, of which the first @p
 * n_before belonged to the run so far. What came after them may change nothing but the end of the simulated
 * time and the output: each later override that gives a parameter another value than it had may reach only
 * "end" of <time> and what stands inside <output>, also by way of other parameters and of functions. For
 * every override that reaches more, the first place where it does is printed, as mistakes of the deck are,
 * and STATUS_USAGE is returned before anything is built. */
int deck_read_resume(struct model **model, const char *path, size_t n_overrides, const char *const *overrides,
                     size_t n_before);

/** Read a deck as deck_read does and print it as understood: every default filled in, constant expressions
 * evaluated to SI numbers, parameters with the values they have after @p overrides. What is printed is a deck
 * that reads to the same model. */
int deck_show(const char *path, size_t n_overrides, const char *const *overrides, FILE *stream);

/** Print the libraries that read decks, with versions, one a line. */
void deck_print_libraries(FILE *stream);

#endif

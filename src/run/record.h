// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RUN_RECORD_H
#define RUN_RECORD_H

#include "model/model.h"

#include <stddef.h>

/** What OUTPUT/input says about what is run: the deck, every file that it names, and the parameters that
 * were overridden. The files lie beside each other as the deck names them; input/record holds one line for
 * each:
 *
 *     skerry-input 1
 *     deck NAME
 *     file HASH SIZE NAME
 *     isa NAME
 *     set NAME=VALUE
 *     end HASH
 *
 * of which the last of a kind counts; the last line is the hash of all before.
 */
struct record {
    char *deck;   /**< path of the deck in the output folder */
    char isa[16]; /**< instruction set of the sweeps; "auto": there is no fluid */
    size_t n_overrides;
    char **overrides; /**< as given to --set, oldest first */
};

/** Copy the deck and its files into @p output/input and write the record; @p isa may be NULL. A file that has
 * changed since it was read is refused (STATUS_IO). Returns a status (reported). */
int record_create(const char *output, const struct model *model, const char *isa, size_t n_overrides,
                  const char *const *overrides);

/** Read the record of an output folder and compare its files with their hashes. Returns 0, STATUS_NO_INPUT
 * (no output of a run; reported), STATUS_IO (something is missing, damaged or has changed; reported) or
 * STATUS_MEMORY.
 */
int record_read(struct record *record, const char *output);
void record_reset(struct record *record);

/** Add to the record what a run goes on with: the instruction set (or NULL) and overrides. Returns a status
 * (reported). */
int record_add(const char *output, const char *isa, size_t n_overrides, const char *const *overrides);

/** Remove the record and the files that it names; without a record there is nothing to do. Returns a status
 * (reported). */
int record_remove(const char *output);

#endif

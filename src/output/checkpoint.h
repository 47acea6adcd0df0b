// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef OUTPUT_CHECKPOINT_H
#define OUTPUT_CHECKPOINT_H

#include "base/field.h"
#include "base/timer.h"

#include <stdint.h>

/** Checkpoints: every STATE field of a run, in double precision, in one HDF5 file
 *
 *     CHECKPOINT FOLDER/step_000001234.h5          group per field group, dataset (items x components) per
 * field CHECKPOINT FOLDER/step_000001234.manifest    size and hash of that file, and the note below
 *
 * The data file is written under a temporary name, synced and renamed before its manifest is; a checkpoint
 * without a manifest is none. The manifest is checked, then the whole file against it, before HDF5 sees it.
 * The data depend on the state alone: equal states give equal files. */

/** What a manifest says of the run besides; it takes no part in the state. */
struct checkpoint_note {
    int64_t step;
    double t;                                /**< s */
    double wall_s;                           /**< wall time of all processes so far */
    double updates;                          /**< particle updates so far */
    double phases_s[TIMER_PHASES];           /**< wall time by phase */
    char version[32], revision[64], isa[16]; /**< of the program; instruction set of the sweeps */
};

/** Write the state as the newest checkpoint of @p folder (made if it is not there), then remove all others
 * but that of step @p keep (< 0: but none). Returns 0; STATUS_NUMERICAL (reported: a value is not finite),
 * STATUS_IO, STATUS_CREATE or STATUS_MEMORY: then the older checkpoints are as they were. */
int checkpoint_write(const char *folder, const struct field_list *state, const struct checkpoint_note *note,
                     int64_t keep);

/** Fill the state from the newest checkpoint of @p folder that is whole and has just the fields of @p state;
 * each one that is passed over gets a warning with the reason. Everything is verified before a field is
 * filled. Returns 0, STATUS_NO_INPUT (there is no checkpoint; reported), STATUS_IO (none is good; reported)
 * or STATUS_MEMORY. */
int checkpoint_read(const char *folder, const struct field_list *state, struct checkpoint_note *note);

/** The step of the newest manifest of @p folder, good or not; -1: none. */
int64_t checkpoint_newest(const char *folder);

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef OUTPUT_CHECKPOINT_INTERNAL_H
#define OUTPUT_CHECKPOINT_INTERNAL_H

#include "output/checkpoint.h"

#include <stddef.h>

/** The two files of a checkpoint, for checkpoint.c only. */

enum { CHECKPOINT_REASON = 512 }; /**< letters of a reason */

/** Write all state fields to the HDF5 file @p path, closed but not synced. A value that is not finite is
 * refused (STATUS_NUMERICAL). Returns a status (reported). */
int checkpoint_data_write(const char *path, const struct field_list *state);

/** Check the HDF5 file @p path against @p state, then fill that. Returns 0, STATUS_MEMORY (reported) or
 * STATUS_IO with the reason in @p reason (not reported). */
int checkpoint_data_read(const char *path, const struct field_list *state, char reason[CHECKPOINT_REASON]);

/** What a manifest says of its file. */
struct checkpoint_file {
    size_t size;
    uint64_t hash;
};

/** Write the manifest @p path atomically. Returns a status (reported). */
int checkpoint_manifest_write(const char *path, const struct checkpoint_note *note,
                              const struct checkpoint_file *file);

/** Read a manifest. Returns 0, STATUS_MEMORY (reported) or STATUS_IO with a reason (not reported). */
int checkpoint_manifest_read(const char *path, struct checkpoint_note *note, struct checkpoint_file *file,
                             char reason[CHECKPOINT_REASON]);

#endif

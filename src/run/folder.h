// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RUN_FOLDER_H
#define RUN_FOLDER_H

#include "model/model.h"

#include <stdbool.h>

/** Make the output folder @p path with its sub-folders, also those that are filled later only, and lock it. A
 * folder that holds anything is refused (STATUS_CREATE) unless @p force; then only files that a run writes
 * there are removed. */
int folder_create(const char *path, const struct model *model, bool force, int *lock);

/** Keep other processes from writing into an output folder: *@p lock is a descriptor to close at the end, or
 * -1. Returns 0 or STATUS_CREATE (reported: another one does). */
int folder_lock(const char *path, int *lock);

#endif

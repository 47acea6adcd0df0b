// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef RUN_FOLDER_H
#define RUN_FOLDER_H

#include "model/model.h"

#include <stdbool.h>

/** Make the output folder @p path with its sub-folders fields, history and input, and copy the deck into
 * input. A folder that holds anything is refused (STATUS_CREATE) unless @p force; then only files that a run
 * writes there are removed. */
int folder_create(const char *path, const struct model *model, bool force);

#endif

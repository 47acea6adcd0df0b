// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef BASE_FILE_H
#define BASE_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/** A file that appears under its name only when it is whole: written to NAME.tmp, flushed, fsynced, renamed;
 * the folder is fsynced too. */
struct file_atomic {
    FILE *stream; /**< write here */
    char *path, *temporary;
};

/** Open for writing. Returns 0, STATUS_IO or STATUS_MEMORY. */
int file_atomic_open(struct file_atomic *file, const char *path);

/** Flush, fsync, rename over the final name. On any error the temporary file is removed, an older file of
 * that name stays as it was, and STATUS_IO is returned. */
int file_atomic_commit(struct file_atomic *file);

/** Give up: remove the temporary file. Safe after commit. */
void file_atomic_abandon(struct file_atomic *file);

/** Sync the closed file @p temporary, rename it to @p path and sync the folder. Returns 0 or STATUS_IO. */
int file_publish(const char *temporary, const char *path);

/** Keep other processes out of a folder until this one ends: *@p lock is a descriptor to close. Returns 0
 * (also where the file system cannot lock: then *@p lock is -1) or STATUS_CREATE, not reported: another
 * process has it. */
int file_lock_folder(const char *path, int *lock);

/** Read a regular file whole (at most @p limit bytes) into memory with a NUL behind it. *@p data is freed
 * with memory_free. Returns 0, STATUS_NO_INPUT (missing, a folder, not a regular file, too large: reported)
 * or STATUS_IO. */
int file_read(const char *path, size_t limit, char **data, size_t *size);

/** Whether a path that was read from a file stays below the folder that it is relative to. */
bool file_stays_below(const char *path);

/** Create a folder and its parents. Returns 0 or STATUS_CREATE. */
int file_make_folder(const char *path);

#endif

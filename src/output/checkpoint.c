// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/checkpoint.h"

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/log.h"
#include "base/memory.h"
#include "output/checkpoint_internal.h"

#include <dirent.h>
#include <errno.h>
#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char *file_path(const char *folder, int64_t step, const char *ending)
{
    return memory_print("%s/step_%09" PRId64 "%s", folder, step, ending);
}

/** The step in a file name of this form, or -1; the ending goes to @p ending. */
static int64_t step_of(const char *name, const char **ending)
{
    char *end;
    if (strncmp(name, "step_", 5) != 0 || name[5] < '0' || name[5] > '9')
        return -1;
    errno = 0;
    const long long step = strtoll(name + 5, &end, 10);
    *ending = end;
    return errno ? -1 : step;
}

/** Steps of all manifests, newest first; freed with memory_free. A folder that is not there has none. */
static int steps_find(const char *folder, int64_t **steps, size_t *n)
{
    DIR *directory = opendir(folder);
    size_t capacity = 0;
    void *found = NULL;
    int status = 0;
    *n = 0;
    CHECK(directory || errno == ENOENT, STATUS_IO, "%s: cannot read the folder: %s", folder, strerror(errno));
    for (const struct dirent *entry; directory && !status && (entry = readdir(directory));) {
        const char *ending = "";
        const int64_t step = step_of(entry->d_name, &ending);
        if (step < 0 || strcmp(ending, ".manifest") != 0)
            continue;
        status = memory_grow(&found, &capacity, *n + 1, sizeof **steps);
        size_t place = *n;
        for (; !status && place > 0 && ((int64_t *)found)[place - 1] < step; --place)
            ((int64_t *)found)[place] = ((int64_t *)found)[place - 1];
        if (!status) {
            ((int64_t *)found)[place] = step;
            ++*n;
        }
    }
    if (directory)
        closedir(directory);
    *steps = found;
    return status;
}

int64_t checkpoint_newest(const char *folder)
{
    int64_t *steps = NULL, newest = -1;
    size_t n;
    if (!steps_find(folder, &steps, &n) && n > 0)
        newest = steps[0];
    memory_free(steps);
    return newest;
}

/** Remove the files of all checkpoints but two, manifests first: what has lost its manifest is none. */
static void others_remove(const char *folder, int64_t newest, int64_t keep)
{
    static const char *const endings[] = {".manifest", ".manifest.tmp", ".h5", ".h5.tmp"};
    for (size_t k = 0; k < sizeof endings / sizeof *endings; ++k) {
        DIR *directory = opendir(folder);
        for (const struct dirent *entry; directory && (entry = readdir(directory));) {
            const char *ending = "";
            const int64_t step = step_of(entry->d_name, &ending);
            if (step < 0 || step == newest || step == keep || strcmp(ending, endings[k]) != 0)
                continue;
            char *path = memory_print("%s/%s", folder, entry->d_name);
            if (path && unlink(path))
                log_message(LOG_WARNING, "%s: cannot be removed: %s", path, strerror(errno));
            memory_free(path);
        }
        if (directory)
            closedir(directory);
    }
}

/** Data file, then manifest. */
static int pair_write(const char *data, const char *temporary, const char *manifest,
                      const struct field_list *state, const struct checkpoint_note *note)
{
    struct checkpoint_file file;
    int status = checkpoint_data_write(temporary, state);
    if (!status)
        status = hash_file(temporary, &file.hash, &file.size);
    if (!status)
        status = file_publish(temporary, data);
    if (status) {
        unlink(temporary);
        return status;
    }
    return checkpoint_manifest_write(manifest, note, &file);
}

int checkpoint_write(const char *folder, const struct field_list *state, const struct checkpoint_note *note,
                     int64_t keep)
{
    CALL(file_make_folder(folder));
    char *data = file_path(folder, note->step, ".h5"), *temporary = file_path(folder, note->step, ".h5.tmp"),
         *manifest = file_path(folder, note->step, ".manifest");
    int status = data && temporary && manifest ? 0 : STATUS_MEMORY;
    if (!status)
        status = pair_write(data, temporary, manifest, state, note);
    if (!status)
        others_remove(folder, note->step, keep);
    memory_free(data);
    memory_free(temporary);
    memory_free(manifest);
    return status;
}

/** Compare the data file with its manifest. */
static int file_verify(const char *path, const struct checkpoint_file *file, char reason[CHECKPOINT_REASON])
{
    uint64_t hash;
    size_t size;
    if (access(path, R_OK))
        snprintf(reason, CHECKPOINT_REASON, "its data cannot be read: %s", strerror(errno));
    else if (hash_file(path, &hash, &size))
        snprintf(reason, CHECKPOINT_REASON, "its data cannot be read");
    else if (size != file->size)
        snprintf(reason, CHECKPOINT_REASON, "its data have %zu bytes instead of %zu", size, file->size);
    else if (hash != file->hash)
        snprintf(reason, CHECKPOINT_REASON, "its data are damaged (their hash is another)");
    else
        return 0;
    return STATUS_IO;
}

static int step_read(const char *folder, int64_t step, const struct field_list *state,
                     struct checkpoint_note *note, char reason[CHECKPOINT_REASON])
{
    struct checkpoint_file file;
    char *data = file_path(folder, step, ".h5"), *manifest = file_path(folder, step, ".manifest");
    int status = data && manifest ? 0 : STATUS_MEMORY;
    if (!status)
        status = checkpoint_manifest_read(manifest, note, &file, reason);
    if (!status && note->step != step) {
        snprintf(reason, CHECKPOINT_REASON, "its manifest is that of step %" PRId64, note->step);
        status = STATUS_IO;
    }
    if (!status)
        status = file_verify(data, &file, reason);
    if (!status)
        status = checkpoint_data_read(data, state, reason);
    memory_free(data);
    memory_free(manifest);
    return status;
}

int checkpoint_read(const char *folder, const struct field_list *state, struct checkpoint_note *note)
{
    int64_t *steps = NULL;
    size_t n;
    int status = steps_find(folder, &steps, &n);
    if (!status && n == 0)
        status = error_report(
            STATUS_NO_INPUT, "%s: there is no checkpoint: the run ended before its first one; start it again",
            folder);
    bool found = false;
    for (size_t k = 0; k < n && !status && !found; ++k) {
        char reason[CHECKPOINT_REASON] = "";
        const int result = step_read(folder, steps[k], state, note, reason);
        found = result == 0;
        if (result && !*reason)
            status = result;
        else if (result)
            log_message(LOG_WARNING, "%s: the checkpoint of step %" PRId64 " cannot be used: %s%s", folder,
                        steps[k], reason, k + 1 < n ? "; the one before it is taken" : "");
    }
    if (!status && !found)
        status = error_report(STATUS_IO, "%s: no checkpoint can be used; start the run again", folder);
    memory_free(steps);
    return status;
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/folder.h"

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"

#include <dirent.h>
#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/** What a run writes: names in the folder itself, and endings in its sub-folders. */
static const char *const own_files[] = {"log.txt", "status.json", "summary.json", "view.py", "blowup.vtu"};
static const struct {
    const char *folder, *ending;
} own_folders[] = {{"fields", ".vtu"}, {"history", ".csv"}, {"input", ".xml"}, {"checkpoint", ".h5"}};

static bool name_ends(const char *name, const char *ending)
{
    size_t n = strlen(name), m = strlen(ending);
    return n >= m && !strcmp(name + n - m, ending);
}

static int folder_empty(const char *path, bool *empty)
{
    DIR *folder = opendir(path);
    *empty = true;
    if (!folder) {
        CHECK(errno == ENOENT, STATUS_CREATE, "%s: %s; name another folder with -o", path, strerror(errno));
        return 0;
    }
    for (const struct dirent *entry; (entry = readdir(folder));)
        if (strcmp(entry->d_name, ".") && strcmp(entry->d_name, ".."))
            *empty = false;
    closedir(folder);
    return 0;
}

/** Remove files of @p path whose name ends in @p ending (or in it and ".tmp"). */
static int files_remove(const char *path, const char *ending)
{
    DIR *folder = opendir(path);
    int status = 0;
    if (!folder)
        return 0;
    char *temporary = memory_print("%s.tmp", ending);
    if (!temporary)
        status = STATUS_MEMORY;
    for (const struct dirent *entry; !status && (entry = readdir(folder));) {
        if (!name_ends(entry->d_name, ending) && !name_ends(entry->d_name, temporary))
            continue;
        char *file = memory_print("%s/%s", path, entry->d_name);
        if (!file)
            status = STATUS_MEMORY;
        else if (unlink(file))
            status = error_report(STATUS_CREATE, "%s: cannot remove: %s", file, strerror(errno));
        memory_free(file);
    }
    memory_free(temporary);
    closedir(folder);
    return status;
}

static int old_run_remove(const char *path, const struct model *model)
{
    char *series = memory_print("%s.pvd", model->name);
    CHECK_MEMORY(series);
    int status = files_remove(path, series);
    memory_free(series);
    for (size_t k = 0; k < sizeof own_files / sizeof *own_files && !status; ++k)
        status = files_remove(path, own_files[k]);
    for (size_t k = 0; k < sizeof own_folders / sizeof *own_folders && !status; ++k) {
        char *folder = memory_print("%s/%s", path, own_folders[k].folder);
        CHECK_MEMORY(folder);
        status = files_remove(folder, own_folders[k].ending);
        memory_free(folder);
    }
    return status;
}

static int subfolder_create(const char *path, const char *name)
{
    char *folder = memory_print("%s/%s", path, name);
    CHECK_MEMORY(folder);
    int status = file_make_folder(folder);
    memory_free(folder);
    return status;
}

static int deck_copy(const char *path, const struct model *model)
{
    char *text = NULL, *target = NULL;
    size_t size;
    CALL(file_read(model->path, (size_t)64 << 20, &text, &size));
    target = memory_print("%s/input/%s.xml", path, model->name);
    struct file_atomic file;
    int status = target ? file_atomic_open(&file, target) : STATUS_MEMORY;
    if (!status && fwrite(text, 1, size, file.stream) != size) {
        status = error_report(STATUS_IO, "%s: %s", target, strerror(errno));
        file_atomic_abandon(&file);
    }
    if (!status)
        status = file_atomic_commit(&file);
    memory_free(target);
    memory_free(text);
    return status;
}

int folder_create(const char *path, const struct model *model, bool force)
{
    bool empty;
    CALL(folder_empty(path, &empty));
    CHECK(
        empty || force, STATUS_CREATE,
        "%s: the folder is not empty; use --force to replace an earlier run there, or -o for another folder",
        path);
    if (!empty)
        CALL(old_run_remove(path, model));
    static const char *const subfolders[] = {"fields", "history", "input"};
    CALL(file_make_folder(path));
    for (size_t k = 0; k < sizeof subfolders / sizeof *subfolders; ++k)
        CALL(subfolder_create(path, subfolders[k]));
    return deck_copy(path, model);
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/folder.h"

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"
#include "run/record.h"

#include <dirent.h>
#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { LOCK_ATTEMPTS = 10 };

/** What a run writes: names in the folder itself, and endings in its sub-folders. */
static const char *const own_files[] = {"log.txt", "status.json", "summary.json",
                                        "view.py", "blowup.vtu",  "stop"};
static const struct {
    const char *folder, *ending;
} own_folders[] = {{"fields", ".vtu"},          {"history", ".csv"}, {"input", ".xml"}, {"checkpoint", ".h5"},
                   {"checkpoint", ".manifest"}, {"probe", ".vti"},   {"probe", ".pvd"}};

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

/** Remove the file @p name of folder @p path, and its temporary one, if they are there. */
static int file_remove(const char *path, const char *name)
{
    static const char *const endings[] = {"", ".tmp"};
    int status = 0;
    for (size_t k = 0; k < sizeof endings / sizeof *endings && !status; ++k) {
        char *file = memory_print("%s/%s%s", path, name, endings[k]);
        CHECK_MEMORY(file);
        if (unlink(file) && errno != ENOENT)
            status = error_report(STATUS_CREATE, "%s: cannot remove: %s", file, strerror(errno));
        memory_free(file);
    }
    return status;
}

static int old_run_remove(const char *path, const struct model *model)
{
    char *series = memory_print("%s.pvd", model->name);
    CHECK_MEMORY(series);
    int status = file_remove(path, series);
    memory_free(series);
    if (!status)
        status = record_remove(path);
    for (size_t k = 0; k < sizeof own_files / sizeof *own_files && !status; ++k)
        status = file_remove(path, own_files[k]);
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

int folder_lock(const char *path, int *lock)
{
    /* "skerry status" holds the lock for a moment to see whether it is free */
    const struct timespec moment = {.tv_nsec = 20000000};
    int status = file_lock_folder(path, lock);
    for (int attempt = 0; status && attempt < LOCK_ATTEMPTS; ++attempt) {
        nanosleep(&moment, NULL);
        status = file_lock_folder(path, lock);
    }
    CHECK(!status, STATUS_CREATE,
          "%s: another skerry is writing there (\"skerry status %s\" tells which); wait for it or stop it",
          path, path);
    return 0;
}

int folder_create(const char *path, const struct model *model, bool force, int *lock)
{
    bool empty;
    CALL(folder_empty(path, &empty));
    CHECK(
        empty || force, STATUS_CREATE,
        "%s: the folder is not empty; go on with an earlier run there with \"skerry resume %s\", replace it "
        "with --force, or name another folder with -o",
        path, path);
    CALL(file_make_folder(path));
    CALL(folder_lock(path, lock));
    if (!empty)
        CALL(old_run_remove(path, model));
    static const char *const subfolders[] = {"fields", "history", "input", "checkpoint"};
    for (size_t k = 0; k < sizeof subfolders / sizeof *subfolders; ++k)
        CALL(subfolder_create(path, subfolders[k]));
    return 0;
}

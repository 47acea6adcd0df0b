// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/file.h"

#include "base/error.h"
#include "base/memory.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

// Free what file_atomic_open made, without touching the disk.
static void file_atomic_reset(struct file_atomic *file)
{
    memory_free(file->path);
    memory_free(file->temporary);
    *file = (struct file_atomic){0};
}

int file_atomic_open(struct file_atomic *file, const char *path)
{
    *file = (struct file_atomic){.path = memory_text(path), .temporary = memory_print("%s.tmp", path)};
    if (!file->path || !file->temporary) {
        file_atomic_reset(file);
        return STATUS_MEMORY;
    }
    file->stream = fopen(file->temporary, "we");
    if (!file->stream) {
        error_report(STATUS_IO, "%s: cannot open for writing: %s", file->temporary, strerror(errno));
        file_atomic_reset(file);
        return STATUS_IO;
    }
    return STATUS_OK;
}

// Make a rename in the folder of @p path last; returns 0 or -1 with errno.
static int sync_folder(const char *path)
{
    const char *slash = strrchr(path, '/');
    char *folder = slash ? memory_print("%.*s", (int)(slash - path + 1), path) : memory_text(".");

    if (!folder) {
        errno = ENOMEM;
        return -1;
    }
    const int descriptor = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    memory_free(folder);
    if (descriptor < 0)
        return -1;
    // Some file systems cannot sync a folder and say EINVAL: there is nothing more to do there.
    const int result = fsync(descriptor) && errno != EINVAL ? -1 : 0;
    const int error = errno;
    close(descriptor);
    errno = error;
    return result;
}

int file_atomic_commit(struct file_atomic *file)
{
    FILE *stream = file->stream;
    const char *failed = NULL;
    int error = 0;

    errno = 0;
    if (ferror(stream)) {
        // Which error that was is not known any more; what made a write fail makes another one fail.
        clearerr(stream);
        if (fseek(stream, 0, SEEK_END) == 0 && fputc('\n', stream) != EOF)
            fflush(stream);
        failed = "write";
    } else if (fflush(stream)) {
        failed = "write";
    }
    if (!failed && fsync(fileno(stream)))
        failed = "sync";
    error = errno;
    file->stream = NULL;
    if (fclose(stream) && !failed) {
        failed = "close";
        error = errno;
    }
    if (!failed && rename(file->temporary, file->path)) {
        failed = "rename to its final name";
        error = errno;
    }
    if (!failed) {
        if (sync_folder(file->path)) {
            error_report(STATUS_IO, "%s: cannot sync its folder: %s", file->path, strerror(errno));
            file_atomic_reset(file);
            return STATUS_IO;
        }
        file_atomic_reset(file);
        return STATUS_OK;
    }
    error_report(STATUS_IO, "%s: cannot %s: %s", file->temporary, failed,
                 error ? strerror(error) : "an earlier write failed");
    file_atomic_abandon(file);
    return STATUS_IO;
}

int file_publish(const char *temporary, const char *path)
{
    const int descriptor = open(temporary, O_RDWR | O_CLOEXEC);
    const bool synced = descriptor >= 0 && fsync(descriptor) == 0;
    const int error = errno;
    if (descriptor >= 0)
        close(descriptor);
    CHECK(synced, STATUS_IO, "%s: cannot sync: %s", temporary, strerror(error));
    CHECK(!rename(temporary, path), STATUS_IO, "%s: cannot rename to its final name: %s", temporary,
          strerror(errno));
    CHECK(!sync_folder(path), STATUS_IO, "%s: cannot sync its folder: %s", path, strerror(errno));
    return STATUS_OK;
}

int file_lock_folder(const char *path, int *lock)
{
    *lock = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (*lock < 0 || flock(*lock, LOCK_EX | LOCK_NB) == 0)
        return STATUS_OK;
    const bool taken = errno == EWOULDBLOCK;
    close(*lock);
    *lock = -1;
    return taken ? STATUS_CREATE : STATUS_OK;
}

void file_atomic_abandon(struct file_atomic *file)
{
    if (file->stream)
        fclose(file->stream);
    if (file->temporary)
        unlink(file->temporary);
    file_atomic_reset(file);
}

// Read what the open file holds; its size is known and may not be trusted (it may grow or shrink meanwhile).
static int read_whole(int descriptor, const char *path, char *data, size_t size)
{
    size_t done = 0;

    while (done < size) {
        const ssize_t n = read(descriptor, data + done, size - done);
        if (n < 0 && errno == EINTR)
            continue;
        CHECK(n >= 0, STATUS_IO, "%s: cannot read: %s", path, strerror(errno));
        CHECK(n > 0, STATUS_IO, "%s: ends after %zu of %zu bytes: it changed while it was read", path, done,
              size);
        done += (size_t)n;
    }
    return STATUS_OK;
}

static int read_descriptor(int descriptor, const char *path, size_t limit, char **data, size_t *size)
{
    struct stat about;

    CHECK(!fstat(descriptor, &about), STATUS_IO, "%s: cannot read: %s", path, strerror(errno));
    CHECK(!S_ISDIR(about.st_mode), STATUS_NO_INPUT, "%s: is a folder, not a file", path);
    CHECK(S_ISREG(about.st_mode), STATUS_NO_INPUT, "%s: is not a regular file", path);
    CHECK((unsigned long long)about.st_size <= limit, STATUS_NO_INPUT,
          "%s: has %lld bytes; at most %zu are read", path, (long long)about.st_size, limit);

    char *content = memory_create((size_t)about.st_size + 1, 1);
    CHECK_MEMORY(content);
    const int status = read_whole(descriptor, path, content, (size_t)about.st_size);
    if (status) {
        memory_free(content);
        return status;
    }
    *data = content;
    *size = (size_t)about.st_size;
    return STATUS_OK;
}

int file_read(const char *path, size_t limit, char **data, size_t *size)
{
    // Not blocking: opening a FIFO must not wait for a writer.
    const int descriptor = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);

    CHECK(descriptor >= 0, STATUS_NO_INPUT, "%s: cannot open: %s", path, strerror(errno));
    const int status = read_descriptor(descriptor, path, limit, data, size);
    close(descriptor);
    return status;
}

bool file_stays_below(const char *path)
{
    if (*path == '/' || *path == '\0')
        return false;
    for (const char *part = path;; ++part) {
        const size_t length = strcspn(part, "/");
        if (length == 2 && strncmp(part, "..", 2) == 0)
            return false;
        part += length;
        if (!*part)
            return true;
    }
}

// Create one folder unless it is there; @p path may end with a slash.
static int make_one_folder(const char *path)
{
    struct stat about;

    if (mkdir(path, 0777) == 0)
        return STATUS_OK;
    const int error = errno;
    if (stat(path, &about) == 0 && S_ISDIR(about.st_mode))
        return STATUS_OK;
    return error_report(STATUS_CREATE, "%s: cannot create the folder: %s", path,
                        strerror(error == EEXIST ? ENOTDIR : error));
}

int file_make_folder(const char *path)
{
    char *copy = memory_text(path);
    int status = STATUS_OK;

    CHECK_MEMORY(copy);
    for (char *slash = strchr(copy + (*copy == '/'), '/'); slash && !status; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        status = make_one_folder(copy);
        *slash = '/';
    }
    if (!status)
        status = make_one_folder(copy);
    memory_free(copy);
    return status;
}

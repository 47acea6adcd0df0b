// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TESTS_OUTPUT_FOLDER_H
#define TESTS_OUTPUT_FOLDER_H

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/** A folder of its own for a test, removed with the files in it at the end. */

struct folder {
    char path[64];
};

static inline void folder_create(struct folder *folder)
{
    strcpy(folder->path, "/tmp/skerry-output-XXXXXX");
    assert_non_null(mkdtemp(folder->path));
}

/** The path of a file in the folder, in @p path. */
static inline const char *folder_file(const struct folder *folder, const char *name, char path[256])
{
    snprintf(path, 256, "%s/%s", folder->path, name);
    return path;
}

/** Number of entries. */
static inline int folder_count(const char *path)
{
    int n = 0;
    DIR *stream = opendir(path);
    for (struct dirent *entry; stream && (entry = readdir(stream));)
        n += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
    if (stream)
        closedir(stream);
    return n;
}

static inline void folder_remove(const char *path)
{
    DIR *stream = opendir(path);
    for (struct dirent *entry; stream && (entry = readdir(stream));) {
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0)
            continue;
        char *file = malloc(strlen(path) + strlen(entry->d_name) + 2);
        if (!file)
            break;
        sprintf(file, "%s/%s", path, entry->d_name);
        if (unlink(file) != 0)
            folder_remove(file);
        free(file);
    }
    if (stream)
        closedir(stream);
    rmdir(path);
}

/** A file as text with a NUL behind it, in memory of malloc. */
static inline char *folder_read(const char *path, size_t *size)
{
    FILE *stream = fopen(path, "rb");
    assert_non_null(stream);
    fseek(stream, 0, SEEK_END);
    size_t n = (size_t)ftell(stream);
    rewind(stream);
    char *text = malloc(n + 1);
    assert_non_null(text);
    assert_int_equal(fread(text, 1, n, stream), n);
    text[n] = '\0';
    fclose(stream);
    if (size)
        *size = n;
    return text;
}

static inline void folder_write(const char *path, const char *data, size_t size)
{
    FILE *stream = fopen(path, "wb");
    assert_non_null(stream);
    assert_int_equal(fwrite(data, 1, size, stream), size);
    fclose(stream);
}

/** Set-up and teardown of a test that runs with a folder of its own as its state. */
static inline int folder_enter(void **state)
{
    static struct folder folder;
    folder_create(&folder);
    *state = &folder;
    return 0;
}

static inline int folder_leave(void **state)
{
    folder_remove(((struct folder *)*state)->path);
    return 0;
}

#endif

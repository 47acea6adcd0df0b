// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/record.h"

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/memory.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { FILE_LIMIT = 1 << 30, RECORD_LIMIT = 1 << 24 }; // bytes

static const char first_line[] = "skerry-input 1\n";

/** Write @p size bytes of @p text to @p path, atomically. */
static int bytes_save(const char *path, const char *text, size_t size)
{
    struct file_atomic file;
    CALL(file_atomic_open(&file, path));
    if (fwrite(text, 1, size, file.stream) != size) {
        const int status = error_report(STATUS_IO, "%s: cannot write: %s", path, strerror(errno));
        file_atomic_abandon(&file);
        return status;
    }
    return file_atomic_commit(&file);
}

static int input_copy(const char *output, const struct model_input *input)
{
    char *text = NULL;
    size_t size;
    CALL(file_read(input->path, FILE_LIMIT, &text, &size));
    char *target = memory_print("%s/input/%s", output, input->name);
    char *folder = target ? memory_print("%.*s", (int)(strrchr(target, '/') - target), target) : NULL;
    int status = target && folder ? 0 : STATUS_MEMORY;
    if (!status && hash_bytes(text, size) != input->hash)
        status =
            error_report(STATUS_IO, "%s: has changed since it was read; start the run again", input->path);
    if (!status)
        status = file_make_folder(folder);
    if (!status)
        status = bytes_save(target, text, size);
    memory_free(folder);
    memory_free(target);
    memory_free(text);
    return status;
}

/** An override is one line. */
static void set_print(FILE *stream, const char *override)
{
    fputs("set ", stream);
    for (; *override; ++override)
        fputc(*override == '\n' || *override == '\r' ? ' ' : *override, stream);
    fputc('\n', stream);
}

static int record_save(const char *output, const char *text)
{
    struct file_atomic file;
    char *path = memory_print("%s/input/record", output);
    CHECK_MEMORY(path);
    int status = file_atomic_open(&file, path);
    if (!status) {
        hash_seal(file.stream, text);
        status = file_atomic_commit(&file);
    }
    memory_free(path);
    return status;
}

/** The lines that a resumed run adds to. */
static void lines_print(FILE *stream, const char *isa, size_t n_overrides, const char *const *overrides)
{
    if (isa)
        fprintf(stream, "isa %s\n", isa);
    for (size_t k = 0; k < n_overrides; ++k)
        set_print(stream, overrides[k]);
}

int record_create(const char *output, const struct model *model, const char *isa, size_t n_overrides,
                  const char *const *overrides)
{
    for (size_t k = 0; k < model->n_inputs; ++k) {
        const char *name = model->inputs[k].name;
        CHECK(
            strcmp(name, "record") != 0 && !strchr(name, '\n'), STATUS_CREATE,
            "%s: cannot be copied to %s/input, where \"record\" is skerry's own file and a name is one line: "
            "rename it",
            model->inputs[k].path, output);
        CALL(input_copy(output, &model->inputs[k]));
    }
    char *text = NULL, hash[HASH_TEXT];
    size_t size;
    FILE *stream = open_memstream(&text, &size);
    CHECK(stream, STATUS_MEMORY, "out of memory: cannot record the run");
    fprintf(stream, "%sdeck %s\n", first_line, model->inputs[0].name);
    for (size_t k = 0; k < model->n_inputs; ++k) {
        hash_print(model->inputs[k].hash, hash);
        fprintf(stream, "file %s %zu %s\n", hash, model->inputs[k].size, model->inputs[k].name);
    }
    lines_print(stream, isa, n_overrides, overrides);
    const int status = fclose(stream) ? error_report(STATUS_MEMORY, "out of memory: cannot record the run")
                                      : record_save(output, text);
    free(text);
    return status;
}

/** The record without its last line. */
static int record_text(const char *output, char **text)
{
    size_t size;
    char *path = memory_print("%s/input/record", output);
    CHECK_MEMORY(path);
    if (access(path, R_OK)) {
        const int error = errno;
        memory_free(path);
        return error_report(STATUS_NO_INPUT, "%s: is not the output folder of a run (input/record: %s)",
                            output, strerror(error));
    }
    const int status = file_read(path, RECORD_LIMIT, text, &size);
    memory_free(path);
    CALL(status);
    if (hash_unseal(*text, size))
        return 0;
    memory_free(*text);
    return error_report(STATUS_IO, "%s/input/record: is damaged or has been changed; start a new run",
                        output);
}

/** Compare a file of the input folder with its line "HASH SIZE NAME". */
static int file_line(const char *output, const char *line)
{
    uint64_t wanted, hash;
    size_t wanted_size, size;
    int name = 0;
    CHECK(sscanf(line, "fnv1a64:%" SCNx64 " %zu %n", &wanted, &wanted_size, &name) == 2 && name > 0,
          STATUS_IO, "%s/input/record: damaged: \"%s\"", output, line);
    CHECK(file_stays_below(line + name), STATUS_IO, "%s/input/record: \"%s\" leads out of the folder", output,
          line + name);
    char *path = memory_print("%s/input/%s", output, line + name);
    CHECK_MEMORY(path);
    int status = hash_file(path, &hash, &size);
    if (!status && (hash != wanted || size != wanted_size))
        status = error_report(STATUS_IO,
                              "%s: is not the file that the run was started with; put that back, or start a "
                              "new run",
                              path);
    memory_free(path);
    return status == STATUS_NO_INPUT ? STATUS_IO : status;
}

static int override_line(struct record *record, const char *line)
{
    size_t capacity = record->n_overrides;
    void *overrides = record->overrides;
    CALL(memory_grow(&overrides, &capacity, record->n_overrides + 1, sizeof *record->overrides));
    record->overrides = overrides;
    CHECK_MEMORY(record->overrides[record->n_overrides] = memory_text(line));
    ++record->n_overrides;
    return 0;
}

static int record_line(struct record *record, const char *output, const char *line)
{
    if (strncmp(line, "deck ", 5) == 0 && !record->deck) {
        CHECK(!strchr(line + 5, '/'), STATUS_IO, "%s/input/record: \"%s\" leads out of the folder", output,
              line + 5);
        CHECK_MEMORY(record->deck = memory_print("%s/input/%s", output, line + 5));
        return 0;
    }
    if (strncmp(line, "file ", 5) == 0)
        return file_line(output, line + 5);
    if (strncmp(line, "isa ", 4) == 0 && strlen(line + 4) < sizeof record->isa) {
        strcpy(record->isa, line + 4);
        return 0;
    }
    if (strncmp(line, "set ", 4) == 0)
        return override_line(record, line + 4);
    return error_report(STATUS_IO, "%s/input/record: damaged: \"%s\"", output, line);
}

static int record_lines(struct record *record, const char *output, char *text)
{
    CHECK(strncmp(text, first_line, strlen(first_line)) == 0, STATUS_IO,
          "%s/input/record: is of another version of skerry", output);
    char *line = text + strlen(first_line);
    for (char *end; (end = strchr(line, '\n')); line = end + 1) {
        *end = '\0';
        CALL(record_line(record, output, line));
    }
    CHECK(*line == '\0' && record->deck, STATUS_IO, "%s/input/record: damaged: it names no deck", output);
    return 0;
}

int record_read(struct record *record, const char *output)
{
    char *text = NULL;
    *record = (struct record){.isa = "auto"};
    CALL(record_text(output, &text));
    const int status = record_lines(record, output, text);
    memory_free(text);
    if (status)
        record_reset(record);
    return status;
}

void record_reset(struct record *record)
{
    for (size_t k = 0; k < record->n_overrides; ++k)
        memory_free(record->overrides[k]);
    memory_free(record->overrides);
    memory_free(record->deck);
    *record = (struct record){.deck = NULL};
}

int record_add(const char *output, const char *isa, size_t n_overrides, const char *const *overrides)
{
    char *before = NULL, *text = NULL;
    size_t size;
    if (!isa && n_overrides == 0)
        return 0;
    CALL(record_text(output, &before));
    FILE *stream = open_memstream(&text, &size);
    int status = stream ? 0 : error_report(STATUS_MEMORY, "out of memory: cannot record the run");
    if (stream) {
        fputs(before, stream);
        lines_print(stream, isa, n_overrides, overrides);
        status = fclose(stream) ? error_report(STATUS_MEMORY, "out of memory: cannot record the run")
                                : record_save(output, text);
    }
    memory_free(before);
    free(text);
    return status;
}

int record_remove(const char *output)
{
    char *path = memory_print("%s/input/record", output), *text = NULL;
    size_t size;
    CHECK_MEMORY(path);
    int status = access(path, F_OK) ? 0 : file_read(path, RECORD_LIMIT, &text, &size);
    status = status == STATUS_NO_INPUT ? STATUS_CREATE : status;
    for (char *line = text, *end; !status && line && (end = strchr(line, '\n')); line = end + 1) {
        int name = 0;
        *end = '\0';
        if (sscanf(line, "file %*s %*s %n", &name) != 0 || name == 0 || !file_stays_below(line + name))
            continue;
        char *file = memory_print("%s/input/%s", output, line + name);
        status = file ? 0 : STATUS_MEMORY;
        if (file && unlink(file) && errno != ENOENT)
            status = error_report(STATUS_CREATE, "%s: cannot remove: %s", file, strerror(errno));
        memory_free(file);
    }
    if (!status && text && unlink(path) && errno != ENOENT)
        status = error_report(STATUS_CREATE, "%s: cannot remove: %s", path, strerror(errno));
    memory_free(text);
    memory_free(path);
    return status;
}

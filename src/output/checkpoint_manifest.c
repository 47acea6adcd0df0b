// SPDX-License-Identifier: GPL-3.0-or-later
// The manifest of a checkpoint: lines "key value" in a fixed order, the last of which is the hash of all
// before.
#include "output/checkpoint_internal.h"

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/memory.h"

#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MANIFEST_LIMIT = 1 << 16 }; // bytes

static const char first_line[] = "skerry-checkpoint 1";

static char *manifest_text(const struct checkpoint_note *note, const struct checkpoint_file *file)
{
    char hash[HASH_TEXT], *text = NULL;
    size_t size;
    FILE *stream = open_memstream(&text, &size);
    if (!stream)
        return NULL;
    hash_print(file->hash, hash);
    fprintf(stream, "%s\nsize %zu\nhash %s\nstep %" PRId64 "\nt %.17g\nwall_s %.17g\nupdates %.17g\n",
            first_line, file->size, hash, note->step, note->t, note->wall_s, note->updates);
    for (int p = 0; p < TIMER_PHASES; ++p)
        fprintf(stream, "%s_s %.17g\n", timer_phase_name((enum timer_phase)p), note->phases_s[p]);
    fprintf(stream, "version %s\nrevision %s\nisa %s\n", note->version, note->revision, note->isa);
    if (fclose(stream)) {
        free(text);
        return NULL;
    }
    return text;
}

int checkpoint_manifest_write(const char *path, const struct checkpoint_note *note,
                              const struct checkpoint_file *file)
{
    char *text = manifest_text(note, file);
    CHECK(text, STATUS_MEMORY, "out of memory: cannot make the manifest of a checkpoint");
    struct file_atomic out;
    int status = file_atomic_open(&out, path);
    if (!status) {
        hash_seal(out.stream, text);
        status = file_atomic_commit(&out);
    }
    free(text);
    return status;
}

/** The value of the next line, which must have the key @p key; NULL: it has another. */
static char *line_take(char **rest, const char *key)
{
    char *line = *rest, *end = line ? strchr(line, '\n') : NULL;
    const size_t length = strlen(key);
    if (!end || strncmp(line, key, length) != 0 || line[length] != ' ')
        return NULL;
    *end = '\0';
    *rest = end + 1;
    return line + length + 1;
}

static bool number_take(char **rest, const char *key, double *value)
{
    char *text = line_take(rest, key), *end;
    *value = text ? strtod(text, &end) : NAN;
    return text && end > text && !*end && isfinite(*value);
}

static bool whole_take(char **rest, const char *key, int64_t *value)
{
    char *text = line_take(rest, key), *end;
    *value = text ? strtoll(text, &end, 10) : 0;
    return text && end > text && !*end && *value >= 0;
}

static bool word_take(char **rest, const char *key, char *word, size_t size)
{
    const char *text = line_take(rest, key);
    if (text)
        snprintf(word, size, "%s", text);
    return text != NULL;
}

static bool lines_take(char *rest, struct checkpoint_note *note, struct checkpoint_file *file)
{
    char hash[HASH_TEXT], key[32];
    int64_t size;
    const char *first = line_take(&rest, "skerry-checkpoint");
    bool good = first && strcmp(first, "1") == 0 && whole_take(&rest, "size", &size) &&
                word_take(&rest, "hash", hash, sizeof hash) &&
                sscanf(hash, "fnv1a64:%16" SCNx64, &file->hash) == 1 &&
                whole_take(&rest, "step", &note->step) && number_take(&rest, "t", &note->t) &&
                number_take(&rest, "wall_s", &note->wall_s) && number_take(&rest, "updates", &note->updates);
    for (int p = 0; p < TIMER_PHASES && good; ++p) {
        snprintf(key, sizeof key, "%s_s", timer_phase_name((enum timer_phase)p));
        good = number_take(&rest, key, &note->phases_s[p]);
    }
    if (good)
        file->size = (size_t)size;
    return good && word_take(&rest, "version", note->version, sizeof note->version) &&
           word_take(&rest, "revision", note->revision, sizeof note->revision) &&
           word_take(&rest, "isa", note->isa, sizeof note->isa) && *rest == '\0';
}

int checkpoint_manifest_read(const char *path, struct checkpoint_note *note, struct checkpoint_file *file,
                             char reason[CHECKPOINT_REASON])
{
    char *text = NULL;
    size_t size;
    *note = (struct checkpoint_note){.step = 0};
    *file = (struct checkpoint_file){.size = 0};
    const int status = file_read(path, MANIFEST_LIMIT, &text, &size);
    if (status == STATUS_MEMORY)
        return status;
    const bool whole = !status && hash_unseal(text, size);
    const bool known = whole && lines_take(text, note, file);
    memory_free(text);
    if (known)
        return 0;
    snprintf(reason, CHECKPOINT_REASON, "%s",
             status  ? "its manifest cannot be read"
             : whole ? "its manifest is of another version of skerry"
                     : "its manifest is damaged");
    return STATUS_IO;
}

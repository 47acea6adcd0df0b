// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/hash.h"

#include "base/error.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { PIECE = 1 << 16 }; // bytes read at once

static const uint64_t hash_start = 0xcbf29ce484222325U;

static uint64_t hash_more(uint64_t hash, const unsigned char *data, size_t size)
{
    for (size_t i = 0; i < size; ++i)
        hash = (hash ^ data[i]) * 0x100000001b3U;
    return hash;
}

uint64_t hash_bytes(const void *data, size_t size)
{
    return hash_more(hash_start, data, size);
}

static int descriptor_hash(int descriptor, const char *path, uint64_t *hash, size_t *size)
{
    unsigned char piece[PIECE];
    struct stat about;
    CHECK(!fstat(descriptor, &about), STATUS_IO, "%s: cannot read: %s", path, strerror(errno));
    CHECK(S_ISREG(about.st_mode), STATUS_NO_INPUT, "%s: is not a regular file", path);
    *hash = hash_start;
    *size = 0;
    for (;;) {
        const ssize_t n = read(descriptor, piece, sizeof piece);
        if (n < 0 && errno == EINTR)
            continue;
        CHECK(n >= 0, STATUS_IO, "%s: cannot read: %s", path, strerror(errno));
        if (n == 0)
            return 0;
        *hash = hash_more(*hash, piece, (size_t)n);
        *size += (size_t)n;
    }
}

int hash_file(const char *path, uint64_t *hash, size_t *size)
{
    size_t length;
    const int descriptor = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    CHECK(descriptor >= 0, STATUS_NO_INPUT, "%s: cannot open: %s", path, strerror(errno));
    const int status = descriptor_hash(descriptor, path, hash, size ? size : &length);
    close(descriptor);
    return status;
}

void hash_print(uint64_t hash, char text[HASH_TEXT])
{
    snprintf(text, HASH_TEXT, "fnv1a64:%016" PRIx64, hash);
}

void hash_seal(FILE *stream, const char *text)
{
    char hash[HASH_TEXT];
    hash_print(hash_bytes(text, strlen(text)), hash);
    fprintf(stream, "%send %s\n", text, hash);
}

bool hash_unseal(char *text, size_t size)
{
    char wanted[HASH_TEXT];
    const size_t tail = strlen("end ") + HASH_TEXT - 1 + 1;
    if (size < tail || strlen(text) != size)
        return false;
    char *last = text + size - tail;
    hash_print(hash_bytes(text, (size_t)(last - text)), wanted);
    const bool good = strncmp(last, "end ", 4) == 0 && strncmp(last + 4, wanted, HASH_TEXT - 1) == 0 &&
                      text[size - 1] == '\n';
    *last = '\0';
    return good;
}

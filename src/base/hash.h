// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef BASE_HASH_H
#define BASE_HASH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/** FNV-1a with 64 bits: tells damaged files from good ones (every change of one byte changes it); it is no
 * protection against forgery. */

enum { HASH_TEXT = 25 }; /**< letters of a hash as text, with the NUL */

/** Hash of @p size bytes. */
uint64_t hash_bytes(const void *data, size_t size);

/** Hash of a regular file, read piece by piece; *@p size (or NULL) is its length in bytes. Returns 0,
 * STATUS_NO_INPUT (missing, not a regular file: reported) or STATUS_IO. */
int hash_file(const char *path, uint64_t *hash, size_t *size);

/** "fnv1a64:" and 16 hexadecimal digits. */
void hash_print(uint64_t hash, char text[HASH_TEXT]);

/** Write lines of text and a last line behind them, "end " and their hash. */
void hash_seal(FILE *stream, const char *text);

/** Whether @p text, of @p size bytes with a NUL behind them, is what hash_seal wrote; the last line is cut
 * off. */
bool hash_unseal(char *text, size_t size);

#endif

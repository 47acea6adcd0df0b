// SPDX-License-Identifier: GPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/error.h"
#include "base/hash.h"
#include "base/log.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// The published test vectors of FNV-1a, 64 bits (Fowler, Noll, Vo).
static void test_vectors(void **state)
{
    (void)state;
    assert_true(hash_bytes("", 0) == 0xcbf29ce484222325U);
    assert_true(hash_bytes("a", 1) == 0xaf63dc4c8601ec8cU);
    assert_true(hash_bytes("foobar", 6) == 0x85944171f73967e8U);
    char text[HASH_TEXT];
    hash_print(0x5944171f73967e8U, text);
    assert_string_equal(text, "fnv1a64:05944171f73967e8");
}

// A file of several pieces has the hash of its bytes at once.
static void test_file(void **state)
{
    (void)state;
    enum { SIZE = 200001 };
    char path[] = "/tmp/skerry-hash-XXXXXX";
    char *data = malloc(SIZE);
    FILE *stream = fdopen(mkstemp(path), "w");
    assert_non_null(stream);
    for (size_t i = 0; i < SIZE; ++i)
        data[i] = (char)(i * i / 7);
    assert_int_equal(fwrite(data, 1, SIZE, stream), SIZE);
    fclose(stream);
    uint64_t hash;
    size_t size;
    assert_int_equal(hash_file(path, &hash, &size), 0);
    assert_true(hash == hash_bytes(data, SIZE));
    assert_int_equal(size, SIZE);
    assert_int_equal(hash_file(path, &hash, NULL), 0);
    unlink(path);
    free(data);
    log_set_level((enum log_level) - 1);
    assert_int_equal(hash_file("/nowhere", &hash, NULL), STATUS_NO_INPUT);
    assert_int_equal(hash_file("/tmp", &hash, NULL), STATUS_NO_INPUT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_vectors), cmocka_unit_test(test_file)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/error.h"
#include "base/hash.h"

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
    assert_int_equal(hash_file("/nowhere", &hash, NULL), STATUS_NO_INPUT);
    assert_int_equal(hash_file("/tmp", &hash, NULL), STATUS_NO_INPUT);
}

// A sealed text is told from each of its beginnings and from what differs in one byte.
static void test_seal(void **state)
{
    (void)state;
    const char *const lines = "step 7\nt 2.385\n";
    char *sealed = NULL;
    size_t size;
    FILE *stream = open_memstream(&sealed, &size);
    assert_non_null(stream);
    hash_seal(stream, lines);
    fclose(stream);
    assert_int_equal(size, strlen(lines) + strlen("end \n") + HASH_TEXT - 1);
    char *copy = malloc(size + 2);
    for (size_t n = 0; n < size; ++n) {
        memcpy(copy, sealed, n);
        copy[n] = '\0';
        assert_false(hash_unseal(copy, n));
    }
    for (size_t i = 0; i < size; ++i)
        for (int change = 1; change < 256; ++change) {
            memcpy(copy, sealed, size + 1);
            copy[i] = (char)(copy[i] ^ change);
            assert_false(hash_unseal(copy, size));
        }
    memcpy(copy, sealed, size);
    memcpy(copy + size, "\n", 2);
    assert_false(hash_unseal(copy, size + 1));
    assert_true(hash_unseal(sealed, size));
    assert_string_equal(sealed, lines);
    free(copy);
    free(sealed);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_vectors), cmocka_unit_test(test_file),
                                       cmocka_unit_test(test_seal)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

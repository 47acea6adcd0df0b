// SPDX-License-Identifier: GPL-3.0-or-later
// What an output folder knows of the run: its deck, the files of that, what was overridden.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/memory.h"
#include "run/record.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[] = "/tmp/skerry-record-XXXXXX", deck[64], points[128], output[64];

static void put(const char *path, const char *text)
{
    FILE *stream = fopen(path, "w");
    assert_non_null(stream);
    fputs(text, stream);
    fclose(stream);
}

static int create(void **state)
{
    (void)state;
    char below[64];
    strcpy(strrchr(folder, '-') + 1, "XXXXXX");
    if (!mkdtemp(folder))
        return 1;
    snprintf(deck, sizeof deck, "%s/a b.xml", folder);
    snprintf(below, sizeof below, "%s/sub", folder);
    snprintf(points, sizeof points, "%s/points..txt", below);
    snprintf(output, sizeof output, "%s/out", folder);
    if (file_make_folder(below))
        return 1;
    put(deck, "<deck/>");
    put(points, "0 1\n2 3\n");
    return 0;
}

static int destroy(void **state)
{
    (void)state;
    char command[64];
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command);
}

static void record_make(struct model_input inputs[2])
{
    static const char *const overrides[] = {"dx=0.005", "end=2\n+ 1"};
    inputs[0] = (struct model_input){"a b.xml", deck, hash_bytes("<deck/>", 7), 7};
    inputs[1] = (struct model_input){"sub/points..txt", points, hash_bytes("0 1\n2 3\n", 8), 8};
    const struct model model = {.n_inputs = 2, .inputs = inputs};
    assert_int_equal(record_create(output, &model, "v3", 2, overrides), 0);
}

static void test_round_trip(void **state)
{
    (void)state;
    struct model_input inputs[2];
    struct record record;
    char path[128], *text;
    size_t size;
    record_make(inputs);
    // the folder of the deck may go
    unlink(deck);
    unlink(points);
    assert_int_equal(record_read(&record, output), 0);
    snprintf(path, sizeof path, "%s/input/a b.xml", output);
    assert_string_equal(record.deck, path);
    assert_string_equal(record.isa, "v3");
    assert_int_equal(record.n_overrides, 2);
    assert_string_equal(record.overrides[0], "dx=0.005");
    assert_string_equal(record.overrides[1], "end=2 + 1"); // one line each
    record_reset(&record);
    snprintf(path, sizeof path, "%s/input/sub/points..txt", output);
    assert_int_equal(file_read(path, 100, &text, &size), 0);
    assert_string_equal(text, "0 1\n2 3\n");
    memory_free(text);
    // a run that goes on adds to it
    static const char *const more[] = {"end=5"};
    assert_int_equal(record_add(output, NULL, 0, NULL), 0);
    assert_int_equal(record_add(output, "baseline", 1, more), 0);
    assert_int_equal(record_read(&record, output), 0);
    assert_string_equal(record.isa, "baseline");
    assert_int_equal(record.n_overrides, 3);
    assert_string_equal(record.overrides[2], "end=5");
    record_reset(&record);
    record_reset(&record);
}

static void test_refusals(void **state)
{
    (void)state;
    struct model_input inputs[2];
    struct record record;
    char path[128], *text;
    size_t size;
    assert_int_equal(record_read(&record, output), STATUS_NO_INPUT);
    record_make(inputs);
    // a file that is another now, or gone
    snprintf(path, sizeof path, "%s/input/sub/points..txt", output);
    put(path, "0 1\n2 4\n");
    assert_int_equal(record_read(&record, output), STATUS_IO);
    assert_null(record.deck);
    unlink(path);
    assert_int_equal(record_read(&record, output), STATUS_IO);
    put(path, "0 1\n2 3\n");
    assert_int_equal(record_read(&record, output), 0);
    record_reset(&record);
    // a record that has been touched, at any place
    snprintf(path, sizeof path, "%s/input/record", output);
    assert_int_equal(file_read(path, 10000, &text, &size), 0);
    for (size_t i = 0; i < size; ++i) {
        text[i] = (char)(text[i] ^ 1);
        put(path, text);
        assert_int_equal(record_read(&record, output), STATUS_IO);
        text[i] = (char)(text[i] ^ 1);
    }
    memory_free(text);
    // what changes while it is copied, and names that cannot be
    const struct model model = {.n_inputs = 2, .inputs = inputs};
    put(deck, "<dock/>");
    assert_int_equal(record_create(output, &model, NULL, 0, NULL), STATUS_IO);
    inputs[0].name = "record";
    assert_int_equal(record_create(output, &model, NULL, 0, NULL), STATUS_CREATE);
    inputs[0].name = "a\nb";
    assert_int_equal(record_create(output, &model, NULL, 0, NULL), STATUS_CREATE);
}

/** Only what it names is removed. */
static void test_remove(void **state)
{
    (void)state;
    struct model_input inputs[2];
    char path[128];
    assert_int_equal(record_remove(output), 0);
    record_make(inputs);
    snprintf(path, sizeof path, "%s/input/mine.txt", output);
    put(path, "mine");
    assert_int_equal(record_remove(output), 0);
    assert_int_equal(access(path, F_OK), 0);
    snprintf(path, sizeof path, "%s/input/a b.xml", output);
    assert_int_not_equal(access(path, F_OK), 0);
    snprintf(path, sizeof path, "%s/input/record", output);
    assert_int_not_equal(access(path, F_OK), 0);
    assert_int_equal(access(deck, F_OK), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test_setup_teardown(test_round_trip, create, destroy),
                                       cmocka_unit_test_setup_teardown(test_refusals, create, destroy),
                                       cmocka_unit_test_setup_teardown(test_remove, create, destroy)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

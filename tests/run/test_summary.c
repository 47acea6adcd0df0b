// SPDX-License-Identifier: GPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/error.h"
#include "run/summary.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[] = "/tmp/skerry-summary-XXXXXX";
static char path[64];

static int create(void **state)
{
    (void)state;
    strcpy(folder + strlen(folder) - 6, "XXXXXX");
    if (!mkdtemp(folder))
        return -1;
    snprintf(path, sizeof path, "%s/a.json", folder);
    return 0;
}

static int destroy(void **state)
{
    (void)state;
    unlink(path);
    return rmdir(folder); // fails if a temporary file was left
}

static void text_read(char *text, size_t size)
{
    FILE *stream = fopen(path, "r");
    assert_non_null(stream);
    text[fread(text, 1, size - 1, stream)] = '\0';
    fclose(stream);
}

static const struct summary_pair parameters[] = {{"dx", 0.005, NULL}, {"end", NAN, NULL}};
static const struct summary_pair balances[] = {{"fluid mass", 1.0 / 3.0, "kg/m"}};
static const struct summary_pair numbers[] = {{"frames", 42, NULL}};
static const char *const overrides[] = {"dx=0.005", "name=\"b\""};
static const struct timer timer = {{1.5, 2.5, 3.5, 0.25, 0.125, 0.0625}};

static const struct summary summary = {.version = "0.1.0",
                                       .revision = "abc",
                                       .deck = "decks/a \"b\".xml",
                                       .deck_hash = 0x0123456789abcdefU,
                                       .isa = "v3",
                                       .dim = 2,
                                       .threads = 3,
                                       .status = 70,
                                       .particles = 12345,
                                       .steps = 777,
                                       .t = 0.1,
                                       .wall_s = 8.0,
                                       .updates = 4e6,
                                       .iterations_mean = 2.385,
                                       .files = 9,
                                       .n_parameters = 2,
                                       .n_overrides = 2,
                                       .n_balances = 1,
                                       .n_numbers = 1,
                                       .parameters = parameters,
                                       .overrides = overrides,
                                       .balances = balances,
                                       .numbers = numbers,
                                       .timer = &timer};

static void test_summary(void **state)
{
    (void)state;
    char text[8192];
    assert_int_equal(summary_write(&summary, path), 0);
    text_read(text, sizeof text);
    static const char *const expected[] = {"\"version\": \"0.1.0\"",
                                           "\"revision\": \"abc\"",
                                           "\"deck\": \"decks/a \\\"b\\\".xml\"",
                                           "\"deck_hash\": \"fnv1a64:0123456789abcdef\"",
                                           "\"processor\": \"",
                                           "\"status\": 70",
                                           "\"particles\": 12345",
                                           "\"dim\": 2",
                                           "\"threads\": 3",
                                           "\"isa\": \"v3\"",
                                           "\"steps\": 777",
                                           "\"wall_s\": 8,",
                                           "\"updates_per_s\": 500000,",
                                           "\"iterations_mean\": 2.3849999999999998",
                                           "\"t\": 0.10000000000000001",
                                           "\"frames\": 42",
                                           "\"dx\": 0.0050000000000000001,\n    \"end\": null\n  }",
                                           "\"overrides\": [\"dx=0.005\", \"name=\\\"b\\\"\"]",
                                           "{\"value\": 0.33333333333333331, \"unit\": \"kg/m\"}",
                                           "\"walls\": 3.5",
                                           "\"output\": 0.0625\n  }\n}\n"};
    for (size_t i = 0; i < sizeof expected / sizeof expected[0]; ++i)
        if (!strstr(text, expected[i]))
            fail_msg("%s is missing in:\n%s", expected[i], text);
    assert_int_equal(summary_write(&summary, "/nowhere/a.json"), STATUS_IO);
    summary_print(&summary);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_summary, create, destroy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

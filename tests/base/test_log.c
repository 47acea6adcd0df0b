// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "base/memory.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static int calls;
static void count_call(void)
{
    calls++;
}

// What @p act prints on stderr; freed with memory_free.
static char *captured(void (*act)(void))
{
    char *data;
    size_t size;
    char path[] = "/tmp/skerry-log-XXXXXX";
    const int file = mkstemp(path), terminal = dup(STDERR_FILENO);

    assert_true(file >= 0 && terminal >= 0);
    dup2(file, STDERR_FILENO);
    act();
    fflush(stderr);
    dup2(terminal, STDERR_FILENO);
    close(terminal);
    close(file);
    assert_int_equal(file_read(path, 100000, &data, &size), 0);
    unlink(path);
    return data;
}

static int check_positive(double value)
{
    CHECK(value > 0.0, STATUS_DECK, "deck.xml:%d:%d: the value %g must be positive", 17, 4, value);
    return STATUS_OK;
}

static int call_twice(double first, double second)
{
    CALL(check_positive(first));
    CALL(check_positive(second));
    return STATUS_USAGE;
}

static void make_errors(void)
{
    assert_int_equal(call_twice(2.385, -0.5), STATUS_DECK);
    assert_int_equal(call_twice(2.385, 0.5), STATUS_USAGE);
}

static void error_is_reported_where_it_happens(void **state)
{
    char *text = captured(make_errors);

    (void)state;
    assert_string_equal(text, "skerry: error: deck.xml:17:4: the value -0.5 must be positive\n");
    memory_free(text);
}

static void speak_all_levels(void)
{
    log_message(LOG_ERROR, "e%d", 1);
    log_message(LOG_WARNING, "w%d", 2);
    log_message(LOG_INFO, "i%d", 3);
    log_message(LOG_DETAIL, "d%d", 4);
}

static void level_limits_the_terminal_only(void **state)
{
    char path[] = "/tmp/skerry-log-XXXXXX", *data, *text;
    size_t size;
    const long warnings = log_warnings();

    (void)state;
    close(mkstemp(path));
    assert_int_equal(log_open(path), 0);
    log_set_hook(count_call);
    calls = 0;
    log_set_level(LOG_WARNING);
    text = captured(speak_all_levels);
    assert_string_equal(text, "skerry: error: e1\nskerry: warning: w2\n");
    assert_int_equal(calls, 2);
    memory_free(text);
    log_set_level(LOG_ERROR);
    text = captured(speak_all_levels);
    assert_string_equal(text, "skerry: error: e1\n");
    assert_int_equal(calls, 3);
    memory_free(text);
    log_set_hook(NULL);
    log_set_level(LOG_DETAIL);
    text = captured(speak_all_levels);
    assert_string_equal(text, "skerry: error: e1\nskerry: warning: w2\ni3\nd4\n");
    memory_free(text);
    log_set_level(LOG_INFO);
    log_close();
    log_message(LOG_DETAIL, "after the end");
    assert_int_equal(log_warnings() - warnings, 3); // also those that were not shown

    assert_int_equal(file_read(path, 1000, &data, &size), 0);
    assert_string_equal(data, "skerry: error: e1\nskerry: warning: w2\ni3\nd4\n"
                              "skerry: error: e1\nskerry: warning: w2\ni3\nd4\n"
                              "skerry: error: e1\nskerry: warning: w2\ni3\nd4\n");
    memory_free(data);
    unlink(path);
}

static void open_reports_a_missing_folder(void **state)
{
    (void)state;
    assert_int_equal(log_open("/proc/nowhere/log.txt"), STATUS_IO);
    log_close();
}

static void speak_from_many_threads(void)
{
#pragma omp parallel for num_threads(4)
    for (int i = 0; i < 400; i++)
        log_message(LOG_INFO, "%s", "a line that stays whole");
}

static void lines_of_threads_stay_whole(void **state)
{
    char *text = captured(speak_from_many_threads);
    int lines = 0;

    (void)state;
    for (char *line = strtok(text, "\n"); line; line = strtok(NULL, "\n"), lines++)
        assert_string_equal(line, "a line that stays whole");
    assert_int_equal(lines, 400);
    memory_free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(error_is_reported_where_it_happens),
        cmocka_unit_test(level_limits_the_terminal_only),
        cmocka_unit_test(open_reports_a_missing_folder),
        cmocka_unit_test(lines_of_threads_stay_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

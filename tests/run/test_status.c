// SPDX-License-Identifier: GPL-3.0-or-later
// Where a run is, as written and as told.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"
#include "run/json.h"
#include "run/status.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[] = "/tmp/skerry-status-XXXXXX", path[64];

static const struct status_report report_of_step_5 = {.state = "running",
                                                      .step = 5,
                                                      .t = 0.25,
                                                      .t_end = 2.5,
                                                      .dt = 0.05,
                                                      .fraction = 0.125,
                                                      .wall_s = 3.0,
                                                      .eta_s = -1.0,
                                                      .updates_per_s = 1.5e6,
                                                      .particles = 99,
                                                      .checkpoint_step = -1};

static int create(void **state)
{
    (void)state;
    strcpy(strrchr(folder, '-') + 1, "XXXXXX");
    if (!mkdtemp(folder))
        return 1;
    snprintf(path, sizeof path, "%s/status.json", folder);
    return 0;
}

static int destroy(void **state)
{
    (void)state;
    unlink(path);
    return rmdir(folder); // fails if a temporary file was left
}

static void test_file(void **state)
{
    (void)state;
    char *text, word[32];
    size_t size;
    double number = 2.385;
    assert_int_equal(status_write(&report_of_step_5, path), 0);
    assert_int_equal(file_read(path, 4096, &text, &size), 0);
    assert_true(json_find_text(text, "state", word, sizeof word));
    assert_string_equal(word, "running");
    assert_true(json_find_number(text, "pid", &number));
    assert_true(number == (double)getpid());
    assert_non_null(strstr(text,
                           ",\n  \"step\": 5,\n  \"particles\": 99,\n  \"t\": 0.25,\n  \"t_end\": 2.5,\n"
                           "  \"dt\": 0.050000000000000003,\n  \"fraction\": 0.125,\n  \"wall_s\": 3,\n"
                           "  \"eta_s\": null,\n  \"updates_per_s\": 1500000,\n"
                           "  \"checkpoint_step\": null,\n  \"checkpoint_t\": null\n}\n"));
    // what is not there, or of another kind, leaves the value
    assert_false(json_find_number(text, "eta_s", &number));
    assert_false(json_find_number(text, "eta", &number));
    assert_false(json_find_number(text, "state", &number));
    assert_false(json_find_text(text, "step", word, sizeof word));
    assert_false(json_find_text(text, "state", word, 7)); // no room for the NUL
    assert_true(number == (double)getpid());
    assert_string_equal(word, "running");
    memory_free(text);
    assert_int_equal(status_write(&report_of_step_5, "/nowhere/a.json"), STATUS_IO);
}

/** What "skerry status" prints, freed with free. */
static char *told(void)
{
    char *text = NULL;
    size_t size;
    FILE *stream = open_memstream(&text, &size);
    assert_int_equal(status_print(folder, stream), 0);
    fclose(stream);
    return text;
}

static void test_told(void **state)
{
    (void)state;
    struct status_report report = report_of_step_5;
    int lock;
    assert_int_equal(status_print(folder, stdout), STATUS_NO_INPUT);
    assert_int_equal(status_write(&report, path), 0);
    char *text = told();
    assert_non_null(strstr(text, "ended from outside"));
    assert_non_null(strstr(text, "  12.5 %: t = 0.25 of 2.5 s, step 5\n  99 particles, 1.5 M updates/s\n"));
    assert_non_null(strstr(text, "no checkpoint"));
    free(text);
    assert_int_equal(file_lock_folder(folder, &lock), 0);
    text = told();
    assert_non_null(strstr(text, ": running (process "));
    free(text);
    close(lock);
    report.state = "stopped";
    report.eta_s = 7300.0;
    assert_int_equal(status_write(&report, path), 0);
    text = told();
    assert_non_null(strstr(text, ": stopped\n"));
    assert_non_null(strstr(text, "wall time 3 s, to go 2.0 h\n"));
    free(text);
    FILE *stream = fopen(path, "w");
    assert_non_null(stream);
    fputs("{\"state\": \"run", stream);
    fclose(stream);
    text = told();
    assert_non_null(strstr(text, "status.json is damaged"));
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test_setup_teardown(test_file, create, destroy),
                                       cmocka_unit_test_setup_teardown(test_told, create, destroy)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

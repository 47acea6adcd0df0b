// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

// Every test runs in an empty folder of its own.
static char folder[] = "/tmp/skerry-file-XXXXXX";
static char before[4096];

static int enter(void **state)
{
    (void)state;
    strcpy(strrchr(folder, '-') + 1, "XXXXXX");
    return !getcwd(before, sizeof before) || !mkdtemp(folder) || chdir(folder);
}

static int leave(void **state)
{
    char command[64];

    (void)state;
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return chdir(before) || system(command);
}

static void put(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");

    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

static void assert_holds(const char *path, const char *text)
{
    char *data;
    size_t size;

    assert_int_equal(file_read(path, 1000, &data, &size), 0);
    assert_int_equal(size, strlen(text));
    assert_string_equal(data, text);
    memory_free(data);
}

static bool exists(const char *path)
{
    return access(path, F_OK) == 0;
}

static void commit_replaces_at_once(void **state)
{
    struct file_atomic file;

    (void)state;
    put("series.pvd", "old");
    assert_int_equal(file_atomic_open(&file, "series.pvd"), 0);
    fprintf(file.stream, "new %d", 42);
    fflush(file.stream);
    assert_holds("series.pvd", "old");
    assert_int_equal(file_atomic_commit(&file), 0);
    assert_holds("series.pvd", "new 42");
    assert_false(exists("series.pvd.tmp"));
    file_atomic_abandon(&file);
    assert_holds("series.pvd", "new 42");
}

static void abandon_leaves_the_old_file(void **state)
{
    struct file_atomic file;

    (void)state;
    put("a", "old");
    assert_int_equal(file_atomic_open(&file, "a"), 0);
    fputs("half", file.stream);
    file_atomic_abandon(&file);
    assert_holds("a", "old");
    assert_false(exists("a.tmp"));
}

static void open_reports_a_missing_folder(void **state)
{
    struct file_atomic file;

    (void)state;
    assert_int_equal(file_atomic_open(&file, "nowhere/a"), STATUS_IO);
    file_atomic_abandon(&file);
}

static void commit_fails_when_the_disk_is_full(void **state)
{
    struct file_atomic file;

    (void)state;
    put("a", "old");
    // Everything written through the temporary name ends on a device that is always full.
    assert_int_equal(symlink("/dev/full", "a.tmp"), 0);
    assert_int_equal(file_atomic_open(&file, "a"), 0);
    fputs("new", file.stream);
    assert_int_equal(file_atomic_commit(&file), STATUS_IO);
    assert_holds("a", "old");
    assert_false(exists("a.tmp"));
}

static void commit_remembers_an_earlier_failure(void **state)
{
    struct file_atomic file;

    (void)state;
    assert_int_equal(symlink("/dev/full", "a.tmp"), 0);
    assert_int_equal(file_atomic_open(&file, "a"), 0);
    setvbuf(file.stream, NULL, _IONBF, 0);
    fputs("new", file.stream);
    assert_int_equal(file_atomic_commit(&file), STATUS_IO);
    assert_false(exists("a"));
}

static void commit_fails_when_it_cannot_rename(void **state)
{
    struct file_atomic file;

    (void)state;
    assert_int_equal(mkdir("a", 0700), 0);
    put("a/inside", "");
    assert_int_equal(file_atomic_open(&file, "a"), 0);
    assert_int_equal(file_atomic_commit(&file), STATUS_IO);
    assert_true(exists("a/inside"));
    assert_false(exists("a.tmp"));
}

static void read_gives_bytes_and_a_nul(void **state)
{
    char *data;
    size_t size;
    FILE *file = fopen("bytes", "w");

    (void)state;
    fwrite("a\0b\n", 1, 4, file);
    fclose(file);
    assert_int_equal(file_read("bytes", 4, &data, &size), 0);
    assert_int_equal(size, 4);
    assert_memory_equal(data, "a\0b\n", 5);
    memory_free(data);
    put("empty", "");
    assert_holds("empty", "");
}

static void read_refuses_what_is_no_small_file(void **state)
{
    char *data;
    size_t size;

    (void)state;
    put("five", "12345");
    assert_int_equal(mkfifo("fifo", 0600), 0);
    assert_int_equal(file_read("five", 4, &data, &size), STATUS_NO_INPUT);
    assert_int_equal(file_read("missing", 4, &data, &size), STATUS_NO_INPUT);
    assert_int_equal(file_read(".", 4, &data, &size), STATUS_NO_INPUT);
    assert_int_equal(file_read("fifo", 4, &data, &size), STATUS_NO_INPUT);
    assert_int_equal(file_read("/dev/zero", 4, &data, &size), STATUS_NO_INPUT);
}

static void make_folder_makes_parents(void **state)
{
    struct stat about;
    char *absolute = memory_print("%s/r//s/", folder);

    (void)state;
    assert_int_equal(file_make_folder("x.out/fields"), 0);
    assert_int_equal(file_make_folder("x.out/fields"), 0);
    assert_int_equal(file_make_folder(absolute), 0);
    assert_int_equal(stat("x.out/fields", &about), 0);
    assert_true(S_ISDIR(about.st_mode));
    assert_true(exists("r/s"));
    memory_free(absolute);
}

static void make_folder_refuses_a_file_in_the_way(void **state)
{
    (void)state;
    put("way", "");
    assert_int_equal(file_make_folder("way"), STATUS_CREATE);
    assert_int_equal(file_make_folder("way/inner"), STATUS_CREATE);
    assert_int_equal(file_make_folder("/proc/skerry/x"), STATUS_CREATE);
    assert_int_equal(file_make_folder(""), STATUS_CREATE);
}

static void paths_that_stay_below(void **state)
{
    static const char *const good[] = {"a", "a/b", "a..b", "..a/b..", "a/...", "./a"};
    static const char *const bad[] = {"", "/a", "..", "../a", "a/..", "a/../b"};

    (void)state;
    for (size_t k = 0; k < sizeof good / sizeof *good; k++)
        assert_true(file_stays_below(good[k]));
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++)
        assert_false(file_stays_below(bad[k]));
}

static void publish_renames_what_is_whole(void **state)
{
    (void)state;
    put("data.tmp", "new");
    put("data", "old");
    assert_int_equal(file_publish("data.tmp", "data"), 0);
    assert_false(exists("data.tmp"));
    char *text;
    size_t size;
    assert_int_equal(file_read("data", 100, &text, &size), 0);
    assert_string_equal(text, "new");
    memory_free(text);
    assert_int_equal(file_publish("data.tmp", "data"), STATUS_IO);
    put("data.tmp", "newer");
    assert_int_equal(file_publish("data.tmp", "no/data"), STATUS_IO);
    assert_true(exists("data"));
}

static void one_process_has_a_folder(void **state)
{
    int first, second;

    (void)state;
    assert_int_equal(file_lock_folder(".", &first), 0);
    assert_true(first >= 0);
    // a second descriptor is as good as a second process
    assert_int_equal(file_lock_folder(".", &second), STATUS_CREATE);
    assert_int_equal(second, -1);
    close(first);
    assert_int_equal(file_lock_folder(".", &second), 0);
    close(second);
    // where there is nothing to lock, nothing is in the way
    assert_int_equal(file_lock_folder("nowhere", &second), 0);
    assert_int_equal(second, -1);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, enter, leave)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(commit_replaces_at_once),
        IN_FOLDER(abandon_leaves_the_old_file),
        IN_FOLDER(open_reports_a_missing_folder),
        IN_FOLDER(commit_fails_when_the_disk_is_full),
        IN_FOLDER(commit_remembers_an_earlier_failure),
        IN_FOLDER(commit_fails_when_it_cannot_rename),
        IN_FOLDER(read_gives_bytes_and_a_nul),
        IN_FOLDER(read_refuses_what_is_no_small_file),
        IN_FOLDER(make_folder_makes_parents),
        IN_FOLDER(make_folder_refuses_a_file_in_the_way),
        IN_FOLDER(paths_that_stay_below),
        IN_FOLDER(publish_renames_what_is_whole),
        IN_FOLDER(one_process_has_a_folder),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

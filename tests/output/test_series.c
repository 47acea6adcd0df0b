// SPDX-License-Identifier: GPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/error.h"
#include "output/history.h"
#include "output/pvd.h"

#include "folder.h"

#include <sys/stat.h>

static void test_pvd(void **state)
{
    char path[256];
    struct pvd pvd, back;
    folder_file(*state, "run.pvd", path);
    assert_int_equal(pvd_create(&pvd, path), 0);
    assert_int_equal(pvd_write(&pvd), 0); // an empty collection is fine
    assert_int_equal(pvd_read(&back, path), 0);
    assert_int_equal(back.n, 0);
    pvd_reset(&back);
    for (int i = 0; i < 40; ++i) {
        char name[64];
        snprintf(name, sizeof name, "fields/fluid_%06d.vtu", i);
        assert_int_equal(pvd_add(&pvd, 0.1 * i, 0, "fluid", name), 0);
        snprintf(name, sizeof name, "fields/a&b_%06d.vtu", i);
        assert_int_equal(pvd_add(&pvd, 0.1 * i, 1, "solid-\"a&b\"", name), 0);
    }
    assert_int_equal(pvd_write(&pvd), 0);
    assert_int_equal(pvd_read(&back, path), 0);
    assert_int_equal(back.n, 80);
    for (size_t i = 0; i < 80; ++i) {
        assert_true(back.entries[i].time == pvd.entries[i].time);
        assert_int_equal(back.entries[i].part, i % 2);
        assert_string_equal(back.entries[i].name, pvd.entries[i].name);
        assert_string_equal(back.entries[i].file, pvd.entries[i].file);
    }
    char *text = folder_read(path, NULL);
    assert_non_null(strstr(text, "<DataSet timestep=\"0.30000000000000004\" group=\"\" part=\"1\" "
                                 "name=\"solid-&quot;a&amp;b&quot;\" file=\"fields/a&amp;b_000003.vtu\"/>"));
    free(text);
    pvd_reset(&back);
    pvd_reset(&pvd);
}

static void test_pvd_errors(void **state)
{
    struct folder *folder = *state;
    char path[256], temporary[256], damaged[256], letters[300];
    struct pvd pvd, back;
    folder_file(folder, "run.pvd", path);
    folder_file(folder, "damaged.pvd", damaged);
    assert_int_equal(pvd_create(&pvd, path), 0);
    memset(letters, 'a', sizeof letters);
    letters[96] = '\0';
    assert_int_equal(pvd_add(&pvd, 0, 0, letters, "f.vtu"), STATUS_IO);
    letters[96] = 'a';
    letters[192] = '\0';
    assert_int_equal(pvd_add(&pvd, 0, 0, "fluid", letters), STATUS_IO);
    assert_int_equal(pvd.n, 0);
    assert_int_equal(pvd_add(&pvd, 0.25, 3, "fluid", "f.vtu"), 0);
    assert_int_equal(pvd_write(&pvd), 0);
    // an older file stays when the new one cannot be written
    folder_file(folder, "run.pvd.tmp", temporary);
    mkdir(temporary, 0777);
    assert_int_equal(pvd_add(&pvd, 0.5, 3, "fluid", "g.vtu"), 0);
    assert_int_equal(pvd_write(&pvd), STATUS_IO);
    assert_int_equal(pvd_read(&back, path), 0);
    assert_int_equal(back.n, 1);
    pvd_reset(&back);
    size_t size;
    char *text = folder_read(path, &size);
    for (size_t n = 0; n < size; ++n) {
        folder_write(damaged, text, n);
        assert_int_equal(pvd_read(&back, damaged), STATUS_IO);
        assert_null(back.entries);
    }
    for (size_t i = 0; i < size; ++i) { // never a crash
        text[i] = (char)(text[i] ^ 4);
        folder_write(damaged, text, size);
        text[i] = (char)(text[i] ^ 4);
        if (pvd_read(&back, damaged) == 0)
            pvd_reset(&back);
    }
    memcpy(strstr(text, "f.vtu"), "/.vtu", 5);
    folder_write(damaged, text, size);
    assert_int_equal(pvd_read(&back, damaged), STATUS_IO);
    free(text);
    assert_int_equal(pvd_read(&back, folder_file(folder, "missing.pvd", damaged)), STATUS_NO_INPUT);
    pvd_reset(&pvd);
}

static void test_history(void **state)
{
    char path[256];
    struct history history;
    const char *const columns[] = {"t [s]", "force \"a,b\" x [N/m]", "n [-]"};
    const double first[] = {0.1, -1.0 / 3.0, 7}, second[] = {1e-300, 0, 2.385};
    folder_file(*state, "tip.csv", path);
    assert_int_equal(history_create(&history, path, columns, 3), 0);
    assert_int_equal(history_row(&history, first), 0);
    char *text = folder_read(path, NULL); // it is there although the file is open
    assert_string_equal(text, "t [s],\"force \"\"a,b\"\" x [N/m]\",n [-]\n"
                              "0.10000000000000001,-0.33333333333333331,7\n");
    free(text);
    assert_int_equal(history_row(&history, second), 0);
    assert_int_equal(history_close(&history), 0);
    text = folder_read(path, NULL);
    double t, x, n;
    const char *row = strchr(strchr(text, '\n') + 1, '\n') + 1;
    assert_int_equal(sscanf(row, "%lf,%lf,%lf", &t, &x, &n), 3);
    assert_true(t == 1e-300 && x == 0.0 && n == 2.385);
    free(text);
    assert_int_equal(history_create(&history, folder_file(*state, "no/tip.csv", path), columns, 3),
                     STATUS_IO);
    assert_int_equal(history_create(&history, "/dev/full", columns, 3), STATUS_IO);
    assert_null(history.stream);
    assert_int_equal(history_close(&history), 0);
}

// Entries up to a time are the first ones, whatever part they are.
static void test_pvd_count(void **state)
{
    char path[256];
    struct pvd pvd;
    assert_int_equal(pvd_create(&pvd, folder_file(*state, "run.pvd", path)), 0);
    assert_int_equal(pvd_count(&pvd, 1.0), 0);
    for (int i = 0; i < 3; ++i)
        for (int part = 0; part < 2; ++part)
            assert_int_equal(pvd_add(&pvd, 0.1 * i, part, "fluid", "f.vtu"), 0);
    assert_int_equal(pvd_count(&pvd, -1e-300), 0);
    assert_int_equal(pvd_count(&pvd, 0.0), 2);
    assert_int_equal(pvd_count(&pvd, 0.1), 4);
    assert_int_equal(pvd_count(&pvd, 0.2), 6);
    pvd_reset(&pvd);
}

// A resumed history is what it would have been, whatever stood behind its last row.
static void test_history_resume(void **state)
{
    char path[256];
    struct history history;
    const char *const columns[] = {"t [s]", "x, y [m]"}, *const others[] = {"t [s]", "x [m]"};
    static const char *const tails[] = {"", "0.30000000000000004,3\n", "0.3000000000",
                                        "0.30000000000000004,3\n0.4", "0.20000000000000001,7"};
    const double rows[][2] = {{0.1, 1}, {0.2, 2}, {0.1 * 3, 2.385}};
    const char *const whole = "t [s],\"x, y [m]\"\n0.10000000000000001,1\n0.20000000000000001,2\n"
                              "0.30000000000000004,2.3849999999999998\n";
    const size_t before = (size_t)(strstr(whole, "0.3") - whole);
    folder_file(*state, "tip.csv", path);
    for (size_t k = 0; k < sizeof tails / sizeof *tails; ++k) {
        char text[256];
        snprintf(text, sizeof text, "%.*s%s", (int)before, whole, tails[k]);
        folder_write(path, text, strlen(text));
        assert_int_equal(history_resume(&history, path, columns, 2, 0.2), 0);
        assert_int_equal(history_row(&history, rows[2]), 0);
        assert_int_equal(history_sync(&history), 0);
        assert_int_equal(history_close(&history), 0);
        char *back = folder_read(path, NULL);
        assert_string_equal(back, whole);
        free(back);
    }
    // a file that is not this history's is left alone
    assert_int_equal(history_resume(&history, path, others, 2, 0.1), STATUS_IO);
    char *back = folder_read(path, NULL);
    assert_string_equal(back, whole);
    free(back);
    folder_write(path, "", 0);
    assert_int_equal(history_resume(&history, path, columns, 2, 0.1), STATUS_IO);
    // a missing one is begun
    assert_int_equal(history_resume(&history, folder_file(*state, "other.csv", path), columns, 2, 0.1), 0);
    assert_int_equal(history_row(&history, rows[0]), 0);
    assert_int_equal(history_close(&history), 0);
    back = folder_read(path, NULL);
    assert_string_equal(back, "t [s],\"x, y [m]\"\n0.10000000000000001,1\n");
    free(back);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_pvd, folder_enter, folder_leave),
        cmocka_unit_test_setup_teardown(test_pvd_errors, folder_enter, folder_leave),
        cmocka_unit_test_setup_teardown(test_history, folder_enter, folder_leave),
        cmocka_unit_test_setup_teardown(test_pvd_count, folder_enter, folder_leave),
        cmocka_unit_test_setup_teardown(test_history_resume, folder_enter, folder_leave),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

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

static int create(void **state)
{
    static struct folder folder;
    folder_create(&folder);
    *state = &folder;
    return 0;
}

static int destroy(void **state)
{
    folder_remove(((struct folder *)*state)->path);
    return 0;
}

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
    letters[64] = '\0';
    assert_int_equal(pvd_add(&pvd, 0, 0, letters, "f.vtu"), STATUS_IO);
    letters[64] = 'a';
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_pvd, create, destroy),
        cmocka_unit_test_setup_teardown(test_pvd_errors, create, destroy),
        cmocka_unit_test_setup_teardown(test_history, create, destroy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/error.h"
#include "base/parallel.h"
#include "output/vtu.h"
#include "output/vtu_types.h"

#include "folder.h"

#include <math.h>
#include <sys/stat.h>

static struct vtu_array array(const char *name, int components, enum vtu_type type, const void *data)
{
    struct vtu_array made = {.components = components, .type = type, .data = data};
    strcpy(made.name, name);
    return made;
}

// All types, own cells, awkward numbers.
static void test_types(void **state)
{
    char path[256];
    folder_file(*state, "solid.vtu", path);
    const double points[5][3] = {
        {0.1, -2.385, 1e-300}, {1.0 / 3.0, 4.0, INFINITY}, {7.0, 8.5, -0.0}, {1, 2, 3}, {5, 6, 7}};
    const int64_t connectivity[7] = {0, 1, 2, 3, 4, 2, 1}, offsets[2] = {4, 7};
    const uint8_t types[2] = {9, 5}, bytes[5] = {0, 255, 7, 8, 128};
    const float vector[5][3] = {{1.1f, 2.2f, 3.3f}, {-1e-30f, 0, 4}, {5, 6, 7}, {8, 9, 1e30f}, {2.5f, 0, 0}};
    const int32_t small[2] = {INT32_MIN, INT32_MAX};
    const int64_t large[5] = {INT64_MIN, INT64_MAX, -1, 0, 1};
    const double tensor[2][6] = {{1.5, 2, 3, 4, 5, 6}, {-1, -2, -3, -4, -5, -6.25}};
    const struct vtu_array point_arrays[] = {array("Density & <\"Mass\">", 1, VTU_UINT8, bytes),
                                             array("Velocity", 3, VTU_FLOAT32, vector),
                                             array("Id", 1, VTU_INT64, large)};
    const struct vtu_array cell_arrays[] = {array("Small", 1, VTU_INT32, small),
                                            array("CauchyStress", 6, VTU_FLOAT64, tensor)};
    const struct vtu_grid grid = {.time = 0.1 + 0.2,
                                  .cycle = -4000000001,
                                  .n_points = 5,
                                  .n_cells = 2,
                                  .n_connectivity = 7,
                                  .points = points,
                                  .points_type = VTU_FLOAT64,
                                  .connectivity = connectivity,
                                  .offsets = offsets,
                                  .types = types,
                                  .n_point_arrays = 3,
                                  .n_cell_arrays = 2,
                                  .point_arrays = point_arrays,
                                  .cell_arrays = cell_arrays,
                                  .scalars = "Id",
                                  .vectors = "Velocity"};
    assert_int_equal(vtu_write(path, &grid), 0);
    struct vtu_file file;
    assert_int_equal(vtu_read(&file, path), 0);
    const struct vtu_grid *back = &file.grid;
    assert_true(back->time == 0.1 + 0.2);
    assert_true(back->cycle == -4000000001);
    assert_int_equal(back->n_points, 5);
    assert_int_equal(back->n_cells, 2);
    assert_int_equal(back->n_connectivity, 7);
    assert_int_equal(back->points_type, VTU_FLOAT64);
    assert_memory_equal(back->points, points, sizeof points);
    assert_memory_equal(back->connectivity, connectivity, sizeof connectivity);
    assert_memory_equal(back->offsets, offsets, sizeof offsets);
    assert_memory_equal(back->types, types, sizeof types);
    assert_int_equal(back->n_point_arrays, 3);
    assert_int_equal(back->n_cell_arrays, 2);
    for (int i = 0; i < 5; ++i) {
        const struct vtu_array *is = i < 3 ? &back->point_arrays[i] : &back->cell_arrays[i - 3];
        const struct vtu_array *was = i < 3 ? &point_arrays[i] : &cell_arrays[i - 3];
        assert_string_equal(is->name, was->name);
        assert_int_equal(is->components, was->components);
        assert_int_equal(is->type, was->type);
        size_t n = (i < 3 ? 5U : 2U) * (size_t)was->components * vtu_type_size(was->type);
        assert_memory_equal(is->data, was->data, n);
    }
    char *text = folder_read(path, NULL);
    assert_non_null(strstr(text, "<PointData Scalars=\"Id\" Vectors=\"Velocity\">"));
    assert_non_null(strstr(text, ">0.30000000000000004</DataArray>"));
    free(text);
    vtu_file_reset(&file);
}

// n points without cells: one vertex each.
static void vertices_check(const char *path, size_t n)
{
    float *points = calloc(n + 1, 3 * sizeof *points);
    double *noise = calloc(n + 1, sizeof *noise);
    uint32_t random = 12345;
    for (size_t i = 0; i < n; ++i) {
        random = random * 1664525U + 1013904223U;
        points[3 * i] = (float)i * 0.37F;
        points[3 * i + 1] = (float)random;
        noise[i] = (double)random / 7.0;
    }
    const struct vtu_array arrays[] = {array("Noise", 1, VTU_FLOAT64, noise)};
    const struct vtu_grid grid = {.time = 2.5,
                                  .n_points = n,
                                  .points = points,
                                  .points_type = VTU_FLOAT32,
                                  .n_point_arrays = 1,
                                  .point_arrays = arrays};
    assert_int_equal(vtu_write(path, &grid), 0);
    struct vtu_file file;
    assert_int_equal(vtu_read(&file, path), 0);
    assert_int_equal(file.grid.n_points, n);
    assert_int_equal(file.grid.n_cells, n);
    if (n > 0) {
        assert_memory_equal(file.grid.points, points, 3 * n * sizeof *points);
        assert_memory_equal(file.grid.point_arrays[0].data, noise, n * sizeof *noise);
    }
    for (size_t i = 0; i < n; ++i) {
        assert_true(file.grid.connectivity[i] == (int64_t)i);
        assert_true(file.grid.offsets[i] == (int64_t)i + 1);
        assert_int_equal(file.grid.types[i], 1);
    }
    vtu_file_reset(&file);
    free(points);
    free(noise);
}

static void test_sizes(void **state)
{
    char path[256];
    folder_file(*state, "fluid.vtu", path);
    const size_t full = VTU_BLOCK / sizeof(double); // values in one block
    const size_t sizes[] = {0, 1, full - 1, full, full + 1, 3 * full, VTU_BLOCK + 5, 40 * full};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; ++i)
        vertices_check(path, sizes[i]);
}

static void test_threads(void **state)
{
    char path[256];
    folder_file(*state, "fluid.vtu", path);
    const size_t n = 3 * VTU_BLOCK / sizeof(double) + 17;
    char *first = NULL;
    size_t first_size = 0, size;
    for (int threads = 1; threads <= 3; ++threads) {
        parallel_setup(threads);
        vertices_check(path, n);
        char *text = folder_read(path, &size);
        if (first) {
            assert_int_equal(size, first_size);
            assert_memory_equal(text, first, size);
            free(text);
        } else {
            first = text;
            first_size = size;
        }
    }
    free(first);
    parallel_setup(0);
}

static void small_write(const char *path, double time)
{
    const float points[2][3] = {{1, 2, 3}, {4, 5, 6}};
    const double pressure[2] = {1e5, 2e5};
    const struct vtu_array arrays[] = {array("Pressure", 1, VTU_FLOAT64, pressure)};
    const struct vtu_grid grid = {.time = time,
                                  .n_points = 2,
                                  .points = points,
                                  .points_type = VTU_FLOAT32,
                                  .n_point_arrays = 1,
                                  .point_arrays = arrays};
    assert_int_equal(vtu_write(path, &grid), 0);
}

static void test_truncated(void **state)
{
    char path[256], damaged[256];
    small_write(folder_file(*state, "good.vtu", path), 1);
    folder_file(*state, "damaged.vtu", damaged);
    size_t size;
    char *text = folder_read(path, &size);
    for (size_t n = 0; n < size; ++n) {
        struct vtu_file file;
        folder_write(damaged, text, n);
        assert_int_equal(vtu_read(&file, damaged), STATUS_IO);
        assert_int_equal(file.n_memory, 0);
    }
    free(text);
}

// Whatever byte is wrong: no crash; in the data also never another value.
static void test_flipped(void **state)
{
    char path[256], damaged[256];
    small_write(folder_file(*state, "good.vtu", path), 1);
    folder_file(*state, "damaged.vtu", damaged);
    size_t size, refused = 0, data;
    char *text = folder_read(path, &size);
    data = (size_t)(strstr(text, VTU_APPENDED) - text) + strlen(VTU_APPENDED);
    for (size_t i = 0; i < size; ++i) {
        for (int bit = 0; bit < 8; ++bit) {
            struct vtu_file file;
            text[i] = (char)(text[i] ^ (1 << bit));
            folder_write(damaged, text, size);
            text[i] = (char)(text[i] ^ (1 << bit));
            int status = vtu_read(&file, damaged);
            assert_true(status == 0 || status == STATUS_IO);
            if (status == 0 && i >= data) {
                const double pressure[2] = {1e5, 2e5};
                assert_memory_equal(file.grid.point_arrays[0].data, pressure, sizeof pressure);
            }
            refused += status != 0;
            vtu_file_reset(&file);
        }
    }
    assert_true(refused > 4 * size);
    free(text);
}

static void replaced_refuse(const char *good, const char *damaged, const char *old, const char *new)
{
    size_t size;
    char *text = folder_read(good, &size), *at = strstr(text, old);
    assert_non_null(at);
    assert_int_equal(strlen(old), strlen(new));
    memcpy(at, new, strlen(new));
    folder_write(damaged, text, size);
    struct vtu_file file;
    assert_int_equal(vtu_read(&file, damaged), STATUS_IO);
    free(text);
}

static void test_refused(void **state)
{
    char path[256], damaged[256];
    small_write(folder_file(*state, "good.vtu", path), 1);
    folder_file(*state, "damaged.vtu", damaged);
    static const char *const cases[][2] = {{"NumberOfPoints=\"2\"", "NumberOfPoints=\"3\""},
                                           {"NumberOfCells=\"2\"", "NumberOfCells=\"1\""},
                                           {"NumberOfComponents=\"1\"", "NumberOfComponents=\"9\""},
                                           {"NumberOfComponents=\"1\"", "NumberOfComponents=\"-\""},
                                           {"UInt64", "UInt32"},
                                           {"Name=\"Points\" Num", "Nome=\"Points\" Num"},
                                           {"offset=\"0\"   ", "offset=\"9999\""},
                                           {"<Piece", "<piece"},
                                           {"Name=\"types\"", "Name=\"tipes\""}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i)
        replaced_refuse(path, damaged, cases[i][0], cases[i][1]);
    struct vtu_file file;
    assert_int_equal(vtu_read(&file, folder_file(*state, "missing.vtu", path)), STATUS_NO_INPUT);
    assert_int_equal(vtu_read(&file, ((struct folder *)*state)->path), STATUS_NO_INPUT);
}

// Cells that name points which do not exist are refused, whoever wrote them.
static void test_cells(void **state)
{
    char path[256];
    folder_file(*state, "cells.vtu", path);
    const float points[2][3] = {{1, 2, 3}, {4, 5, 6}};
    const uint8_t types[2] = {3, 3};
    const int64_t good[2] = {0, 1}, high[2] = {0, 2}, low[2] = {-1, 1};
    const int64_t offsets[2] = {1, 2}, falling[2] = {2, 1}, outside[2] = {1, 3};
    const int64_t *const cases[][2] = {
        {good, offsets}, {high, offsets}, {low, offsets}, {good, falling}, {good, outside}};
    for (size_t i = 0; i < 5; ++i) {
        const struct vtu_grid grid = {.n_points = 2,
                                      .n_cells = 2,
                                      .n_connectivity = 2,
                                      .points = points,
                                      .points_type = VTU_FLOAT32,
                                      .connectivity = cases[i][0],
                                      .offsets = cases[i][1],
                                      .types = types};
        struct vtu_file file;
        assert_int_equal(vtu_write(path, &grid), 0);
        assert_int_equal(vtu_read(&file, path), i == 0 ? 0 : STATUS_IO);
        vtu_file_reset(&file);
    }
}

// The old file stays when the new one cannot be written, and no temporary one is left.
static void test_atomic(void **state)
{
    struct folder *folder = *state;
    char path[256], temporary[256], nowhere[256];
    small_write(folder_file(folder, "a.vtu", path), 1);
    folder_file(folder, "a.vtu.tmp", temporary);
    assert_int_equal(mkdir(temporary, 0777), 0); // now the temporary file cannot be opened
    const struct vtu_grid grid = {.time = 2, .points_type = VTU_FLOAT32};
    assert_int_equal(vtu_write(path, &grid), STATUS_IO);
    struct vtu_file file;
    assert_int_equal(vtu_read(&file, path), 0);
    assert_true(file.grid.time == 1.0);
    vtu_file_reset(&file);
    rmdir(temporary);
    assert_int_equal(vtu_write(path, &grid), 0);
    assert_int_equal(vtu_read(&file, path), 0);
    assert_true(file.grid.time == 2.0);
    vtu_file_reset(&file);
    assert_int_equal(vtu_write(folder_file(folder, "no/a.vtu", nowhere), &grid), STATUS_IO);
    assert_int_equal(folder_count(folder->path), 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_types, folder_enter, folder_leave),
        cmocka_unit_test_setup_teardown(test_sizes, folder_enter, folder_leave),
        cmocka_unit_test_setup_teardown(test_threads, folder_enter, folder_leave),
        cmocka_unit_test_setup_teardown(test_truncated, folder_enter, folder_leave),
        cmocka_unit_test_setup_teardown(test_flipped, folder_enter, folder_leave),
        cmocka_unit_test_setup_teardown(test_refused, folder_enter, folder_leave),
        cmocka_unit_test_setup_teardown(test_cells, folder_enter, folder_leave),
        cmocka_unit_test_setup_teardown(test_atomic, folder_enter, folder_leave),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "base/field.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <string.h>

static double separate[3][3] = {{1.25, 2.5, 3.75}, {-1.5, -2.5, -3.5}, {7.0, 8.0, 9.0}};
static float interleaved[6] = {0.5f, 1.5f, 2.5f, 3.5f, 4.5f, 5.5f};
static int64_t ids[3] = {INT64_C(1) << 40, -2, 3};
static size_t count = 3;

static int fill_thirds(const void *owner, const struct field *field, void *destination)
{
    double *to = destination;

    for (size_t i = 0; i < count; i++)
        to[i] = *(const double *)owner * (double)i / 3.0;
    return field->components == 1 ? STATUS_OK : STATUS_NUMERICAL;
}

static int fill_fails(const void *owner, const struct field *field, void *destination)
{
    (void)owner;
    (void)field;
    (void)destination;
    return STATUS_NUMERICAL;
}

static struct field fields[] = {
    {"Velocity", "m/s", FIELD_DOUBLE, 3, FIELD_STATE, {separate[0], separate[1], separate[2]}, NULL},
    {"Pair", "-", FIELD_FLOAT, 2, FIELD_OUTPUT, {interleaved}, NULL},
    {"Id", "-", FIELD_INT64, 1, FIELD_STATE, {ids}, NULL},
    {"Thirds", "m", FIELD_DOUBLE, 1, FIELD_OUTPUT, {NULL}, fill_thirds},
    {"Bad", "m", FIELD_DOUBLE, 1, FIELD_OUTPUT, {NULL}, fill_fails},
    {"Later", "m", FIELD_UINT8, 1, FIELD_OUTPUT, {NULL}, NULL},
};
static const double owner = 2.385;
static const struct field_group group = {"block", &owner, &count, fields, sizeof fields / sizeof fields[0]};

static void find_by_name(void **state)
{
    (void)state;
    assert_ptr_equal(field_find(&group, "Id"), &fields[2]);
    assert_null(field_find(&group, "id"));
}

static void read_interleaves_and_copies(void **state)
{
    double u[9], thirds[3];
    float pair[6];
    int64_t id[3];

    (void)state;
    count = 3;
    assert_int_equal(field_read(&group, field_find(&group, "Velocity"), u), 0);
    for (int i = 0; i < 3; i++)
        for (int c = 0; c < 3; c++)
            assert_true(u[3 * i + c] == separate[c][i]);
    assert_int_equal(field_read(&group, field_find(&group, "Pair"), pair), 0);
    assert_memory_equal(pair, interleaved, sizeof pair);
    assert_int_equal(field_read(&group, field_find(&group, "Id"), id), 0);
    assert_memory_equal(id, ids, sizeof id);
    assert_int_equal(field_read(&group, field_find(&group, "Thirds"), thirds), 0);
    assert_true(thirds[2] == 2.385 * 2.0 / 3.0);
}

static void read_hands_on_the_status(void **state)
{
    double any[3];

    (void)state;
    assert_int_equal(field_read(&group, field_find(&group, "Bad"), any), STATUS_NUMERICAL);
}

static void read_of_an_empty_group_needs_no_array(void **state)
{
    unsigned char untouched = 0x5a;

    (void)state;
    count = 0;
    assert_int_equal(field_read(&group, field_find(&group, "Later"), &untouched), 0);
    assert_int_equal(untouched, 0x5a);
    count = 3;
}

static void write_is_the_reverse_of_read(void **state)
{
    double u[9], kept[3][3], other[9];
    int64_t id[3] = {5, 6, INT64_C(1) << 41}, id_kept[3];

    (void)state;
    memcpy(kept, separate, sizeof kept);
    memcpy(id_kept, ids, sizeof id_kept);
    for (int i = 0; i < 9; i++)
        u[i] = 0.1 + i * 2.385;
    field_write(&group, field_find(&group, "Velocity"), u);
    assert_true(separate[1][2] == u[7]);
    assert_int_equal(field_read(&group, field_find(&group, "Velocity"), other), 0);
    assert_memory_equal(other, u, sizeof u);
    field_write(&group, field_find(&group, "Id"), id);
    assert_memory_equal(ids, id, sizeof id);
    memcpy(separate, kept, sizeof kept);
    memcpy(ids, id_kept, sizeof id_kept);
}

static void lists_leave_out_what_has_no_state(void **state)
{
    struct field_list list = {0};
    struct field storage[2];
    double time = 0.25;
    int64_t steps = 7;
    const struct field singles[] = {{"Time", "s", FIELD_DOUBLE, 1, FIELD_STATE, {&time}, NULL},
                                    {"Steps", "-", FIELD_INT64, 1, 0, {&steps}, NULL}};
    const struct field_group stateless = {"shown", &owner, &count, &fields[3], 2};

    (void)state;
    const struct field_group values = field_singles("run", &owner, storage, singles, 2);
    assert_int_equal(*values.count, 1);
    assert_int_equal(field_count_state(&group), 2);
    assert_int_equal(field_count_state(&values), 1);
    assert_int_equal(field_list_add(&list, &group), 0);
    assert_int_equal(field_list_add(&list, &stateless), 0);
    assert_int_equal(field_list_add(&list, &values), 0);
    assert_int_equal(list.n, 2);
    assert_ptr_equal(list.groups[0], &group);
    assert_ptr_equal(list.groups[1], &values);
    field_list_reset(&list);
    field_list_reset(&list);
    assert_int_equal(list.n, 0);
}

static void sizes(void **state)
{
    (void)state;
    assert_int_equal(field_size(FIELD_DOUBLE), 8);
    assert_int_equal(field_size(FIELD_FLOAT), 4);
    assert_int_equal(field_size(FIELD_INT64), 8);
    assert_int_equal(field_size(FIELD_INT32), 4);
    assert_int_equal(field_size(FIELD_UINT8), 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(find_by_name),
        cmocka_unit_test(read_interleaves_and_copies),
        cmocka_unit_test(read_hands_on_the_status),
        cmocka_unit_test(read_of_an_empty_group_needs_no_array),
        cmocka_unit_test(write_is_the_reverse_of_read),
        cmocka_unit_test(lists_leave_out_what_has_no_state),
        cmocka_unit_test(sizes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

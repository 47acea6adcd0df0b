// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "base/log.h"
#include "base/memory.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <string.h>

static void create_gives_aligned_zeroes(void **state)
{
    static const size_t counts[] = {0, 1, 7, 8, 1021};

    (void)state;
    for (size_t k = 0; k < sizeof counts / sizeof counts[0]; k++) {
        double *numbers = memory_create(counts[k], sizeof *numbers);
        assert_non_null(numbers);
        assert_int_equal((uintptr_t)numbers % 64, 0);
        for (size_t i = 0; i < counts[k]; i++)
            assert_true(numbers[i] == 0.0);
        memset(numbers, 0xa5, counts[k] * sizeof *numbers); // the next one must not see it
        memory_free(numbers);
    }
    memory_free(NULL);
}

static void create_refuses_what_cannot_be_addressed(void **state)
{
    (void)state;
    assert_null(memory_create(SIZE_MAX / 8, 16));
    assert_null(memory_create(SIZE_MAX, 1));
    assert_null(memory_create((size_t)1 << 46, 64));
}

static void grow_keeps_and_zeroes(void **state)
{
    int *numbers = NULL;
    size_t capacity = 0;

    (void)state;
    assert_int_equal(memory_grow((void **)&numbers, &capacity, 5, sizeof *numbers), 0);
    assert_true(capacity >= 5);
    for (size_t i = 0; i < capacity; i++)
        numbers[i] = 31 + (int)i;
    const size_t before = capacity;
    assert_int_equal(memory_grow((void **)&numbers, &capacity, before, sizeof *numbers), 0);
    assert_int_equal(capacity, before);
    assert_int_equal(memory_grow((void **)&numbers, &capacity, before + 1, sizeof *numbers), 0);
    assert_true(capacity > before);
    assert_int_equal((uintptr_t)numbers % 64, 0);
    for (size_t i = 0; i < capacity; i++)
        assert_int_equal(numbers[i], i < before ? 31 + (int)i : 0);

    int *const same = numbers;
    const size_t kept = capacity;
    assert_int_equal(memory_grow((void **)&numbers, &capacity, SIZE_MAX / 2, sizeof *numbers), STATUS_MEMORY);
    assert_ptr_equal(numbers, same);
    assert_int_equal(capacity, kept);
    memory_free(numbers);
}

static void grow_gives_memory_for_nothing(void **state)
{
    void *memory = NULL;
    size_t capacity = 0;

    (void)state;
    assert_int_equal(memory_grow(&memory, &capacity, 0, 24), 0);
    assert_non_null(memory);
    memory_free(memory);
}

static void text_and_print_copy(void **state)
{
    char original[] = "beam";
    char *copy = memory_text(original), *printed = memory_print("%s-%03d %.3g", original, 17, 2.385);
    char *longer = memory_print("%700d", 1);

    (void)state;
    original[0] = 'x';
    assert_string_equal(copy, "beam");
    assert_string_equal(printed, "beam-017 2.38");
    assert_int_equal(strlen(longer), 700);
    memory_free(copy);
    memory_free(printed);
    memory_free(longer);
}

static int returns_memory(void)
{
    CHECK_MEMORY(memory_create(SIZE_MAX, 2));
    return STATUS_OK;
}

static void check_returns_the_status(void **state)
{
    (void)state;
    assert_int_equal(returns_memory(), STATUS_MEMORY);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(create_gives_aligned_zeroes),
        cmocka_unit_test(create_refuses_what_cannot_be_addressed),
        cmocka_unit_test(grow_keeps_and_zeroes),
        cmocka_unit_test(grow_gives_memory_for_nothing),
        cmocka_unit_test(text_and_print_copy),
        cmocka_unit_test(check_returns_the_status),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

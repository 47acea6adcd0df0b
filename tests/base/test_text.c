// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/text.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <string.h>

static const char *const list[] = {"density", "young", "poisson", "law", "k"};
enum { N = sizeof list / sizeof list[0] };

static void closest_finds_slips_of_the_finger(void **state)
{
    (void)state;
    assert_string_equal(text_closest("yuong", list, N), "young");      // swapped
    assert_string_equal(text_closest("densty", list, N), "density");   // left out
    assert_string_equal(text_closest("poissson", list, N), "poisson"); // doubled
    assert_string_equal(text_closest("lav", list, N), "law");          // replaced
    assert_string_equal(text_closest("k", list, N), "k");
}

static void closest_refuses_other_words(void **state)
{
    char longest[200];

    (void)state;
    memset(longest, 'd', sizeof longest - 1);
    longest[sizeof longest - 1] = '\0';
    assert_null(text_closest("viscosity", list, N));
    assert_null(text_closest("ky", list, N)); // one of two letters is more than a third
    assert_null(text_closest("", list, N));
    assert_null(text_closest(longest, list, N));
    assert_null(text_closest("young", list, 0));
    assert_null(text_closest("young", (const char *const[]){longest}, 1));
}

static void closest_takes_the_nearest_then_the_first(void **state)
{
    static const char *const similar[] = {"pressure-b", "pressure-a", "pressure-ax"};

    (void)state;
    assert_string_equal(text_closest("pressure-ax", similar, 3), "pressure-ax");
    assert_string_equal(text_closest("pressure-c", similar, 3), "pressure-b");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closest_finds_slips_of_the_finger),
        cmocka_unit_test(closest_refuses_other_words),
        cmocka_unit_test(closest_takes_the_nearest_then_the_first),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

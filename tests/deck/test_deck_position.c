// SPDX-License-Identifier: GPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/error.h"
#include "base/memory.h"
#include "deck/deck_position.h"

#include <stdlib.h>
#include <string.h>

static void assert_place(struct location where, int line, int column)
{
    if (where.line != line || where.column != column)
        fail_msg("at %d:%d, not at %d:%d", where.line, where.column, line, column);
}

static void test_places(void **state)
{
    (void)state;
    const char *text = "\xEF\xBB\xBF<?xml version='1.0' encoding='utf-8'?>\r\n"
                       "<!-- <no tag='x'> -->\n"
                       "<a one=\"1>2\" xmlns:p='q'\n"
                       "   two = '<\"'><![CDATA[<b x='1'>]]>\n"
                       "  F\xC3\xA4hnchen <b/><c\tthree='3'/>\n"
                       "</a>\n";
    struct positions positions;
    struct location where;
    char message[128];
    assert_int_equal(positions_scan(&positions, text, &where, message, sizeof message), 0);
    assert_int_equal(positions.n_tags, 3);
    assert_int_equal(positions.n_attributes, 3);
    assert_place(positions.tags[0].where, 3, 1);
    assert_int_equal(positions.tags[0].n, 2);
    assert_place(positions.attributes[0], 3, 4);
    assert_place(positions.attributes[1], 4, 4);
    assert_place(positions.tags[1].where, 5, 12);
    assert_int_equal(positions.tags[1].n, 0);
    assert_place(positions.tags[2].where, 5, 16);
    assert_int_equal(positions.tags[2].first, 2);
    assert_place(positions.attributes[2], 5, 19);
    positions_reset(&positions);
    assert_null(positions.tags);
}

static void refuse(const char *text, int line, int column, const char *wanted)
{
    struct positions positions;
    struct location where;
    char message[128];
    assert_int_equal(positions_scan(&positions, text, &where, message, sizeof message), STATUS_DECK);
    assert_place(where, line, column);
    assert_string_equal(message, wanted);
    positions_reset(&positions);
}

static void test_refused(void **state)
{
    (void)state;
    refuse("<?xml version=\"1.0\" encoding=\"latin1\"?>\n<a/>", 1, 1,
           "encoding \"latin1\" is not supported: write the deck in UTF-8");
    refuse("<!-- x -->\n  <!DOCTYPE deck []>\n<a/>", 2, 3,
           "a deck must not have a document type (<!DOCTYPE ...>) or entities");
    char deep[4 * (POSITION_DEPTH + 1) + 1] = "";
    for (int i = 0; i < POSITION_DEPTH + 1; i++)
        strcat(deep, "<a>\n");
    refuse(deep, POSITION_DEPTH + 1, 1, "elements are nested deeper than 64 levels");
}

/** What is not well-formed is left to the parser; nothing is read beyond the end. */
static void test_broken(void **state)
{
    (void)state;
    static const char whole[] = "<?xml version='1.0'?><!-- c --><a b='c' d=\"e\"><![CDATA[f]]></a>";
    for (size_t n = 0; n < sizeof whole; n++) {
        char *text = malloc(n + 1); // of exactly this length, so that tools see reads behind it
        assert_non_null(text);
        memcpy(text, whole, n);
        text[n] = '\0';
        struct positions positions;
        struct location where;
        char message[128];
        int status = positions_scan(&positions, text, &where, message, sizeof message);
        assert_true(status == 0 || (status == STATUS_DECK && strstr(message, "document type")));
        assert_true(positions.n_tags <= 2);
        positions_reset(&positions);
        free(text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_places), cmocka_unit_test(test_refused),
                                       cmocka_unit_test(test_broken)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

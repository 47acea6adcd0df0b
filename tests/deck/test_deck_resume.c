// SPDX-License-Identifier: GPL-3.0-or-later
// What --set may change when a run is resumed.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/error.h"
#include "base/log.h"
#include "deck/deck.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char deck_path[] = "/tmp/skerry-resume-XXXXXX", log_path[] = "/tmp/skerry-resume-log-XXXXXX";

static int setup(void **state)
{
    (void)state;
    log_set_level(LOG_ERROR);
    int deck = mkstemp(deck_path), log = mkstemp(log_path);
    return deck < 0 || log < 0 || close(deck) || close(log);
}

static int teardown(void **state)
{
    (void)state;
    return unlink(deck_path) || unlink(log_path);
}

/** Every parameter is a trap of its own. */
static const char deck_text[] =
    "<deck version='1' dim='2'>\n"
    "  <parameters>\n"
    "    <parameter name='dx' value='0.1'/>\n"
    "    <parameter name='width' value='10*dx'/>\n"
    "    <parameter name='last' value='10'/>\n"
    "    <parameter name='frames' value='last/20'/>\n"
    "    <parameter name='m' value='1'/>\n"     // a unit
    "    <parameter name='water' value='1'/>\n" // the name of a material
    "    <parameter name='mixed' value='1'/>\n" // a choice
    "    <parameter name='e3' value='1'/>\n"    // the end of a number
    "    <parameter name='d' value='1'/>\n"     // a part of words
    "    <parameter name='speed' value='2'/>\n"
    "    <parameter name='slow' value='min(speed, 3)'/>\n"
    "    <function name='ramp' value='speed*t'/>\n"
    "    <function name='push' value='2*ramp'/>\n"
    "    <parameter name='c' value='10'/>\n"
    "    <function name='twice' value='min(2*c, 22)'/>\n"
    "    <parameter name='sound' value='twice'/>\n"
    "  </parameters>\n"
    "  <time end='last' step='0.001'><body-force value='slow 0'/></time>\n"
    "  <domain lower='0 0' upper='1m 1.e3*0.001'/>\n"
    "  <materials>\n"
    "    <fluid name='water' density='1' kinematic-viscosity='0.1' sound-speed='20' "
    "background-pressure='0'/>\n"
    "  </materials>\n"
    "  <fluid material='water' spacing='0.1' arithmetic='mixed'>\n"
    "    <region><points>0.25 0.25 # dx last c\n 0.35 0.25</points></region>\n"
    "  </fluid>\n"
    "  <output>\n"
    "    <fields every='frames'/>\n"
    "    <history name='gauge' type='gauge' at='m 0.5*(water+d)' every='0.1*(e3+mixed)+0*dx'/>\n"
    "    <checkpoints every='speed'/>\n"
    "  </output>\n"
    "</deck>\n";

struct trial {
    const char *piece, *replacement; /**< of the deck; NULL: as it is */
    const char *before, *later;      /**< overrides, separated by blanks */
    const char *place; /**< the refusal: "LINE:COLUMN: NAME=VALUE ELEMENT ATTRIBUTE"; NULL: allowed */
};

static void write_variant(const char *piece, const char *replacement)
{
    const char *found = piece ? strstr(deck_text, piece) : deck_text;
    if (!found)
        fail_msg("\"%s\" is not in the deck", piece);
    FILE *file = fopen(deck_path, "w");
    assert_non_null(file);
    fprintf(file, "%.*s%s%s", (int)(found - deck_text), deck_text, piece ? replacement : "",
            found + (piece ? strlen(piece) : 0));
    assert_int_equal(fclose(file), 0);
}

/** Cut at blanks, behind the @p n overrides that are there. Returns the number of all. */
static size_t add_overrides(const char *text, char buffer[256], const char **overrides, size_t n)
{
    char *rest = NULL;
    snprintf(buffer, 256, "%s", text);
    for (char *word = strtok_r(buffer, " ", &rest); word; word = strtok_r(NULL, " ", &rest))
        overrides[n++] = word;
    return n;
}

/** Read the deck as that of a resumed run; what is reported goes to @p messages. */
static int resume(const char *before, const char *later, struct model **model, char messages[4096])
{
    char buffers[2][256];
    const char *overrides[16];
    const size_t n_before = add_overrides(before, buffers[0], overrides, 0);
    const size_t n = add_overrides(later, buffers[1], overrides, n_before);
    assert_int_equal(truncate(log_path, 0), 0);
    assert_int_equal(log_open(log_path), 0);
    int status = deck_read_resume(model, deck_path, n, overrides, n_before);
    log_close();
    FILE *file = fopen(log_path, "r");
    assert_non_null(file);
    messages[fread(messages, 1, 4095, file)] = '\0';
    fclose(file);
    assert_true((status == 0) == (*model != NULL));
    return status;
}

/** "12:5: dx=1 fluid spacing" as it is reported. */
static void print_refusal(const char *place, char *text, size_t size)
{
    int line, column;
    char override[64], element[64], attribute[64];
    assert_int_equal(sscanf(place, "%d:%d: %63s %63s %63s", &line, &column, override, element, attribute), 5);
    snprintf(text, size,
             "%s:%d:%d: error: --set %s would change <%s %s>: a resumed run can only change its end and its "
             "output; start a new run for this\n",
             deck_path, line, column, override, element, attribute);
}

static void run_trials(const struct trial *trials, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        const struct trial *trial = &trials[i];
        char messages[4096], wanted[512] = "";
        struct model *model;
        write_variant(trial->piece, trial->replacement);
        int status = resume(trial->before, trial->later, &model, messages);
        if (trial->place)
            print_refusal(trial->place, wanted, sizeof wanted);
        if (status != (trial->place ? STATUS_USAGE : 0) || strcmp(messages, wanted) != 0)
            fail_msg("%s | %s | %s: status %d\n%sinstead of\n%s",
                     trial->piece ? trial->replacement : "the deck", trial->before, trial->later, status,
                     messages, wanted);
        model_destroy(model);
    }
}
#define RUN_TRIALS(trials) run_trials(trials, sizeof(trials) / sizeof *(trials))

/** The end and the output may change, by way of other parameters too. */
static void test_allowed(void **state)
{
    (void)state;
    static const struct trial trials[] = {
        {NULL, NULL, "", "", NULL},
        {NULL, NULL, "", "last=20", NULL}, // reaches end and, through frames, fields
        {NULL, NULL, "", "frames=0.25", NULL},
        {NULL, NULL, "last=5", "last=20 frames=last/7", NULL},
        {"every='frames'", "every='frames' arrays='Support' virtual-particles='last'", "", "last=20", NULL},
        {"name='gauge' type='gauge' at='m 0.5*(water+d)'",
         "name='line' type='profile' from='0 0' to='m d' "
         "points='last*water'",
         "", "last=20 water=2 d=0.5", NULL},
        {"end='last'", "end='frames*20'", "", "frames=3", NULL},
    };
    RUN_TRIALS(trials);
    struct model *model;
    char messages[4096];
    write_variant(NULL, NULL);
    assert_int_equal(resume("last=5", "last=2*20", &model, messages), 0);
    assert_true(model->time.end == 40.0 && model->output.every == 2.0);
    model_destroy(model);
}

/** Anything else may not, wherever it is mentioned and whatever stands between. */
static void test_refused(void **state)
{
    (void)state;
    static const struct trial trials[] = {
        {"spacing='0.1'", "spacing='dx'", "", "dx=0.05", "25:27: dx=0.05 fluid spacing"},
        {"spacing='0.1'", "spacing='width/10'", "", "dx=0.05", "25:27: dx=0.05 fluid spacing"},
        {"spacing='0.1'", "spacing='width/10'", "", "width=2", "25:27: width=2 fluid spacing"},
        {"step='0.001'", "step='last/10000'", "", "last=20", "20:20: last=20 time step"},
        {"step='0.001'", "step='frames/500'", "", "last=20", "20:20: last=20 time step"},
        {"value='slow 0'", "value='0 ramp'", "", "speed=1", "20:45: speed=1 body-force value"},
        {"value='slow 0'", "value='0 push'", "", "speed=1", "20:45: speed=1 body-force value"},
        {"sound-speed='20'", "sound-speed='sound'", "", "c=11", "23:63: c=11 fluid sound-speed"},
        {"upper='1m 1.e3*0.001'", "upper='1 - d + last/10 m'", "", "last=20", "21:23: last=20 domain upper"},
        {"upper='1m 1.e3*0.001'", "upper='1 m'", "", "m=2", "21:23: m=2 domain upper"},
        {"<region><points>", "<region velocity='0 d*x'><points>", "", "d=2", "26:13: d=2 region velocity"},
        {"<region><points>", "<region origin='0 (1+d)'><points>", "", "d=2", "26:13: d=2 region origin"},
        {NULL, NULL, "", "slow=1", "20:45: slow=1 body-force value"},
        {NULL, NULL, "", "speed=1", "20:45: speed=1 body-force value"},
    };
    RUN_TRIALS(trials);
}

/** A value that is the same as before changes nothing, however it is written. */
static void test_same_values(void **state)
{
    (void)state;
    static const struct trial trials[] = {
        {"spacing='0.1'", "spacing='dx'", "", "dx=0.1", NULL},
        {"spacing='0.1'", "spacing='dx'", "", "dx=1/10", NULL},
        {"spacing='0.1'", "spacing='dx'", "", "dx=100e-3", NULL},
        {"spacing='0.1'", "spacing='dx'", "dx=0.05", "dx=0.05", NULL},
        {"spacing='0.1'", "spacing='dx'", "dx=0.05", "dx=0.1", "25:27: dx=0.1 fluid spacing"},
        // of several overrides the last one counts, on both sides
        {"spacing='0.1'", "spacing='dx'", "dx=0.1 dx=0.05", "dx=0.2 dx=0.05", NULL},
        {"spacing='0.1'", "spacing='dx'", "dx=0.05 dx=0.1", "dx=0.05", "25:27: dx=0.05 fluid spacing"},
        {"spacing='0.1'", "spacing='dx'", "", "dx=0.1 dx=0.05", "25:27: dx=0.05 fluid spacing"},
        // speed reaches the force through slow only, which stays at 3
        {NULL, NULL, "speed=4", "speed=5", NULL},
        {"sound-speed='20'", "sound-speed='sound'", "c=11", "c=12", NULL},
        // width no longer depends on dx
        {"spacing='0.1'", "spacing='width/10'", "width=1", "dx=0.05", NULL},
        {"spacing='0.1'", "spacing='width/10'", "", "dx=0.05 width=1", NULL},
        {"spacing='0.1'", "spacing='width/10'", "width=2", "width=20*dx", NULL},
        {"spacing='0.1'", "spacing='width/10'", "width=20*dx", "dx=0.05", "25:27: dx=0.05 fluid spacing"},
        {"spacing='0.1'", "spacing='width/10'", "", "dx=0.05 width=2", "25:27: width=2 fluid spacing"},
        // but water does now
        {"spacing='0.1'", "spacing='water/10'", "water=10*dx", "dx=0.05", "25:27: dx=0.05 fluid spacing"},
    };
    RUN_TRIALS(trials);
}

/** Units, names, choices, comments, numbers and parts of words mention no parameter. */
static void test_words(void **state)
{
    (void)state;
    static const struct trial trials[] = {
        {NULL, NULL, "", "m=0.5", NULL},
        {NULL, NULL, "", "water=2", NULL},
        {NULL, NULL, "", "mixed=2", NULL},
        {NULL, NULL, "", "e3=2", NULL},
        {"spacing='0.1'", "spacing='dx'", "", "d=2", NULL},
        {"spacing='0.1'", "spacing='0.1 m'", "", "m=0.5", NULL},
        {"<parameter name='width' value='10*dx'/>", "<parameter name='width' value='1 m'/>", "", "m=0.5",
         NULL},
        {"spacing='0.1'", "spacing='1/(5+5*m)'", "", "m=0.5", "25:27: m=0.5 fluid spacing"},
    };
    RUN_TRIALS(trials);
}

/** Each override is refused on its own, in the order of the deck; one that is allowed does not help. */
static void test_several(void **state)
{
    (void)state;
    char messages[4096], first[512], second[512], both[1024];
    struct model *model;
    write_variant("spacing='0.1'", "spacing='dx' damping='dx*c'");
    assert_int_equal(resume("", "c=11 last=20 dx=0.05", &model, messages), STATUS_USAGE);
    print_refusal("25:27: dx=0.05 fluid spacing", first, sizeof first);
    print_refusal("25:40: c=11 fluid damping", second, sizeof second);
    snprintf(both, sizeof both, "%s%s", first, second);
    assert_string_equal(messages, both);
}

/** What is wrong in any case is reported as deck_read does. */
static void test_mistakes(void **state)
{
    (void)state;
    static const struct {
        const char *later;
        int status;
        const char *text;
    } cases[] = {
        {"dxx=1", STATUS_USAGE,
         "skerry: error: --set dxx=1: %s has no parameter \"dxx\"; did you mean \"dx\"?\n"},
        {"ramp=1", STATUS_USAGE,
         "skerry: error: --set ramp=1: %s has no parameter \"ramp\"; known: \"dx\", "},
        {"dx", STATUS_USAGE, "skerry: error: --set dx: write NAME=VALUE\n"},
        {"last=1+", STATUS_USAGE, "skerry: error: --set last=1+: "},
        {"last=0", STATUS_DECK, "%s:20:9: error: <time>: end=\"last\" is 0; it must be greater than 0\n"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char messages[4096], wanted[512];
        struct model *model;
        write_variant(NULL, NULL);
        assert_int_equal(resume("", cases[i].later, &model, messages), cases[i].status);
        const char *name = strstr(cases[i].text, "%s");
        snprintf(wanted, sizeof wanted, "%.*s%s%s", name ? (int)(name - cases[i].text) : 0, cases[i].text,
                 name ? deck_path : "", name ? name + 2 : cases[i].text);
        if (!strstr(messages, wanted))
            fail_msg("--set %s: %sinstead of\n%s", cases[i].later, messages, wanted);
    }
    char messages[4096];
    struct model *model;
    write_variant("<parameter name='dx' value='0.1'/>", "<parameter name='dx' value='0.1 +'/>");
    assert_int_equal(resume("", "slow=1", &model, messages), STATUS_DECK);
}

/** A parameter that had no value before has another one now. */
static void test_no_value_before(void **state)
{
    (void)state;
    static const struct trial trials[] = {
        {"spacing='0.1'", "spacing='dx'", "dx=1/0", "dx=0.1", "25:27: dx=0.1 fluid spacing"},
        {NULL, NULL, "last=1/0", "last=20", NULL},
    };
    RUN_TRIALS(trials);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_allowed),        cmocka_unit_test(test_refused),
                                       cmocka_unit_test(test_same_values),    cmocka_unit_test(test_words),
                                       cmocka_unit_test(test_several),        cmocka_unit_test(test_mistakes),
                                       cmocka_unit_test(test_no_value_before)};
    return cmocka_run_group_tests(tests, setup, teardown);
}

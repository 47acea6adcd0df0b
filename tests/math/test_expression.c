// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"
#include "math/expression.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char *const constants[] = {"H", "U_mean", "dx"};
static const double values[] = {0.41, 1.0, 0.0082};
static const char *const functions[] = {"ramp", "profile", "loop"};
static const char *const texts[] = {"t < 2 ? (1 - cos(pi*t/2))/2 : 1", "1.5*U_mean*y*(H - y)/(H/2)^2 * ramp",
                                    "loop + 1"};
static const struct expression_scope scope = {3, constants, values, 3, functions, texts};

static const double place[3] = {0.31, 0.17, -2.5};
static const double instant = 1.3;

static double evaluate(const char *text)
{
    struct expression *expression;
    char message[300] = "";

    if (expression_create(&expression, text, &scope, message, sizeof message))
        fail_msg("'%s': %s", text, message);
    assert_string_equal(expression_text(expression), text);
    const double value = expression_value(expression, place, instant);
    expression_destroy(expression);
    return value;
}

static void assert_near(double value, double expected)
{
    if (!(fabs(value - expected) <= 4e-16 * fabs(expected)))
        fail_msg("%.17g is not %.17g", value, expected);
}

static void arithmetic(void **state)
{
    (void)state;
    assert_near(evaluate("2.385"), 2.385);
    assert_near(evaluate(" .5e1+5.*1E-1 "), 5.5);
    assert_near(evaluate("2^3^2"), 512.0);
    assert_near(evaluate("-2^2"), -4.0);
    assert_near(evaluate("2^-1"), 0.5);
    assert_near(evaluate("1 - -x"), 1.31);
    assert_near(evaluate("x*y + z"), 0.31 * 0.17 - 2.5);
    assert_near(evaluate("x\t+\n1"), 1.31);
    assert_near(evaluate("x - z/t"), 0.31 + 2.5 / 1.3);
    assert_near(evaluate("pi"), 3.14159265358979323846);
    assert_near(evaluate("sin(pi/6) + sqrt (2.25) + max(x, y, 1) + atan2(1, 1)"),
                sin(M_PI / 6.0) + 1.5 + 1.0 + M_PI / 4.0);
}

static void comparisons_and_choices(void **state)
{
    (void)state;
    assert_near(evaluate("x <= 0.31"), 1.0);
    assert_near(evaluate("x >= 0.32"), 0.0);
    assert_near(evaluate("x == 0.31 && y != 0.18 || 0"), 1.0);
    assert_near(evaluate("x < 0 ? 2 : x < 1 ? 5 : 7"), 5.0);
}

static void names_of_the_scope(void **state)
{
    const double ramp = (1.0 - cos(M_PI * 1.3 / 2.0)) / 2.0;

    (void)state;
    assert_near(evaluate("H/dx"), 0.41 / 0.0082);
    assert_near(evaluate("ramp"), ramp);
    assert_near(evaluate("-2*ramp^2"), -2.0 * ramp * ramp);
    assert_true(fabs(evaluate("profile") - 1.5 * 0.17 * 0.24 / (0.205 * 0.205) * ramp) < 1e-15);
}

static void undefined_results_are_the_callers_affair(void **state)
{
    (void)state;
    assert_true(isinf(evaluate("1/0")));
    assert_true(isnan(evaluate("0/0")));
    assert_true(isnan(evaluate("sqrt(z)")));
}

static void what_it_depends_on(void **state)
{
    static const struct {
        const char *text;
        bool constant, steady;
    } cases[] = {{"2*H", true, true},    {"x*0", false, true},   {"z", false, true},
                 {"t", false, false},    {"ramp", false, false}, {"profile", false, false},
                 {"exp(1)", true, true}, {"H + y", false, true}, {"1 < 2 ? H : t", false, false}};

    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct expression *expression;
        char message[300];
        assert_int_equal(expression_create(&expression, cases[i].text, &scope, message, sizeof message), 0);
        assert_int_equal(expression_is_constant(expression), cases[i].constant);
        assert_int_equal(expression_is_steady(expression), cases[i].steady);
        expression_destroy(expression);
    }
}

static void expressions_do_not_share_their_variables(void **state)
{
    struct expression *first, *second;
    char message[300];

    (void)state;
    assert_int_equal(expression_create(&first, "x + 10*t", NULL, message, sizeof message), 0);
    assert_int_equal(expression_create(&second, "x + 10*t", NULL, message, sizeof message), 0);
    assert_near(expression_value(first, place, 2.0), 20.31);
    assert_near(expression_value(second, NULL, 0.5), 5.0);
    assert_near(expression_value(first, NULL, 0.25), 2.5);
    expression_destroy(first);
    expression_destroy(second);
}

static void plain_numbers(void **state)
{
    struct expression *expression = expression_constant(-0.1);

    (void)state;
    assert_true(expression_value(expression, place, instant) == -0.1);
    assert_true(expression_is_constant(expression) && expression_is_steady(expression));
    assert_string_equal(expression_text(expression), "-0.10000000000000001");
    expression_destroy(expression);
    expression_destroy(NULL);
}

static void assert_refused(const char *text, const char *expected)
{
    struct expression *expression = NULL;
    char message[300] = "";

    const int status = expression_create(&expression, text, &scope, message, sizeof message);
    if (status != STATUS_DECK || !strstr(message, expected))
        fail_msg("'%.60s': status %d, message '%s', expected '%s'", text, status, message, expected);
    assert_null(expression);
    assert_null(strchr(message, '\n'));
}

static void mistakes_are_named(void **state)
{
    (void)state;
    assert_refused("", "empty");
    assert_refused(" \t", "empty");
    assert_refused("x = 3", "'=' cannot assign");
    assert_refused("x === 3", "'=' cannot assign");
    assert_refused("U_maen*2", "unknown name 'U_maen': did you mean 'U_mean'?");
    assert_refused("quark", "unknown name 'quark': known are x, y, z, t, pi");
    assert_refused("profil", "did you mean 'profile'?");
    assert_refused("sine(x)", "did you mean 'sin'?");
    assert_refused("_pi", "unknown name '_pi': did you mean 'pi'?");
    assert_refused("rnd(1)", "unknown name 'rnd'");
    assert_refused("0x1F", "unknown name 'x1F'");
    assert_refused("loop", "unknown name 'loop'"); // functions see only those before them
    assert_refused("sin + 1", "'sin' is a function");
    assert_refused("ramp(t)", "'ramp' takes no argument");
    assert_refused("x (2)", "'x' takes no argument");
    assert_refused("(1 + x", "closing parenthesis is missing");
    assert_refused("1 + x)", "without an opening one");
    assert_refused("1 +", "Unexpected end");
    assert_refused("1 2", "Unexpected value");
    assert_refused("x ? 1", "else");
    assert_refused("1, 2", "2 values");
    assert_refused("sin()", "Too few parameters");
    assert_refused("1e400", "too large");
    assert_refused("1 + .", "a point without digits");
    assert_refused("\"x\"", "unexpected character '\"'");
    assert_refused("1;2", "unexpected character ';'");
    assert_refused("2\xc3\x97x", "unexpected byte 0xc3");
}

static void long_and_deep_texts_do_not_harm(void **state)
{
    char text[6000];

    (void)state;
    memset(text, 'q', 1024);
    text[1024] = '\0';
    assert_refused(text, "unknown name 'qqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqq...'");
    text[1024] = 'q';
    text[1025] = '\0';
    assert_refused(text, "1025 letters long; at most 1024");
    memset(text, '1', 1000);
    text[1000] = '\0';
    assert_refused(text, "too large");

    for (int depth = 64; depth <= 65; depth++) {
        memset(text, '(', (size_t)depth);
        text[depth] = 'x';
        memset(text + depth + 1, ')', (size_t)depth);
        text[2 * depth + 1] = '\0';
        if (depth == 64)
            assert_near(evaluate(text), 0.31);
        else
            assert_refused(text, "deeper than 64");
    }
    memset(text, '-', 1000);
    text[1000] = 'x';
    text[1001] = '\0';
    assert_refused(text, "Unexpected operator");
}

static void expansion_is_capped(void **state)
{
    static const char *const names[] = {"f0", "f1", "f2", "f3", "f4", "f5", "f6", "f7"};
    static const char *const doubled[] = {"x+x",   "f0*f0", "f1*f1", "f2*f2",
                                          "f3*f3", "f4*f4", "f5*f5", "f6*f6"};
    static const char *const broken[] = {"1)+(1", "(2", "1,2"};
    const struct expression_scope growing = {0, NULL, NULL, 8, names, doubled};
    const struct expression_scope bad = {0, NULL, NULL, 3, names, broken};
    struct expression *expression;
    char message[300], text[1025] = "f4";

    (void)state;
    assert_int_equal(expression_create(&expression, "f4", &growing, message, sizeof message), 0);
    assert_near(expression_value(expression, place, 0.0), pow(0.62, 16.0));
    expression_destroy(expression);
    for (int i = 0; i < 100; i++)
        strcat(text, "+f7");
    assert_int_equal(expression_create(&expression, text, &growing, message, sizeof message), STATUS_DECK);
    assert_non_null(strstr(message, "longer than 8192"));
    // A mistake muParser sees in a long text: its own message could overflow its buffer and is not asked for.
    strcpy(text, "f6*f6*f6 +");
    assert_int_equal(expression_create(&expression, text, &growing, message, sizeof message), STATUS_DECK);
    assert_non_null(strstr(message, "not a well-formed expression"));

    assert_int_equal(expression_create(&expression, "f0", &bad, message, sizeof message), STATUS_DECK);
    assert_non_null(strstr(message, "without an opening one"));
    assert_int_equal(expression_create(&expression, "f1)", &bad, message, sizeof message), STATUS_DECK);
    assert_non_null(strstr(message, "function 'f1'"));
}

static void taken_names_are_refused(void **state)
{
    static const char *const taken[] = {"t", "pi", "exp"};

    (void)state;
    for (size_t i = 0; i < 3; i++) {
        const struct expression_scope as_constant = {1, &taken[i], values, 0, NULL, NULL};
        const struct expression_scope as_function = {0, NULL, NULL, 1, &taken[i], texts};
        struct expression *expression;
        char message[300];
        assert_int_equal(expression_create(&expression, "1", &as_constant, message, sizeof message),
                         STATUS_DECK);
        assert_non_null(strstr(message, "choose another parameter name"));
        assert_int_equal(expression_create(&expression, "1", &as_function, message, sizeof message),
                         STATUS_DECK);
        assert_non_null(strstr(message, "choose another function name"));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(arithmetic),
        cmocka_unit_test(comparisons_and_choices),
        cmocka_unit_test(names_of_the_scope),
        cmocka_unit_test(undefined_results_are_the_callers_affair),
        cmocka_unit_test(what_it_depends_on),
        cmocka_unit_test(expressions_do_not_share_their_variables),
        cmocka_unit_test(plain_numbers),
        cmocka_unit_test(mistakes_are_named),
        cmocka_unit_test(long_and_deep_texts_do_not_harm),
        cmocka_unit_test(expansion_is_capped),
        cmocka_unit_test(taken_names_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

// SPDX-License-Identifier: GPL-3.0-or-later
// Expressions by muParser's C interface. Its traps, met here before it sees the text: it aborts on tokens of
// about 2 kB (also in its error messages) and on very deep parentheses; "=" assigns; "a, b" has two values;
// its own _pi has 13 digits only.
#include "math/expression.h"

#include "base/error.h"
#include "base/memory.h"
#include "base/text.h"

#include <ctype.h>
#include <math.h>
#include <muParserDLL.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    TEXT_LIMIT = 1024,     // letters of one text
    EXPANDED_LIMIT = 8192, // letters with the functions' texts in their places
    MESSAGE_LIMIT = 1500,  // longer texts could overflow muParser's message buffer
    DEPTH_LIMIT = 64       // nested parentheses
};

enum { X, Y, Z, T, N_PLACE };

static const char *const place_names[N_PLACE] = {"x", "y", "z", "t"};
static const char *const built_in[] = {
    "abs", "acos", "acosh", "asin", "asinh", "atan", "atan2", "atanh", "avg",  "cos",  "cosh", "exp", "ln",
    "log", "log2", "log10", "max",  "min",   "rint", "sign",  "sin",   "sinh", "sqrt", "sum",  "tan", "tanh",
};
enum { N_BUILT_IN = sizeof built_in / sizeof built_in[0] };

struct expression {
    char *text;
    muParserHandle_t parser; // NULL: the value below, always
    double value;
    double *place; // x, y, z, t as the parser sees them
    bool uses[N_PLACE];
};

// Where a mistake is written.
struct complaint {
    char *message;
    size_t size;
};

#define REFUSE(complaint, ...) (snprintf((complaint).message, (complaint).size, __VA_ARGS__), STATUS_DECK)

// The text on its way to the parser.
struct expansion {
    const struct expression_scope *scope;
    struct complaint complaint;
    char text[EXPANDED_LIMIT + 1];
    size_t length;
    int depth; // of open parentheses
    int floor; // depth at which the text being read began
    bool uses[N_PLACE];
};

static int find_name(const char *name, size_t length, const char *const *list, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (strlen(list[i]) == length && memcmp(list[i], name, length) == 0)
            return (int)i;
    return -1;
}

static int append(struct expansion *to, const char *text, size_t length)
{
    if (to->length + length > EXPANDED_LIMIT)
        return REFUSE(to->complaint, "longer than %d letters with the functions it uses written out",
                      EXPANDED_LIMIT);
    memcpy(to->text + to->length, text, length);
    to->length += length;
    to->text[to->length] = '\0';
    return STATUS_OK;
}

static int open_parenthesis(struct expansion *to)
{
    if (++to->depth > DEPTH_LIMIT)
        return REFUSE(to->complaint, "parentheses nested deeper than %d", DEPTH_LIMIT);
    return append(to, "(", 1);
}

static int unknown_name(struct expansion *to, const char *name, size_t length, size_t n_functions)
{
    const struct expression_scope *scope = to->scope;
    const size_t n = N_PLACE + 1 + N_BUILT_IN + scope->n_constants + n_functions;
    const char **names = memory_create(n, sizeof *names);
    char word[48];
    size_t i = 0;

    CHECK_MEMORY(names);
    for (size_t k = 0; k < scope->n_constants; k++)
        names[i++] = scope->constant_names[k];
    for (size_t k = 0; k < n_functions; k++)
        names[i++] = scope->function_names[k];
    for (size_t k = 0; k < N_PLACE; k++)
        names[i++] = place_names[k];
    for (size_t k = 0; k < N_BUILT_IN; k++)
        names[i++] = built_in[k];
    names[i++] = "pi";

    snprintf(word, sizeof word, "%.*s%s", length > 40 ? 40 : (int)length, name, length > 40 ? "..." : "");
    const char *closest = length > 40 ? NULL : text_closest(word, names, n);
    int status;
    if (closest)
        status = REFUSE(to->complaint, "unknown name '%s': did you mean '%s'?", word, closest);
    else
        status =
            REFUSE(to->complaint,
                   "unknown name '%s': known are x, y, z, t, pi, the parameters and functions of the deck "
                   "and mathematical functions such as sin, exp, min, max",
                   word);
    memory_free(names);
    return status;
}

static int expand(struct expansion *to, const char *text, size_t n_functions);

// Append the identifier of @p length letters at @p name, which @p next follows; a function's text takes its
// place.
static int expand_name(struct expansion *to, const char *name, size_t length, char next, size_t n_functions)
{
    const struct expression_scope *scope = to->scope;
    const int place = find_name(name, length, place_names, N_PLACE);
    const int function = find_name(name, length, scope->function_names, n_functions);
    const bool constant = find_name(name, length, scope->constant_names, scope->n_constants) >= 0 ||
                          find_name(name, length, (const char *const[]){"pi"}, 1) >= 0;

    if (find_name(name, length, built_in, N_BUILT_IN) >= 0) {
        if (next != '(')
            return REFUSE(to->complaint, "'%.*s' is a function: write %.*s(...)", (int)length, name,
                          (int)length, name);
        return append(to, name, length);
    }
    if (place < 0 && function < 0 && !constant)
        return unknown_name(to, name, length, n_functions);
    if (next == '(')
        return REFUSE(to->complaint,
                      "'%.*s' takes no argument: write it without parentheses, or * before them",
                      length > 40 ? 40 : (int)length, name);
    if (place >= 0)
        to->uses[place] = true;
    if (function < 0)
        return append(to, name, length);

    const int floor = to->floor;
    CALL(open_parenthesis(to));
    to->floor = to->depth;
    CALL(expand(to, scope->function_texts[function], (size_t)function));
    if (to->depth != to->floor)
        return REFUSE(to->complaint, "function '%.40s': a closing parenthesis is missing",
                      scope->function_names[function]);
    to->floor = floor;
    to->depth--;
    return append(to, ")", 1);
}

// Length of the number at @p text: digits with a point, and an exponent if it is whole.
static size_t number_length(const char *text)
{
    size_t n = 0, m;

    while (isdigit((unsigned char)text[n]))
        n++;
    if (text[n] == '.')
        n++;
    while (isdigit((unsigned char)text[n]))
        n++;
    if (text[n] != 'e' && text[n] != 'E')
        return n;
    m = n + 1;
    if (text[m] == '+' || text[m] == '-')
        m++;
    if (!isdigit((unsigned char)text[m]))
        return n;
    while (isdigit((unsigned char)text[m]))
        m++;
    return m;
}

static int expand_number(struct expansion *to, const char *text, size_t length)
{
    char number[TEXT_LIMIT + 1];

    memcpy(number, text, length);
    number[length] = '\0';
    if (length == 1 && *number == '.')
        return REFUSE(to->complaint, "a point without digits");
    if (!isfinite(strtod(number, NULL)))
        return REFUSE(to->complaint, "the number %.40s is too large", number);
    return append(to, text, length);
}

// Append the operator or parenthesis at @p text; @p length becomes its number of letters.
static int expand_operator(struct expansion *to, const char *text, size_t *length)
{
    static const char *const pairs[] = {"==", "!=", "<=", ">=", "&&", "||"};

    *length = 1;
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++)
        if (strncmp(text, pairs[i], 2) == 0) {
            *length = 2;
            return append(to, text, 2);
        }
    if (*text == '(')
        return open_parenthesis(to);
    if (*text == ')') {
        if (--to->depth < to->floor)
            return REFUSE(to->complaint, "a closing parenthesis without an opening one");
        return append(to, text, 1);
    }
    if (*text == '=')
        return REFUSE(to->complaint, "'=' cannot assign: compare with ==, <= or >=");
    if (strchr("+-*/^<>?:,", *text))
        return append(to, text, 1);
    if (isprint((unsigned char)*text))
        return REFUSE(to->complaint, "unexpected character '%c'", *text);
    return REFUSE(to->complaint, "unexpected byte 0x%02x: expressions are plain ASCII", (unsigned char)*text);
}

// Append @p text with the first @p n_functions functions of the scope written out.
static int expand(struct expansion *to, const char *text, size_t n_functions)
{
    size_t n;

    if (strlen(text) > TEXT_LIMIT)
        return REFUSE(to->complaint, "%zu letters long; at most %d are read", strlen(text), TEXT_LIMIT);
    if (text[strspn(text, " \t\r\n")] == '\0')
        return REFUSE(to->complaint, "is empty: write a number or an expression");
    for (; *text; text += n) {
        n = 1;
        if (isspace((unsigned char)*text)) {
            CALL(append(to, " ", 1));
        } else if (isdigit((unsigned char)*text) || *text == '.') {
            n = number_length(text);
            CALL(expand_number(to, text, n));
        } else if (isalpha((unsigned char)*text) || *text == '_') {
            while (isalnum((unsigned char)text[n]) || text[n] == '_')
                n++;
            const size_t gap = strspn(text + n, " \t\r\n");
            CALL(expand_name(to, text, n, text[n + gap], n_functions));
            if (text[n + gap] == '(')
                n += gap; // muParser wants it next to the function's name
        } else {
            CALL(expand_operator(to, text, &n));
        }
    }
    return STATUS_OK;
}

// Names that mean something already cannot be given to constants and functions.
static int check_scope(const struct expression_scope *scope, struct complaint complaint)
{
    for (size_t i = 0; i < scope->n_constants + scope->n_functions; i++) {
        const bool constant = i < scope->n_constants;
        const char *name =
            constant ? scope->constant_names[i] : scope->function_names[i - scope->n_constants];
        const size_t length = strlen(name);
        if (find_name(name, length, place_names, N_PLACE) >= 0 || strcmp(name, "pi") == 0 ||
            find_name(name, length, built_in, N_BUILT_IN) >= 0)
            return REFUSE(complaint, "the name '%.40s' has a meaning already: choose another %s name", name,
                          constant ? "parameter" : "function");
    }
    return STATUS_OK;
}

// What muParser says about its last call, as a status.
static int parser_status(muParserHandle_t parser, const struct expansion *from)
{
    if (!mupError(parser))
        return STATUS_OK;
    if (from->length > MESSAGE_LIMIT)
        return REFUSE(from->complaint, "is not a well-formed expression once its functions are written out");
    return REFUSE(from->complaint, "%s", mupGetErrorMsg(parser));
}

static int compile(struct expression *expression, const struct expansion *from)
{
    const struct expression_scope *scope = from->scope;
    muParserHandle_t parser = expression->parser;
    int n_values = 0;

    for (int i = 0; i < N_PLACE; i++) {
        mupDefineVar(parser, place_names[i], &expression->place[i]);
        CALL(parser_status(parser, from));
    }
    mupDefineConst(parser, "pi", 3.14159265358979323846);
    for (size_t i = 0; i < scope->n_constants; i++) {
        mupDefineConst(parser, scope->constant_names[i], scope->constant_values[i]);
        CALL(parser_status(parser, from));
    }
    mupSetExpr(parser, from->text);
    CALL(parser_status(parser, from));
    mupEvalMulti(parser, &n_values);
    CALL(parser_status(parser, from));
    if (n_values != 1)
        return REFUSE(from->complaint, "has %d values separated by commas; one is wanted", n_values);
    return STATUS_OK;
}

// An expression without a parser.
static struct expression *new_expression(const char *text)
{
    struct expression *expression = memory_create(1, sizeof *expression);

    if (!expression)
        return NULL;
    expression->text = memory_text(text);
    expression->place = memory_create(N_PLACE, sizeof *expression->place);
    if (!expression->text || !expression->place) {
        expression_destroy(expression);
        return NULL;
    }
    return expression;
}

static int build(struct expression **expression, const char *text, const struct expansion *from)
{
    struct expression *built = new_expression(text);

    CHECK_MEMORY(built);
    memcpy(built->uses, from->uses, sizeof built->uses);
    built->parser = mupCreate(muBASETYPE_FLOAT);
    const int status = built->parser ? compile(built, from)
                                     : error_report(STATUS_MEMORY, "out of memory: cannot make a parser");
    if (status) {
        expression_destroy(built);
        return status;
    }
    if (expression_is_constant(built)) {
        built->value = mupEval(built->parser);
        mupRelease(built->parser);
        built->parser = NULL;
    }
    *expression = built;
    return STATUS_OK;
}

int expression_create(struct expression **expression, const char *text, const struct expression_scope *scope,
                      char *message, size_t message_size)
{
    static const struct expression_scope empty;
    struct expansion *expansion = memory_create(1, sizeof *expansion);
    int status;

    CHECK_MEMORY(expansion);
    expansion->scope = scope ? scope : &empty;
    expansion->complaint = (struct complaint){message, message_size};
    status = check_scope(expansion->scope, expansion->complaint);
    if (!status)
        status = expand(expansion, text, expansion->scope->n_functions);
    if (!status && expansion->depth)
        status = REFUSE(expansion->complaint, "a closing parenthesis is missing");
    if (!status)
        status = build(expression, text, expansion);
    memory_free(expansion);
    return status;
}

struct expression *expression_constant(double value)
{
    char text[32];

    snprintf(text, sizeof text, "%.17g", value);
    struct expression *expression = new_expression(text);
    if (expression)
        expression->value = value;
    return expression;
}

double expression_value(const struct expression *expression, const double x[3], double t)
{
    if (!expression->parser)
        return expression->value;
    for (int i = 0; i < 3; i++)
        expression->place[i] = x ? x[i] : 0.0;
    expression->place[T] = t;
    const double value = mupEval(expression->parser);
    return mupError(expression->parser) ? (double)NAN : value;
}

bool expression_is_constant(const struct expression *expression)
{
    return !expression->uses[X] && !expression->uses[Y] && !expression->uses[Z] && !expression->uses[T];
}

bool expression_is_steady(const struct expression *expression)
{
    return !expression->uses[T];
}

const char *expression_text(const struct expression *expression)
{
    return expression->text;
}

void expression_destroy(struct expression *expression)
{
    if (!expression)
        return;
    if (expression->parser)
        mupRelease(expression->parser);
    memory_free(expression->text);
    memory_free(expression->place);
    memory_free(expression);
}

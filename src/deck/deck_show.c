// SPDX-License-Identifier: GPL-3.0-or-later
// The deck as understood: the tree is printed with every default filled in and every constant evaluated.
#include "deck/deck.h"

#include "base/error.h"
#include "base/memory.h"
#include "deck/deck_node.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/** The shortest decimal number that reads back as @p value. */
static void number_text(double value, char text[32])
{
    for (int digits = 6; digits <= 17; digits++) {
        snprintf(text, 32, "%.*g", digits, value);
        if (strtod(text, NULL) == value)
            return;
    }
}

static void print_escaped(const char *text, FILE *stream)
{
    for (; *text; text++)
        switch (*text) {
        case '&':
            fputs("&amp;", stream);
            break;
        case '<':
            fputs("&lt;", stream);
            break;
        case '>':
            fputs("&gt;", stream);
            break;
        case '"':
            fputs("&quot;", stream);
            break;
        case '\n':
        case '\r':
        case '\t':
            fputc(' ', stream);
            break;
        default:
            fputc(*text, stream);
        }
}

/** One entry of a value: a number where it is constant, otherwise the expression as written. */
static void print_entry(struct deck *deck, const struct schema_attribute *attribute, const char *text,
                        FILE *stream)
{
    char message[512], number[32];
    double value;
    if (deck_evaluate(deck, text, deck_unit(deck, attribute), &value, message, sizeof message)) {
        const bool whole = attribute->kind == SCHEMA_INTEGER || attribute->kind == SCHEMA_INTEGERS ||
                           attribute->kind == SCHEMA_CELLS;
        number_text(whole ? rint(value) : value, number);
        fputs(number, stream);
    } else {
        print_escaped(text, stream);
    }
}

static void print_list(struct deck *deck, const struct schema_attribute *attribute, const char *text,
                       FILE *stream)
{
    char *copy = memory_text(text), **entries = NULL;
    if (!copy) {
        deck->status = STATUS_MEMORY;
        return;
    }
    size_t n = deck_split(deck, copy, &entries);
    for (size_t i = 0; i < n; i++) {
        fputs(i ? " " : "", stream);
        print_entry(deck, attribute, entries[i], stream);
    }
    memory_free(entries);
    memory_free(copy);
}

static void print_attribute(struct deck *deck, const struct deck_node *node,
                            const struct schema_attribute *attribute, FILE *stream)
{
    const char *text = deck_text(node, attribute->name);
    char number[32];
    if (!text)
        return;
    fprintf(stream, " %s=\"", attribute->name);
    switch (attribute->kind) {
    case SCHEMA_REAL:
    case SCHEMA_INTEGER:
        print_entry(deck, attribute, text, stream);
        break;
    case SCHEMA_EXPRESSION:
        if (node->id == SCHEMA_FUNCTION)
            print_escaped(text, stream);
        else
            print_entry(deck, attribute, text, stream);
        break;
    case SCHEMA_VECTOR:
    case SCHEMA_CELLS:
    case SCHEMA_TURN:
    case SCHEMA_INERTIA:
    case SCHEMA_POINTS:
    case SCHEMA_INTEGERS:
    case SCHEMA_EXPRESSIONS:
        print_list(deck, attribute, text, stream);
        break;
    default:
        if (node->id == SCHEMA_PARAMETER && strcmp(attribute->name, "value") == 0) {
            for (size_t p = 0; p < deck->model->n_parameters; p++)
                if (strcmp(deck->model->parameters[p].name, deck_text(node, "name")) == 0) {
                    number_text(deck->model->parameters[p].value, number);
                    fputs(number, stream);
                }
        } else {
            print_escaped(text, stream);
        }
    }
    fputc('"', stream);
}

static void print_node(struct deck *deck, const struct deck_node *node, int depth, FILE *stream)
{
    for (; node; node = node->next) {
        fprintf(stream, "%*s<%s", 2 * depth, "", node->element->name);
        for (size_t a = 0; a < schema_attribute_count(node->element); a++)
            print_attribute(deck, node, &node->element->attributes[a], stream);
        const bool has_text = node->text && node->text[strspn(node->text, " \t\r\n")];
        if (!node->children && !has_text) {
            fputs("/>\n", stream);
            continue;
        }
        fputs(node->children ? ">\n" : ">", stream);
        print_node(deck, node->children, depth + 1, stream);
        for (const char *c = has_text ? node->text : ""; *c;
             c++) // comments and line ends are part of the numbers
            if (*c == '&' || *c == '<' || *c == '>')
                fputs(*c == '&' ? "&amp;" : *c == '<' ? "&lt;" : "&gt;", stream);
            else if (*c != '\r')
                fputc(*c, stream);
        fprintf(stream, "%*s</%s>\n", node->children ? 2 * depth : 0, "", node->element->name);
    }
}

int deck_show(const char *path, size_t n_overrides, const char *const *overrides, FILE *stream)
{
    struct deck deck;
    int status = deck_load(&deck, path, n_overrides, overrides, n_overrides);
    if (!status) {
        fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n", stream);
        print_node(&deck, deck.root, 0, stream);
        status = deck.status;
        if (!status && (fflush(stream) || ferror(stream)))
            status = error_report(STATUS_IO, "the deck cannot be printed");
    }
    deck_reset(&deck);
    return status;
}

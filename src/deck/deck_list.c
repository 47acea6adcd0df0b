// SPDX-License-Identifier: GPL-3.0-or-later
// Lists: cutting at blanks, lists of choices, numbers of an element's text.
#include "deck/deck_node.h"

#include "base/error.h"
#include "base/memory.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

static bool is_operator(char c)
{
    return c && strchr("+-*/^<>=!&|?:,", c);
}

/** Whether the blanks from @p blank to the character @p next separate two entries. */
static bool is_separator(const char *start, const char *blank, const char *next)
{
    if (blank > start && is_operator(blank[-1]))
        return false;
    if (!is_operator(*next) || *next == '!')
        return *next != '!' || next[1] != '=';
    return (*next == '+' || *next == '-') && !is_blank(next[1]);
}

size_t deck_split(struct deck *deck, char *text, char ***entries)
{
    *entries = deck_memory(deck, strlen(text) / 2 + 1, sizeof **entries);
    if (!*entries)
        return 0;
    size_t n = 0;
    int depth = 0;
    char *c = text;
    while (is_blank(*c))
        c++;
    char *start = c;
    while (*c) {
        depth += (*c == '(') - (*c == ')');
        if (!is_blank(*c)) {
            c++;
            continue;
        }
        char *blank = c;
        while (is_blank(*c))
            c++;
        if (!*c)
            *blank = '\0';
        else if (depth <= 0 && is_separator(start, blank, c)) {
            *blank = '\0';
            (*entries)[n++] = start;
            start = c;
        }
    }
    if (*start)
        (*entries)[n++] = start;
    return n;
}

void deck_choices(struct deck *deck, const struct deck_node *node, const char *name, bool *chosen)
{
    const struct schema_attribute *attribute = node->element->attributes;
    while (strcmp(attribute->name, name) != 0)
        attribute++;
    char *text = deck_word(deck, node, name), *rest = NULL;
    for (char *word = text ? strtok_r(text, " \t\r\n", &rest) : NULL; word;
         word = strtok_r(NULL, " \t\r\n", &rest)) {
        int number = 0;
        for (const char *choice = attribute->choices; *choice; number++) {
            size_t n = strcspn(choice, "|");
            if (strlen(word) == n && strncmp(choice, word, n) == 0)
                chosen[number] = true;
            choice += n + (choice[n] == '|');
        }
    }
    memory_free(text);
}

/** The next number of a text; comments run from # to the end of the line. */
static const char *next_number(const char *c)
{
    for (;;) {
        c += strspn(c, " \t\r\n,;");
        if (*c != '#')
            return c;
        c += strcspn(c, "\n");
    }
}

size_t deck_numbers(struct deck *deck, const struct deck_node *node, const char *text, size_t columns,
                    double **values)
{
    size_t n = 0, capacity = 0;
    *values = NULL;
    for (const char *c = next_number(text); *c; c = next_number(c)) {
        char *end = NULL;
        double value = isdigit((unsigned char)*c) || strchr("+-.", *c) ? strtod(c, &end) : NAN;
        if (!end || end == c || !isfinite(value) || (*end && !strchr(" \t\r\n,;#", *end))) {
            deck_error(deck, node, NULL, "\"%.*s\" (entry %zu) is not a number",
                       (int)strcspn(c, " \t\r\n,;#"), c, n + 1);
            break;
        }
        if (memory_grow((void **)values, &capacity, n + 1, sizeof **values)) {
            deck->status = STATUS_MEMORY;
            break;
        }
        (*values)[n++] = value;
        c = end;
    }
    if (n % columns != 0)
        deck_error(deck, node, NULL, "has %zu numbers; each row needs %zu", n, columns);
    if (n == 0)
        deck_error(deck, node, NULL, "is empty");
    return n / columns;
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "deck/deck_node.h"

#include "base/error.h"
#include "base/log.h"
#include "base/memory.h"
#include "base/text.h"

#include <stdlib.h>
#include <string.h>

/** "<mesh name="beam">" */
static char *node_label(const struct deck_node *node)
{
    const struct schema_attribute *attributes = node->element->attributes;
    const bool named = attributes && strcmp(attributes[0].name, "name") == 0 && node->attributes[0].text;
    return named ? memory_print("<%s name=\"%s\">", node->element->name, node->attributes[0].text)
                 : memory_print("<%s>", node->element->name);
}

static void deck_error_add(struct deck *deck, struct location where, const char *label, const char *format,
                           va_list arguments)
{
    char what[4096];
    vsnprintf(what, sizeof what, format, arguments);
    if (memory_grow((void **)&deck->errors, &deck->error_capacity, deck->n_errors + 1,
                    sizeof *deck->errors)) {
        deck->status = STATUS_MEMORY;
        return;
    }
    struct deck_error *error = &deck->errors[deck->n_errors];
    error->where = where;
    error->text = memory_print("%s:%d:%d: error: %s%s%s", deck->path, where.line, where.column, label,
                               *label ? ": " : "", what);
    deck->n_problems++;
    if (error->text)
        deck->n_errors++;
    else
        deck->status = STATUS_MEMORY;
}

void deck_error_at(struct deck *deck, struct location where, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    deck_error_add(deck, where, "", format, arguments);
    va_end(arguments);
}

void deck_error(struct deck *deck, const struct deck_node *node, const char *attribute, const char *format,
                ...)
{
    struct location where = node->where;
    for (size_t a = 0; attribute && a < schema_attribute_count(node->element); a++)
        if (strcmp(node->element->attributes[a].name, attribute) == 0 && node->attributes[a].where.line)
            where = node->attributes[a].where;
    char *label = node_label(node);
    if (!label) {
        deck->status = STATUS_MEMORY;
        return;
    }
    va_list arguments;
    va_start(arguments, format);
    deck_error_add(deck, where, label, format, arguments);
    va_end(arguments);
    memory_free(label);
}

void deck_need_dim(struct deck *deck, const struct deck_node *node, int dim, const char *instead)
{
    if (deck->model->dim != dim)
        deck_error(deck, node, NULL, "is for %d-D decks, this one is %d-D; use %s", dim, deck->model->dim,
                   instead);
}

void deck_warning(const struct deck *deck, struct location where, const char *format, ...)
{
    char what[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    log_message(LOG_WARNING, "%s:%d:%d: %s", deck->path, where.line, where.column, what);
}

void deck_suggest(const char *word, const char *const *names, size_t n, char *text, size_t size)
{
    const char *closest = text_closest(word, names, n);
    if (closest) {
        snprintf(text, size, "; did you mean \"%s\"?", closest);
        return;
    }
    if (n == 0) {
        snprintf(text, size, "; there is none");
        return;
    }
    size_t used = (size_t)snprintf(text, size, "; known: ");
    for (size_t i = 0; i < n && used < size; i++)
        used += (size_t)snprintf(text + used, size - used, "%s\"%s\"", i ? ", " : "", names[i]);
}

static int error_compare(const void *left, const void *right)
{
    const struct deck_error *a = left, *b = right;
    if (a->where.line != b->where.line)
        return a->where.line < b->where.line ? -1 : 1;
    if (a->where.column != b->where.column)
        return a->where.column < b->where.column ? -1 : 1;
    return strcmp(a->text, b->text);
}

int deck_errors_finish(struct deck *deck)
{
    int status = deck->status ? deck->status : deck->n_errors ? STATUS_DECK : 0;
    if (deck->n_errors)
        qsort(deck->errors, deck->n_errors, sizeof *deck->errors, error_compare);
    for (size_t i = 0; i < deck->n_errors; i++) {
        // at this level a line has no prefix: it keeps the form that compilers use and editors understand
        log_message(LOG_INFO, "%s", deck->errors[i].text);
        memory_free(deck->errors[i].text);
    }
    memory_free(deck->errors);
    deck->errors = NULL;
    deck->n_errors = deck->error_capacity = 0;
    return status;
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "deck/deck_node.h"

#include "base/error.h"
#include "base/memory.h"

#include <ctype.h>
#include <string.h>

void deck_node_destroy(struct deck_node *node)
{
    while (node) {
        struct deck_node *next = node->next;
        deck_node_destroy(node->children);
        for (size_t a = 0; node->attributes && a < schema_attribute_count(node->element); a++)
            memory_free(node->attributes[a].text);
        memory_free(node->attributes);
        memory_free(node->text);
        memory_free(node);
        node = next;
    }
}

static struct deck_node *node_of_kind(struct deck_node *node, enum schema_id id)
{
    while (node && node->id != id)
        node = node->next;
    return node;
}

struct deck_node *deck_child(const struct deck_node *node, enum schema_id id)
{
    return node ? node_of_kind(node->children, id) : NULL;
}

struct deck_node *deck_next(const struct deck_node *node)
{
    return node_of_kind(node->next, node->id);
}

size_t deck_count(const struct deck_node *node, enum schema_id id)
{
    size_t n = 0;
    for (const struct deck_node *child = deck_child(node, id); child; child = deck_next(child))
        n++;
    return n;
}

struct deck_node *deck_add(struct deck *deck, struct deck_node *parent, enum schema_id id)
{
    struct deck_node *node = deck_memory(deck, 1, sizeof *node);
    if (!node)
        return NULL;
    struct deck_node **last = &parent->children;
    while (*last && (*last)->id < id)
        last = &(*last)->next;
    node->id = id;
    node->element = schema_element(id);
    node->where = parent->where;
    node->parent = parent;
    node->attributes = deck_memory(deck, schema_attribute_count(node->element), sizeof *node->attributes);
    node->next = *last;
    *last = node;
    return node->attributes ? node : NULL;
}

static size_t attribute_index(const struct deck_node *node, const char *name)
{
    size_t a = 0;
    while (strcmp(node->element->attributes[a].name, name) != 0)
        a++;
    return a;
}

bool deck_has(const struct deck_node *node, const char *name)
{
    return node->attributes[attribute_index(node, name)].text != NULL;
}

const char *deck_text(const struct deck_node *node, const char *name)
{
    const size_t a = attribute_index(node, name);
    return node->attributes[a].text ? node->attributes[a].text : node->element->attributes[a].fallback;
}

const char *deck_get(struct deck *deck, const struct deck_node *node, const char *name)
{
    const char *text = deck_text(node, name);
    deck->n_problems += !text && node->element->attributes[attribute_index(node, name)].required;
    return text;
}

void deck_fill(struct deck *deck, struct deck_node *node, const char *name, const char *format, ...)
{
    char text[256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    struct deck_attribute *attribute = &node->attributes[attribute_index(node, name)];
    if (!attribute->text && !(attribute->text = memory_text(text)))
        deck->status = STATUS_MEMORY;
}

static bool choice_is_listed(const char *choices, const char *word, size_t length)
{
    for (const char *choice = choices; *choice;) {
        size_t n = strcspn(choice, "|");
        if (n == length && strncmp(choice, word, n) == 0)
            return true;
        choice += n + (choice[n] == '|');
    }
    return false;
}

/** A word that is none of the choices; suggests the closest. */
static void choice_refuse(struct deck *deck, const struct deck_node *node,
                          const struct schema_attribute *attribute, const char *word)
{
    char copy[256], suggestion[512];
    const char *names[16];
    size_t n = 0;
    snprintf(copy, sizeof copy, "%s", attribute->choices);
    for (char *rest = NULL, *name = strtok_r(copy, "|", &rest); name && n < 16;
         name = strtok_r(NULL, "|", &rest))
        names[n++] = name;
    deck_suggest(word, names, n, suggestion, sizeof suggestion);
    deck_error(deck, node, attribute->name, "%s=\"%s\" is unknown%s", attribute->name, word, suggestion);
}

static void check_choices(struct deck *deck, const struct deck_node *node,
                          const struct schema_attribute *attribute, const char *text)
{
    if (attribute->kind == SCHEMA_CHOICE) {
        if (!choice_is_listed(attribute->choices, text, strlen(text)))
            choice_refuse(deck, node, attribute, text);
        return;
    }
    for (text += strspn(text, " \t\r\n"); *text; text += strspn(text, " \t\r\n")) {
        const size_t length = strcspn(text, " \t\r\n");
        if (!choice_is_listed(attribute->choices, text, length)) {
            char word[64];
            snprintf(word, sizeof word, "%.*s", length < 60 ? (int)length : 60, text);
            choice_refuse(deck, node, attribute, word);
        }
        text += length;
    }
}

/** Names become file names and words of lists; those of parameters become words of expressions. */
static void check_name(struct deck *deck, const struct deck_node *node, const char *name)
{
    const bool variable = node->id == SCHEMA_PARAMETER || node->id == SCHEMA_FUNCTION;
    bool good = isalpha((unsigned char)name[0]) || (variable && name[0] == '_');
    size_t length = 0;
    for (; name[length]; length++)
        good = good && (isalnum((unsigned char)name[length]) || name[length] == '_' ||
                        (!variable && strchr("-+.", name[length])));
    if (!good || length > 64)
        deck_error(deck, node, "name",
                   "\"%.80s\" is not a name: up to 64 letters, digits%s, beginning with a letter", name,
                   variable ? " and _" : ", and _ - + .");
}

static void check_attributes(struct deck *deck, const struct deck_node *node)
{
    for (size_t a = 0; a < schema_attribute_count(node->element); a++) {
        const struct schema_attribute *attribute = &node->element->attributes[a];
        const char *text = node->attributes[a].text;
        if (!text && attribute->required) {
            char takes[512];
            schema_describe(attribute, takes, sizeof takes);
            deck_error(deck, node, NULL, "attribute \"%s\" is missing: %s", attribute->name, takes);
        }
        if (!text)
            continue;
        if (attribute->kind == SCHEMA_CHOICE || attribute->kind == SCHEMA_CHOICES)
            check_choices(deck, node, attribute, text);
        else if (attribute->kind == SCHEMA_NAME)
            check_name(deck, node, text);
        else if (!text[strspn(text, " \t\r\n")] && !(attribute->fallback && !*attribute->fallback))
            deck_error(deck, node, attribute->name, "attribute \"%s\" is empty", attribute->name);
    }
}

static void check_children(struct deck *deck, const struct deck_node *node)
{
    const struct schema_element *element = node->element;
    for (const struct schema_child *child = element->children; child && child->id != SCHEMA_ELEMENTS_END;
         child++) {
        size_t n = deck_count(node, child->id);
        const char *name = schema_element(child->id)->name;
        if (n < (size_t)child->least)
            deck_error(deck, node, NULL, "element <%s> is missing: %s", name, schema_element(child->id)->doc);
        if (child->most && n > (size_t)child->most) {
            const struct deck_node *extra = deck_next(deck_child(node, child->id));
            deck_error_at(deck, extra->where, "<%s>: a second <%s> in <%s>; only one is allowed", name, name,
                          element->name);
        }
    }
    int n_shapes = 0;
    for (const struct schema_child *child = element->shapes; child && child->id != SCHEMA_ELEMENTS_END;
         child++)
        n_shapes += (int)deck_count(node, child->id);
    if (n_shapes < element->least_shapes)
        deck_error(deck, node, NULL, "needs at least %d shape%s inside", element->least_shapes,
                   element->least_shapes > 1 ? "s" : "");
    if (element->most_shapes && n_shapes > element->most_shapes)
        deck_error(deck, node, NULL, "takes one shape; put several into a <union>");
}

/** Things of one list have different names, fluids and solids too. */
static void check_names(struct deck *deck, const struct deck_node *parent)
{
    for (const struct deck_node *node = parent->children; node; node = node->next) {
        const struct schema_attribute *attributes = node->element->attributes;
        if (!attributes || attributes[0].kind != SCHEMA_NAME || !node->attributes[0].text)
            continue;
        for (const struct deck_node *other = parent->children; other != node; other = other->next)
            if (other->element->attributes && other->element->attributes[0].kind == SCHEMA_NAME &&
                other->attributes[0].text &&
                strcmp(other->attributes[0].text, node->attributes[0].text) == 0) {
                deck_error(deck, node, "name", "the name is taken by <%s> in line %d", other->element->name,
                           other->where.line);
                break;
            }
    }
}

void deck_check_structure(struct deck *deck, const struct deck_node *node)
{
    check_attributes(deck, node);
    check_children(deck, node);
    check_names(deck, node);
    for (const struct deck_node *child = node->children; child; child = child->next)
        deck_check_structure(deck, child);
}

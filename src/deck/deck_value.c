// SPDX-License-Identifier: GPL-3.0-or-later
// Single values: numbers, units, expressions, words, references.
#include "deck/deck_node.h"

#include "base/error.h"
#include "base/memory.h"

#include <ctype.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char blanks[] = " \t\r\n";

void *deck_memory(struct deck *deck, size_t count, size_t size)
{
    void *memory = memory_create(count, size);
    if (!memory)
        deck->status = STATUS_MEMORY;
    return memory;
}

static const struct schema_attribute *attribute_of(const struct deck_node *node, const char *name)
{
    const struct schema_attribute *attribute = node->element->attributes;
    while (strcmp(attribute->name, name) != 0)
        attribute++;
    return attribute;
}

const char *deck_unit(const struct deck *deck, const struct schema_attribute *attribute)
{
    const int dim = deck->model ? deck->model->dim : 0;
    const char *unit = dim == 2 && attribute->unit_2d ? attribute->unit_2d : attribute->unit;
    return unit ? unit : "1";
}

/** A decimal number at the start of @p text; where it ends, or NULL. */
static const char *number_end(const char *text)
{
    const char *c = text + strspn(text, blanks);
    c += *c == '+' || *c == '-';
    size_t digits = strspn(c, "0123456789");
    c += digits;
    if (*c == '.') {
        size_t decimals = strspn(c + 1, "0123456789");
        digits += decimals;
        c += 1 + decimals;
    }
    if (digits == 0)
        return NULL;
    if (*c == 'e' || *c == 'E') {
        const char *exponent = c + 1 + (c[1] == '+' || c[1] == '-');
        if (isdigit((unsigned char)*exponent))
            c = exponent + strspn(exponent, "0123456789");
    }
    return c;
}

/** How a value is written. */
enum value_form { VALUE_NUMBER, VALUE_WITH_UNIT, VALUE_EXPRESSION };

static enum value_form value_form(const char *text, const char **rest)
{
    const char *end = number_end(text);
    if (!end)
        return VALUE_EXPRESSION;
    *rest = end + strspn(end, blanks);
    if (!**rest)
        return VALUE_NUMBER;
    bool unit = isalpha((unsigned char)**rest) || **rest == '%' || (**rest & 0x80);
    return unit ? VALUE_WITH_UNIT : VALUE_EXPRESSION;
}

/** The unit behind a number, without blanks at its end. */
static bool convert_unit(struct deck *deck, const char *text, const char *rest, const char *unit,
                         double *value, char *message, size_t size)
{
    char *trimmed = memory_text(rest);
    if (!trimmed) {
        deck->status = STATUS_MEMORY;
        return false;
    }
    size_t length = strlen(trimmed);
    while (length > 0 && strchr(blanks, trimmed[length - 1]))
        trimmed[--length] = '\0';
    int status = unit_convert(&deck->units, strtod(text, NULL), trimmed, unit, value, message, size);
    memory_free(trimmed);
    return status == STATUS_OK;
}

bool deck_evaluate(struct deck *deck, const char *text, const char *unit, double *value, char *message,
                   size_t size)
{
    const char *rest = NULL;
    *value = 0.0;
    snprintf(message, size, "out of memory");
    enum value_form form = value_form(text, &rest);
    if (form == VALUE_NUMBER)
        *value = strtod(text, NULL);
    else if (form == VALUE_WITH_UNIT) {
        if (!convert_unit(deck, text, rest, unit, value, message, size))
            return false;
    } else {
        struct expression *expression = NULL;
        int status = expression_create(&expression, text, &deck->scope, message, size);
        if (status) {
            deck->status = status == STATUS_DECK ? deck->status : status;
            return false;
        }
        const bool constant = expression_is_constant(expression);
        if (constant)
            *value = expression_value(expression, NULL, 0.0);
        else
            snprintf(message, size, "a constant is wanted here: x, y, z and t cannot be used");
        expression_destroy(expression);
        if (!constant)
            return false;
    }
    if (!isfinite(*value)) {
        snprintf(message, size, "%s", deck->spoilt ? "" : "the value is not finite");
        *value = 0.0;
        return false;
    }
    return true;
}

void deck_error_value(struct deck *deck, const struct deck_node *node, const char *attribute,
                      const char *text, const char *message)
{
    if (*message)
        deck_error(deck, node, attribute, "%s=\"%.80s\": %s", attribute, text, message);
    else
        deck->n_problems++;
}

/** Whether an entry of a value uses the parameter or function @p name, in what is neither number nor unit. */
static bool entry_mentions(const char *text, const char *name)
{
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_.";
    const char *rest = NULL;
    if (value_form(text, &rest) != VALUE_EXPRESSION)
        return false;
    for (const char *word = text + strcspn(text, letters); *word; word += strcspn(word, letters)) {
        const size_t length = strspn(word, letters);
        if (length == strlen(name) && strncmp(word, name, length) == 0)
            return true;
        word += length;
    }
    return false;
}

static bool list_mentions(struct deck *deck, const char *text, const char *name)
{
    char *copy = memory_text(text), **entries = NULL;
    bool found = false;
    size_t n = copy ? deck_split(deck, copy, &entries) : 0;
    for (size_t i = 0; i < n && !found; i++)
        found = entry_mentions(entries[i], name);
    deck->status = copy ? deck->status : STATUS_MEMORY;
    memory_free(entries);
    memory_free(copy);
    return found;
}

bool deck_mentions(struct deck *deck, const struct deck_node *node, size_t attribute, const char *name)
{
    const char *text = node->attributes[attribute].text;
    if (!text)
        return false;
    switch (node->element->attributes[attribute].kind) {
    case SCHEMA_REAL:
    case SCHEMA_INTEGER:
    case SCHEMA_EXPRESSION:
        return entry_mentions(text, name);
    case SCHEMA_VECTOR:
    case SCHEMA_CELLS:
    case SCHEMA_TURN:
    case SCHEMA_INERTIA:
    case SCHEMA_POINTS:
    case SCHEMA_INTEGERS:
    case SCHEMA_EXPRESSIONS:
        return list_mentions(deck, text, name);
    case SCHEMA_TEXT:
        if (node->id == SCHEMA_PARAMETER) {
            const char *override = deck_override(deck, node, deck->n_overrides);
            return entry_mentions(override ? override : text, name);
        }
        return false;
    default: // names and words
        return false;
    }
}

const struct deck_node *deck_find_mention(struct deck *deck, const struct deck_node *node, size_t n,
                                          const char *const *names,
                                          bool (*counts)(const struct deck_node *node, size_t attribute),
                                          size_t *attribute)
{
    for (; node; node = node->next) {
        for (size_t a = 0; a < schema_attribute_count(node->element); a++)
            for (size_t i = 0; i < n && (!counts || counts(node, a)); i++)
                if (deck_mentions(deck, node, a, names[i])) {
                    *attribute = a;
                    return node;
                }
        const struct deck_node *found = deck_find_mention(deck, node->children, n, names, counts, attribute);
        if (found)
            return found;
    }
    return NULL;
}

static const char *range_words(enum schema_range range, double value)
{
    switch (range) {
    case RANGE_POSITIVE:
        return value > 0.0 ? NULL : "greater than 0";
    case RANGE_NOT_NEGATIVE:
        return value >= 0.0 ? NULL : "0 or greater";
    case RANGE_FRACTION:
        return value >= 0.0 && value <= 1.0 ? NULL : "from 0 to 1";
    case RANGE_POISSON:
        return value > -1.0 && value < 0.5 ? NULL : "greater than -1 and less than 0.5";
    default:
        return NULL;
    }
}

/** Evaluate one value of an attribute, with its range. */
static double evaluate_entry(struct deck *deck, const struct deck_node *node,
                             const struct schema_attribute *attribute, const char *text)
{
    char message[512];
    double value;
    if (!deck_evaluate(deck, text, deck_unit(deck, attribute), &value, message, sizeof message)) {
        deck_error_value(deck, node, attribute->name, text, message);
        return value;
    }
    const char *range = range_words(attribute->range, value);
    if (range)
        deck_error(deck, node, attribute->name, "%s=\"%.80s\" is %.9g; it must be %s", attribute->name, text,
                   value, range);
    return value;
}

/** A whole number up to the rounding of an expression. */
static long whole_entry(struct deck *deck, const struct deck_node *node,
                        const struct schema_attribute *attribute, const char *text)
{
    size_t before = deck->n_problems;
    double value = evaluate_entry(deck, node, attribute, text);
    if (deck->n_problems > before)
        return 0;
    if (fabs(value - rint(value)) > 1e-9 * fmax(1.0, fabs(value)) || fabs(value) > (double)INT_MAX) {
        deck_error(deck, node, attribute->name, "%s=\"%.80s\" is %.9g; a whole number%s is wanted",
                   attribute->name, text, value,
                   fabs(value) > (double)INT_MAX ? " of at most 2147483647" : "");
        return 0;
    }
    return lrint(value);
}

double deck_real(struct deck *deck, const struct deck_node *node, const char *name)
{
    const char *text = deck_get(deck, node, name);
    return text ? evaluate_entry(deck, node, attribute_of(node, name), text) : 0.0;
}

int deck_integer(struct deck *deck, const struct deck_node *node, const char *name)
{
    const char *text = deck_get(deck, node, name);
    return text ? (int)whole_entry(deck, node, attribute_of(node, name), text) : 0;
}

struct expression *deck_compile(struct deck *deck, const struct deck_node *node,
                                const struct schema_attribute *attribute, const char *text)
{
    char message[512];
    const char *rest = NULL;
    struct expression *expression = NULL;
    if (value_form(text, &rest) != VALUE_EXPRESSION) {
        double value = evaluate_entry(deck, node, attribute, text);
        expression = expression_constant(value);
        deck->status = expression ? deck->status : STATUS_MEMORY;
        return expression;
    }
    int status = expression_create(&expression, text, &deck->scope, message, sizeof message);
    if (status == STATUS_DECK)
        deck_error(deck, node, attribute->name, "%s=\"%.80s\": %s", attribute->name, text, message);
    else if (status)
        deck->status = status;
    else if (expression_is_constant(expression) && !isfinite(expression_value(expression, NULL, 0.0)))
        deck_error_value(deck, node, attribute->name, text, deck->spoilt ? "" : "the value is not finite");
    else if (strcmp(attribute->variables, "xyz") == 0 && !expression_is_steady(expression))
        deck_error(deck, node, attribute->name, "%s=\"%.80s\": holds at time 0 only, t cannot be used",
                   attribute->name, text);
    else if (strcmp(attribute->variables, "t") == 0) {
        // a function of t alone gives the same value at different places; three probes find x, y or z in
        // practice
        const double origin[3] = {0.0, 0.0, 0.0}, place[3] = {0.7310585, 1.3132616, 2.1269280};
        const double times[3] = {0.0, 0.3819660, 2.6180340};
        for (int i = 0; i < 3; i++) {
            double a = expression_value(expression, origin, times[i]),
                   b = expression_value(expression, place, times[i]);
            if (a != b && !(isnan(a) && isnan(b))) {
                deck_error(deck, node, attribute->name,
                           "%s=\"%.80s\": depends on time only, x, y and z cannot be used", attribute->name,
                           text);
                break;
            }
        }
    }
    return expression;
}

struct expression *deck_expression(struct deck *deck, const struct deck_node *node, const char *name)
{
    const char *text = deck_get(deck, node, name);
    return text ? deck_compile(deck, node, attribute_of(node, name), text) : NULL;
}

int deck_choice(struct deck *deck, const struct deck_node *node, const char *name)
{
    const char *text = deck_get(deck, node, name);
    int number = 0;
    for (const char *choice = attribute_of(node, name)->choices; text && *choice; number++) {
        size_t n = strcspn(choice, "|");
        if (strlen(text) == n && strncmp(choice, text, n) == 0)
            return number;
        choice += n + (choice[n] == '|');
    }
    deck->n_problems += text != NULL; // noted by the structure check
    return -1;
}

bool deck_yes(struct deck *deck, const struct deck_node *node, const char *name)
{
    return strcmp(deck_get(deck, node, name), "yes") == 0;
}

char *deck_word(struct deck *deck, const struct deck_node *node, const char *name)
{
    const char *text = deck_get(deck, node, name);
    char *copy = text ? memory_text(text) : NULL;
    if (text && !copy)
        deck->status = STATUS_MEMORY;
    return copy;
}

/** Index of the object called @p word, or -1 after noting the error. */
static int find_object(struct deck *deck, const struct deck_node *node, const char *name, const char *what,
                       const char *word, const void *objects, size_t n, size_t size)
{
    const char **names = deck_memory(deck, n, sizeof *names);
    int found = -1;
    size_t n_names = 0;
    for (size_t i = 0; names && i < n; i++) {
        memcpy(&names[n_names], (const char *)objects + i * size,
               sizeof *names); // the first member of each object
        if (!names[n_names])
            continue;
        if (found < 0 && strcmp(names[n_names], word) == 0)
            found = (int)i;
        n_names++;
    }
    if (names && found < 0) {
        char suggestion[1024];
        deck_suggest(word, names, n_names, suggestion, sizeof suggestion);
        deck_error(deck, node, name, "unknown %s \"%s\"%s", what, word, suggestion);
    }
    if (found >= 0 && objects == deck->model->surfaces)
        deck->surface_used[found] = true;
    memory_free(names);
    return found;
}

int deck_reference(struct deck *deck, const struct deck_node *node, const char *name, const char *what,
                   const void *objects, size_t n, size_t size)
{
    const char *word = deck_get(deck, node, name);
    return word ? find_object(deck, node, name, what, word, objects, n, size) : -1;
}

size_t deck_references(struct deck *deck, const struct deck_node *node, const char *name, const char *what,
                       const void *objects, size_t n, size_t size, int **values)
{
    char *text = deck_word(deck, node, name);
    size_t count = 0;
    *values = deck_memory(deck, text ? strlen(text) / 2 + 1 : 0, sizeof **values);
    for (char *rest = NULL, *word = text && *values ? strtok_r(text, blanks, &rest) : NULL; word;
         word = strtok_r(NULL, blanks, &rest)) {
        int index = find_object(deck, node, name, what, word, objects, n, size);
        for (size_t i = 0; index >= 0 && i < count; i++)
            if ((*values)[i] == index) {
                deck_error(deck, node, name, "%s \"%s\" is named twice", what, word);
                index = -1;
            }
        if (index >= 0)
            (*values)[count++] = index;
    }
    memory_free(text);
    return count;
}

/** A list with another number of entries, @p n, than @p wanted in this dimension. */
static void refuse_count(struct deck *deck, const struct deck_node *node, const char *name, size_t wanted,
                         size_t n)
{
    deck_error(deck, node, name, "%s=\"%.80s\": a %d-D deck needs %zu %s separated by blanks, here %s %zu",
               name, deck_text(node, name), deck->model->dim, wanted, wanted > 1 ? "entries" : "entry",
               n == 1 ? "is" : "are", n);
}

/** @p wanted reals. */
static bool read_reals(struct deck *deck, const struct deck_node *node, const char *name, size_t wanted,
                       double *value)
{
    char **entries = NULL, *text = deck_word(deck, node, name);
    if (!text)
        return false;
    size_t n = deck_split(deck, text, &entries);
    if (n != wanted)
        refuse_count(deck, node, name, wanted, n);
    else
        for (size_t d = 0; d < n; d++)
            value[d] = evaluate_entry(deck, node, attribute_of(node, name), entries[d]);
    memory_free(entries);
    memory_free(text);
    return true;
}

bool deck_vector(struct deck *deck, const struct deck_node *node, const char *name, double value[3])
{
    value[0] = value[1] = value[2] = 0.0;
    return read_reals(deck, node, name, (size_t)deck->model->dim, value);
}

bool deck_turn(struct deck *deck, const struct deck_node *node, const char *name, double value[3])
{
    const bool space = deck->model->dim == 3;
    value[0] = value[1] = value[2] = 0.0;
    return read_reals(deck, node, name, space ? 3 : 1, space ? value : &value[2]);
}

bool deck_inertia(struct deck *deck, const struct deck_node *node, const char *name, double value[3][3])
{
    const bool space = deck->model->dim == 3;
    double entries[6] = {0.0}; /* xx yy zz xy yz xz */
    const bool given = read_reals(deck, node, name, space ? 6 : 1, space ? entries : &entries[2]);
    for (int d = 0; d < 3; d++) {
        const int e = (d + 1) % 3;
        value[d][d] = entries[d];
        value[d][e] = value[e][d] = entries[3 + d];
    }
    return given;
}

bool deck_cells(struct deck *deck, const struct deck_node *node, const char *name, int value[3])
{
    value[0] = value[1] = value[2] = 0;
    char **entries = NULL, *text = deck_word(deck, node, name);
    if (!text)
        return false;
    size_t n = deck_split(deck, text, &entries);
    if (n != (size_t)deck->model->dim)
        refuse_count(deck, node, name, (size_t)deck->model->dim, n);
    else
        for (size_t d = 0; d < n; d++)
            value[d] = (int)whole_entry(deck, node, attribute_of(node, name), entries[d]);
    memory_free(entries);
    memory_free(text);
    return true;
}

size_t deck_integers(struct deck *deck, const struct deck_node *node, const char *name, long **values)
{
    char **entries = NULL, *text = deck_word(deck, node, name);
    size_t n = text ? deck_split(deck, text, &entries) : 0;
    *values = deck_memory(deck, n, sizeof **values);
    for (size_t i = 0; *values && i < n; i++)
        (*values)[i] = whole_entry(deck, node, attribute_of(node, name), entries[i]);
    memory_free(entries);
    memory_free(text);
    return n;
}

size_t deck_points(struct deck *deck, const struct deck_node *node, const char *name, double (**points)[3])
{
    char **entries = NULL, *text = deck_word(deck, node, name);
    const size_t dim = (size_t)deck->model->dim;
    size_t n = text ? deck_split(deck, text, &entries) : 0;
    if (n % dim != 0)
        deck_error(deck, node, name, "%s has %zu entries; each point needs %zu", name, n, dim);
    n /= dim;
    *points = deck_memory(deck, n, sizeof **points);
    for (size_t i = 0; *points && i < n; i++)
        for (size_t d = 0; d < dim; d++)
            (*points)[i][d] = evaluate_entry(deck, node, attribute_of(node, name), entries[i * dim + d]);
    memory_free(entries);
    memory_free(text);
    return n;
}

bool deck_expressions(struct deck *deck, const struct deck_node *node, const char *name,
                      struct expression *value[3])
{
    value[0] = value[1] = value[2] = NULL;
    char **entries = NULL, *text = deck_word(deck, node, name);
    if (!text)
        return false;
    size_t n = deck_split(deck, text, &entries);
    if (n != (size_t)deck->model->dim)
        refuse_count(deck, node, name, (size_t)deck->model->dim, n);
    else
        for (size_t d = 0; d < n; d++)
            value[d] = deck_compile(deck, node, attribute_of(node, name), entries[d]);
    memory_free(entries);
    memory_free(text);
    return true;
}

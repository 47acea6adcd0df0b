// SPDX-License-Identifier: GPL-3.0-or-later
// What --set may change when a run is resumed: nothing that the state reached so far depends on.
#include "deck/deck_node.h"

#include "base/error.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

/** The parameters and functions, in the order of the deck. */
static const struct deck_node *first_name(const struct deck *deck)
{
    const struct deck_node *section = deck_child(deck->root, SCHEMA_PARAMETERS);
    return section ? section->children : NULL;
}

/** Values that the parameters had in the run so far; NaN: none. */
static void values_before(struct deck *deck, double *values)
{
    const struct expression_scope scope = deck->scope;
    char message[512];
    deck->scope.n_constants = deck->scope.n_functions = 0;
    deck->scope.constant_values = values;
    for (const struct deck_node *node = first_name(deck); node; node = node->next) {
        if (node->id == SCHEMA_FUNCTION) {
            deck->scope.n_functions++;
            continue;
        }
        const char *override = deck_override(deck, node, deck->n_before);
        double *value = &values[deck->scope.n_constants];
        if (!deck_evaluate(deck, override ? override : deck_text(node, "value"), NULL, value, message,
                           sizeof message))
            *value = NAN;
        deck->scope.n_constants++;
    }
    deck->scope = scope;
}

static bool has_changed(const struct deck *deck, size_t parameter, const double *before)
{
    return memcmp(&before[parameter], &deck->scope.constant_values[parameter], sizeof *before) != 0;
}

static bool mentions_any(struct deck *deck, const struct deck_node *node, size_t n, const char *const *names)
{
    bool found = false;
    for (size_t a = 0; a < schema_attribute_count(node->element); a++)
        for (size_t i = 0; i < n && !found; i++)
            found = deck_mentions(deck, node, a, names[i]);
    return found;
}

/** Into @p names: the parameter at @p node and what changes because of it. Returns their number. */
static size_t names_reached(struct deck *deck, const struct deck_node *node, const double *before,
                            const char **names)
{
    size_t n = 0, parameter = 0;
    for (const struct deck_node *other = first_name(deck); other; other = other->next) {
        const bool changed = other->id == SCHEMA_FUNCTION || has_changed(deck, parameter, before);
        if (other == node || (changed && mentions_any(deck, other, n, names)))
            names[n++] = deck_text(other, "name");
        parameter += other->id == SCHEMA_PARAMETER;
    }
    return n;
}

/** What the state of a run depends on: all but the end and the output; parameters only by their uses. */
static bool is_fixed(const struct deck_node *node, size_t attribute)
{
    for (const struct deck_node *above = node; above; above = above->parent)
        if (above->id == SCHEMA_PARAMETERS || above->id == SCHEMA_OUTPUT)
            return false;
    return node->id != SCHEMA_TIME || strcmp(node->element->attributes[attribute].name, "end") != 0;
}

/** Refuse the override of the parameter at @p node if it reaches what must stay. */
static void check_override(struct deck *deck, const struct deck_node *node, const double *before,
                           const char **names)
{
    size_t attribute;
    const size_t n = names_reached(deck, node, before, names);
    const struct deck_node *reached = deck_find_mention(deck, deck->root, n, names, is_fixed, &attribute);
    if (reached)
        deck_error_at(deck, reached->attributes[attribute].where,
                      "--set %s=%.200s would change <%s %s>: a resumed run can only change its end and its "
                      "output; start a new run for this",
                      deck_text(node, "name"), deck_override(deck, node, deck->n_overrides),
                      reached->element->name, reached->element->attributes[attribute].name);
}

int deck_check_resume(struct deck *deck)
{
    if (deck->n_before == deck->n_overrides || deck->n_problems > 0)
        return deck->status;
    const size_t n = deck->scope.n_constants;
    double *before = deck_memory(deck, n, sizeof *before);
    const char **names = deck_memory(deck, n + deck->scope.n_functions, sizeof *names);
    if (before && names)
        values_before(deck, before);
    size_t parameter = 0;
    for (const struct deck_node *node = first_name(deck); node && !deck->status; node = node->next) {
        if (node->id != SCHEMA_PARAMETER)
            continue;
        const bool is_later =
            deck_override(deck, node, deck->n_overrides) != deck_override(deck, node, deck->n_before);
        if (is_later && has_changed(deck, parameter, before))
            check_override(deck, node, before, names);
        parameter++;
    }
    if (deck->n_errors > 0 && !deck->status)
        deck->status = STATUS_USAGE;
    memory_free(before);
    memory_free((void *)names);
    return deck->status;
}

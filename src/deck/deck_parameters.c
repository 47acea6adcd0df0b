// SPDX-License-Identifier: GPL-3.0-or-later
// Sections <parameters>, <time> and <domain>.
#include "deck/deck_node.h"

#include "base/error.h"
#include "base/memory.h"

#include <math.h>
#include <string.h>

const char *deck_override(const struct deck *deck, const struct deck_node *node, size_t n_overrides)
{
    const char *name = deck_text(node, "name");
    const size_t length = name ? strlen(name) : 0;
    for (size_t i = n_overrides; i-- > 0 && name;)
        if (strncmp(deck->overrides[i], name, length) == 0 && deck->overrides[i][length] == '=')
            return deck->overrides[i] + length + 1;
    return NULL;
}

/** Whether expressions would take @p name for something else (x, pi, sin, ...). */
static bool name_is_reserved(struct deck *deck, const char *name)
{
    const double value = 12345.5;
    const struct expression_scope scope = {
        .n_constants = 1, .constant_names = &name, .constant_values = &value};
    struct expression *expression = NULL;
    char message[512];
    int status = expression_create(&expression, name, &scope, message, sizeof message);
    if (status && status != STATUS_DECK)
        deck->status = status;
    bool reserved =
        status || !expression_is_constant(expression) || expression_value(expression, NULL, 0.0) != value;
    expression_destroy(expression);
    return reserved;
}

static void read_parameter(struct deck *deck, const struct deck_node *node)
{
    struct parameter *parameter = &deck->model->parameters[deck->model->n_parameters++];
    struct expression_scope *scope = &deck->scope;
    parameter->where = node->where;
    parameter->name = deck_word(deck, node, "name");
    const char *override = deck_override(deck, node, deck->n_overrides);
    const char *text = override ? override : deck_text(node, "value");
    char message[512];
    if (!deck_evaluate(deck, text, NULL, &parameter->value, message, sizeof message)) {
        if (override)
            deck->status = error_report(STATUS_USAGE, "--set %s=%s: %s", parameter->name, text, message);
        else
            deck_error_value(deck, node, "value", text, message);
        parameter->value = NAN; // spoils what uses it, without further messages
        deck->spoilt = true;
    }
    if (!(parameter->text = memory_text(text)))
        deck->status = STATUS_MEMORY;
    ((const char **)scope->constant_names)[scope->n_constants] = parameter->name;
    ((double *)scope->constant_values)[scope->n_constants++] = parameter->value;
}

static void read_function(struct deck *deck, const struct deck_node *node)
{
    struct expression_scope *scope = &deck->scope;
    expression_destroy(deck_expression(deck, node, "value"));
    ((const char **)scope->function_names)[scope->n_functions] = deck_text(node, "name");
    ((const char **)scope->function_texts)[scope->n_functions++] = deck_text(node, "value");
}

/** Every override must name a parameter of the deck. */
static void check_overrides(struct deck *deck)
{
    for (size_t i = 0; i < deck->n_overrides; i++) {
        const char *override = deck->overrides[i];
        const size_t length = strcspn(override, "=");
        bool known = false;
        for (size_t p = 0; p < deck->scope.n_constants; p++)
            known = known || (strlen(deck->scope.constant_names[p]) == length &&
                              strncmp(deck->scope.constant_names[p], override, length) == 0);
        if (!override[length]) {
            deck->status = error_report(STATUS_USAGE, "--set %s: write NAME=VALUE", override);
        } else if (!known) {
            char word[80], suggestion[1024];
            snprintf(word, sizeof word, "%.*s", length < 70 ? (int)length : 70, override);
            deck_suggest(word, deck->scope.constant_names, deck->scope.n_constants, suggestion,
                         sizeof suggestion);
            deck->status = error_report(STATUS_USAGE, "--set %s: %s has no parameter \"%s\"%s", override,
                                        deck->path, word, suggestion);
        }
    }
}

/** Parameters with a new value that nothing uses are allowed, but often a slip. */
static void warn_unused_override(struct deck *deck, const struct deck_node *node)
{
    const char *name = deck_text(node, "name");
    size_t attribute;
    if (deck_override(deck, node, deck->n_overrides) &&
        !deck_find_mention(deck, deck->root, 1, &name, NULL, &attribute))
        deck_warning(deck, node->where, "--set changes nothing: <%s name=\"%s\"> is not used",
                     node->element->name, name);
}

int deck_read_parameters(struct deck *deck)
{
    const struct deck_node *section = deck_child(deck->root, SCHEMA_PARAMETERS);
    const size_t n_parameters = deck_count(section, SCHEMA_PARAMETER);
    const size_t n_functions = deck_count(section, SCHEMA_FUNCTION);
    struct expression_scope *scope = &deck->scope;
    CHECK_MEMORY(deck->model->parameters = memory_create(n_parameters, sizeof *deck->model->parameters));
    CHECK_MEMORY(scope->constant_names = memory_create(n_parameters, sizeof *scope->constant_names));
    CHECK_MEMORY(scope->constant_values = memory_create(n_parameters, sizeof *scope->constant_values));
    CHECK_MEMORY(scope->function_names = memory_create(n_functions, sizeof *scope->function_names));
    CHECK_MEMORY(scope->function_texts = memory_create(n_functions, sizeof *scope->function_texts));
    for (const struct deck_node *node = section ? section->children : NULL; node && !deck->status;
         node = node->next) {
        if (!deck_get(deck, node, "name") || !deck_get(deck, node, "value"))
            continue;
        if (name_is_reserved(deck, deck_text(node, "name"))) {
            deck_error(deck, node, "name", "the name \"%s\" is reserved", deck_text(node, "name"));
            continue;
        }
        if (node->id == SCHEMA_PARAMETER) {
            read_parameter(deck, node);
            warn_unused_override(deck, node);
        } else {
            read_function(deck, node);
        }
    }
    if (!deck->status)
        check_overrides(deck);
    return deck->status;
}

int deck_read_time(struct deck *deck)
{
    const struct deck_node *node = deck_child(deck->root, SCHEMA_TIME);
    const struct deck_node *force = deck_child(node, SCHEMA_BODY_FORCE);
    struct model_time *time = &deck->model->time;
    for (int d = 0; d < 3; d++)
        CHECK_MEMORY(time->body_force[d] = expression_constant(0.0));
    if (!node)
        return deck->status;
    size_t before = deck->n_problems;
    time->where = node->where;
    time->end = deck_real(deck, node, "end");
    time->step = deck_real(deck, node, "step");
    if (deck->n_problems == before && time->step > time->end)
        deck_error(deck, node, "step", "the step of %.9g s is longer than the simulated time of %.9g s",
                   time->step, time->end);
    struct expression *value[3] = {NULL, NULL, NULL};
    if (force)
        deck_expressions(deck, force, "value", value);
    for (int d = 0; d < 3; d++)
        if (value[d]) {
            expression_destroy(time->body_force[d]);
            time->body_force[d] = value[d];
        }
    return deck->status;
}

int deck_read_domain(struct deck *deck)
{
    const struct deck_node *node = deck_child(deck->root, SCHEMA_DOMAIN);
    struct model_domain *domain = &deck->model->domain;
    if (!node) {
        if (deck_child(deck->root, SCHEMA_FLUID))
            deck_error(deck, deck->root, NULL,
                       "element <domain> is missing: a fluid needs the box in which particles may be");
        return deck->status;
    }
    size_t before = deck->n_problems;
    domain->where = node->where;
    deck_vector(deck, node, "lower", domain->lower);
    deck_vector(deck, node, "upper", domain->upper);
    deck_choices(deck, node, "periodic", domain->periodic);
    domain->outside = deck_choice(deck, node, "outside") == 1 ? OUTSIDE_REMOVE : OUTSIDE_STOP;
    for (int d = 0; d < 3 && deck->n_problems == before; d++) {
        if (d < deck->model->dim && !(domain->lower[d] < domain->upper[d]))
            deck_error(deck, node, "upper",
                       "upper corner %.9g is not above lower corner %.9g in direction %c", domain->upper[d],
                       domain->lower[d], "xyz"[d]);
        if (d >= deck->model->dim && domain->periodic[d])
            deck_error(deck, node, "periodic", "a %d-D deck has no direction %c", deck->model->dim, "xyz"[d]);
    }
    return deck->status;
}

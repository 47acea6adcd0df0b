// SPDX-License-Identifier: GPL-3.0-or-later
// Section <output>.
#include "deck/deck_node.h"

#include "base/error.h"
#include "base/memory.h"

#include <string.h>

static int read_fields(struct deck *deck, const struct deck_node *node, struct model_output *output)
{
    static const char *const names[] = {"Vorticity", "Acceleration", "Support"};
    bool chosen[3] = {false, false, false};
    output->every = deck_real(deck, node, "every");
    output->float64 = deck_choice(deck, node, "precision") == 1;
    deck_choices(deck, node, "arrays", chosen);
    CHECK_MEMORY(output->arrays = memory_create(3, sizeof *output->arrays));
    for (int i = 0; i < 3; i++)
        if (chosen[i])
            CHECK_MEMORY(output->arrays[output->n_arrays++] = memory_text(names[i]));
    output->n_virtual_particles = deck_integers(deck, node, "virtual-particles", &output->virtual_particles);
    for (size_t i = 0; i < output->n_virtual_particles; i++)
        if (output->virtual_particles[i] < 0)
            deck_error(deck, node, "virtual-particles", "%ld is no particle; ids count from 0",
                       output->virtual_particles[i]);
    return deck->status;
}

/** Which attributes a kind of history needs (the others it does not take). */
struct history_form {
    enum history_kind kind;
    const char *needs; /**< blank-separated */
    const char *may;   /**< what it takes but can do without */
};

static const struct history_form forms[] = {
    {HISTORY_POINT, "mesh at", ""},
    {HISTORY_FORCE, "surfaces", ""},
    {HISTORY_GAUGE, "at", ""},
    {HISTORY_PROFILE, "from to points", ""},
    {HISTORY_VOLUME, "", "lower upper"},
    {HISTORY_RIGID, "mesh", ""},
    {HISTORY_ENERGY, "", ""},
    {HISTORY_COUPLING, "", ""},
};

/** Whether @p name is among the blank-separated @p words. */
static bool among(const char *words, const char *name)
{
    const char *found = strstr(words, name);
    const size_t length = strlen(name);
    return found && (found == words || found[-1] == ' ') && (found[length] == '\0' || found[length] == ' ');
}

static void check_form(struct deck *deck, const struct deck_node *node, const struct history_form *form)
{
    static const char *const names[] = {"mesh", "at", "surfaces", "from", "to", "points", "lower", "upper"};
    const char *type = deck_text(node, "type");
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const bool needed = among(form->needs, names[i]);
        if (needed && !deck_has(node, names[i]))
            deck_error(deck, node, "type", "attribute \"%s\" is missing: type=\"%s\" needs it", names[i],
                       type);
        if (!needed && !among(form->may, names[i]) && deck_has(node, names[i]))
            deck_error(deck, node, names[i], "attribute \"%s\" has no meaning for type=\"%s\"", names[i],
                       type);
    }
    const struct model *model = deck->model;
    const bool of_fluid =
        form->kind == HISTORY_GAUGE || form->kind == HISTORY_PROFILE || form->kind == HISTORY_VOLUME;
    if (of_fluid && !model->fluid.present)
        deck_error(deck, node, "type", "type=\"%s\" needs a <fluid>", type);
    if (form->kind == HISTORY_COUPLING && model->coupling.scheme &&
        strcmp(model->coupling.scheme, "none") == 0)
        deck_error(deck, node, "type", "type=\"coupling\": nothing is coupled in this deck");
}

/** The part of space that a history of the volume counts, if it does not count everything. */
static void read_box(struct deck *deck, const struct deck_node *node, struct model_history *history)
{
    history->has_box = deck_has(node, "lower") || deck_has(node, "upper");
    if (!history->has_box)
        return;
    if (!deck_has(node, "lower") || !deck_has(node, "upper")) {
        deck_error(deck, node, NULL, "a box needs both \"lower\" and \"upper\"");
        return;
    }
    const size_t before = deck->n_problems;
    deck_vector(deck, node, "lower", history->from);
    deck_vector(deck, node, "upper", history->to);
    for (int d = 0; d < deck->model->dim && deck->n_problems == before; d++)
        if (!(history->from[d] < history->to[d]))
            deck_error(deck, node, "upper",
                       "upper corner %.9g is not above lower corner %.9g in direction %c", history->to[d],
                       history->from[d], "xyz"[d]);
}

static void read_history(struct deck *deck, const struct deck_node *node, struct model_history *history)
{
    const struct model *model = deck->model;
    const int type = deck_choice(deck, node, "type");
    const struct history_form *form = &forms[type < 0 ? 0 : type];
    int *surfaces = NULL;
    history->where = node->where;
    history->name = deck_word(deck, node, "name");
    history->kind = form->kind;
    history->every = deck_real(deck, node, "every");
    if (type < 0)
        return;
    check_form(deck, node, form);
    history->mesh =
        deck_reference(deck, node, "mesh", "mesh", model->meshes, model->n_meshes, sizeof *model->meshes);
    if (deck_has(node, "surfaces"))
        history->n_surfaces = (int)deck_references(deck, node, "surfaces", "surface", model->surfaces,
                                                   model->n_surfaces, sizeof *model->surfaces, &surfaces);
    history->surfaces = surfaces;
    if (form->kind == HISTORY_RIGID && history->mesh >= 0 && !model->meshes[history->mesh].rigid.present)
        deck_error(deck, node, "mesh", "type=\"rigid\": mesh \"%s\" is no rigid body; use type=\"point\"",
                   model->meshes[history->mesh].name);
    if (form->kind == HISTORY_VOLUME) {
        read_box(deck, node, history);
    } else {
        deck_vector(deck, node, form->kind == HISTORY_PROFILE ? "from" : "at", history->from);
        deck_vector(deck, node, "to", history->to);
    }
    history->points = deck_integer(deck, node, "points");
    for (int i = 0; i < history->n_surfaces; i++) {
        bool has_wall = false;
        for (size_t w = 0; w < model->n_walls; w++)
            for (size_t k = 0; k < model->walls[w].n_surfaces; k++)
                has_wall = has_wall || model->walls[w].surfaces[k] == surfaces[i];
        if (!has_wall)
            deck_error(deck, node, "surfaces", "surface \"%s\" belongs to no wall: no force acts on it",
                       model->surfaces[surfaces[i]].name);
    }
}

int deck_read_output(struct deck *deck)
{
    struct deck_node *section = deck_child(deck->root, SCHEMA_OUTPUT);
    struct model_output *output = &deck->model->output;
    const struct deck_node *fields = deck_child(section, SCHEMA_FIELDS);
    const struct deck_node *checkpoints = deck_child(section, SCHEMA_CHECKPOINTS);
    if (!section)
        return deck->status; // noted already
    if (!checkpoints)
        CHECK_MEMORY(checkpoints = deck_add(deck, section, SCHEMA_CHECKPOINTS));
    output->checkpoint_every = deck_real(deck, checkpoints, "every");
    if (fields)
        CALL(read_fields(deck, fields, output));
    CHECK_MEMORY(output->histories =
                     memory_create(deck_count(section, SCHEMA_HISTORY), sizeof *output->histories));
    for (const struct deck_node *node = deck_child(section, SCHEMA_HISTORY); node; node = deck_next(node))
        read_history(deck, node, &output->histories[output->n_histories++]);
    return deck->status;
}

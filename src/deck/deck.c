// SPDX-License-Identifier: GPL-3.0-or-later
#include "deck/deck.h"

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/memory.h"
#include "deck/deck_node.h"

#include <string.h>

enum { DECK_LIMIT = 64 << 20 }; // bytes

/** "decks/fsi2.xml" -> "fsi2". */
static char *base_name(const char *path)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    const size_t length = strlen(name);
    const bool xml = length > 4 && strcmp(name + length - 4, ".xml") == 0;
    return memory_print("%.*s", (int)(xml ? length - 4 : length), name);
}

/** A name without "." folders and double slashes. */
static char *plain_name(const char *name)
{
    char *plain = memory_text(name), *end = plain;
    for (const char *c = name; plain && *c;) {
        const size_t length = strcspn(c, "/");
        if (length > 0 && !(length == 1 && *c == '.')) {
            if (end > plain)
                *end++ = '/';
            memcpy(end, c, length);
            end += length;
        }
        c += length + (c[length] == '/');
    }
    if (plain)
        *end = '\0';
    return plain;
}

int deck_note_input(struct deck *deck, const char *name, const char *path, const char *data, size_t size)
{
    struct model *model = deck->model;
    char *plain = plain_name(name), *place = memory_text(path);
    int status = plain && place ? 0 : STATUS_MEMORY;
    bool listed = false;
    for (size_t i = 0; !status && i < model->n_inputs; i++)
        listed = listed || strcmp(model->inputs[i].name, plain) == 0;
    if (!status && !listed)
        status = memory_grow((void **)&model->inputs, &deck->input_capacity, model->n_inputs + 1,
                             sizeof *model->inputs);
    if (!status && !listed) {
        model->inputs[model->n_inputs++] = (struct model_input){plain, place, hash_bytes(data, size), size};
        return 0;
    }
    memory_free(plain);
    memory_free(place);
    return status;
}

/** Objects that nothing refers to are allowed, but often a slip. */
static void warn_unused(struct deck *deck)
{
    const struct model *model = deck->model;
    for (size_t i = 0; i < model->n_fluid_materials; i++)
        if (model->fluid.material != (int)i)
            deck_warning(deck, model->fluid_materials[i].where, "<fluid name=\"%s\"> is not used",
                         model->fluid_materials[i].name);
    for (size_t i = 0; i < model->n_solid_materials; i++) {
        bool used = false;
        for (size_t m = 0; m < model->n_meshes; m++)
            used = used || model->meshes[m].material == (int)i;
        if (!used)
            deck_warning(deck, model->solid_materials[i].where, "<solid name=\"%s\"> is not used",
                         model->solid_materials[i].name);
    }
    for (size_t i = 0; i < model->n_surfaces; i++)
        if (!deck->surface_used[i])
            deck_warning(deck, model->surfaces[i].where, "<surface name=\"%s\"> is not used",
                         model->surfaces[i].name);
}

/** From the tree to the model, section by section in the order in which they refer to each other. */
static int deck_build(struct deck *deck)
{
    static int (*const sections[])(struct deck *) = {
        deck_read_parameters, deck_check_resume,  deck_read_time,     deck_read_domain,
        deck_read_materials,  deck_read_meshes,   deck_read_surfaces, deck_read_fluid,
        deck_read_boundaries, deck_read_coupling, deck_read_output};
    struct model *model = deck->model;
    model->path = memory_text(deck->path);
    model->name = base_name(deck->path);
    if (!model->path || !model->name)
        return STATUS_MEMORY;
    model->dim = deck_choice(deck, deck->root, "dim") + 1;
    if (model->dim == 0)
        return 0; // noted already; nothing can be understood without it
    for (size_t s = 0; s < sizeof sections / sizeof *sections; s++)
        CALL(sections[s](deck));
    if (deck->n_problems == 0 && !model->fluid.present && model->n_meshes == 0)
        deck_error(deck, deck->root, NULL, "there is nothing to compute: neither a <fluid> nor a <mesh>");
    if (deck->n_problems == 0)
        warn_unused(deck);
    return 0;
}

int deck_load(struct deck *deck, const char *path, size_t n_overrides, const char *const *overrides,
              size_t n_before)
{
    *deck =
        (struct deck){.path = path, .n_overrides = n_overrides, .overrides = overrides, .n_before = n_before};
    char *text = NULL;
    size_t size = 0;
    CALL(file_read(path, DECK_LIMIT, &text, &size));
    int status = (deck->model = memory_create(1, sizeof *deck->model)) ? 0 : STATUS_MEMORY;
    if (!status) {
        const char *slash = strrchr(path, '/');
        status = deck_note_input(deck, slash ? slash + 1 : path, path, text, size);
    }
    if (!status)
        status = deck_parse(deck, text, size);
    memory_free(text);
    if (!status && !deck->status && deck->root)
        status = deck_build(deck);
    if (status && !deck->status)
        deck->status = status;
    return deck_errors_finish(deck);
}

void deck_reset(struct deck *deck)
{
    deck_node_destroy(deck->root);
    model_destroy(deck->model);
    unit_system_reset(&deck->units);
    memory_free((void *)deck->scope.constant_names);
    memory_free((void *)deck->scope.constant_values);
    memory_free((void *)deck->scope.function_names);
    memory_free((void *)deck->scope.function_texts);
    memory_free(deck->surface_used);
    *deck = (struct deck){0};
}

int deck_read_resume(struct model **model, const char *path, size_t n_overrides, const char *const *overrides,
                     size_t n_before)
{
    struct deck deck;
    *model = NULL;
    int status = deck_load(&deck, path, n_overrides, overrides, n_before);
    if (!status) {
        *model = deck.model;
        deck.model = NULL;
    }
    deck_reset(&deck);
    return status;
}

int deck_read(struct model **model, const char *path, size_t n_overrides, const char *const *overrides)
{
    return deck_read_resume(model, path, n_overrides, overrides, n_overrides);
}

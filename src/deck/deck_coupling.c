// SPDX-License-Identifier: GPL-3.0-or-later
// Section <coupling>.
#include "deck/deck_node.h"

#include "base/error.h"
#include "base/memory.h"

#include <string.h>

/** Whether some wall has the skin of a mesh. */
static bool fluid_meets_solid(const struct model *model)
{
    for (size_t w = 0; w < model->n_walls; w++)
        for (size_t i = 0; i < model->walls[w].n_surfaces; i++) {
            const struct model_surface *surface = &model->surfaces[model->walls[w].surfaces[i]];
            for (size_t p = 0; p < surface->n_parts; p++)
                if (surface->parts[p].mesh >= 0)
                    return true;
        }
    return false;
}

int deck_read_coupling(struct deck *deck)
{
    struct deck_node *node = deck_child(deck->root, SCHEMA_COUPLING);
    struct model_coupling *coupling = &deck->model->coupling;
    const bool meet = fluid_meets_solid(deck->model);
    if (!node)
        CHECK_MEMORY(node = deck_add(deck, deck->root, SCHEMA_COUPLING));
    if (!deck_has(node, "scheme"))
        deck_fill(deck, node, "scheme", "%s", meet ? "fixed-point" : "none");
    coupling->where = node->where;
    coupling->scheme = deck_word(deck, node, "scheme");
    coupling->tolerance = deck_real(deck, node, "tolerance");
    coupling->iterations = deck_integer(deck, node, "iterations");
    coupling->acceleration = deck_word(deck, node, "acceleration");
    coupling->relaxation = deck_real(deck, node, "relaxation");
    const bool none = coupling->scheme && strcmp(coupling->scheme, "none") == 0;
    if (deck->n_problems > 0) // surfaces or walls may be missing
        return deck->status;
    if (none && meet)
        deck_error(deck, node, "scheme",
                   "a wall has the skin of a mesh, so that fluid and solid need scheme=\"fixed-point\"");
    else if (!none && !meet && coupling->scheme)
        deck_error(deck, node, "scheme",
                   "no wall has the skin of a mesh: nothing is coupled, use scheme=\"none\" or leave "
                   "out <coupling>");
    return deck->status;
}

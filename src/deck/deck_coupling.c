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

static bool is_sub_cycled(const struct model_coupling *coupling)
{
    return coupling->scheme && strcmp(coupling->scheme, "sub-cycled") == 0;
}

/** What belongs to one acceleration only: filled in for it, refused with others. */
static void read_quasi_newton(struct deck *deck, struct deck_node *node, struct model_coupling *coupling)
{
    static const char *const names[] = {"reused-steps", "filter"}, *const defaults[] = {"5", "1e-2"};
    const bool chosen = coupling->acceleration && strcmp(coupling->acceleration, "iqn-ils") == 0;
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        if (!chosen && deck_has(node, names[k]))
            deck_error(deck, node, names[k], "%s goes with acceleration=\"iqn-ils\" only", names[k]);
        else if (chosen && !deck_has(node, names[k]))
            deck_fill(deck, node, names[k], "%s", defaults[k]);
    }
    if (!chosen)
        return;
    coupling->reused_steps = deck_integer(deck, node, "reused-steps");
    coupling->filter = deck_real(deck, node, "filter");
    if (coupling->filter >= 1.0)
        deck_error(deck, node, "filter", "filter=\"%.9g\" would forget everything; it must be less than 1",
                   coupling->filter);
}

/** When the iteration stops. */
static void read_criteria(struct deck *deck, struct deck_node *node, struct model_coupling *coupling)
{
    if (!deck_has(node, "tolerance") && !deck_has(node, "force-tolerance"))
        deck_fill(deck, node, "tolerance", "1e-8");
    if (deck_has(node, "tolerance"))
        coupling->tolerance = deck_real(deck, node, "tolerance");
    if (deck_has(node, "force-tolerance"))
        coupling->force_tolerance = deck_real(deck, node, "force-tolerance");
    coupling->iterations = deck_integer(deck, node, "iterations");
}

static void read_predictor(struct deck *deck, struct deck_node *node, struct model_coupling *coupling)
{
    if (!deck_has(node, "predictor"))
        deck_fill(deck, node, "predictor", "%s",
                  is_sub_cycled(coupling) ? "constant-acceleration" : "linear-acceleration");
    const int predictor = deck_choice(deck, node, "predictor");
    coupling->predictor = predictor < 0 ? PREDICTOR_LINEAR : (enum predictor)predictor;
}

/** What belongs to steps of the solid that span several of the fluid's. */
static void read_sub_cycling(struct deck *deck, struct deck_node *node, struct model_coupling *coupling)
{
    if (!is_sub_cycled(coupling)) {
        if (deck_has(node, "solid-every"))
            deck_error(deck, node, "solid-every", "solid-every goes with scheme=\"sub-cycled\" only");
        return;
    }
    if (!deck_has(node, "solid-every"))
        deck_fill(deck, node, "solid-every", "2");
    coupling->solid_every = deck_integer(deck, node, "solid-every");
    if (deck_has(node, "force-tolerance"))
        deck_error(deck, node, "force-tolerance",
                   "scheme=\"sub-cycled\" has no iteration whose forces could settle; leave out "
                   "force-tolerance");
    if (coupling->acceleration && strcmp(coupling->acceleration, "added-mass") != 0 &&
        strcmp(coupling->acceleration, "none") != 0)
        deck_error(deck, node, "acceleration",
                   "scheme=\"sub-cycled\" has no iteration to accelerate by \"%s\"; use \"added-mass\", "
                   "which makes its only solve stable, or \"none\"",
                   coupling->acceleration);
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
    read_criteria(deck, node, coupling);
    coupling->acceleration = deck_word(deck, node, "acceleration");
    coupling->relaxation = deck_real(deck, node, "relaxation");
    read_quasi_newton(deck, node, coupling);
    read_sub_cycling(deck, node, coupling);
    read_predictor(deck, node, coupling);
    const bool none = coupling->scheme && strcmp(coupling->scheme, "none") == 0;
    if (deck->n_problems > 0) // surfaces or walls may be missing
        return deck->status;
    if (none && meet)
        deck_error(deck, node, "scheme",
                   "a wall has the skin of a mesh, so that fluid and solid need scheme=\"fixed-point\" or "
                   "\"sub-cycled\"");
    else if (!none && !meet && coupling->scheme)
        deck_error(deck, node, "scheme",
                   "no wall has the skin of a mesh: nothing is coupled, use scheme=\"none\" or leave "
                   "out <coupling>");
    return deck->status;
}

// SPDX-License-Identifier: GPL-3.0-or-later
// Section <materials>.
#include "deck/deck_node.h"

#include "base/error.h"
#include "base/memory.h"

int deck_read_materials(struct deck *deck)
{
    const struct deck_node *section = deck_child(deck->root, SCHEMA_MATERIALS);
    struct model *model = deck->model;
    CHECK_MEMORY(model->fluid_materials = memory_create(deck_count(section, SCHEMA_FLUID_MATERIAL),
                                                        sizeof *model->fluid_materials));
    CHECK_MEMORY(model->solid_materials = memory_create(deck_count(section, SCHEMA_SOLID_MATERIAL),
                                                        sizeof *model->solid_materials));
    for (const struct deck_node *node = section ? section->children : NULL; node; node = node->next) {
        if (node->id == SCHEMA_FLUID_MATERIAL) {
            struct fluid_material *fluid = &model->fluid_materials[model->n_fluid_materials++];
            fluid->where = node->where;
            fluid->name = deck_word(deck, node, "name");
            fluid->density = deck_real(deck, node, "density");
            fluid->kinematic_viscosity = deck_real(deck, node, "kinematic-viscosity");
            fluid->sound_speed = deck_real(deck, node, "sound-speed");
            fluid->background_pressure = deck_real(deck, node, "background-pressure");
        } else {
            struct solid_material *solid = &model->solid_materials[model->n_solid_materials++];
            solid->where = node->where;
            solid->name = deck_word(deck, node, "name");
            solid->law = deck_word(deck, node, "law");
            solid->density = deck_real(deck, node, "density");
            solid->young = deck_real(deck, node, "young");
            solid->poisson = deck_real(deck, node, "poisson");
        }
    }
    return deck->status;
}

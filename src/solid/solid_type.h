// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef SOLID_SOLID_TYPE_H
#define SOLID_SOLID_TYPE_H

#include "base/error.h"
#include "solid/attachment.h"
#include "solid/solid.h"

/** For checks: report a mistake of the mesh @c definition in the deck of @c model. */
#define CHECK_MESH(condition, where_, format, ...)                                                           \
    CHECK((condition), STATUS_DECK, "%s:%d:%d: <mesh name=\"%s\">: " format, model->path, (where_).line,     \
          (where_).column, definition->name, __VA_ARGS__)

/** A discretisation of solids; the functions do what their namesakes in solid.h say. */
struct solid_type {
    const char *name;
    /** Whether meshes of this kind are its business. */
    bool (*takes)(const struct model_mesh *mesh);
    int (*check)(const struct model *model, const struct model_mesh *mesh);
    /** Build solid->data from solid->model and ->definition. */
    int (*create)(struct solid *solid);
    void (*destroy)(struct solid *solid);
    int (*start)(struct solid *solid);
    void (*load)(struct solid *solid);
    int (*resume)(struct solid *solid);
    double (*stable_step)(const struct solid *solid);
    int (*begin_step)(struct solid *solid);
    int (*predict)(struct solid *solid);
    int (*solve)(struct solid *solid);
    int (*correct)(struct solid *solid, bool added_mass);
    int (*accept)(struct solid *solid);
    void (*energies)(const struct solid *solid, struct solid_energies *energies);
    /** NULL: it is no rigid body. */
    void (*rigid)(const struct solid *solid, double ahead, struct solid_rigid *rigid);
    int (*locate)(const struct solid *solid, const double X[3], struct solid_place *place);
    void (*evaluate)(const struct solid *solid, const struct solid_place *place, double d[3], double v[3],
                     double a[3]);
    const double (*(*positions)(const struct solid *solid))[3];
    const struct field_group *(*node_fields)(const struct solid *solid);
    const struct field_group *(*cell_fields)(const struct solid *solid);
    const struct field_group *(*state_fields)(const struct solid *solid);
};

/** What all discretisations share. */
struct solid {
    const struct solid_type *type;
    const struct model *model;
    const struct model_mesh *definition;
    int index;         /**< of the mesh in the model */
    double t, dt;      /**< start and length of the step under way, s */
    bool mean_loads;   /**< loads on the surfaces are means over the step */
    double end_weight; /**< of forces at the end of a step; the discretisation sets it if not 1/2 */
    size_t n_attachments;
    struct attachment *attachments;
    bool *claimed; /**< per node: an attachment has it */
    void *data;    /**< of the discretisation */
};

/** Weights of the accelerations at the start of the step and one step before in the one that the deck wants
 * predicted for its end. */
void solid_predictor(const struct solid *solid, double weights[2]);

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef COUPLING_COUPLING_H
#define COUPLING_COUPLING_H

#include "base/timer.h"
#include "coupling/quasi_newton.h"
#include "coupling/relaxation.h"
#include "fluid/fluid.h"
#include "model/model.h"
#include "solid/solid.h"

/** The parts of a simulation (not owned). fluid may be NULL, n_solids 0. */
struct coupling_parts {
    struct fluid *fluid;
    struct solid **solids;
    size_t n_solids;
    struct surface **surfaces;
    size_t n_surfaces;
    struct timer *timer;
};

struct coupling;

/** A coupling scheme: one step of the whole system. */
struct coupling_type {
    const char *name;
    /** Why the model cannot be run with this scheme (reported, STATUS_DECK), or 0. */
    int (*check)(const struct model *model);
    int (*step)(struct coupling *coupling, double t, double dt);
    /** What a scheme keeps between steps: made, undone, its fields; NULL: nothing. */
    int (*create)(struct coupling *coupling);
    void (*destroy)(struct coupling *coupling);
    int (*state)(struct coupling *coupling, struct field_list *list);
    /** Go on from state fields that have been filled; NULL: all parts are at the end of a step. */
    int (*resume)(struct coupling *coupling);
};

struct coupling {
    const struct coupling_type *type;
    const struct model_coupling *definition;
    struct coupling_parts parts;
    bool added_mass;                   /**< use the surfaces' added-mass operators */
    struct relaxation *relaxation;     /**< of the displacements of all coupled surfaces */
    struct quasi_newton *quasi_newton; /**< instead of relaxation; NULL: none */
    size_t n_points, n_dof;            /**< of the coupled surfaces, clamped ones too; n_dof = dim n_points */
    double *difference;                /**< trial minus level 1, n_dof entries */
    double *answer, *iterate;          /**< x, v, a of trial and level 1 for quasi_newton, 3 n_dof each */
    double (*load_before)[3];          /**< loads of the iteration before, n_points rows */
    struct sub_cycle *sub_cycle;       /**< of the scheme "sub-cycled" */
    const char *unit_of_force;
    int iterations;  /**< of the last step: calls of fluid_interface */
    double residual; /**< of the last step: eq. 46, m/s */
    int64_t total_iterations, steps;
    double t_end;           /**< end of the last step, s */
    double solids_behind;   /**< how long before that the state of the solids is, s */
    double wall_impulse[3]; /**< of the fluid on all surfaces since the start, N s (2-D: N s/m) */
    struct field_group state;
    struct field state_fields[4];
};

/** The scheme the model asks for, or the default for its parts; NULL (reported) when there is none of that
 * name. */
const struct coupling_type *coupling_choose(const struct model *model);

int coupling_create(struct coupling **coupling, const struct model *model,
                    const struct coupling_parts *parts);
void coupling_destroy(struct coupling *coupling);

/** Initial evaluation of all parts at @p t. */
int coupling_start(struct coupling *coupling, double t);

/** Add everything that the next step reads of all parts. */
int coupling_state(struct coupling *coupling, struct field_list *list);

/** Go on from state fields that have been filled: everything else is derived, nothing is evaluated. */
int coupling_resume(struct coupling *coupling);

/** For schemes that couple: STATUS_DECK (reported) when there is no fluid or no mesh, else 0. */
int coupling_check_parts(const struct model *model);

/** For schemes, once a step: the loads of its end into the impulses of all surfaces. */
void coupling_add_impulse(struct coupling *coupling, double dt);

/** Advance everything from @p t by @p dt. */
int coupling_step(struct coupling *coupling, double t, double dt);

#endif

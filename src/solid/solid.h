// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef SOLID_SOLID_H
#define SOLID_SOLID_H

#include "base/field.h"
#include "model/model.h"
#include "model/surface.h"

#include <stdbool.h>

struct solid;

struct solid_energies {
    double kinetic, elastic; /**< J (2-D: J/m) */
    double external;         /**< work done on the solid so far by loads and supports */
};

/** A rigid body at one time. */
struct solid_rigid {
    double centre[3];   /**< place of the centre of mass, m */
    double velocity[3]; /**< of that, m/s */
    double rotation[3]; /**< 2-D: angle turned so far about z; 3-D: rotation vector, at most pi long; rad */
    double angular_velocity[3]; /**< rad/s */
    double force[3], moment[3]; /**< of all loads, about the centre, N and N m (2-D: N/m, N) */
};

/** A material point of a solid. */
struct solid_place {
    int element;
    double xi[3];
};

/** Say why mesh @p index of the model cannot be solved (STATUS_DECK, reported with its line), or 0. */
int solid_check(const struct model *model, int index);

/** Create the solid of mesh @p index of the model (checked first). The model must outlive it. Free with
 * solid_destroy. */
int solid_create(struct solid **solid, const struct model *model, int index);
void solid_destroy(struct solid *solid);

/** Map the points of @p surface that belong to this solid's mesh; loads go back by the transpose of this map.
 */
int solid_attach(struct solid *solid, struct surface *surface);

/** Initial state into level 1 (and 0) of the attached surfaces; initial accelerations: 0 when coupled, else
 * from equilibrium. */
int solid_start(struct solid *solid, double t);

/** Take in the loads that the fluid's first evaluation put on the attached surfaces; once, after
 * solid_start. */
void solid_load(struct solid *solid);

/** From now on the loads on attached surfaces are means over the solid's step, not those of its end: they
 * enter the balance whole. */
void solid_take_means(struct solid *solid);

/** Weight of forces at the end of a step in the solid's balance of it (generalised-alpha: 1 - alpha_f). */
double solid_end_weight(const struct solid *solid);

/** Add everything that the next step reads of the solid. */
int solid_state(const struct solid *solid, struct field_list *list);

/** Go on from state fields that have been filled at the end of a step at time @p t: both levels and the trial
 * of the attached surfaces follow. */
int solid_resume(struct solid *solid, double t);

/** Largest stable step (implicit: infinity), s. */
double solid_stable_step(const struct solid *solid);

/** Start a step from @p t to @p t + @p dt. */
int solid_begin_step(struct solid *solid, double t, double dt);

/** Predict the end of the step into level 1 of the attached surfaces: the acceleration as the deck's
 * predictor says (by default a = 2 a_n - a_{n-1}), the rest by Newmark. */
int solid_predict(struct solid *solid);

/** Solve the step with the loads now on the attached surfaces; answer in their trial. */
int solid_solve(struct solid *solid);

/** One modified-Newton correction with the newest loads and, if @p added_mass, the surfaces' operators;
 * answer in trial. */
int solid_correct(struct solid *solid, bool added_mass);

/** State := trial; level 1 of the attached surfaces := trial. */
int solid_accept(struct solid *solid);

void solid_energies(const struct solid *solid, struct solid_energies *energies);

/** A rigid body as it is, or would be after the time @p ahead with the accelerations it has; false: the solid
 * is none. */
bool solid_rigid(const struct solid *solid, double ahead, struct solid_rigid *rigid);

/** Find the material point at reference place @p X (STATUS_DECK, not reported, when it lies outside the
 * mesh). */
int solid_locate(const struct solid *solid, const double X[3], struct solid_place *place);

/** Displacement, velocity, acceleration of a material point. */
void solid_evaluate(const struct solid *solid, const struct solid_place *place, double d[3], double v[3],
                    double a[3]);

/** Geometry and fields for output: node and cell groups, current node places, connectivity as in the mesh. */
const char *solid_name(const struct solid *solid);
const struct mesh *solid_mesh(const struct solid *solid);
const double (*solid_positions(const struct solid *solid))[3];
const struct field_group *solid_node_fields(const struct solid *solid);
const struct field_group *solid_cell_fields(const struct solid *solid);

/** State that is neither of nodes nor of cells (one item): counters, energies, what the kept factor was made
 * for. */
const struct field_group *solid_state_fields(const struct solid *solid);

#endif

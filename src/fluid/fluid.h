// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FLUID_FLUID_H
#define FLUID_FLUID_H

#include "base/timer.h"
#include "model/model.h"
#include "model/particles.h"
#include "sph/boundary.h"
#include "sph/open_boundary.h"

#include <stdbool.h>

struct fluid;

/** What a fluid is given besides the model. */
struct fluid_parts {
    struct surface **surfaces; /**< all surfaces of the model by index; not owned */
    const struct boundary_type *const *wall_types;
    size_t n_wall_types;
    const struct open_boundary_type *const *opening_types; /**< by enum open_kind */
    const char *isa;                                       /**< "auto", "baseline", "v3", "v4" */
    struct timer *timer;
};

/** Create the fluid of the model with its particles, boundaries and open boundaries. Returns a status
 * (STATUS_USAGE: the machine lacks the instruction set asked for). */
int fluid_create(struct fluid **fluid, const struct model *model, const struct fluid_parts *parts);
void fluid_destroy(struct fluid *fluid);

/** The evaluation at @p t = 0 only; never after a resume. */
int fluid_start(struct fluid *fluid, double t);

/** Add everything that the next step reads of the fluid, its walls and openings. */
int fluid_state(struct fluid *fluid, struct field_list *list);

/** Go on from state fields that have been filled at the end of a step at time @p t: makes the lists of the
 * last rebuild again, evaluates nothing. Returns a status (STATUS_IO: the fields contradict each other). */
int fluid_resume(struct fluid *fluid, double t);

/** Largest stable step by paper 000 eq. 25 from the last evaluation, s. */
double fluid_stable_step(const struct fluid *fluid);

/** Kick, drift, sort, lists, and all fluid-fluid work that does not see the surface's new place. */
int fluid_begin_step(struct fluid *fluid, double t, double dt);

/** Repeatable and cheap: surfaces at their level 1 -> density, pressure of near particles -> open boundary
 * values -> wall state -> wall forces -> surface loads. @p moving_only: only boundaries with coupled surfaces
 * are prepared again. */
int fluid_interface(struct fluid *fluid, bool moving_only);

/** Close the other walls, all remaining forces, final kick. Reuses the wall forces of the last
 * fluid_interface. */
int fluid_end_step(struct fluid *fluid);

/** Make the added-mass operators of the coupled surfaces (once a step, after the first fluid_interface). */
int fluid_added_mass(struct fluid *fluid);

/** After the end of a step: points of @p surface were put elsewhere, at most @p distance away from where the
 * fluid met them (more than an iteration's tolerance), m. */
void fluid_surface_moved(struct fluid *fluid, const struct surface *surface, double distance);

/** Read access for output and monitors. */
const struct particles *fluid_particles(const struct fluid *fluid);
const struct fluid_view *fluid_view(const struct fluid *fluid);
size_t fluid_boundary_count(const struct fluid *fluid);
const struct boundary *fluid_boundary(const struct fluid *fluid, size_t index);
/** Particles born and removed at openings so far. */
void fluid_openings_count(const struct fluid *fluid, int64_t *born, int64_t *removed);
/** Fields of the moving block in the order of the output: Density and Mass first (ParaView's SPH filters
 * preselect them), then SmoothingLength, Velocity, Pressure, Id, Kind where there are openings, and the
 * optional Acceleration, Support (sum V W), Vorticity. The group belongs to the fluid; its pointers are fresh
 * until the next step. */
const struct field_group *fluid_output(struct fluid *fluid);

/** Instruction set of the sweeps in use: "baseline", "v3" or "v4". */
const char *fluid_isa(const struct fluid *fluid);
/** How often the lists were rebuilt. */
int64_t fluid_rebuilds(const struct fluid *fluid);
/** Bytes of particle and neighbour data. */
size_t fluid_bytes(const struct fluid *fluid);

/** Shepard-corrected sum (paper 000 eq. 14) over fluid particles at @p x: @p pressure, @p velocity, @p
 * density; returns the denominator sum V W (0: no fluid near, values 0). */
double fluid_probe(const struct fluid *fluid, const double x[3], double *pressure, double velocity[3],
                   double *density);

#endif

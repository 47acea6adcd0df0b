// SPDX-License-Identifier: GPL-3.0-or-later
/* The solid takes steps of several fluid steps: Fuchs et al. (2021), remark 14. The fluid meets the predicted
 * motion of the solid; the solid meets the mean of the fluid's loads, once, at the end of its step: nothing
 * is iterated between them. Loads were made with predicted accelerations, and are linear in these by the
 * fluid's added mass M_a. The solid counts on that: its answer belongs to the load that its own acceleration
 * would have made, weighted as its method weights the end of the step (as if M_a were its own mass), and a
 * load at the start of a step is taken as one with the acceleration it had there. Without the first, light
 * solids are lost at once, without the second after some steps. What the solid gets more or less than the
 * fluid gave in a step is the change of M_a (a_{n+1} - a_n) with the constant predictor: it adds up to a
 * bounded amount, not with time. */
#include "base/error.h"
#include "base/memory.h"
#include "coupling/coupling_list.h"
#include "coupling/interface.h"

#include <math.h>
#include <string.h>

enum { CYCLE_FIELDS = 3 };

/** A step of the solids under way. Rows are those of the points of all coupled surfaces. */
struct sub_cycle {
    int64_t done;                       /**< fluid steps of it; 0: it has not begun */
    double start, length;               /**< s */
    double (*mean)[3];                  /**< loads, N (2-D: N/m) */
    double (*x)[3], (*a)[3];            /**< predicted for its end */
    double (*shift)[3];                 /**< M_a (a - predicted a) at the end of the step before */
    double (*ahead)[3], (*reaction)[3]; /**< workspace */
    struct field_group single, rows;
    struct field single_fields[CYCLE_FIELDS], row_field;
};

static int sub_cycled_check(const struct model *model)
{
    return coupling_check_parts(model);
}

static int sub_cycled_create(struct coupling *coupling)
{
    const size_t n = coupling->n_points;
    struct sub_cycle *c = memory_create(1, sizeof *c);
    CHECK_MEMORY(coupling->sub_cycle = c);
    CHECK_MEMORY(c->mean = memory_create(n, sizeof *c->mean));
    CHECK_MEMORY(c->x = memory_create(n, sizeof *c->x));
    CHECK_MEMORY(c->a = memory_create(n, sizeof *c->a));
    CHECK_MEMORY(c->shift = memory_create(n, sizeof *c->shift));
    CHECK_MEMORY(c->ahead = memory_create(n, sizeof *c->ahead));
    CHECK_MEMORY(c->reaction = memory_create(n, sizeof *c->reaction));
    const struct field fields[CYCLE_FIELDS] = {
        {"StepsDone", "-", FIELD_INT64, 1, FIELD_STATE, {&c->done}, NULL},
        {"Start", "s", FIELD_DOUBLE, 1, FIELD_STATE, {&c->start}, NULL},
        {"Length", "s", FIELD_DOUBLE, 1, FIELD_STATE, {&c->length}, NULL},
    };
    c->single = field_singles("coupling:solid-step", coupling, c->single_fields, fields, CYCLE_FIELDS);
    c->row_field = (struct field){"LoadShift", "N", FIELD_DOUBLE, 3, FIELD_STATE, {c->shift}, NULL};
    c->rows = (struct field_group){.name = "coupling:points",
                                   .owner = coupling,
                                   .count = &coupling->n_points,
                                   .fields = &c->row_field,
                                   .n_fields = coupling->added_mass ? 1 : 0};
    for (size_t k = 0; k < coupling->parts.n_solids; ++k)
        solid_take_means(coupling->parts.solids[k]);
    return 0;
}

static void sub_cycled_destroy(struct coupling *coupling)
{
    struct sub_cycle *c = coupling->sub_cycle;
    if (!c)
        return;
    memory_free(c->mean);
    memory_free(c->x);
    memory_free(c->a);
    memory_free(c->shift);
    memory_free(c->ahead);
    memory_free(c->reaction);
    memory_free(c);
}

static int sub_cycled_state(struct coupling *coupling, struct field_list *list)
{
    CALL(field_list_add(list, &coupling->sub_cycle->single));
    return field_list_add(list, &coupling->sub_cycle->rows);
}

static int solids_predict(struct coupling *coupling)
{
    const struct sub_cycle *c = coupling->sub_cycle;
    for (size_t k = 0; k < coupling->parts.n_solids; ++k) {
        CALL(solid_begin_step(coupling->parts.solids[k], c->start, c->length));
        CALL(solid_predict(coupling->parts.solids[k]));
    }
    return 0;
}

/** Surfaces that no solid moves take the fluid's steps, the others those of the solids. */
static int surfaces_open(struct coupling *coupling, double t, double dt)
{
    struct sub_cycle *c = coupling->sub_cycle;
    const bool begins = c->done == 0;
    if (begins) {
        c->start = t;
        c->length = coupling->definition->solid_every * dt;
    }
    for (size_t s = 0; s < coupling->parts.n_surfaces; ++s) {
        struct surface *surface = coupling->parts.surfaces[s];
        if (!surface->coupled) {
            surface_open(surface, t + dt);
        } else if (begins) {
            surface_open(surface, c->start + c->length);
            surface->level[0].t = c->start; /* the same bits after a resume */
        }
    }
    return begins ? solids_predict(coupling) : 0;
}

/** Keep what was predicted, and the mean loads, which the surfaces get. The load at the start of the step has
 * 1 / (2 solid-every) of the weight. */
static void means_take(struct coupling *coupling)
{
    struct sub_cycle *c = coupling->sub_cycle;
    const double weight = 0.5 / coupling->definition->solid_every;
    size_t row = 0;
    for (size_t s = 0; s < coupling->parts.n_surfaces; ++s) {
        struct surface *surface = coupling->parts.surfaces[s];
        for (size_t p = 0; p < surface->n_points && surface->coupled; ++p, ++row)
            for (int k = 0; k < 3; ++k) {
                c->mean[row][k] = surface->impulse[p][k] / c->length - weight * c->shift[row][k];
                c->x[row][k] = surface->level[1].x[p][k];
                c->a[row][k] = surface->level[1].a[p][k];
                surface->load[p][k] = c->mean[row][k];
            }
    }
}

/** Weight of what happens at the end of the step in the balance of the solid that moves a point. */
static double end_weight(const struct coupling *coupling, int32_t mesh)
{
    return mesh < 0 ? 0.0 : solid_end_weight(coupling->parts.solids[mesh]);
}

/** Loads := what they would have been with the accelerations of level 1 instead of the predicted ones. */
static void loads_shift(struct coupling *coupling)
{
    struct sub_cycle *c = coupling->sub_cycle;
    size_t first = 0;
    for (size_t s = 0; s < coupling->parts.n_surfaces; ++s) {
        struct surface *surface = coupling->parts.surfaces[s];
        if (!surface->coupled)
            continue;
        for (size_t p = 0; p < surface->n_points; ++p)
            for (int k = 0; k < 3; ++k)
                c->ahead[p][k] = surface->level[1].a[p][k] - c->a[first + p][k];
        surface_added_mass_apply(surface, (const double(*)[3])c->ahead, 0.0, c->reaction);
        memcpy(c->shift + first, c->reaction, surface->n_points * sizeof *c->shift);
        for (size_t p = 0; p < surface->n_points; ++p)
            for (int k = 0; k < 3; ++k)
                surface->load[p][k] =
                    c->mean[first + p][k] - end_weight(coupling, surface->mesh[p]) * c->reaction[p][k];
        first += surface->n_points;
    }
}

/** Correct the solids until their answer and the loads that follow from it agree. */
static int solids_correct(struct coupling *coupling)
{
    const struct sub_cycle *c = coupling->sub_cycle;
    const struct model_coupling *definition = coupling->definition;
    for (int correction = 1;; ++correction) {
        for (size_t k = 0; k < coupling->parts.n_solids; ++k)
            CALL(solid_correct(coupling->parts.solids[k], true));
        const double change = interface_difference(coupling, c->length);
        interface_blend(coupling, 1.0);
        loads_shift(coupling);
        if (change < definition->tolerance)
            return 0;
        CHECK(isfinite(change) && correction < definition->iterations, STATUS_NUMERICAL,
              "the solids' step to t = %g s did not converge: change %g m/s in correction %d, tolerance %g "
              "m/s; try a smaller solid-every or more iterations",
              c->start + c->length, change, correction, definition->tolerance);
    }
}

static int solids_solve(struct coupling *coupling)
{
    for (size_t k = 0; k < coupling->parts.n_solids; ++k)
        CALL(solid_solve(coupling->parts.solids[k]));
    interface_blend(coupling, 1.0);
    return 0;
}

/** After the solids have accepted: loads are those of the last evaluation again, and the fluid learns how far
 * its walls jump. */
static void surfaces_close(struct coupling *coupling)
{
    const struct sub_cycle *c = coupling->sub_cycle;
    double square = 0.0;
    size_t row = 0;
    for (size_t s = 0; s < coupling->parts.n_surfaces; ++s) {
        struct surface *surface = coupling->parts.surfaces[s];
        double farthest = 0.0;
        for (size_t p = 0; p < surface->n_points && surface->coupled; ++p, ++row) {
            double jump = 0.0;
            for (int k = 0; k < 3; ++k) {
                jump += pow(surface->level[1].x[p][k] - c->x[row][k], 2.0);
                surface->load[p][k] = surface->load_previous[p][k];
            }
            farthest = fmax(farthest, jump);
            square += jump;
        }
        if (surface->coupled)
            fluid_surface_moved(coupling->parts.fluid, surface, sqrt(farthest));
    }
    coupling->residual = sqrt(square / (double)coupling->n_dof) / c->length;
}

static void surfaces_show(struct coupling *coupling, bool now)
{
    for (size_t s = 0; s < coupling->parts.n_surfaces; ++s)
        if (coupling->parts.surfaces[s]->coupled)
            surface_show(coupling->parts.surfaces[s], now);
}

static int solids_step(struct coupling *coupling)
{
    means_take(coupling);
    CALL(coupling->added_mass ? solids_correct(coupling) : solids_solve(coupling));
    for (size_t k = 0; k < coupling->parts.n_solids; ++k)
        CALL(solid_accept(coupling->parts.solids[k]));
    surfaces_close(coupling);
    return 0;
}

static int sub_cycled_step(struct coupling *coupling, double t, double dt)
{
    struct coupling_parts *parts = &coupling->parts;
    struct sub_cycle *c = coupling->sub_cycle;
    double since = timer_now();
    CALL(surfaces_open(coupling, t, dt));
    timer_lap(parts->timer, TIMER_SOLID, &since);
    const bool last = ++c->done == coupling->definition->solid_every;
    CALL(fluid_begin_step(parts->fluid, t, dt));
    CALL(fluid_interface(parts->fluid, false));
    if (last && coupling->added_mass)
        CALL(fluid_added_mass(parts->fluid));
    CALL(fluid_end_step(parts->fluid));
    coupling_add_impulse(coupling, dt);
    coupling->iterations = 1;
    coupling->residual = 0.0;
    since = timer_now();
    if (last) {
        CALL(solids_step(coupling));
        c->done = 0;
    }
    coupling->solids_behind = last ? 0.0 : t + dt - c->start;
    surfaces_show(coupling, !last);
    timer_lap(parts->timer, TIMER_SOLID, &since);
    return 0;
}

static int sub_cycled_resume(struct coupling *coupling)
{
    const struct coupling_parts *parts = &coupling->parts;
    const struct sub_cycle *c = coupling->sub_cycle;
    const bool inside = c->done > 0;
    const double t = inside ? c->start : coupling->t_end;
    for (size_t s = 0; s < parts->n_surfaces; ++s)
        surface_resume(parts->surfaces[s], parts->surfaces[s]->coupled ? t : coupling->t_end);
    for (size_t k = 0; k < parts->n_solids; ++k)
        CALL(solid_resume(parts->solids[k], t));
    for (size_t s = 0; s < parts->n_surfaces && inside; ++s)
        if (parts->surfaces[s]->coupled)
            surface_reopen(parts->surfaces[s], c->start + c->length);
    if (inside)
        CALL(solids_predict(coupling));
    CALL(fluid_resume(parts->fluid, coupling->t_end));
    for (size_t s = 0; s < parts->n_surfaces && inside; ++s)
        surface_at(parts->surfaces[s], coupling->t_end);
    surfaces_show(coupling, inside);
    return 0;
}

const struct coupling_type coupling_sub_cycled = {
    .name = "sub-cycled",
    .check = sub_cycled_check,
    .create = sub_cycled_create,
    .destroy = sub_cycled_destroy,
    .state = sub_cycled_state,
    .step = sub_cycled_step,
    .resume = sub_cycled_resume,
};

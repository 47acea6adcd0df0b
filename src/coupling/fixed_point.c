// SPDX-License-Identifier: GPL-3.0-or-later
/* Strong Dirichlet-Neumann coupling by fixed-point iteration: Fuchs et al. (2021), section 3.4, algorithm 1.
 * Particle places at the end of the step do not depend on the surface, so one step needs the fluid's pair
 * sums once; the iterations touch only particles near the moving surface, and the solid does one correction
 * each with the newest load. */
#include "base/error.h"
#include "coupling/coupling_list.h"

#include <math.h>
#include <string.h>

static int fixed_point_check(const struct model *model)
{
    CHECK(model->fluid.present && model->n_meshes, STATUS_DECK,
          "%s:%d:%d: error: <coupling>: scheme \"fixed-point\" couples a fluid with meshes, and the deck has "
          "no %s",
          model->path, model->coupling.where.line, model->coupling.where.column,
          model->fluid.present ? "<mesh>" : "<fluid>");
    return 0;
}

/** Trial minus level 1 of all coupled surfaces; returns eq. 46: its norm by the step and the root of the
 * number of entries. */
static double difference_take(struct coupling *coupling, double dt)
{
    double *difference = coupling->difference, square = 0.0;
    for (size_t s = 0; s < coupling->parts.n_surfaces; ++s) {
        const struct surface *surface = coupling->parts.surfaces[s];
        for (size_t p = 0; p < surface->n_points && surface->coupled; ++p)
            for (int d = 0; d < surface->dim; ++d) {
                double r = surface->mesh[p] < 0 ? 0.0 : surface->trial.x[p][d] - surface->level[1].x[p][d];
                *difference++ = r;
                square += r * r;
            }
    }
    return sqrt(square / (double)coupling->n_dof) / dt;
}

static void rows_blend(double (*level)[3], const double (*trial)[3], size_t p, double factor)
{
    for (int d = 0; d < 3; ++d)
        level[p][d] = factor == 1.0 ? trial[p][d] : level[p][d] + factor * (trial[p][d] - level[p][d]);
}

/** Level 1 of the points that solids move towards their trial. */
static void level_update(struct coupling *coupling, double factor)
{
    for (size_t s = 0; s < coupling->parts.n_surfaces; ++s) {
        struct surface *surface = coupling->parts.surfaces[s];
        for (size_t p = 0; p < surface->n_points && surface->coupled; ++p) {
            if (surface->mesh[p] < 0)
                continue;
            rows_blend(surface->level[1].x, (const double(*)[3])surface->trial.x, p, factor);
            rows_blend(surface->level[1].v, (const double(*)[3])surface->trial.v, p, factor);
            rows_blend(surface->level[1].a, (const double(*)[3])surface->trial.a, p, factor);
        }
    }
}

static int iterate(struct coupling *coupling, double t, double dt)
{
    struct coupling_parts *parts = &coupling->parts;
    const int limit = coupling->definition->iterations;
    relaxation_restart(coupling->relaxation);
    for (coupling->iterations = 1;; ++coupling->iterations) {
        CALL(fluid_interface(parts->fluid, coupling->iterations > 1));
        if (coupling->iterations == 1 && coupling->added_mass)
            CALL(fluid_added_mass(parts->fluid));
        double since = timer_now();
        for (size_t k = 0; k < parts->n_solids; ++k)
            CALL(solid_correct(parts->solids[k], coupling->added_mass));
        timer_lap(parts->timer, TIMER_SOLID, &since);
        coupling->residual = difference_take(coupling, dt);
        level_update(coupling, relaxation_factor(coupling->relaxation, coupling->difference));
        timer_lap(parts->timer, TIMER_COUPLING, &since);
        if (coupling->residual < coupling->definition->tolerance)
            return 0;
        CHECK(coupling->iterations < limit && isfinite(coupling->residual), STATUS_NUMERICAL,
              "the coupling did not converge at t = %g s: residual %g m/s after %d iterations, tolerance %g "
              "m/s; try "
              "acceleration=\"added-mass\", a smaller step or more iterations",
              t + dt, coupling->residual, coupling->iterations, coupling->definition->tolerance);
    }
}

static int fixed_point_step(struct coupling *coupling, double t, double dt)
{
    struct coupling_parts *parts = &coupling->parts;
    double since = timer_now();
    for (size_t s = 0; s < parts->n_surfaces; ++s)
        surface_open(parts->surfaces[s], t + dt);
    for (size_t k = 0; k < parts->n_solids; ++k) {
        CALL(solid_begin_step(parts->solids[k], t, dt));
        CALL(solid_predict(parts->solids[k]));
    }
    timer_lap(parts->timer, TIMER_SOLID, &since);
    CALL(fluid_begin_step(parts->fluid, t, dt));
    CALL(iterate(coupling, t, dt));
    CALL(fluid_end_step(parts->fluid));
    since = timer_now();
    for (size_t k = 0; k < parts->n_solids; ++k)
        CALL(solid_accept(parts->solids[k]));
    timer_lap(parts->timer, TIMER_SOLID, &since);
    return 0;
}

const struct coupling_type coupling_fixed_point = {
    .name = "fixed-point",
    .check = fixed_point_check,
    .step = fixed_point_step,
};

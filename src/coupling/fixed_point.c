// SPDX-License-Identifier: GPL-3.0-or-later
/* Strong Dirichlet-Neumann coupling by fixed-point iteration: Fuchs et al. (2021), section 3.4, algorithm 1.
 * Particle places at the end of the step do not depend on the surface, so one step needs the fluid's pair
 * sums once; the iterations touch only particles near the moving surface, and the solid does one correction
 * each with the newest load. */
#include "base/error.h"
#include "coupling/coupling_list.h"
#include "coupling/interface.h"

#include <math.h>
#include <stdio.h>

static int fixed_point_check(const struct model *model)
{
    return coupling_check_parts(model);
}

/** Whether what the deck asks for holds; @p change is that of the loads. */
static bool converged(const struct coupling *coupling, double change)
{
    const struct model_coupling *definition = coupling->definition;
    const bool displacement = definition->tolerance == 0.0 || coupling->residual < definition->tolerance;
    const bool force = definition->force_tolerance == 0.0 ||
                       (coupling->iterations > 1 && change < definition->force_tolerance);
    return displacement && force;
}

static int report_divergence(const struct coupling *coupling, double t, double change)
{
    const struct model_coupling *definition = coupling->definition;
    char displacement[64] = "", force[96] = "";
    if (definition->tolerance > 0.0)
        snprintf(displacement, sizeof displacement, ", tolerance %g m/s", definition->tolerance);
    if (definition->force_tolerance > 0.0)
        snprintf(force, sizeof force, ", change of the force %g, force-tolerance %g %s", change,
                 definition->force_tolerance, coupling->unit_of_force);
    return error_report(
        STATUS_NUMERICAL,
        "the coupling did not converge at t = %g s: residual %g m/s after %d iterations%s%s; try %sa "
        "smaller step or more iterations",
        t, coupling->residual, coupling->iterations, displacement, force,
        coupling->added_mass ? "" : "acceleration=\"added-mass\", ");
}

static int iterate(struct coupling *coupling, double t, double dt)
{
    struct coupling_parts *parts = &coupling->parts;
    const struct model_coupling *definition = coupling->definition;
    double change = 0.0;
    relaxation_restart(coupling->relaxation);
    if (coupling->quasi_newton)
        quasi_newton_restart(coupling->quasi_newton);
    for (coupling->iterations = 1;; ++coupling->iterations) {
        CALL(fluid_interface(parts->fluid, coupling->iterations > 1));
        if (coupling->iterations == 1 && coupling->added_mass)
            CALL(fluid_added_mass(parts->fluid));
        double since = timer_now();
        for (size_t k = 0; k < parts->n_solids; ++k)
            CALL(solid_correct(parts->solids[k], coupling->added_mass));
        timer_lap(parts->timer, TIMER_SOLID, &since);
        coupling->residual = interface_difference(coupling, dt);
        if (definition->force_tolerance > 0.0)
            change = interface_load_change(coupling);
        const bool finite = isfinite(coupling->residual) && isfinite(change);
        if (finite && coupling->quasi_newton)
            interface_extrapolate(coupling);
        else if (finite)
            interface_blend(coupling, relaxation_factor(coupling->relaxation, coupling->difference));
        timer_lap(parts->timer, TIMER_COUPLING, &since);
        if (finite && converged(coupling, change))
            return 0;
        if (!finite || coupling->iterations >= definition->iterations)
            return report_divergence(coupling, t + dt, change);
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
    coupling_add_impulse(coupling, dt);
    return 0;
}

const struct coupling_type coupling_fixed_point = {
    .name = "fixed-point",
    .check = fixed_point_check,
    .step = fixed_point_step,
};

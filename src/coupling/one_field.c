// SPDX-License-Identifier: GPL-3.0-or-later
/* Fluid alone, solids alone, or both without a common surface that moves: each field takes its step once. */
#include "base/error.h"
#include "coupling/coupling_list.h"

static int one_field_check(const struct model *model)
{
    (void)model;
    return 0;
}

static int one_field_step(struct coupling *coupling, double t, double dt)
{
    struct coupling_parts *parts = &coupling->parts;
    for (size_t s = 0; s < parts->n_surfaces; ++s)
        surface_open(parts->surfaces[s], t + dt);
    if (parts->fluid) {
        CALL(fluid_begin_step(parts->fluid, t, dt));
        CALL(fluid_interface(parts->fluid, false));
        CALL(fluid_end_step(parts->fluid));
    }
    double since = timer_now();
    for (size_t k = 0; k < parts->n_solids; ++k) {
        CALL(solid_begin_step(parts->solids[k], t, dt));
        CALL(solid_solve(parts->solids[k]));
        CALL(solid_accept(parts->solids[k]));
    }
    timer_lap(parts->timer, TIMER_SOLID, &since);
    coupling_add_impulse(coupling, dt);
    coupling->iterations = 1;
    return 0;
}

const struct coupling_type coupling_one_field = {
    .name = "none",
    .check = one_field_check,
    .step = one_field_step,
};

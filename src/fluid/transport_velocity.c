// SPDX-License-Identifier: GPL-3.0-or-later
/* Transport-velocity formulation of weakly compressible SPH: Fuchs et al. (2021), section 3.1, after Adami,
 * Hu and Adams (2013). Density summation (15), momentum (16), linear equation of state (20), kick-drift-kick
 * (22)-(24); the background pressure moves particles but is no force. The pair sums over fluid particles are
 * in transport_velocity_sweeps.c; wall terms (31), (40) are here, in double.
 *
 * Where the particles are gives the density, so that mass moves with the transport velocity, and so does the
 * momentum that particles take along. The convective stress corrects the latter to the momentum velocity. It
 * depends on the frame of reference: of a disordered distribution it makes accelerations that grow with the
 * speed of the fluid. Without it the shifts act as a diffusion that grows with the background pressure
 * (doc/transport-velocity.md shows both). */
#include "fluid/transport_velocity.h"

#include "base/error.h"
#include "base/memory.h"
#include "fluid/fluid_internal.h"

#include <math.h>
#include <string.h>

struct transport_velocity {
    const struct transport_velocity_sweeps *sweeps;
    double *a[3];            /**< du/dt of the last evaluation */
    double *a_background[3]; /**< acceleration by the background pressure, same evaluation */
    double *w[3];            /**< transport minus momentum velocity of this step */
    double *kernel_sum;      /**< sum W of this evaluation over the fluid */
    void *places, *records;  /**< workspace of the sweeps */
    size_t places_capacity, records_capacity;
};

static const struct transport_velocity_sweeps *const sweeps_mixed[ISAS] =
    ISA_TABLE(transport_velocity_sweeps, mixed);
static const struct transport_velocity_sweeps *const sweeps_double[ISAS] =
    ISA_TABLE(transport_velocity_sweeps, double);

static int transport_velocity_create(struct fluid *fluid)
{
    struct transport_velocity *tv = memory_create(1, sizeof *tv);
    CHECK_MEMORY(tv);
    fluid->data = tv;
    const bool full = fluid->model->fluid.arithmetic == ARITHMETIC_DOUBLE;
    tv->sweeps = (full ? sweeps_double : sweeps_mixed)[fluid->isa];
    struct particles *block = fluid->block;
    CALL(particles_add_field(block, "Acceleration", "m/s^2", 3, FIELD_STATE | FIELD_SORTED | FIELD_OUTPUT,
                             tv->a));
    CALL(particles_add_field(block, "BackgroundAcceleration", "m/s^2", 3, FIELD_STATE | FIELD_SORTED,
                             tv->a_background));
    CALL(particles_add_field(block, "TransportShift", "m/s", 3, FIELD_SORTED, tv->w));
    return particles_add_field(block, "KernelSum", "m^-dim", 1, 0, &tv->kernel_sum);
}

static void transport_velocity_destroy(struct fluid *fluid)
{
    struct transport_velocity *tv = fluid->data;
    if (tv) {
        memory_free(tv->places);
        memory_free(tv->records);
    }
    memory_free(tv);
}

/** Numbers of a record of the force sweep. */
static size_t record_numbers(const struct fluid *fluid)
{
    const size_t dim = (size_t)fluid->model->dim;
    return dim + 3 + (fluid->model->fluid.convective_stress ? dim : 0);
}

static size_t transport_velocity_bytes(const struct fluid *fluid)
{
    const struct transport_velocity *tv = fluid->data;
    const size_t size = fluid->model->fluid.arithmetic == ARITHMETIC_DOUBLE ? sizeof(double) : sizeof(float);
    return (tv->places_capacity * (size_t)fluid->model->dim + tv->records_capacity * record_numbers(fluid)) *
           size;
}

static void transport_velocity_start(struct fluid *fluid)
{
    struct transport_velocity *tv = fluid->data;
    for (int k = 0; k < 3; ++k)
        memset(tv->w[k], 0, fluid->block->n * sizeof(double));
}

/** Whether the momentum equation moves particle @p i: fluid, and outflow zones that ask for it. */
static inline bool momentum_moves(const struct fluid *fluid, size_t i)
{
    uint8_t kind = fluid->block->kind[i];
    return kind == PARTICLE_FLUID ||
           (kind == PARTICLE_OUTFLOW &&
            fluid->openings[fluid->block->opening[i]].definition->velocity_rule == OPEN_MOMENTUM);
}

/** A step is lost when a particle would cross half a spacing in it (this also catches NaN). */
static int runaway_report(const struct fluid *fluid, double dt, double limit2)
{
    const struct transport_velocity *tv = fluid->data;
    const struct particles *block = fluid->block;
    for (size_t i = 0; i < block->n; ++i) {
        double v2 = 0.0;
        for (int k = 0; k < 3; ++k)
            v2 += pow(block->u[k][i] + tv->w[k][i], 2.0);
        if (!(v2 * dt * dt <= limit2))
            return error_report(
                STATUS_NUMERICAL,
                "the fluid diverged at t = %g s: particle %lld at (%g, %g, %g) has velocity (%g, %g, %g) "
                "m/s; is the time step or the sound speed right?",
                fluid->view.t, (long long)block->id[i], block->x[0][i], block->x[1][i], block->x[2][i],
                block->u[0][i], block->u[1][i], block->u[2][i]);
    }
    return error_report(STATUS_NUMERICAL, "the fluid diverged at t = %g s", fluid->view.t);
}

static int transport_velocity_drift(struct fluid *fluid, double dt, double *moved)
{
    struct transport_velocity *tv = fluid->data;
    struct particles *block = fluid->block;
    const int dim = fluid->model->dim;
    double fastest = 0.0;
    long lost = 0;
    const double limit = 0.5 * fluid->view.spacing, limit2 = limit * limit;
#pragma omp parallel for schedule(static) reduction(max : fastest) reduction(+ : lost)
    for (size_t i = 0; i < block->n; ++i) {
        const bool kicked = momentum_moves(fluid, i), shifted = block->kind[i] == PARTICLE_FLUID;
        double v2 = 0.0;
        for (int k = 0; k < dim; ++k) {
            if (kicked)
                block->u[k][i] += 0.5 * dt * tv->a[k][i];
            tv->w[k][i] = shifted ? 0.5 * dt * tv->a_background[k][i] : 0.0;
            double v = block->u[k][i] + tv->w[k][i];
            block->x[k][i] += dt * v;
            v2 += v * v;
        }
        lost += !(v2 * dt * dt <= limit2);
        fastest = fmax(fastest, v2);
    }
    *moved = sqrt(fastest) * dt;
    return lost ? runaway_report(fluid, dt, limit2) : 0;
}

static struct transport_velocity_arrays sweep_arrays(const struct fluid *fluid)
{
    const struct transport_velocity *tv = fluid->data;
    const struct particles *block = fluid->block;
    struct transport_velocity_arrays arrays = {
        .dim = fluid->model->dim,
        .n = block->n,
        .rho = block->rho,
        .p = block->p,
        .m = block->m,
        .places = tv->places,
        .records = tv->records,
        .h = fluid->view.kernel.h,
        .constant = fluid->view.kernel.constant,
        .viscosity = fluid->view.viscosity,
        .background_pressure = fluid->material->background_pressure,
        .convective_stress = fluid->model->fluid.convective_stress,
        .kernel_sum = tv->kernel_sum,
    };
    for (int k = 0; k < 3; ++k) {
        arrays.x[k] = block->x[k];
        arrays.u[k] = block->u[k];
        arrays.w[k] = tv->w[k];
        arrays.a[k] = tv->a[k];
        arrays.a_background[k] = tv->a_background[k];
    }
    return arrays;
}

static int transport_velocity_density(struct fluid *fluid)
{
    struct transport_velocity *tv = fluid->data;
    const size_t dim = (size_t)fluid->model->dim, slots = fluid->list.n_slots;
    const size_t size = fluid->model->fluid.arithmetic == ARITHMETIC_DOUBLE ? sizeof(double) : sizeof(float);
    CALL(memory_grow(&tv->places, &tv->places_capacity, slots, dim * size));
    CALL(memory_grow(&tv->records, &tv->records_capacity, slots, record_numbers(fluid) * size));
    const struct transport_velocity_arrays arrays = sweep_arrays(fluid);
    tv->sweeps->density(&fluid->list, &arrays);
    return 0;
}

/** Density (31) and pressure (20) of fluid particle @p i from its kernel sum. */
static inline void state_set(struct fluid *fluid, size_t i, double kernel_sum)
{
    struct particles *block = fluid->block;
    if (block->kind[i] != PARTICLE_FLUID)
        return;
    double c = fluid->view.sound_speed;
    block->rho[i] = block->m[i] * kernel_sum;
    block->p[i] = c * c * (block->rho[i] - fluid->view.density);
}

/** Add the wall part of the kernel sums of boundary @p b to @p sums. */
static void wall_sums_add(const struct boundary *b, double *sums)
{
#pragma omp parallel for schedule(static)
    for (size_t k = 0; k < b->n_near; ++k) /* each particle is named once */
        sums[b->near[k]] += b->kernel_sum[k];
}

/** Density and pressure of the particles near walls, or only of those near walls that solids move. */
static void walls_pressure(struct fluid *fluid, bool coupled_only)
{
    const struct transport_velocity *tv = fluid->data;
    double *sums = fluid->block->scratch; /* of particles that are not asked for: anything */
    for (size_t b = 0; b < fluid->n_boundaries; ++b) {
        const struct boundary *boundary = fluid->boundaries[b];
        for (size_t k = 0; k < boundary->n_near && (boundary->coupled || !coupled_only); ++k)
            sums[boundary->near[k]] = tv->kernel_sum[boundary->near[k]];
    }
    for (int coupled = 0; coupled < 2; ++coupled)
        for (size_t b = 0; b < fluid->n_boundaries; ++b)
            if (fluid->boundaries[b]->coupled == coupled)
                wall_sums_add(fluid->boundaries[b], sums);
    for (size_t b = 0; b < fluid->n_boundaries; ++b) {
        const struct boundary *boundary = fluid->boundaries[b];
        for (size_t k = 0; k < boundary->n_near && (boundary->coupled || !coupled_only); ++k)
            state_set(fluid, boundary->near[k], sums[boundary->near[k]]);
    }
}

static void transport_velocity_pressure(struct fluid *fluid, bool coupled_only)
{
    const struct transport_velocity *tv = fluid->data;
    const size_t n = fluid->block->n;
    if (!coupled_only) {
#pragma omp parallel for schedule(static)
        for (size_t i = 0; i < n; ++i)
            state_set(fluid, i, tv->kernel_sum[i]);
    }
    walls_pressure(fluid, coupled_only);
}

static void transport_velocity_wall_pair(const struct fluid *fluid, size_t i,
                                         const struct wall_neighbours *neighbours, double a[3],
                                         double a_background[3], double *const force[3])
{
    const struct transport_velocity *tv = fluid->data;
    const struct particles *block = fluid->block;
    const double m = block->m[i], rho = block->rho[i], p = block->p[i], volume = m / rho;
    const double viscosity = fluid->view.viscosity, background = fluid->material->background_pressure;
    double u[3], w[3];
    for (int d = 0; d < 3; ++d) {
        u[d] = block->u[d][i];
        w[d] = fluid->model->fluid.convective_stress ? tv->w[d][i] : 0.0;
        a[d] = a_background[d] = 0.0;
    }
    for (size_t k = 0; k < neighbours->n; ++k) {
        const double inverse = 1.0 / neighbours->r[k], rho_k = neighbours->rho[k];
        const double f =
            (volume * volume + neighbours->volume[k] * neighbours->volume[k]) * neighbours->dw[k];
        const double fg = f * neighbours->share_pressure[k], fv = f * neighbours->share_viscous[k];
        const double pressure = (rho_k * p + rho * neighbours->p[k]) / (rho + rho_k);
        double e[3], we = 0.0;
        for (int d = 0; d < 3; ++d) {
            e[d] = neighbours->dx[d][k] * inverse;
            we += w[d] * e[d];
        }
        for (int d = 0; d < 3; ++d) {
            force[d][k] = fg * (0.5 * rho * u[d] * we - pressure * e[d]) +
                          fv * viscosity * (u[d] - neighbours->u_viscous[d][k]) * inverse;
            a[d] += force[d][k];
            a_background[d] -= background * fg * e[d];
        }
    }
    for (int d = 0; d < 3; ++d) {
        a[d] /= m;
        a_background[d] /= m;
    }
}

static int transport_velocity_finish(struct fluid *fluid, double dt)
{
    struct transport_velocity *tv = fluid->data;
    struct particles *block = fluid->block;
    const int dim = fluid->model->dim;
    const double damping = fluid->model->fluid.damping;
    const struct transport_velocity_arrays arrays = sweep_arrays(fluid);
    tv->sweeps->force(&fluid->list, &arrays);
    for (size_t b = 0; b < fluid->n_boundaries; ++b) {
        const struct boundary *boundary = fluid->boundaries[b];
        const struct fluid_wall_forces *forces = &fluid->wall_forces[b];
#pragma omp parallel for schedule(static)
        for (size_t k = 0; k < boundary->n_near; ++k)
            for (int d = 0; d < dim; ++d) {
                tv->a[d][boundary->near[k]] += forces->a[d][k];
                tv->a_background[d][boundary->near[k]] += forces->a_background[d][k];
            }
    }
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < block->n; ++i) {
        const bool kicked = momentum_moves(fluid, i);
        for (int d = 0; d < dim; ++d) {
            tv->a[d][i] += fluid->view.body_force[d] - damping * block->u[d][i];
            if (kicked)
                block->u[d][i] += 0.5 * dt * tv->a[d][i];
        }
    }
    return 0;
}

const struct fluid_type fluid_transport_velocity = {
    .name = "transport-velocity",
    .create = transport_velocity_create,
    .destroy = transport_velocity_destroy,
    .drift = transport_velocity_drift,
    .start = transport_velocity_start,
    .density = transport_velocity_density,
    .pressure = transport_velocity_pressure,
    .bytes = transport_velocity_bytes,
    .wall_pair = transport_velocity_wall_pair,
    .finish = transport_velocity_finish,
};

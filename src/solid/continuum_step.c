// SPDX-License-Identifier: GPL-3.0-or-later
/* One step of continuum finite elements: generalised-alpha in time, Newton's method, or one modified-Newton
 * correction per coupling iteration. */
#include "solid/continuum.h"

#include "base/error.h"

#include <math.h>
#include <string.h>

enum {
    NEWTON_LIMIT = 25,   /**< iterations of solid_solve */
    FACTOR_STEPS = 20,   /**< steps a factor of the deformed configuration serves */
    SLOW_CORRECTIONS = 8 /**< corrections in one step after which the factor is renewed */
};

/** Tolerance of the correction with added mass: more does not save coupling iterations. */
static const double gmres_tolerance = 1e-2;

static size_t vector_size(const struct continuum *continuum)
{
    return continuum->mesh->n_nodes * sizeof(double[3]);
}

/** A nodal vector as 3 n_nodes numbers. */
static double *flat(double (*vector)[3])
{
    return (double *)vector;
}

static double value_of(const struct expression *expression, const double *x, double t)
{
    return expression ? expression_value(expression, x, t) : 0;
}

/** f := nodal loads (shared equally by the nodes of a set) and body forces, the mesh's own and the deck's on
 * everything, at time @p t. */
static void given_loads(const struct continuum *continuum, double t, double (*f)[3])
{
    const struct model_mesh *definition = continuum->definition;
    memset(f, 0, vector_size(continuum));
    for (int i = 0; i < continuum->dim; i++) {
        const double value = value_of(continuum->solid->model->time.body_force[i], NULL, t);
        for (size_t a = 0; a < continuum->mesh->n_nodes; a++)
            f[a][i] += continuum->nodal_mass[a] * value;
    }
    for (size_t l = 0; l < definition->n_loads; l++) {
        const struct model_load *load = &definition->loads[l];
        const struct node_set *set = load->set < 0 ? NULL : &continuum->mesh->sets[load->set];
        for (int i = 0; i < continuum->dim; i++) {
            const double value = value_of(load->force[i], NULL, t);
            for (size_t a = 0; !set && a < continuum->mesh->n_nodes; a++)
                f[a][i] += continuum->nodal_mass[a] * value;
            for (size_t k = 0; set && k < set->n; k++)
                f[set->nodes[k]][i] += value / (double)set->n;
        }
    }
}

/** f_interface := loads now on the attached surfaces; external := given + interface. */
static void external_forces(struct continuum *continuum, const double (*given)[3], double (*external)[3])
{
    const struct solid *solid = continuum->solid;
    memset(continuum->f_interface, 0, vector_size(continuum));
    for (size_t k = 0; k < solid->n_attachments; k++)
        attachment_add_load(&solid->attachments[k], continuum->f_interface);
    for (size_t a = 0; a < continuum->mesh->n_nodes; a++)
        for (int i = 0; i < continuum->dim; i++)
            external[a][i] = given[a][i] + continuum->f_interface[a][i];
}

/** External forces of the step from the loads now on the attached surfaces: of its end, or, where these are
 * means over the step, with the same share of theirs at both ends. */
static void step_forces(struct continuum *continuum)
{
    const struct solid *solid = continuum->solid;
    if (solid->mean_loads) {
        given_loads(continuum, solid->t, continuum->work);
        external_forces(continuum, (const double(*)[3])continuum->work, continuum->state.f_external);
    }
    external_forces(continuum, (const double(*)[3])continuum->f_given, continuum->trial.f_external);
}

/** Set what supports prescribe at time @p t. */
static void prescribe(const struct continuum *continuum, double t, struct continuum_nodes *nodes)
{
    for (size_t a = 0; a < continuum->mesh->n_nodes; a++) {
        const int32_t support = continuum->moving_support[a];
        double x[3], v[3] = {0}, acceleration[3] = {0};
        memcpy(x, continuum->mesh->X[a], sizeof x);
        if (support >= 0)
            motion_at(&continuum->definition->supports[support].motion, continuum->mesh->X[a], t, x, v,
                      acceleration);
        for (int i = 0; i < continuum->dim; i++) {
            if (continuum->equation[3 * a + (size_t)i] >= 0)
                continue;
            nodes->d[a][i] = x[i] - continuum->mesh->X[a][i];
            nodes->v[a][i] = v[i];
            nodes->a[a][i] = acceleration[i];
        }
    }
}

static void move_surfaces(const struct continuum *continuum, const struct continuum_nodes *nodes, bool level1,
                          bool trial)
{
    const struct solid *solid = continuum->solid;
    for (size_t k = 0; k < solid->n_attachments; k++) {
        struct surface *surface = solid->attachments[k].surface;
        struct surface_motion *const motions[2] = {level1 ? &surface->level[1] : NULL,
                                                   trial ? &surface->trial : NULL};
        for (int m = 0; m < 2; m++)
            if (motions[m])
                attachment_move(&solid->attachments[k], (const double(*)[3])continuum->mesh->X,
                                (const double(*)[3])nodes->d, (const double(*)[3])nodes->v,
                                (const double(*)[3])nodes->a, motions[m]);
    }
}

/** M a = f_external - f_internal for the free components. */
static int start_acceleration(struct continuum *continuum)
{
    struct continuum_nodes *state = &continuum->state;
    if (continuum->n_free == 0)
        return 0;
    continuum_mass_times(continuum, (const double(*)[3])state->a, continuum->work);
    for (size_t e = 0; e < continuum->n_free; e++) {
        const size_t a = (size_t)continuum->component[e] / 3, i = (size_t)continuum->component[e] % 3;
        continuum->residual[e] = state->f_external[a][i] - state->f_internal[a][i] - continuum->work[a][i];
    }
    CALL(continuum_factor(continuum, 1, 0, (const double(*)[3])state->d));
    CALL(sparse_solver_solve(continuum->solver, continuum->residual, continuum->delta));
    for (size_t e = 0; e < continuum->n_free; e++)
        state->a[continuum->component[e] / 3][continuum->component[e] % 3] = continuum->delta[e];
    return 0;
}

/** Current places from the state. */
static void places_take(struct continuum *continuum)
{
    for (size_t a = 0; a < continuum->mesh->n_nodes; a++)
        for (int i = 0; i < 3; i++)
            continuum->x[a][i] = continuum->mesh->X[a][i] + continuum->state.d[a][i];
}

/** Places, and the attached surfaces at both levels and in the trial, from the state. */
static void surfaces_take(struct continuum *continuum)
{
    const struct solid *solid = continuum->solid;
    const struct continuum_nodes *state = &continuum->state;
    places_take(continuum);
    move_surfaces(continuum, state, true, true);
    for (size_t k = 0; k < solid->n_attachments; k++)
        attachment_move(&solid->attachments[k], (const double(*)[3])continuum->mesh->X,
                        (const double(*)[3])state->d, (const double(*)[3])state->v,
                        (const double(*)[3])state->a, &solid->attachments[k].surface->level[0]);
}

int continuum_start(struct solid *solid)
{
    struct continuum *continuum = solid->data;
    struct continuum_nodes *state = &continuum->state;
    const struct model_mesh *definition = continuum->definition;
    for (size_t a = 0; a < continuum->mesh->n_nodes; a++)
        for (int i = 0; i < continuum->dim; i++) {
            state->d[a][i] = value_of(definition->displacement[i], continuum->mesh->X[a], solid->t);
            state->v[a][i] = value_of(definition->velocity[i], continuum->mesh->X[a], solid->t);
            state->a[a][i] = 0;
        }
    prescribe(continuum, solid->t, state);
    if (continuum_internal_forces(continuum, (const double(*)[3])state->d, state->f_internal))
        return continuum_report_inverted(continuum, solid->t);
    given_loads(continuum, solid->t, continuum->f_given);
    external_forces(continuum, (const double(*)[3])continuum->f_given, state->f_external);
    /* in contact with a fluid f/m without the added mass is far too large: start from 0 */
    if (!(solid->model->fluid.present && solid->n_attachments > 0))
        CALL(start_acceleration(continuum));
    memcpy(continuum->a_before, state->a, vector_size(continuum));
    surfaces_take(continuum);
    return 0;
}

void continuum_load(struct solid *solid)
{
    struct continuum *continuum = solid->data;
    external_forces(continuum, (const double(*)[3])continuum->f_given, continuum->state.f_external);
}

int continuum_resume(struct solid *solid)
{
    struct continuum *continuum = solid->data;
    continuum->factored = false; /* made again for factor_d when it is needed */
    surfaces_take(continuum);
    return 0;
}

/** d and v of the trial from its accelerations by Newmark; supports last. */
static void newmark(struct continuum *continuum)
{
    const struct continuum_nodes *state = &continuum->state;
    struct continuum_nodes *trial = &continuum->trial;
    generalized_alpha_newmark(&continuum->method, continuum->solid->dt, 3 * continuum->mesh->n_nodes,
                              flat(state->d), flat(state->v), flat(state->a), flat(trial->a), flat(trial->d),
                              flat(trial->v));
    prescribe(continuum, continuum->solid->t + continuum->solid->dt, trial);
    continuum->forces_current = false;
}

/** Trial := displacement @p d, with the velocities and accelerations that Newmark asks for. */
static void trial_from_displacement(struct continuum *continuum, const double (*d)[3])
{
    const double dt = continuum->solid->dt, beta = continuum->method.beta;
    const struct continuum_nodes *state = &continuum->state;
    for (size_t a = 0; a < continuum->mesh->n_nodes; a++)
        for (int i = 0; i < 3; i++)
            continuum->trial.a[a][i] =
                ((d[a][i] - state->d[a][i]) / dt - state->v[a][i] - (0.5 - beta) * dt * state->a[a][i]) /
                (beta * dt);
    newmark(continuum);
}

int continuum_begin_step(struct solid *solid)
{
    struct continuum *continuum = solid->data;
    double weights[2];
    given_loads(continuum, solid->t + solid->dt, continuum->f_given);
    solid_predictor(solid, weights);
    for (size_t k = 0; k < 3 * continuum->mesh->n_nodes; k++)
        flat(continuum->trial.a)[k] =
            weights[0] * flat(continuum->state.a)[k] + weights[1] * flat(continuum->a_before)[k];
    newmark(continuum);
    continuum->corrections = 0;
    return 0;
}

int continuum_predict(struct solid *solid)
{
    const struct continuum *continuum = solid->data;
    move_surfaces(continuum, &continuum->trial, true, true);
    return 0;
}

/** Residual of the balance at the generalised midpoint for the trial; the internal force is current. Returns
 * its norm. */
static double residual(struct continuum *continuum)
{
    const struct continuum_nodes *state = &continuum->state, *trial = &continuum->trial;
    const double am = continuum->method.alpha_m, af = continuum->method.alpha_f;
    double sum = 0;
    for (size_t k = 0; k < 3 * continuum->mesh->n_nodes; k++)
        flat(continuum->work)[k] = (1 - am) * flat(trial->a)[k] + am * flat(state->a)[k];
    continuum_mass_times(continuum, (const double(*)[3])continuum->work, continuum->work2);
    for (size_t e = 0; e < continuum->n_free; e++) {
        const int32_t c = continuum->component[e];
        const double r = flat(continuum->work2)[c] +
                         (1 - af) * (flat(trial->f_internal)[c] - flat(trial->f_external)[c]) +
                         af * (flat(state->f_internal)[c] - flat(state->f_external)[c]);
        continuum->residual[e] = r;
        sum += r * r;
    }
    return sqrt(sum);
}

/** The largest of the forces that balance in the residual. */
static double reference_force(const struct continuum *continuum)
{
    double internal = 0, external = 0, inertia = 0;
    for (size_t k = 0; k < 3 * continuum->mesh->n_nodes; k++) {
        internal += flat(continuum->trial.f_internal)[k] * flat(continuum->trial.f_internal)[k];
        external += flat(continuum->trial.f_external)[k] * flat(continuum->trial.f_external)[k];
        inertia += flat(continuum->work2)[k] * flat(continuum->work2)[k];
    }
    return sqrt(fmax(internal, fmax(external, inertia)));
}

/** Trial += delta, consistent with Newmark. */
static void update(struct continuum *continuum)
{
    struct continuum_nodes *trial = &continuum->trial;
    const double dt = continuum->solid->dt, beta = continuum->method.beta;
    for (size_t e = 0; e < continuum->n_free; e++) {
        const int32_t c = continuum->component[e];
        flat(trial->d)[c] += continuum->delta[e];
        flat(trial->v)[c] += continuum->method.gamma / (beta * dt) * continuum->delta[e];
        flat(trial->a)[c] += continuum->delta[e] / (beta * dt * dt);
    }
    continuum->forces_current = false;
}

/** Factor of the effective matrix (1 - alpha_m)/(beta dt^2) M + (1 - alpha_f) K(d). */
static int factor_at(struct continuum *continuum, const double (*d)[3])
{
    const double dt = continuum->solid->dt;
    return continuum_factor(continuum, (1 - continuum->method.alpha_m) / (continuum->method.beta * dt * dt),
                            1 - continuum->method.alpha_f, d);
}

/** Newton's method from the trial. *@p inverted tells that an element was, which is not reported. */
static int newton(struct continuum *continuum, bool *inverted)
{
    const double t = continuum->solid->t + continuum->solid->dt;
    double norm = 0, reference = 0;
    *inverted = false;
    for (int iteration = 0; iteration <= NEWTON_LIMIT; iteration++) {
        if (continuum_internal_forces(continuum, (const double(*)[3])continuum->trial.d,
                                      continuum->trial.f_internal)) {
            *inverted = true;
            return 0;
        }
        norm = residual(continuum);
        reference = reference_force(continuum);
        continuum->forces_current = true;
        CHECK(isfinite(norm), STATUS_NUMERICAL, "solid \"%s\": the residual force is %g at t = %g s",
              continuum->definition->name, norm, t);
        if (norm <= continuum->definition->newton_tolerance * reference + continuum->force_floor)
            return 0;
        if (iteration == NEWTON_LIMIT)
            break;
        CALL(factor_at(continuum, (const double(*)[3])continuum->trial.d));
        CALL(sparse_solver_solve(continuum->solver, continuum->residual, continuum->delta));
        for (size_t e = 0; e < continuum->n_free; e++)
            continuum->delta[e] = -continuum->delta[e];
        update(continuum);
    }
    return error_report(
        STATUS_NUMERICAL,
        "solid \"%s\": Newton's method did not converge in %d iterations at t = %g s: residual "
        "%.3e N of %.3e N (tolerance %g); use a smaller step",
        continuum->definition->name, NEWTON_LIMIT, t, norm, reference,
        continuum->definition->newton_tolerance);
}

int continuum_solve(struct solid *solid)
{
    struct continuum *continuum = solid->data;
    bool inverted;
    step_forces(continuum);
    continuum->factored = false; /* the solver's factor is no longer the kept one */
    CALL(newton(continuum, &inverted));
    if (inverted) { /* with a long step the prediction may lead too far */
        trial_from_displacement(continuum, (const double(*)[3])continuum->state.d);
        CALL(newton(continuum, &inverted));
        if (inverted)
            return continuum_report_inverted(continuum, solid->t + solid->dt);
    }
    move_surfaces(continuum, &continuum->trial, false, true);
    return 0;
}

/** Make sure the solver holds the kept factor, renewed when it is due. */
static int keep_factor(struct continuum *continuum)
{
    const double dt = continuum->solid->dt;
    const bool slow = continuum->corrections > 0 && continuum->corrections % SLOW_CORRECTIONS == 0;
    const bool old = continuum->corrections == 0 && continuum->factor_age >= FACTOR_STEPS;
    if (slow || old || fabs(continuum->factor_dt - dt) > 0) {
        memcpy(continuum->factor_d, continuum->trial.d, vector_size(continuum));
        continuum->factor_dt = dt;
        continuum->factor_age = 0;
        continuum->factored = false;
    }
    if (!continuum->factored)
        CALL(factor_at(continuum, (const double(*)[3])continuum->factor_d));
    continuum->factored = true;
    return 0;
}

/** z := J^-1 v, w := (J + (1 - alpha_f)/(beta dt^2) (M_a + gamma dt D)) z (numerics: added mass of the
 * attached surfaces, and their damping unless loads are means, which know of accelerations only). */
static int apply_added_mass(void *context, const double *v, double *z, double *w)
{
    struct continuum *continuum = context;
    const double dt = continuum->solid->dt;
    const double factor = continuum->solid->end_weight / (continuum->method.beta * dt * dt);
    CALL(sparse_solver_solve(continuum->solver, v, z));
    memset(continuum->work, 0, vector_size(continuum));
    memset(continuum->work2, 0, vector_size(continuum));
    for (size_t e = 0; e < continuum->n_free; e++)
        flat(continuum->work)[continuum->component[e]] = z[e];
    for (size_t k = 0; k < continuum->solid->n_attachments; k++)
        attachment_add_added_mass(&continuum->solid->attachments[k], (const double(*)[3])continuum->work,
                                  continuum->solid->mean_loads ? 0.0 : continuum->method.gamma * dt,
                                  continuum->work2);
    for (size_t e = 0; e < continuum->n_free; e++)
        w[e] = v[e] + factor * flat(continuum->work2)[continuum->component[e]];
    return 0;
}

static bool has_added_mass(const struct solid *solid)
{
    for (size_t k = 0; k < solid->n_attachments; k++)
        if (solid->attachments[k].surface->n_added_mass > 0)
            return true;
    return false;
}

int continuum_correct(struct solid *solid, bool added_mass)
{
    struct continuum *continuum = solid->data;
    struct continuum_nodes *trial = &continuum->trial;
    bool moved = false;
    for (size_t k = 0; k < solid->n_attachments; k++)
        moved |= attachment_follow(&solid->attachments[k], trial->d);
    /* rounding must not part displacement and acceleration: no correction would bring them together again */
    if (moved)
        trial_from_displacement(continuum, (const double(*)[3])trial->d);
    else
        prescribe(continuum, solid->t + solid->dt, trial);
    step_forces(continuum);
    if (continuum_internal_forces(continuum, (const double(*)[3])trial->d, trial->f_internal))
        return continuum_report_inverted(continuum, solid->t + solid->dt);
    const double norm = residual(continuum);
    CHECK(isfinite(norm), STATUS_NUMERICAL, "solid \"%s\": the residual force is %g at t = %g s",
          continuum->definition->name, norm, solid->t + solid->dt);
    if (continuum->n_free > 0) {
        CALL(keep_factor(continuum));
        for (size_t e = 0; e < continuum->n_free; e++)
            continuum->residual[e] = -continuum->residual[e];
        if (added_mass && has_added_mass(solid))
            CALL(gmres_solve(continuum->gmres, apply_added_mass, continuum, continuum->residual,
                             continuum->delta, gmres_tolerance, NULL, NULL));
        else
            CALL(sparse_solver_solve(continuum->solver, continuum->residual, continuum->delta));
    }
    update(continuum);
    continuum->corrections++;
    move_surfaces(continuum, trial, false, true);
    return 0;
}

/** Forces of the supports at the end of the step, and the work of loads and supports over it (trapezoidal
 * rule). */
static void account(struct continuum *continuum)
{
    const struct continuum_nodes *state = &continuum->state, *trial = &continuum->trial;
    continuum_mass_times(continuum, (const double(*)[3])trial->a, continuum->work);
    for (size_t c = 0; c < 3 * continuum->mesh->n_nodes; c++) {
        const bool held = continuum->equation[c] < 0;
        const double before = flat(state->f_external)[c] + flat(continuum->reaction)[c];
        flat(continuum->reaction)[c] =
            held ? flat(continuum->work)[c] + flat(trial->f_internal)[c] - flat(trial->f_external)[c] : 0;
        const double after = flat(trial->f_external)[c] + flat(continuum->reaction)[c];
        continuum->external_work += 0.5 * (before + after) * (flat(trial->d)[c] - flat(state->d)[c]);
    }
}

int continuum_accept(struct solid *solid)
{
    struct continuum *continuum = solid->data;
    struct continuum_nodes *state = &continuum->state, *trial = &continuum->trial;
    const size_t size = vector_size(continuum);
    if (!continuum->forces_current &&
        continuum_internal_forces(continuum, (const double(*)[3])trial->d, trial->f_internal))
        return continuum_report_inverted(continuum, solid->t + solid->dt);
    account(continuum);
    memcpy(continuum->a_before, state->a, size);
    memcpy(state->d, trial->d, size);
    memcpy(state->v, trial->v, size);
    memcpy(state->a, trial->a, size);
    memcpy(state->f_internal, trial->f_internal, size);
    memcpy(state->f_external, trial->f_external, size);
    for (size_t a = 0; a < continuum->mesh->n_nodes; a++)
        for (int i = 0; i < 3; i++)
            continuum->x[a][i] = continuum->mesh->X[a][i] + state->d[a][i];
    continuum->factor_age++;
    move_surfaces(continuum, state, true, true);
    return 0;
}

// SPDX-License-Identifier: GPL-3.0-or-later
/* Motion of rigid bodies: one step of Simo and Wong (1991), algorithm C1, as rigid_body.h tells. */
#include "solid/rigid_body.h"

#include <math.h>
#include <string.h>

enum { STEP_LIMIT = 50 /**< iterations for the rotation of a step: 2 or 3 are usual */ };

/** Changes of the rotation by less than this part of it may be rounding. */
static const double step_tolerance = 1e-11;

static void cross(const double a[3], const double b[3], double c[3])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static void times(const double A[3][3], const double b[3], double c[3])
{
    for (int i = 0; i < 3; i++)
        c[i] = A[i][0] * b[0] + A[i][1] * b[1] + A[i][2] * b[2];
}

static void transposed_times(const double A[3][3], const double b[3], double c[3])
{
    for (int i = 0; i < 3; i++)
        c[i] = A[0][i] * b[0] + A[1][i] * b[1] + A[2][i] * b[2];
}

void rigid_body_rotation(const double q[4], double R[3][3])
{
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    const double all[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                              {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                              {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
    memcpy(R, all, sizeof all);
}

void rigid_body_turn(const double q[4], const double turn[3], double p[4])
{
    const double angle = sqrt(turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2]);
    const double w = cos(0.5 * angle), s = angle > 0 ? sin(0.5 * angle) / angle : 0.5;
    const double x = s * turn[0], y = s * turn[1], z = s * turn[2];
    p[0] = q[0] * w - q[1] * x - q[2] * y - q[3] * z;
    p[1] = q[0] * x + q[1] * w + q[2] * z - q[3] * y;
    p[2] = q[0] * y - q[1] * z + q[2] * w + q[3] * x;
    p[3] = q[0] * z + q[1] * y - q[2] * x + q[3] * w;
    const double length = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2] + p[3] * p[3]);
    for (int i = 0; i < 4; i++)
        p[i] /= length;
}

/** Solve A x = b for the components that are free, the others 0, by elimination with partial pivoting; A and
 * b are used up. */
static void solve_free(int n, double A[6][6], double b[6], const bool *is_free, double *x)
{
    int rows[6], m = 0;
    for (int i = 0; i < n; i++) {
        x[i] = 0;
        if (is_free[i])
            rows[m++] = i;
    }
    int order[6];
    memcpy(order, rows, sizeof order);
    for (int k = 0; k < m; k++) {
        int best = k;
        for (int r = k + 1; r < m; r++)
            if (fabs(A[order[r]][rows[k]]) > fabs(A[order[best]][rows[k]]))
                best = r;
        const int pivot = order[best];
        order[best] = order[k];
        order[k] = pivot;
        for (int r = k + 1; r < m; r++) {
            const double factor = A[order[r]][rows[k]] / A[pivot][rows[k]];
            for (int c = k; c < m; c++)
                A[order[r]][rows[c]] -= factor * A[pivot][rows[c]];
            b[order[r]] -= factor * b[pivot];
        }
    }
    for (int k = m - 1; k >= 0; k--) {
        double sum = b[order[k]];
        for (int c = k + 1; c < m; c++)
            sum -= A[order[k]][rows[c]] * x[rows[c]];
        x[rows[k]] = sum / A[order[k]][rows[k]];
    }
}

/** The same for rotations only. */
static void solve_rotation(const struct rigid_body *body, const double A[3][3], const double b[3],
                           double x[3])
{
    double matrix[6][6], right[6];
    for (int i = 0; i < 3; i++) {
        right[i] = b[i];
        for (int j = 0; j < 3; j++)
            matrix[i][j] = A[i][j];
    }
    solve_free(3, matrix, right, body->free + 3, x);
}

/** The inertia in fixed axes: R J R^T. */
static void inertia_of(const struct rigid_body *body, const double R[3][3], double I[3][3])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            I[i][j] = 0;
            for (int k = 0; k < 3; k++)
                for (int l = 0; l < 3; l++)
                    I[i][j] += R[i][k] * body->mass.inertia[k][l] * R[j][l];
        }
}

/** Angular velocity from orientation and angular momentum. */
static void spin(const struct rigid_body *body, struct rigid_body_motion *motion)
{
    double R[3][3], I[3][3];
    rigid_body_rotation(motion->q, R);
    inertia_of(body, (const double(*)[3])R, I);
    solve_rotation(body, (const double(*)[3])I, motion->momentum, motion->omega);
}

void rigid_body_point(const struct rigid_body *body, const struct rigid_body_motion *motion,
                      const double R[3][3], const double X[3], double x[3], double v[3], double a[3])
{
    double arm[3], r[3], way[3], inner[3], angular[3];
    for (int i = 0; i < 3; i++)
        arm[i] = X[i] - body->mass.centre[i];
    times(R, arm, r);
    cross(motion->omega, r, way);
    cross(motion->omega, way, inner);
    cross(motion->alpha, r, angular);
    for (int i = 0; i < 3; i++) {
        x[i] = X[i] + (motion->d[i] + (r[i] - arm[i])); /* X to the bit as long as nothing has moved */
        v[i] = motion->v[i] + way[i];
        a[i] = motion->a[i] + angular[i] + inner[i];
    }
}

/** The motion into some of level 0, level 1 and the trial of the attached surfaces. */
static void move_surfaces(const struct rigid_body *body, const struct rigid_body_motion *motion, bool level0,
                          bool level1, bool trial)
{
    const struct solid *solid = body->solid;
    double R[3][3], x[3], v[3], a[3];
    rigid_body_rotation(motion->q, R);
    for (size_t k = 0; k < solid->n_attachments; k++) {
        const struct attachment *attachment = &solid->attachments[k];
        struct surface *surface = attachment->surface;
        struct surface_motion *const motions[3] = {level0 ? &surface->level[0] : NULL,
                                                   level1 ? &surface->level[1] : NULL,
                                                   trial ? &surface->trial : NULL};
        for (size_t n = 0; n < attachment->n; n++) {
            const int32_t p = attachment->points[n];
            rigid_body_point(body, motion, (const double(*)[3])R, body->mesh->X[attachment->nodes[n]], x, v,
                             a);
            for (int m = 0; m < 3; m++)
                if (motions[m]) {
                    memcpy(motions[m]->x[p], x, sizeof x);
                    memcpy(motions[m]->v[p], v, sizeof v);
                    memcpy(motions[m]->a[p], a, sizeof a);
                }
        }
    }
}

/** Places of all nodes from the state. */
static void places_take(struct rigid_body *body)
{
    double R[3][3], v[3], a[3];
    rigid_body_rotation(body->state.q, R);
    for (size_t n = 0; n < body->mesh->n_nodes; n++)
        rigid_body_point(body, &body->state, (const double(*)[3])R, body->mesh->X[n], body->x[n], v, a);
}

static void load_add(struct rigid_body_load *load, const double arm[3], const double f[3])
{
    for (int i = 0; i < 3; i++) {
        load->force[i] += f[i];
        for (int j = 0; j < 3; j++)
            load->lever[i][j] += arm[i] * f[j];
    }
}

/** Loads of the deck at time @p t: on node sets, shared equally by their nodes, and body forces. */
static void load_given(const struct rigid_body *body, double t, struct rigid_body_load *load)
{
    const struct model_mesh *definition = body->definition;
    *load = (struct rigid_body_load){0};
    for (int i = 0; i < body->mesh->dim; i++)
        if (body->solid->model->time.body_force[i])
            load->force[i] +=
                body->mass.mass * expression_value(body->solid->model->time.body_force[i], NULL, t);
    for (size_t l = 0; l < definition->n_loads; l++) {
        const struct node_set *set =
            definition->loads[l].set < 0 ? NULL : &body->mesh->sets[definition->loads[l].set];
        double f[3] = {0}, arm[3] = {0};
        for (int i = 0; i < body->mesh->dim; i++)
            if (definition->loads[l].force[i])
                f[i] = (set ? 1 : body->mass.mass) * expression_value(definition->loads[l].force[i], NULL, t);
        for (size_t k = 0; set && k < set->n; k++)
            for (int i = 0; i < 3; i++)
                arm[i] += (body->mesh->X[set->nodes[k]][i] - body->mass.centre[i]) / (double)set->n;
        load_add(load, arm, f);
    }
}

/** Loads now on the attached surfaces. */
static void load_take(struct rigid_body *body)
{
    const struct solid *solid = body->solid;
    body->interface = (struct rigid_body_load){0};
    for (size_t k = 0; k < solid->n_attachments; k++) {
        const struct attachment *attachment = &solid->attachments[k];
        for (size_t n = 0; n < attachment->n; n++) {
            double arm[3];
            for (int i = 0; i < 3; i++)
                arm[i] = body->mesh->X[attachment->nodes[n]][i] - body->mass.centre[i];
            load_add(&body->interface, arm, attachment->surface->load[attachment->points[n]]);
        }
    }
}

/** moment += @p weight times that of the load with its arms turned by R. */
static void moment_add(const struct rigid_body_load *load, const double R[3][3], double weight,
                       double moment[3])
{
    double lever[3][3] = {{0}};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++)
                lever[i][j] += R[i][k] * load->lever[k][j];
    moment[0] += weight * (lever[1][2] - lever[2][1]);
    moment[1] += weight * (lever[2][0] - lever[0][2]);
    moment[2] += weight * (lever[0][1] - lever[1][0]);
}

/** Force and moment of all loads: of the end of the step, where the rotation is @p R, or the means over it.
 */
static void resultants(const struct rigid_body *body, const double R0[3][3], const double R[3][3],
                       double force[3], double moment[3])
{
    const double start = body->solid->mean_loads ? 0.5 : 0, end = 1 - start;
    memset(moment, 0, 3 * sizeof *moment);
    for (int i = 0; i < 3; i++)
        force[i] = body->interface.force[i] + start * body->given[0].force[i] + end * body->given[1].force[i];
    moment_add(&body->interface, R, end, moment);
    moment_add(&body->given[1], R, end, moment);
    if (start > 0) {
        moment_add(&body->interface, R0, start, moment);
        moment_add(&body->given[0], R0, start, moment);
    }
}

/** What acts on the body over the step, and the accelerations that follow from it. */
struct action {
    double force[3], moment[3];
};

/** Accelerations of the trial, whose rotation is @p R, from the loads; unless @p guess is NULL those were
 * made with its accelerations and follow others by the added mass. */
static void accelerate(struct rigid_body *body, const double R0[3][3], const double R[3][3],
                       const double I[3][3], const struct rigid_body_motion *guess, struct action *action)
{
    double A[6][6] = {{0}}, b[6], answer[6], angular[3], gyroscopic[3], ahead[6] = {0};
    resultants(body, R0, R, action->force, action->moment);
    times(I, body->trial.omega, angular);
    cross(body->trial.omega, angular, gyroscopic);
    for (int i = 0; i < 3; i++) {
        A[i][i] = body->mass.mass;
        b[i] = action->force[i];
        b[3 + i] = action->moment[i] - gyroscopic[i];
        for (int j = 0; j < 3; j++)
            A[3 + i][3 + j] = I[i][j];
    }
    for (int i = 0; guess && i < 6; i++)
        for (int j = 0; j < 6; j++) {
            A[i][j] += body->added_mass[i][j];
            b[i] += body->added_mass[i][j] * (j < 3 ? guess->a[j] : guess->alpha[j - 3]);
        }
    solve_free(6, A, b, body->free, answer);
    memcpy(body->trial.a, answer, sizeof body->trial.a);
    memcpy(body->trial.alpha, answer + 3, sizeof body->trial.alpha);
    for (int j = 0; guess && j < 6; j++)
        ahead[j] = answer[j] - (j < 3 ? guess->a[j] : guess->alpha[j - 3]);
    for (int i = 0; guess && i < 6; i++)
        for (int j = 0; j < 6; j++)
            *(i < 3 ? &action->force[i] : &action->moment[i - 3]) -= body->added_mass[i][j] * ahead[j];
}

/** Impulse from the forces at both ends of the step, @p before and @p after, or from the mean, which is @p
 * after. */
static double impulse(const struct solid *solid, double before, double after)
{
    return solid->dt * (solid->mean_loads ? after : 0.5 * (before + after));
}

/** Velocity and place of the centre. */
static void translate(struct rigid_body *body, const double force[3])
{
    const struct rigid_body_motion *state = &body->state;
    struct rigid_body_motion *trial = &body->trial;
    for (int i = 0; i < 3; i++) {
        if (!body->free[i])
            continue;
        trial->v[i] = state->v[i] + impulse(body->solid, body->force[i], force[i]) / body->mass.mass;
        trial->d[i] = state->d[i] + 0.5 * body->solid->dt * (state->v[i] + trial->v[i]);
    }
}

/** One step of Newton's method for I(omega) omega = angular momentum; the inertia turns with half the angular
 * velocity. */
static void rotate(struct rigid_body *body, const double moment[3], const double I[3][3])
{
    struct rigid_body_motion *trial = &body->trial;
    const double *w = trial->omega, half = 0.5 * body->solid->dt;
    double L[3], defect[3], change[3], slope[3][3];
    times(I, w, L);
    for (int i = 0; i < 3; i++) {
        trial->momentum[i] = body->state.momentum[i] + impulse(body->solid, body->moment[i], moment[i]);
        defect[i] = trial->momentum[i] - L[i];
    }
    const double wx[3][3] = {{0, -w[2], w[1]}, {w[2], 0, -w[0]}, {-w[1], w[0], 0}};
    const double Lx[3][3] = {{0, -L[2], L[1]}, {L[2], 0, -L[0]}, {-L[1], L[0], 0}};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            slope[i][j] = I[i][j] - half * Lx[i][j];
            for (int k = 0; k < 3; k++)
                slope[i][j] += half * I[i][k] * wx[k][j];
        }
    solve_rotation(body, (const double(*)[3])slope, defect, change);
    for (int i = 0; i < 3; i++)
        trial->omega[i] += change[i];
}

/** The trial's rotation from the angular velocities at both ends; @p turn is the rotation vector of the step
 * in the axes of the body. Returns how much that changed. */
static double turn_trial(struct rigid_body *body, const double W0[3], const double R[3][3], double turn[3])
{
    double W[3], change = 0;
    transposed_times(R, body->trial.omega, W);
    for (int i = 0; i < 3; i++) {
        const double now = 0.5 * body->solid->dt * (W0[i] + W[i]);
        change = fmax(change, fabs(now - turn[i]));
        turn[i] = now;
    }
    rigid_body_turn(body->state.q, turn, body->trial.q);
    return change;
}

static bool is_finite(const struct rigid_body_motion *motion)
{
    double sum = motion->q[0];
    for (int i = 0; i < 3; i++)
        sum += motion->d[i] + motion->a[i] + motion->q[1 + i] + motion->omega[i] + motion->alpha[i];
    return isfinite(sum);
}

static int report(const struct rigid_body *body, const double turn[3])
{
    const double *a = body->trial.a, *alpha = body->trial.alpha;
    return error_report(
        STATUS_NUMERICAL,
        "solid \"%s\": its motion is lost at t = %g s: acceleration (%g, %g, %g) m/s^2, angular acceleration "
        "(%g, %g, %g) rad/s^2, turned by (%g, %g, %g) rad in one step; use a smaller step",
        body->definition->name, body->solid->t + body->solid->dt, a[0], a[1], a[2], alpha[0], alpha[1],
        alpha[2], turn[0], turn[1], turn[2]);
}

/** Where some rotation is fixed, the angular momentum also has what supports add. */
static void momentum_complete(struct rigid_body *body)
{
    double R[3][3], I[3][3];
    if (body->free[3] && body->free[4] && body->free[5])
        return;
    rigid_body_rotation(body->trial.q, R);
    inertia_of(body, (const double(*)[3])R, I);
    times((const double(*)[3])I, body->trial.omega, body->trial.momentum);
}

/** Solve the step for the trial, which is the first guess: with the loads as they are, or (@p added_mass)
 * counting on what the added mass will make of them. */
static int advance(struct rigid_body *body, bool added_mass)
{
    const struct rigid_body_motion guess = body->trial;
    double R0[3][3], R[3][3], I[3][3], W0[3], turn[3] = {0}, last = INFINITY;
    struct action action;
    rigid_body_rotation(body->state.q, R0);
    transposed_times((const double(*)[3])R0, body->state.omega, W0);
    for (int iteration = 0;; iteration++) {
        rigid_body_rotation(body->trial.q, R);
        inertia_of(body, (const double(*)[3])R, I);
        accelerate(body, (const double(*)[3])R0, (const double(*)[3])R, (const double(*)[3])I,
                   added_mass ? &guess : NULL, &action);
        translate(body, action.force);
        rotate(body, action.moment, (const double(*)[3])I);
        const double change = turn_trial(body, W0, (const double(*)[3])R, turn);
        const double size = fabs(turn[0]) + fabs(turn[1]) + fabs(turn[2]);
        if (!is_finite(&body->trial) || iteration == STEP_LIMIT)
            return report(body, turn);
        /* until rounding is all that is left of the change */
        if (iteration > 0 && (change <= 0 || (change <= step_tolerance * size && 2 * change >= last)))
            break;
        last = change;
    }
    momentum_complete(body);
    spin(body, &body->trial);
    return 0;
}

/** Accelerations of the trial without a step: of the loads at rest in the orientation of the state. */
static void start_acceleration(struct rigid_body *body)
{
    double R[3][3], I[3][3];
    struct action action;
    body->trial = body->state;
    rigid_body_rotation(body->state.q, R);
    inertia_of(body, (const double(*)[3])R, I);
    accelerate(body, (const double(*)[3])R, (const double(*)[3])R, (const double(*)[3])I, NULL, &action);
    memcpy(body->state.a, body->trial.a, sizeof body->state.a);
    memcpy(body->state.alpha, body->trial.alpha, sizeof body->state.alpha);
}

/** Force and moment of the loads at the start of the first step. */
static void start_action(struct rigid_body *body)
{
    double R[3][3];
    rigid_body_rotation(body->state.q, R);
    resultants(body, (const double(*)[3])R, (const double(*)[3])R, body->force, body->moment);
}

int rigid_body_start(struct solid *solid)
{
    struct rigid_body *body = solid->data;
    const struct model_rigid *rigid = &body->definition->rigid;
    struct rigid_body_motion *state = &body->state;
    *state = (struct rigid_body_motion){.q = {1}};
    memcpy(state->v, rigid->velocity, sizeof state->v);
    times((const double(*)[3])body->mass.inertia, rigid->angular_velocity, state->momentum);
    spin(body, state);
    load_given(body, solid->t, &body->given[1]);
    body->given[0] = body->given[1];
    body->interface = (struct rigid_body_load){0};
    start_action(body);
    /* in contact with a fluid f/m without the added mass is far too large: start from 0 */
    if (!(solid->model->fluid.present && solid->n_attachments > 0))
        start_acceleration(body);
    memcpy(body->a_before, state->a, sizeof body->a_before);
    memcpy(body->alpha_before, state->alpha, sizeof body->alpha_before);
    body->trial = *state;
    places_take(body);
    move_surfaces(body, state, true, true, true);
    return 0;
}

void rigid_body_take_load(struct solid *solid)
{
    struct rigid_body *body = solid->data;
    load_take(body);
    start_action(body);
}

int rigid_body_resume(struct solid *solid)
{
    struct rigid_body *body = solid->data;
    spin(body, &body->state);
    body->trial = body->state;
    places_take(body);
    move_surfaces(body, &body->state, true, true, true);
    return 0;
}

/** Angular velocity and rotation of the trial from its predicted acceleration. */
static void predict_rotation(struct rigid_body *body)
{
    const struct rigid_body_motion *state = &body->state;
    struct rigid_body_motion *trial = &body->trial;
    double R[3][3], I[3][3], L[3], gyroscopic[3], rest[3], alpha[3], middle[3], turn[3];
    rigid_body_rotation(state->q, R);
    inertia_of(body, (const double(*)[3])R, I);
    times((const double(*)[3])I, state->omega, L);
    cross(state->omega, L, gyroscopic);
    for (int i = 0; i < 3; i++)
        rest[i] = body->moment[i] - gyroscopic[i];
    solve_rotation(body, (const double(*)[3])I, rest, alpha);
    for (int i = 0; i < 3; i++) {
        trial->omega[i] = state->omega[i] + impulse(body->solid, alpha[i], trial->alpha[i]);
        middle[i] = 0.5 * body->solid->dt * (state->omega[i] + trial->omega[i]);
    }
    transposed_times((const double(*)[3])R, middle, turn);
    rigid_body_turn(state->q, turn, trial->q);
}

int rigid_body_begin_step(struct solid *solid)
{
    struct rigid_body *body = solid->data;
    const struct rigid_body_motion *state = &body->state;
    double weights[2], force[3];
    load_given(body, solid->t, &body->given[0]);
    load_given(body, solid->t + solid->dt, &body->given[1]);
    solid_predictor(solid, weights);
    body->trial = *state;
    for (int i = 0; i < 3; i++) {
        body->trial.a[i] = weights[0] * state->a[i] + weights[1] * body->a_before[i];
        body->trial.alpha[i] = weights[0] * state->alpha[i] + weights[1] * body->alpha_before[i];
        force[i] = body->mass.mass * body->trial.a[i];
    }
    translate(body, force);
    predict_rotation(body);
    body->added_mass_current = false;
    return 0;
}

int rigid_body_predict(struct solid *solid)
{
    const struct rigid_body *body = solid->data;
    move_surfaces(body, &body->trial, false, true, true);
    return 0;
}

/** What the added mass of an attached surface makes of the acceleration @p mode of the trial: @p column
 * (added to). */
static void added_mass_column(const struct rigid_body *body, const struct attachment *attachment, int mode,
                              double column[6])
{
    static const double axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    struct surface *surface = attachment->surface;
    const double(*x)[3] = (const double(*)[3])surface->trial.x;
    double r[3], moment[3];
    /* points that are not on this body keep acceleration 0 */
    for (size_t n = 0; n < attachment->n; n++) {
        double *a = attachment->acceleration[attachment->points[n]];
        for (int i = 0; i < 3; i++)
            r[i] = x[attachment->points[n]][i] - (body->mass.centre[i] + body->trial.d[i]);
        if (mode < 3)
            memcpy(a, axes[mode], sizeof r);
        else
            cross(axes[mode - 3], r, a);
    }
    surface_added_mass_apply(surface, (const double(*)[3])attachment->acceleration,
                             body->solid->mean_loads ? 0.0 : 0.5 * body->solid->dt, attachment->reaction);
    for (size_t n = 0; n < attachment->n; n++) {
        const double *f = attachment->reaction[attachment->points[n]];
        for (int i = 0; i < 3; i++)
            r[i] = x[attachment->points[n]][i] - (body->mass.centre[i] + body->trial.d[i]);
        cross(r, f, moment);
        for (int i = 0; i < 3; i++) {
            column[i] += f[i];
            column[3 + i] += moment[i];
        }
    }
}

/** The surfaces' operator is made once a step, and so is this. */
static void added_mass_take(struct rigid_body *body)
{
    const struct solid *solid = body->solid;
    memset(body->added_mass, 0, sizeof body->added_mass);
    for (int mode = 0; mode < 6; mode++) {
        double column[6] = {0};
        for (size_t k = 0; k < solid->n_attachments && body->free[mode]; k++)
            added_mass_column(body, &solid->attachments[k], mode, column);
        for (int i = 0; i < 6; i++)
            body->added_mass[i][mode] = column[i];
    }
    body->added_mass_current = true;
}

int rigid_body_solve(struct solid *solid)
{
    return rigid_body_correct(solid, false);
}

int rigid_body_correct(struct solid *solid, bool added_mass)
{
    struct rigid_body *body = solid->data;
    load_take(body);
    if (added_mass && !body->added_mass_current)
        added_mass_take(body);
    CALL(advance(body, added_mass));
    body->approximate = added_mass;
    move_surfaces(body, &body->trial, false, false, true);
    return 0;
}

/** Work of the loads over the step: exactly the kinetic energy that it brings. */
static double work_of(const struct rigid_body *body, const double force[3], const double moment[3])
{
    const struct rigid_body_motion *state = &body->state, *trial = &body->trial;
    double R0[3][3], R[3][3], W0[3], W[3], middle[3], omega[3], work = 0;
    rigid_body_rotation(state->q, R0);
    rigid_body_rotation(trial->q, R);
    transposed_times((const double(*)[3])R0, state->omega, W0);
    transposed_times((const double(*)[3])R, trial->omega, W);
    for (int i = 0; i < 3; i++)
        middle[i] = 0.5 * (W0[i] + W[i]);
    times((const double(*)[3])R0, middle, omega);
    for (int i = 0; i < 3; i++)
        work += impulse(body->solid, body->force[i], force[i]) * 0.5 * (state->v[i] + trial->v[i]) +
                impulse(body->solid, body->moment[i], moment[i]) * omega[i];
    return work;
}

int rigid_body_accept(struct solid *solid)
{
    struct rigid_body *body = solid->data;
    double R0[3][3], R[3][3], force[3], moment[3];
    load_take(body);
    if (body->approximate) /* the impulse of the step is that of the very loads that the fluid lost */
        CALL(advance(body, false));
    rigid_body_rotation(body->state.q, R0);
    rigid_body_rotation(body->trial.q, R);
    resultants(body, (const double(*)[3])R0, (const double(*)[3])R, force, moment);
    body->external_work += work_of(body, force, moment);
    body->turn += 0.5 * solid->dt * (body->state.omega[2] + body->trial.omega[2]);
    memcpy(body->force, force, sizeof body->force);
    memcpy(body->moment, moment, sizeof body->moment);
    memcpy(body->a_before, body->state.a, sizeof body->a_before);
    memcpy(body->alpha_before, body->state.alpha, sizeof body->alpha_before);
    body->state = body->trial;
    places_take(body);
    move_surfaces(body, &body->state, false, true, true);
    return 0;
}

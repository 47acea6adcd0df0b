// SPDX-License-Identifier: GPL-3.0-or-later
/* The pair sweeps against the equations written down plainly, in double, over all pairs and periodic images.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/memory.h"
#include "base/parallel.h"
#include "fluid/fluid_case.h"
#include "sph/isa.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double dx = 0.013;

struct reference {
    double *rho, *p, *a[3], *background[3], *w[3];
};

static double nearest(double d, const struct model *model, int k)
{
    double length = model->domain.upper[k] - model->domain.lower[k];
    return d - length * round(d / length);
}

/** Sums of eqs. 15 and 16 over every pair. */
static void reference_make(const struct fluid_case *c, struct reference *ref, int pass)
{
    const struct particles *b = fluid_particles(c->fluid);
    const struct fluid_view *view = fluid_view(c->fluid);
    const int dim = c->model.dim;
    for (size_t i = 0; i < b->n; ++i) {
        double sum = 0.0, a[3] = {0}, background[3] = {0};
        for (size_t j = 0; j < b->n; ++j) {
            double d[3] = {0}, r = 0.0;
            for (int k = 0; k < dim; ++k) {
                d[k] = nearest(b->x[k][i] - b->x[k][j], &c->model, k);
                r += d[k] * d[k];
            }
            r = sqrt(r);
            sum += kernel_w(&view->kernel, r);
            if (pass == 0 || i == j || r >= view->kernel.support)
                continue;
            double vi = b->m[i] / ref->rho[i], vj = b->m[j] / ref->rho[j], vv = vi * vi + vj * vj;
            double dw = kernel_dw(&view->kernel, r), we_i = 0.0, we_j = 0.0;
            double pij = (ref->rho[j] * ref->p[i] + ref->rho[i] * ref->p[j]) / (ref->rho[i] + ref->rho[j]);
            for (int k = 0; k < dim; ++k) {
                we_i += ref->w[k][i] * d[k] / r;
                we_j += ref->w[k][j] * d[k] / r;
            }
            for (int k = 0; k < dim; ++k) {
                double stress =
                    !c->model.fluid.convective_stress
                        ? 0.0
                        : 0.5 * (ref->rho[i] * b->u[k][i] * we_i + ref->rho[j] * b->u[k][j] * we_j);
                a[k] += vv * dw / b->m[i] *
                        (stress - pij * d[k] / r + view->viscosity * (b->u[k][i] - b->u[k][j]) / r);
                background[k] -= c->material.background_pressure * vv * dw / b->m[i] * d[k] / r;
            }
        }
        if (pass == 0) {
            ref->rho[i] = b->m[i] * sum;
            ref->p[i] = view->sound_speed * view->sound_speed * (ref->rho[i] - view->density);
        }
        for (int k = 0; k < dim && pass; ++k) {
            ref->a[k][i] = a[k] + view->body_force[k];
            ref->background[k][i] = background[k];
        }
    }
}

static double *const *field_arrays(const struct particles *b, const char *name)
{
    const struct field *field = field_find(&b->fields, name);
    assert_non_null(field);
    return (double *const *)field->data;
}

/** Largest difference over components, relative to the largest value. */
static double difference(double *const got[3], double *const want[3], int dim, size_t n)
{
    double largest = 0.0, error = 0.0;
    for (int k = 0; k < dim; ++k)
        for (size_t i = 0; i < n; ++i) {
            largest = fmax(largest, fabs(want[k][i]));
            error = fmax(error, fabs(got[k][i] - want[k][i]));
        }
    return error / largest;
}

static void compare(int dim, const int cells[3], double jitter, int cluster, enum arithmetic arithmetic,
                    bool stress, const char *isa, double tolerance_rho, double tolerance_a)
{
    struct fluid_case c;
    assert_int_equal(fluid_case_create(&c, dim, cells, dx, jitter, 0.7, cluster, arithmetic, isa), 0);
    c.model.fluid.convective_stress = stress;
    assert_int_equal(fluid_start(c.fluid, 0.0), 0);
    /* a few steps, so that transport shifts, list ages and images differ from the start */
    double t = 0.0, dt = cluster ? 2e-6 : 1e-4;
    for (int step = 0; step < 3; ++step, t += dt) {
        assert_int_equal(fluid_begin_step(c.fluid, t, dt), 0);
        assert_int_equal(fluid_interface(c.fluid, false), 0);
        assert_int_equal(fluid_end_step(c.fluid), 0);
    }
    assert_int_equal(fluid_begin_step(c.fluid, t, dt), 0);
    assert_int_equal(fluid_interface(c.fluid, false), 0);
    const struct particles *b = fluid_particles(c.fluid);
    struct reference ref;
    double *memory = memory_create(11 * b->n, sizeof(double));
    ref.rho = memory;
    ref.p = memory + b->n;
    for (size_t k = 0; k < 3; ++k) {
        ref.a[k] = memory + (2 + k) * b->n;
        ref.background[k] = memory + (5 + k) * b->n;
        ref.w[k] = memory + (8 + k) * b->n;
        memcpy(ref.w[k], field_arrays(b, "TransportShift")[k], b->n * sizeof(double));
    }
    reference_make(&c, &ref, 0);
    double *const rho[3] = {b->rho}, *const rho_ref[3] = {ref.rho};
    double error_rho = difference(rho, rho_ref, 1, b->n);
    reference_make(&c, &ref, 1);
    assert_int_equal(fluid_end_step(c.fluid), 0);
    double error = difference(field_arrays(b, "Acceleration"), ref.a, dim, b->n);
    double error_background =
        difference(field_arrays(b, "BackgroundAcceleration"), ref.background, dim, b->n);
    if (!(error_rho < tolerance_rho && error < tolerance_a && error_background < tolerance_a))
        fail_msg("dim %d jitter %g cluster %d stress %d %s %s: errors %g %g %g", dim, jitter, cluster, stress,
                 isa, arithmetic == ARITHMETIC_DOUBLE ? "double" : "mixed", error_rho, error,
                 error_background);
    memory_free(memory);
    fluid_case_reset(&c);
}

static const char *const isas[] = {"baseline", "v3", "v4"};

static void sweeps_match_equations(void **state)
{
    (void)state;
    static const int cells[4][3] = {{0}, {57, 1, 1}, {23, 19, 1}, {11, 9, 13}};
    for (size_t s = 0; s < 3; ++s)
        for (int k = 0; k < 6; ++k) {
            const int dim = 1 + k % 3;
            const bool stress = k >= 3;
            if (!isa_available(isas[s]))
                continue;
            compare(dim, cells[dim], 0.0, 0, ARITHMETIC_DOUBLE, stress, isas[s], 1e-13, 1e-11);
            compare(dim, cells[dim], 0.2, 0, ARITHMETIC_DOUBLE, stress, isas[s], 1e-13, 1e-11);
            compare(dim, cells[dim], 0.2, 0, ARITHMETIC_MIXED, stress, isas[s], 2e-6, 5e-5);
            compare(dim, cells[dim], 0.1, 1, ARITHMETIC_DOUBLE, stress, isas[s], 1e-13, 1e-11);
            compare(dim, cells[dim], 0.1, 1, ARITHMETIC_MIXED, stress, isas[s], 2e-6, 5e-5);
        }
    /* a domain longer than the 2048 h at which places in mixed precision wrap around */
    static const int longer[3] = {2311, 1, 1};
    compare(1, longer, 0.2, 0, ARITHMETIC_MIXED, true, "auto", 2e-6, 5e-5);
}

/** Accelerations in a box that moves as a whole with (@p speed, -@p speed), by id. */
static void accelerations_when_moving(bool stress, double speed, double *a, size_t n)
{
    static const int cells[3] = {19, 23, 1};
    struct fluid_case c;
    assert_int_equal(fluid_case_create(&c, 2, cells, dx, 0.2, 0.3, 0, ARITHMETIC_DOUBLE, "auto"), 0);
    c.model.fluid.convective_stress = stress;
    struct particles *b = (struct particles *)fluid_particles(c.fluid);
    assert_int_equal(b->n, n);
    for (size_t i = 0; i < n; ++i) {
        b->u[0][i] += speed;
        b->u[1][i] -= speed;
    }
    assert_int_equal(fluid_start(c.fluid, 0.0), 0);
    for (int step = 0; step < 2; ++step) {
        assert_int_equal(fluid_begin_step(c.fluid, 1e-4 * step, 1e-4), 0);
        assert_int_equal(fluid_interface(c.fluid, false), 0);
        assert_int_equal(fluid_end_step(c.fluid), 0);
    }
    double *const *from = field_arrays(b, "Acceleration");
    for (size_t i = 0; i < n; ++i)
        for (size_t k = 0; k < 2; ++k)
            a[2 * (size_t)b->id[i] + k] = from[k][i];
    fluid_case_reset(&c);
}

/** A disordered box feels its own speed by the convective stress alone. */
static void frames_of_reference(void **state)
{
    (void)state;
    enum { N = 19 * 23 };
    static double a[2][2 * N];
    for (int stress = 0; stress < 2; ++stress) {
        double largest = 0.0, off = 0.0;
        for (int k = 0; k < 2; ++k)
            accelerations_when_moving(stress, 3.7 * k, a[k], N);
        for (size_t i = 0; i < 2 * (size_t)N; ++i) {
            largest = fmax(largest, fabs(a[0][i]));
            off = fmax(off, fabs(a[1][i] - a[0][i]));
        }
        print_message("convective stress %d: accelerations up to %g differ by %g\n", stress, largest, off);
        assert_true(stress ? off > 1e-3 * largest : off < 1e-9 * largest);
    }
}

/** Places and velocities after some steps, ordered by id. */
static void run_steps(int threads, double *result, size_t n)
{
    static const int cells[3] = {31, 27, 1};
    struct fluid_case c;
    parallel_setup(threads);
    assert_int_equal(fluid_case_create(&c, 2, cells, dx, 0.15, 0.9, 0, ARITHMETIC_MIXED, "auto"), 0);
    assert_int_equal(fluid_start(c.fluid, 0.0), 0);
    double t = 0.0, dt = 0.25 * dx / 11.0;
    for (int step = 0; step < 40; ++step, t += dt) {
        assert_int_equal(fluid_begin_step(c.fluid, t, dt), 0);
        assert_int_equal(fluid_interface(c.fluid, false), 0);
        assert_int_equal(fluid_end_step(c.fluid), 0);
    }
    const struct particles *b = fluid_particles(c.fluid);
    assert_int_equal(b->n, n);
    assert_true(fluid_rebuilds(c.fluid) > 2);
    for (size_t i = 0; i < n; ++i)
        for (size_t k = 0; k < 2; ++k) {
            result[4 * (size_t)b->id[i] + k] = b->x[k][i];
            result[4 * (size_t)b->id[i] + 2 + k] = b->u[k][i];
        }
    fluid_case_reset(&c);
}

static void threads_give_same_bytes(void **state)
{
    (void)state;
    enum { N = 31 * 27 };
    static double one[4 * N], other[4 * N];
    static const int threads[] = {2, 3, 7};
    run_steps(1, one, N);
    for (size_t k = 0; k < 3; ++k) {
        run_steps(threads[k], other, N);
        assert_memory_equal(one, other, sizeof one);
    }
    parallel_setup(0);
}

/** The sums are antisymmetric: momentum changes by the body force alone, up to the rounding of the sums. */
static void momentum_is_conserved(void **state)
{
    (void)state;
    static const int cells[3] = {17, 21, 1};
    struct fluid_case c;
    assert_int_equal(fluid_case_create(&c, 2, cells, dx, 0.2, 0.9, 0, ARITHMETIC_DOUBLE, "auto"), 0);
    assert_int_equal(fluid_start(c.fluid, 0.0), 0);
    const struct particles *b = fluid_particles(c.fluid);
    double before[2] = {0}, after[2] = {0}, size = 0.0, dt = 1e-4;
    for (size_t i = 0; i < b->n; ++i)
        for (int k = 0; k < 2; ++k) {
            before[k] += b->m[i] * b->u[k][i];
            size += b->m[i] * fabs(b->u[k][i]);
        }
    for (int step = 0; step < 20; ++step) {
        assert_int_equal(fluid_begin_step(c.fluid, step * dt, dt), 0);
        assert_int_equal(fluid_interface(c.fluid, false), 0);
        assert_int_equal(fluid_end_step(c.fluid), 0);
    }
    double mass = 0.0;
    for (size_t i = 0; i < b->n; ++i) {
        mass += b->m[i];
        for (int k = 0; k < 2; ++k)
            after[k] += b->m[i] * b->u[k][i];
    }
    for (int k = 0; k < 2; ++k)
        assert_true(fabs(after[k] - before[k] - 20 * dt * mass * (0.1 * k - 0.03)) < 1e-12 * size);
    fluid_case_reset(&c);
}

static void errors_are_reported(void **state)
{
    (void)state;
    static const int cells[3] = {17, 21, 1};
    struct fluid_case c;
    assert_int_equal(fluid_case_create(&c, 2, cells, dx, 0.0, 0.0, 0, ARITHMETIC_MIXED, "v9"), 64);
    fluid_case_reset(&c);
    assert_int_equal(fluid_case_create(&c, 2, cells, dx, 0.0, 0.3, 0, ARITHMETIC_MIXED, "auto"), 0);
    assert_int_equal(fluid_start(c.fluid, 0.0), 0);
    ((struct particles *)fluid_particles(c.fluid))->u[1][13] = NAN;
    assert_int_equal(fluid_begin_step(c.fluid, 0.0, 1e-4), 70);
    fluid_case_reset(&c);
    static const int small[3] = {17, 5, 1};
    assert_int_equal(fluid_case_create(&c, 2, small, dx, 0.0, 0.0, 0, ARITHMETIC_MIXED, "auto"), 65);
    fluid_case_reset(&c);
}

/** Two particles on one place. */
static void overlap_is_refused(void **state)
{
    (void)state;
    static const int cells[3] = {17, 21, 1};
    struct fluid_case c;
    assert_int_equal(fluid_case_create(&c, 2, cells, dx, 0.0, 0.3, 0, ARITHMETIC_MIXED, "auto"), 0);
    struct particles *b = (struct particles *)fluid_particles(c.fluid);
    b->x[0][40] = b->x[0][99];
    b->x[1][40] = b->x[1][99];
    assert_int_equal(fluid_start(c.fluid, 0.0), 65);
    fluid_case_reset(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sweeps_match_equations),  cmocka_unit_test(frames_of_reference),
        cmocka_unit_test(threads_give_same_bytes), cmocka_unit_test(momentum_is_conserved),
        cmocka_unit_test(errors_are_reported),     cmocka_unit_test(overlap_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

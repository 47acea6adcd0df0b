// SPDX-License-Identifier: GPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "wall/contact_sums_sweeps.h"

#define N 53

/** -1 ... 1 */
static double noise(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return (double)*seed / 2147483648.0 - 1.0;
}

/** The sums one particle after the other. */
static struct contact_sums sums_plain(const struct contact_sums_task *task)
{
    struct contact_sums sums = {0};
    for (uint32_t k = 0; k < task->n; ++k) {
        const uint32_t j = task->list[k];
        double d[3], height = 0.0, r2 = 0.0;
        for (int l = 0; l < 3; ++l) {
            d[l] = task->particles->x[l][j] - task->c[l];
            while (task->period[l] > 0.0 && fabs(d[l]) > 0.5 * task->period[l])
                d[l] -= copysign(task->period[l], d[l]);
            height += d[l] * task->normal[l];
            r2 += d[l] * d[l];
        }
        double w = kernel_w(task->kernel, sqrt(r2));
        if (task->per_ramp > 0.0 && j != task->self)
            w *= fmax(0.0, fmin(1.0, height * task->per_ramp));
        sums.weight += w;
        sums.p += w * task->particles->p[j];
        sums.rho += w * task->particles->rho[j];
        for (int l = 0; l < 3; ++l) {
            sums.u[l] += w * task->particles->u[l][j];
            sums.r[l] += w * d[l];
        }
    }
    return sums;
}

static void compare(double a, double b, double scale)
{
    if (!(fabs(a - b) <= 1e-13 * scale))
        fail_msg("%.17g instead of %.17g", a, b);
}

/** All instruction sets; lists that fill lanes partly; domains of a few supports, where what stands behind a
 * list must not come in as an image of something. */
static void test_plain(void **state)
{
    (void)state;
    static const uint32_t lengths[] = {1, 3, 15, 16, 17, 33, 48, N};
    static const double periods[] = {0.0, 2.0, 2.3, 3.1, 7.7}; // of the support
    uint32_t list[N], seed = 11;
    for (int dim = 2; dim <= 3; ++dim) {
        const struct kernel kernel = kernel_quintic(dim, 0.83, false);
        struct particles *p;
        assert_int_equal(particles_create(&p, "p", dim, N), 0);
        for (uint32_t j = 0; j < N; ++j) {
            const double x[3] = {3.1 + 2.6 * noise(&seed), 2.6 * noise(&seed),
                                 dim > 2 ? 2.6 * noise(&seed) : 0.0};
            size_t i;
            assert_int_equal(particles_append(p, PARTICLE_FLUID, x, 1.0, &i), 0);
            p->p[i] = 7.0 * noise(&seed);
            p->rho[i] = 1.0 + 0.02 * noise(&seed);
            for (int k = 0; k < dim; ++k)
                p->u[k][i] = noise(&seed);
            list[j] = (j * 29 + 5) % N;
        }
        for (size_t length = 0; length < sizeof lengths / sizeof *lengths; ++length)
            for (size_t period = 0; period < sizeof periods / sizeof *periods; ++period)
                for (int ramped = 0; ramped < 2; ++ramped) {
                    struct contact_sums_task task = {&kernel,
                                                     p,
                                                     list,
                                                     lengths[length],
                                                     list[0],
                                                     {2.2, -0.4, dim > 2 ? 0.3 : 0.0},
                                                     {0},
                                                     {0.6, dim > 2 ? 0.48 : 0.8, dim > 2 ? 0.64 : 0.0},
                                                     ramped ? 1.0 / 0.71 : 0.0};
                    for (int k = 0; k < dim; ++k)
                        task.period[k] = periods[period] * kernel.support;
                    const struct contact_sums expected = sums_plain(&task);
                    for (int isa = ISA_BASELINE; isa <= (int)isa_best(); ++isa) {
                        struct contact_sums sums;
                        contact_sums_of((enum isa)isa)(&task, &sums);
                        compare(sums.weight, expected.weight, 1.0);
                        compare(sums.p, expected.p, 7.0);
                        compare(sums.rho, expected.rho, 1.0);
                        for (int k = 0; k < 3; ++k) {
                            compare(sums.u[k], expected.u[k], 1.0);
                            compare(sums.r[k], expected.r[k], 1.0);
                        }
                    }
                }
        particles_destroy(p);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_plain)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "points.h"

#include "base/parallel.h"
#include "sph/shepard.h"

#include <math.h>
#include <stdlib.h>

enum { FIELDS = 2 };

/** What the particles at some points carry. */
struct carried {
    double m[POINTS_MOST], rho[POINTS_MOST], f[FIELDS][POINTS_MOST];
    uint8_t kind[POINTS_MOST];
};

static void carried_make(struct carried *carried, struct points *points)
{
    for (size_t i = 0; i < points->n; ++i) {
        carried->m[i] = 0.0173 * (1.5 + points_random(points));
        carried->rho[i] = 1.31 + 0.4 * points_random(points);
        carried->f[0][i] = 1e5 * points_random(points);
        carried->f[1][i] = 0.37 + points_random(points);
        carried->kind[i] = i % 7 == 3 ? PARTICLE_INFLOW : i % 11 == 5 ? PARTICLE_OUTFLOW : PARTICLE_FLUID;
    }
}

static struct shepard particles_of(const struct points *points, const struct cell_grid *grid,
                                   const struct kernel *kernel, const struct carried *carried)
{
    return (struct shepard){.kernel = kernel,
                            .grid = grid,
                            .x = {points->x[0], points->x[1], points->x[2]},
                            .m = carried->m,
                            .rho = carried->rho};
}

/** Quintic spline by its definition (paper 000 remark 5), in powers of the distance by h. */
static double spline(int dim, double h, double r)
{
    static const double norm[] = {1.0 / 120.0, 7.0 / (478.0 * M_PI), 1.0 / (120.0 * M_PI)};
    double w = 0.0;
    if (r < 3.0 * h)
        w += pow(3.0 - r / h, 5.0);
    if (r < 2.0 * h)
        w -= 6.0 * pow(2.0 - r / h, 5.0);
    if (r < h)
        w += 15.0 * pow(1.0 - r / h, 5.0);
    return norm[dim - 1] / pow(h, dim) * w;
}

/** Sums over all particles and all their images: returns sum V W. */
static double sums_by_force(const struct points *points, const struct carried *carried, double h,
                            bool only_fluid, const double x[3], double sums[FIELDS])
{
    double weight = 0.0;
    sums[0] = sums[1] = 0.0;
    for (int image = 0; image < 27; ++image) {
        double shift[3];
        if (!points_image(points, image, shift))
            continue;
        for (size_t i = 0; i < points->n; ++i) {
            const double y[3] = {points->x[0][i], points->x[1][i], points->x[2][i]};
            const double w =
                carried->m[i] / carried->rho[i] * spline(points->dim, h, points_distance(x, y, shift));
            if (only_fluid && carried->kind[i] != PARTICLE_FLUID)
                continue;
            weight += w;
            sums[0] += w * carried->f[0][i];
            sums[1] += w * carried->f[1][i];
        }
    }
    return weight;
}

/** Compare at places in the domain and a little outside; returns how many see no particle. */
static int compare(struct points *points, const struct shepard *particles, const struct carried *carried)
{
    const double *const values[FIELDS] = {carried->f[0], carried->f[1]};
    int empty = 0;
    for (int q = 0; q < 80; ++q) {
        double x[3] = {0.0, 0.0, 0.0}, means[FIELDS], sums[FIELDS];
        for (int k = 0; k < points->dim; ++k)
            x[k] = points->lower[k] +
                   (0.5 + 0.6 * points_random(points)) * (points->upper[k] - points->lower[k]);
        const double support = shepard_means(particles, x, FIELDS, values, means);
        const double weight =
            sums_by_force(points, carried, particles->kernel->h, particles->kind != NULL, x, sums);
        assert_true(fabs(support - weight) <= 1e-13 * weight);
        for (int v = 0; v < FIELDS; ++v)
            assert_true(weight > 0.0 ? fabs(means[v] * weight - sums[v]) <= 1e-12 * 1e5 * weight
                                     : isnan(means[v]));
        empty += !(weight > 0.0);
    }
    return empty;
}

static void test_brute_force(void **state)
{
    (void)state;
    static struct points points;
    static struct carried carried;
    int empty = 0;
    for (int dim = 1; dim <= 3; ++dim)
        for (int kind = 0; kind < POINTS_KINDS; ++kind) {
            // periodic sides of 1.2 m, kernels that reach 0.36 m
            const struct kernel kernel = kernel_quintic(dim, 0.12, false);
            struct cell_grid grid;
            points_make(&points, dim, kind, dim == 1 ? 40 : 900);
            points_grid(&points, &grid);
            points_sort(&points, &grid);
            carried_make(&carried, &points);
            struct shepard particles = particles_of(&points, &grid, &kernel, &carried);
            empty += compare(&points, &particles, &carried);
            particles.kind = carried.kind;
            empty += compare(&points, &particles, &carried);
            cell_grid_reset(&grid);
        }
    assert_true(empty > 10);
}

/** What a periodic image sees is the same. */
static void test_images(void **state)
{
    (void)state;
    static struct points points;
    static struct carried carried;
    for (int dim = 1; dim <= 3; ++dim) {
        const struct kernel kernel = kernel_quintic(dim, 0.117, false);
        struct cell_grid grid;
        points_make(&points, dim, POINTS_PERIODIC, 800);
        points_grid(&points, &grid);
        points_sort(&points, &grid);
        carried_make(&carried, &points);
        const struct shepard particles = particles_of(&points, &grid, &kernel, &carried);
        const double *const values[FIELDS] = {carried.f[0], carried.f[1]};
        const int side = dim == 1 ? 0 : dim - 1; // the last direction is periodic
        for (int q = 0; q < 40; ++q) {
            double x[3] = {0.21, 0.33, 1.7}, one[FIELDS], other[FIELDS];
            for (int k = dim; k < 3; ++k)
                x[k] = 0.0;
            x[side] = points.lower[side] + 0.2 * points_random(&points);
            const double here = shepard_means(&particles, x, FIELDS, values, one);
            x[side] += points.upper[side] - points.lower[side];
            const double there = shepard_means(&particles, x, FIELDS, values, other);
            assert_true(here > 0.0 && fabs(here - there) <= 1e-12 * here);
            for (int v = 0; v < FIELDS; ++v)
                assert_true(fabs(one[v] - other[v]) <= 1e-12 * 1e5);
        }
        cell_grid_reset(&grid);
    }
}

/** Fourier transform of the kernel at wave number @p k and its derivative, by Simpson's rule. */
static double transform(const struct kernel *kernel, double k, double *derivative)
{
    enum { N = 3000 }; // intervals
    double sum = 0.0, slope = 0.0;
    for (int i = 0; i <= N; ++i) {
        const double r = kernel->support * i / N, w = kernel_w(kernel, r), q = k * r;
        const double weight = kernel->support / N / 3.0 * (i == 0 || i == N ? 1.0 : i % 2 ? 4.0 : 2.0);
        if (kernel->dim == 1) {
            sum += weight * 2.0 * w * cos(q);
            slope -= weight * 2.0 * w * r * sin(q);
        } else if (kernel->dim == 2) {
            sum += weight * 2.0 * M_PI * w * r * j0(q);
            slope -= weight * 2.0 * M_PI * w * r * r * j1(q);
        } else if (r > 0.0) {
            sum += weight * 4.0 * M_PI * w * r * sin(q) / k;
            slope += weight * 4.0 * M_PI * w * (q * cos(q) - sin(q)) * r / (k * k);
        }
    }
    *derivative = slope;
    return sum;
}

/** On a lattice of spacing @p dx the sums differ from the integrals by the transform at the vectors G of the
 * reciprocal lattice (Poisson): sum V W (x_j - x) has a component of at most sum |W^'(|G|)| |G_x| / |G|, sum
 * V W is at least 1 - sum |W^(|G|)|. The largest error of a field of slope 1 along x. */
static double lattice_bound(const struct kernel *kernel, double dx)
{
    double above = 0.0, below = 1.0;
    for (int a = -2; a <= 2; ++a)
        for (int b = kernel->dim > 1 ? -2 : 0; b <= (kernel->dim > 1 ? 2 : 0); ++b)
            for (int c = kernel->dim > 2 ? -2 : 0; c <= (kernel->dim > 2 ? 2 : 0); ++c) {
                const double n = sqrt(a * a + b * b + c * c);
                double slope;
                if (n == 0.0)
                    continue;
                below -= fabs(transform(kernel, 2.0 * M_PI * n / dx, &slope));
                above += fabs(slope) * abs(a) / n;
            }
    return above / below;
}

/** A lattice of @p side points in each direction; the field is the coordinate along x. */
static void lattice_make(struct points *points, struct carried *carried, int dim, int side, double dx)
{
    *points = (struct points){.dim = dim, .n = 1, .seed = 5 + (uint64_t)dim};
    for (int k = 0; k < dim; ++k) {
        points->n *= (size_t)side;
        points->lower[k] = -0.21;
        points->upper[k] = -0.21 + side * dx;
    }
    assert_true(points->n <= POINTS_MOST);
    for (size_t i = 0; i < points->n; ++i) {
        size_t rest = i;
        for (int k = 0; k < dim; ++k, rest /= (size_t)side)
            points->x[k][i] = points->lower[k] + ((double)(rest % (size_t)side) + 0.5) * dx;
        carried->rho[i] = 1.7;
        carried->m[i] = 1.7 * pow(dx, dim);
    }
}

/** Largest error of a linear field in the middle of the lattice, where no side is in reach. */
static double lattice_error(int dim, double ratio, double *bound)
{
    static struct points points;
    static struct carried carried;
    const double dx = 0.0613;
    const struct kernel kernel = kernel_quintic(dim, ratio * dx, false);
    struct cell_grid grid;
    const int side = dim == 1 ? 41 : dim == 2 ? 29 : 9;
    lattice_make(&points, &carried, dim, side, dx);
    assert_int_equal(cell_grid_create(&grid, dim, points.lower, points.upper, points.periodic, kernel.support,
                                      kernel.support, dx),
                     0);
    points_sort(&points, &grid);
    memcpy(carried.f[0], points.x[0], sizeof carried.f[0]);
    const struct shepard particles = particles_of(&points, &grid, &kernel, &carried);
    const double *const values[] = {carried.f[0]};
    double worst = 0.0;
    for (int q = 0; q < 400; ++q) {
        double x[3] = {0.0, 0.0, 0.0}, mean;
        for (int k = 0; k < dim; ++k)
            x[k] = 0.5 * (points.lower[k] + points.upper[k] + dx * points_random(&points));
        assert_true(shepard_means(&particles, x, 1, values, &mean) > 0.9);
        worst = fmax(worst, fabs(mean - x[0]));
    }
    cell_grid_reset(&grid);
    *bound = lattice_bound(&kernel, dx);
    print_message("%d-D, h = %g dx: a linear field is off by up to %.3g dx, at most %.3g dx by theory\n", dim,
                  ratio, worst / dx, *bound / dx);
    return worst;
}

static void test_linear_field(void **state)
{
    (void)state;
    double bound;
    // with h = dx the kernel in 1-D is the cardinal B-spline of degree 5, which reproduces linear fields
    assert_true(lattice_error(1, 1.0, &bound) < 1e-15);
    static const struct {
        int dim;
        double ratio;
    } cases[] = {{1, 1.13}, {2, 1.0}, {2, 1.2}, {3, 1.0}};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; ++c) {
        const double error = lattice_error(cases[c].dim, cases[c].ratio, &bound);
        assert_true(error <= 1.001 * bound && error > 0.3 * bound);
    }
}

static int single(void **state)
{
    (void)state;
    parallel_setup(1);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_brute_force),
        cmocka_unit_test(test_images),
        cmocka_unit_test(test_linear_field),
    };
    return cmocka_run_group_tests(tests, single, NULL);
}

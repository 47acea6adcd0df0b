// SPDX-License-Identifier: GPL-3.0-or-later
// What this machine can do at most: fused multiply-adds of one core in double precision, and memory traffic
// of all threads together (triad). Prints one line of JSON, so that rates of different machines can be
// compared.

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#ifdef _OPENMP
#include <omp.h>
#endif

#define LANES 8
#define CHAINS 12 // independent sums, enough to hide the latency of a multiply-add in two units
#define TRIAD_DOUBLES 16000000L

typedef double vector __attribute__((vector_size(LANES * sizeof(double))));

static double seconds_now(void)
{
    struct timespec now;

    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/** The body is compiled once per instruction set below. */
static inline __attribute__((always_inline)) double multiply_add(long rounds)
{
    vector sum[CHAINS], factor, term;
    double total = 0.0;

    for (int l = 0; l < LANES; l++) {
        factor[l] = 1.0 - 1e-9 * l;
        term[l] = 1e-9 * (l + 1);
    }
    for (int c = 0; c < CHAINS; c++)
        sum[c] = factor * (1.0 + 0.01 * c);
    for (long i = 0; i < rounds; i++) {
#pragma GCC unroll 12
        for (int c = 0; c < CHAINS; c++)
            sum[c] = sum[c] * factor + term;
    }
    for (int c = 0; c < CHAINS; c++)
        for (int l = 0; l < LANES; l++)
            total += sum[c][l];
    return total;
}

static double multiply_add_baseline(long rounds)
{
    return multiply_add(rounds);
}

#ifdef __x86_64__
__attribute__((target("avx2,fma"))) static double multiply_add_v3(long rounds)
{
    return multiply_add(rounds);
}

__attribute__((target("avx512f,avx2,fma"))) static double multiply_add_v4(long rounds)
{
    return multiply_add(rounds);
}
#endif

typedef double multiply_add_function(long rounds);

static multiply_add_function *multiply_add_choose(void)
{
#ifdef __x86_64__
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f"))
        return multiply_add_v4;
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        return multiply_add_v3;
#endif
    return multiply_add_baseline;
}

/** Best of several tries, so that others on the machine count little. */
static double measure_multiply_add(double *witness)
{
    multiply_add_function *function = multiply_add_choose();
    const long rounds = 4000000;
    double best = 0.0;

    for (int trial = 0; trial < 5; trial++) {
        double start = seconds_now();
        *witness += function(rounds);
        double rate = 2.0 * LANES * CHAINS * (double)rounds / (seconds_now() - start) * 1e-9;
        best = rate > best ? rate : best;
    }
    return best;
}

static double measure_triad(double *witness)
{
    double *a = malloc(TRIAD_DOUBLES * sizeof *a), *b = malloc(TRIAD_DOUBLES * sizeof *b),
           *c = malloc(TRIAD_DOUBLES * sizeof *c), best = 0.0;

    if (a && b && c) {
#pragma omp parallel for schedule(static)
        for (long i = 0; i < TRIAD_DOUBLES; i++) {
            a[i] = 0.0;
            b[i] = 1.0;
            c[i] = 2.0;
        }
        for (int trial = 0; trial < 8; trial++) {
            double start = seconds_now();
#pragma omp parallel for schedule(static)
            for (long i = 0; i < TRIAD_DOUBLES; i++)
                a[i] = b[i] + (1.5 + trial) * c[i];
            double rate = 3.0 * sizeof *a * (double)TRIAD_DOUBLES / (seconds_now() - start) * 1e-9;
            best = rate > best ? rate : best;
        }
        *witness += a[TRIAD_DOUBLES / 3];
    }
    free(a);
    free(b);
    free(c);
    return best;
}

int main(void)
{
    double witness = 0.0;
    double multiply_adds = measure_multiply_add(&witness), triad = measure_triad(&witness);
    int threads = 1;

#ifdef _OPENMP
    threads = omp_get_max_threads();
#endif
    if (triad <= 0.0 || witness == 0.0) { // using the witness keeps the loops from being removed
        fprintf(stderr, "skerry-machine: error: needs %ld MB of memory for the triad\n",
                3 * TRIAD_DOUBLES * (long)sizeof(double) / 1000000);
        return 71;
    }
    printf("{\"fma_gflops_core\": %.1f, \"triad_gbs\": %.1f, \"threads\": %d}\n", multiply_adds, triad,
           threads);
    return 0;
}

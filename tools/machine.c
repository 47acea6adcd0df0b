// SPDX-License-Identifier: GPL-3.0-or-later
// What this machine can do at most: fused multiply-adds in double and single precision, and memory traffic
// (triad), of one core and of all threads together. Prints one line of JSON, so that rates of different
// machines can be compared.

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#ifdef _OPENMP
#include <omp.h>
#endif

enum {
    WIDTH = 64,  // bytes of a vector
    CHAINS = 12, // independent sums, enough to hide the latency of a multiply-add in two units
    TRIALS = 5   // the best one counts, so that others on the machine count little
};

#define TRIAD_DOUBLES 16000000L

typedef double doubles __attribute__((vector_size(WIDTH)));
typedef float floats __attribute__((vector_size(WIDTH)));
typedef double multiply_add_function(long rounds);

static double seconds_now(void)
{
    struct timespec now;

    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void threads_set(int threads)
{
#ifdef _OPENMP
    omp_set_num_threads(threads);
#else
    (void)threads;
#endif
}

// The body is compiled once per number type and instruction set below.
#define MULTIPLY_ADD(vector, number)                                                                         \
    static inline __attribute__((always_inline)) double multiply_add_##vector(long rounds)                   \
    {                                                                                                        \
        enum { LANES = WIDTH / sizeof(number) };                                                             \
        vector sum[CHAINS], factor, term;                                                                    \
        double total = 0.0;                                                                                  \
        for (int l = 0; l < LANES; l++) {                                                                    \
            factor[l] = (number)(1.0 - 1e-6 * l);                                                            \
            term[l] = (number)(1e-6 * (l + 1));                                                              \
        }                                                                                                    \
        for (int c = 0; c < CHAINS; c++)                                                                     \
            sum[c] = factor * (number)(1.0 + 0.01 * c);                                                      \
        for (long i = 0; i < rounds; i++) {                                                                  \
            _Pragma("GCC unroll 12") for (int c = 0; c < CHAINS; c++) sum[c] = sum[c] * factor + term;       \
        }                                                                                                    \
        for (int c = 0; c < CHAINS; c++)                                                                     \
            for (int l = 0; l < LANES; l++)                                                                  \
                total += (double)sum[c][l];                                                                  \
        return total;                                                                                        \
    }

#define MULTIPLY_ADD_FOR(vector, isa, attribute)                                                             \
    attribute static double multiply_add_##vector##_##isa(long rounds)                                       \
    {                                                                                                        \
        return multiply_add_##vector(rounds);                                                                \
    }

MULTIPLY_ADD(doubles, double)
MULTIPLY_ADD(floats, float)
MULTIPLY_ADD_FOR(doubles, baseline, )
MULTIPLY_ADD_FOR(floats, baseline, )
#ifdef __x86_64__
MULTIPLY_ADD_FOR(doubles, v3, __attribute__((target("avx2,fma"))))
MULTIPLY_ADD_FOR(floats, v3, __attribute__((target("avx2,fma"))))
MULTIPLY_ADD_FOR(doubles, v4, __attribute__((target("avx512f,avx2,fma"))))
MULTIPLY_ADD_FOR(floats, v4, __attribute__((target("avx512f,avx2,fma"))))
#endif

static void multiply_add_choose(multiply_add_function *functions[2])
{
    functions[0] = multiply_add_doubles_baseline;
    functions[1] = multiply_add_floats_baseline;
#ifdef __x86_64__
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f")) {
        functions[0] = multiply_add_doubles_v4;
        functions[1] = multiply_add_floats_v4;
    } else if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
        functions[0] = multiply_add_doubles_v3;
        functions[1] = multiply_add_floats_v3;
    }
#endif
}

/** GFLOP/s of all threads together. */
static double multiply_add_measure(multiply_add_function *function, int lanes, int threads, double *witness)
{
    const long rounds = 4000000;
    double best = 0.0, sum = 0.0;

    threads_set(threads);
    for (int trial = 0; trial < TRIALS; trial++) {
        double start = seconds_now();
#pragma omp parallel for schedule(static, 1) reduction(+ : sum)
        for (int t = 0; t < threads; t++)
            sum += function(rounds);
        double rate = 2.0 * lanes * CHAINS * threads * (double)rounds / (seconds_now() - start) * 1e-9;
        best = rate > best ? rate : best;
    }
    *witness += sum;
    return best;
}

/** GB/s of all threads together; 0: not enough memory. */
static double triad_measure(int threads, double *witness)
{
    double *a = malloc(TRIAD_DOUBLES * sizeof *a), *b = malloc(TRIAD_DOUBLES * sizeof *b),
           *c = malloc(TRIAD_DOUBLES * sizeof *c), best = 0.0;

    threads_set(threads);
    if (a && b && c) {
#pragma omp parallel for schedule(static)
        for (long i = 0; i < TRIAD_DOUBLES; i++) {
            a[i] = 0.0;
            b[i] = 1.0;
            c[i] = 2.0;
        }
        for (int trial = 0; trial < TRIALS; trial++) {
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

int main(int argc, char **argv)
{
    multiply_add_function *functions[2];
    const int lanes[2] = {WIDTH / sizeof(double), WIDTH / sizeof(float)};
    double witness = 0.0, rates[2][2], triads[2];
    int threads[2] = {1, 1}; // the second: all

#ifdef _OPENMP
    threads[1] = omp_get_max_threads();
    if (argc == 3 && strcmp(argv[1], "-j") == 0)
        threads[1] = atoi(argv[2]);
#endif
    if ((argc != 1 && argc != 3) || threads[1] < 1) {
        fprintf(stderr, "usage: skerry-machine [-j THREADS]\n");
        return 64;
    }
    multiply_add_choose(functions);
    for (int t = 0; t < 2; t++) {
        for (int k = 0; k < 2; k++)
            rates[t][k] = multiply_add_measure(functions[k], lanes[k], threads[t], &witness);
        triads[t] = triad_measure(threads[t], &witness);
    }
    if (triads[0] <= 0.0 || triads[1] <= 0.0 ||
        witness == 0.0) { // its use keeps the loops from being removed
        fprintf(stderr, "skerry-machine: error: needs %ld MB of memory for the triad\n",
                3 * TRIAD_DOUBLES * (long)sizeof(double) / 1000000);
        return 71;
    }
    printf("{\"fma_gflops_core\": %.1f, \"fma_gflops_float_core\": %.1f, \"triad_gbs_core\": %.1f, "
           "\"fma_gflops\": %.1f, \"fma_gflops_float\": %.1f, \"triad_gbs\": %.1f, \"threads\": %d}\n",
           rates[0][0], rates[0][1], triads[0], rates[1][0], rates[1][1], triads[1], threads[1]);
    return 0;
}

// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FLUID_SWEEP_VECTOR_H
#define FLUID_SWEEP_VECTOR_H

/* The lanes of a cluster as native vectors of the compiler's vector extension (gcc, clang), which stay in
 * registers. Loops over lanes left to the vectoriser lost it as soon as the code around them changed (up to
 * eight times slower, gcc 12). Only the root needs intrinsics: the extension has no name for it. */

#include <math.h>
#include <stdint.h>
#ifdef __SSE__
#include <immintrin.h>
#endif

typedef SWEEP_REAL real;

/** Bytes of a vector register of this instruction set. */
#if defined __AVX512F__
#define SWEEP_BYTES 64
#elif defined __AVX__
#define SWEEP_BYTES 32
#else
#define SWEEP_BYTES 16
#endif

typedef real vreal __attribute__((vector_size(SWEEP_BYTES)));

/** Particles per vector. */
enum { SWEEP_WIDTH = SWEEP_BYTES / (int)sizeof(real) };

#define SWEEP_INLINE static inline __attribute__((always_inline))

/** Twice the positive part: x + |x| needs no comparison; kernels absorb the powers of two exactly. */
SWEEP_INLINE vreal twice_positive(vreal x)
{
    if (sizeof(real) == sizeof(float)) {
        typedef uint32_t bits __attribute__((vector_size(SWEEP_BYTES)));
        return x + (vreal)((bits)x & 0x7fffffffu);
    }
    typedef uint64_t bits __attribute__((vector_size(SWEEP_BYTES)));
    return x + (vreal)((bits)x & 0x7fffffffffffffffu);
}

/** 1/sqrt(x) for x > 0: in float the hardware's estimate and one Newton step (2e-7), in double exact. */
SWEEP_INLINE vreal inverse_root(vreal x)
{
#if defined __AVX512F__
    if (sizeof(real) == sizeof(double))
        return (real)1 / (vreal)_mm512_sqrt_pd((__m512d)x);
    const vreal y = (vreal)_mm512_rsqrt14_ps((__m512)x);
#elif defined __AVX__
    if (sizeof(real) == sizeof(double))
        return (real)1 / (vreal)_mm256_sqrt_pd((__m256d)x);
    const vreal y = (vreal)_mm256_rsqrt_ps((__m256)x);
#elif defined __SSE2__
    if (sizeof(real) == sizeof(double))
        return (real)1 / (vreal)_mm_sqrt_pd((__m128d)x);
    const vreal y = (vreal)_mm_rsqrt_ps((__m128)x);
#else
    vreal y = x;
    for (int l = 0; l < SWEEP_WIDTH; ++l)
        y[l] = (real)(1.0 / sqrt((double)x[l]));
    if (sizeof(real) == sizeof(double))
        return y;
#endif
    return y * ((real)1.5 - (real)0.5 * x * y * y);
}

#endif

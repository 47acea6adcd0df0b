// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef SPH_SWEEP_VECTOR_H
#define SPH_SWEEP_VECTOR_H

/* The lanes of a cluster as native vectors of the compiler's vector extension (gcc, clang), which stay in
 * registers. Loops over lanes left to the vectoriser lost it as soon as the code around them changed (up to
 * eight times slower, gcc 12). Only what the extension has no name for needs intrinsics: roots, maxima,
 * reciprocals and masks. For files that are compiled once per instruction set (SWEEP_ISA) and precision of
 * the pair arithmetic (SWEEP_MANTISSA, its bits; SWEEP_PRECISION, its name). */

#include <math.h>
#include <stdint.h>
#ifdef __SSE__
#include <immintrin.h>
#endif

/** Whether the pair arithmetic is in float. */
#define SWEEP_SINGLE (SWEEP_MANTISSA == 24)

#if SWEEP_SINGLE
typedef float real;
#else
typedef double real;
#endif

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

/** Name of an object of this compilation: what_ISA_PRECISION. */
#define SWEEP_JOIN_(what, isa, precision) what##_##isa##_##precision
#define SWEEP_JOIN(what, isa, precision) SWEEP_JOIN_(what, isa, precision)
#define SWEEP_NAME(what) SWEEP_JOIN(what, SWEEP_ISA, SWEEP_PRECISION)

/** The positive part of x. */
SWEEP_INLINE vreal positive(vreal x)
{
#if defined __AVX512F__
    if (SWEEP_SINGLE)
        return (vreal)_mm512_max_ps((__m512)x, _mm512_setzero_ps());
    return (vreal)_mm512_max_pd((__m512d)x, _mm512_setzero_pd());
#elif defined __AVX__
    if (SWEEP_SINGLE)
        return (vreal)_mm256_max_ps((__m256)x, _mm256_setzero_ps());
    return (vreal)_mm256_max_pd((__m256d)x, _mm256_setzero_pd());
#elif defined __SSE2__
    if (SWEEP_SINGLE)
        return (vreal)_mm_max_ps((__m128)x, _mm_setzero_ps());
    return (vreal)_mm_max_pd((__m128d)x, _mm_setzero_pd());
#else
    for (int l = 0; l < SWEEP_WIDTH; ++l)
        x[l] = x[l] > (real)0 ? x[l] : (real)0;
    return x;
#endif
}

/** |x| */
SWEEP_INLINE vreal absolute(vreal x)
{
    typedef uint32_t single __attribute__((vector_size(SWEEP_BYTES)));
    typedef uint64_t full __attribute__((vector_size(SWEEP_BYTES)));
    return SWEEP_SINGLE ? (vreal)((single)x & 0x7fffffffu) : (vreal)((full)x & 0x7fffffffffffffffu);
}

/** Estimate of 1/sqrt(x) for x > 0: in float good to 4e-4 at least (2e-4 with AVX-512), in double exact. */
SWEEP_INLINE vreal inverse_root_estimate(vreal x)
{
#if defined __AVX512F__
    if (SWEEP_SINGLE)
        return (vreal)_mm512_rsqrt14_ps((__m512)x);
    return (real)1 / (vreal)_mm512_sqrt_pd((__m512d)x);
#elif defined __AVX__
    if (SWEEP_SINGLE)
        return (vreal)_mm256_rsqrt_ps((__m256)x);
    return (real)1 / (vreal)_mm256_sqrt_pd((__m256d)x);
#elif defined __SSE2__
    if (SWEEP_SINGLE)
        return (vreal)_mm_rsqrt_ps((__m128)x);
    return (real)1 / (vreal)_mm_sqrt_pd((__m128d)x);
#else
    for (int l = 0; l < SWEEP_WIDTH; ++l)
        x[l] = (real)(1.0 / sqrt((double)x[l]));
    return x;
#endif
}

/** Of x = q^2 > 0 the root @p twice_q = 2 q and @p twice_inverse = 2 / q: the Newton step without its factor
 * 1/2, which constants elsewhere absorb. In float good to 2e-7, in double exact. */
SWEEP_INLINE void twice_root(vreal x, vreal *twice_q, vreal *twice_inverse)
{
    const vreal y = inverse_root_estimate(x), q = x * y;
    const vreal correction = SWEEP_SINGLE ? (real)3 - q * y : (real)2 + (vreal){0};
    *twice_q = q * correction;
    *twice_inverse = y * correction;
}

/** 1/x, where a relative error of 4e-4 does no harm: estimated in float, exact in double. */
SWEEP_INLINE vreal inverse_estimate(vreal x)
{
#if defined __AVX512F__
    if (SWEEP_SINGLE)
        return (vreal)_mm512_rcp14_ps((__m512)x);
#elif defined __AVX__
    if (SWEEP_SINGLE)
        return (vreal)_mm256_rcp_ps((__m256)x);
#elif defined __SSE2__
    if (SWEEP_SINGLE)
        return (vreal)_mm_rcp_ps((__m128)x);
#endif
    return (real)1 / x;
}

/** Bit l: whether x[l] < limit. */
SWEEP_INLINE unsigned below(vreal x, real limit)
{
#if defined __AVX512F__
    if (SWEEP_SINGLE)
        return _mm512_cmp_ps_mask((__m512)x, _mm512_set1_ps((float)limit), _CMP_LT_OQ);
    return _mm512_cmp_pd_mask((__m512d)x, _mm512_set1_pd(limit), _CMP_LT_OQ);
#elif defined __AVX__
    if (SWEEP_SINGLE)
        return (unsigned)_mm256_movemask_ps(
            _mm256_cmp_ps((__m256)x, _mm256_set1_ps((float)limit), _CMP_LT_OQ));
    return (unsigned)_mm256_movemask_pd(_mm256_cmp_pd((__m256d)x, _mm256_set1_pd(limit), _CMP_LT_OQ));
#elif defined __SSE2__
    if (SWEEP_SINGLE)
        return (unsigned)_mm_movemask_ps(_mm_cmplt_ps((__m128)x, _mm_set1_ps((float)limit)));
    return (unsigned)_mm_movemask_pd(_mm_cmplt_pd((__m128d)x, _mm_set1_pd(limit)));
#else
    unsigned bits = 0;
    for (int l = 0; l < SWEEP_WIDTH; ++l)
        bits |= (unsigned)(x[l] < limit) << l;
    return bits;
#endif
}

#endif

/* Numbers of several runs side by side, one a lane, by the vector types of GCC and Clang. A comparison gives
 * a mask: all bits of a lane where it holds, none where not. */
#ifndef INERTANCE_WIDE_H
#define INERTANCE_WIDE_H

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#if defined __AVX__
#include <immintrin.h>
#endif

#if defined __AVX512DQ__
#define LANES 8
#else
#define LANES 4
#endif

typedef double wide __attribute__((vector_size(8 * LANES)));
typedef long long mask __attribute__((vector_size(8 * LANES)));

static inline wide all(double value) { return value - (wide){0}; }

static inline wide chosen(mask where, wide a, wide b) {
    return (wide)((where & (mask)a) | (~where & (mask)b));
}

static inline wide one(mask where) { return (wide)(where & (mask)all(1)); }

static inline wide only(mask where, wide a) { return (wide)(where & (mask)a); }

/* The lanes where a mask holds, as bits. */
static inline unsigned lanes_of(mask where) {
#if defined __AVX512DQ__
    return (unsigned)_mm512_movepi64_mask((__m512i)where);
#elif defined __AVX__
    return (unsigned)_mm256_movemask_pd((__m256d)where);
#else
    unsigned bits = 0;
    for (int k = 0; k < LANES; k++) bits |= where[k] ? 1u << k : 0;
    return bits;
#endif
}

static inline mask mask_of(unsigned lanes) {
#if defined __AVX512DQ__
    return (mask)_mm512_movm_epi64((__mmask8)lanes);
#else
    mask where;
    for (int k = 0; k < LANES; k++) where[k] = lanes >> k & 1 ? -1 : 0;
    return where;
#endif
}

static inline wide wide_fabs(wide a) { return (wide)((mask)a & ~(mask)all(-0.0)); }
static inline wide wide_greater(wide a, wide b) { return chosen(a > b, a, b); }
static inline wide wide_lesser(wide a, wide b) { return chosen(a < b, a, b); }
static inline wide wide_fmax(wide a, wide b) { return chosen((a > b) | (b != b), a, b); }
static inline wide wide_fmin(wide a, wide b) { return chosen((a < b) | (b != b), a, b); }
static inline wide wide_sign(wide a) { return chosen(a > 0, all(1), chosen(a < 0, all(-1), a)); }
static inline mask is_finite(wide a) { return wide_fabs(a) <= all(DBL_MAX); }
static inline mask nonzero(wide a) { return a != 0; }

static inline wide wide_sqrt(wide a) {
#if defined __AVX512DQ__
    return (wide)_mm512_sqrt_pd((__m512d)a);
#elif defined __AVX__
    return (wide)_mm256_sqrt_pd((__m256d)a);
#else
    for (int k = 0; k < LANES; k++) a[k] = sqrt(a[k]);
    return a;
#endif
}

#define LANE_BY_LANE(name)                                 \
    static inline wide wide_##name(wide a) {               \
        for (int k = 0; k < LANES; k++) a[k] = name(a[k]); \
        return a;                                          \
    }
#define PAIR_BY_PAIR(name)                                       \
    static inline wide wide_##name(wide a, wide b) {             \
        for (int k = 0; k < LANES; k++) a[k] = name(a[k], b[k]); \
        return a;                                                \
    }

/* glibc has vector functions, wrong by up to 4 units in the last place, under the names of the vector ABI. */
#if defined __x86_64__ && defined __AVX2__ && defined __GLIBC__ && __GLIBC_PREREQ(2, 35)
#define JOINED(a, b) a##b
#if LANES == 8
#define ABI_1(name) JOINED(_ZGVeN8v_, name)
#define ABI_2(name) JOINED(_ZGVeN8vv_, name)
#else
#define ABI_1(name) JOINED(_ZGVdN4v_, name)
#define ABI_2(name) JOINED(_ZGVdN4vv_, name)
#endif
#define VECTOR_1(name)      \
    wide ABI_1(name)(wide); \
    static inline wide wide_##name(wide a) { return ABI_1(name)(a); }
#define VECTOR_2(name)            \
    wide ABI_2(name)(wide, wide); \
    static inline wide wide_##name(wide a, wide b) { return ABI_2(name)(a, b); }
#else
#define VECTOR_1 LANE_BY_LANE
#define VECTOR_2 PAIR_BY_PAIR
#endif

VECTOR_1(sin)
VECTOR_1(cos)
VECTOR_1(tan)
VECTOR_1(asin)
VECTOR_1(acos)
VECTOR_1(atan)
VECTOR_1(sinh)
VECTOR_1(cosh)
VECTOR_1(tanh)
VECTOR_1(asinh)
VECTOR_1(acosh)
VECTOR_1(atanh)
VECTOR_1(exp)
VECTOR_1(expm1)
VECTOR_1(log)
VECTOR_1(log1p)
VECTOR_1(erf)
VECTOR_2(pow)
VECTOR_2(atan2)
VECTOR_2(hypot)
LANE_BY_LANE(floor)
LANE_BY_LANE(ceil)
PAIR_BY_PAIR(fmod)
PAIR_BY_PAIR(remainder)
PAIR_BY_PAIR(copysign)

#endif

/* What both fuzz drivers share: numbers that a caller should not send, drawn from a seed. */
#ifndef FUZZ_H
#define FUZZ_H

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "fmi_common.h"

#define LONGEST 30     /* calls in a sequence */
#define PATIENCE 30    /* seconds that a sequence may take */
#define FEW 8
#define ROOMY (NX + NG + FEW)

static uint64_t state;

static unsigned draw(unsigned below) /* xorshift64 */
{
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return (unsigned)(state >> 11) % below;
}

static int one_in(unsigned n) { return draw(n) == 0; }

static double tame(void) { return draw(2000) / 1000.0 - 1.0; }

static double number(void) {
    static const double odd[] = {0.0, -0.0, -1.0, 1e300, -1e-300, 1e-320};
    switch (draw(10)) {
    case 0: return NAN;
    case 1: return one_in(2) ? INFINITY : -INFINITY;
    case 2: return odd[draw(6)];
    default: return tame();
    }
}

static void numbers(double values[], size_t n) {
    for (size_t i = 0; i < n; i++) values[i] = number();
}

static void references(uint32_t refs[], size_t n) {
    for (size_t i = 0; i < n; i++) refs[i] = one_in(20) ? (uint32_t)state : draw(REF_END + 3);
}

static double step_size(void) { return one_in(3) ? fmin(number(), 0.05) : 0.01 * (1 + draw(3)); }

/* A legal call may find the model where it cannot be computed, but is never an error. */
static void must(int legal, const char *call, unsigned long sequence) {
    if (legal) return;
    fprintf(stderr, "sequence %lu: the legal call %s was refused\n", sequence, call);
    exit(3);
}

static int tell(const unsigned long counts[], long balance) {
    printf("%lu ok, %lu warning, %lu discard, %lu error\n", counts[0], counts[1], counts[2], counts[3]);
    if (balance) fprintf(stderr, "%ld pieces of memory were not freed\n", balance);
    return balance != 0;
}

#endif

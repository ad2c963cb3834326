/* Inputs from data: polynomials between instants, of which neighbours are mostly wanted next. */
#include <math.h>

#include "core_state.h"

#define ROUNDING 8e-15 /* of an instant */

static int holds(const Record *r, long long piece, double t) {
    return 0 <= piece && piece < r->count - 1 && r->times[piece] <= t && t < r->times[piece + 1];
}

static long long piece_at(const Record *r, double t) {
    for (long long near = r->found - 1; near <= r->found + 1; near++)
        if (holds(r, near, t)) return near;
    long long low = 0, high = r->count - 1;
    while (high - low > 1) {
        long long middle = (low + high) / 2;
        if (t < r->times[middle]) high = middle;
        else low = middle;
    }
    return low;
}

/* Evaluate an input from data and its rate; beyond its ends the outermost pieces go on. */
void core_record_at(Record *r, double t, double *value, double *rate) {
    const long long pieces = r->count - 1, low = holds(r, r->found, t) ? r->found : piece_at(r, t);
    const double x = t - r->times[low], *power = r->powers + low;
    double c3 = power[0], c2 = power[pieces], c1 = power[2 * pieces], c0 = power[3 * pieces];
    r->found = low;
    *value = c0 + x * (c1 + x * (c2 + x * c3));
    *rate = c1 + x * (2 * c2 + x * 3 * c3);
}

/* The next instant after t, by more than rounding, at which the pieces of any data meet, and the length of
 * the piece that ends there. */
double core_corner_after(const Core *c, double t, double *length) {
    double next = INFINITY;
    for (int i = 0; i < NU; i++) {
        const Record *r = c->records[i];
        if (!r) continue;
        long long end = (holds(r, r->found, t) ? r->found : piece_at(r, t)) + 1;
        while (end < r->count - 1 && r->times[end] - t <= ROUNDING * fabs(t)) end++;
        if (r->times[end] <= t || r->times[end] >= next) continue;
        next = r->times[end];
        *length = next - r->times[end - 1];
    }
    return next;
}

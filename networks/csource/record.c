/* Inputs from data: polynomials between instants, of which neighbours are mostly wanted next. */
#include "core_state.h"

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

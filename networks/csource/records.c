/* Inputs from data, piece by piece. */
#include "core_state.h"

/* Evaluate a record and its rate; beyond its ends the outermost pieces go on. */
void core_record_at(Record *r, double t, double *value, double *rate) {
    long long pieces = r->count - 1, low = r->found, high = low + 1;
    if (!(r->times[low] <= t && t < r->times[high])) {
        low = 0;
        high = pieces;
        while (high - low > 1) {
            long long middle = (low + high) / 2;
            if (t < r->times[middle]) high = middle;
            else low = middle;
        }
        r->found = low;
    }
    const double x = t - r->times[low], *power = r->powers + low;
    double c3 = power[0], c2 = power[pieces], c1 = power[2 * pieces], c0 = power[3 * pieces];
    *value = c0 + x * (c1 + x * (c2 + x * c3));
    *rate = c1 + x * (2 * c2 + x * 3 * c3);
}

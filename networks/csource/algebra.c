/* Algebraic unknowns: their values by Newton's method, and their rates. */
#include <math.h>

#include "core_state.h"

/* Factor the algebraic rows of the slopes, under rows of the identity for the states. */
int core_algebra_factor(Core *c, double t, const double y[]) {
    double entries[ROOM(NREDUCED)] = {0};
    core_slope_at(c, t, y);
    for (int i = 0; i < NF; i++) {
        int j = model_kept[i];
        for (int k = model_slope_column[j]; k < model_slope_column[j + 1]; k++)
            if (model_entry[k] >= 0)
                entries[model_entry[k]] = model_slope_row[k] < NX ? model_slope_row[k] == j : c->slope[k];
    }
    return core_factor(&c->algebra, entries, c->full);
}

/* Newton's step for the residuals in `value`. Returns 1 if it was so short that unknowns are found, 0 if not,
 * -1 if there is none. */
int core_newton(Core *c, double t, double y[]) {
    if (!core_algebra_factor(c, t, y)) return -1;
    for (int i = 0; i < NX; i++) c->value[i] = 0;
    core_factor_solve(&c->algebra, c->value, c->full);
    for (int i = NX; i < NY; i++) y[i] -= c->value[i];
    double change = core_largest(c->value + NX, NZ), size = core_largest(y + NX, NZ);
    if (!isfinite(size) || !isfinite(change)) return -1;
    return change <= NEWTON_CLOSE * (1 + size);
}

int core_solve_algebra(Core *c, double t, double y[]) {
    if (NZ == 0) return 1;
    for (int round = 0; round < NEWTON_ROUNDS; round++) {
        if (!core_motion_at(c, t, y, c->value)) return 0;
        int found = core_newton(c, t, y);
        if (found) return found > 0;
    }
    return 0;
}

/* Put the rates of algebraic unknowns where motion left residuals. */
int core_algebra_rates(Core *c, double t, const double y[], double rates[]) {
    if (NZ == 0) return 1;
    if (!core_algebra_factor(c, t, y)) return 0;
    for (int i = NX; i < NY; i++) rates[i] = -c->by_time[i];
    for (int i = 0; i < NLED; i++) {
        int j = model_led[i];
        for (int k = model_slope_column[j]; k < model_slope_column[j + 1]; k++)
            if (model_slope_row[k] >= NX) rates[model_slope_row[k]] -= c->slope[k] * rates[j];
    }
    core_factor_solve(&c->algebra, rates, c->full);
    return 1;
}

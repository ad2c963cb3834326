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

int core_solve_algebra(Core *c, double t, double y[]) {
    if (NZ == 0) return 1;
    for (int round = 0; round < NEWTON_ROUNDS; round++) {
        double largest = 0, size = 0;
        if (!core_motion_at(c, t, y, c->value) || !core_algebra_factor(c, t, y)) return 0;
        for (int i = 0; i < NX; i++) c->value[i] = 0;
        core_factor_solve(&c->algebra, c->value, c->full);
        for (int i = NX; i < NY; i++) {
            y[i] -= c->value[i];
            largest = fmax(largest, fabs(c->value[i]));
            size = fmax(size, fabs(y[i]));
        }
        if (!isfinite(size) || !isfinite(largest)) return 0;
        if (largest <= NEWTON_CLOSE * (1 + size)) return 1;
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

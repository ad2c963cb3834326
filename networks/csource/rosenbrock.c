/* One step of the method of rodas5p.h. */
#include <math.h>
#include <string.h>

#include "core_state.h"

/* Evaluate rates and slopes where the core stands. */
int core_step_begin(Core *c) {
    if (core_rates(c, 0) != CORE_OK) return 0;
    if (c->slope_fresh) return 1;
    core_slope_at(c, c->t, c->y);
    c->slope_fresh = 1;
    for (int i = 0; i < NY; i++) c->still[i] = i < NX && c->by_time[i] == 0;
    for (int k = 0; k < NSLOPE; k++)
        if (c->slope[k] != 0) c->still[model_slope_row[k]] = 0;
    c->still_count = 0;
    for (int i = 0; i < NX; i++) c->still_count += c->still[i];
    return 1;
}

/* The matrix 1 / (h GAMMA) - slope. Where x_i' = x_j, x_i = h GAMMA (b_i + x_j) goes into the other rows. */
static int factored(Core *c, double h) {
    double entries[ROOM(NREDUCED)] = {0}, reach = h * GAMMA;
    for (int i = 0; i < NF; i++) {
        int j = model_kept[i];
        for (int k = model_slope_column[j]; k < model_slope_column[j + 1]; k++) {
            if (model_entry[k] < 0) continue;
            entries[model_entry[k]] -= c->slope[k];
            if (j < NX && model_slope_row[k] == j) entries[model_entry[k]] += 1 / reach;
        }
    }
    for (int i = 0; i < NLED; i++)
        for (int k = model_slope_column[model_led[i]]; k < model_slope_column[model_led[i] + 1]; k++)
            if (model_entry[k] >= 0) entries[model_entry[k]] -= reach * c->slope[k];
    return core_factor(&c->factor, entries, c->full);
}

/* Solve for one stage. An unknown on whose rate nothing acts moves by just that: what is held stays held. */
static void solve_stage(Core *c, double h, double increment[]) {
    double reach = h * GAMMA;
    memcpy(c->value, increment, sizeof c->value);
    for (int i = 0; i < NLED; i++) {
        double follows = reach * c->value[model_led[i]];
        for (int k = model_slope_column[model_led[i]]; k < model_slope_column[model_led[i] + 1]; k++)
            increment[model_slope_row[k]] += c->slope[k] * follows;
    }
    core_factor_solve(&c->factor, increment, c->full);
    for (int i = 0; c->still_count && i < NX; i++)
        if (c->still[i]) increment[i] = reach * c->value[i];
    for (int i = 0; i < NLED; i++)
        increment[model_led[i]] = reach * (c->value[model_led[i]] + increment[model_leader[i]]);
}

static void add(double *restrict to, double factor, const double *restrict from, int count) {
    for (int i = 0; i < count; i++) to[i] += factor * from[i];
}

static int stages(Core *c, double h) {
    Step *s = &c->step;
    for (int k = 0; k < STAGES; k++) {
        double *increment = c->stage[k];
        if (k == 0) memcpy(increment, c->rates, sizeof c->rates);
        else {
            int explicit_ = k < 6 ? k : 0;
            if (explicit_) memcpy(s->end, s->begin, sizeof s->end);
            for (int j = 0; j < explicit_; j++) add(s->end, A[k][j], c->stage[j], NY);
            if (k >= 6) add(s->end, 1, c->stage[k - 1], NY);
            if (!core_motion_at(c, AT[k] == 1 ? s->t + h : s->t + AT[k] * h, s->end, increment)) return 0;
        }
        for (int j = 0; j < k; j++) add(increment, C[k][j] / h, c->stage[j], NX);
        if (BY_TIME[k] != 0) add(increment, h * BY_TIME[k], c->by_time, NY);
        solve_stage(c, h, increment);
    }
    add(s->end, 1, c->stage[STAGES - 1], NY);
    return 1;
}

/* The error of a step over what is allowed. That of an algebraic unknown counts against the largest it was
 * lately: where it bends as it crosses zero, a step errs by a share of how far it moves, however short. */
static double measure(Core *c, double rtol, double atol) {
    const Step *s = &c->step;
    double sum = 0, most = -1;
    for (int i = 0; i < NY; i++) {
        double size = fmax(fabs(s->begin[i]), fabs(s->end[i]));
        if (i >= NX) size = fmax(size, c->largest[i - NX]);
        double share = c->stage[STAGES - 1][i] / (rtol * size + atol * model_nominal[i]);
        sum += share * share;
        if (share * share > most) {
            most = share * share;
            c->worst = i;
        }
    }
    return NY ? sqrt(sum / NY) : 0;
}

/* Step over h. Returns 0 if that left the finite numbers; `error` is 1 at the tolerance. */
int core_step_try(Core *c, double h, double rtol, double atol, double *error) {
    Step *s = &c->step;
    s->t = c->t;
    s->h = h;
    memcpy(s->begin, c->y, sizeof s->begin);
    memcpy(s->end, c->y, sizeof s->end);
    s->bent = 0;
    *error = 0;
    if (NY == 0) return 1;
    if (!factored(c, h) || !stages(c, h)) return 0;
    *error = measure(c, rtol, atol);
    return isfinite(*error);
}

static void bend(Core *c) {
    memset(c->step.bend, 0, sizeof c->step.bend);
    for (int b = 0; b < 3; b++)
        for (int k = 0; k < STAGES; k++) add(c->step.bend[b], BEND[b][k], c->stage[k], NY);
    c->step.bent = 1;
}

/* Interpolate inside the last step, and, if `rates` are wanted, what rates the interpolation has. */
void core_step_dense(Core *c, double t, double y[], double rates[]) {
    const Step *s = &c->step;
    if (!s->bent) bend(c);
    double x = (t - s->t) / s->h, rest = 1 - x;
    for (int i = 0; i < NY; i++) {
        double b = s->bend[1][i] + x * s->bend[2][i], a = s->bend[0][i] + x * b;
        y[i] = rest * s->begin[i] + x * (s->end[i] + rest * a);
        if (rates)
            rates[i] = (s->end[i] - s->begin[i] + (rest - x) * a + x * rest * (b + x * s->bend[2][i])) / s->h;
    }
}

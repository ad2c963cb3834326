/* A step of all lanes by the method of rodas5p.h, each over its own time; see rosenbrock.c. */
#include "wide_core.h"

/* Evaluate inputs where each lane is; a lane's own data by scalar code. */
void wide_inputs_at(Wide *w, wide t, unsigned active) {
    if (NA == 0 || !(lanes_of(t != w->u_time) & active)) return;
    w->u_time = chosen(mask_of(active), t, all(NAN));
    if (NU < NA) wide_inputs((const wide *[]){&t}, (wide *[]){w->u, w->u_rate});
    for (int i = 0; i < NU; i++) {
        int at = model_input_at[i], sign = model_input_sign[i];
        w->u[at] = sign * w->free[i];
        w->u_rate[at] = (wide){0};
        for (int k = 0; w->recorded[i] && k < LANES; k++) {
            double value, rate;
            if (!(active >> k & 1) || !w->records[i][k]) continue;
            core_record_at(w->records[i][k], t[k], &value, &rate);
            w->u[at][k] = sign * value;
            w->u_rate[at][k] = sign * rate;
        }
    }
}

static void lanes_motion_at(Wide *w, wide t, const wide y[], wide rates[], unsigned active) {
    wide_inputs_at(w, t, active);
    wide_motion((const wide *[]){y, y + NX, w->u, w->q, &t}, (wide *[]){rates});
}

static void lanes_slopes(Wide *w, unsigned active) {
    wide_inputs_at(w, w->t, active);
    wide_slope((const wide *[]){w->y, w->y + NX, w->u, w->q, &w->t, w->u_rate},
               (wide *[]){w->slope, w->by_time});
    for (int k = 0; k < NSLOPE; k++) w->slope[k] = only(is_finite(w->slope[k]), w->slope[k]);
    for (int i = 0; i < NY; i++) w->by_time[i] = only(is_finite(w->by_time[i]), w->by_time[i]);
    for (int i = 0; i < NX; i++) w->still[i] = w->by_time[i] == 0;
    for (int k = 0; k < NSLOPE; k++)
        if (model_slope_row[k] < NX) w->still[model_slope_row[k]] &= w->slope[k] == 0;
    mask any = {0};
    for (int i = 0; i < NX; i++) any |= w->still[i];
    w->any_still = lanes_of(any) & active;
}

/* The matrix 1 / reach - slope, without states that follow another one. Returns the lanes it is good in. */
static unsigned lanes_factored(Wide *w, wide reach, unsigned active) {
    wide entries[ROOM(NREDUCED)] = {0}, inverse = 1 / reach;
    for (int i = 0; i < NF; i++) {
        int j = model_kept[i];
        for (int k = model_slope_column[j]; k < model_slope_column[j + 1]; k++) {
            if (model_entry[k] < 0) continue;
            entries[model_entry[k]] -= w->slope[k];
            if (j < NX && model_slope_row[k] == j) entries[model_entry[k]] += inverse;
        }
    }
    for (int i = 0; i < NLED; i++)
        for (int k = model_slope_column[model_led[i]]; k < model_slope_column[model_led[i] + 1]; k++)
            if (model_entry[k] >= 0) entries[model_entry[k]] -= reach * w->slope[k];
    memset(w->lu, 0, sizeof w->lu);
    for (int j = 0; j < NF; j++)
        for (int k = model_reduced_column[j]; k < model_reduced_column[j + 1]; k++)
            w->lu[j * NF + model_reduced_row[k]] = entries[k];
    return wide_factor(w->lu, NF, &w->pivots, active);
}

static void lanes_solve_stage(const Wide *w, wide reach, wide increment[]) {
    wide value[ROOM(NY)], x[ROOM(NF)];
    memcpy(value, increment, sizeof value);
    for (int i = 0; i < NLED; i++) {
        wide follows = reach * value[model_led[i]];
        for (int k = model_slope_column[model_led[i]]; k < model_slope_column[model_led[i] + 1]; k++)
            increment[model_slope_row[k]] += w->slope[k] * follows;
    }
    for (int i = 0; i < NF; i++) x[i] = increment[model_kept[i]];
    wide_solve(w->lu, NF, &w->pivots, x);
    for (int i = 0; i < NF; i++) increment[model_kept[i]] = x[i];
    for (int i = 0; w->any_still && i < NX; i++)
        increment[i] = chosen(w->still[i], reach * value[i], increment[i]);
    for (int i = 0; i < NLED; i++)
        increment[model_led[i]] = reach * (value[model_led[i]] + increment[model_leader[i]]);
}

/* What stages before the one numbered `count` sum up to in unknown i, by weights. */
static wide summed(const Wide *w, const double weights[], int count, int i) {
    wide sum = {0};
    for (int j = 0; j < count; j++) sum += weights[j] * w->stage[j][i];
    return sum;
}

static void lanes_stages(Wide *w, wide reach, unsigned active) {
    wide inverse = 1 / w->h;
    for (int k = 0; k < STAGES; k++) {
        wide *increment = w->stage[k];
        if (k == 0) memcpy(increment, w->rates, sizeof w->rates);
        else {
            if (k < 6)
                for (int i = 0; i < NY; i++) w->end[i] = w->y[i] + summed(w, A[k], k, i);
            else
                for (int i = 0; i < NY; i++) w->end[i] += w->stage[k - 1][i];
            lanes_motion_at(w, w->t + AT[k] * w->h, w->end, increment, active);
        }
        for (int i = 0; k > 0 && i < NX; i++) increment[i] += inverse * summed(w, C[k], k, i);
        for (int i = 0; BY_TIME[k] != 0 && i < NY; i++) increment[i] += BY_TIME[k] * w->h * w->by_time[i];
        lanes_solve_stage(w, reach, increment);
    }
    for (int i = 0; i < NY; i++) w->end[i] += w->stage[STAGES - 1][i];
}

static void lanes_measure(Wide *w, double rtol, double atol) {
    wide sum = {0}, most = all(-1);
    w->worst = (wide){0};
    for (int i = 0; i < NY; i++) {
        wide size = wide_greater(wide_fabs(w->y[i]), wide_fabs(w->end[i]));
        if (i >= NX) size = wide_greater(size, w->largest[i - NX]);
        wide share = w->stage[STAGES - 1][i] / (rtol * size + atol * model_nominal[i]);
        share *= share;
        sum += share;
        w->worst = chosen(share > most, all(i), w->worst);
        most = wide_greater(share, most);
    }
    w->error = wide_sqrt(sum / ROOM(NY));
}

/* Step over h. Returns the lanes in which the step may be trusted, whatever it came to; the error is
 * not finite where it left the finite numbers. */
unsigned wide_step(Wide *w, unsigned active, double rtol, double atol) {
    wide reach = GAMMA * w->h, sum = {0};
    lanes_slopes(w, active);
    unsigned sound = lanes_factored(w, reach, active);
    if (!sound) return 0;
    lanes_stages(w, reach, active);
    lanes_measure(w, rtol, atol);
    lanes_motion_at(w, w->t + w->h, w->end, w->end_rates, active);
    for (int i = 0; i < NY; i++) sum += wide_fabs(w->end_rates[i]);
    w->error = chosen(is_finite(sum), w->error, all(NAN));
    return sound;
}

void wide_bend(Wide *w) {
    for (int b = 0; b < 3; b++)
        for (int i = 0; i < NY; i++) w->bend[b][i] = summed(w, BEND[b], STAGES, i);
}

/* Interpolate inside the step, once it is bent, and, if `rates` are wanted, what rates that has. */
void wide_dense(const Wide *w, wide t, wide y[], wide rates[]) {
    wide x = (t - w->t) / w->h, rest = 1 - x, inverse = 1 / w->h;
    for (int i = 0; i < NY; i++) {
        wide b = w->bend[1][i] + x * w->bend[2][i], a = w->bend[0][i] + x * b;
        y[i] = rest * w->y[i] + x * (w->end[i] + rest * a);
        if (rates)
            rates[i] = (w->end[i] - w->y[i] + (rest - x) * a + x * rest * (b + x * w->bend[2][i])) * inverse;
    }
}

/* Shocks: what a jump of a prescribed motion, or of its slope, does in no time at all, as in shocks.py; and
 * what contacts do then: they are struck or left, or pass the shock on. */
#include <math.h>
#include <string.h>

#include "core_state.h"

void core_see(Core *c, double seen[]) {
    (void)c, (void)seen;
#if MODEL_JUMPS
    core_evaluate(c, model_seen, c->t, c->y, &(Call){.res = {seen}});
#endif
}

#if MODEL_JUMPS
static int last_of_signal(int k) {
    for (int s = 1; s <= NSIGNAL; s++)
        if (model_jump_start[s] == k + 1) return 1;
    return 0;
}

/* By how much signals and their derivatives have jumped since they were seen, zero where that is rounding. */
static int since(Core *c, const double seen[], double jump[]) {
    double now[ROOM(NREAD)], size[ROOM(NJ)], raw[ROOM(NJ)];
    Call call = {{seen, now, c->q, &c->t}, {raw, size}};
    int any = 0;
    core_see(c, now);
    model_jump(call.arg, call.res, c->iw, c->w, 0);
    for (int k = 0; k < NJ; k++) {
        int last = last_of_signal(k);
        double late = last ? 0 : JUMP_LATE * fmax(1, fabs(c->t)) * fabs(raw[k + 1]);
        jump[k] = last || fabs(raw[k]) <= JUMP_ROUNDING * size[k] + late ? 0 : model_jump_sign[k] * raw[k];
        any |= jump[k] != 0;
    }
    return any;
}

/* Rates of states and forces while signals are off by a course. */
static int rates_off(Core *c, const double x[], const double course[], double rates[]) {
    double y[ROOM(NY)], signed_[ROOM(NJ)], moved[ROOM(NPATH) + ROOM(NZ)], sum = 0;
    for (int k = 0; k < NJ; k++) signed_[k] = model_jump_sign[k] * course[k];
    memcpy(y, x, NX * sizeof *x);
    memcpy(y + NX, c->y + NX, NZ * sizeof *y);
    for (int round = 0, found = 0; round < NEWTON_ROUNDS && !found; round++) {
        core_evaluate(c, model_moving, c->t, y, &(Call){.arg = {[5] = signed_}, .res = {moved}});
        if (NZ == 0) break;
        memcpy(c->value + NX, moved + NPATH, NZ * sizeof *moved);
        found = core_newton(c, c->t, y);
        if (found < 0) return 0;
    }
    for (int i = 0; i < NPATH; i++) sum += fabs(rates[i] = moved[i]);
    return isfinite(sum);
}

/* How far states are off while a position jumps that relative velocities follow; 0 if that takes forces. */
static int thrown(Core *c, const double jump[], const double x[], double far[]) {
    double course[ROOM(NJ)] = {0}, at_rest[ROOM(NPATH)], away[ROOM(NPATH)];
    if (!rates_off(c, x, course, at_rest)) return 0;
    for (int s = 0; s < NSIGNAL; s++)
        for (int k = model_jump_start[s] + 2; k < model_jump_start[s + 1]; k++)
            course[k] = jump[k - 2] / RAMP;
    if (!rates_off(c, x, course, away)) return 0;
    for (int i = 0; i < NX; i++) far[i] = away[i] - at_rest[i];
    for (int i = NPUSH > 0 ? NX : 0; i < NPATH; i++)
        if (!(fabs(away[i] - at_rest[i]) <= JUMP_UNBOUNDED)) return 0;
    return 1;
}

static double least_size(int i) { return i < NX ? model_nominal[i] : 1; }

static int moved(Core *c, const double jump[], const double path[], double s, double instant, double out[]) {
    const double *far = jump + NJ;
    double still[ROOM(NJ)], course[ROOM(NJ)], at_rest[ROOM(NPATH)], x[ROOM(NX)];
    for (int i = 0; i < NX; i++) x[i] = path[i] + RAMP / instant * far[i];
    for (int k = 0; k < NJ; k++) {
        still[k] = course[k] = (s - 1) * jump[k];
        if (k > 0 && !last_of_signal(k - 1)) course[k] += jump[k - 1] / instant;
    }
    if (!rates_off(c, path, still, at_rest) || !rates_off(c, x, course, out)) return 0;
    for (int i = 0; i < NPATH; i++) out[i] = instant * (out[i] - at_rest[i]);
    return 1;
}

/* How states and impulses move with s; `jump` ends with how far states are off. 0 if they move the faster,
 * the shorter the ramp. */
static int path_rates(Core *c, const double jump[], const double path[], double s, double rates[]) {
    double shorter[ROOM(NPATH)];
    if (!moved(c, jump, path, s, RAMP, rates) || !moved(c, jump, path, s, RAMP * RAMP_SHORTER, shorter))
        return 0;
    double most = core_largest(rates, NPATH);
    for (int i = 0; i < NPATH; i++)
        if (!(fabs(rates[i] - shorter[i]) <= JUMP_UNBOUNDED * (most + least_size(i)))) return 0;
    return 1;
}

static int runge_kutta(Core *c, const double jump[], const double path[], double s, double h, double to[]) {
    static const double share[4] = {0, 0.5, 0.5, 1}, weight[4] = {1, 2, 2, 1};
    double rates[ROOM(NPATH)] = {0}, at[ROOM(NPATH)], sum[ROOM(NPATH)] = {0};
    for (int stage = 0; stage < 4; stage++) {
        for (int i = 0; i < NPATH; i++) at[i] = path[i] + h * share[stage] * rates[i];
        if (!path_rates(c, jump, at, s + h * share[stage], rates)) return 0;
        for (int i = 0; i < NPATH; i++) sum[i] += weight[stage] * rates[i];
    }
    for (int i = 0; i < NPATH; i++) to[i] = path[i] + h / 6 * sum[i];
    return 1;
}

/* The mode through which a jump acts otherwise than through its others, of which none is known to hold; else
 * -1. */
static int uncertain(Core *c, const double jump[], const double path[], double rates[]) {
    double other[ROOM(NPATH)], *modes = core_modes(c);
    Kept kept;
    int found = -1;
    memcpy(kept.modes, modes, (NM + NI + NK) * sizeof *modes);
    for (int m = 0; m < NM && found < 0; m++)
        for (int value = 0; value < model_in_shock_start[m + 1] - model_in_shock_start[m] && found < 0;
             value++) {
            if (model_jump_mode[m] || value == (int)kept.modes[m] || core_stands_in(m, value) >= 0) continue;
            modes[m] = value;
            if (core_complete(c) != CORE_OK || !path_rates(c, jump, path, 0, other)) found = m;
            for (int i = 0; i < NPATH && found < 0; i++)
                if (!(fabs(other[i] - rates[i]) <= JUMP_ALIKE * (1 + fabs(rates[i])))) found = m;
            core_go_back(c, &kept);
        }
    return found;
}

/* Follow the jump, in steps halved until they are accurate; `path` holds states, then impulses. */
static int follow(Core *c, const double jump[], double path[]) {
    double whole[ROOM(NPATH)], half[ROOM(NPATH)], next[ROOM(NPATH)];
    for (double s = 0, h = 1; s < 1;) {
        int accurate = 1;
        h = fmin(h, 1 - s);
        if (!runge_kutta(c, jump, path, s, h, whole) || !runge_kutta(c, jump, path, s, h / 2, half) ||
            !runge_kutta(c, jump, half, s + h / 2, h / 2, next))
            return 0;
        for (int i = 0; i < NPATH; i++)
            accurate &= fabs(whole[i] - next[i]) <= JUMP_ACCURACY * fmax(least_size(i), fabs(next[i]));
        if (!accurate && h > JUMP_STEP) {
            h /= 2;
            continue;
        }
        memcpy(path, next, NPATH * sizeof *path);
        s += h;
        h *= 2;
    }
    return 1;
}

static CoreStatus unbounded(Core *c, const double jump[]) {
    int any = 0;
    core_fail(c, CORE_ERROR, "at t = %g s what prescribes a motion jumps: ", c->t);
    for (int s = 0; s < NSIGNAL; s++) {
        int start = model_jump_start[s];
        double size = core_largest(jump + start, model_jump_start[s + 1] - start);
        if (size > 0) core_say_more(c, "%s%s (by %g)", any++ ? ", " : "", model_jump_name[s], size);
    }
    core_say_more(
        c,
        ", which takes infinite forces; give a ramp instead of the jump, a Speed instead of a Position, or "
        "exact=False, which filters it");
    return CORE_ERROR;
}

/* Move states and impulses by a jump, in the modes that hold in shocks. */
static CoreStatus pass_through(Core *c, double jump[], double path[]) {
    double rates[ROOM(NPATH)];
    if (!thrown(c, jump, path, jump + NJ) || !path_rates(c, jump, path, 0, rates)) return unbounded(c, jump);
    int mode = uncertain(c, jump, path, rates);
    if (mode < 0) return follow(c, jump, path) ? CORE_OK : unbounded(c, jump);
    return core_fail(c, CORE_ERROR,
                     "at t = %g s %s: a jump of a prescribed motion acts through this mode, and which one "
                     "holds is not known: give a ramp instead of the jump",
                     c->t, model_mode_name[mode]);
}

static int is_still(const Core *c, const double path[]) {
    int still = 1;
    for (int i = 0; i < NPATH; i++) still &= path[i] == (i < NX ? c->y[i] : 0);
    return still;
}

/* Whether a position jumps onto a stop, or off it, from indicators before. */
static CoreStatus check_reach(Core *c, const double before[]) {
    for (int i = 0; i < NG; i++) {
        int mode = model_change_mode[i], present = core_mode(c, mode), indicator = model_change_indicator[i];
        double was = before[indicator], now = c->expressions[indicator];
        int opens = model_change_source[i] != model_change_target[i] && core_holds(c, i);
        int onto = present == model_change_source[i] && core_stands_in(mode, present) < 0 &&
                   was <= STOP_DEPTH && now > STOP_DEPTH;
        if (model_change_impulse[i] < 0) continue;
        if (!onto && !(opens && fabs(now - was) > STOP_DEPTH)) continue;
        return core_fail(c, CORE_ERROR,
                         "at t = %g s %s is struck or left at infinite speed, where a prescribed position "
                         "jumps; give a ramp instead of the jump",
                         c->t, model_component[i]);
    }
    return CORE_OK;
}

static int any_pressed(const Core *c) {
    const double *value = c->expressions;
    int any = 0;
    for (int i = 0; i < NG && !any; i++)
        any = core_holds(c, i) &&
              value[model_change_after[i]] > value[model_change_velocity[i]] + PRESSING_SPEED;
    return any;
}

/* Add what motions give when contacts pass a shock on, by the impulses of these. */
static CoreStatus add_passed(Core *c, const int contacts[], const double impulses[], int count,
                             double pushes[]) {
    double still[ROOM(NJ)] = {0}, before[ROOM(NPATH)], after[ROOM(NPATH)];
    Kept kept;
    CoreStatus status = core_stand_in(c, &kept);
    int finite = status == CORE_OK && rates_off(c, c->y, still, before);
    for (int k = 0; k < count; k++) core_modes(c)[NM + model_change_impulse[contacts[k]]] = impulses[k];
    finite = finite && rates_off(c, c->y, still, after);
    for (int i = 0; i < NPUSH && finite; i++) pushes[i] += after[NX + i] - before[NX + i];
    core_go_back(c, &kept);
    return status;
}

/* Let the contacts that hold, where they are pressed together, pass a shock on, and tell of all impulses. */
static CoreStatus pass_on(Core *c, double pushes[], const Observer *told) {
    int contacts[ROOM(NG)], stays[ROOM(NG)], count = 0;
    double impulses[ROOM(NG)];
    CoreStatus status = CORE_OK;
    if (any_pressed(c)) {
        status = core_strike(c, contacts, stays, impulses, &count);
        if (status == CORE_OK) status = add_passed(c, contacts, impulses, count, pushes);
    }
    if (status != CORE_OK || !told || !told->fired) return status;
    double largest = core_largest(pushes, NPUSH);
    for (int i = 0; i < NPUSH; i++)
        if (fabs(pushes[i]) > JUMP_FELT_SHARE * largest) told->fired(told->context, c, NG + i, 0, pushes[i]);
    if (largest == 0) told->fired(told->context, c, NG + NPUSH, 0, 0);
    for (int k = 0; k < count; k++) told->fired(told->context, c, contacts[k], 1, impulses[k]);
    return status;
}
#endif

/* Let what has jumped since it was seen act on states, and the contacts that pass it on. */
CoreStatus core_jump(Core *c, const double seen[], const Observer *told, int *changed) {
    (void)c, (void)seen, (void)told, (void)changed;
#if MODEL_JUMPS
    double jump[ROOM(NJ) + ROOM(NX)], path[ROOM(NPATH)] = {0}, before[ROOM(NE)];
    Kept kept;
    CoreStatus status = core_rates(c, 0);
    if (status != CORE_OK || !since(c, seen, jump)) return status;
    core_forget_sizes(c);
    core_switching(c);
    memcpy(before, c->expressions, NE * sizeof *before);
    memcpy(path, c->y, NX * sizeof *path);
    status = core_stand_in(c, &kept);
    if (status == CORE_OK) status = pass_through(c, jump, path);
    core_go_back(c, &kept);
    if (status != CORE_OK || is_still(c, path)) return status;
    memcpy(c->y, path, NX * sizeof *path);
    *changed = 1;
    core_switching(c);
    status = check_reach(c, before);
    if (status == CORE_OK) status = pass_on(c, path + NX, told);
    if (status == CORE_OK) status = core_complete(c);
    core_stale(c);
    if (status != CORE_OK) return status;
#endif
    return core_rates(c, 0);
}

/* Shocks: what a jump of a prescribed motion, or of its slope, does in no time at all; as in shocks.py. */
#include <math.h>
#include <string.h>

#include "core_state.h"

void core_see(Core *c, double seen[]) {
    (void)c, (void)seen;
#if NJ > 0
    const double *arg[ROOM(MODEL_ARGS)] = {0};
    double *res[ROOM(MODEL_RESULTS)] = {seen};
    core_arguments(c, c->t, c->y, arg);
    arg[4] = &c->t;
    model_seen(arg, res, c->iw, c->w, 0);
#endif
}

#if NJ > 0
static int last_of_signal(int k) {
    for (int s = 1; s <= NSIGNAL; s++)
        if (model_jump_start[s] == k + 1) return 1;
    return 0;
}

/* By how much signals and their derivatives have jumped since they were seen, zero where that is rounding. */
static int since(Core *c, const double seen[], double jump[]) {
    double now[ROOM(NREAD)], size[ROOM(NJ)], raw[ROOM(NJ)];
    const double *arg[ROOM(MODEL_ARGS)] = {0};
    double *res[ROOM(MODEL_RESULTS)] = {raw, size};
    int any = 0;
    core_see(c, now);
    arg[0] = seen;
    arg[1] = now;
    arg[2] = c->q;
    arg[3] = &c->t;
    model_jump(arg, res, c->iw, c->w, 0);
    for (int k = 0; k < NJ; k++) {
        int last = last_of_signal(k);
        double late = last ? 0 : JUMP_LATE * fmax(1, fabs(c->t)) * fabs(raw[k + 1]);
        jump[k] = last || fabs(raw[k]) <= JUMP_ROUNDING * size[k] + late ? 0 : model_jump_sign[k] * raw[k];
        any |= jump[k] != 0;
    }
    return any;
}

/* Rates of states and forces while signals are off by a course. */
int core_rates_off(Core *c, const double x[], const double course[], double rates[]) {
    const double *arg[ROOM(MODEL_ARGS)] = {0};
    double y[ROOM(NY)], signed_[ROOM(NJ)], moved[ROOM(NPATH + NZ)], *res[ROOM(MODEL_RESULTS)] = {moved},
                                                                    sum = 0;
    for (int k = 0; k < NJ; k++) signed_[k] = model_jump_sign[k] * course[k];
    memcpy(y, x, NX * sizeof *x);
    memcpy(y + NX, c->y + NX, NZ * sizeof *y);
    for (int round = 0; round < NEWTON_ROUNDS; round++) {
        double largest = 0, size = 0;
        core_arguments(c, c->t, y, arg);
        arg[4] = &c->t;
        arg[5] = signed_;
        model_moving(arg, res, c->iw, c->w, 0);
        if (NZ == 0) break;
        if (!core_algebra_factor(c, c->t, y)) return 0;
        for (int i = 0; i < NX; i++) c->value[i] = 0;
        for (int i = 0; i < NZ; i++) c->value[NX + i] = moved[NPATH + i];
        core_factor_solve(&c->algebra, c->value, c->full);
        for (int i = NX; i < NY; i++) {
            y[i] -= c->value[i];
            largest = fmax(largest, fabs(c->value[i]));
            size = fmax(size, fabs(y[i]));
        }
        if (!(largest > NEWTON_CLOSE * (1 + size))) break;
    }
    for (int i = 0; i < NPATH; i++) sum += fabs(rates[i] = moved[i]);
    return isfinite(sum);
}

/* How far states are off while a position jumps that relative velocities follow; 0 if that takes forces. */
static int thrown(Core *c, const double jump[], const double x[], double far[]) {
    double course[ROOM(NJ)] = {0}, at_rest[ROOM(NPATH)], away[ROOM(NPATH)];
    if (!core_rates_off(c, x, course, at_rest)) return 0;
    for (int s = 0; s < NSIGNAL; s++)
        for (int k = model_jump_start[s] + 2; k < model_jump_start[s + 1]; k++)
            course[k] = jump[k - 2] / RAMP;
    if (!core_rates_off(c, x, course, away)) return 0;
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
    if (!core_rates_off(c, path, still, at_rest) || !core_rates_off(c, x, course, out)) return 0;
    for (int i = 0; i < NPATH; i++) out[i] = instant * (out[i] - at_rest[i]);
    return 1;
}

/* How states and impulses move with s; `jump` ends with how far states are off. 0 if they move the faster,
 * the shorter the ramp. */
static int path_rates(Core *c, const double jump[], const double path[], double s, double rates[]) {
    double shorter[ROOM(NPATH)], most = 0;
    if (!moved(c, jump, path, s, RAMP, rates) || !moved(c, jump, path, s, RAMP * RAMP_SHORTER, shorter))
        return 0;
    for (int i = 0; i < NPATH; i++) most = fmax(most, fabs(rates[i]));
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
    double other[ROOM(NPATH)], *modes = core_modes(c), kept[ROOM(NM + NI + NK)];
    int found = -1;
    memcpy(kept, modes, (NM + NI + NK) * sizeof *kept);
    for (int m = 0; m < NM && found < 0; m++)
        for (int value = 0; value < model_in_shock_start[m + 1] - model_in_shock_start[m] && found < 0;
             value++) {
            if (model_jump_mode[m] || value == (int)kept[m] || core_stands_in(m, value) >= 0) continue;
            modes[m] = value;
            if (core_complete(c) != CORE_OK || !path_rates(c, jump, path, 0, other)) found = m;
            for (int i = 0; i < NPATH && found < 0; i++)
                if (!(fabs(other[i] - rates[i]) <= JUMP_ALIKE * (1 + fabs(rates[i])))) found = m;
            memcpy(modes, kept, (NM + NI + NK) * sizeof *kept);
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
    core_say_when(c);
    core_say_more(c, "what prescribes a motion jumps: ");
    for (int s = 0; s < NSIGNAL; s++) {
        double size = 0;
        for (int k = model_jump_start[s]; k < model_jump_start[s + 1]; k++) size = fmax(size, fabs(jump[k]));
        if (size == 0) continue;
        if (any++) core_say_more(c, ", ");
        core_say_more(c, model_jump_name[s]);
        core_say_more(c, " (by ");
        core_say_number(c, size);
        core_say_more(c, ")");
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
    core_say_when(c);
    core_say_more(c, model_mode_name[mode]);
    core_say_more(
        c,
        ": a jump of a prescribed motion acts through this mode, and which one holds is not known: give a ramp "
        "instead of the jump");
    return CORE_ERROR;
}

static int is_still(const Core *c, const double path[]) {
    int still = 1;
    for (int i = 0; i < NPATH; i++) still &= path[i] == (i < NX ? c->y[i] : 0);
    return still;
}
#endif

/* Let what has jumped since it was seen act on states, and the contacts that pass it on. */
CoreStatus core_jump(Core *c, const double seen[], const Observer *told, int *changed) {
    (void)c, (void)seen, (void)told, (void)changed;
#if NJ > 0
    double jump[NJ + ROOM(NX)], path[ROOM(NPATH)] = {0}, kept[ROOM(NM + NI + NK)], before[ROOM(NE)];
    double *modes = core_modes(c);
    CoreStatus status = core_rates(c, 0);
    if (status != CORE_OK || !since(c, seen, jump)) return status;
    core_switching(c);
    memcpy(before, c->expressions, NE * sizeof *before);
    memcpy(path, c->y, NX * sizeof *path);
    memcpy(kept, modes, (NM + NI + NK) * sizeof *kept);
    core_stand_in(c);
    status = core_complete(c);
    if (status == CORE_OK) status = pass_through(c, jump, path);
    memcpy(modes, kept, (NM + NI + NK) * sizeof *kept);
    if (status != CORE_OK || is_still(c, path)) return status;
    memcpy(c->y, path, NX * sizeof *path);
    *changed = 1;
    core_switching(c);
    status = core_check_reach(c, before);
    if (status == CORE_OK) status = core_pass_on(c, path + NX, told);
    if (status == CORE_OK) status = core_complete(c);
    core_stale(c);
    if (status != CORE_OK) return status;
#endif
    return core_rates(c, 0);
}

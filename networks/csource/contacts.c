/* What contacts do where a prescribed motion jumps: they are struck or left, or pass the shock on. */
#include <math.h>
#include <string.h>

#include "core_state.h"

#if NJ > 0
/* Whether a position jumps onto a stop, or off it, from indicators before. */
CoreStatus core_check_reach(Core *c, const double before[]) {
    for (int i = 0; i < NG; i++) {
        int mode = model_change_mode[i], present = core_mode(c, mode), indicator = model_change_indicator[i];
        double was = before[indicator], now = c->expressions[indicator];
        int opens = model_change_source[i] != model_change_target[i] && core_holds(c, i);
        int onto = present == model_change_source[i] && core_stands_in(mode, present) < 0 && was <= INSIDE &&
                   now > INSIDE;
        if (model_change_impulse[i] < 0) continue;
        if (!onto && !(opens && fabs(now - was) > INSIDE)) continue;
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
        any = core_holds(c, i) && value[model_change_after[i]] > value[model_change_velocity[i]] + PRESSED;
    return any;
}

/* Add what motions give when contacts pass a shock on, by the impulses of these. */
static CoreStatus add_passed(Core *c, const int contacts[], const double impulses[], int count,
                             double pushes[]) {
    double still[ROOM(NJ)] = {0}, before[ROOM(NPATH)], after[ROOM(NPATH)];
    Kept kept;
    CoreStatus status = core_stand_in(c, &kept);
    int finite = status == CORE_OK && core_rates_off(c, c->y, still, before);
    for (int k = 0; k < count; k++) core_modes(c)[NM + model_change_impulse[contacts[k]]] = impulses[k];
    finite = finite && core_rates_off(c, c->y, still, after);
    for (int i = 0; i < NPUSH && finite; i++) pushes[i] += after[NX + i] - before[NX + i];
    core_go_back(c, &kept);
    return status;
}

/* Let the contacts that hold, where they are pressed together, pass a shock on, and tell of all impulses. */
CoreStatus core_pass_on(Core *c, double pushes[], const Observer *told) {
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
        if (fabs(pushes[i]) > JUMP_FELT * largest) told->fired(told->context, c, NG + i, 0, pushes[i]);
    if (largest == 0) told->fired(told->context, c, NG + NPUSH, 0, 0);
    for (int k = 0; k < count; k++) told->fired(told->context, c, contacts[k], 1, impulses[k]);
    return status;
}
#endif

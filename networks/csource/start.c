/* Start values that satisfy the equations and what is given, and the modes that go with them. */
#include "start.h"

#include <float.h>
#include <math.h>
#include <string.h>

void core_given(Given *given) {
    for (int i = 0; i < NX; i++) given->x[i] = model_guess[i];
    for (int i = 0; i < NAIM; i++) given->aim[i] = model_aim[i];
}

/* By how much aims (and then algebraic equations) are missed, and the slopes of that, one column for each. */
static int missed(Core *c, const Given *given, ModelFunction law, int aims, int rows, StartRoom *room) {
    double sum = 0;
    core_evaluate(c, law, c->t, c->y, &(Call){.res = {room->value, room->slope}});
    for (int i = 0; i < aims; i++) room->value[i] -= given->aim[i];
    for (int i = 0; i < rows; i++) sum += fabs(room->value[i]);
    return isfinite(sum);
}

/* Take out of a column what lies along others, which are orthogonal. */
static void take_out(double column[], const double others[], int length, int count) {
    double strongest = 0;
    for (int k = 0; k < count; k++)
        strongest = fmax(strongest, core_dot(others + k * length, others + k * length, length));
    for (int k = 0; k < count; k++) {
        const double *other = others + k * length;
        double strength = core_dot(other, other, length);
        if (!(strength > START_WEAK * START_WEAK * strongest)) continue;
        double share = core_dot(column, other, length) / strength;
        for (int i = 0; i < length; i++) column[i] -= share * other[i];
    }
}

/* Move states that have no start of their own so that fixed aims are met and others are nearest. */
static void lead(Core *c, const Given *given, StartRoom *room) {
    double before[ROOM(NX)];
    memcpy(before, c->y, NX * sizeof *before);
    for (int round = 0; round < LEAD_ROUNDS; round++) {
        double *soft = room->slope + NFIXED * NLEAD, further[ROOM(NLEAD)];
        if (!missed(c, given, model_lead, NAIM, NAIM, room)) break;
        memcpy(room->kept, room->slope, sizeof room->kept);
        for (int i = 0; i < NFIXED; i++) room->missing[i] = -room->value[i];
        core_least_norm(room->slope, room->turn, NLEAD, NFIXED, 1, room->missing, room->step);
        for (int i = 0; i < NAIM - NFIXED; i++) {
            const double *column = room->kept + (NFIXED + i) * NLEAD;
            room->missing[i] = -room->value[NFIXED + i] - core_dot(column, room->step, NLEAD);
            take_out(soft + i * NLEAD, room->slope, NLEAD, NFIXED);
            if (core_dot(soft + i * NLEAD, soft + i * NLEAD, NLEAD) <=
                START_WEAK * START_WEAK * core_dot(column, column, NLEAD))
                memset(soft + i * NLEAD, 0, NLEAD * sizeof *soft);
        }
        core_least_norm(soft, room->turn, NLEAD, NAIM - NFIXED, 1, room->missing, further);
        for (int i = 0; i < NLEAD; i++) {
            room->step[i] += further[i];
            c->y[model_lead_state[i]] += room->step[i];
        }
        double largest = core_largest(room->step, NLEAD), size = core_largest(c->y, NX);
        if (!isfinite(largest) || !isfinite(size)) break;
        if (largest <= START_CLOSE * (1 + size) || round == LEAD_ROUNDS - 1) return;
    }
    memcpy(c->y, before, NX * sizeof *before);
}

static CoreStatus contradiction(Core *c, const Given *given, const StartRoom *room, double size) {
    int any = 0;
    for (int i = 0; i < NFIXED; i++) {
        if (fabs(room->value[i]) <= START_MISSED * (1 + size)) continue;
        if (!any) core_fail(c, CORE_ERROR, "start values: ");
        core_say_more(c, "%s%s = %g %s", any++ ? ", " : "", model_aim_name[i], given->aim[i],
                      model_aim_unit[i]);
    }
    if (!any) return core_fail(c, CORE_ERROR, "no start values satisfy the equations");
    core_say_more(c, " cannot be reached by any choice of the states that are not fixed");
    return CORE_ERROR;
}

/* Gauss and Newton, with steps of least norm in the states that are not fixed and the algebraic unknowns. */
static CoreStatus meet(Core *c, const Given *given, StartRoom *room) {
    for (int round = 0; round < MEET_ROUNDS; round++) {
        if (!missed(c, given, model_meet, NFIXED, NMET, room)) break;
        for (int i = 0; i < NMET; i++) room->missing[i] = -room->value[i];
        core_least_norm(room->slope, room->turn, NFREE + NZ, NMET, 1, room->missing, room->step);
        for (int i = 0; i < NFREE + NZ; i++)
            c->y[i < NFREE ? model_free_state[i] : NX + i - NFREE] += room->step[i];
        if (core_largest(room->step, NFREE + NZ) <= START_CLOSE * (1 + core_largest(c->y, NY))) break;
    }
    double size = core_largest(c->y, NX);
    int finite = missed(c, given, model_meet, NFIXED, NMET, room), met = finite;
    for (int i = 0; i < NMET && met; i++) met = fabs(room->value[i]) <= START_MISSED * (1 + size);
    if (met) return CORE_OK;
    if (finite) return contradiction(c, given, room, size);
    return core_fail(c, CORE_ERROR, "the equations have no value at the start");
}

/* Seek start values in the present modes. */
static CoreStatus seek(Core *c, const Given *given, StartRoom *room) {
    memcpy(c->y, given->x, NX * sizeof *c->y);
    memcpy(c->y + NX, model_guess + NX, NZ * sizeof *c->y);
    for (int i = 0; i < NFIXED; i++)
        if (model_aim_unknown[i] >= 0) c->y[NX + model_aim_unknown[i]] = given->aim[i];
    core_stale(c);
    for (int again = 0; again < (NFIXED ? 2 : 1); again++) {
        if (NLEAD) lead(c, given, room);
        if (!NFIXED) break;
        CoreStatus status = meet(c, given, room);
        if (status != CORE_OK) return status;
    }
    core_stale(c);
    return CORE_OK;
}

/* Forget what has been seen of events and of unknowns. */
static void forget(Core *c) {
    core_forget_sizes(c);
    memset(c->largest, 0, sizeof c->largest);
    memset(c->raised, 0, sizeof c->raised);
    memset(c->muted, 0, sizeof c->muted);
}

static void note_shock(void *context, const Core *c, int change, int stays, double impulse) {
    (void)c, (void)stays, (void)impulse;
    if (change >= NG || model_change_impulse[change] >= 0) *(int *)context = 1;
}

static CoreStatus fire_at(Core *c, double t, const Observer *told, int begins, int *happened) {
    int changed;
    c->t = t;
    core_stale(c);
    return core_fire(c, -1, told, begins, happened, &changed);
}

/* Go back to where start values were sought, in modes that were tried. */
static CoreStatus go_back(Core *c, const double y[], const double modes[]) {
    forget(c);
    memcpy(c->y, y, NY * sizeof *y);
    memcpy(core_modes(c), modes, NM * sizeof *modes);
    memset(c->q + NP + NM, 0, (NI + NK) * sizeof *c->q);
    core_stale(c);
    return core_complete(c);
}

/* Fire what happens at the start. A signal that jumps in the first instant acts on what was just before. */
static CoreStatus fire_first(Core *c, const Observer *told, int *happened) {
    double y[ROOM(NY)], modes[ROOM(NM)], earlier[ROOM(NM)];
    double t = c->t, before = t - fmax(JUST_BEFORE, 8 * DBL_EPSILON * fabs(t));
    int jumps = 0, had = 0;
    if (!NSIGNAL) return fire_at(c, t, told, 1, happened);
    memcpy(y, c->y, NY * sizeof *y);
    memcpy(modes, core_modes(c), NM * sizeof *modes);
    int known = fire_at(c, before, 0, 1, happened) == CORE_OK;
    memcpy(earlier, core_modes(c), NM * sizeof *earlier);
    c->t = t;
    CoreStatus status = go_back(c, y, modes);
    if (status == CORE_OK) status = fire_at(c, t, told, 1, happened);
    for (int i = 0; i < NM; i++) jumps |= known && model_jump_mode[i] && core_modes(c)[i] != earlier[i];
    if (status != CORE_OK || !jumps) return status;
    status = go_back(c, y, modes);
    if (status == CORE_OK) status = fire_at(c, before, told, 1, &had);
    if (status == CORE_OK) status = fire_at(c, t, told, 0, happened);
    c->t = t;
    *happened |= had;
    return status;
}

CoreStatus core_begin(Core *c, const Given *given, StartRoom *room) {
    double settled[ROOM(NY)];
    memcpy(c->q + NP, model_first_mode, NM * sizeof *c->q);
    memset(c->q + NP + NM, 0, (NI + NK) * sizeof *c->q);
    for (int round = 0; round < START_ROUNDS; round++) {
        int struck = 0, happened, agree = 1;
        Observer observer = {&struck, note_shock, 0, 0};
        forget(c);
        memset(c->y, 0, sizeof c->y);
        CoreStatus status = core_complete(c);
        if (status == CORE_OK) status = seek(c, given, room);
        if (status == CORE_OK) status = fire_first(c, &observer, &happened);
        if (status != CORE_OK || !happened || !NFIXED || struck) return status;
        memcpy(settled, c->y, sizeof settled);
        status = seek(c, given, room);
        if (status != CORE_OK) return status;
        for (int i = 0; i < NX; i++) agree &= fabs(c->y[i] - settled[i]) <= 1e-12 * fabs(settled[i]) + 1e-14;
        if (!agree) continue;
        memcpy(c->y, settled, sizeof settled);
        core_stale(c);
        return CORE_OK;
    }
    return core_fail(c, CORE_ERROR,
                     "start values and modes do not agree with each other; fix states instead of "
                     "accelerations or forces");
}

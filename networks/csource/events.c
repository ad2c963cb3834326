/* Transitions: which fire at an instant, again until none is left, and whether they do so without end. */
#include <math.h>
#include <string.h>

#include "core_state.h"

int core_leavable(const Core *c, int i) {
    return core_mode(c, model_change_mode[i]) == model_change_source[i];
}

int core_can_fire(const Core *c, int i) { return core_leavable(c, i) && !c->muted[i]; }

void core_list_open(Core *c) {
    c->open_count = 0;
    for (int i = 0; i < NG; i++)
        if (core_leavable(c, i)) c->open[c->open_count++] = i;
}

double core_near_zero(const Core *c, int i) {
    return core_larger(INDICATOR_FLOOR, INDICATOR_ROUNDING * c->seen[i]);
}

/* Forget how large indicators and their rates have been. */
void core_forget_sizes(Core *c) {
    memset(c->seen, 0, sizeof c->seen);
    for (int i = 0; i < NG; i++) c->fastest[i] = 1;
}

/* Evaluate indicators and their rates where states have `rates`; remember their size. */
int core_watch(Core *c, double t, const double y[], const double rates[], Watched *w) {
    double sum = 0;
    if (NG == 0) return 1;
    memcpy(c->trial, rates, NY * sizeof *rates);
    if (!core_algebra_rates(c, t, y, c->trial)) return 0;
    Call call = {.arg = {[5] = c->trial, c->trial + NX, c->u_rate}, .res = {w->value, w->rate}};
    core_evaluate(c, model_watch, t, y, &call);
    for (int i = 0; i < NG; i++) {
        sum += fabs(w->value[i]) + fabs(w->rate[i]);
        c->seen[i] = core_larger(fabs(w->value[i]), c->seen[i]);
        c->fastest[i] = core_larger(fabs(w->rate[i]), c->fastest[i]);
    }
    return isfinite(sum);
}

/* Evaluate them where the core stands, with rates that are fresh, unless that is done. */
int core_watch_here(Core *c) {
    if (c->fresh & FRESH_LEFT) return 1;
    if (!core_watch(c, c->t, c->y, c->rates, &c->left)) return 0;
    c->fresh |= FRESH_LEFT;
    return 1;
}

void core_switching(Core *c) { core_evaluate(c, model_switch, c->t, c->y, &(Call){.res = {c->expressions}}); }

static int is_ready(const Core *c, int i, int forced) {
    if (!core_can_fire(c, i)) return 0;
    const double *g = c->left.value, *rate = c->left.rate, near = core_near_zero(c, i);
    int rising = rate[i] > RATE_NOISE * c->fastest[i];
    int ready = g[i] > near || (g[i] > -near && rising);
    if (g[i] <= LEAVING_RATIO * near && rate[i] < -RATE_NOISE * c->fastest[i]) ready = 0;
    if (forced >= 0 && model_change_mode[i] == model_change_mode[forced])
        ready = ready || (g[i] == g[forced] && rate[i] == rate[forced]);
    return ready;
}

/* List what fires, the strongest of each mode, by number. Returns how many, or -1. */
static int firing(Core *c, int forced, int fired[]) {
    int strongest[ROOM(NM)], count = 0, any = 0;
    if (core_rates(c, 0) != CORE_OK || !core_watch_here(c)) return -1;
    for (int i = 0; i < NG && !any; i++) any = is_ready(c, i, forced);
    if (!any) return 0;
    core_switching(c);
    for (int m = 0; m < NM; m++) strongest[m] = -1;
    for (int i = 0; i < NG; i++) {
        int allowed = model_change_allowed[i], *best = strongest + model_change_mode[i];
        if (!is_ready(c, i, forced) || (allowed >= 0 && c->expressions[allowed] == 0)) continue;
        if (*best < 0 ||
            c->left.value[i] / core_near_zero(c, i) >= c->left.value[*best] / core_near_zero(c, *best))
            *best = i;
    }
    for (int i = 0; i < NG; i++)
        if (strongest[model_change_mode[i]] == i) fired[count++] = i;
    return count;
}

/* Tell whether a transition would fire here, -1 if indicators are not finite. */
int core_any_due(Core *c) {
    int fired[ROOM(NG)], count = firing(c, -1, fired);
    return count < 0 ? -1 : count > 0;
}

static uint64_t mixed(uint64_t hash, const void *bytes, size_t count) {
    const unsigned char *byte = bytes;
    for (size_t i = 0; i < count; i++) hash = (hash ^ byte[i]) * UINT64_C(1099511628211);
    return hash;
}

static uint64_t situation(Core *c, const int fired[], int count) {
    uint64_t hash = mixed(UINT64_C(14695981039346656037), core_modes(c), NM * sizeof(double));
    hash = mixed(hash, c->y, NX * sizeof(double));
    return mixed(hash, fired, (size_t)count * sizeof *fired);
}

/* Remember that a transition has fired. */
static void note(Core *c, int change) { c->noted[change] = ++c->notes; }

/* Say which components fired last, by name, each once. */
static void say_latest(Core *c, int count) {
    const char *last = "", *next;
    long long since = c->notes > count ? c->notes - count : 0;
    for (;; last = next) {
        next = 0;
        for (int i = 0; i < NG; i++) {
            const char *name = model_component[i];
            if (c->noted[i] > since && strcmp(name, last) > 0 && (!next || strcmp(name, next) < 0))
                next = name;
        }
        if (!next) return;
        core_say_more(c, "%s%s", *last ? ", " : "", next);
    }
}

static CoreStatus chatters(Core *c, int count, double since) {
    core_fail(c, CORE_ERROR, "chattering: %g events within %g s at t = %g s, from ", (double)count,
              c->t - since, c->t);
    say_latest(c, count);
    core_say_more(c, "; give it a resting speed, hysteresis or some compliance");
    return CORE_ERROR;
}

/* Tell if there are very many events in next to no time, or more in an interval than can be meant. */
CoreStatus core_watch_chatter(Core *c) {
    c->recent[c->landings++ % CHATTER_COUNT] = c->t;
    double oldest = c->recent[c->landings % CHATTER_COUNT];
    if (c->landings >= CHATTER_COUNT && oldest <= c->t && c->t - oldest < CHATTER_WINDOW * c->interval)
        return chatters(c, CHATTER_COUNT, oldest);
    if (c->t - c->mark > c->interval) {
        c->mark = c->t;
        c->mark_count = 0;
    }
    return ++c->mark_count > c->crowd ? chatters(c, c->mark_count, c->mark) : CORE_OK;
}

/* Apply changes: shocks first, then modes, then resets. */
static CoreStatus apply(Core *c, const int fired[], int count, const Observer *told, int begins,
                        int *changed) {
    int changes[ROOM(NG)], stays[ROOM(NG)] = {0}, kept = 0, shocked = 0;
    double impulses[ROOM(NG)] = {0}, seen[ROOM(NREAD)];
    CoreStatus status;
    core_see(c, seen);
    for (int k = 0; k < count; k++)
        if (model_change_impulse[fired[k]] < 0) changes[kept++] = fired[k];
    for (int k = 0; k < count; k++)
        if (model_change_impulse[fired[k]] >= 0) changes[kept + shocked++] = fired[k];
    if (shocked) {
        status = core_strike(c, changes + kept, stays + kept, impulses + kept, &shocked);
        if (status != CORE_OK) return status;
        *changed = 1;
        core_switching(c);
        kept += shocked;
    }
    for (int k = 0; k < kept; k++) {
        int mode = model_change_mode[changes[k]];
        note(c, changes[k]);
        core_modes(c)[mode] = model_change_target[changes[k]];
        for (int i = 0; i < NG; i++)
            if (model_change_mode[i] == mode) c->muted[i] = 0;
        if (model_reset_start[changes[k]] < model_reset_start[changes[k] + 1]) *changed = 1;
    }
    status = core_complete(c);
    if (status != CORE_OK) return status;
    core_reset_variables(c, changes, kept, seen);
    core_stale(c);
    for (int k = 0; k < kept; k++)
        if (told && told->fired) told->fired(told->context, c, changes[k], stays[k], impulses[k]);
    return begins ? core_rates(c, 0) : core_jump(c, seen, told, changed);
}

static CoreStatus check_adrift(Core *c) {
    if (!c->adrift) return CORE_OK;
    return core_fail(
        c, CORE_ERROR,
        "at t = %g s nothing with inertia moves with %s, which no longer holds; join a Mass "
        "(or an Inertia) where it slides, or, if a spring is in series with it, take a Jenkins for "
        "both",
        c->t, model_block_label[c->adrift - 1]);
}

static CoreStatus forever(Core *c) {
    core_fail(c, CORE_ERROR, "no consistent set of modes at t = %g s; these switch for ever: ", c->t);
    say_latest(c, FIRING_TOLD);
    return CORE_ERROR;
}

CoreStatus core_fire(Core *c, int forced, const Observer *told, int begins, int *happened, int *changed) {
    uint64_t visited[FIRING_ROUNDS];
    int fired[ROOM(NG)], count = 0, one_by_one = 0, since = 0, adrift = 0, waited = forced;
    CoreStatus status = core_complete(c);
    *happened = *changed = 0;
    c->pending = 0;
    if (status != CORE_OK) return status;
    c->fresh = 0;
    for (int round = 0; round < FIRING_ROUNDS; round++) {
        count = firing(c, forced, fired);
        forced = -1;
        if (count < 0) {
            if (core_rates(c, 0) != CORE_OK) return CORE_DISCARD;
            return core_fail(c, CORE_DISCARD, "indicators are not finite");
        }
        if (count == 0) {
            if (!*happened && waited >= 0) c->muted[waited] = 1;
            return check_adrift(c);
        }
        visited[round] = situation(c, fired, count);
        int visits = 0;
        for (int k = since; k < round; k++) visits += visited[k] == visited[round];
        if (visits && !one_by_one) {
            one_by_one = 1;
            since = round;
            visits = 0;
        }
        if (one_by_one) /* another of them each time this situation comes back */
            status = apply(c, fired + visits % count, 1, told, begins, changed);
        else status = apply(c, fired, count, told, begins, changed);
        if (status != CORE_OK) return status;
        if (c->adrift) adrift = c->adrift;
        *happened = 1;
    }
    c->adrift = adrift;
    status = check_adrift(c);
    return status == CORE_OK ? forever(c) : status;
}

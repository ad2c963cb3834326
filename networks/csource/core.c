/* Numbers by kind, and what is evaluated from them. */
#include <math.h>
#include <string.h>

#include "core_state.h"

void core_stale(Core *c) {
    c->fresh = 0;
    c->slope_fresh = 0;
    c->pending = 0;
    c->ahead = 0;
}

/* Something was set: what followed from it is stale, and may soon be so again. */
static void touch(Core *c) {
    core_stale(c);
    c->calm = 0;
}

double *core_modes(Core *c) { return c->q + NP; }

void core_reset(Core *c) {
    memset(c, 0, sizeof *c);
    for (int i = 0; i < NY; i++) c->y[i] = model_start[i];
    for (int i = 0; i < NP; i++) c->q[i] = model_parameter[i];
    for (int i = 0; i < NG; i++) c->fastest[i] = 1;
    c->u_time = NAN;
    c->interval = 1;
    c->reach = -INFINITY;
    c->crowd = CROWD_COUNT;
}

double core_time(const Core *c) { return c->t; }
double core_state(const Core *c, int i) { return c->y[i]; }
double core_input(const Core *c, int i) { return c->free[i]; }
double core_parameter(const Core *c, int i) { return c->q[i]; }
int core_mode(const Core *c, int i) { return (int)c->q[NP + i]; }

static CoreStatus not_finite(Core *c, const char *name, double value) {
    return core_fail(c, CORE_ERROR, "%s must be a finite number, got %g", name, value);
}

static CoreStatus set(Core *c, const char *name, double *number, double value) {
    if (!isfinite(value)) return not_finite(c, name, value);
    if (value != *number) touch(c);
    *number = value;
    return CORE_OK;
}

CoreStatus core_set_time(Core *c, double t) {
    if (t != c->t && isfinite(t)) c->free_since = t;
    return set(c, "time", &c->t, t);
}

CoreStatus core_set_state(Core *c, int i, double value) {
    return set(c, model_unknown_name[i], c->y + i, value);
}

CoreStatus core_set_states(Core *c, const double x[]) {
    for (int i = 0; i < NX; i++)
        if (!isfinite(x[i])) return not_finite(c, model_unknown_name[i], x[i]);
    for (int i = 0; i < NX; i++) core_set_state(c, i, x[i]);
    return CORE_OK;
}

CoreStatus core_set_input(Core *c, int i, double value) {
    if (value != c->free[i]) c->u_time = NAN;
    return set(c, model_input_name[i], c->free + i, value);
}

CoreStatus core_set_slope(Core *c, int i, double value) {
    if (model_input_rate[i] >= 0) return core_set_input(c, model_input_rate[i], value);
    if (!isfinite(value))
        return core_fail(c, CORE_ERROR, "%s: its derivative must be a finite number, got %g",
                         model_input_name[i], value);
    c->drift[i] = value;
    c->u_time = NAN;
    touch(c);
    return CORE_OK;
}

CoreStatus core_set_parameter(Core *c, int i, double value) {
    const char *name = model_parameter_name[i], *unit = model_parameter_unit[i];
    double least = model_least[i], most = model_most[i];
    if (!isfinite(value)) return not_finite(c, name, value);
    if (model_open[i] ? value <= least : value < least)
        core_fail(c, CORE_ERROR, "%s is too small, got %g; it must be %s %g", name, value,
                  model_open[i] ? "above" : "at least", least);
    else if (value > most)
        core_fail(c, CORE_ERROR, "%s is too great, got %g; it must be at most %g", name, value, most);
    else return set(c, name, c->q + i, value);
    if (strcmp(unit, "1") != 0) core_say_more(c, " %s", unit);
    return CORE_ERROR;
}

/* A free input at an instant: a polynomial of it and those that are its derivatives, since they were set. */
double core_free_at(const Core *c, int i, double t) {
    double value = 0, power = 1, since = t - c->free_since;
    for (int order = 1; i >= 0; order++) {
        int next = model_input_rate[i];
        value += power * c->free[i];
        power *= since / order;
        if (next < 0) value += power * c->drift[i];
        i = next;
    }
    return value;
}

static void inputs_at(Core *c, double t) {
    if (NA == 0 || c->u_time == t) return;
    Call call = {{&t}, {c->u, c->u_rate}};
    c->u_time = t;
    if (NU < NA) model_inputs(call.arg, call.res, c->iw, c->w, 0);
    for (int i = 0; i < NU; i++) {
        int at = model_input_at[i], sign = model_input_sign[i], next = model_input_rate[i];
#ifdef CORE_RECORDS
        if (c->records[i]) {
            double value, rate;
            core_record_at(c->records[i], t, &value, &rate);
            c->u[at] = sign * value;
            c->u_rate[at] = sign * rate;
            continue;
        }
#endif
        c->u[at] = sign * core_free_at(c, i, t);
        c->u_rate[at] = sign * (next < 0 ? c->drift[i] : core_free_at(c, next, t));
    }
}

void core_evaluate(Core *c, ModelFunction function, double t, const double y[], Call *call) {
    inputs_at(c, t);
    c->work++;
    call->arg[0] = y;
    call->arg[1] = y + NX;
    call->arg[2] = c->u;
    call->arg[3] = c->q;
    call->arg[4] = &t;
    function(call->arg, call->res, c->iw, c->w, 0);
}

int core_motion_at(Core *c, double t, const double y[], double rates[]) {
    double sum = 0;
    core_evaluate(c, model_motion, t, y, &(Call){.res = {rates}});
    for (int i = 0; i < NY; i++) sum += fabs(rates[i]);
    return isfinite(sum);
}

void core_slope_at(Core *c, double t, const double y[]) {
    core_evaluate(c, model_slope, t, y, &(Call){.arg = {[5] = c->u_rate}, .res = {c->slope, c->by_time}});
    for (int k = 0; k < NSLOPE; k++) /* at a corner there may be no slope: the error control sees to that */
        if (!isfinite(c->slope[k])) c->slope[k] = 0;
    for (int i = 0; i < NY; i++)
        if (!isfinite(c->by_time[i])) c->by_time[i] = 0;
    c->slope_fresh = 0;
}

static CoreStatus impossible(Core *c, const char *what) {
    return core_fail(c, CORE_DISCARD, "%s at t = %g s", what, c->t);
}

static CoreStatus fresh_algebra(Core *c) {
    if (c->fresh & FRESH_ALGEBRA) return CORE_OK;
    if (!core_solve_algebra(c, c->t, c->y)) return impossible(c, "the algebraic equations have no solution");
    c->fresh |= FRESH_ALGEBRA;
    return CORE_OK;
}

CoreStatus core_rates(Core *c, const double **rates) {
    CoreStatus status = fresh_algebra(c);
    if (status != CORE_OK) return status;
    if (!(c->fresh & FRESH_RATES)) {
        if (!core_motion_at(c, c->t, c->y, c->rates))
            return impossible(c, "the rates of the states are not finite");
        c->fresh |= FRESH_RATES;
    }
    if (rates) *rates = c->rates;
    return CORE_OK;
}

CoreStatus core_variables(Core *c, const double **w) {
    CoreStatus status = fresh_algebra(c);
    if (status != CORE_OK) return status;
    if (!(c->fresh & FRESH_VARIABLES)) {
        double sum = 0;
        core_evaluate(c, model_variables, c->t, c->y, &(Call){.res = {c->variables}});
        for (int i = 0; i < NW; i++) sum += fabs(c->variables[i]);
        if (!isfinite(sum)) return impossible(c, "variables are not finite");
        c->fresh |= FRESH_VARIABLES;
    }
    *w = c->variables;
    return CORE_OK;
}

/* A transition that can fire crosses zero a little late, so that it surely fires when it is settled; one that
 * cannot keeps below. */
CoreStatus core_indicators(Core *c, const double **g) {
    CoreStatus status = core_rates(c, 0);
    if (status != CORE_OK) return status;
    if (!(c->fresh & FRESH_INDICATORS)) {
        if (!core_watch_here(c)) return impossible(c, "indicators are not finite");
        for (int i = 0; i < NG; i++)
            c->indicators[i] =
                core_leavable(c, i) ? c->left.value[i] - c->raised[i] - 2 * core_near_zero(c, i) : -1;
        c->fresh |= FRESH_INDICATORS;
    }
    *g = c->indicators;
    return CORE_OK;
}

/* An integrator may look beyond the data, but no step may end there. */
int core_knows_inputs(Core *c, double t) {
    const double slack = 1e-9 * (fabs(t) + 1);
    if (model_data_span[0] - slack <= t && t <= model_data_span[1] + slack) return 1;
    core_fail(c, CORE_ERROR,
              "the data of its inputs are from %g to %g s, and nothing is known of them at %g s",
              model_data_span[0], model_data_span[1], t);
    return 0;
}

/* An integrator outside sees only signs at the ends of its steps: what falls now must count as negative,
 * or a short hop, down and up again within one step, goes unseen. */
static void raise_falling(Core *c) {
    for (int i = 0; i < NG; i++)
        c->raised[i] = core_leavable(c, i) && c->left.rate[i] < 0 ? fmax(0, c->left.value[i]) : 0;
    c->fresh &= ~FRESH_INDICATORS;
}

/* What begins does not jump. */
CoreStatus core_start(Core *c) {
    int happened, changed;
    if (!core_knows_inputs(c, c->t)) return CORE_ERROR;
    core_stale(c);
    c->h = 0;
    core_find_leg(c);
    CoreStatus status = core_fire(c, -1, 0, 1, &happened, &changed);
    if (status == CORE_OK) raise_falling(c);
    return status;
}

CoreStatus core_settle(Core *c, int *changed) {
    int happened, jumped = 0, forced = c->pending - 1;
    CoreStatus status = core_enter_legs(c, &jumped);
    if (status == CORE_OK) status = core_fire(c, forced, 0, 0, &happened, changed);
    *changed |= jumped;
    if (status == CORE_OK) raise_falling(c);
    return status;
}

CoreStatus core_due(Core *c, int *due) {
    if (!core_knows_inputs(c, c->t)) return CORE_ERROR;
    *due = core_any_due(c);
    return *due < 0 ? impossible(c, "indicators are not finite") : CORE_OK;
}

CoreStatus core_advance(Core *c, double stop, double rtol, double atol, double fixed_step, int return_early,
                        CoreStop *reached) {
    return core_advance_told(c, stop, rtol, atol, fixed_step, return_early, 0, reached);
}

CoreStatus core_advance_told(Core *c, double stop, double rtol, double atol, double fixed_step,
                             int return_early, const Observer *told, CoreStop *reached) {
    /* What is given may have jumped since the last step; inside a step that goes on, nothing has. */
    int happened, changed, due = c->ahead ? 0 : core_any_due(c);
    if (due < 0) return impossible(c, "indicators are not finite");
    *reached = CORE_EVENT;
    if (due && return_early) return CORE_OK;
    CoreStatus status = due ? core_fire(c, c->pending - 1, 0, 0, &happened, &changed) : CORE_OK;
    if (status != CORE_OK) return status;
    c->interval = stop - c->t;
    return core_travel(c, stop, rtol, atol, fixed_step, return_early, told, reached);
}

/* Instances: their phases, what they say, and how they begin, settle and step. */
#include "fmi_common.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define ABSOLUTE_SHARE 3e-3 /* of the relative tolerance, times the nominal value of each state */
#define LOCAL_ERROR_SHARE 3e-2 /* of the tolerance asked for, so that many steps add up to no more */
#define FINEST_TOLERANCE 1e-12
#define RUN_INTERVALS 500 /* of a run of model exchange, whose outputs nobody tells */
#define POINT_TOLERANCE 1e-9 /* communication points closer than this, against their size, are one */

static const double inputs[ROOM(NU)] = FMU_INPUTS;

static void reset(Instance *c) {
    memset(&c->now, 0, sizeof c->now);
    core_reset(&c->now.core);
    core_given(&c->now.given);
    for (int i = 0; i < NU; i++) core_set_input(&c->now.core, i, inputs[i]);
    c->now.phase = INSTANTIATED;
    c->now.tolerance = FMU_TOLERANCE;
    c->now.stop = INFINITY;
}

void face_start(Instance *c, Kind kind) {
    c->kind = kind;
    reset(c);
}

static Status say(Instance *c, Status status, const char *why) {
    char message[MESSAGE + 64];
    snprintf(message, sizeof message, "%s: %s", c->function, why);
    face_log(c, status, status == FMI(Error) ? "logStatusError" : "logStatusDiscard", message);
    return status;
}

Status face_refuse(Instance *c, const char *why) { return say(c, FMI(Error), why); }

Status face_accepted(Instance *c, CoreStatus status) {
    return status == CORE_OK ? FMI(OK) : face_refuse(c, core_message(&c->now.core));
}

Status face_outcome(Instance *c, CoreStatus status) {
    if (status == CORE_OK) return FMI(OK);
    if (status == CORE_ERROR) c->now.phase = FAILED;
    return say(c, status == CORE_DISCARD ? FMI(Discard) : FMI(Error), core_message(&c->now.core));
}

static const char *phase_name(int phase) {
    switch (phase) {
    case INSTANTIATED: return "instantiated";
    case INITIALIZATION: return "in initialization mode";
    case EVENT_MODE: return "in event mode";
    case CONTINUOUS_TIME: return "in continuous-time mode";
    case STEP_MODE: return "in step mode";
    case STEP_FAILED: return "in the middle of a failed step";
    case TERMINATED: return "terminated";
    case INTERMEDIATE: return "in intermediate update mode";
    default: return "in error";
    }
}

int face_may(Instance *c, const char *function, int phases, int kinds) {
    char why[128];
    if (!c) return 0;
    c->function = function;
    if (!(c->kind & kinds)) {
        int steps = c->kind == CO_SIMULATION;
        face_refuse(c, steps ? "this instance was made for co-simulation"
                             : "this instance was made for model exchange");
        return 0;
    }
    if (c->now.phase & phases) return 1;
    snprintf(why, sizeof why, "may not be called while the instance is %s", phase_name(c->now.phase));
    face_refuse(c, why);
    return 0;
}

int face_missing(Instance *c, size_t n, const void *refs, const void *values) {
    return n > 0 && (!refs || !values) && face_refuse(c, "an array is missing") != FMI(OK);
}

Status face_bad_reference(Instance *c, uint32_t ref) {
    char why[96];
    snprintf(why, sizeof why, "value reference %lu does not fit here", (unsigned long)ref);
    return face_refuse(c, why);
}

Status face_no_such(Instance *c, size_t n) {
    return n ? face_refuse(c, "there are no variables of this type") : FMI(OK);
}

/* Find start values and modes, unless that is done. */
static CoreStatus begin(Instance *c) {
    CoreStatus status = CORE_OK;
    if (!c->now.begun) status = core_begin(&c->now.core, &c->now.given, &c->room);
    c->now.begun = status == CORE_OK;
    return status;
}

int face_ready(Instance *c) {
    return c->now.phase != INITIALIZATION || face_accepted(c, begin(c)) == FMI(OK);
}

Status face_experiment(Instance *c, int tolerance_defined, double tolerance, double start, int stop_defined,
                       double stop) {
    if (tolerance_defined && !(tolerance > 0 && tolerance < 1))
        return face_refuse(c, "the tolerance must lie between 0 and 1");
    if (!isfinite(start)) return face_refuse(c, "the start time must be a finite number");
    if (stop_defined && !(stop >= start)) return face_refuse(c, "the stop time lies before the start");
    if (face_accepted(c, core_set_time(&c->now.core, start)) != FMI(OK)) return FMI(Error);
    c->now.tolerance = tolerance_defined ? tolerance : FMU_TOLERANCE;
    c->now.start = start;
    c->now.stop = stop_defined ? stop : INFINITY;
    if (stop_defined) c->now.core.interval = (stop - start) / RUN_INTERVALS;
    return FMI(OK);
}

Status face_settle(Instance *c, int *states_changed) {
    Core *core = &c->now.core;
    long long before = core->notes;
    CoreStatus status = core_settle(core, states_changed);
    int lands = c->kind == MODEL_EXCHANGE && core->notes > before && isfinite(c->now.stop);
    if (status == CORE_OK && lands) status = core_watch_chatter(core);
    return face_outcome(c, status);
}

static double slack(double point) { return POINT_TOLERANCE * fmax(1.0, fabs(point)); }

Status face_step(Instance *c, double point, double size, CoreStop *reached) {
    double stop = point + size, asked = c->now.tolerance;
    double rtol = fmax(LOCAL_ERROR_SHARE * asked, fmin(asked, FINEST_TOLERANCE));
    if (!isfinite(point) || fabs(point - core_time(&c->now.core)) > slack(point))
        return face_refuse(c, "the communication point is not where the last step ended");
    if (!(size > 0) || !isfinite(stop)) return face_refuse(c, "the step must be positive and finite");
    if (face_untold_rate(c) != FMI(OK)) return FMI(Error);
    if (stop > c->now.stop + slack(c->now.stop)) return face_refuse(c, "the step leads beyond the stop time");
    Observer room;
    c->now.core.reach = c->now.stop;
    CoreStatus status =
        core_advance_told(&c->now.core, stop, rtol, ABSOLUTE_SHARE * rtol, FMU_FIXED_STEP,
                          c->event_mode_used && c->may_return_early, face_observer(c, &room), reached);
    if (c->now.phase == FAILED) return FMI(Error);
    /* With error control smaller steps were tried already: no other step of communication would help. */
    return face_outcome(c, status == CORE_DISCARD && !(FMU_FIXED_STEP > 0) ? CORE_ERROR : status);
}

const char *FMI(GetVersion)(void) { return FMI(Version); }

/* There are only messages that say why something was not done: none can be left out. */
Status FMI(SetDebugLogging)(void *instance, FMI(Boolean) on, size_t n, const FMI(String) categories[]) {
    ENTER(ANY_PHASE, EITHER);
    return face_missing(c, n, categories, categories) ? FMI(Error) : FMI(OK);
}

Status FMI(ExitInitializationMode)(void *instance) {
    ENTER(INITIALIZATION, EITHER);
    CoreStatus status = begin(c);
    if (status == CORE_OK) status = core_start(&c->now.core);
    if (status != CORE_OK) return face_outcome(c, CORE_ERROR);
    c->now.phase = c->kind == MODEL_EXCHANGE || c->event_mode_used ? EVENT_MODE : STEP_MODE;
    return FMI(OK);
}

Status FMI(Terminate)(void *instance) {
    ENTER(RUNNING | STEP_FAILED, EITHER);
    c->now.phase = TERMINATED;
    return FMI(OK);
}

Status FMI(Reset)(void *instance) {
    ENTER(ANY_PHASE, EITHER);
    reset(c);
    return FMI(OK);
}

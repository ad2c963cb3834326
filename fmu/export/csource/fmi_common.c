/* Instances: their phases, what they say, and how they begin, settle and step. */
#include "fmi_common.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define ABSOLUTE 1e-4 /* of the relative tolerance, times the nominal value of each state */
#define LOCAL 1e-2    /* error of one step, of the tolerance asked for: many steps add up to no more */
#define FINEST 1e-12
#define INTERVALS 500 /* of a run of model exchange, whose outputs nobody tells */
#define NEAR 1e-9 /* communication points closer than this, against their size, are one */

static const double inputs[ROOM(NU)] = FMU_INPUTS;

void face_start(Instance *c, Kind kind, Logger log) {
    c->kind = kind;
    c->log = log;
    face_reset(c);
}

void face_reset(Instance *c) {
    memset(&c->now, 0, sizeof c->now);
    core_reset(&c->now.core);
    core_given(&c->now.given);
    for (int i = 0; i < NU; i++) core_set_input(&c->now.core, i, inputs[i]);
    c->now.phase = INSTANTIATED;
    c->now.tolerance = FMU_TOLERANCE;
    c->now.stop = INFINITY;
}

FaceStatus face_refuse(Instance *c, const char *function, const char *why) {
    char message[MESSAGE + 64];
    snprintf(message, sizeof message, "%s: %s", function, why);
    c->log(c, FACE_ERROR, message);
    return FACE_ERROR;
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
    default: return "in error";
    }
}

int face_may(Instance *c, const char *function, int phases, int kinds) {
    char why[128];
    if (!c) return 0;
    if (!(c->kind & kinds)) {
        face_refuse(c, function,
                    c->kind == CO_SIMULATION ? "this instance was made for co-simulation"
                                             : "this instance was made for model exchange");
        return 0;
    }
    if (c->now.phase & phases) return 1;
    snprintf(why, sizeof why, "may not be called while the instance is %s", phase_name(c->now.phase));
    face_refuse(c, function, why);
    return 0;
}

FaceStatus face_outcome(Instance *c, const char *function, CoreStatus status) {
    char message[MESSAGE + 64];
    FaceStatus told = status == CORE_DISCARD ? FACE_DISCARD : FACE_ERROR;
    if (status == CORE_OK) return FACE_OK;
    if (status == CORE_ERROR) c->now.phase = FAILED;
    snprintf(message, sizeof message, "%s: %s", function, core_message(&c->now.core));
    c->log(c, told, message);
    return told;
}

FaceStatus face_refuse_number(Instance *c, const char *function) {
    return face_refuse(c, function, core_message(&c->now.core));
}

int face_missing(size_t n, const void *refs, const void *values) { return n > 0 && (!refs || !values); }

FaceStatus face_bad_reference(Instance *c, const char *function, uint32_t ref) {
    char why[96];
    snprintf(why, sizeof why, "value reference %lu does not fit here", (unsigned long)ref);
    return face_refuse(c, function, why);
}

FaceStatus face_no_such(Instance *c, const char *function, size_t n) {
    return n ? face_refuse(c, function, "there are no variables of this type") : FACE_OK;
}

/* Find start values and modes, unless that is done. */
static CoreStatus begin(Instance *c) {
    CoreStatus status = CORE_OK;
    if (!c->now.begun) status = core_begin(&c->now.core, &c->now.given, &c->room);
    c->now.begun = status == CORE_OK;
    return status;
}

FaceStatus face_ready(Instance *c, const char *function) {
    if (c->now.phase != INITIALIZATION || begin(c) == CORE_OK) return FACE_OK;
    return face_refuse_number(c, function);
}

FaceStatus face_experiment(Instance *c, const char *function, int tolerance_defined, double tolerance,
                           double start, int stop_defined, double stop) {
    if (tolerance_defined && !(tolerance > 0 && tolerance < 1))
        return face_refuse(c, function, "the tolerance must lie between 0 and 1");
    if (!isfinite(start)) return face_refuse(c, function, "the start time must be a finite number");
    if (stop_defined && !(stop >= start))
        return face_refuse(c, function, "the stop time lies before the start");
    if (core_set_time(&c->now.core, start) != CORE_OK) return face_refuse_number(c, function);
    c->now.tolerance = tolerance_defined ? tolerance : FMU_TOLERANCE;
    c->now.start = start;
    c->now.stop = stop_defined ? stop : INFINITY;
    if (stop_defined) c->now.core.interval = (stop - start) / INTERVALS;
    return FACE_OK;
}

FaceStatus face_initialize(Instance *c, const char *function) {
    CoreStatus status = begin(c);
    if (status == CORE_OK) status = core_start(&c->now.core);
    return face_outcome(c, function, status == CORE_OK ? CORE_OK : CORE_ERROR);
}

FaceStatus face_settle(Instance *c, const char *function, int *states_changed) {
    Core *core = &c->now.core;
    long long before = core->notes;
    CoreStatus status = core_settle(core, states_changed);
    int lands = c->kind == MODEL_EXCHANGE && core->notes > before && isfinite(c->now.stop);
    if (status == CORE_OK && lands) status = core_watch_chatter(core);
    return face_outcome(c, function, status);
}

/* Whether an integrator has stepped over an event, twice through zero within one step. */
FaceStatus face_due(Instance *c, const char *function, int *due) {
    return face_outcome(c, function, core_due(&c->now.core, due));
}

static double slack(double point) { return NEAR * fmax(1.0, fabs(point)); }

FaceStatus face_step(Instance *c, const char *function, double point, double size, CoreStop *reached) {
    double stop = point + size, asked = c->now.tolerance, rtol = fmax(LOCAL * asked, fmin(asked, FINEST));
    if (!isfinite(point) || fabs(point - core_time(&c->now.core)) > slack(point))
        return face_refuse(c, function, "the communication point is not where the last step ended");
    if (!(size > 0) || !isfinite(stop))
        return face_refuse(c, function, "the step must be positive and finite");
    if (face_untold_rate(c, function) != FACE_OK) return FACE_ERROR;
    if (stop > c->now.stop + slack(c->now.stop))
        return face_refuse(c, function, "the step leads beyond the stop time");
    CoreStatus status = core_advance(&c->now.core, stop, rtol, ABSOLUTE * rtol, FMU_FIXED_STEP,
                                     c->event_mode_used && c->may_return_early, reached);
    /* With error control smaller steps were tried already: no other step of communication would help. */
    return face_outcome(c, function, status == CORE_DISCARD && !(FMU_FIXED_STEP > 0) ? CORE_ERROR : status);
}

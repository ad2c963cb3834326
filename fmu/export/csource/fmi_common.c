#include "fmi_common.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define ABSOLUTE 1e-4 /* of the relative tolerance, times the nominal value of each state */
#define LOCAL \
    1e-2 /* error of one step, of the tolerance asked for: what many steps add up to stays within that */
#define FINEST 1e-12
#define NEAR 1e-9 /* communication points closer than this, against their size, are one */

static const uint32_t aims[ROOM(NAIM)] = FMU_AIMS; /* what refers to them */
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
    char message[256];
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
    char message[512];
    FaceStatus told = status == CORE_DISCARD ? FACE_DISCARD : FACE_ERROR;
    if (status == CORE_OK) return FACE_OK;
    if (status == CORE_ERROR) c->now.phase = FAILED;
    snprintf(message, sizeof message, "%s: %s", function, core_message(&c->now.core));
    c->log(c, told, message);
    return told;
}

/* A number that the core does not accept changes nothing. */
static FaceStatus refused_number(Instance *c, const char *function) {
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
    return refused_number(c, function);
}

static FaceStatus get_real(Instance *c, const char *function, uint32_t ref, double *value) {
    Core *core = &c->now.core;
    const double *numbers = NULL;
    CoreStatus status = CORE_OK;
    if (ref == REF_TIME) *value = core_time(core);
    else if (ref < REF_RATES) *value = core_state(core, (int)(ref - REF_STATES));
    else if (ref < REF_INPUTS) {
        status = core_rates(core, &numbers);
        if (status == CORE_OK) *value = numbers[ref - REF_RATES];
    } else if (ref < REF_PARAMETERS) *value = core_input(core, (int)(ref - REF_INPUTS));
    else if (ref < REF_VARIABLES) *value = core_parameter(core, (int)(ref - REF_PARAMETERS));
    else if (ref < REF_MODES) {
        status = core_variables(core, &numbers);
        if (status == CORE_OK) *value = numbers[ref - REF_VARIABLES];
    } else if (ref >= REF_INDICATORS && ref < REF_END) {
        status = core_indicators(core, &numbers);
        if (status == CORE_OK) *value = numbers[ref - REF_INDICATORS];
    } else return face_bad_reference(c, function, ref);
    return status == CORE_OK ? FACE_OK : face_outcome(c, function, CORE_DISCARD);
}

FaceStatus face_get_reals(Instance *c, const char *function, const uint32_t refs[], size_t n,
                          double values[]) {
    if (face_missing(n, refs, values)) return face_refuse(c, function, "an array is missing");
    if (face_ready(c, function) != FACE_OK) return FACE_ERROR;
    for (size_t i = 0; i < n; i++) {
        FaceStatus status = get_real(c, function, refs[i], &values[i]);
        if (status != FACE_OK) return status;
    }
    return FACE_OK;
}

static CoreStatus set_input(Instance *c, int i, double value) {
    Core *core = &c->now.core;
    c->now.moved[i] |= core_time(core) > c->now.start && value != core_input(core, i);
    c->now.told[i] |= value != 0;
    return core_set_input(core, i, value);
}

/* An input that moves while its derivative, which the equations hold, was never anything but zero. */
static FaceStatus untold_rate(Instance *c, const char *function) {
    char why[512];
    for (int i = 0; i < NU; i++) {
        int rate = model_input_rate[i];
        if (rate < 0 || !c->now.moved[i] || c->now.told[rate]) continue;
        snprintf(
            why, sizeof why,
            "input %.128s (derivative %d of it) changes, but its own derivative, an input too, was never anything but "
            "zero; set it as well, or export the network with exact=False where it prescribes a motion",
            model_input_name[i], model_input_order[i]);
        return face_refuse(c, function, why);
    }
    return FACE_OK;
}

/* Give a start value; what follows from it is found when it is asked for. */
static void set_start(Instance *c, uint32_t ref, double value) {
    Given *given = &c->now.given;
    for (int i = 0; i < NAIM; i++)
        if (aims[i] == ref) given->aim[i] = value;
    if (ref >= REF_STATES && ref < REF_RATES) given->x[ref - REF_STATES] = value;
}

/* The state that only follows from other start values, or -1. */
static int follower(uint32_t ref) {
    for (int i = 0; i < NLEAD; i++)
        if (ref == REF_STATES + (uint32_t)model_lead_state[i]) return model_lead_state[i];
    return -1;
}

static FaceStatus refuse_follower(Instance *c, const char *function, int state) {
    Core *core = &c->now.core;
    core_say(core, model_unknown_name[state]);
    core_say_more(core, " follows from other start values; set those of ");
    for (int i = 0; i < NAIM && i < 6; i++) {
        if (i) core_say_more(core, i < 5 ? ", " : ", ...");
        if (i < 5) core_say_more(core, model_aim_name[i]);
    }
    return refused_number(c, function);
}

static int is_start(uint32_t ref) {
    int found = ref >= REF_STATES && ref < REF_RATES;
    for (int i = 0; i < NAIM; i++) found |= aims[i] == ref;
    return found;
}

static FaceStatus set_real(Instance *c, const char *function, uint32_t ref, double value) {
    Core *core = &c->now.core;
    int phase = c->now.phase;
    int starting = phase & (INSTANTIATED | INITIALIZATION);
    int tuning = starting || phase == EVENT_MODE || (phase == STEP_MODE && !c->event_mode_used);
    CoreStatus status = CORE_OK;
    c->now.begun = c->now.begun && !starting;
    if (starting && is_start(ref)) {
        if (follower(ref) >= 0) return refuse_follower(c, function, follower(ref));
        if (!isfinite(value)) return face_refuse(c, function, "a start value must be a finite number");
        set_start(c, ref, value);
    } else if (ref >= REF_INPUTS && ref < REF_PARAMETERS)
        status = set_input(c, (int)(ref - REF_INPUTS), value);
    else if (ref >= REF_PARAMETERS && ref < REF_VARIABLES && tuning)
        status = core_set_parameter(core, (int)(ref - REF_PARAMETERS), value);
    else return face_bad_reference(c, function, ref);
    return status == CORE_OK ? FACE_OK : refused_number(c, function);
}

FaceStatus face_set_reals(Instance *c, const char *function, const uint32_t refs[], size_t n,
                          const double values[]) {
    if (face_missing(n, refs, values)) return face_refuse(c, function, "an array is missing");
    for (size_t i = 0; i < n; i++) {
        FaceStatus status = set_real(c, function, refs[i], values[i]);
        if (status != FACE_OK) return status;
    }
    return FACE_OK;
}

FaceStatus face_get_mode(Instance *c, const char *function, uint32_t ref, int *value) {
    if (ref < REF_MODES || ref >= REF_INDICATORS) return face_bad_reference(c, function, ref);
    if (face_ready(c, function) != FACE_OK) return FACE_ERROR;
    *value = core_mode(&c->now.core, (int)(ref - REF_MODES));
    return FACE_OK;
}

static int misfit(Instance *c, const char *function, const void *array, size_t n, size_t expected) {
    if (n == expected && (array || !n)) return 0;
    face_refuse(c, function, n == expected ? "an array is missing" : "the array has the wrong length");
    return 1;
}

static FaceStatus copied(const double *from, double to[], size_t n) {
    if (n) memcpy(to, from, n * sizeof *to);
    return FACE_OK;
}

FaceStatus face_set_slopes(Instance *c, const char *function, const uint32_t refs[], size_t n,
                           const double slopes[]) {
    if (face_missing(n, refs, slopes)) return face_refuse(c, function, "an array is missing");
    c->now.begun = c->now.begun && !(c->now.phase & (INSTANTIATED | INITIALIZATION));
    for (size_t i = 0; i < n; i++) {
        if (refs[i] < REF_INPUTS || refs[i] >= REF_PARAMETERS)
            return face_bad_reference(c, function, refs[i]);
        int input = (int)(refs[i] - REF_INPUTS), rate = model_input_rate[input];
        if (rate >= 0) c->now.told[rate] |= slopes[i] != 0;
        if (core_set_slope(&c->now.core, input, slopes[i]) != CORE_OK) return refused_number(c, function);
    }
    return FACE_OK;
}

FaceStatus face_set_time(Instance *c, const char *function, double time) {
    return core_set_time(&c->now.core, time) == CORE_OK ? FACE_OK : refused_number(c, function);
}

FaceStatus face_set_states(Instance *c, const char *function, const double x[], size_t n) {
    if (misfit(c, function, x, n, NX)) return FACE_ERROR;
    return !n || core_set_states(&c->now.core, x) == CORE_OK ? FACE_OK : refused_number(c, function);
}

FaceStatus face_get_states(Instance *c, const char *function, double x[], size_t n) {
    if (misfit(c, function, x, n, NX) || face_ready(c, function) != FACE_OK) return FACE_ERROR;
    for (size_t i = 0; i < n; i++) x[i] = core_state(&c->now.core, (int)i);
    return FACE_OK;
}

FaceStatus face_get_nominals(Instance *c, const char *function, double x[], size_t n) {
    if (misfit(c, function, x, n, NX)) return FACE_ERROR;
    return copied(model_nominal, x, n);
}

FaceStatus face_get_rates(Instance *c, const char *function, double rates[], size_t n) {
    const double *computed = NULL;
    if (misfit(c, function, rates, n, NX) || face_ready(c, function) != FACE_OK ||
        untold_rate(c, function) != FACE_OK)
        return FACE_ERROR;
    if (core_rates(&c->now.core, &computed) != CORE_OK) return face_outcome(c, function, CORE_DISCARD);
    return copied(computed, rates, n);
}

FaceStatus face_get_indicators(Instance *c, const char *function, double g[], size_t n) {
    const double *computed = NULL;
    if (misfit(c, function, g, n, NG) || face_ready(c, function) != FACE_OK) return FACE_ERROR;
    if (core_indicators(&c->now.core, &computed) != CORE_OK) return face_outcome(c, function, CORE_DISCARD);
    return copied(computed, g, n);
}

FaceStatus face_experiment(Instance *c, const char *function, int tolerance_defined, double tolerance,
                           double start, int stop_defined, double stop) {
    if (tolerance_defined && !(tolerance > 0 && tolerance < 1))
        return face_refuse(c, function, "the tolerance must lie between 0 and 1");
    if (!isfinite(start)) return face_refuse(c, function, "the start time must be a finite number");
    if (stop_defined && !(stop >= start))
        return face_refuse(c, function, "the stop time lies before the start");
    if (core_set_time(&c->now.core, start) != CORE_OK) return refused_number(c, function);
    c->now.tolerance = tolerance_defined ? tolerance : FMU_TOLERANCE;
    c->now.start = start;
    c->now.stop = stop_defined ? stop : INFINITY;
    return FACE_OK;
}

FaceStatus face_initialize(Instance *c, const char *function) {
    CoreStatus status = begin(c);
    if (status == CORE_OK) status = core_start(&c->now.core);
    return face_outcome(c, function, status == CORE_OK ? CORE_OK : CORE_ERROR);
}

FaceStatus face_settle(Instance *c, const char *function, int *states_changed) {
    return face_outcome(c, function, core_settle(&c->now.core, states_changed));
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
    if (untold_rate(c, function) != FACE_OK) return FACE_ERROR;
    if (stop > c->now.stop + slack(c->now.stop))
        return face_refuse(c, function, "the step leads beyond the stop time");
    CoreStatus status = core_advance(&c->now.core, stop, rtol, ABSOLUTE * rtol, FMU_FIXED_STEP,
                                     c->event_mode_used && c->may_return_early, reached);
    /* With error control smaller steps were tried already: no other step of communication would help. */
    return face_outcome(c, function, status == CORE_DISCARD && !(FMU_FIXED_STEP > 0) ? CORE_ERROR : status);
}

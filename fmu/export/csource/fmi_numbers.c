/* Numbers of an instance, by value reference or all of a kind. */
#include "fmi_common.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const uint32_t aims[ROOM(NAIM)] = FMU_AIMS; /* what refers to them */
static const uint32_t booleans[ROOM(NBOOLEAN)] = FMU_BOOLEANS, integers[ROOM(NINTEGER)] = FMU_INTEGERS;

/* Whether a rising list has a reference. */
static int listed(const uint32_t list[], int n, uint32_t ref) {
    int low = 0, high = n;
    while (low < high) {
        int middle = low + (high - low) / 2;
        if (list[middle] < ref) low = middle + 1;
        else high = middle;
    }
    return low < n && list[low] == ref;
}

Type face_type(uint32_t ref) {
    if (ref >= REF_MODES && ref < REF_INDICATORS) return ENUMERATION;
    return listed(booleans, NBOOLEAN, ref) ? BOOLEAN : listed(integers, NINTEGER, ref) ? INTEGER : REAL;
}

static Status get_number(Instance *c, uint32_t ref, double *value) {
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
    } else return face_bad_reference(c, ref);
    return status == CORE_OK ? FMI(OK) : face_outcome(c, CORE_DISCARD);
}

Status face_get(Instance *c, Type type, uint32_t ref, double *value) {
    Status status = FMI(OK);
    if (face_type(ref) != type) return face_bad_reference(c, ref);
    if (!face_ready(c)) return FMI(Error);
    if (type == ENUMERATION) *value = core_mode(&c->now.core, (int)(ref - REF_MODES));
    else status = get_number(c, ref, value);
    if (status == FMI(OK) && type == BOOLEAN) *value = *value > 0.5;
    if (status == FMI(OK) && type == INTEGER) *value = round(*value);
    return status;
}

Status face_get_reals(Instance *c, const uint32_t refs[], size_t n, double values[]) {
    if (face_missing(c, n, refs, values) || !face_ready(c)) return FMI(Error);
    for (size_t i = 0; i < n; i++) {
        Status status = face_get(c, REAL, refs[i], &values[i]);
        if (status != FMI(OK)) return status;
    }
    return FMI(OK);
}

static CoreStatus set_input(Instance *c, int i, double value) {
    Core *core = &c->now.core;
    c->now.moved[i] |= core_time(core) > c->now.start && value != core_input(core, i);
    c->now.told[i] |= value != 0;
    return core_set_input(core, i, value);
}

Status face_untold_rate(Instance *c) {
    char why[512];
    for (int i = 0; i < NU; i++) {
        int rate = model_input_rate[i];
        if (rate < 0 || !c->now.moved[i] || c->now.told[rate]) continue;
        snprintf(
            why, sizeof why,
            "input %.128s (derivative %d of it) changes, but its own derivative, an input too, was never anything but "
            "zero; set it as well, or export the network with exact=False where it prescribes a motion",
            model_input_name[i], model_input_order[i]);
        return face_refuse(c, why);
    }
    return FMI(OK);
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

static Status refuse_follower(Instance *c, int state) {
    Core *core = &c->now.core;
    const char *name = model_unknown_name[state];
    core_fail(core, CORE_ERROR, "%s follows from other start values; set those of ", name);
    for (int i = 0; i < NAIM && i < 6; i++) {
        if (i) core_say_more(core, "%s", i < 5 ? ", " : ", ...");
        if (i < 5) core_say_more(core, "%s", model_aim_name[i]);
    }
    return face_accepted(c, CORE_ERROR);
}

static int is_start(uint32_t ref) {
    int found = ref >= REF_STATES && ref < REF_RATES;
    for (int i = 0; i < NAIM; i++) found |= aims[i] == ref;
    return found;
}

Status face_set(Instance *c, Type type, uint32_t ref, double value) {
    Core *core = &c->now.core;
    int phase = c->now.phase;
    int starting = phase & (INSTANTIATED | INITIALIZATION);
    int tuning = starting || phase == EVENT_MODE || (phase == STEP_MODE && !c->event_mode_used);
    CoreStatus status = CORE_OK;
    if (face_type(ref) != type) return face_bad_reference(c, ref);
    c->now.begun = c->now.begun && !starting;
    if (starting && is_start(ref)) {
        if (follower(ref) >= 0) return refuse_follower(c, follower(ref));
        if (!isfinite(value)) return face_refuse(c, "a start value must be a finite number");
        set_start(c, ref, value);
    } else if (ref >= REF_INPUTS && ref < REF_PARAMETERS && (type == REAL || tuning))
        status = set_input(c, (int)(ref - REF_INPUTS), value);
    else if (ref >= REF_PARAMETERS && ref < REF_VARIABLES && tuning)
        status = core_set_parameter(core, (int)(ref - REF_PARAMETERS), value);
    else return face_bad_reference(c, ref);
    return face_accepted(c, status);
}

Status face_set_reals(Instance *c, const uint32_t refs[], size_t n, const double values[]) {
    if (face_missing(c, n, refs, values)) return FMI(Error);
    for (size_t i = 0; i < n; i++) {
        Status status = face_set(c, REAL, refs[i], values[i]);
        if (status != FMI(OK)) return status;
    }
    return FMI(OK);
}

/* Numbers of an instance, by value reference or all of a kind. */
#include "fmi_common.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const uint32_t aims[ROOM(NAIM)] = FMU_AIMS; /* what refers to them */

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

FaceStatus face_untold_rate(Instance *c, const char *function) {
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
    const char *name = model_unknown_name[state];
    core_fail(core, CORE_ERROR, "%s follows from other start values; set those of ", name);
    for (int i = 0; i < NAIM && i < 6; i++) {
        if (i) core_say_more(core, "%s", i < 5 ? ", " : ", ...");
        if (i < 5) core_say_more(core, "%s", model_aim_name[i]);
    }
    return face_refuse_number(c, function);
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
    return status == CORE_OK ? FACE_OK : face_refuse_number(c, function);
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
        if (core_set_slope(&c->now.core, input, slopes[i]) != CORE_OK) return face_refuse_number(c, function);
    }
    return FACE_OK;
}

FaceStatus face_set_time(Instance *c, const char *function, double time) {
    return core_set_time(&c->now.core, time) == CORE_OK ? FACE_OK : face_refuse_number(c, function);
}

FaceStatus face_set_states(Instance *c, const char *function, const double x[], size_t n) {
    if (misfit(c, function, x, n, NX)) return FACE_ERROR;
    return !n || core_set_states(&c->now.core, x) == CORE_OK ? FACE_OK : face_refuse_number(c, function);
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
        face_untold_rate(c, function) != FACE_OK)
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

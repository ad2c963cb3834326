/* Model exchange in both standards: time, states and what is computed from them, all of a kind. */
#include <string.h>

#include "fmi_common.h"

static int misfit(Instance *c, const void *array, size_t n, size_t expected) {
    if (n == expected && (array || !n)) return 0;
    face_refuse(c, n == expected ? "an array is missing" : "the array has the wrong length");
    return 1;
}

static Status copied(const double *from, double to[], size_t n) {
    if (n) memcpy(to, from, n * sizeof *to);
    return FMI(OK);
}

Status FMI(EnterContinuousTimeMode)(void *instance) {
    ENTER(EVENT_MODE, MODEL_EXCHANGE);
    c->now.phase = CONTINUOUS_TIME;
    return FMI(OK);
}

/* An event is due if the integrator has stepped over one, twice through zero within one step. */
Status FMI(CompletedIntegratorStep)(void *instance, FMI(Boolean) no_state_set_before, FMI(Boolean) * event,
                                    FMI(Boolean) * end) {
    int due = 0;
    ENTER(CONTINUOUS_TIME, MODEL_EXCHANGE);
    if (!event || !end) return face_refuse(c, "there is nowhere to put the answer");
    CoreStatus status = core_due(&c->now.core, &due);
    *event = due != 0;
    *end = FMI(False);
    return face_outcome(c, status);
}

Status FMI(SetTime)(void *instance, double time) {
    ENTER(EVENT_MODE | CONTINUOUS_TIME, MODEL_EXCHANGE);
    return face_accepted(c, core_set_time(&c->now.core, time));
}

Status FMI(SetContinuousStates)(void *instance, const double x[], size_t n) {
    ENTER(CONTINUOUS_TIME, MODEL_EXCHANGE);
    if (misfit(c, x, n, NX)) return FMI(Error);
    return n ? face_accepted(c, core_set_states(&c->now.core, x)) : FMI(OK);
}

Status FMI(GetContinuousStates)(void *instance, double x[], size_t n) {
    ENTER(READABLE, MODEL_EXCHANGE);
    if (misfit(c, x, n, NX) || !face_ready(c)) return FMI(Error);
    return copied(c->now.core.y, x, n);
}

Status FMI(GetNominalsOfContinuousStates)(void *instance, double x[], size_t n) {
    ENTER(ANY_PHASE, MODEL_EXCHANGE);
    return misfit(c, x, n, NX) ? FMI(Error) : copied(model_nominal, x, n);
}

Status FMI(GetContinuousStateDerivatives)(void *instance, double rates[], size_t n) {
    const double *computed = NULL;
    ENTER(READABLE, MODEL_EXCHANGE);
    if (misfit(c, rates, n, NX) || !face_ready(c) || face_untold_rate(c) != FMI(OK)) return FMI(Error);
    if (core_rates(&c->now.core, &computed) != CORE_OK) return face_outcome(c, CORE_DISCARD);
    return copied(computed, rates, n);
}

Status FMI(GetEventIndicators)(void *instance, double g[], size_t n) {
    const double *computed = NULL;
    ENTER(READABLE, MODEL_EXCHANGE);
    if (misfit(c, g, n, NG) || !face_ready(c)) return FMI(Error);
    if (core_indicators(&c->now.core, &computed) != CORE_OK) return face_outcome(c, CORE_DISCARD);
    return copied(computed, g, n);
}

/* FMI 2.0.4: events, model exchange and co-simulation. */
#include <string.h>

#include "fmi2_face.h"

fmi2Status fmi2EnterEventMode(fmi2Component component) {
    ENTER(CONTINUOUS_TIME | EVENT_MODE, MODEL_EXCHANGE);
    c->now.phase = EVENT_MODE;
    return fmi2OK;
}

fmi2Status fmi2NewDiscreteStates(fmi2Component component, fmi2EventInfo *eventInfo) {
    int changed = 0;
    FaceStatus status;
    ENTER(EVENT_MODE, MODEL_EXCHANGE);
    if (!eventInfo) return AS_FMI(face_refuse(c, HERE, "there is nowhere to put the event information"));
    memset(eventInfo, 0, sizeof *eventInfo);
    status = face_settle(c, HERE, &changed);
    eventInfo->valuesOfContinuousStatesChanged = changed ? fmi2True : fmi2False;
    if (core_next_time(&c->now.core, &eventInfo->nextEventTime)) eventInfo->nextEventTimeDefined = fmi2True;
    return AS_FMI(status);
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component component) {
    ENTER(EVENT_MODE, MODEL_EXCHANGE);
    c->now.phase = CONTINUOUS_TIME;
    return fmi2OK;
}

fmi2Status fmi2CompletedIntegratorStep(fmi2Component component, fmi2Boolean noSetFMUStatePriorToCurrentPoint,
                                       fmi2Boolean *enterEventMode, fmi2Boolean *terminateSimulation) {
    int due = 0;
    FaceStatus status;
    ENTER(CONTINUOUS_TIME, MODEL_EXCHANGE);
    (void)noSetFMUStatePriorToCurrentPoint;
    if (!enterEventMode || !terminateSimulation)
        return AS_FMI(face_refuse(c, HERE, "there is nowhere to put the answer"));
    status = face_due(c, HERE, &due);
    *enterEventMode = due ? fmi2True : fmi2False;
    *terminateSimulation = fmi2False;
    return AS_FMI(status);
}

fmi2Status fmi2SetTime(fmi2Component component, fmi2Real time) {
    ENTER(EVENT_MODE | CONTINUOUS_TIME, MODEL_EXCHANGE);
    return AS_FMI(face_set_time(c, HERE, time));
}

fmi2Status fmi2SetContinuousStates(fmi2Component component, const fmi2Real x[], size_t nx) {
    ENTER(CONTINUOUS_TIME, MODEL_EXCHANGE);
    return AS_FMI(face_set_states(c, HERE, x, nx));
}

fmi2Status fmi2GetDerivatives(fmi2Component component, fmi2Real derivatives[], size_t nx) {
    ENTER(READABLE, MODEL_EXCHANGE);
    return AS_FMI(face_get_rates(c, HERE, derivatives, nx));
}

fmi2Status fmi2GetEventIndicators(fmi2Component component, fmi2Real eventIndicators[], size_t ni) {
    ENTER(READABLE, MODEL_EXCHANGE);
    return AS_FMI(face_get_indicators(c, HERE, eventIndicators, ni));
}

fmi2Status fmi2GetContinuousStates(fmi2Component component, fmi2Real x[], size_t nx) {
    ENTER(READABLE, MODEL_EXCHANGE);
    return AS_FMI(face_get_states(c, HERE, x, nx));
}

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component component, fmi2Real x_nominal[], size_t nx) {
    ENTER(ANY_PHASE, MODEL_EXCHANGE);
    return AS_FMI(face_get_nominals(c, HERE, x_nominal, nx));
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component component, const fmi2ValueReference vr[], size_t nvr,
                                       const fmi2Integer order[], const fmi2Real value[]) {
    ENTER(INSTANTIATED | INITIALIZATION | STEP_MODE, CO_SIMULATION);
    if (nvr && !order) return AS_FMI(face_refuse(c, HERE, "an array is missing"));
    for (size_t i = 0; i < nvr; i++)
        if (order[i] != 1) return AS_FMI(face_refuse(c, HERE, "only first derivatives of inputs are taken"));
    return AS_FMI(face_set_slopes(c, HERE, vr, nvr, value));
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component component, const fmi2ValueReference vr[], size_t nvr,
                                        const fmi2Integer order[], fmi2Real value[]) {
    ENTER(READABLE, CO_SIMULATION);
    (void)vr;
    (void)order;
    (void)value;
    return nvr ? AS_FMI(face_refuse(c, HERE, "derivatives of outputs are not provided")) : fmi2OK;
}

fmi2Status fmi2DoStep(fmi2Component component, fmi2Real currentCommunicationPoint,
                      fmi2Real communicationStepSize, fmi2Boolean noSetFMUStatePriorToCurrentPoint) {
    CoreStop reached;
    FaceStatus status;
    ENTER(STEP_MODE, CO_SIMULATION);
    (void)noSetFMUStatePriorToCurrentPoint;
    status = face_step(c, HERE, currentCommunicationPoint, communicationStepSize, &reached);
    if (status == FACE_DISCARD) c->now.phase = STEP_FAILED;
    return AS_FMI(status);
}

fmi2Status fmi2CancelStep(fmi2Component component) {
    ENTER(0, CO_SIMULATION);
    return fmi2Error;
}

#define STATUS_PHASES (STEP_MODE | STEP_FAILED | TERMINATED)
#define STATUS_OF(name, type)                                                                    \
    fmi2Status name(fmi2Component component, const fmi2StatusKind s, type *value) {              \
        ENTER(STATUS_PHASES, CO_SIMULATION);                                                     \
        (void)s;                                                                                 \
        (void)value;                                                                             \
        return AS_FMI(face_refuse(c, HERE, "steps end before they return: nothing is pending")); \
    }

STATUS_OF(fmi2GetStatus, fmi2Status)
STATUS_OF(fmi2GetIntegerStatus, fmi2Integer)
STATUS_OF(fmi2GetStringStatus, fmi2String)

fmi2Status fmi2GetRealStatus(fmi2Component component, const fmi2StatusKind s, fmi2Real *value) {
    ENTER(STATUS_PHASES, CO_SIMULATION);
    if (s != fmi2LastSuccessfulTime || !value)
        return AS_FMI(face_refuse(c, HERE, "only the last successful time is a real number"));
    *value = core_time(&c->now.core);
    return fmi2OK;
}

fmi2Status fmi2GetBooleanStatus(fmi2Component component, const fmi2StatusKind s, fmi2Boolean *value) {
    ENTER(STATUS_PHASES, CO_SIMULATION);
    if (s != fmi2Terminated || !value)
        return AS_FMI(face_refuse(c, HERE, "only whether it wants to terminate is true or false"));
    *value = fmi2False;
    return fmi2OK;
}

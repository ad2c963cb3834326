/* FMI 3.0.1: events, model exchange and co-simulation. */
#include "fmi3_face.h"

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean *discreteStatesNeedUpdate,
                                    fmi3Boolean *terminateSimulation,
                                    fmi3Boolean *nominalsOfContinuousStatesChanged,
                                    fmi3Boolean *valuesOfContinuousStatesChanged,
                                    fmi3Boolean *nextEventTimeDefined, fmi3Float64 *nextEventTime) {
    int changed = 0;
    FaceStatus status;
    ENTER(EVENT_MODE, EITHER);
    if (!discreteStatesNeedUpdate || !terminateSimulation || !nominalsOfContinuousStatesChanged ||
        !valuesOfContinuousStatesChanged || !nextEventTimeDefined || !nextEventTime)
        return AS_FMI(face_refuse(c, HERE, "there is nowhere to put the answer"));
    status = face_settle(c, HERE, &changed);
    *discreteStatesNeedUpdate = fmi3False;
    *terminateSimulation = fmi3False;
    *nominalsOfContinuousStatesChanged = fmi3False;
    *valuesOfContinuousStatesChanged = changed != 0;
    *nextEventTime = 0.0;
    *nextEventTimeDefined = core_next_time(&c->now.core, nextEventTime) != 0;
    return AS_FMI(status);
}

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance instance) {
    ENTER(EVENT_MODE, MODEL_EXCHANGE);
    c->now.phase = CONTINUOUS_TIME;
    return fmi3OK;
}

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance instance, fmi3Boolean noSetFMUStatePriorToCurrentPoint,
                                       fmi3Boolean *enterEventMode, fmi3Boolean *terminateSimulation) {
    int due = 0;
    FaceStatus status;
    ENTER(CONTINUOUS_TIME, MODEL_EXCHANGE);
    (void)noSetFMUStatePriorToCurrentPoint;
    if (!enterEventMode || !terminateSimulation)
        return AS_FMI(face_refuse(c, HERE, "there is nowhere to put the answer"));
    status = face_due(c, HERE, &due);
    *enterEventMode = due ? fmi3True : fmi3False;
    *terminateSimulation = fmi3False;
    return AS_FMI(status);
}

fmi3Status fmi3SetTime(fmi3Instance instance, fmi3Float64 time) {
    ENTER(EVENT_MODE | CONTINUOUS_TIME, MODEL_EXCHANGE);
    return AS_FMI(face_set_time(c, HERE, time));
}

fmi3Status fmi3SetContinuousStates(fmi3Instance instance, const fmi3Float64 continuousStates[],
                                   size_t nContinuousStates) {
    ENTER(CONTINUOUS_TIME, MODEL_EXCHANGE);
    return AS_FMI(face_set_states(c, HERE, continuousStates, nContinuousStates));
}

fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance instance, fmi3Float64 derivatives[],
                                             size_t nContinuousStates) {
    ENTER(READABLE, MODEL_EXCHANGE);
    return AS_FMI(face_get_rates(c, HERE, derivatives, nContinuousStates));
}

fmi3Status fmi3GetEventIndicators(fmi3Instance instance, fmi3Float64 eventIndicators[],
                                  size_t nEventIndicators) {
    ENTER(READABLE, MODEL_EXCHANGE);
    return AS_FMI(face_get_indicators(c, HERE, eventIndicators, nEventIndicators));
}

fmi3Status fmi3GetContinuousStates(fmi3Instance instance, fmi3Float64 continuousStates[],
                                   size_t nContinuousStates) {
    ENTER(READABLE, MODEL_EXCHANGE);
    return AS_FMI(face_get_states(c, HERE, continuousStates, nContinuousStates));
}

fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance instance, fmi3Float64 nominals[],
                                             size_t nContinuousStates) {
    ENTER(ANY_PHASE, MODEL_EXCHANGE);
    return AS_FMI(face_get_nominals(c, HERE, nominals, nContinuousStates));
}

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance instance, size_t *nEventIndicators) {
    ENTER(ANY_PHASE, MODEL_EXCHANGE);
    if (!nEventIndicators) return AS_FMI(face_refuse(c, HERE, "there is nowhere to put the answer"));
    *nEventIndicators = NG;
    return fmi3OK;
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance instance, size_t *nContinuousStates) {
    ENTER(ANY_PHASE, MODEL_EXCHANGE);
    if (!nContinuousStates) return AS_FMI(face_refuse(c, HERE, "there is nowhere to put the answer"));
    *nContinuousStates = NX;
    return fmi3OK;
}

fmi3Status fmi3EnterStepMode(fmi3Instance instance) {
    ENTER(EVENT_MODE, CO_SIMULATION);
    c->now.phase = STEP_MODE;
    return fmi3OK;
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 currentCommunicationPoint,
                      fmi3Float64 communicationStepSize, fmi3Boolean noSetFMUStatePriorToCurrentPoint,
                      fmi3Boolean *eventHandlingNeeded, fmi3Boolean *terminateSimulation,
                      fmi3Boolean *earlyReturn, fmi3Float64 *lastSuccessfulTime) {
    CoreStop reached = CORE_ARRIVED;
    FaceStatus status;
    ENTER(STEP_MODE, CO_SIMULATION);
    (void)noSetFMUStatePriorToCurrentPoint;
    if (!eventHandlingNeeded || !terminateSimulation || !earlyReturn || !lastSuccessfulTime)
        return AS_FMI(face_refuse(c, HERE, "there is nowhere to put the answer"));
    status = face_step(c, HERE, currentCommunicationPoint, communicationStepSize, &reached);
    *lastSuccessfulTime = core_time(&c->now.core);
    *eventHandlingNeeded = status == FACE_OK && reached == CORE_EVENT;
    *earlyReturn =
        *eventHandlingNeeded && *lastSuccessfulTime < currentCommunicationPoint + communicationStepSize;
    *terminateSimulation = fmi3False;
    return AS_FMI(status);
}

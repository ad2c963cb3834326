/* FMI 3.0.1: what FMI 2 has otherwise, or not at all. */
#include <stdlib.h>
#include <string.h>

#include "fmi_common.h"

void face_log(const Instance *c, Status status, const char *category, const char *message) {
    if (c->host.log) c->host.log(c->host.environment, status, category, message);
}

static Instance *instantiate(const char *name, const char *token, Host host, Kind kind) {
    Instance *c = NULL;
    const char *why = NULL;
    if (!name || !*name) why = "fmi3Instantiate: the instance needs a name";
    else if (!token || strcmp(token, FMU_TOKEN)) why = "fmi3Instantiate: the token is that of another model";
    else {
        c = calloc(1, sizeof *c);
        if (!c) why = "fmi3Instantiate: out of memory";
    }
    if (!c) {
        if (host.log) host.log(host.environment, fmi3Error, "logStatusError", why);
        return NULL;
    }
    c->host = host;
    face_start(c, kind);
    return c;
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String instanceName, fmi3String instantiationToken,
                                          fmi3String resourcePath, fmi3Boolean visible, fmi3Boolean loggingOn,
                                          fmi3InstanceEnvironment instanceEnvironment,
                                          fmi3LogMessageCallback logMessage) {
    return instantiate(instanceName, instantiationToken, (Host){instanceEnvironment, logMessage, NULL},
                       MODEL_EXCHANGE);
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String instanceName, fmi3String instantiationToken,
                                         fmi3String resourcePath, fmi3Boolean visible, fmi3Boolean loggingOn,
                                         fmi3Boolean eventModeUsed, fmi3Boolean earlyReturnAllowed,
                                         const fmi3ValueReference requiredIntermediateVariables[],
                                         size_t nRequiredIntermediateVariables,
                                         fmi3InstanceEnvironment instanceEnvironment,
                                         fmi3LogMessageCallback logMessage,
                                         fmi3IntermediateUpdateCallback intermediateUpdate) {
    Host host = {instanceEnvironment, logMessage, intermediateUpdate};
    Instance *c = instantiate(instanceName, instantiationToken, host, CO_SIMULATION);
    if (!c) return NULL;
    if (nRequiredIntermediateVariables && !intermediateUpdate) {
        c->function = __func__;
        face_refuse(c, "intermediate variables are wanted, but there is nowhere to tell of them");
        free(c);
        return NULL;
    }
    c->event_mode_used = eventModeUsed;
    c->may_return_early = earlyReturnAllowed;
    return c;
}

void fmi3FreeInstance(fmi3Instance instance) { free(instance); }

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean toleranceDefined,
                                       fmi3Float64 tolerance, fmi3Float64 startTime,
                                       fmi3Boolean stopTimeDefined, fmi3Float64 stopTime) {
    ENTER(INSTANTIATED, EITHER);
    fmi3Status status = face_experiment(c, toleranceDefined, tolerance, startTime, stopTimeDefined, stopTime);
    if (status == fmi3OK) c->now.phase = INITIALIZATION;
    return status;
}

fmi3Status fmi3EnterEventMode(fmi3Instance instance) {
    ENTER(CONTINUOUS_TIME | STEP_MODE, EITHER);
    if (c->kind == CO_SIMULATION && !c->event_mode_used)
        return face_refuse(c, "this instance was made without event mode");
    c->now.phase = EVENT_MODE;
    return fmi3OK;
}

static int odd(Instance *c, size_t values, size_t references) {
    return values != references && face_refuse(c, "every variable has one value") != fmi3OK;
}

fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                          size_t nValueReferences, fmi3Float64 values[], size_t nValues) {
    ENTER(READABLE, EITHER);
    if (odd(c, nValues, nValueReferences)) return fmi3Error;
    return face_get_reals(c, valueReferences, nValues, values);
}

fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                          size_t nValueReferences, const fmi3Float64 values[], size_t nValues) {
    ENTER(SETTABLE, EITHER);
    if (odd(c, nValues, nValueReferences)) return fmi3Error;
    return face_set_reals(c, valueReferences, nValues, values);
}

#define GET(name, type, kind)                                                                       \
    fmi3Status name(fmi3Instance instance, const fmi3ValueReference valueReferences[],              \
                    size_t nValueReferences, type values[], size_t nValues) {                       \
        ENTER(READABLE, EITHER);                                                                    \
        if (odd(c, nValues, nValueReferences) || face_missing(c, nValues, valueReferences, values)) \
            return fmi3Error;                                                                       \
        for (size_t i = 0; i < nValues; i++) {                                                      \
            double found;                                                                           \
            fmi3Status status = face_get(c, kind, valueReferences[i], &found);                      \
            if (status != fmi3OK) return status;                                                    \
            values[i] = (type)found;                                                                \
        }                                                                                           \
        return fmi3OK;                                                                              \
    }

GET(fmi3GetBoolean, fmi3Boolean, BOOLEAN)
GET(fmi3GetInt32, fmi3Int32, INTEGER)
GET(fmi3GetInt64, fmi3Int64, ENUMERATION) /* modes */

fmi3Status fmi3SetBoolean(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                          size_t nValueReferences, const fmi3Boolean values[], size_t nValues) {
    ENTER(SETTABLE, EITHER);
    if (odd(c, nValues, nValueReferences) || face_missing(c, nValues, valueReferences, values))
        return fmi3Error;
    for (size_t i = 0; i < nValues; i++)
        if (face_set(c, BOOLEAN, valueReferences[i], values[i]) != fmi3OK) return fmi3Error;
    return fmi3OK;
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
                                        size_t nUnknowns, const fmi3ValueReference knowns[], size_t nKnowns,
                                        const fmi3Float64 seed[], size_t nSeed, fmi3Float64 sensitivity[],
                                        size_t nSensitivity) {
    ENTER(READABLE, EITHER);
    if (odd(c, nSeed, nKnowns) || odd(c, nSensitivity, nUnknowns)) return fmi3Error;
    return face_sensitivities(c, 0, knowns, nKnowns, seed, unknowns, nUnknowns, sensitivity);
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
                                    size_t nUnknowns, const fmi3ValueReference knowns[], size_t nKnowns,
                                    const fmi3Float64 seed[], size_t nSeed, fmi3Float64 sensitivity[],
                                    size_t nSensitivity) {
    ENTER(READABLE, EITHER);
    if (odd(c, nSeed, nUnknowns) || odd(c, nSensitivity, nKnowns)) return fmi3Error;
    return face_sensitivities(c, 1, unknowns, nUnknowns, seed, knowns, nKnowns, sensitivity);
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                    size_t nValueReferences, const fmi3Int32 orders[], fmi3Float64 values[],
                                    size_t nValues) {
    ENTER(READABLE, CO_SIMULATION);
    if (odd(c, nValues, nValueReferences)) return fmi3Error;
    return face_output_derivatives(c, valueReferences, orders, nValueReferences, values);
}

/* After each step of the integrator variables may be read. */
static int stepped(void *context, Core *core, double t) {
    Instance *c = context;
    fmi3Boolean asked = fmi3False;
    fmi3Float64 when = t;
    int phase = c->now.phase;
    (void)core;
    c->now.phase = INTERMEDIATE;
    c->host.update(c->host.environment, t, fmi3False, fmi3True, fmi3True, fmi3False, &asked, &when);
    if (c->now.phase == FAILED) return 1;
    c->now.phase = phase;
    return 0;
}

const Observer *face_observer(Instance *c, Observer *room) {
    if (!c->host.update) return NULL;
    memset(room, 0, sizeof *room);
    room->context = c;
    room->stepped = stepped;
    return room;
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean *discreteStatesNeedUpdate,
                                    fmi3Boolean *terminateSimulation,
                                    fmi3Boolean *nominalsOfContinuousStatesChanged,
                                    fmi3Boolean *valuesOfContinuousStatesChanged,
                                    fmi3Boolean *nextEventTimeDefined, fmi3Float64 *nextEventTime) {
    int changed = 0;
    ENTER(EVENT_MODE, EITHER);
    if (!discreteStatesNeedUpdate || !terminateSimulation || !nominalsOfContinuousStatesChanged ||
        !valuesOfContinuousStatesChanged || !nextEventTimeDefined || !nextEventTime)
        return face_refuse(c, "there is nowhere to put the answer");
    fmi3Status status = face_settle(c, &changed);
    *discreteStatesNeedUpdate = *terminateSimulation = *nominalsOfContinuousStatesChanged = fmi3False;
    *valuesOfContinuousStatesChanged = changed != 0;
    *nextEventTime = 0.0;
    *nextEventTimeDefined = core_next_time(&c->now.core, nextEventTime) != 0;
    return status;
}

/* How many of a kind there are, for model exchange. */
static fmi3Status count_of(Instance *c, const char *function, size_t count, size_t *told) {
    if (!face_may(c, function, ANY_PHASE, MODEL_EXCHANGE)) return fmi3Error;
    if (!told) return face_refuse(c, "there is nowhere to put the answer");
    *told = count;
    return fmi3OK;
}

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance instance, size_t *nEventIndicators) {
    return count_of(instance, __func__, NG, nEventIndicators);
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance instance, size_t *nContinuousStates) {
    return count_of(instance, __func__, NX, nContinuousStates);
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
    ENTER(STEP_MODE, CO_SIMULATION);
    if (!eventHandlingNeeded || !terminateSimulation || !earlyReturn || !lastSuccessfulTime)
        return face_refuse(c, "there is nowhere to put the answer");
    fmi3Status status = face_step(c, currentCommunicationPoint, communicationStepSize, &reached);
    *lastSuccessfulTime = core_time(&c->now.core);
    *eventHandlingNeeded = status == fmi3OK && reached == CORE_EVENT;
    *earlyReturn =
        *eventHandlingNeeded && *lastSuccessfulTime < currentCommunicationPoint + communicationStepSize;
    *terminateSimulation = fmi3False;
    return status;
}

/* FMI 2.0.4: what FMI 3 has otherwise, or not at all. */
#include <stdlib.h>
#include <string.h>

#include "fmi_common.h"

void face_log(const Instance *c, Status status, const char *category, const char *message) {
    const fmi2CallbackFunctions *to = &c->host.callbacks;
    if (to->logger) to->logger(to->componentEnvironment, c->host.name, status, category, "%s", message);
}

static void *room(const fmi2CallbackFunctions *callbacks, size_t size) {
    return callbacks->allocateMemory ? callbacks->allocateMemory(1, size) : calloc(1, size);
}

static void release(const fmi2CallbackFunctions *callbacks, void *memory) {
    if (callbacks->allocateMemory && callbacks->freeMemory) callbacks->freeMemory(memory);
    else if (!callbacks->allocateMemory) free(memory);
}

const Observer *face_observer(Instance *c, Observer *room) {
    (void)c;
    (void)room;
    return NULL;
}

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }

fmi2Component fmi2Instantiate(fmi2String instanceName, fmi2Type fmuType, fmi2String fmuGUID,
                              fmi2String fmuResourceLocation, const fmi2CallbackFunctions *functions,
                              fmi2Boolean visible, fmi2Boolean loggingOn) {
    Instance *c = NULL;
    const char *why = NULL;
    if (!functions) return NULL;
    if (!instanceName || !*instanceName) why = "fmi2Instantiate: the instance needs a name";
    else if (!fmuGUID || strcmp(fmuGUID, FMU_TOKEN))
        why = "fmi2Instantiate: the GUID is that of another model";
    else if (fmuType != fmi2ModelExchange && fmuType != fmi2CoSimulation)
        why = "fmi2Instantiate: unknown type";
    else {
        c = room(functions, sizeof *c);
        if (c) c->host.name = room(functions, strlen(instanceName) + 1);
        if (!c || !c->host.name) why = "fmi2Instantiate: out of memory";
    }
    if (why) {
        if (functions->logger)
            functions->logger(functions->componentEnvironment, instanceName ? instanceName : "", fmi2Error,
                              "logStatusError", "%s", why);
        if (c) release(functions, c);
        return NULL;
    }
    strcpy(c->host.name, instanceName);
    c->host.callbacks = *functions;
    face_start(c, fmuType == fmi2CoSimulation ? CO_SIMULATION : MODEL_EXCHANGE);
    return c;
}

void fmi2FreeInstance(fmi2Component instance) {
    Instance *c = instance;
    if (!c) return;
    fmi2CallbackFunctions callbacks = c->host.callbacks;
    release(&callbacks, c->host.name);
    release(&callbacks, c);
}

fmi2Status fmi2SetupExperiment(fmi2Component instance, fmi2Boolean toleranceDefined, fmi2Real tolerance,
                               fmi2Real startTime, fmi2Boolean stopTimeDefined, fmi2Real stopTime) {
    ENTER(INSTANTIATED, EITHER);
    return face_experiment(c, toleranceDefined, tolerance, startTime, stopTimeDefined, stopTime);
}

fmi2Status fmi2EnterInitializationMode(fmi2Component instance) {
    ENTER(INSTANTIATED, EITHER);
    c->now.phase = INITIALIZATION;
    return fmi2OK;
}

fmi2Status fmi2GetReal(fmi2Component instance, const fmi2ValueReference vr[], size_t nvr, fmi2Real value[]) {
    ENTER(READABLE, EITHER);
    return face_get_reals(c, vr, nvr, value);
}

fmi2Status fmi2SetReal(fmi2Component instance, const fmi2ValueReference vr[], size_t nvr,
                       const fmi2Real value[]) {
    ENTER(SETTABLE, EITHER);
    return face_set_reals(c, vr, nvr, value);
}

/* Modes are read as integers. */
fmi2Status fmi2GetInteger(fmi2Component instance, const fmi2ValueReference vr[], size_t nvr,
                          fmi2Integer value[]) {
    ENTER(READABLE, EITHER);
    if (face_missing(c, nvr, vr, value)) return fmi2Error;
    for (size_t i = 0; i < nvr; i++) {
        double found;
        fmi2Status status = face_get(c, face_type(vr[i]) == INTEGER ? INTEGER : ENUMERATION, vr[i], &found);
        if (status != fmi2OK) return status;
        value[i] = (fmi2Integer)found;
    }
    return fmi2OK;
}

fmi2Status fmi2GetBoolean(fmi2Component instance, const fmi2ValueReference vr[], size_t nvr,
                          fmi2Boolean value[]) {
    ENTER(READABLE, EITHER);
    if (face_missing(c, nvr, vr, value)) return fmi2Error;
    for (size_t i = 0; i < nvr; i++) {
        double found;
        fmi2Status status = face_get(c, BOOLEAN, vr[i], &found);
        if (status != fmi2OK) return status;
        value[i] = found != 0 ? fmi2True : fmi2False;
    }
    return fmi2OK;
}

fmi2Status fmi2SetBoolean(fmi2Component instance, const fmi2ValueReference vr[], size_t nvr,
                          const fmi2Boolean value[]) {
    ENTER(SETTABLE, EITHER);
    if (face_missing(c, nvr, vr, value)) return fmi2Error;
    for (size_t i = 0; i < nvr; i++)
        if (face_set(c, BOOLEAN, vr[i], value[i] != fmi2False) != fmi2OK) return fmi2Error;
    return fmi2OK;
}

#define NO_SUCH(name, type, phases)                                                                    \
    fmi2Status name(fmi2Component instance, const fmi2ValueReference vr[], size_t nvr, type value[]) { \
        ENTER(phases, EITHER);                                                                         \
        return face_no_such(c, nvr);                                                                   \
    }

NO_SUCH(fmi2GetString, fmi2String, READABLE)
NO_SUCH(fmi2SetInteger, const fmi2Integer, SETTABLE)
NO_SUCH(fmi2SetString, const fmi2String, SETTABLE)

fmi2Status fmi2GetDirectionalDerivative(fmi2Component instance, const fmi2ValueReference vUnknown_ref[],
                                        size_t nUnknown, const fmi2ValueReference vKnown_ref[], size_t nKnown,
                                        const fmi2Real dvKnown[], fmi2Real dvUnknown[]) {
    ENTER(READABLE, EITHER);
    return face_sensitivities(c, 0, vKnown_ref, nKnown, dvKnown, vUnknown_ref, nUnknown, dvUnknown);
}

fmi2Status fmi2EnterEventMode(fmi2Component instance) {
    ENTER(CONTINUOUS_TIME | EVENT_MODE, MODEL_EXCHANGE);
    c->now.phase = EVENT_MODE;
    return fmi2OK;
}

fmi2Status fmi2NewDiscreteStates(fmi2Component instance, fmi2EventInfo *eventInfo) {
    int changed = 0;
    ENTER(EVENT_MODE, MODEL_EXCHANGE);
    if (!eventInfo) return face_refuse(c, "there is nowhere to put the event information");
    memset(eventInfo, 0, sizeof *eventInfo);
    fmi2Status status = face_settle(c, &changed);
    eventInfo->valuesOfContinuousStatesChanged = changed != 0;
    eventInfo->nextEventTimeDefined = core_next_time(&c->now.core, &eventInfo->nextEventTime) != 0;
    return status;
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component instance, const fmi2ValueReference vr[], size_t nvr,
                                       const fmi2Integer order[], const fmi2Real value[]) {
    ENTER(INSTANTIATED | INITIALIZATION | STEP_MODE, CO_SIMULATION);
    if (face_missing(c, nvr, vr, value) || face_missing(c, nvr, order, order)) return fmi2Error;
    for (size_t i = 0; i < nvr; i++)
        if (order[i] != 1) return face_refuse(c, "only first derivatives of inputs are taken");
    c->now.begun = c->now.begun && c->now.phase == STEP_MODE;
    for (size_t i = 0; i < nvr; i++) {
        if (vr[i] < REF_INPUTS || vr[i] >= REF_PARAMETERS || face_type(vr[i]) != REAL)
            return face_bad_reference(c, vr[i]);
        int input = (int)(vr[i] - REF_INPUTS), rate = model_input_rate[input];
        if (rate >= 0) c->now.told[rate] |= value[i] != 0;
        CoreStatus status = core_set_slope(&c->now.core, input, value[i]);
        if (status != CORE_OK) return face_accepted(c, status);
    }
    return fmi2OK;
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component instance, const fmi2ValueReference vr[], size_t nvr,
                                        const fmi2Integer order[], fmi2Real value[]) {
    ENTER(READABLE, CO_SIMULATION);
    return face_output_derivatives(c, vr, order, nvr, value);
}

fmi2Status fmi2DoStep(fmi2Component instance, fmi2Real currentCommunicationPoint,
                      fmi2Real communicationStepSize, fmi2Boolean noSetFMUStatePriorToCurrentPoint) {
    CoreStop reached;
    ENTER(STEP_MODE, CO_SIMULATION);
    fmi2Status status = face_step(c, currentCommunicationPoint, communicationStepSize, &reached);
    if (status == fmi2Discard) c->now.phase = STEP_FAILED;
    return status;
}

fmi2Status fmi2CancelStep(fmi2Component instance) {
    ENTER(0, CO_SIMULATION);
    return fmi2Error;
}

#define STATUS_PHASES (STEP_MODE | STEP_FAILED | TERMINATED)
#define STATUS_OF(name, type)                                                      \
    fmi2Status name(fmi2Component instance, const fmi2StatusKind s, type *value) { \
        ENTER(STATUS_PHASES, CO_SIMULATION);                                       \
        return face_refuse(c, "steps end before they return: nothing is pending"); \
    }

STATUS_OF(fmi2GetStatus, fmi2Status)
STATUS_OF(fmi2GetIntegerStatus, fmi2Integer)
STATUS_OF(fmi2GetStringStatus, fmi2String)

fmi2Status fmi2GetRealStatus(fmi2Component instance, const fmi2StatusKind s, fmi2Real *value) {
    ENTER(STATUS_PHASES, CO_SIMULATION);
    if (s != fmi2LastSuccessfulTime || !value)
        return face_refuse(c, "only the last successful time is a real number");
    *value = core_time(&c->now.core);
    return fmi2OK;
}

fmi2Status fmi2GetBooleanStatus(fmi2Component instance, const fmi2StatusKind s, fmi2Boolean *value) {
    ENTER(STATUS_PHASES, CO_SIMULATION);
    if (s != fmi2Terminated || !value)
        return face_refuse(c, "only whether it wants to terminate is true or false");
    *value = fmi2False;
    return fmi2OK;
}

/* The functions of FMI 2.0.4, for model exchange and co-simulation. */
#include <stdlib.h>
#include <string.h>

#include "face.h"
#include "fmi2Functions.h"

typedef struct {
    Instance common;
    fmi2CallbackFunctions callbacks;
    char *name;
    int logging;
} Component;

#define ENTER(phases, kinds)                                     \
    Instance *c = component;                                     \
    if (!face_may(c, __func__, (phases), (kinds))) return fmi2Error

#define AS_FMI(status) ((fmi2Status)(status))
#define HERE __func__

static void log_message(Instance *c, FaceStatus status, const char *message)
{
    const Component *self = (const Component *)(const void *)c;
    const char *category = status == FACE_ERROR ? "logStatusError" : "logStatusDiscard";
    if (self->callbacks.logger && (self->logging || status == FACE_ERROR))
        self->callbacks.logger(self->callbacks.componentEnvironment, self->name, AS_FMI(status), category, "%s",
                               message);
}

static void *room(const fmi2CallbackFunctions *callbacks, size_t size)
{
    return callbacks->allocateMemory ? callbacks->allocateMemory(1, size) : calloc(1, size);
}

static void release(const fmi2CallbackFunctions *callbacks, void *memory)
{
    if (callbacks->allocateMemory && callbacks->freeMemory) callbacks->freeMemory(memory);
    else if (!callbacks->allocateMemory) free(memory);
}

static void complain(const fmi2CallbackFunctions *callbacks, fmi2String name, const char *why)
{
    if (callbacks && callbacks->logger)
        callbacks->logger(callbacks->componentEnvironment, name ? name : "", fmi2Error, "logStatusError", "%s",
                          why);
}

const char *fmi2GetTypesPlatform(void)
{
    return fmi2TypesPlatform;
}

const char *fmi2GetVersion(void)
{
    return fmi2Version;
}

fmi2Component fmi2Instantiate(fmi2String instanceName, fmi2Type fmuType, fmi2String fmuGUID,
                              fmi2String fmuResourceLocation, const fmi2CallbackFunctions *functions,
                              fmi2Boolean visible, fmi2Boolean loggingOn)
{
    Component *self;
    const char *why = NULL;
    (void)fmuResourceLocation;
    (void)visible;
    if (!functions) return NULL;
    if (!instanceName || !*instanceName) why = "fmi2Instantiate: the instance needs a name";
    else if (!fmuGUID || strcmp(fmuGUID, FMU_TOKEN)) why = "fmi2Instantiate: the GUID is that of another model";
    else if (fmuType != fmi2ModelExchange && fmuType != fmi2CoSimulation) why = "fmi2Instantiate: unknown type";
    if (why) {
        complain(functions, instanceName, why);
        return NULL;
    }
    self = room(functions, sizeof *self);
    if (self) self->name = room(functions, strlen(instanceName) + 1);
    if (!self || !self->name) {
        complain(functions, instanceName, "fmi2Instantiate: out of memory");
        if (self) release(functions, self);
        return NULL;
    }
    strcpy(self->name, instanceName);
    self->callbacks = *functions;
    self->logging = loggingOn != fmi2False;
    face_start(&self->common, fmuType == fmi2CoSimulation ? CO_SIMULATION : MODEL_EXCHANGE, log_message);
    return self;
}

void fmi2FreeInstance(fmi2Component component)
{
    Component *self = component;
    fmi2CallbackFunctions callbacks;
    if (!self) return;
    callbacks = self->callbacks;
    release(&callbacks, self->name);
    release(&callbacks, self);
}

fmi2Status fmi2SetDebugLogging(fmi2Component component, fmi2Boolean loggingOn, size_t nCategories,
                               const fmi2String categories[])
{
    ENTER(ANY_PHASE, EITHER);
    if (nCategories && !categories) return AS_FMI(face_refuse(c, HERE, "an array is missing"));
    ((Component *)component)->logging = loggingOn != fmi2False;
    return fmi2OK;
}

fmi2Status fmi2SetupExperiment(fmi2Component component, fmi2Boolean toleranceDefined, fmi2Real tolerance,
                               fmi2Real startTime, fmi2Boolean stopTimeDefined, fmi2Real stopTime)
{
    ENTER(INSTANTIATED, EITHER);
    return AS_FMI(face_experiment(c, HERE, toleranceDefined, tolerance, startTime, stopTimeDefined, stopTime));
}

fmi2Status fmi2EnterInitializationMode(fmi2Component component)
{
    ENTER(INSTANTIATED, EITHER);
    c->now.phase = INITIALIZATION;
    return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component component)
{
    FaceStatus status;
    ENTER(INITIALIZATION, EITHER);
    status = face_initialize(c, HERE);
    if (status == FACE_OK) c->now.phase = c->kind == CO_SIMULATION ? STEP_MODE : EVENT_MODE;
    return AS_FMI(status);
}

fmi2Status fmi2Terminate(fmi2Component component)
{
    ENTER(RUNNING | STEP_FAILED, EITHER);
    c->now.phase = TERMINATED;
    return fmi2OK;
}

fmi2Status fmi2Reset(fmi2Component component)
{
    ENTER(ANY_PHASE, EITHER);
    face_reset(c);
    return fmi2OK;
}

fmi2Status fmi2GetReal(fmi2Component component, const fmi2ValueReference vr[], size_t nvr, fmi2Real value[])
{
    ENTER(READABLE, EITHER);
    return AS_FMI(face_get_reals(c, HERE, vr, nvr, value));
}

fmi2Status fmi2GetInteger(fmi2Component component, const fmi2ValueReference vr[], size_t nvr, fmi2Integer value[])
{
    ENTER(READABLE, EITHER);
    if (nvr && (!vr || !value)) return AS_FMI(face_refuse(c, HERE, "an array is missing"));
    for (size_t i = 0; i < nvr; i++)
        if (face_get_mode(c, HERE, vr[i], &value[i]) != FACE_OK) return fmi2Error;
    return fmi2OK;
}

fmi2Status fmi2SetReal(fmi2Component component, const fmi2ValueReference vr[], size_t nvr,
                       const fmi2Real value[])
{
    ENTER(INSTANTIATED | INITIALIZATION | RUNNING, EITHER);
    return AS_FMI(face_set_reals(c, HERE, vr, nvr, value));
}

#define NO_SUCH(name, type, phases)                                                                             \
    fmi2Status name(fmi2Component component, const fmi2ValueReference vr[], size_t nvr, type value[])          \
    {                                                                                                           \
        ENTER(phases, EITHER);                                                                                  \
        (void)vr;                                                                                               \
        (void)value;                                                                                            \
        return AS_FMI(face_no_such(c, HERE, nvr));                                                              \
    }

NO_SUCH(fmi2GetBoolean, fmi2Boolean, READABLE)
NO_SUCH(fmi2GetString, fmi2String, READABLE)
NO_SUCH(fmi2SetInteger, const fmi2Integer, INSTANTIATED | INITIALIZATION | RUNNING)
NO_SUCH(fmi2SetBoolean, const fmi2Boolean, INSTANTIATED | INITIALIZATION | RUNNING)
NO_SUCH(fmi2SetString, const fmi2String, INSTANTIATED | INITIALIZATION | RUNNING)

fmi2Status fmi2GetFMUstate(fmi2Component component, fmi2FMUstate *FMUstate)
{
    ENTER(ANY_PHASE, EITHER);
    return AS_FMI(face_save(c, HERE, (Saved **)FMUstate));
}

fmi2Status fmi2SetFMUstate(fmi2Component component, fmi2FMUstate FMUstate)
{
    ENTER(ANY_PHASE, EITHER);
    return AS_FMI(face_restore(c, HERE, FMUstate));
}

fmi2Status fmi2FreeFMUstate(fmi2Component component, fmi2FMUstate *FMUstate)
{
    ENTER(ANY_PHASE, EITHER);
    return AS_FMI(face_forget(c, HERE, (Saved **)FMUstate));
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component component, fmi2FMUstate FMUstate, size_t *size)
{
    ENTER(ANY_PHASE, EITHER);
    return AS_FMI(face_saved_size(c, HERE, FMUstate, size));
}

fmi2Status fmi2SerializeFMUstate(fmi2Component component, fmi2FMUstate FMUstate, fmi2Byte serializedState[],
                                 size_t size)
{
    ENTER(ANY_PHASE, EITHER);
    return AS_FMI(face_serialize(c, HERE, FMUstate, serializedState, size));
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component component, const fmi2Byte serializedState[], size_t size,
                                   fmi2FMUstate *FMUstate)
{
    ENTER(ANY_PHASE, EITHER);
    return AS_FMI(face_deserialize(c, HERE, serializedState, size, (Saved **)FMUstate));
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component component, const fmi2ValueReference vUnknown_ref[],
                                        size_t nUnknown, const fmi2ValueReference vKnown_ref[], size_t nKnown,
                                        const fmi2Real dvKnown[], fmi2Real dvUnknown[])
{
    ENTER(READABLE, EITHER);
    return AS_FMI(face_forward(c, HERE, vUnknown_ref, nUnknown, vKnown_ref, nKnown, dvKnown, dvUnknown));
}

fmi2Status fmi2EnterEventMode(fmi2Component component)
{
    ENTER(CONTINUOUS_TIME | EVENT_MODE, MODEL_EXCHANGE);
    c->now.phase = EVENT_MODE;
    return fmi2OK;
}

fmi2Status fmi2NewDiscreteStates(fmi2Component component, fmi2EventInfo *eventInfo)
{
    int changed = 0;
    FaceStatus status;
    ENTER(EVENT_MODE, MODEL_EXCHANGE);
    if (!eventInfo) return AS_FMI(face_refuse(c, HERE, "there is nowhere to put the event information"));
    memset(eventInfo, 0, sizeof *eventInfo);
    status = face_settle(c, HERE, &changed);
    eventInfo->valuesOfContinuousStatesChanged = changed ? fmi2True : fmi2False;
    return AS_FMI(status);
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component component)
{
    ENTER(EVENT_MODE, MODEL_EXCHANGE);
    c->now.phase = CONTINUOUS_TIME;
    return fmi2OK;
}

fmi2Status fmi2CompletedIntegratorStep(fmi2Component component, fmi2Boolean noSetFMUStatePriorToCurrentPoint,
                                       fmi2Boolean *enterEventMode, fmi2Boolean *terminateSimulation)
{
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

fmi2Status fmi2SetTime(fmi2Component component, fmi2Real time)
{
    ENTER(EVENT_MODE | CONTINUOUS_TIME, MODEL_EXCHANGE);
    return AS_FMI(face_set_time(c, HERE, time));
}

fmi2Status fmi2SetContinuousStates(fmi2Component component, const fmi2Real x[], size_t nx)
{
    ENTER(CONTINUOUS_TIME, MODEL_EXCHANGE);
    return AS_FMI(face_set_states(c, HERE, x, nx));
}

fmi2Status fmi2GetDerivatives(fmi2Component component, fmi2Real derivatives[], size_t nx)
{
    ENTER(READABLE, MODEL_EXCHANGE);
    return AS_FMI(face_get_rates(c, HERE, derivatives, nx));
}

fmi2Status fmi2GetEventIndicators(fmi2Component component, fmi2Real eventIndicators[], size_t ni)
{
    ENTER(READABLE, MODEL_EXCHANGE);
    return AS_FMI(face_get_indicators(c, HERE, eventIndicators, ni));
}

fmi2Status fmi2GetContinuousStates(fmi2Component component, fmi2Real x[], size_t nx)
{
    ENTER(READABLE, MODEL_EXCHANGE);
    return AS_FMI(face_get_states(c, HERE, x, nx));
}

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component component, fmi2Real x_nominal[], size_t nx)
{
    ENTER(ANY_PHASE, MODEL_EXCHANGE);
    return AS_FMI(face_get_nominals(c, HERE, x_nominal, nx));
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component component, const fmi2ValueReference vr[], size_t nvr,
                                       const fmi2Integer order[], const fmi2Real value[])
{
    ENTER(INSTANTIATED | INITIALIZATION | STEP_MODE, CO_SIMULATION);
    if (nvr && !order) return AS_FMI(face_refuse(c, HERE, "an array is missing"));
    for (size_t i = 0; i < nvr; i++)
        if (order[i] != 1) return AS_FMI(face_refuse(c, HERE, "only first derivatives of inputs are taken"));
    return AS_FMI(face_set_slopes(c, HERE, vr, nvr, value));
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component component, const fmi2ValueReference vr[], size_t nvr,
                                        const fmi2Integer order[], fmi2Real value[])
{
    ENTER(READABLE, CO_SIMULATION);
    (void)vr;
    (void)order;
    (void)value;
    return nvr ? AS_FMI(face_refuse(c, HERE, "derivatives of outputs are not provided")) : fmi2OK;
}

fmi2Status fmi2DoStep(fmi2Component component, fmi2Real currentCommunicationPoint,
                      fmi2Real communicationStepSize, fmi2Boolean noSetFMUStatePriorToCurrentPoint)
{
    CoreStop reached;
    FaceStatus status;
    ENTER(STEP_MODE, CO_SIMULATION);
    (void)noSetFMUStatePriorToCurrentPoint;
    status = face_step(c, HERE, currentCommunicationPoint, communicationStepSize, &reached);
    if (status == FACE_DISCARD) c->now.phase = STEP_FAILED;
    return AS_FMI(status);
}

fmi2Status fmi2CancelStep(fmi2Component component)
{
    ENTER(0, CO_SIMULATION);
    return fmi2Error;
}

#define STATUS_PHASES (STEP_MODE | STEP_FAILED | TERMINATED)
#define STATUS_OF(name, type)                                                                  \
    fmi2Status name(fmi2Component component, const fmi2StatusKind s, type *value)              \
    {                                                                                          \
        ENTER(STATUS_PHASES, CO_SIMULATION);                                                   \
        (void)s;                                                                               \
        (void)value;                                                                           \
        return AS_FMI(face_refuse(c, HERE, "steps end before they return: nothing is pending")); \
    }

STATUS_OF(fmi2GetStatus, fmi2Status)
STATUS_OF(fmi2GetIntegerStatus, fmi2Integer)
STATUS_OF(fmi2GetStringStatus, fmi2String)

fmi2Status fmi2GetRealStatus(fmi2Component component, const fmi2StatusKind s, fmi2Real *value)
{
    ENTER(STATUS_PHASES, CO_SIMULATION);
    if (s != fmi2LastSuccessfulTime || !value)
        return AS_FMI(face_refuse(c, HERE, "only the last successful time is a real number"));
    *value = core_time(&c->now.core);
    return fmi2OK;
}

fmi2Status fmi2GetBooleanStatus(fmi2Component component, const fmi2StatusKind s, fmi2Boolean *value)
{
    ENTER(STATUS_PHASES, CO_SIMULATION);
    if (s != fmi2Terminated || !value)
        return AS_FMI(face_refuse(c, HERE, "only whether it wants to terminate is true or false"));
    *value = fmi2False;
    return fmi2OK;
}

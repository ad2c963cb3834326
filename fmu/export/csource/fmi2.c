/* FMI 2.0.4: instances, variables, saved states and derivatives. */
#include <stdlib.h>
#include <string.h>

#include "fmi2_face.h"

typedef struct {
    Instance common;
    fmi2CallbackFunctions callbacks;
    char *name;
} Component;

static void log_message(Instance *c, FaceStatus status, const char *message) {
    const Component *self = (const Component *)(const void *)c;
    const char *category = status == FACE_ERROR ? "logStatusError" : "logStatusDiscard";
    if (self->callbacks.logger)
        self->callbacks.logger(self->callbacks.componentEnvironment, self->name, AS_FMI(status), category,
                               "%s", message);
}

static void *room(const fmi2CallbackFunctions *callbacks, size_t size) {
    return callbacks->allocateMemory ? callbacks->allocateMemory(1, size) : calloc(1, size);
}

static void release(const fmi2CallbackFunctions *callbacks, void *memory) {
    if (callbacks->allocateMemory && callbacks->freeMemory) callbacks->freeMemory(memory);
    else if (!callbacks->allocateMemory) free(memory);
}

static void complain(const fmi2CallbackFunctions *callbacks, fmi2String name, const char *why) {
    if (callbacks && callbacks->logger)
        callbacks->logger(callbacks->componentEnvironment, name ? name : "", fmi2Error, "logStatusError",
                          "%s", why);
}

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }

const char *fmi2GetVersion(void) { return fmi2Version; }

fmi2Component fmi2Instantiate(fmi2String instanceName, fmi2Type fmuType, fmi2String fmuGUID,
                              fmi2String fmuResourceLocation, const fmi2CallbackFunctions *functions,
                              fmi2Boolean visible, fmi2Boolean loggingOn) {
    Component *self;
    const char *why = NULL;
    (void)fmuResourceLocation;
    (void)visible;
    (void)loggingOn; /* there are only messages that say why something was not done */
    if (!functions) return NULL;
    if (!instanceName || !*instanceName) why = "fmi2Instantiate: the instance needs a name";
    else if (!fmuGUID || strcmp(fmuGUID, FMU_TOKEN))
        why = "fmi2Instantiate: the GUID is that of another model";
    else if (fmuType != fmi2ModelExchange && fmuType != fmi2CoSimulation)
        why = "fmi2Instantiate: unknown type";
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
    face_start(&self->common, fmuType == fmi2CoSimulation ? CO_SIMULATION : MODEL_EXCHANGE, log_message);
    return self;
}

void fmi2FreeInstance(fmi2Component component) {
    Component *self = component;
    fmi2CallbackFunctions callbacks;
    if (!self) return;
    callbacks = self->callbacks;
    release(&callbacks, self->name);
    release(&callbacks, self);
}

fmi2Status fmi2SetDebugLogging(fmi2Component component, fmi2Boolean loggingOn, size_t nCategories,
                               const fmi2String categories[]) {
    ENTER(ANY_PHASE, EITHER);
    if (nCategories && !categories) return AS_FMI(face_refuse(c, HERE, "an array is missing"));
    (void)loggingOn;
    return fmi2OK;
}

fmi2Status fmi2SetupExperiment(fmi2Component component, fmi2Boolean toleranceDefined, fmi2Real tolerance,
                               fmi2Real startTime, fmi2Boolean stopTimeDefined, fmi2Real stopTime) {
    ENTER(INSTANTIATED, EITHER);
    return AS_FMI(
        face_experiment(c, HERE, toleranceDefined, tolerance, startTime, stopTimeDefined, stopTime));
}

fmi2Status fmi2EnterInitializationMode(fmi2Component component) {
    ENTER(INSTANTIATED, EITHER);
    c->now.phase = INITIALIZATION;
    return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component component) {
    FaceStatus status;
    ENTER(INITIALIZATION, EITHER);
    status = face_initialize(c, HERE);
    if (status == FACE_OK) c->now.phase = c->kind == CO_SIMULATION ? STEP_MODE : EVENT_MODE;
    return AS_FMI(status);
}

fmi2Status fmi2Terminate(fmi2Component component) {
    ENTER(RUNNING | STEP_FAILED, EITHER);
    c->now.phase = TERMINATED;
    return fmi2OK;
}

fmi2Status fmi2Reset(fmi2Component component) {
    ENTER(ANY_PHASE, EITHER);
    face_reset(c);
    return fmi2OK;
}

fmi2Status fmi2GetReal(fmi2Component component, const fmi2ValueReference vr[], size_t nvr, fmi2Real value[]) {
    ENTER(READABLE, EITHER);
    return AS_FMI(face_get_reals(c, HERE, vr, nvr, value));
}

fmi2Status fmi2GetInteger(fmi2Component component, const fmi2ValueReference vr[], size_t nvr,
                          fmi2Integer value[]) {
    ENTER(READABLE, EITHER);
    if (nvr && (!vr || !value)) return AS_FMI(face_refuse(c, HERE, "an array is missing"));
    for (size_t i = 0; i < nvr; i++)
        if (face_get_mode(c, HERE, vr[i], &value[i]) != FACE_OK) return fmi2Error;
    return fmi2OK;
}

fmi2Status fmi2SetReal(fmi2Component component, const fmi2ValueReference vr[], size_t nvr,
                       const fmi2Real value[]) {
    ENTER(INSTANTIATED | INITIALIZATION | RUNNING, EITHER);
    return AS_FMI(face_set_reals(c, HERE, vr, nvr, value));
}

#define NO_SUCH(name, type, phases)                                                                     \
    fmi2Status name(fmi2Component component, const fmi2ValueReference vr[], size_t nvr, type value[]) { \
        ENTER(phases, EITHER);                                                                          \
        (void)vr;                                                                                       \
        (void)value;                                                                                    \
        return AS_FMI(face_no_such(c, HERE, nvr));                                                      \
    }

NO_SUCH(fmi2GetBoolean, fmi2Boolean, READABLE)
NO_SUCH(fmi2GetString, fmi2String, READABLE)
NO_SUCH(fmi2SetInteger, const fmi2Integer, INSTANTIATED | INITIALIZATION | RUNNING)
NO_SUCH(fmi2SetBoolean, const fmi2Boolean, INSTANTIATED | INITIALIZATION | RUNNING)
NO_SUCH(fmi2SetString, const fmi2String, INSTANTIATED | INITIALIZATION | RUNNING)

fmi2Status fmi2GetFMUstate(fmi2Component component, fmi2FMUstate *FMUstate) {
    ENTER(ANY_PHASE, EITHER);
    return AS_FMI(face_save(c, HERE, (Saved **)FMUstate));
}

fmi2Status fmi2SetFMUstate(fmi2Component component, fmi2FMUstate FMUstate) {
    ENTER(ANY_PHASE, EITHER);
    return AS_FMI(face_restore(c, HERE, FMUstate));
}

fmi2Status fmi2FreeFMUstate(fmi2Component component, fmi2FMUstate *FMUstate) {
    ENTER(ANY_PHASE, EITHER);
    return AS_FMI(face_forget(c, HERE, (Saved **)FMUstate));
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component component, fmi2FMUstate FMUstate, size_t *size) {
    ENTER(ANY_PHASE, EITHER);
    return AS_FMI(face_saved_size(c, HERE, FMUstate, size));
}

fmi2Status fmi2SerializeFMUstate(fmi2Component component, fmi2FMUstate FMUstate, fmi2Byte serializedState[],
                                 size_t size) {
    ENTER(ANY_PHASE, EITHER);
    return AS_FMI(face_serialize(c, HERE, FMUstate, serializedState, size));
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component component, const fmi2Byte serializedState[], size_t size,
                                   fmi2FMUstate *FMUstate) {
    ENTER(ANY_PHASE, EITHER);
    return AS_FMI(face_deserialize(c, HERE, serializedState, size, (Saved **)FMUstate));
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component component, const fmi2ValueReference vUnknown_ref[],
                                        size_t nUnknown, const fmi2ValueReference vKnown_ref[], size_t nKnown,
                                        const fmi2Real dvKnown[], fmi2Real dvUnknown[]) {
    ENTER(READABLE, EITHER);
    return AS_FMI(face_forward(c, HERE, vUnknown_ref, nUnknown, vKnown_ref, nKnown, dvKnown, dvUnknown));
}

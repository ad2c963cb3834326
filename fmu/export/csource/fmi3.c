/* FMI 3.0.1: instances, variables, saved states and derivatives. */
#include <stdlib.h>
#include <string.h>

#include "fmi3_face.h"

typedef struct {
    Instance common;
    fmi3InstanceEnvironment environment;
    fmi3LogMessageCallback log;
} Component;

static void log_message(Instance *c, FaceStatus status, const char *message) {
    const Component *self = (const Component *)(const void *)c;
    const char *category = status == FACE_ERROR ? "logStatusError" : "logStatusDiscard";
    if (self->log) self->log(self->environment, AS_FMI(status), category, message);
}

const char *fmi3GetVersion(void) { return fmi3Version; }

static Component *instantiate(const char *name, const char *token, fmi3InstanceEnvironment environment,
                              fmi3LogMessageCallback log, Kind kind) {
    Component *self = NULL;
    const char *why = NULL;
    if (!name || !*name) why = "fmi3Instantiate: the instance needs a name";
    else if (!token || strcmp(token, FMU_TOKEN)) why = "fmi3Instantiate: the token is that of another model";
    else {
        self = calloc(1, sizeof *self);
        if (!self) why = "fmi3Instantiate: out of memory";
    }
    if (!self) {
        if (log) log(environment, fmi3Error, "logStatusError", why);
        return NULL;
    }
    self->environment = environment;
    self->log = log;
    face_start(&self->common, kind, log_message);
    return self;
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String instanceName, fmi3String instantiationToken,
                                          fmi3String resourcePath, fmi3Boolean visible, fmi3Boolean loggingOn,
                                          fmi3InstanceEnvironment instanceEnvironment,
                                          fmi3LogMessageCallback logMessage) {
    (void)resourcePath;
    (void)visible;
    (void)loggingOn; /* there are only messages that say why something was not done */
    return instantiate(instanceName, instantiationToken, instanceEnvironment, logMessage, MODEL_EXCHANGE);
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String instanceName, fmi3String instantiationToken,
                                         fmi3String resourcePath, fmi3Boolean visible, fmi3Boolean loggingOn,
                                         fmi3Boolean eventModeUsed, fmi3Boolean earlyReturnAllowed,
                                         const fmi3ValueReference requiredIntermediateVariables[],
                                         size_t nRequiredIntermediateVariables,
                                         fmi3InstanceEnvironment instanceEnvironment,
                                         fmi3LogMessageCallback logMessage,
                                         fmi3IntermediateUpdateCallback intermediateUpdate) {
    Component *self =
        instantiate(instanceName, instantiationToken, instanceEnvironment, logMessage, CO_SIMULATION);
    (void)resourcePath;
    (void)visible;
    (void)loggingOn;
    (void)requiredIntermediateVariables;
    (void)intermediateUpdate;
    if (!self) return NULL;
    if (nRequiredIntermediateVariables) {
        face_refuse(&self->common, HERE, "intermediate update is not provided");
        free(self);
        return NULL;
    }
    self->common.event_mode_used = eventModeUsed;
    self->common.may_return_early = earlyReturnAllowed;
    return self;
}

void fmi3FreeInstance(fmi3Instance instance) { free(instance); }

fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean loggingOn, size_t nCategories,
                               const fmi3String categories[]) {
    ENTER(ANY_PHASE, EITHER);
    if (nCategories && !categories) return AS_FMI(face_refuse(c, HERE, "an array is missing"));
    (void)loggingOn;
    return fmi3OK;
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean toleranceDefined,
                                       fmi3Float64 tolerance, fmi3Float64 startTime,
                                       fmi3Boolean stopTimeDefined, fmi3Float64 stopTime) {
    FaceStatus status;
    ENTER(INSTANTIATED, EITHER);
    status = face_experiment(c, HERE, toleranceDefined, tolerance, startTime, stopTimeDefined, stopTime);
    if (status == FACE_OK) c->now.phase = INITIALIZATION;
    return AS_FMI(status);
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance) {
    FaceStatus status;
    ENTER(INITIALIZATION, EITHER);
    status = face_initialize(c, HERE);
    if (status == FACE_OK)
        c->now.phase = c->kind == MODEL_EXCHANGE || c->event_mode_used ? EVENT_MODE : STEP_MODE;
    return AS_FMI(status);
}

fmi3Status fmi3EnterEventMode(fmi3Instance instance) {
    ENTER(CONTINUOUS_TIME | STEP_MODE, EITHER);
    if (c->kind == CO_SIMULATION && !c->event_mode_used)
        return AS_FMI(face_refuse(c, HERE, "this instance was made without event mode"));
    c->now.phase = EVENT_MODE;
    return fmi3OK;
}

fmi3Status fmi3Terminate(fmi3Instance instance) {
    ENTER(RUNNING, EITHER);
    c->now.phase = TERMINATED;
    return fmi3OK;
}

fmi3Status fmi3Reset(fmi3Instance instance) {
    ENTER(ANY_PHASE, EITHER);
    face_reset(c);
    return fmi3OK;
}

fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                          size_t nValueReferences, fmi3Float64 values[], size_t nValues) {
    ENTER(READABLE, EITHER);
    if (nValues != nValueReferences) return AS_FMI(face_refuse(c, HERE, "every variable has one value"));
    return AS_FMI(face_get_reals(c, HERE, valueReferences, nValueReferences, values));
}

fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                          size_t nValueReferences, const fmi3Float64 values[], size_t nValues) {
    ENTER(SETTABLE, EITHER);
    if (nValues != nValueReferences) return AS_FMI(face_refuse(c, HERE, "every variable has one value"));
    return AS_FMI(face_set_reals(c, HERE, valueReferences, nValueReferences, values));
}

/* Enumerations are read as 64-bit integers. */
fmi3Status fmi3GetInt64(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                        size_t nValueReferences, fmi3Int64 values[], size_t nValues) {
    ENTER(READABLE, EITHER);
    if (nValues != nValueReferences) return AS_FMI(face_refuse(c, HERE, "every variable has one value"));
    if (nValues && (!valueReferences || !values)) return AS_FMI(face_refuse(c, HERE, "an array is missing"));
    for (size_t i = 0; i < nValues; i++) {
        int mode;
        if (face_get_mode(c, HERE, valueReferences[i], &mode) != FACE_OK) return fmi3Error;
        values[i] = mode;
    }
    return fmi3OK;
}

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState *FMUState) {
    ENTER(ANY_PHASE, EITHER);
    return AS_FMI(face_save(c, HERE, (Saved **)FMUState));
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState FMUState) {
    ENTER(ANY_PHASE, EITHER);
    return AS_FMI(face_restore(c, HERE, FMUState));
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState *FMUState) {
    ENTER(ANY_PHASE, EITHER);
    return AS_FMI(face_forget(c, HERE, (Saved **)FMUState));
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState FMUState, size_t *size) {
    ENTER(ANY_PHASE, EITHER);
    return AS_FMI(face_saved_size(c, HERE, FMUState, size));
}

fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState FMUState, fmi3Byte serializedState[],
                                 size_t size) {
    ENTER(ANY_PHASE, EITHER);
    return AS_FMI(face_serialize(c, HERE, FMUState, serializedState, size));
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte serializedState[], size_t size,
                                   fmi3FMUState *FMUState) {
    ENTER(ANY_PHASE, EITHER);
    return AS_FMI(face_deserialize(c, HERE, serializedState, size, (Saved **)FMUState));
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
                                        size_t nUnknowns, const fmi3ValueReference knowns[], size_t nKnowns,
                                        const fmi3Float64 seed[], size_t nSeed, fmi3Float64 sensitivity[],
                                        size_t nSensitivity) {
    ENTER(READABLE, EITHER);
    if (nSeed != nKnowns || nSensitivity != nUnknowns)
        return AS_FMI(face_refuse(c, HERE, "every variable has one value"));
    return AS_FMI(face_forward(c, HERE, unknowns, nUnknowns, knowns, nKnowns, seed, sensitivity));
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
                                    size_t nUnknowns, const fmi3ValueReference knowns[], size_t nKnowns,
                                    const fmi3Float64 seed[], size_t nSeed, fmi3Float64 sensitivity[],
                                    size_t nSensitivity) {
    ENTER(READABLE, EITHER);
    if (nSeed != nUnknowns || nSensitivity != nKnowns)
        return AS_FMI(face_refuse(c, HERE, "every variable has one value"));
    return AS_FMI(face_adjoint(c, HERE, unknowns, nUnknowns, knowns, nKnowns, seed, sensitivity));
}

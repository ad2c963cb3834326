/* The functions of FMI 3.0.1 for what these models do not have: other types, clocks, configuration,
 * partitions. */
#include "fmi_common.h"

fmi3Instance fmi3InstantiateScheduledExecution(
    fmi3String instanceName, fmi3String instantiationToken, fmi3String resourcePath, fmi3Boolean visible,
    fmi3Boolean loggingOn, fmi3InstanceEnvironment instanceEnvironment, fmi3LogMessageCallback logMessage,
    fmi3ClockUpdateCallback clockUpdate, fmi3LockPreemptionCallback lockPreemption,
    fmi3UnlockPreemptionCallback unlockPreemption) {
    if (logMessage)
        logMessage(instanceEnvironment, fmi3Error, "logStatusError", "scheduled execution is not provided");
    return NULL;
}

#define NO_SUCH(name, phases, count, ...)                                              \
    fmi3Status name(fmi3Instance instance, const fmi3ValueReference valueReferences[], \
                    size_t nValueReferences, __VA_ARGS__) {                            \
        ENTER(phases, EITHER);                                                         \
        return face_no_such(c, count);                                                 \
    }

#define BOTH (nValueReferences + nValues)
#define NOT_SET(type) NO_SUCH(fmi3Set##type, SETTABLE, BOTH, const fmi3##type values[], size_t nValues)
#define NO_TYPE(type) \
    NO_SUCH(fmi3Get##type, READABLE, BOTH, fmi3##type values[], size_t nValues) NOT_SET(type)

NO_TYPE(Float32)
NO_TYPE(Int8)
NO_TYPE(UInt8)
NO_TYPE(Int16)
NO_TYPE(UInt16)
NO_TYPE(UInt32)
NO_TYPE(UInt64)
NO_TYPE(String)
NOT_SET(Int32)
NOT_SET(Int64)
NO_SUCH(fmi3GetBinary, READABLE, BOTH, size_t valueSizes[], fmi3Binary values[], size_t nValues)
NO_SUCH(fmi3SetBinary, SETTABLE, BOTH, const size_t valueSizes[], const fmi3Binary values[], size_t nValues)

/* What belongs to clocks: there are none, so nothing may be asked of them. */
#define NO_CLOCK(name, ...) NO_SUCH(name, ANY_PHASE, nValueReferences, __VA_ARGS__)

NO_CLOCK(fmi3GetClock, fmi3Clock values[])
NO_CLOCK(fmi3SetClock, const fmi3Clock values[])
NO_CLOCK(fmi3GetIntervalDecimal, fmi3Float64 intervals[], fmi3IntervalQualifier qualifiers[])
NO_CLOCK(fmi3GetIntervalFraction, fmi3UInt64 counters[], fmi3UInt64 resolutions[],
         fmi3IntervalQualifier qualifiers[])
NO_CLOCK(fmi3GetShiftDecimal, fmi3Float64 shifts[])
NO_CLOCK(fmi3SetShiftDecimal, const fmi3Float64 shifts[])
NO_CLOCK(fmi3GetShiftFraction, fmi3UInt64 counters[], fmi3UInt64 resolutions[])
NO_CLOCK(fmi3SetShiftFraction, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])
NO_CLOCK(fmi3SetIntervalFraction, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])
NO_CLOCK(fmi3SetIntervalDecimal, const fmi3Float64 intervals[])

fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance instance, fmi3ValueReference valueReference,
                                               size_t *nDependencies) {
    ENTER(ANY_PHASE, EITHER);
    return face_refuse(c, "dependencies do not change: see the model description");
}

fmi3Status fmi3GetVariableDependencies(fmi3Instance instance, fmi3ValueReference dependent,
                                       size_t elementIndicesOfDependent[], fmi3ValueReference independents[],
                                       size_t elementIndicesOfIndependents[],
                                       fmi3DependencyKind dependencyKinds[], size_t nDependencies) {
    ENTER(ANY_PHASE, EITHER);
    return face_refuse(c, "dependencies do not change: see the model description");
}

fmi3Status fmi3EnterConfigurationMode(fmi3Instance instance) {
    ENTER(INSTANTIATED | RUNNING, EITHER);
    return face_refuse(c, "there are no structural parameters");
}

fmi3Status fmi3ExitConfigurationMode(fmi3Instance instance) {
    ENTER(0, EITHER);
    return fmi3Error;
}

fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance instance) {
    ENTER(INITIALIZATION | EVENT_MODE, EITHER);
    return face_refuse(c, "is not provided; call fmi3UpdateDiscreteStates");
}

fmi3Status fmi3ActivateModelPartition(fmi3Instance instance, fmi3ValueReference clockReference,
                                      fmi3Float64 activationTime) {
    ENTER(0, EITHER);
    return fmi3Error;
}

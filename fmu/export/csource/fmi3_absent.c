/* The functions of FMI 3.0.1 for what these models do not have: other types, clocks, configuration,
 * partitions. */
#include "fmi3_face.h"

fmi3Instance fmi3InstantiateScheduledExecution(
    fmi3String instanceName, fmi3String instantiationToken, fmi3String resourcePath, fmi3Boolean visible,
    fmi3Boolean loggingOn, fmi3InstanceEnvironment instanceEnvironment, fmi3LogMessageCallback logMessage,
    fmi3ClockUpdateCallback clockUpdate, fmi3LockPreemptionCallback lockPreemption,
    fmi3UnlockPreemptionCallback unlockPreemption) {
    (void)instanceName;
    (void)instantiationToken;
    (void)resourcePath;
    (void)visible;
    (void)loggingOn;
    (void)clockUpdate;
    (void)lockPreemption;
    (void)unlockPreemption;
    if (logMessage)
        logMessage(instanceEnvironment, fmi3Error, "logStatusError", "scheduled execution is not provided");
    return NULL;
}

#define NO_SUCH(name, type, phases)                                                    \
    fmi3Status name(fmi3Instance instance, const fmi3ValueReference valueReferences[], \
                    size_t nValueReferences, type values[], size_t nValues) {          \
        ENTER(phases, EITHER);                                                         \
        (void)valueReferences;                                                         \
        (void)values;                                                                  \
        return AS_FMI(face_no_such(c, HERE, nValueReferences + nValues));              \
    }

NO_SUCH(fmi3GetFloat32, fmi3Float32, READABLE)
NO_SUCH(fmi3GetInt8, fmi3Int8, READABLE)
NO_SUCH(fmi3GetUInt8, fmi3UInt8, READABLE)
NO_SUCH(fmi3GetInt16, fmi3Int16, READABLE)
NO_SUCH(fmi3GetUInt16, fmi3UInt16, READABLE)
NO_SUCH(fmi3GetInt32, fmi3Int32, READABLE)
NO_SUCH(fmi3GetUInt32, fmi3UInt32, READABLE)
NO_SUCH(fmi3GetUInt64, fmi3UInt64, READABLE)
NO_SUCH(fmi3GetBoolean, fmi3Boolean, READABLE)
NO_SUCH(fmi3GetString, fmi3String, READABLE)
NO_SUCH(fmi3SetFloat32, const fmi3Float32, SETTABLE)
NO_SUCH(fmi3SetInt8, const fmi3Int8, SETTABLE)
NO_SUCH(fmi3SetUInt8, const fmi3UInt8, SETTABLE)
NO_SUCH(fmi3SetInt16, const fmi3Int16, SETTABLE)
NO_SUCH(fmi3SetUInt16, const fmi3UInt16, SETTABLE)
NO_SUCH(fmi3SetInt32, const fmi3Int32, SETTABLE)
NO_SUCH(fmi3SetUInt32, const fmi3UInt32, SETTABLE)
NO_SUCH(fmi3SetInt64, const fmi3Int64, SETTABLE)
NO_SUCH(fmi3SetUInt64, const fmi3UInt64, SETTABLE)
NO_SUCH(fmi3SetBoolean, const fmi3Boolean, SETTABLE)
NO_SUCH(fmi3SetString, const fmi3String, SETTABLE)

fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                         size_t nValueReferences, size_t valueSizes[], fmi3Binary values[], size_t nValues) {
    ENTER(READABLE, EITHER);
    (void)valueReferences;
    (void)valueSizes;
    (void)values;
    return AS_FMI(face_no_such(c, HERE, nValueReferences + nValues));
}

fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                         size_t nValueReferences, const size_t valueSizes[], const fmi3Binary values[],
                         size_t nValues) {
    ENTER(SETTABLE, EITHER);
    (void)valueReferences;
    (void)valueSizes;
    (void)values;
    return AS_FMI(face_no_such(c, HERE, nValueReferences + nValues));
}

/* What belongs to clocks: there are none, so nothing may be asked of them. */
#define NO_CLOCK(name, ...)                                                            \
    fmi3Status name(fmi3Instance instance, const fmi3ValueReference valueReferences[], \
                    size_t nValueReferences, __VA_ARGS__) {                            \
        ENTER(ANY_PHASE, EITHER);                                                      \
        (void)valueReferences;                                                         \
        UNUSED;                                                                        \
        return AS_FMI(face_no_such(c, HERE, nValueReferences));                        \
    }

#define UNUSED (void)values
NO_CLOCK(fmi3GetClock, fmi3Clock values[])
NO_CLOCK(fmi3SetClock, const fmi3Clock values[])
#undef UNUSED
#define UNUSED (void)intervals, (void)qualifiers
NO_CLOCK(fmi3GetIntervalDecimal, fmi3Float64 intervals[], fmi3IntervalQualifier qualifiers[])
#undef UNUSED
#define UNUSED (void)counters, (void)resolutions, (void)qualifiers
NO_CLOCK(fmi3GetIntervalFraction, fmi3UInt64 counters[], fmi3UInt64 resolutions[],
         fmi3IntervalQualifier qualifiers[])
#undef UNUSED
#define UNUSED (void)shifts
NO_CLOCK(fmi3GetShiftDecimal, fmi3Float64 shifts[])
NO_CLOCK(fmi3SetShiftDecimal, const fmi3Float64 shifts[])
#undef UNUSED
#define UNUSED (void)counters, (void)resolutions
NO_CLOCK(fmi3GetShiftFraction, fmi3UInt64 counters[], fmi3UInt64 resolutions[])
NO_CLOCK(fmi3SetShiftFraction, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])
NO_CLOCK(fmi3SetIntervalFraction, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])
#undef UNUSED
#define UNUSED (void)intervals
NO_CLOCK(fmi3SetIntervalDecimal, const fmi3Float64 intervals[])
#undef UNUSED

fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance instance, fmi3ValueReference valueReference,
                                               size_t *nDependencies) {
    ENTER(ANY_PHASE, EITHER);
    (void)valueReference;
    (void)nDependencies;
    return AS_FMI(face_refuse(c, HERE, "dependencies do not change: see the model description"));
}

fmi3Status fmi3GetVariableDependencies(fmi3Instance instance, fmi3ValueReference dependent,
                                       size_t elementIndicesOfDependent[], fmi3ValueReference independents[],
                                       size_t elementIndicesOfIndependents[],
                                       fmi3DependencyKind dependencyKinds[], size_t nDependencies) {
    ENTER(ANY_PHASE, EITHER);
    (void)dependent;
    (void)elementIndicesOfDependent;
    (void)independents;
    (void)elementIndicesOfIndependents;
    (void)dependencyKinds;
    (void)nDependencies;
    return AS_FMI(face_refuse(c, HERE, "dependencies do not change: see the model description"));
}

fmi3Status fmi3EnterConfigurationMode(fmi3Instance instance) {
    ENTER(INSTANTIATED | RUNNING, EITHER);
    return AS_FMI(face_refuse(c, HERE, "there are no structural parameters"));
}

fmi3Status fmi3ExitConfigurationMode(fmi3Instance instance) {
    ENTER(0, EITHER);
    return fmi3Error;
}

fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance instance) {
    ENTER(INITIALIZATION | EVENT_MODE, EITHER);
    return AS_FMI(face_refuse(c, HERE, "is not provided; call fmi3UpdateDiscreteStates"));
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                    size_t nValueReferences, const fmi3Int32 orders[], fmi3Float64 values[],
                                    size_t nValues) {
    ENTER(READABLE, CO_SIMULATION);
    (void)valueReferences;
    (void)orders;
    (void)values;
    return nValueReferences + nValues
               ? AS_FMI(face_refuse(c, HERE, "derivatives of outputs are not provided"))
               : fmi3OK;
}

fmi3Status fmi3ActivateModelPartition(fmi3Instance instance, fmi3ValueReference clockReference,
                                      fmi3Float64 activationTime) {
    ENTER(0, EITHER);
    (void)clockReference;
    (void)activationTime;
    return fmi3Error;
}

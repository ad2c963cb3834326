/* Random call sequences on an FMI 3.0 FMU: fuzz3 me|cs COUNT SEED. It exits with 0 if all went well. */
#include "fmi3Functions.h"
#include "fuzz.h"

static unsigned long counts[7], sequence;

static void logger(fmi3InstanceEnvironment e, fmi3Status status, fmi3String category, fmi3String message) {
    (void)e, (void)status;
    if (!strlen(category) || !strlen(message)) exit(4);
}

typedef struct {
    fmi3Instance c;
    fmi3FMUState saved;
    fmi3Byte *bytes;
    void *garbage;
    size_t size;
    double t;
    int exchange, events;
} Bench;

static fmi3Status update(Bench *b) {
    fmi3Boolean flags[5];
    double next;
    return fmi3UpdateDiscreteStates(b->c, flags, flags + 1, flags + 2, flags + 3, flags + 4, &next);
}

static void initialize(Bench *b) {
    must(fmi3EnterInitializationMode(b->c, false, 0, 0, false, 0) == fmi3OK, "EnterInitializationMode",
         sequence);
    must(fmi3ExitInitializationMode(b->c) == fmi3OK, "ExitInitializationMode", sequence);
    b->t = 0;
    if (!b->exchange && !b->events) return;
    must(update(b) == fmi3OK, "UpdateDiscreteStates", sequence);
    if (b->exchange) must(fmi3EnterContinuousTimeMode(b->c) == fmi3OK, "EnterContinuousTimeMode", sequence);
    else must(fmi3EnterStepMode(b->c) == fmi3OK, "EnterStepMode", sequence);
}

static void set_inputs(Bench *b) {
    for (fmi3ValueReference ref = REF_INPUTS; ref < REF_PARAMETERS; ref++) {
        double value = 5 * tame();
        must(fmi3SetFloat64(b->c, &ref, 1, &value, 1) == fmi3OK, "SetFloat64", sequence);
    }
}

static void legal_exchange(Bench *b) {
    double x[ROOMY], rates[ROOMY], g[ROOMY];
    fmi3Boolean due, end;
    for (int k = 0; k < LONGEST; k++) {
        double h = 1e-4 * (1 + draw(10));
        must(fmi3GetContinuousStates(b->c, x, NX) == fmi3OK, "GetContinuousStates", sequence);
        must(fmi3GetContinuousStateDerivatives(b->c, rates, NX) <= fmi3Discard, "GetDerivatives", sequence);
        for (int i = 0; i < NX; i++) x[i] += h * rates[i];
        must(fmi3SetTime(b->c, b->t += h) == fmi3OK, "SetTime", sequence);
        must(fmi3SetContinuousStates(b->c, x, NX) == fmi3OK, "SetContinuousStates", sequence);
        set_inputs(b);
        must(fmi3GetEventIndicators(b->c, g, NG) <= fmi3Discard, "GetEventIndicators", sequence);
        must(fmi3CompletedIntegratorStep(b->c, true, &due, &end) <= fmi3Discard, "CompletedStep", sequence);
        if (!due && !one_in(5)) continue;
        must(fmi3EnterEventMode(b->c) == fmi3OK, "EnterEventMode", sequence);
        if (update(b) != fmi3OK) return;
        must(fmi3EnterContinuousTimeMode(b->c) == fmi3OK, "EnterContinuousTimeMode", sequence);
    }
}

static void legal_communication(Bench *b) {
    for (int k = 0; k < LONGEST; k++) {
        double h = 1e-3 * (1 + draw(20)), back = b->t, reached = b->t;
        fmi3Boolean event = false, end, early;
        fmi3FMUState here = NULL;
        if (!b->events || k == 0) set_inputs(b);
        must(fmi3GetFMUState(b->c, &here) == fmi3OK, "GetFMUState", sequence);
        if (fmi3DoStep(b->c, b->t, h, false, &event, &end, &early, &reached) == fmi3OK)
            b->t = early ? reached : b->t + h;
        if (one_in(4)) {
            must(fmi3SetFMUState(b->c, here) == fmi3OK, "SetFMUState", sequence);
            b->t = back;
        } else if (event) {
            must(fmi3EnterEventMode(b->c) == fmi3OK, "EnterEventMode", sequence);
            if (update(b) == fmi3OK) must(fmi3EnterStepMode(b->c) == fmi3OK, "EnterStepMode", sequence);
        }
        must(fmi3FreeFMUState(b->c, &here) == fmi3OK, "FreeFMUState", sequence);
    }
}

static fmi3Status serialized(Bench *b) {
    fmi3Status status = fmi3SerializedFMUStateSize(b->c, b->saved, &b->size);
    if (status != fmi3OK) return status;
    free(b->bytes);
    b->bytes = malloc(b->size);
    status = fmi3SerializeFMUState(b->c, b->saved, b->bytes, one_in(5) ? b->size / 2 : b->size);
    if (one_in(3)) b->bytes[draw((unsigned)b->size)] ^= 1;
    return status;
}

static fmi3Status step(Bench *b) {
    fmi3Boolean flags[3];
    double reached = b->t;
    fmi3Status status = fmi3DoStep(b->c, one_in(6) ? number() : b->t, step_size(), one_in(2), flags,
                                   flags + 1, one_in(20) ? NULL : flags + 2, &reached);
    if (status == fmi3OK) b->t = reached;
    return status;
}

static fmi3Status other_type(fmi3Instance c, const fmi3ValueReference refs[], size_t n, size_t m) {
    union {
        fmi3Float32 f[FEW];
        fmi3Int8 a[FEW];
        fmi3UInt8 b[FEW];
        fmi3Int16 d[FEW];
        fmi3UInt16 e[FEW];
        fmi3Int32 g[FEW];
        fmi3UInt32 h[FEW];
        fmi3Int64 i[FEW];
        fmi3UInt64 j[FEW];
        fmi3Boolean k[FEW];
        fmi3String l[FEW];
        fmi3Binary o[FEW];
        fmi3Clock p[FEW];
        fmi3Float64 q[FEW];
    } v;
    size_t sizes[FEW] = {0};
    fmi3IntervalQualifier kinds[FEW];
    fmi3UInt64 others[FEW] = {0};
    memset(&v, 0, sizeof v);
    switch (draw(36)) {
    case 0: return fmi3GetFloat32(c, refs, n, v.f, m);
    case 1: return fmi3SetFloat32(c, refs, n, v.f, m);
    case 2: return fmi3GetInt8(c, refs, n, v.a, m);
    case 3: return fmi3SetInt8(c, refs, n, v.a, m);
    case 4: return fmi3GetUInt8(c, refs, n, v.b, m);
    case 5: return fmi3SetUInt8(c, refs, n, v.b, m);
    case 6: return fmi3GetInt16(c, refs, n, v.d, m);
    case 7: return fmi3SetInt16(c, refs, n, v.d, m);
    case 8: return fmi3GetUInt16(c, refs, n, v.e, m);
    case 9: return fmi3SetUInt16(c, refs, n, v.e, m);
    case 10: return fmi3GetInt32(c, refs, n, v.g, m);
    case 11: return fmi3SetInt32(c, refs, n, v.g, m);
    case 12: return fmi3GetUInt32(c, refs, n, v.h, m);
    case 13: return fmi3SetUInt32(c, refs, n, v.h, m);
    case 14: return fmi3GetInt64(c, refs, n, v.i, m);
    case 15: return fmi3SetInt64(c, refs, n, v.i, m);
    case 16: return fmi3GetUInt64(c, refs, n, v.j, m);
    case 17: return fmi3SetUInt64(c, refs, n, v.j, m);
    case 18: return fmi3GetBoolean(c, refs, n, v.k, m);
    case 19: return fmi3SetBoolean(c, refs, n, v.k, m);
    case 20: return fmi3GetString(c, refs, n, v.l, m);
    case 21: return fmi3SetString(c, refs, n, v.l, m);
    case 22: return fmi3GetBinary(c, refs, n, sizes, v.o, m);
    case 23: return fmi3SetBinary(c, refs, n, sizes, v.o, m);
    case 24: return fmi3GetClock(c, refs, n, v.p);
    case 25: return fmi3SetClock(c, refs, n, v.p);
    case 26: return fmi3GetIntervalDecimal(c, refs, n, v.q, kinds);
    case 27: return fmi3GetIntervalFraction(c, refs, n, v.j, others, kinds);
    case 28: return fmi3GetShiftDecimal(c, refs, n, v.q);
    case 29: return fmi3GetShiftFraction(c, refs, n, v.j, others);
    case 30: return fmi3SetIntervalDecimal(c, refs, n, v.q);
    case 31: return fmi3SetIntervalFraction(c, refs, n, v.j, others);
    case 32: return fmi3SetShiftDecimal(c, refs, n, v.q);
    case 33: return fmi3SetShiftFraction(c, refs, n, v.j, others);
    case 34: return fmi3GetOutputDerivatives(c, refs, n, v.g, v.q, m);
    default: return fmi3ActivateModelPartition(c, 0, number());
    }
}

static fmi3Status any_call(Bench *b) {
    fmi3ValueReference refs[FEW], knowns[FEW];
    double v[ROOMY], w[ROOMY];
    fmi3Int64 whole[FEW];
    fmi3Boolean flags[2];
    fmi3Instance c = b->c;
    size_t n = draw(FEW + 1), m = one_in(9) ? draw(FEW + 1) : n, k = draw(FEW + 1), size;
    size_t nx = one_in(5) ? n : NX, ng = one_in(5) ? n : NG;
    double *some = one_in(9) ? NULL : v;
    references(refs, FEW);
    references(knowns, FEW);
    numbers(v, ROOMY);
    switch (draw(44)) {
    case 0: return fmi3EnterInitializationMode(c, one_in(2), number(), number(), one_in(2), number());
    case 1: return fmi3ExitInitializationMode(c);
    case 2: return one_in(4) ? fmi3Terminate(c) : fmi3OK;
    case 3: b->t = 0; return one_in(4) ? fmi3Reset(c) : fmi3OK;
    case 4: return fmi3GetFloat64(c, refs, n, some, m);
    case 5: return fmi3SetFloat64(c, one_in(9) ? NULL : refs, n, v, m);
    case 6: return fmi3GetInt64(c, refs, n, whole, m);
    case 7: return fmi3GetFMUState(c, &b->saved);
    case 8: return fmi3SetFMUState(c, b->saved);
    case 9: return fmi3SetFMUState(c, one_in(2) ? b->garbage : NULL);
    case 10: return fmi3FreeFMUState(c, &b->saved);
    case 11: return serialized(b);
    case 12: return b->bytes ? fmi3DeserializeFMUState(c, b->bytes, b->size - one_in(5), &b->saved) : fmi3OK;
    case 13: return fmi3GetDirectionalDerivative(c, refs, n, knowns, k, some, one_in(9) ? m : k, w, n);
    case 14: return fmi3GetAdjointDerivative(c, refs, n, knowns, k, some, one_in(9) ? k : n, w, k);
    case 15: return fmi3EnterEventMode(c);
    case 16: return update(b);
    case 17: return fmi3UpdateDiscreteStates(c, NULL, NULL, NULL, NULL, NULL, NULL);
    case 18: return fmi3EnterContinuousTimeMode(c);
    case 19: return fmi3EnterStepMode(c);
    case 20: return fmi3CompletedIntegratorStep(c, one_in(2), one_in(20) ? NULL : flags, flags + 1);
    case 21: return fmi3SetTime(c, number());
    case 22: return fmi3SetContinuousStates(c, some, nx);
    case 23: return fmi3GetContinuousStateDerivatives(c, some, nx);
    case 24: return fmi3GetEventIndicators(c, some, ng);
    case 25: return fmi3GetContinuousStates(c, some, nx);
    case 26: return fmi3GetNominalsOfContinuousStates(c, some, nx);
    case 27: return fmi3GetNumberOfEventIndicators(c, one_in(3) ? NULL : &size);
    case 28: return fmi3GetNumberOfContinuousStates(c, one_in(3) ? NULL : &size);
    case 29: return fmi3EvaluateDiscreteStates(c);
    case 30: return fmi3EnterConfigurationMode(c);
    case 31: return fmi3ExitConfigurationMode(c);
    case 32: return fmi3GetNumberOfVariableDependencies(c, refs[0], &size);
    case 33: return fmi3GetVariableDependencies(c, refs[0], NULL, NULL, NULL, NULL, 0);
    case 34: return fmi3SetDebugLogging(c, one_in(2), n, NULL);
    case 35:
    case 36:
    case 37: return other_type(c, refs, draw(FEW), draw(FEW));
    default: return step(b);
    }
}

int main(int argc, char **argv) {
    unsigned long count;
    if (argc != 4) return 2;
    count = strtoul(argv[2], NULL, 10);
    state = (strtoull(argv[3], NULL, 10) + 1) * 0x9E3779B97F4A7C15u;
    for (sequence = 0; sequence < count; sequence++) {
        Bench b = {0};
        int course = (int)draw(3);
        const char *name = course || !one_in(20) ? "it" : NULL;
        const char *token = course || !one_in(20) ? FMU_TOKEN : "another";
        b.exchange = !strcmp(argv[1], "me");
        b.events = one_in(2);
        alarm(PATIENCE);
        if (b.exchange) b.c = fmi3InstantiateModelExchange(name, token, NULL, false, one_in(2), NULL, logger);
        else
            b.c = fmi3InstantiateCoSimulation(name, token, NULL, false, one_in(2), b.events, b.events, NULL,
                                              course || !one_in(20) ? 0 : 1, NULL, one_in(5) ? NULL : logger,
                                              NULL);
        b.garbage = calloc(1, sizeof(Situation) + 4096);
        if (course) initialize(&b);
        if (course == 1) (b.exchange ? legal_exchange : legal_communication)(&b);
        for (unsigned k = course == 1 ? LONGEST : draw(LONGEST); k < LONGEST; k++) counts[any_call(&b)]++;
        if (b.c && b.saved) fmi3FreeFMUState(b.c, &b.saved);
        free(b.bytes);
        free(b.garbage);
        fmi3FreeInstance(b.c);
    }
    return tell(counts, 0);
}

/* Random call sequences on an FMI 2.0 FMU: fuzz2 me|cs COUNT SEED. It exits with 0 if all went well. */
#include <stdarg.h>

#include "fmi2Functions.h"
#include "fuzz.h"

static long allocated;
static unsigned long counts[7], sequence;

static void *allocate(size_t n, size_t size) {
    allocated++;
    return calloc(n, size);
}

static void release(void *memory) {
    allocated -= memory != NULL;
    free(memory);
}

static void logger(fmi2ComponentEnvironment e, fmi2String name, fmi2Status status, fmi2String category,
                   fmi2String message, ...) {
    char text[2000];
    va_list arguments;
    (void)e, (void)name, (void)status, (void)category;
    va_start(arguments, message);
    vsnprintf(text, sizeof text, message, arguments);
    va_end(arguments);
}

typedef struct {
    fmi2Component c;
    fmi2FMUstate saved;
    char *bytes, *garbage;
    size_t size;
    double t;
} Bench;

static void initialize(Bench *b) {
    must(fmi2SetupExperiment(b->c, fmi2False, 0, 0, fmi2False, 0) == fmi2OK, "fmi2SetupExperiment", sequence);
    must(fmi2EnterInitializationMode(b->c) == fmi2OK, "fmi2EnterInitializationMode", sequence);
    must(fmi2ExitInitializationMode(b->c) == fmi2OK, "fmi2ExitInitializationMode", sequence);
    b->t = 0;
}

static void set_inputs(Bench *b) {
    for (fmi2ValueReference ref = REF_INPUTS; ref < REF_PARAMETERS; ref++) {
        double value = 5 * tame();
        must(fmi2SetReal(b->c, &ref, 1, &value) == fmi2OK, "fmi2SetReal", sequence);
    }
}

static void legal_exchange(Bench *b) {
    double x[ROOMY], rates[ROOMY], g[ROOMY];
    fmi2Boolean due, end;
    fmi2EventInfo info;
    must(fmi2NewDiscreteStates(b->c, &info) == fmi2OK, "fmi2NewDiscreteStates", sequence);
    must(fmi2EnterContinuousTimeMode(b->c) == fmi2OK, "fmi2EnterContinuousTimeMode", sequence);
    for (int k = 0; k < LONGEST; k++) {
        double h = 1e-4 * (1 + draw(10));
        must(fmi2GetContinuousStates(b->c, x, NX) == fmi2OK, "fmi2GetContinuousStates", sequence);
        must(fmi2GetDerivatives(b->c, rates, NX) <= fmi2Discard, "fmi2GetDerivatives", sequence);
        for (int i = 0; i < NX; i++) x[i] += h * rates[i];
        must(fmi2SetTime(b->c, b->t += h) == fmi2OK, "fmi2SetTime", sequence);
        must(fmi2SetContinuousStates(b->c, x, NX) == fmi2OK, "fmi2SetContinuousStates", sequence);
        set_inputs(b);
        must(fmi2GetEventIndicators(b->c, g, NG) <= fmi2Discard, "fmi2GetEventIndicators", sequence);
        must(fmi2CompletedIntegratorStep(b->c, fmi2True, &due, &end) <= fmi2Discard,
             "fmi2CompletedIntegratorStep", sequence);
        if (!due && !one_in(5)) continue;
        must(fmi2EnterEventMode(b->c) == fmi2OK, "fmi2EnterEventMode", sequence);
        if (fmi2NewDiscreteStates(b->c, &info) != fmi2OK) return;
        must(fmi2EnterContinuousTimeMode(b->c) == fmi2OK, "fmi2EnterContinuousTimeMode", sequence);
    }
}

static void legal_communication(Bench *b) {
    for (int k = 0; k < LONGEST; k++) {
        double h = 1e-3 * (1 + draw(20)), back = b->t;
        fmi2FMUstate here = NULL;
        set_inputs(b);
        must(fmi2GetFMUstate(b->c, &here) == fmi2OK, "fmi2GetFMUstate", sequence);
        if (fmi2DoStep(b->c, b->t, h, fmi2False) == fmi2OK) b->t += h;
        if (one_in(4)) {
            must(fmi2SetFMUstate(b->c, here) == fmi2OK, "fmi2SetFMUstate", sequence);
            b->t = back;
        }
        must(fmi2FreeFMUstate(b->c, &here) == fmi2OK, "fmi2FreeFMUstate", sequence);
    }
}

static fmi2Status serialized(Bench *b) {
    fmi2Status status = fmi2SerializedFMUstateSize(b->c, b->saved, &b->size);
    if (status != fmi2OK) return status;
    free(b->bytes);
    b->bytes = malloc(b->size);
    status = fmi2SerializeFMUstate(b->c, b->saved, b->bytes, one_in(5) ? b->size / 2 : b->size);
    if (one_in(3)) b->bytes[draw((unsigned)b->size)] ^= 1;
    return status;
}

static fmi2Status step(Bench *b) {
    fmi2Real reached;
    fmi2Status status = fmi2DoStep(b->c, one_in(6) ? number() : b->t, step_size(), fmi2True);
    if (fmi2GetRealStatus(b->c, fmi2LastSuccessfulTime, &reached) == fmi2OK) b->t = reached;
    return status;
}

static fmi2Status any_call(Bench *b) {
    fmi2ValueReference refs[FEW], knowns[FEW];
    double v[ROOMY], w[ROOMY];
    fmi2Integer whole[FEW], orders[FEW];
    fmi2String texts[FEW] = {0};
    fmi2Boolean yes[FEW];
    fmi2EventInfo info;
    fmi2Real real;
    fmi2Status told;
    fmi2Component c = b->c;
    size_t n = draw(FEW + 1), nx = one_in(5) ? n : NX, ng = one_in(5) ? n : NG;
    double *some = one_in(9) ? NULL : v;
    references(refs, FEW);
    references(knowns, FEW);
    numbers(v, ROOMY);
    for (int i = 0; i < FEW; i++) whole[i] = (fmi2Integer)draw(5), orders[i] = (fmi2Integer)draw(3);
    switch (draw(44)) {
    case 0: return fmi2SetupExperiment(c, one_in(2), number(), number(), one_in(2), number());
    case 1: return fmi2EnterInitializationMode(c);
    case 2: return fmi2ExitInitializationMode(c);
    case 3: return one_in(4) ? fmi2Terminate(c) : fmi2OK;
    case 4: b->t = 0; return one_in(4) ? fmi2Reset(c) : fmi2OK;
    case 5: return fmi2GetReal(c, refs, n, v);
    case 6: return fmi2GetReal(c, one_in(2) ? NULL : refs, n, some);
    case 7: return fmi2SetReal(c, refs, n, some);
    case 8: return fmi2GetInteger(c, refs, n, whole);
    case 9: return fmi2SetInteger(c, refs, n, whole);
    case 10: return fmi2GetBoolean(c, refs, n, yes);
    case 11: return fmi2SetBoolean(c, refs, n, whole);
    case 12: return fmi2GetString(c, refs, n, texts);
    case 13: return fmi2SetString(c, refs, n, texts);
    case 14: return fmi2GetFMUstate(c, &b->saved);
    case 15: return fmi2SetFMUstate(c, b->saved);
    case 16: return fmi2SetFMUstate(c, one_in(2) ? b->garbage : NULL);
    case 17: return fmi2FreeFMUstate(c, &b->saved);
    case 18: return serialized(b);
    case 19: return b->bytes ? fmi2DeSerializeFMUstate(c, b->bytes, b->size - one_in(5), &b->saved) : fmi2OK;
    case 20: return fmi2GetDirectionalDerivative(c, refs, n, knowns, draw(FEW), some, w);
    case 21: return fmi2EnterEventMode(c);
    case 22: return fmi2NewDiscreteStates(c, one_in(20) ? NULL : &info);
    case 23: return fmi2EnterContinuousTimeMode(c);
    case 24: return fmi2CompletedIntegratorStep(c, fmi2True, one_in(20) ? NULL : yes, yes + 1);
    case 25: return fmi2SetTime(c, number());
    case 26: return fmi2SetContinuousStates(c, some, nx);
    case 27: return fmi2GetDerivatives(c, some, nx);
    case 28: return fmi2GetEventIndicators(c, some, ng);
    case 29: return fmi2GetContinuousStates(c, some, nx);
    case 30: return fmi2GetNominalsOfContinuousStates(c, some, nx);
    case 31: return fmi2SetRealInputDerivatives(c, refs, n, orders, some);
    case 32: return fmi2GetRealOutputDerivatives(c, refs, n, orders, some);
    case 33: return fmi2CancelStep(c);
    case 34: return fmi2GetStatus(c, (fmi2StatusKind)draw(5), &told);
    case 35: return fmi2GetRealStatus(c, (fmi2StatusKind)draw(5), &real);
    case 36: return fmi2GetIntegerStatus(c, (fmi2StatusKind)draw(5), whole);
    case 37: return fmi2GetBooleanStatus(c, (fmi2StatusKind)draw(5), yes);
    case 38: return fmi2GetStringStatus(c, (fmi2StatusKind)draw(5), texts);
    case 39: return fmi2SetDebugLogging(c, one_in(2), n, NULL);
    default: return step(b);
    }
}

int main(int argc, char **argv) {
    static const fmi2CallbackFunctions counted = {logger, allocate, release, NULL, NULL};
    static const fmi2CallbackFunctions bare = {NULL, NULL, NULL, NULL, NULL};
    fmi2Type type;
    unsigned long count;
    if (argc != 4) return 2;
    type = strcmp(argv[1], "me") ? fmi2CoSimulation : fmi2ModelExchange;
    count = strtoul(argv[2], NULL, 10);
    state = (strtoull(argv[3], NULL, 10) + 1) * 0x9E3779B97F4A7C15u;
    for (sequence = 0; sequence < count; sequence++) {
        Bench b = {0};
        int course = (int)draw(3);
        alarm(PATIENCE);
        if (course) b.c = fmi2Instantiate("it", type, FMU_TOKEN, "", &counted, fmi2False, one_in(2));
        else
            b.c = fmi2Instantiate(one_in(20) ? NULL : "it", one_in(20) ? (fmi2Type)7 : type,
                                  one_in(20) ? "another" : FMU_TOKEN, NULL, one_in(5) ? &bare : &counted,
                                  fmi2True, fmi2True);
        b.garbage = calloc(1, sizeof(Situation) + 4096);
        if (course) initialize(&b);
        if (course == 1) (type == fmi2ModelExchange ? legal_exchange : legal_communication)(&b);
        for (unsigned k = course == 1 ? LONGEST : draw(LONGEST); k < LONGEST; k++) counts[any_call(&b)]++;
        if (b.c && b.saved) fmi2FreeFMUstate(b.c, &b.saved);
        free(b.bytes);
        free(b.garbage);
        fmi2FreeInstance(b.c);
    }
    return tell(counts, allocated);
}

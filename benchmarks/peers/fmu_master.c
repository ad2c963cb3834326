/* A master of FMI 2.0 FMUs that costs next to nothing itself: Co-Simulation in equal steps, Model Exchange by
 * CVODE.
 *
 * fmu_master cs|me LIBRARY GUID RESOURCES STOP INTERVALS TOLERANCE RUNS STATES INDICATORS STEPS_TOLD FILE
 * REFERENCE ...
 *
 * Runs an FMU from 0 to STOP with INTERVALS outputs of the references, RUNS times from instantiation to the
 * end. Prints the median wall and CPU time of a run and the steps of the last one, and writes its outputs to
 * FILE
 * ("-" for none). STEPS_TOLD is 1 where the FMU wants to be told of completed steps. */
#define _POSIX_C_SOURCE 200809L
#include <cvode/cvode.h>
#include <dlfcn.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <time.h>

#include "fmi2FunctionTypes.h"

#define MOST_OUTPUTS 64
#define ATOL_SHARE 1e-2 /* of the tolerance, times the nominal value of a state */

static struct {
    fmi2InstantiateTYPE *instantiate;
    fmi2FreeInstanceTYPE *free;
    fmi2SetupExperimentTYPE *setup;
    fmi2EnterInitializationModeTYPE *enter_initialization;
    fmi2ExitInitializationModeTYPE *exit_initialization;
    fmi2TerminateTYPE *terminate;
    fmi2GetRealTYPE *get_real;
    fmi2DoStepTYPE *do_step;
    fmi2SetTimeTYPE *set_time;
    fmi2SetContinuousStatesTYPE *set_states;
    fmi2GetContinuousStatesTYPE *get_states;
    fmi2GetDerivativesTYPE *get_rates;
    fmi2GetEventIndicatorsTYPE *get_indicators;
    fmi2GetNominalsOfContinuousStatesTYPE *get_nominals;
    fmi2EnterEventModeTYPE *enter_event;
    fmi2EnterContinuousTimeModeTYPE *enter_continuous;
    fmi2NewDiscreteStatesTYPE *new_discrete;
    fmi2CompletedIntegratorStepTYPE *completed;
} fmu;

static const char *guid, *resources;
static double stop, tolerance;
static int intervals, states, indicators, steps_told, references;
static fmi2ValueReference reference[MOST_OUTPUTS];
static double *rows; /* time and outputs, one after the other */
static long steps;

static void give_up(const char *what) {
    fprintf(stderr, "%s failed\n", what);
    exit(1);
}

#define DO(call) \
    if ((call) > fmi2Warning) give_up(#call)
#define CV(call) \
    if ((call) < 0) give_up(#call)

static void tell(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status,
                 fmi2String category, fmi2String message, ...) {
    (void)environment, (void)category;
    if (status <= fmi2Warning) return;
    va_list given;
    va_start(given, message);
    fprintf(stderr, "%s: ", name);
    vfprintf(stderr, message, given);
    fputc('\n', stderr);
    va_end(given);
}

static void *found(void *library, const char *name) {
    void *symbol = dlsym(library, name);
    if (!symbol) give_up(name);
    return symbol;
}

static void load(const char *path, int is_cs) {
    void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!library) give_up(dlerror());
#define FIND(member, name) *(void **)&fmu.member = found(library, name)
    FIND(instantiate, "fmi2Instantiate");
    FIND(free, "fmi2FreeInstance");
    FIND(setup, "fmi2SetupExperiment");
    FIND(enter_initialization, "fmi2EnterInitializationMode");
    FIND(exit_initialization, "fmi2ExitInitializationMode");
    FIND(terminate, "fmi2Terminate");
    FIND(get_real, "fmi2GetReal");
    if (is_cs) {
        FIND(do_step, "fmi2DoStep");
        return;
    }
    FIND(set_time, "fmi2SetTime");
    FIND(set_states, "fmi2SetContinuousStates");
    FIND(get_states, "fmi2GetContinuousStates");
    FIND(get_rates, "fmi2GetDerivatives");
    FIND(get_indicators, "fmi2GetEventIndicators");
    FIND(get_nominals, "fmi2GetNominalsOfContinuousStates");
    FIND(enter_event, "fmi2EnterEventMode");
    FIND(enter_continuous, "fmi2EnterContinuousTimeMode");
    FIND(new_discrete, "fmi2NewDiscreteStates");
    FIND(completed, "fmi2CompletedIntegratorStep");
}

static void record(fmi2Component c, int k) {
    double *row = rows + (size_t)k * (size_t)(1 + references);
    row[0] = stop * k / intervals;
    DO(fmu.get_real(c, reference, (size_t)references, row + 1));
}

static fmi2Component begun(fmi2Type type) {
    static const fmi2CallbackFunctions callbacks = {tell, calloc, free, NULL, NULL};
    fmi2Component c = fmu.instantiate("it", type, guid, resources, &callbacks, fmi2False, fmi2False);
    if (!c) give_up("fmi2Instantiate");
    DO(fmu.setup(c, fmi2True, tolerance, 0, fmi2True, stop));
    DO(fmu.enter_initialization(c));
    DO(fmu.exit_initialization(c));
    return c;
}

static void run_cs(void) {
    fmi2Component c = begun(fmi2CoSimulation);
    record(c, 0);
    for (int k = 0; k < intervals; k++) {
        double t = stop * k / intervals;
        DO(fmu.do_step(c, t, stop * (k + 1) / intervals - t, fmi2True));
        record(c, k + 1);
    }
    DO(fmu.terminate(c));
    fmu.free(c);
    steps = intervals;
}

static void stand(fmi2Component c, double t, N_Vector x) {
    DO(fmu.set_time(c, t));
    DO(fmu.set_states(c, NV_DATA_S(x), (size_t)states));
}

static int rates(double t, N_Vector x, N_Vector found, void *c) {
    if (fmu.set_time(c, t) > fmi2Warning || fmu.set_states(c, NV_DATA_S(x), (size_t)states) > fmi2Warning)
        return 1;
    return fmu.get_rates(c, NV_DATA_S(found), (size_t)states) > fmi2Warning;
}

static int watched(double t, N_Vector x, double g[], void *c) {
    stand(c, t, x);
    return fmu.get_indicators(c, g, (size_t)indicators) > fmi2Warning;
}

/* Let events happen until none is left; return when time itself brings the next one. */
static double settle(fmi2Component c, N_Vector x) {
    fmi2EventInfo info = {.newDiscreteStatesNeeded = fmi2True};
    while (info.newDiscreteStatesNeeded) DO(fmu.new_discrete(c, &info));
    DO(fmu.enter_continuous(c));
    DO(fmu.get_states(c, NV_DATA_S(x), (size_t)states));
    return info.nextEventTimeDefined ? info.nextEventTime : INFINITY;
}

static void run_me(void) {
    SUNContext context;
    double t = 0;
    int next = 1;
    CV(SUNContext_Create(NULL, &context));
    fmi2Component c = begun(fmi2ModelExchange);
    N_Vector x = N_VNew_Serial(states, context), between = N_VClone(x), atol = N_VClone(x);
    double due = settle(c, x);
    record(c, 0);
    DO(fmu.get_nominals(c, NV_DATA_S(atol), (size_t)states));
    N_VScale(ATOL_SHARE * tolerance, atol, atol);
    void *cvode = CVodeCreate(CV_BDF, context);
    SUNMatrix matrix = SUNDenseMatrix(states, states, context);
    SUNLinearSolver solver = SUNLinSol_Dense(x, matrix, context);
    CV(CVodeInit(cvode, rates, 0, x));
    CV(CVodeSVtolerances(cvode, tolerance, atol));
    CV(CVodeSetUserData(cvode, c));
    CV(CVodeSetLinearSolver(cvode, solver, matrix));
    CV(CVodeRootInit(cvode, indicators, watched));
    CV(CVodeSetMaxNumSteps(cvode, -1));
    CV(CVodeSetNoInactiveRootWarn(cvode));
    for (steps = 0; next <= intervals; steps++) {
        fmi2Boolean event = fmi2False, end = fmi2False;
        CV(CVodeSetStopTime(cvode, fmin(due, stop)));
        int flag = CVode(cvode, stop, x, &t, CV_ONE_STEP);
        CV(flag);
        for (; next <= intervals && stop * next / intervals <= t; next++) {
            CV(CVodeGetDky(cvode, stop * next / intervals, 0, between));
            stand(c, stop * next / intervals, between);
            record(c, next);
        }
        stand(c, t, x);
        if (steps_told) DO(fmu.completed(c, fmi2True, &event, &end));
        if (next > intervals || !(event || flag == CV_ROOT_RETURN || t >= due)) continue;
        DO(fmu.enter_event(c));
        due = settle(c, x);
        CV(CVodeReInit(cvode, t, x));
    }
    DO(fmu.terminate(c));
    fmu.free(c);
    SUNLinSolFree(solver), SUNMatDestroy(matrix), CVodeFree(&cvode);
    N_VDestroy(x), N_VDestroy(between), N_VDestroy(atol);
    SUNContext_Free(&context);
}

static double now(clockid_t which) {
    struct timespec t;
    clock_gettime(which, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int ascending(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double values[], int n) {
    qsort(values, (size_t)n, sizeof *values, ascending);
    return n % 2 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

int main(int count, char *given[]) {
    if (count < 13 || count - 13 > MOST_OUTPUTS) give_up("reading the arguments, see the source, which");
    int is_cs = !strcmp(given[1], "cs"), runs = atoi(given[8]);
    guid = given[3], resources = given[4], stop = atof(given[5]), intervals = atoi(given[6]);
    tolerance = atof(given[7]), states = atoi(given[9]), indicators = atoi(given[10]);
    steps_told = atoi(given[11]), references = count - 13;
    for (int i = 0; i < references; i++) reference[i] = (fmi2ValueReference)strtoul(given[13 + i], NULL, 10);
    rows = calloc((size_t)(intervals + 1) * (size_t)(1 + references), sizeof *rows);
    double *wall = calloc((size_t)runs, sizeof *wall), *cpu = calloc((size_t)runs, sizeof *cpu);
    load(given[2], is_cs);
    for (int k = 0; k < runs; k++) {
        double began = now(CLOCK_MONOTONIC), spent = now(CLOCK_PROCESS_CPUTIME_ID);
        if (is_cs) run_cs();
        else run_me();
        wall[k] = now(CLOCK_MONOTONIC) - began, cpu[k] = now(CLOCK_PROCESS_CPUTIME_ID) - spent;
    }
    printf("wall %g s, cpu %g s, steps %ld\n", median(wall, runs), median(cpu, runs), steps);
    FILE *file = strcmp(given[12], "-") ? fopen(given[12], "w") : NULL;
    for (int k = 0; k <= intervals && file; k++)
        for (int i = 0; i <= references; i++)
            fprintf(file, "%.17g%c", rows[k * (1 + references) + i], i < references ? ',' : '\n');
    return 0;
}

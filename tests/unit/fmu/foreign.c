/* A tiny FMI 2.0 FMU, for the tests of the import: what it models is chosen by MODEL.
 *
 * 1  body:   s' = v, v' = F/m; faults on demand (parameter `fault`, from time `when` on).
 * 2  ball:   h' = v, v' = -g, bounces with e = 0.8 (state event).
 * 3  clock:  x' = rate; at 0.25, 0.5, ... rate grows by 1 (time event); at 1.0 it asks to end.
 * 4  saw:    x' = 1; asks for an event when a completed step is beyond 0.1, then x = 0 (step event).
 * 5  spring: F = k s + d v, no states.
 * 6  relay:  x' = u > 0 ? 1 : -1 by event mode, y = x (state event of an input).
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "fmi2Functions.h"

#ifndef FAULT
#define FAULT 0 /* what it begins with */
#endif
#ifndef HANG
#define HANG 0 /* which call waits for ever: 1 instantiate, 2, 3 initialise, 4 step, 5 terminate, 6 free */
#endif
#define STAY(where) \
    while (HANG == where) pause();
#define N 8
typedef struct {
    double v[N], t, next;
    int pending;
} M;
/* v: 0, 1 states; 2 input; 3 parameter; 4 output; 5 fault; 6 when; 7 second input */
#define NX (MODEL == 5 ? 0 : MODEL == 1 || MODEL == 2 ? 2 : 1)
#define NZ (MODEL == 2 || MODEL == 6 ? 1 : 0)

static void fault(M *m) {
    volatile int *nowhere = 0;
    if (m->v[5] == 0 || m->t < m->v[6]) return;
    if (m->v[5] == 1) *nowhere = 1;
    if (m->v[5] == 2) abort();
    if (m->v[5] == 3) exit(7);
    if (m->v[5] == 4)
        for (;;) nowhere = 0;
}

static void rates(M *m, double *d) {
    if (MODEL == 1) {
        fault(m);
        d[0] = m->v[1];
        d[1] = m->v[5] == 5 && m->t >= m->v[6] ? NAN : m->v[2] / m->v[3];
    }
    if (MODEL == 2) {
        d[0] = m->v[1];
        d[1] = -9.81;
    }
    if (MODEL == 3 || MODEL == 6) d[0] = m->v[3];
    if (MODEL == 4) d[0] = 1;
}

static void advance(M *m, double h) {
    double a = m->v[2] / m->v[3];
    fault(m);
    if (MODEL != 1) return;
    m->v[0] += h * m->v[1] + h * h * a / 2;
    m->v[1] += h * a;
    if (m->v[5] == 5 && m->t + h >= m->v[6]) m->v[0] = NAN;
}

static void events(M *m, fmi2EventInfo *e) {
    if (MODEL == 2 && m->v[0] <= 0 && m->v[1] < 0) {
        m->v[0] = 0;
        m->v[1] *= -0.8;
        e->valuesOfContinuousStatesChanged = 1;
    }
    if (MODEL == 3) {
        if (m->t >= m->next) {
            m->v[3] += 1;
            m->next += 0.25;
        }
        e->nextEventTimeDefined = 1;
        e->nextEventTime = m->next;
        e->terminateSimulation = m->t >= 1;
    }
    if (MODEL == 4 && m->pending) {
        m->v[0] = 0;
        m->pending = 0;
        e->valuesOfContinuousStatesChanged = 1;
    }
    if (MODEL == 6) m->v[3] = m->v[2] > 0 ? 1 : -1;
}

#define I M *m = c
#define EXPORT FMI2_Export
EXPORT const char *fmi2GetTypesPlatform(void) { return "default"; }
EXPORT const char *fmi2GetVersion(void) { return "2.0"; }
EXPORT fmi2Component fmi2Instantiate(fmi2String n, fmi2Type k, fmi2String g, fmi2String r,
                                     const fmi2CallbackFunctions *f, fmi2Boolean v, fmi2Boolean l) {
    M *m = calloc(1, sizeof(M));
    STAY(1)
    m->v[5] = FAULT;
    m->v[3] = MODEL == 1 ? 2 : MODEL == 5 ? 100 : 1;
    m->v[0] = MODEL == 2;
    m->next = 0.25;
    return m;
}
EXPORT void fmi2FreeInstance(fmi2Component c) { STAY(6) free(c); }
EXPORT fmi2Status fmi2EnterInitializationMode(fmi2Component c) { STAY(2) return fmi2OK; }
EXPORT fmi2Status fmi2ExitInitializationMode(fmi2Component c) { STAY(3) return fmi2OK; }
EXPORT fmi2Status fmi2Terminate(fmi2Component c) { STAY(5) return fmi2OK; }
EXPORT fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean a, fmi2Real b, fmi2Real t, fmi2Boolean d,
                                      fmi2Real e) {
    I;
    m->t = t;
    return fmi2OK;
}
EXPORT fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference *r, size_t n, fmi2Real *y) {
    I;
    size_t i;
    if (MODEL == 5) m->v[4] = m->v[3] * m->v[2] + 3 * m->v[7];
    if (MODEL == 6) m->v[4] = m->v[0];
    for (i = 0; i < n; i++) y[i] = m->v[r[i]];
    return fmi2OK;
}
EXPORT fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference *r, size_t n, const fmi2Real *y) {
    I;
    size_t i;
    for (i = 0; i < n; i++) m->v[r[i]] = y[i];
    return fmi2OK;
}
EXPORT fmi2Status fmi2SetTime(fmi2Component c, fmi2Real t) {
    I;
    m->t = t;
    return fmi2OK;
}
EXPORT fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real *x, size_t n) {
    I;
    memcpy(m->v, x, n * sizeof(double));
    return fmi2OK;
}
EXPORT fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real *x, size_t n) {
    I;
    memcpy(x, m->v, n * sizeof(double));
    return fmi2OK;
}
EXPORT fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real *x, size_t n) {
    while (n--) x[n] = 1;
    return fmi2OK;
}
EXPORT fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real *d, size_t n) {
    I;
    rates(m, d);
    return fmi2OK;
}
EXPORT fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real *z, size_t n) {
    I;
    if (n) z[0] = MODEL == 2 ? m->v[0] : m->v[2];
    return fmi2OK;
}
EXPORT fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *e) {
    I;
    memset(e, 0, sizeof *e);
    events(m, e);
    return fmi2OK;
}
EXPORT fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean n, fmi2Boolean *e,
                                              fmi2Boolean *s) {
    I;
    *e = m->pending = MODEL == 4 && m->v[0] > 0.1;
    *s = 0;
    return fmi2OK;
}
EXPORT fmi2Status fmi2DoStep(fmi2Component c, fmi2Real t, fmi2Real h, fmi2Boolean n) {
    I;
    STAY(4) m->t = t;
    advance(m, h);
    return fmi2OK;
}
EXPORT fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *s) {
    if (!*s) *s = malloc(sizeof(M));
    memcpy(*s, c, sizeof(M));
    return fmi2OK;
}
EXPORT fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate s) {
    memcpy(c, s, sizeof(M));
    return fmi2OK;
}
EXPORT fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *s) {
    free(*s);
    *s = 0;
    return fmi2OK;
}
#define OK(name, ...) \
    EXPORT fmi2Status fmi2##name(fmi2Component c, ##__VA_ARGS__) { return fmi2OK; }
OK(SetDebugLogging, fmi2Boolean l, size_t n, const fmi2String s[])
OK(EnterEventMode)
OK(EnterContinuousTimeMode)
OK(Reset)
#define REFUSED(name, ...) \
    EXPORT fmi2Status fmi2##name(fmi2Component c, ##__VA_ARGS__) { return fmi2Error; }
typedef const fmi2ValueReference *VR;
REFUSED(GetInteger, VR r, size_t n, fmi2Integer y[])
REFUSED(GetBoolean, VR r, size_t n, fmi2Boolean y[])
REFUSED(GetString, VR r, size_t n, fmi2String y[])
REFUSED(SetInteger, VR r, size_t n, const fmi2Integer y[])
REFUSED(SetBoolean, VR r, size_t n, const fmi2Boolean y[])
REFUSED(SetString, VR r, size_t n, const fmi2String y[])
REFUSED(SerializedFMUstateSize, fmi2FMUstate s, size_t *n)
REFUSED(SerializeFMUstate, fmi2FMUstate s, fmi2Byte b[], size_t n)
REFUSED(DeSerializeFMUstate, const fmi2Byte b[], size_t n, fmi2FMUstate *s)
REFUSED(GetDirectionalDerivative, VR u, size_t nu, VR k, size_t nk, const fmi2Real a[], fmi2Real b[])
REFUSED(SetRealInputDerivatives, VR r, size_t n, const fmi2Integer o[], const fmi2Real y[])
REFUSED(GetRealOutputDerivatives, VR r, size_t n, const fmi2Integer o[], fmi2Real y[])
REFUSED(CancelStep)
REFUSED(GetStatus, const fmi2StatusKind k, fmi2Status *y)
REFUSED(GetRealStatus, const fmi2StatusKind k, fmi2Real *y)
REFUSED(GetIntegerStatus, const fmi2StatusKind k, fmi2Integer *y)
REFUSED(GetBooleanStatus, const fmi2StatusKind k, fmi2Boolean *y)
#ifndef INCOMPLETE
REFUSED(GetStringStatus, const fmi2StatusKind k, fmi2String *y)
#endif

/* What FMI 2 and FMI 3 share: one instance, its numbers by reference, what refuses a call. */
#ifndef INERTANCE_FMI_COMMON_H
#define INERTANCE_FMI_COMMON_H

#include "fmu_model.h" /* generated: the face, FMU_TOKEN, FMU_TOLERANCE, FMU_FIXED_STEP, FMU_AIMS, ... */
#include "start.h"

#ifdef __GNUC__ /* the standard says which parameters there are */
#pragma GCC diagnostic ignored "-Wunused-parameter"
#endif

/* Value references, the same in both standards: one range for each kind of number. */
#define REF_TIME 0
#define REF_STATES 1
#define REF_RATES (REF_STATES + NX)
#define REF_INPUTS (REF_RATES + NX)
#define REF_PARAMETERS (REF_INPUTS + NU)
#define REF_VARIABLES (REF_PARAMETERS + NP)
#define REF_MODES (REF_VARIABLES + NW)
#define REF_INDICATORS (REF_MODES + NM)
#define REF_END (REF_INDICATORS + NG)

typedef FMI(Status) Status;

typedef enum {
    INSTANTIATED = 1,
    INITIALIZATION = 2,
    EVENT_MODE = 4,
    CONTINUOUS_TIME = 8,
    STEP_MODE = 16,
    STEP_FAILED = 32,
    TERMINATED = 64,
    FAILED = 128,
    INTERMEDIATE = 256
} Phase;

/* Types of variables; modes are enumerations. */
typedef enum { REAL, BOOLEAN, INTEGER, ENUMERATION } Type;

#define RUNNING (EVENT_MODE | CONTINUOUS_TIME | STEP_MODE)
#define SETTABLE (INSTANTIATED | INITIALIZATION | RUNNING)
#define READABLE (INITIALIZATION | RUNNING | STEP_FAILED | TERMINATED | FAILED | INTERMEDIATE)
#define ANY_PHASE (INSTANTIATED | (READABLE & ~INTERMEDIATE))

typedef enum { MODEL_EXCHANGE = 1, CO_SIMULATION = 2, EITHER = 3 } Kind;

/* All that a saved state keeps; numbers only. */
typedef struct {
    Core core;
    Given given;
    int begun; /* whether the core stands where what is given leads */
    int phase;
    double tolerance;
    double start;
    double stop; /* infinite if not defined */
    char moved[ROOM(NU)], told[ROOM(NU)]; /* inputs that changed after the start; that were ever not zero */
} Situation;

typedef struct {
    Situation now;
    Kind kind;
    int event_mode_used;
    int may_return_early;
    Host host;
    const char *function; /* that was called last */
    StartRoom room;
    double x[ROOM(NX)], u[ROOM(NU)], p[ROOM(NP)], rates[ROOM(NX)], w[ROOM(NW)]; /* seeds and sensitivities */
} Instance;

/* How a function of the standard begins: in which phases, and of which kinds of instances, it may be called.
 */
#define ENTER(phases, kinds) \
    Instance *c = instance;  \
    if (!face_may(c, __func__, (phases), (kinds))) return FMI(Error)

/* Whether a call is legal now; logs if not. */
int face_may(Instance *c, const char *function, int phases, int kinds);

void face_start(Instance *c, Kind kind);

/* Pass a message on to the host. */
void face_log(const Instance *c, Status status, const char *category, const char *message);

/* Log why a call is refused and return an error; the instance stays as it was. */
Status face_refuse(Instance *c, const char *why);

/* The same, if the core did not accept a number, which changes nothing. */
Status face_accepted(Instance *c, CoreStatus status);

Status face_bad_reference(Instance *c, uint32_t ref);
Status face_no_such(Instance *c, size_t n);

/* Whether arrays that should hold something are absent; logs if so. */
int face_missing(Instance *c, size_t n, const void *refs, const void *values);

/* Log what the core has to say; after an error nothing but reading, restoring and resetting is left. */
Status face_outcome(Instance *c, CoreStatus status);

/* Whether numbers can be told now: before a run, start values are found first; logs if not. */
int face_ready(Instance *c);

/* Refuse an input that moves while its derivative, which the equations hold, was never anything but zero. */
Status face_untold_rate(Instance *c);

Status face_get_reals(Instance *c, const uint32_t refs[], size_t n, double values[]);
Status face_set_reals(Instance *c, const uint32_t refs[], size_t n, const double values[]);

/* What type a variable has; time and indicators are real. */
Type face_type(uint32_t ref);

/* A number, a truth value (0 or 1), a whole number or a mode, if the reference is one of that type. */
Status face_get(Instance *c, Type type, uint32_t ref, double *value);
Status face_set(Instance *c, Type type, uint32_t ref, double value);

/* Sensitivities of unknowns to knowns in the direction of a seed, or, adjoint, of their sum weighted by it.
 */
Status face_sensitivities(Instance *c, int adjoint, const uint32_t from[], size_t n, const double seed[],
                          const uint32_t to[], size_t m, double sensitivity[]);

/* Rates of states, rates and other variables, as time goes on and inputs with it. */
Status face_output_derivatives(Instance *c, const uint32_t refs[], const int32_t orders[], size_t n,
                               double values[]);

/* Whom to tell of each step of the integrator within a step of communication, or NULL. */
const Observer *face_observer(Instance *c, Observer *room);

Status face_experiment(Instance *c, int tolerance_defined, double tolerance, double start, int stop_defined,
                       double stop);
Status face_settle(Instance *c, int *states_changed);
Status face_step(Instance *c, double point, double size, CoreStop *reached);

#endif

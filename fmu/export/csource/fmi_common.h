/* What the FMI 2 and the FMI 3 face share: one instance, its numbers by reference, its saved states. */
#ifndef INERTANCE_FMI_COMMON_H
#define INERTANCE_FMI_COMMON_H

#include <stddef.h>
#include <stdint.h>

#include "core.h"
#include "core_state.h"
#include "fmu_model.h" /* generated: FMU_TOKEN, FMU_TOLERANCE, FMU_FIXED_STEP, FMU_AIMS, FMU_INPUTS */
#include "start.h"

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

/* Numbered as in both standards. */
typedef enum { FACE_OK, FACE_WARNING, FACE_DISCARD, FACE_ERROR } FaceStatus;

typedef enum {
    INSTANTIATED = 1,
    INITIALIZATION = 2,
    EVENT_MODE = 4,
    CONTINUOUS_TIME = 8,
    STEP_MODE = 16,
    STEP_FAILED = 32,
    TERMINATED = 64,
    FAILED = 128
} Phase;

#define RUNNING (EVENT_MODE | CONTINUOUS_TIME | STEP_MODE)
#define READABLE (INITIALIZATION | RUNNING | STEP_FAILED | TERMINATED | FAILED)
#define ANY_PHASE (INSTANTIATED | READABLE)

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

typedef struct Instance Instance;
typedef void (*Logger)(Instance *c, FaceStatus status, const char *message);

/* Callbacks and name belong to the face, which puts this first in a struct of its own. */
struct Instance {
    Situation now;
    Kind kind;
    int event_mode_used;
    int may_return_early;
    Logger log;
    StartRoom room;
    double x[ROOM(NX)], u[ROOM(NU)], p[ROOM(NP)], rates[ROOM(NX)], w[ROOM(NW)]; /* seeds and sensitivities */
};

typedef struct Saved Saved;

void face_start(Instance *c, Kind kind, Logger log);
void face_reset(Instance *c);

/* Log why a call is refused and return FACE_ERROR; the instance stays as it was. */
FaceStatus face_refuse(Instance *c, const char *function, const char *why);

/* Log why the core did not accept a number, which changes nothing. */
FaceStatus face_refuse_number(Instance *c, const char *function);

FaceStatus face_bad_reference(Instance *c, const char *function, uint32_t ref);

/* Whether arrays that should hold something are absent. */
int face_missing(size_t n, const void *refs, const void *values);

/* Whether a call is legal now; logs if not. */
int face_may(Instance *c, const char *function, int phases, int kinds);

/* Log what the core has to say; after an error nothing but reading, restoring and resetting is left. */
FaceStatus face_outcome(Instance *c, const char *function, CoreStatus status);

FaceStatus face_get_reals(Instance *c, const char *function, const uint32_t refs[], size_t n,
                          double values[]);
FaceStatus face_set_reals(Instance *c, const char *function, const uint32_t refs[], size_t n,
                          const double values[]);
FaceStatus face_get_mode(Instance *c, const char *function, uint32_t ref, int *value);
FaceStatus face_no_such(Instance *c, const char *function, size_t n);

FaceStatus face_forward(Instance *c, const char *function, const uint32_t unknowns[], size_t nu,
                        const uint32_t knowns[], size_t nk, const double seed[], double sensitivity[]);
FaceStatus face_adjoint(Instance *c, const char *function, const uint32_t unknowns[], size_t nu,
                        const uint32_t knowns[], size_t nk, const double seed[], double sensitivity[]);

FaceStatus face_set_slopes(Instance *c, const char *function, const uint32_t refs[], size_t n,
                           const double slopes[]);
FaceStatus face_set_time(Instance *c, const char *function, double time);
FaceStatus face_set_states(Instance *c, const char *function, const double x[], size_t n);
FaceStatus face_get_states(Instance *c, const char *function, double x[], size_t n);
FaceStatus face_get_nominals(Instance *c, const char *function, double x[], size_t n);
FaceStatus face_get_rates(Instance *c, const char *function, double rates[], size_t n);
FaceStatus face_get_indicators(Instance *c, const char *function, double g[], size_t n);

FaceStatus face_experiment(Instance *c, const char *function, int tolerance_defined, double tolerance,
                           double start, int stop_defined, double stop);

/* Refuse an input that moves while its derivative, which the equations hold, was never anything but zero. */
FaceStatus face_untold_rate(Instance *c, const char *function);

/* Whether numbers can be told now: before a run, start values are found first. */
FaceStatus face_ready(Instance *c, const char *function);
FaceStatus face_initialize(Instance *c, const char *function);
FaceStatus face_settle(Instance *c, const char *function, int *states_changed);
FaceStatus face_due(Instance *c, const char *function, int *due);
FaceStatus face_step(Instance *c, const char *function, double point, double size, CoreStop *reached);

FaceStatus face_save(Instance *c, const char *function, Saved **state);
FaceStatus face_restore(Instance *c, const char *function, const Saved *state);
FaceStatus face_forget(Instance *c, const char *function, Saved **state);
FaceStatus face_saved_size(Instance *c, const char *function, const Saved *state, size_t *size);
FaceStatus face_serialize(Instance *c, const char *function, const Saved *state, void *bytes, size_t size);
FaceStatus face_deserialize(Instance *c, const char *function, const void *bytes, size_t size, Saved **state);

#endif

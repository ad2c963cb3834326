/* What a Core holds, and what its parts offer each other. */
#ifndef INERTANCE_CORE_STATE_H
#define INERTANCE_CORE_STATE_H

#include <stdint.h>

#include "constants.h" /* generated from networks/simulation/events/constants.py */
#include "core.h"
#include "rodas5p.h"

#define NY (NX + NZ)
#define NPATH (NX + NPUSH) /* states and impulses, which a jump moves */
#ifdef CORE_SHARED /* by models of a size class: sizes are variables, and model.h tells the most of each */
#define ROOM(n) MOST_##n
#define MOST_NY (MOST_NX + MOST_NZ)
#define MOST_NPATH (MOST_NX + MOST_NPUSH)
#else
#define ROOM(n) ((n) > 0 ? (n) : 1) /* C knows no empty arrays */
#endif
#define MESSAGE 1024
#define FADING 0.99 /* of the size of an algebraic unknown from step to step */

/* As fmax and fmin, whose calls cost more than they do; a number that is none must come second. */
static inline double core_larger(double a, double b) { return a > b ? a : b; }
static inline double core_smaller(double a, double b) { return a < b ? a : b; }

#ifdef __GNUC__
#define SAYS(place) __attribute__((format(printf, place, place + 1)))
#else
#define SAYS(place)
#endif

/* Factors of a matrix of the unknowns that are kept: LU with pivoting, or sparse QR. */
typedef struct {
#if MODEL_SPARSE
    double v[ROOM(NV)], r[ROOM(NR)];
#else
    double lu[ROOM(NF) * ROOM(NF)];
    int pivot[ROOM(NF)];
#endif
} Factor;

/* One step of the integrator, from `t` over `h`, and its dense output. */
typedef struct {
    double t, h;
    double begin[ROOM(NY)], end[ROOM(NY)];
    double bend[3][ROOM(NY)]; /* of the interpolation, once it is asked for */
    int bent;
} Step;

/* Indicators, and how fast they rise. */
typedef struct {
    double value[ROOM(NG)], rate[ROOM(NG)];
} Watched;

/* Where an indicator rises through zero, in the piece from `begin` to `end`. */
typedef struct {
    double t, begin, end;
    int indicator;
} Crossing;

/* A function of (x, z, u, q, t), of further arguments from place 5 on; and where its results go. */
typedef int (*ModelFunction)(const double **arg, double **res, int *iw, double *w, int mem);
typedef struct {
    const double *arg[ROOM(MODEL_ARGS)];
    double *res[ROOM(MODEL_RESULTS)];
} Call;

/* Modes, impulses and completion, kept while others hold. */
typedef struct {
    double modes[ROOM(NM) + ROOM(NI) + ROOM(NK)];
} Kept;

struct Core {
    double t;
    double y[ROOM(NY)]; /* states, then algebraic unknowns */
    double free[ROOM(NU)], free_since; /* free inputs as they were at the instant free_since */
    double drift[ROOM(NU)]; /* slopes of the highest derivatives among them, over the next advance */
    double q[ROOM(NQ)]; /* parameters, modes, impulses, completion */
    double u[ROOM(NA)], u_rate[ROOM(NA)], u_time; /* all inputs at the instant u_time */

#ifdef CORE_RECORDS /* in this process only: such a core cannot be kept beyond its records */
    struct Record *records[ROOM(NU)];
    struct Legs *legs;
#endif
    long long leg; /* on which the core stands */

    int fresh; /* which of the following is up to date */
    double rates[ROOM(NY)], variables[ROOM(NW)], indicators[ROOM(NG)];

    double seen[ROOM(NG)], fastest[ROOM(NG)]; /* sizes of indicators and of their rates */
    double largest[ROOM(NZ)]; /* lately, of algebraic unknowns: their errors count against that */
    double raised[ROOM(NG)]; /* where indicators stood after the last events, if they were falling */
    int muted[ROOM(NG)]; /* risen above zero, but not allowed to fire */
    int open[ROOM(NG)], open_count; /* those that can fire in the present modes, muted or not */
    int adrift, shared[ROOM(NB)]; /* blocks (adrift: one more than its number) that modes leave singular */
    int pending; /* one more than the indicator on whose crossing the core stands */

    double h, last_error, last_h; /* next step size; of the last accepted step */
    double reach;     /* up to where steps may lead beyond the instant at which they are asked to stop */
    int ahead, calm;  /* whether the core stands inside its last step; advances since anything was set */
    double ahead_end; /* where that step ends */
    int corners;     /* of data, still to be landed on */
    double interval; /* what time is long or short against: step of communication or of output */
    int crowd;       /* events in an interval that are more than can be meant */
    double recent[CHATTER_COUNT], mark;
    int mark_count;
    long long landings, notes,
        noted[ROOM(NG)]; /* when each transition fired last, in the order in which all did */
    long long steps, rejected, work; /* work: how often anything of the model was evaluated */
    int slope_fresh, worst; /* unknown with the greatest error in the last step */
    int limits[ROOM(NY)]; /* steps that each unknown limited */

    char message[MESSAGE];

    /* Scratch: nothing here outlives a call, except as `slope_fresh` and `ahead` say. */
    double slope[ROOM(NSLOPE)], by_time[ROOM(NY)];
    int still[ROOM(NY)], still_count;
    double stage[STAGES][ROOM(NY)], trial[ROOM(NY)], value[ROOM(NY)], full[ROOM(NROWS) + ROOM(NY)];
    Factor factor, algebra;
    Step step;
    Watched left, middle, right, last;
    double end_rates[ROOM(NY)], trial_free[ROOM(NU)];
    double expressions[ROOM(NE)];
    double blocks[ROOM(NK)], square[3][ROOM(BLOCK) * ROOM(BLOCK)];
    double response[ROOM(NRESPONSE)], velocity[ROOM(NVELOCITY)];
    double others[ROOM(NO)], other[ROOM(NOTHER)];
    double struck[ROOM(NS) * (ROOM(NX) + 3 * ROOM(NS))];
    double moved[ROOM(NO) * (ROOM(NX) + ROOM(NO))];
    double w[ROOM(MODEL_WORK)];
    int iw[ROOM(MODEL_INTEGERS)];
    double results[ROOM(NY) + ROOM(NW)], seeds[ROOM(NY) + ROOM(NW)];
    double of_y[ROOM(NY) + 1], of_u[ROOM(NA)], of_p[ROOM(NP)];
};

/* Parts of a run between instants at which what is given switches: where they begin and end, the longest step
 * that steps over nothing, and whether a signal jumps where they begin. */
typedef struct Legs {
    long long count;
    const double *begin, *end, *longest;
    const int *jumps;
} Legs;

/* Told of what happens on the way. Any function may be absent. */
typedef struct {
    void *context;
    /* A change of mode, or a shock; `stays` for a contact that passes a shock on; from NG on, a
     * motion that jumps, and NG + NPUSH for what none feels. */
    void (*fired)(void *context, const Core *c, int change, int stays, double impulse);
    /* A step was taken, of which [c->step.t, until] counts. Nonzero asks to stop there. */
    int (*stepped)(void *context, Core *c, double until);
    /* The core has landed on an event; called before and after it is fired. */
    void (*landed)(void *context, Core *c, int after, int switched);
} Observer;

/* On the way to `stop`, and the step that is to be tried next, of length `h`, zero if none is. */
typedef struct {
    double stop, reach, rtol, atol, fixed; /* steps may lead beyond `stop`, up to `reach` */
    int early;
    const Observer *told;
    double most; /* length of the next step, while an indicator rests on zero */
    int halt;    /* ends the advance */
    CoreStop reached;
    long long begin, before; /* steps and work when it began, at the instant `from` */
    double from;
    double h, tried, kept,
        bound; /* at most up to `bound`; `tried` first, when the core held h to be `kept` */
} Travel;

#ifdef CORE_RECORDS
/* Free input from data: a polynomial between instants, highest power first, (4, count - 1). */
typedef struct Record {
    const double *times, *powers;
    long long count, found;
} Record;

/* record.c */
void core_record_at(Record *r, double t, double *value, double *rate);
double core_corner_after(const Core *c, double t, double *length);
#endif

/* legs.c */
void core_find_leg(Core *c);
int core_at_end_of_leg(const Core *c);
int core_jumps_next(const Core *c);
double core_end_of_leg(const Core *c);
double core_longest_step(const Core *c);
CoreStatus core_next_leg(Core *c, const Observer *told, int *changed);
CoreStatus core_enter_legs(Core *c, int *changed);
int core_next_time(Core *c, double *time);

/* core.c */
enum { FRESH_ALGEBRA = 1, FRESH_RATES = 2, FRESH_VARIABLES = 4, FRESH_INDICATORS = 8, FRESH_LEFT = 16 };
void core_stale(Core *c);
int core_knows_inputs(Core *c, double t);
double core_free_at(const Core *c, int i, double t);
int core_motion_at(Core *c, double t, const double y[], double rates[]);
void core_slope_at(Core *c, double t, const double y[]);
void core_evaluate(Core *c, ModelFunction function, double t, const double y[], Call *call);
double *core_modes(Core *c);

/* algebra.c */
int core_solve_algebra(Core *c, double t, double y[]);
int core_algebra_factor(Core *c, double t, const double y[]);
int core_newton(Core *c, double t, double y[]);
int core_algebra_rates(Core *c, double t, const double y[], double rates[]);

/* linear.c */
double core_dot(const double *a, const double *b, int n);
double core_largest(const double *a, int n);
int core_factor(Factor *f, const double entries[], double full[]);
void core_factor_solve(const Factor *f, double b[], double full[]);
void core_factor_solve_transposed(const Factor *f, double b[], double full[]);
int core_dense_factor(double lu[], int n, int pivot[]);
void core_jacobi(double columns[], double right[], int length, int count);
void core_least_norm(double columns[], double right[], int length, int count, int transposed,
                     const double b[], double x[]);

/* events.c */
void core_forget_sizes(Core *c);
int core_watch(Core *c, double t, const double y[], const double rates[], Watched *w);
int core_watch_here(Core *c);
void core_list_open(Core *c);
double core_near_zero(const Core *c, int i);
int core_can_fire(const Core *c, int i);
int core_leavable(const Core *c, int i);
int core_any_due(Core *c);
void core_switching(Core *c);
CoreStatus core_fire(Core *c, int forced, const Observer *told, int begins, int *happened, int *changed);
CoreStatus core_watch_chatter(Core *c);

/* impacts.c */
CoreStatus core_complete(Core *c);
CoreStatus core_strike(Core *c, int shocks[], int stays[], double impulses[], int *count);
void core_reset_variables(Core *c, const int changes[], int count, double seen[]);
int core_stands_in(int mode, int value);
int core_holds(const Core *c, int i);
CoreStatus core_stand_in(Core *c, Kept *kept);
void core_go_back(Core *c, const Kept *kept);

/* shocks.c */
void core_see(Core *c, double seen[]);
CoreStatus core_jump(Core *c, const double seen[], const Observer *told, int *changed);

/* rosenbrock.c */
int core_step_begin(Core *c);
int core_step_try(Core *c, double h, double rtol, double atol, double *error);
void core_step_dense(Core *c, double t, double y[], double rates[]);

/* locate.c */
int core_locate(Core *c, Crossing *crossing);
CoreStatus core_land(Core *c, Crossing *crossing, int *reached);

/* stepper.c */
CoreStatus core_depart(Core *c, Travel *travel);
int core_underway(const Core *c, const Travel *travel);
int core_only_steps(const Core *c, const Travel *travel);
CoreStatus core_aim(Core *c, Travel *travel);
CoreStatus core_stride(Core *c, Travel *travel);
CoreStatus core_refuse(Core *c, Travel *travel, int finite, double error);
double core_accept(Core *c, Travel *travel, double error);
CoreStatus core_conclude(Core *c, Travel *travel, double t);
CoreStatus core_advance_told(Core *c, double stop, double rtol, double atol, double fixed_step,
                             int return_early, const Observer *told, CoreStop *reached);
CoreStatus core_travel(Core *c, double stop, double rtol, double atol, double fixed_step, int return_early,
                       const Observer *told, CoreStop *reached);

/* message.c */
CoreStatus core_fail(Core *c, CoreStatus status, const char *format, ...) SAYS(3);
void core_say_more(Core *c, const char *format, ...) SAYS(2);

#endif

/* Runs a network in the calling process and records what it does. */
#include <math.h>
#include <string.h>

#include "core_state.h"

#if defined(_WIN32)
#define EXPORT __declspec(dllexport)
#else
#define EXPORT __attribute__((visibility("default")))
#endif

enum { ARRIVED, PAUSED, STUCK, FAILED };

/* Shared with native.py, field by field. Arrays are drained by whoever calls, when a run pauses. */
typedef struct {
    double stop, interval, rtol, atol;
    const double *outputs;
    double *times, *points, *constants, *event_times, *impulses;
    long long *segment_rows, *changes, *stays;
    long long output_count, next, row_count, segment_count, event_count;
    long long room, crowd, budget, steps, rejected;
    double last;
} Run;

/* Sizes of what the caller makes room for. */
EXPORT size_t native_size(int kind) {
    return (const size_t[]){sizeof(Core), sizeof(Run), sizeof(Record), sizeof(Legs)}[kind];
}

EXPORT const char *native_message(const Core *c) { return c->message; }

/* Records, of as many inputs as have one, must live as long as the run. */
EXPORT void native_begin(Core *c, double t, const double y[], const double q[], const double free[],
                         Record *const records[], Legs *legs) {
    core_reset(c);
    c->legs = legs;
    for (int i = 0; i < NU; i++) {
        c->free[i] = free[i];
        c->records[i] = records[i];
    }
    c->t = c->free_since = t;
    memcpy(c->y, y, NY * sizeof *y);
    memcpy(c->q, q, NQ * sizeof *q);
}

/* Blocks whose forces were not unique, and steps that each unknown limited. */
EXPORT void native_tell(const Core *c, long long shared[], long long limits[]) {
    for (int i = 0; i < NB; i++) shared[i] = c->shared[i];
    for (int i = 0; i < NY; i++) limits[i] = c->limits[i];
}

static void record(Run *run, double t, const double y[]) {
    run->times[run->row_count] = run->last = t;
    memcpy(run->points + run->row_count++ * NY, y, NY * sizeof *y);
    if (run->row_count >= run->output_count + run->room) run->budget = 0;
}

static void open_segment(Run *run, const Core *c) {
    run->segment_rows[run->segment_count] = run->row_count;
    memcpy(run->constants + run->segment_count++ * NQ, c->q, NQ * sizeof *c->q);
    record(run, c->t, c->y);
    if (run->segment_count >= run->room) run->budget = 0;
}

static int stepped(void *context, Core *c, double until) {
    Run *run = context;
    double y[ROOM(NY)];
    for (; run->next < run->output_count && run->outputs[run->next] <= until; run->next++) {
        double t = run->outputs[run->next];
        if (t == until) record(run, t, c->y);
        else {
            core_step_dense(c, t, y, 0);
            core_solve_algebra(c, t, y);
            record(run, t, y);
        }
    }
    return --run->budget <= 0;
}

static void landed(void *context, Core *c, int after, int switched) {
    Run *run = context;
    if (!after && c->t > run->last) record(run, c->t, c->y);
    if (after && switched) open_segment(run, c);
    if (after && run->next < run->output_count && run->outputs[run->next] <= c->t) run->next++;
}

static void fired(void *context, const Core *c, int change, int stays, double impulse) {
    Run *run = context;
    run->event_times[run->event_count] = c->t;
    run->changes[run->event_count] = change;
    run->stays[run->event_count] = stays;
    run->impulses[run->event_count++] = impulse;
    if (run->event_count >= run->room) run->budget = 0;
}

EXPORT int native_run(Core *c, Run *run) {
    const Observer told = {run, fired, stepped, landed};
    CoreStop reached;
    long long before = c->steps, refused = c->rejected;
    c->interval = run->interval;
    if (0 < run->crowd && run->crowd < c->crowd) c->crowd = (int)run->crowd; /* 0: as usual */
    if (isinf(run->last)) open_segment(run, c); /* where it begins */
    CoreStatus status = core_travel(c, run->stop, run->rtol, run->atol, 0, 0, &told, &reached);
    run->steps += c->steps - before;
    run->rejected += c->rejected - refused;
    if (status != CORE_OK) return status == CORE_DISCARD ? STUCK : FAILED;
    return c->t < run->stop ? PAUSED : ARRIVED;
}

/* Lanes that step together, each on its own time: one that may meet an event is looked after by scalar code,
 * one that has arrived takes the next member in. */
#include "ensemble.h"

#include <math.h>
#include <string.h>

/* Sizes of what the caller makes room for, and how many lanes there are. */
EXPORT size_t ensemble_size(int kind) {
    return (const size_t[]){sizeof(Crew), sizeof(Block), sizeof(Record), sizeof(Legs),
                            LANES,        MESSAGE,       CROSSING}[kind];
}

#define EACH_LANE(k, lanes)         \
    for (int k = 0; k < LANES; k++) \
        if ((lanes) >> k & 1)

static void leave(Crew *crew, int k, CoreStatus status) {
    member_ends(&crew->lane[k], status);
    crew->busy &= ~(1u << k);
    crew->lane[k].travel.h = 0;
}

#ifdef MODEL_WIDE

/* Let a lane know what its core knows. */
static void spread(Crew *crew, int k) {
    Wide *w = &crew->wide;
    const Core *c = &crew->lane[k].core;
    for (int i = 0; i < NY; i++) {
        w->y[i][k] = c->y[i];
        w->rates[i][k] = c->rates[i];
    }
    for (int i = 0; i < NQ; i++) w->q[i][k] = c->q[i];
    w->u_time[k] = NAN;
    for (int i = 0; i < NU; i++) {
        w->free[i][k] = c->free[i];
        w->records[i][k] = c->records[i];
        w->recorded[i] = 0;
        for (int j = 0; j < LANES; j++) w->recorded[i] |= w->records[i][j] != 0;
    }
    for (int i = 0; i < NG; i++) {
        w->left.value[i][k] = c->left.value[i];
        w->left.rate[i][k] = c->left.rate[i];
        w->seen[i][k] = c->seen[i];
        w->fastest[i][k] = c->fastest[i];
    }
    for (int i = 0; i < NZ; i++) w->largest[i][k] = c->largest[i];
    crew->fresh &= ~(1u << k);
}

/* Let a core know where its lane stands. */
static void gather(Crew *crew, int k) {
    const Wide *w = &crew->wide;
    Core *c = &crew->lane[k].core;
    if (!crew->lane[k].ahead) return;
    for (int i = 0; i < NY; i++) {
        c->y[i] = w->y[i][k];
        c->rates[i] = w->rates[i][k];
    }
    for (int i = 0; i < NG; i++) {
        c->left.value[i] = w->left.value[i][k];
        c->left.rate[i] = w->left.rate[i][k];
        c->seen[i] = w->seen[i][k];
        c->fastest[i] = w->fastest[i][k];
    }
    for (int i = 0; i < NZ; i++) c->largest[i] = w->largest[i][k];
    crew->lane[k].ahead = 0;
}

/* Let a core know of the step of its lane as if it had taken it. */
static void gather_step(Crew *crew, int k) {
    const Wide *w = &crew->wide;
    Core *c = &crew->lane[k].core;
    Step *s = &c->step;
    gather(crew, k);
    s->t = c->t;
    s->bent = 1;
    for (int i = 0; i < NY; i++) {
        s->begin[i] = w->y[i][k];
        s->end[i] = w->end[i][k];
        c->end_rates[i] = w->end_rates[i][k];
        for (int b = 0; b < 3; b++) s->bend[b][i] = w->bend[b][i][k];
    }
}

/* Let those lanes stand where their steps have ended. */
static void commit_lanes(Crew *crew, unsigned lanes, const double ends[]) {
    Wide *w = &crew->wide;
    const mask done = mask_of(lanes);
    for (int i = 0; i < NY; i++) {
        w->y[i] = chosen(done, w->end[i], w->y[i]);
        w->rates[i] = chosen(done, w->end_rates[i], w->rates[i]);
    }
    for (int i = 0; i < NG; i++) {
        w->left.value[i] = chosen(done, w->last.value[i], w->left.value[i]);
        w->left.rate[i] = chosen(done, w->last.rate[i], w->left.rate[i]);
        w->seen[i] = chosen(done, w->now_seen[i], w->seen[i]);
        w->fastest[i] = chosen(done, w->now_fastest[i], w->fastest[i]);
    }
    for (int i = 0; i < NZ; i++) {
        wide size = wide_greater(wide_fabs(w->y[NX + i]), FADING * w->largest[i]);
        w->largest[i] = chosen(done, size, w->largest[i]);
    }
    for (int k = 0; k < LANES; k++) {
        if (!(lanes >> k & 1)) continue;
        Core *c = &crew->lane[k].core;
        core_stale(c);
        c->t = ends[k];
        c->fresh = FRESH_ALGEBRA | FRESH_RATES;
        crew->lane[k].ahead = 1;
        crew->lane[k].travel.most = INFINITY;
    }
}

/* Lanes that have outputs up to where their steps end, and the next one of each. */
static unsigned due(const Crew *crew, const Block *block, unsigned lanes, const double ends[], wide *t) {
    for (int k = 0; k < LANES; k++) {
        long long next = crew->lane[k].next;
        if (!(lanes >> k & 1)) continue;
        if (next < block->output_count && block->outputs[next] <= ends[k]) (*t)[k] = block->outputs[next];
        else lanes &= ~(1u << k);
    }
    return lanes;
}

static void write_rows(Crew *crew, const wide y[], wide t, unsigned lanes) {
    Wide *w = &crew->wide;
#if NZ == 0
    if (VARIABLES_FOLLOW_INPUTS) wide_inputs_at(w, t, lanes);
    wide_variables((const wide *[]){y, y + NX, w->u, w->q, &t}, (wide *[]){w->variables});
#endif
    for (int k = 0; k < LANES; k++) {
        if (!(lanes >> k & 1)) continue;
        Lane *lane = &crew->lane[k];
#if NZ == 0
        double *row = member_row(lane, lane->next++);
        for (int i = 0; i < NW; i++) row[i] = w->variables[i][k];
        lane->counted = lane->core.steps;
#else
        double point[NY];
        for (int i = 0; i < NY; i++) point[i] = y[i][k];
        core_solve_algebra(&lane->core, t[k], point);
        member_writes(lane, t[k], point);
#endif
    }
}

/* Write down what is asked for of the steps that lanes have taken. */
static void write_outputs(Crew *crew, const Block *block, unsigned lanes, const double ends[], int bent) {
    wide t = crew->wide.t, y[ROOM(NY)];
    while ((lanes = due(crew, block, lanes, ends, &t))) {
        if (!bent++) wide_bend(&crew->wide);
        wide_dense(&crew->wide, t, y, 0);
        write_rows(crew, y, t, lanes);
    }
}

static unsigned any_muted(const Core *c) {
    unsigned any = 0;
    for (int i = 0; i < NG; i++) any |= c->muted[i] != 0;
    return any;
}

/* Take a lane's step, or look into the one it has taken, by its core alone. */
static void alone(Crew *crew, int k, const double *end) {
    Lane *lane = &crew->lane[k];
    if (end) gather_step(crew, k);
    else gather(crew, k);
    crew->fresh |= 1u << k;
    CoreStatus status =
        end ? core_conclude(&lane->core, &lane->travel, *end) : core_stride(&lane->core, &lane->travel);
    if (status != CORE_OK) leave(crew, k, status);
}

/* Judge the step of a lane. Returns whether it counts. */
static int judged(Crew *crew, int k) {
    Lane *lane = &crew->lane[k];
    double error = crew->wide.error[k];
    lane->core.worst = (int)crew->wide.worst[k];
    if (error <= 1) return 1;
    gather(crew, k);
    CoreStatus status = core_refuse(&lane->core, &lane->travel, isfinite(error), error);
    if (status != CORE_OK) leave(crew, k, status);
    return 0;
}

static void step_together(Crew *crew, Block *block, unsigned trying) {
    Wide *w = &crew->wide;
    double ends[LANES] = {0};
    unsigned accepted = 0, hushed = 0;
    EACH_LANE(k, trying) {
        if (crew->fresh >> k & 1) spread(crew, k);
        w->t[k] = crew->lane[k].core.t;
        w->h[k] = crew->lane[k].travel.h;
    }
    unsigned sound = wide_step(w, trying, block->rtol, block->atol);
    wide until = w->t;
    EACH_LANE(k, trying & ~sound) alone(crew, k, 0);
    EACH_LANE(k, sound) {
        if (!judged(crew, k)) continue;
        until[k] = ends[k] = core_accept(&crew->lane[k].core, &crew->lane[k].travel, w->error[k]);
        w->h[k] = crew->lane[k].core.step.h;
        accepted |= 1u << k;
        if (NG > 0 && any_muted(&crew->lane[k].core)) hushed |= 1u << k;
    }
    if (NG > 0 && accepted) wide_bend(w);
    unsigned calm = wide_uneventful(w, until, accepted & ~hushed);
    EACH_LANE(k, accepted & ~calm) alone(crew, k, ends + k);
    write_outputs(crew, block, calm, ends, NG > 0);
    commit_lanes(crew, calm, ends);
}

#else

static void step_together(Crew *crew, Block *block, unsigned trying) {
    (void)block, (void)trying;
    CoreStatus status = core_stride(&crew->lane->core, &crew->lane->travel);
    if (status != CORE_OK) leave(crew, 0, status);
}

static void gather(Crew *crew, int k) { (void)crew, (void)k; }

#endif

/* Let a lane go on until it has a step to try, from member to member. Returns whether it has. */
static int aims(Crew *crew, Block *block, int k) {
    Lane *lane = &crew->lane[k];
    Core *c = &lane->core;
    for (;;) {
        CoreStatus status = CORE_OK;
        if (!(crew->busy >> k & 1)) {
            if (!member_enters(crew, block, lane)) return 0;
            crew->busy |= 1u << k;
            crew->fresh |= 1u << k;
        }
        if (lane->travel.h > 0) return 1;
        if (!core_underway(c, &lane->travel)) {
            leave(crew, k, CORE_OK);
            continue;
        }
        if (!core_only_steps(c, &lane->travel)) {
            gather(crew, k);
            crew->fresh |= 1u << k;
        }
        if (c->steps - lane->counted > block->most_between)
            status = core_fail(c, CORE_DISCARD, "%g steps did not lead to the next output",
                               (double)block->most_between);
        if (status == CORE_OK) status = core_aim(c, &lane->travel);
        if (status != CORE_OK) leave(crew, k, status);
    }
}

/* Go on until all members have been through, or the budget of rounds is spent. Returns whether any is left.
 */
EXPORT int ensemble_run(Crew *crew, Block *block) {
    while (block->budget-- > 0) {
        unsigned trying = 0;
        for (int k = 0; k < LANES; k++) trying |= aims(crew, block, k) ? 1u << k : 0;
        if (!trying) break;
        block->rounds++;
        EACH_LANE(k, trying) block->tried++;
        step_together(crew, block, trying);
    }
    return crew->busy || block->entered < block->member_count;
}

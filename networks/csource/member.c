/* A member of an ensemble: how it begins, what it writes down on its way, how it ends. */
#include "ensemble.h"

#include <math.h>
#include <string.h>

double *member_row(const Lane *lane, long long output) {
    const Block *block = lane->block;
    return block->values + (lane->member * block->output_count + output) * NW;
}

/* Write what is asked for into the next row. */
void member_writes(Lane *lane, double t, const double y[]) {
    double *row = member_row(lane, lane->next++);
    lane->counted = lane->core.steps;
    core_evaluate(&lane->core, model_variables, t, y, &(Call){.res = {row}});
}

/* Write down where a member stands before an event, or where a segment begins. */
static void crosses(Lane *lane, int begins) {
    Block *block = lane->block;
    Core *c = &lane->core;
    if (!block->crossings || (!begins && c->t == lane->crossed)) return;
    lane->crossed = c->t;
    if (block->crossing_count >= block->crossing_most) {
        lane->lost = 1;
        return;
    }
    double *row = block->crossings + block->crossing_count++ * CROSSING;
    row[0] = (double)lane->member;
    row[1] = begins;
    row[2] = c->t;
    memcpy(row + 3, c->q, NQ * sizeof *row);
    core_evaluate(c, model_variables, c->t, c->y, &(Call){.res = {row + 3 + NQ}});
    if (block->crossing_count >= block->crossing_room) block->budget = 0;
}

static int stepped(void *context, Core *c, double until) {
    Lane *lane = context;
    const Block *block = lane->block;
    double y[ROOM(NY)];
    while (lane->next < block->output_count && block->outputs[lane->next] <= until) {
        double t = block->outputs[lane->next];
        if (t == until) memcpy(y, c->y, sizeof y);
        else core_step_dense(c, t, y, 0);
        if (t != until) core_solve_algebra(c, t, y);
        member_writes(lane, t, y);
    }
    return 0;
}

/* What an output at the instant of an event tells is what is true after it. */
static void landed(void *context, Core *c, int after, int switched) {
    Lane *lane = context;
    const Block *block = lane->block;
    if (!after) crosses(lane, 0);
    if (!after || !switched || core_rates(c, 0) != CORE_OK) return;
    crosses(lane, 1);
    if (lane->next > 0 && block->outputs[lane->next - 1] == c->t) lane->next--;
    if (lane->next < block->output_count && block->outputs[lane->next] <= c->t)
        member_writes(lane, c->t, c->y);
}

static void fired(void *context, const Core *c, int change, int stays, double impulse) {
    Lane *lane = context;
    Block *block = lane->block;
    block->event_times[block->event_count] = c->t;
    block->event_members[block->event_count] = lane->member;
    block->changes[block->event_count] = change;
    block->stays[block->event_count] = stays;
    block->impulses[block->event_count++] = impulse;
    if (block->event_count >= block->event_room) block->budget = 0;
}

/* Give the core the inputs of a member, and the instant where it begins. */
static void stand(Lane *lane) {
    const Block *block = lane->block;
    Core *c = &lane->core;
    long long set = block->signals_of[lane->member];
    core_reset(c);
    c->legs = block->legs + block->legs_of[lane->member];
    for (int i = 0; i < NU; i++) {
        lane->record[i] = block->records[set * NU + i];
        c->free[i] = block->free[set * NU + i];
        c->records[i] = lane->record[i].times ? lane->record + i : 0;
    }
    c->t = c->free_since = block->begin;
}

/* Put the core where its member starts, seeking that if it is not known. */
static CoreStatus start(Crew *crew, Lane *lane) {
    const Block *block = lane->block;
    Core *c = &lane->core;
    double y[ROOM(NY)], q[ROOM(NQ)];
    stand(lane);
    if (block->points) {
        memcpy(c->y, block->points + lane->member * NY, NY * sizeof *y);
        memcpy(c->q, block->constants + lane->member * NQ, NQ * sizeof *q);
        return CORE_OK;
    }
    memcpy(c->q, block->parameters + lane->member * NP, NP * sizeof *q);
    memcpy(crew->given.x, block->guesses + lane->member * NX, NX * sizeof *y);
    memcpy(crew->given.aim, block->aims + lane->member * NAIM, NAIM * sizeof *y);
    CoreStatus status = core_begin(c, &crew->given, &crew->room);
    if (status == CORE_OK) status = core_rates(c, 0); /* algebraic unknowns follow */
    if (status != CORE_OK) return status;
    memcpy(y, c->y, sizeof y);
    memcpy(q, c->q, sizeof q);
    stand(lane);
    memcpy(c->y, y, sizeof y);
    memcpy(c->q, q, sizeof q);
    return CORE_OK;
}

static CoreStatus depart(Lane *lane) {
    Core *c = &lane->core;
    const Block *block = lane->block;
    c->interval = block->interval;
    lane->told = (Observer){lane, fired, stepped, landed};
    lane->travel = (Travel){.stop = block->stop,
                            .reach = block->stop,
                            .rtol = block->rtol,
                            .atol = block->atol,
                            .told = &lane->told};
    lane->next = lane->counted = 0;
    lane->crossed = -INFINITY;
    lane->lost = 0;
    CoreStatus status = core_depart(c, &lane->travel);
    if (status != CORE_OK) return status;
    crosses(lane, 1);
    member_writes(lane, c->t, c->y);
    return status;
}

/* Let the next member that can start have a lane. Returns 0 if none is left. */
int member_enters(Crew *crew, Block *block, Lane *lane) {
    lane->block = block;
    while (block->entered < block->member_count && block->budget >= 0) {
        lane->member = block->entered++;
        lane->ahead = 0;
        CoreStatus status = start(crew, lane);
        if (status != CORE_OK) { /* whoever calls may know a start */
            block->status[lane->member] = UNSTARTED;
            continue;
        }
        status = depart(lane);
        if (status == CORE_OK) return 1;
        member_ends(lane, status);
    }
    return 0;
}

/* Note what came of a member. */
void member_ends(Lane *lane, CoreStatus status) {
    Block *block = lane->block;
    const Core *c = &lane->core;
    long long member = lane->member;
    block->ended[member] = c->t;
    block->steps[member] = c->steps;
    block->rejected[member] = c->rejected;
    block->status[member] = status == CORE_OK ? ARRIVED : status == CORE_DISCARD ? STUCK : FAILED;
    if (status == CORE_OK && lane->lost) block->status[member] = UNSTARTED;
    if (status == CORE_OK) return;
    memcpy(block->messages + block->message_count * MESSAGE, c->message, MESSAGE);
    block->message_members[block->message_count++] = member;
    if (block->message_count >= block->message_room) block->budget = 0;
}

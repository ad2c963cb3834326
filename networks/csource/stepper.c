/* From instant to instant: step size, events on the way, and when to give up. */
#include <math.h>
#include <string.h>

#include "core_state.h"

#define SAFETY 0.9
#define FASTER 6.0
#define SLOWER 0.2
#define ORDER 5.0
#define TINY 1e-15
#define MOST_STEPS 10000000
#define MOST_WORK 5e7
#define PATIENCE 1e6

typedef struct {
    double rtol, atol, fixed;
    int early;
    const Observer *told;
} Wanted;

static void fail_because(Core *c, const char *reason) {
    core_say(c, "integration failed at t = ");
    core_say_number(c, c->t);
    core_say_more(c, " s: ");
    core_say_more(c, reason);
}

static void name_worst(Core *c) {
    if (NY == 0) return;
    core_say_more(c, "; the state that limited the step is ");
    core_say_more(c, model_unknown_name[c->worst]);
    core_say_more(c, " = ");
    core_say_number(c, c->y[c->worst]);
}

static CoreStatus failed(Core *c, const char *reason) {
    fail_because(c, reason);
    name_worst(c);
    return CORE_DISCARD;
}

static double norm(const double values[], const double sizes[], const Wanted *wanted) {
    double sum = 0;
    for (int i = 0; i < NX; i++) {
        double share = values[i] / (wanted->rtol * fabs(sizes[i]) + wanted->atol * model_nominal[i]);
        sum += share * share;
    }
    return sqrt(sum / ROOM(NX));
}

/* Guess the first step from how fast states move for their size (Hairer, Norsett, Wanner, II.4). */
static double first_step(const Core *c, const Wanted *wanted, double most) {
    double size = norm(c->y, c->y, wanted), speed = norm(c->rates, c->y, wanted);
    double h = size < 1e-5 || speed < 1e-5 ? 1e-6 : 0.01 * size / speed;
    return fmin(h, most);
}

/* Try ever smaller steps until one is within tolerance. */
static CoreStatus accepted_step(Core *c, const Wanted *wanted, double *h, double *error) {
    CoreStatus status = core_rates(c, 0);
    int again = 0;
    if (status != CORE_OK) return status;
    for (;; again = 1) {
        if (!(*h > TINY * fabs(c->t)) || !(*h > 1e-290)) {
            failed(c, "no step is short enough");
            return wanted->told ? CORE_DISCARD : CORE_ERROR; /* no step of communication would be either */
        }
        int finite = core_step_begin(c) && core_step_try(c, *h, wanted->rtol, wanted->atol, error) &&
                     core_motion_at(c, c->t + *h, c->step.end, c->end_rates);
        if (finite && (wanted->fixed > 0 || *error <= 1)) break;
        if (!finite && wanted->fixed > 0) return failed(c, "the states left the finite numbers");
        c->rejected++;
        c->limits[c->worst]++;
        *h *= finite ? fmax(SLOWER, SAFETY * pow(*error, -1 / ORDER)) : 0.25;
    }
    c->steps++;
    double scale = fmin(FASTER, fmax(SLOWER, SAFETY * pow(fmax(*error, 1e-10), -1 / ORDER)));
    if (c->last_h > 0) {
        double foreseen = SAFETY * c->last_h / *h * pow(*error * *error / c->last_error, 1 / ORDER);
        if (foreseen > 1 / FASTER) scale = fmin(scale, fmax(SLOWER, 1 / foreseen));
    }
    c->last_error = fmax(*error, 1e-2);
    c->last_h = *h;
    c->h = *h * (again ? fmin(scale, 1) : scale);
    if (!again) c->limits[c->worst]++;
    return CORE_OK;
}

static void commit(Core *c, double t) {
    memcpy(c->y, c->step.end, sizeof c->y);
    memcpy(c->rates, c->end_rates, sizeof c->rates);
    core_stale(c);
    c->t = t;
    c->fresh = FRESH_ALGEBRA | FRESH_RATES;
}

static CoreStatus chatters(Core *c, int count, double since) {
    core_say(c, "chattering: ");
    core_say_number(c, count);
    core_say_more(c, " events within ");
    core_say_number(c, c->t - since);
    core_say_more(c, " s at t = ");
    core_say_number(c, c->t);
    core_say_more(c, " s");
    return CORE_ERROR;
}

/* Tell if there are very many events in next to no time, or more in an interval than can be meant. */
static CoreStatus watch_chatter(Core *c) {
    double *oldest = c->recent + c->recent_count % CHATTER_COUNT;
    if (c->recent_count >= CHATTER_COUNT && c->t - *oldest < CHATTER_WINDOW * c->interval) return chatters(c, CHATTER_COUNT, *oldest);
    *oldest = c->t;
    c->recent_count = c->recent_count % CHATTER_COUNT + (c->recent_count >= CHATTER_COUNT ? CHATTER_COUNT : 0) + 1;
    if (c->recent_count >= 2 * CHATTER_COUNT) c->recent_count = CHATTER_COUNT;
    if (c->t - c->mark > c->interval) {
        c->mark = c->t;
        c->mark_count = 0;
    }
    if (++c->mark_count > c->crowd) return chatters(c, c->mark_count, c->mark);
    return CORE_OK;
}

/* Fire what fires where the core has landed, and look around anew. */
static CoreStatus fire(Core *c, const Wanted *wanted, int forced) {
    const Observer *told = wanted->told;
    int happened, changed;
    if (told && told->landed) told->landed(told->context, c, 0, 0);
    CoreStatus status = core_fire(c, forced, told, 0, &happened, &changed);
    if (status == CORE_OK && told && told->landed) told->landed(told->context, c, 1, happened);
    if (happened) c->last_h = 0;
    if (status == CORE_OK) status = watch_chatter(c);
    if (status == CORE_OK) status = core_rates(c, 0);
    return status;
}

/* Go on to an instant that only rounding tells from the present one. */
static CoreStatus arrive(Core *c, double t) {
    core_stale(c);
    c->t = t;
    CoreStatus status = core_rates(c, 0);
    if (status != CORE_OK) return status;
    return core_watch(c, t, c->y, c->rates, &c->left) ? CORE_OK : failed(c, "indicators are not finite");
}

/* Take one step, not beyond `stop`, up to the first event. Nonzero `halt` ends the advance. */
static CoreStatus stride(Core *c, const Wanted *wanted, double stop, double *most, CoreStop *reached,
                         int *halt) {
    double left = stop - c->t, h = fmin(fmin(c->h, *most), core_longest_step(c)), kept, error, t, begin, end;
    int indicator, hit;
    if (left <= 4 * TINY * fabs(stop)) return arrive(c, stop);
    if (wanted->fixed > 0) h = left / ceil(left / wanted->fixed - 1e-9);
    if (h >= left * (1 - 1e-10)) h = left;
    else if (wanted->fixed <= 0 && h > 0.5 * left) h = 0.5 * left;
    h = fmin(left, fmax(h, 8 * TINY * fabs(stop))); /* a leg may be as short as rounding */
    kept = c->h;
    double tried = h;
    CoreStatus status = accepted_step(c, wanted, &h, &error);
    if (status != CORE_OK) return status;
    if (h == tried && h < kept) c->h = fmax(c->h, kept);
    t = h == left ? stop : c->t + h;
    c->step.h = t - c->t;
    double seen[ROOM(NG)], fastest[ROOM(NG)];
    memcpy(seen, c->seen, sizeof seen);
    memcpy(fastest, c->fastest, sizeof fastest);
    if (!core_watch(c, t, c->step.end, c->end_rates, &c->last)) return failed(c, "indicators are not finite");
    for (int i = 0; i < NG; i++) c->muted[i] = c->muted[i] && c->last.value[i] > -core_near_zero(c, i);
    Watched *start = &c->left;
    double begin_rate[ROOM(NG)];
    memcpy(begin_rate, start->rate, sizeof begin_rate);
    double event = t;
    int found = core_locate(c, &event, &begin, &end, &indicator);
    if (found < 0) return failed(c, "indicators are not finite");
    if (!found) {
        commit(c, t);
        c->left = c->last;
        *most = INFINITY;
        if (wanted->told && wanted->told->stepped) *halt = wanted->told->stepped(wanted->told->context, c, t);
        return CORE_OK;
    }
    memcpy(c->seen, seen, sizeof seen); /* what lies beyond an event is never reached, and has no size */
    memcpy(c->fastest, fastest, sizeof fastest);
    if (event <= c->t && begin_rate[indicator] <= RATE_NOISE * c->fastest[indicator] && h > 1e-9 * c->interval) {
        *most = h / 8; /* it rests on zero: see whether it really leaves */
        return core_rates(c, 0) == CORE_OK && core_watch(c, c->t, c->y, c->rates, &c->left) ? CORE_OK
                                                                                            : CORE_DISCARD;
    }
    *most = INFINITY;
    status = core_land(c, &indicator, event, begin, end, &hit);
    if (status != CORE_OK) return status;
    if (c->step.h > 0 && wanted->told && wanted->told->stepped)
        *halt = wanted->told->stepped(wanted->told->context, c, c->t);
    if (wanted->early) {
        c->pending = hit ? indicator + 1 : 0;
        *reached = CORE_EVENT;
        *halt = 1;
        return watch_chatter(c);
    }
    status = fire(c, wanted, hit ? indicator : -1);
    if (status != CORE_OK) return status;
    return core_watch(c, c->t, c->y, c->rates, &c->left) ? CORE_OK : failed(c, "indicators are not finite");
}

/* Go on beyond the end of a leg; where something jumps there, fire what that fires, or leave it. */
static CoreStatus enter_next_leg(Core *c, const Wanted *wanted, CoreStop *reached, int *halt) {
    const Observer *told = wanted->told;
    int happened, changed, jumps = core_jumps_next(c);
    CoreStatus status;
    if (jumps && wanted->early) {
        *reached = CORE_EVENT;
        *halt = 1;
        return CORE_OK;
    }
    if (jumps && told && told->landed) told->landed(told->context, c, 0, 0);
    status = core_next_leg(c, told, &changed);
    if (status == CORE_OK && jumps) status = core_fire(c, -1, told, 0, &happened, &changed);
    if (status == CORE_OK && jumps && told && told->landed) told->landed(told->context, c, 1, 1);
    if (status == CORE_OK) status = core_rates(c, 0);
    if (status != CORE_OK) return status;
    return core_watch(c, c->t, c->y, c->rates, &c->left) ? CORE_OK : failed(c, "indicators are not finite");
}

/* Give up a step of communication that at this pace has no end; large models get less patience at once. */
static CoreStatus check_pace(Core *c, double begin, double stop, long long before) {
    double work = (double)(c->work - before), done = c->t - begin, whole = stop - begin;
    if (work <= PATIENCE / (1 + NY / 10.0) + MOST_WORK * done / whole) return CORE_OK;
    fail_because(c, "a step of ");
    core_say_number(c, whole);
    core_say_more(c, " s is given up, as so far the model was evaluated ");
    core_say_number(c, work);
    core_say_more(c, " times for ");
    core_say_number(c, done);
    core_say_more(c, " s of it");
    name_worst(c);
    core_say_more(c, ". Is a parameter out of all proportion, or the communication step too long?");
    return CORE_ERROR;
}

/* Let free inputs, which went on by their derivatives, start from where they are. */
static void rebase(Core *c) {
    for (int i = 0; i < NU; i++) c->trial_free[i] = core_free_at(c, i, c->t);
    for (int i = 0; i < NU; i++) {
        c->free[i] = c->trial_free[i];
        c->drift[i] = 0;
    }
    c->free_since = c->t;
    c->u_time = NAN;
}

CoreStatus core_travel(Core *c, double stop, double rtol, double atol, double fixed_step, int return_early,
                       const Observer *told, CoreStop *reached) {
    Wanted wanted = {rtol, atol, fixed_step, return_early, told};
    double most = INFINITY;
    int halt = 0;
    long long begin = c->steps, before = c->work;
    double from = c->t;
    *reached = CORE_ARRIVED;
    if (!isfinite(stop) || stop < c->t) {
        core_say(c, "time can only advance, from ");
        core_say_number(c, c->t);
        core_say_more(c, " s; got ");
        core_say_number(c, stop);
        return CORE_ERROR;
    }
    if (!core_knows_inputs(c, stop)) return CORE_ERROR;
    if (!(rtol > 0) || !(atol > 0)) {
        core_say(c, "tolerances must be above 0");
        return CORE_ERROR;
    }
    core_find_leg(c);
    CoreStatus status = core_rates(c, 0);
    if (status == CORE_OK && !core_watch(c, c->t, c->y, c->rates, &c->left))
        status = failed(c, "indicators are not finite");
    if (!(c->h > 0) && status == CORE_OK) c->h = first_step(c, &wanted, stop - c->t);
    while (status == CORE_OK && !halt && c->t < stop) {
        status = core_at_end_of_leg(c)
                     ? enter_next_leg(c, &wanted, reached, &halt)
                     : stride(c, &wanted, fmin(stop, core_end_of_leg(c)), &most, reached, &halt);
        if (status == CORE_OK && c->steps - begin > MOST_STEPS)
            status = failed(c, "there is no end of steps");
        if (status == CORE_OK && !told && !(fixed_step > 0)) status = check_pace(c, from, stop, before);
    }
    rebase(c);
    return status;
}

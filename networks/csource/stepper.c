/* From instant to instant: step size, events on the way, and when to give up. */
#include <math.h>
#include <string.h>

#include "core_state.h"

#define SAFETY 0.9
#define FASTER 6.0
#define SLOWER 0.2
#define ORDER 5.0
#define TINY 1e-15
/* Share of an interval below which a step need not be shorter to see an indicator rise. */
#define SHORTEST 1e-9
#define NOT_FINITE "indicators are not finite"
/* Corners of data landed on, once one was too much for a step that would end among them. */
#define CORNERS 16
/* Advances over which a step may lead, those for which it is worth it, and how near to an event it goes. */
#define MOST_AHEAD 1000
#define FEWEST_AHEAD 4
#define SHARE_BEFORE 0.9
#define MOST_STEPS 10000000
#define MOST_WORK 5e7
#define PATIENCE 1e6

static void name_worst(Core *c) {
    if (NY == 0) return;
    core_say_more(c, "; the state that limited the step is %s = %g", model_unknown_name[c->worst],
                  c->y[c->worst]);
}

static CoreStatus failed(Core *c, const char *reason) {
    core_fail(c, CORE_DISCARD, "integration failed at t = %g s: %s", c->t, reason);
    name_worst(c);
    return CORE_DISCARD;
}

static double norm(const double values[], const double sizes[], const Travel *travel) {
    double sum = 0;
    for (int i = 0; i < NX; i++) {
        double share = values[i] / (travel->rtol * fabs(sizes[i]) + travel->atol * model_nominal[i]);
        sum += share * share;
    }
    return NX ? sqrt(sum / NX) : 0;
}

/* Guess the first step from how fast states move for their size (Hairer, Norsett, Wanner, II.4). */
static double first_step(const Core *c, const Travel *travel, double most) {
    double size = norm(c->y, c->y, travel), speed = norm(c->rates, c->y, travel);
    double h = size < 1e-5 || speed < 1e-5 ? 1e-6 : 0.01 * size / speed;
    return fmin(h, most);
}

/* Where the next corner of data is, and how long the piece before it. */
static double corner_ahead(const Core *c, double *length) {
#ifdef CORE_RECORDS
    return core_corner_after(c, c->t, length);
#else
    (void)c;
    *length = 0;
    return INFINITY;
#endif
}

/* Let a refused step end at the corner that it has met, if a shorter one would not get beyond it by far. */
static void end_at_corner(Core *c, Travel *travel, double refused) {
    double length, corner = corner_ahead(c, &length);
    if (corner - c->t >= refused || travel->h >= length) return;
    c->corners = CORNERS;
    travel->bound = corner;
    travel->h = travel->tried = corner - c->t;
}

/* Take back a step that is too long, or leaves the finite numbers, for a shorter one. */
CoreStatus core_refuse(Core *c, Travel *travel, int finite, double error) {
    if (!finite && travel->fixed > 0) return failed(c, "the states left the finite numbers");
    c->rejected++;
    c->limits[c->worst]++;
    double refused = travel->h;
    travel->h *= finite ? fmax(SLOWER, SAFETY * pow(error, -1 / ORDER)) : 0.25;
    if (finite) end_at_corner(c, travel, refused);
    if (travel->h > TINY * fabs(c->t) && travel->h > 1e-290) return CORE_OK;
    failed(c, "no step is short enough");
    return travel->told ? CORE_DISCARD : CORE_ERROR; /* no step of communication would be either */
}

/* Count a step, choose the length of the next one; return where it ends. */
double core_accept(Core *c, Travel *travel, double error) {
    double h = travel->h;
    int again = h != travel->tried;
    c->steps++;
    double scale = fmin(FASTER, fmax(SLOWER, SAFETY * pow(fmax(error, 1e-10), -1 / ORDER)));
    if (c->last_h > 0) {
        double foreseen = SAFETY * c->last_h / h * pow(error * error / c->last_error, 1 / ORDER);
        if (foreseen > 1 / FASTER) scale = fmin(scale, fmax(SLOWER, 1 / foreseen));
    }
    c->last_error = fmax(error, 1e-2);
    c->last_h = h;
    c->h = h * (again ? fmin(scale, 1) : scale);
    if (!again) c->limits[c->worst]++;
    if (!again && h < travel->kept) c->h = fmax(c->h, travel->kept); /* shorter only for where it stops */
    int stops = h == travel->bound - c->t;
    double t = stops ? travel->bound : c->t + h;
    c->corners -= stops && c->corners > 0;
    c->step.h = t - c->t;
    travel->h = 0;
    return t;
}

/* Solve for what follows from where the core stands, and evaluate its indicators. */
static CoreStatus look_around(Core *c) {
    CoreStatus status = core_rates(c, 0);
    if (status != CORE_OK) return status;
    return core_watch_here(c) ? CORE_OK : failed(c, NOT_FINITE);
}

static void tell_landed(Core *c, const Travel *travel, int after, int switched) {
    const Observer *told = travel->told;
    if (told && told->landed) told->landed(told->context, c, after, switched);
}

static void stop_at_event(Travel *travel) {
    travel->reached = CORE_EVENT;
    travel->halt = 1;
}

/* Fire what fires where the core has landed. */
static CoreStatus fire(Core *c, const Travel *travel, int forced) {
    int happened, changed;
    tell_landed(c, travel, 0, 0);
    CoreStatus status = core_fire(c, forced, travel->told, 0, &happened, &changed);
    if (happened) c->last_h = 0;
    if (status != CORE_OK) return status;
    tell_landed(c, travel, 1, happened);
    return core_watch_chatter(c);
}

/* Go on to an instant that only rounding tells from the present one. */
static CoreStatus arrive(Core *c, double t) {
    core_stale(c);
    c->t = t;
    return look_around(c);
}

/* The length of the next step: at most to where it has to stop, or near to half the way if little would be
 * left. */
static double chosen_step(const Core *c, const Travel *travel, double stop) {
    double left = stop - c->t, h = fmin(fmin(c->h, travel->most), core_longest_step(c));
    if (travel->fixed > 0) h = left / ceil(left / travel->fixed - 1e-9);
    if (h >= left * (1 - 1e-10)) h = left;
    else if (travel->fixed <= 0 && h > 0.5 * left) h = 0.5 * left;
    return fmin(left, fmax(h, 8 * TINY * fabs(stop))); /* a leg may be as short as rounding */
}

static void step_was_taken(Core *c, Travel *travel) {
    const Observer *told = travel->told;
    if (told && told->stepped) travel->halt = told->stepped(told->context, c, c->t);
}

/* Let the core stand where the last step ended. */
static void commit(Core *c, double t) {
    memcpy(c->y, c->step.end, sizeof c->y);
    memcpy(c->rates, c->end_rates, sizeof c->rates);
    for (int i = 0; i < NZ; i++) c->largest[i] = core_larger(fabs(c->y[NX + i]), FADING * c->largest[i]);
    core_stale(c);
    c->t = t;
    c->fresh = FRESH_ALGEBRA | FRESH_RATES | FRESH_LEFT;
    c->left = c->last;
}

/* Let the core stand inside the last step, in which nothing happens, at the instant it was asked for. */
static CoreStatus stand_inside(Core *c, Travel *travel, double end) {
    core_stale(c);
    c->t = travel->stop;
    core_step_dense(c, c->t, c->y, 0);
    if (core_rates(c, 0) != CORE_OK) return failed(c, "the interpolation leads where rates are not finite");
    c->ahead = 1;
    c->ahead_end = end;
    return CORE_OK;
}

/* Step again, as something happens beyond what is asked for: to somewhat before, or no farther. */
static CoreStatus step_shorter(Core *c, Travel *travel, const Crossing *crossing) {
    double before = c->t + SHARE_BEFORE * (crossing->t - c->t), span = travel->stop - travel->from;
    int worth = before - travel->stop > FEWEST_AHEAD * span;
    travel->reach = worth ? before : travel->stop;
    if (!worth) c->calm = -FEWEST_AHEAD;
    return look_around(c);
}

/* Go onto a crossing in the last step and fire what fires there, or leave it to be fired. */
static CoreStatus land_and_fire(Core *c, Travel *travel, Crossing *crossing) {
    int hit;
    CoreStatus status = core_land(c, crossing, &hit);
    if (status != CORE_OK) return status;
    if (c->step.h > 0) step_was_taken(c, travel);
    if (!travel->early) {
        status = fire(c, travel, hit ? crossing->indicator : -1);
        return status == CORE_OK ? look_around(c) : status;
    }
    c->pending = hit ? crossing->indicator + 1 : 0;
    stop_at_event(travel);
    return core_watch_chatter(c);
}

/* Look for a crossing in the step just taken to t, without which it counts as a whole. */
CoreStatus core_conclude(Core *c, Travel *travel, double t) {
    double seen[ROOM(NG)], fastest[ROOM(NG)], began[ROOM(NG)];
    Crossing crossing = {t, c->t, t, 0};
    memcpy(seen, c->seen, sizeof seen);
    memcpy(fastest, c->fastest, sizeof fastest);
    memcpy(began, c->left.rate, sizeof began);
    if (!core_watch(c, t, c->step.end, c->end_rates, &c->last)) return failed(c, NOT_FINITE);
    for (int i = 0; i < NG; i++) c->muted[i] = c->muted[i] && c->last.value[i] > -core_near_zero(c, i);
    c->fresh &= ~FRESH_LEFT; /* from piece to piece `left` moves on */
    int found = core_locate(c, &crossing);
    if (found < 0) return failed(c, NOT_FINITE);
    if (!found && t > travel->stop) return stand_inside(c, travel, t);
    if (!found) {
        commit(c, t);
        travel->most = INFINITY;
        step_was_taken(c, travel);
        return CORE_OK;
    }
    memcpy(c->seen, seen, sizeof seen); /* what lies beyond an event is never reached, and has no size */
    memcpy(c->fastest, fastest, sizeof fastest);
    if (t > travel->stop) return step_shorter(c, travel, &crossing);
    int i = crossing.indicator, flat = crossing.t <= c->t && began[i] <= RATE_NOISE * c->fastest[i];
    if (flat && c->step.h > SHORTEST * c->interval) { /* it rests on zero: see whether it really leaves */
        travel->most = c->step.h / 8;
        return look_around(c);
    }
    travel->most = INFINITY;
    return land_and_fire(c, travel, &crossing);
}

static double bound_of(const Core *c, const Travel *travel) {
    return fmin(travel->reach, core_end_of_leg(c));
}

static int is_there(const Core *c, double bound) { return bound - c->t <= 4 * TINY * fabs(bound); }

/* Set out for a step that ends at `bound` or before. */
static CoreStatus set_out(Core *c, Travel *travel, double bound) {
    double length;
    if (is_there(c, bound)) return arrive(c, bound);
    if (c->corners > 0) bound = fmin(bound, corner_ahead(c, &length));
    travel->bound = bound;
    travel->kept = c->h;
    travel->h = travel->tried = chosen_step(c, travel, bound);
    return core_rates(c, 0);
}

/* Try the step that is to be tried. */
CoreStatus core_stride(Core *c, Travel *travel) {
    double error = 0;
    int finite = core_step_begin(c) && core_step_try(c, travel->h, travel->rtol, travel->atol, &error) &&
                 core_motion_at(c, c->t + travel->h, c->step.end, c->end_rates);
    if (!finite || (error > 1 && !(travel->fixed > 0))) return core_refuse(c, travel, finite, error);
    return core_conclude(c, travel, core_accept(c, travel, error));
}

/* Go on beyond the end of a leg; where something jumps there, fire what that fires, or leave it. */
static CoreStatus enter_next_leg(Core *c, Travel *travel) {
    int happened, changed, jumps = core_jumps_next(c);
    if (jumps && travel->early) {
        stop_at_event(travel);
        return CORE_OK;
    }
    if (jumps) tell_landed(c, travel, 0, 0);
    CoreStatus status = core_next_leg(c, travel->told, &changed);
    if (status == CORE_OK && jumps) {
        status = core_fire(c, -1, travel->told, 0, &happened, &changed);
        if (status == CORE_OK) tell_landed(c, travel, 1, 1);
    }
    return status == CORE_OK ? look_around(c) : status;
}

/* Give up a step of communication that at this pace has no end; large models get less patience at once. */
static CoreStatus check_pace(Core *c, double begin, double stop, long long before) {
    double work = (double)(c->work - before), done = c->t - begin, whole = stop - begin;
    if (work <= PATIENCE / (1 + NY / 10.0) + MOST_WORK * done / whole) return CORE_OK;
    core_fail(c, CORE_ERROR,
              "integration failed at t = %g s: a step of %g s is given up, as so far the model was evaluated "
              "%g times for %g s of it",
              c->t, whole, work, done);
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

static CoreStatus check_wish(Core *c, double stop, double rtol, double atol) {
    if (!isfinite(stop) || stop < c->t)
        return core_fail(c, CORE_ERROR, "time can only advance, from %g s; got %g", c->t, stop);
    if (!core_knows_inputs(c, stop)) return CORE_ERROR;
    return rtol > 0 && atol > 0 ? CORE_OK : core_fail(c, CORE_ERROR, "tolerances must be above 0");
}

/* Let steps lead beyond where the core is asked to stop, if it has been left alone for a while. */
static double chosen_reach(Core *c, const Travel *travel) {
    const Observer *told = travel->told;
    double span = travel->stop - c->t, last = fmin(c->reach, model_data_span[1]);
    int alone = ++c->calm > 1 && travel->fixed <= 0 && !(told && told->stepped);
    for (int i = 0; i < NG; i++) alone = alone && !c->muted[i];
    for (int i = 0; i < NU; i++) alone = alone && c->drift[i] == 0;
    return alone ? fmax(travel->stop, fmin(last, travel->stop + MOST_AHEAD * span)) : travel->stop;
}

/* Go on in the step inside which the core stands; tell whether that is all that is asked for. */
static CoreStatus go_on(Core *c, Travel *travel, int *arrived) {
    *arrived = travel->stop < c->ahead_end;
    if (*arrived) return stand_inside(c, travel, c->ahead_end);
    commit(c, c->ahead_end);
    return CORE_OK;
}

/* Make ready to go from where the core stands. */
CoreStatus core_depart(Core *c, Travel *travel) {
    travel->begin = c->steps;
    travel->before = c->work;
    travel->from = c->t;
    travel->most = INFINITY;
    travel->reached = CORE_ARRIVED;
    core_find_leg(c);
    CoreStatus status = look_around(c);
    if (!(c->h > 0) && status == CORE_OK) c->h = first_step(c, travel, travel->stop - c->t);
    return status;
}

int core_underway(const Core *c, const Travel *travel) { return !travel->halt && c->t < travel->stop; }

/* Whether the way on from here is a step, for which all is known. */
int core_only_steps(const Core *c, const Travel *travel) {
    return !core_at_end_of_leg(c) && !is_there(c, bound_of(c, travel));
}

/* Choose a step to try, or do what needs none. */
CoreStatus core_aim(Core *c, Travel *travel) {
    if (c->steps - travel->begin > MOST_STEPS) return failed(c, "there is no end of steps");
    if (core_at_end_of_leg(c)) return enter_next_leg(c, travel);
    return set_out(c, travel, bound_of(c, travel));
}

CoreStatus core_travel(Core *c, double stop, double rtol, double atol, double fixed_step, int return_early,
                       const Observer *told, CoreStop *reached) {
    Travel travel = {
        .stop = stop, .rtol = rtol, .atol = atol, .fixed = fixed_step, .early = return_early, .told = told};
    *reached = CORE_ARRIVED;
    CoreStatus status = check_wish(c, stop, rtol, atol);
    if (status != CORE_OK) return status;
    travel.reach = chosen_reach(c, &travel);
    int arrived = 0;
    if (c->ahead) status = go_on(c, &travel, &arrived);
    if (status == CORE_OK && !arrived) status = core_depart(c, &travel);
    while (status == CORE_OK && core_underway(c, &travel)) {
        status = travel.h > 0 ? core_stride(c, &travel) : core_aim(c, &travel);
        if (status == CORE_OK && !told && !(fixed_step > 0))
            status = check_pace(c, travel.from, stop, travel.before);
    }
    *reached = travel.reached;
    rebase(c);
    return status;
}

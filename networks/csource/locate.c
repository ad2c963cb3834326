/* Where in a step an indicator rises above zero first, and how to land there. */
#include <math.h>
#include <string.h>

#include "core_state.h"

#define GOLDEN 0.3819660112501051
#define CHECKS 3
#define MOST_PIECES 100000
#define SHORTEST_PIECE 1e-9 /* share of a step */
#define FAR_BELOW 10

static const double SHARES[CHECKS] = {GOLDEN, 0.5, 1 - GOLDEN};

/* The cubic with values a, b and slopes da, db at the ends of [0, 1]. */
typedef struct {
    double a, b, da, db, c2, c3;
} Cubic;

static Cubic cubic(const Watched *left, const Watched *right, int i, double span) {
    Cubic p = {left->value[i], right->value[i], left->rate[i] * span, right->rate[i] * span, 0, 0};
    p.c3 = 2 * p.a - 2 * p.b + p.da + p.db;
    p.c2 = -3 * p.a + 3 * p.b - 2 * p.da - p.db;
    return p;
}

static double cubic_at(const Cubic *p, double x) { return p->a + x * (p->da + x * (p->c2 + x * p->c3)); }

static double bound(const Cubic *p) {
    return core_larger(p->a, p->b) + CUBIC_CREST * (fabs(p->da) + fabs(p->db));
}

static double peak(const Cubic *p) {
    double lean = 3 * (p->b - p->a) - p->da - p->db;
    if (!(p->da > 0 && p->db < 0)) return -INFINITY;
    return cubic_at(p, p->da / (p->da + (sqrt(lean * lean - p->da * p->db) - lean)));
}

static int rises(const Cubic *p, double near) {
    if (p->a > near) return p->da <= 0 && p->b > near && p->db > 0;
    return p->b > near || peak(p) > near;
}

/* Where the cubic turns: up (side 1) or down (side -1). */
static double turn(const Cubic *p, int side) {
    return -p->da / (p->c2 + side * sqrt(fmax(p->c2 * p->c2 - 3 * p->c3 * p->da, 0)));
}

static double root(const Cubic *p, double near) {
    if (p->a >= 0 && p->da >= 0) return 0;
    double low = p->a >= 0 ? turn(p, 1) : 0, high = p->b <= near ? turn(p, -1) : 1;
    for (int k = 0; k < CUBIC_BISECTIONS; k++) {
        double middle = 0.5 * (low + high);
        if (cubic_at(p, middle) < 0) low = middle;
        else high = middle;
    }
    return high;
}

/* Whether cubics tell what indicators do between two instants, a third between them being known. */
static int resolved(const Core *c, double span, double share) {
    for (int k = 0; k < c->open_count; k++) {
        int i = c->open[k];
        Cubic p = cubic(&c->left, &c->right, i, span);
        double seen = c->middle.value[i], error = fabs(seen - cubic_at(&p, share)),
               near = core_near_zero(c, i);
        double range = core_larger(core_larger(p.a, p.b), seen) - core_smaller(core_smaller(p.a, p.b), seen);
        if (error > CUBIC_MISSES * range + near && core_larger(bound(&p), seen) + 10 * error > near) return 0;
    }
    return 1;
}

static int timed(const Core *c) {
    for (int k = 0; k < c->open_count; k++)
        if (model_change_timed[c->open[k]]) return 1;
    return 0;
}

/* Whether all lie farther below zero than some times what they move in the step, as its ends tell. */
static int far_below(const Core *c) {
    for (int k = 0; k < c->open_count; k++) {
        int i = c->open[k];
        double a = c->left.value[i], b = c->last.value[i];
        double moves = fabs(b - a) + c->step.h * (fabs(c->left.rate[i]) + fabs(c->last.rate[i]));
        if (!(core_larger(a, b) < -FAR_BELOW * moves)) return 0;
    }
    return 1;
}

/* Algebraic unknowns follow time, which a step need not: they are solved for where it matters. Rates are
 * those of the interpolation, as its errors in stiff states would make wrong ones of them there. */
static int watch_inside(Core *c, double t, Watched *w) {
    double y[ROOM(NY)], rates[ROOM(NY)];
    core_step_dense(c, t, y, rates);
    if (timed(c) && !core_solve_algebra(c, t, y)) return 0;
    return core_watch(c, t, y, rates, w);
}

static int first(const Core *c, double span, double *share) {
    int found = -1;
    for (int k = 0; k < c->open_count; k++) {
        int i = c->open[k];
        if (c->muted[i]) continue;
        Cubic p = cubic(&c->left, &c->right, i, span);
        double near = core_near_zero(c, i), at;
        if (bound(&p) <= near || !rises(&p, near)) continue;
        at = root(&p, near);
        if (found < 0 || at < *share) {
            found = i;
            *share = at;
        }
    }
    return found;
}

/* Look for the first crossing in the last step, `left` and `last` being known at its ends. Returns 1 if there
 * is one, 0 if not, -1 if indicators are not finite. */
int core_locate(Core *c, Crossing *crossing) {
    core_list_open(c);
    double stop = c->step.t + c->step.h, a = c->step.t;
    double shortest = fmax(SHORTEST_PIECE * c->step.h, 1e-15 * fmax(1, fabs(stop)));
    int checks = timed(c) ? CHECKS : 1; /* what time does, no step follows; one check may pass by chance */
    if (NG == 0 || (checks == 1 && far_below(c))) return 0;
    for (int piece = 0; piece < MOST_PIECES && a < stop; piece++) {
        double b = stop, share = 0;
        c->right = c->last;
        for (int k = 0; k < checks && b - a > shortest;) {
            double middle = a + SHARES[k] * (b - a);
            if (!watch_inside(c, middle, &c->middle)) return -1;
            if (resolved(c, b - a, SHARES[k])) k++;
            else {
                k = 0;
                b = middle;
                c->right = c->middle;
            }
        }
        int indicator = first(c, b - a, &share);
        if (indicator >= 0) {
            *crossing = (Crossing){a + share * (b - a), a, b, indicator};
            return 1;
        }
        a = b;
        c->left = c->right;
    }
    return 0;
}

/* Evaluate indicators at the end of the step. */
static int look(Core *c, double t) {
    return core_motion_at(c, t, c->step.end, c->end_rates) &&
           core_watch(c, t, c->step.end, c->end_rates, &c->right);
}

/* Move a point that is very near a crossing onto it, along its velocity; tell whether it is there. */
static int shift(Core *c, int indicator, double *t) {
    double *y = c->step.end;
    for (int again = 0; again < 2; again++) {
        if (!look(c, *t) || !(c->right.rate[indicator] > 0)) return 0;
        double span = -c->right.value[indicator] / c->right.rate[indicator];
        for (int i = 0; i < NX; i++) y[i] += span * c->end_rates[i];
        *t += span;
        if (!core_solve_algebra(c, *t, y)) return 0;
    }
    return look(c, *t) && fabs(c->right.value[indicator]) <= core_near_zero(c, indicator);
}

/* Whether an indicator is above zero where the piece begins, or falls from zero less than noise would hide:
 * what is sought then is where it begins to rise. */
static int begins_beyond(const Core *c, int indicator, double span) {
    Cubic p = cubic(&c->left, &c->right, indicator, span);
    double near = core_near_zero(c, indicator);
    if (p.a > near || p.a < 0 || p.da >= 0) return p.a > near;
    return cubic_at(&p, turn(&p, 1)) > -near;
}

static CoreStatus step_onto(Core *c, const Crossing *crossing) {
    double error;
    if (core_step_begin(c) && core_step_try(c, crossing->t - c->t, 1, 1, &error) && look(c, crossing->t))
        return CORE_OK;
    return core_fail(c, CORE_DISCARD, "no way onto the event of %s", model_component[crossing->indicator]);
}

/* Shift the end of the step onto a crossing, if that is possible, else leave it. Returns -1 if it is lost. */
static int shifted(Core *c, Crossing *crossing) {
    double kept[ROOM(NY)], at = crossing->t;
    memcpy(kept, c->step.end, sizeof kept);
    if (shift(c, crossing->indicator, &at)) {
        crossing->t = at;
        return 1;
    }
    memcpy(c->step.end, kept, sizeof kept);
    return look(c, crossing->t) ? 0 : -1;
}

/* Step anew onto a crossing, in its piece, at whose begin indicators are in `left`. `reached` tells whether
 * zero was: interpolation can make believe in a crossing. */
static CoreStatus approach(Core *c, Crossing *crossing, int *reached) {
    double low = crossing->begin, high = crossing->end, whole = c->step.h, moved = INFINITY;
    int i = crossing->indicator, beyond = begins_beyond(c, i, high - low);
    *reached = 1;
    for (;;) {
        int narrow = high - low < NARROWEST * fmax(1, fabs(crossing->t));
        if (narrow) crossing->t = high;
        if (crossing->t <= c->t) return CORE_OK;
        CoreStatus status = step_onto(c, crossing);
        if (status != CORE_OK) return status;
        double t = crossing->t, g = c->right.value[i], rate = c->right.rate[i];
        double newton = rate > 0 && !beyond ? t - g / rate : INFINITY;
        int near = low <= newton && newton <= high && fabs(newton - t) < SHIFT_SHARE * whole;
        if (near || (narrow && c->t < newton && newton < crossing->end)) {
            int there = shifted(c, crossing);
            if (there) return there > 0 ? CORE_OK : CORE_DISCARD;
        }
        if (narrow) {
            *reached = g >= 0;
            return CORE_OK;
        }
        if (beyond ? rate < 0 : g < 0) low = t;
        else high = t;
        /* Where the rate of a stiff state misleads, Newton's steps creep, and only those that halve are
         * taken. */
        int follow = low < newton && newton < high && fabs(newton - t) < 0.5 * moved;
        crossing->t = follow ? newton : 0.5 * (low + high);
        moved = fabs(crossing->t - t);
    }
}

/* The indicator whose crossing in a piece that ends at t (`right`) lies farthest behind it, or -1. */
static int passed(const Core *c, double t) {
    double longest = SAME_INSTANT * fmax(1, fabs(t));
    int found = -1;
    for (int i = 0; i < NG; i++) {
        double near = core_near_zero(c, i),
               since = (c->right.value[i] - near) / fmax(fabs(c->right.rate[i]), INDICATOR_FLOOR);
        if (!core_can_fire(c, i) || c->left.value[i] > near || since <= longest) continue;
        found = i;
        longest = since;
    }
    return found;
}

/* Approach a crossing, or that of another indicator which is passed on the way, and stand there. */
CoreStatus core_land(Core *c, Crossing *crossing, int *reached) {
    double earliest = INFINITY;
    CoreStatus status = approach(c, crossing, reached);
    while (status == CORE_OK && c->t < crossing->t && crossing->t < earliest) {
        int other = passed(c, crossing->t);
        if (other < 0 || other == crossing->indicator) break;
        crossing->indicator = other;
        crossing->end = earliest = crossing->t;
        status = approach(c, crossing, reached);
    }
    if (status != CORE_OK) return status;
    if (crossing->t <= c->t) {
        c->step.h = 0;
        return CORE_OK;
    }
    core_stale(c);
    c->t = crossing->t;
    memcpy(c->y, c->step.end, sizeof c->y);
    return CORE_OK;
}

/* Whether anything may happen in the step that lanes have just taken; where it may, scalar code looks. */
#include "wide_core.h"

#if NG > 0 && NZ == 0

static void lanes_watch(Wide *w, wide t, const wide y[], const wide rates[], WideWatched *seen,
                        unsigned active) {
    wide_inputs_at(w, t, active);
    wide_watch((const wide *[]){y, y + NX, w->u, w->q, &t, rates, rates + NX, w->u_rate},
               (wide *[]){seen->value, seen->rate});
}

/* As `resolved`, `bound` and `rises` in locate.c say of the cubic through both ends, `middle` being known. */
static mask lanes_quiet(const Wide *w, const WideWatched *middle, double share, wide near, int i) {
    wide a = w->left.value[i], b = w->last.value[i], seen = middle->value[i];
    wide da = w->left.rate[i] * w->h, db = w->last.rate[i] * w->h;
    wide c3 = 2 * a - 2 * b + da + db, c2 = -3 * a + 3 * b - 2 * da - db;
    wide error = wide_fabs(seen - (a + share * (da + share * (c2 + share * c3))));
    wide high = wide_greater(a, b), crest = high + CUBIC_CREST * (wide_fabs(da) + wide_fabs(db));
    wide range = wide_greater(high, seen) - wide_lesser(wide_lesser(a, b), seen);
    mask vague = (error > CUBIC_MISSES * range + near) & (wide_greater(crest, seen) + 10 * error > near);
    mask up = (b > near) & (da <= 0) & (db > 0), over = (b > near) | ((da > 0) & (db < 0));
    mask rises = (crest > near) & (((a > near) & up) | (~(a > near) & over));
    return ~(vague | rises);
}

/* The lanes in which no indicator can have risen in the step to `end`, for all that its ends and one instant
 * between them tell; `bend` must be known. */
unsigned wide_uneventful(Wide *w, wide end, unsigned active) {
    const double share = 0.3819660112501051;
    wide y[ROOM(NY)], rates[ROOM(NY)], at = w->t + share * w->h;
    WideWatched middle;
    mask calm = mask_of(active);
    lanes_watch(w, end, w->end, w->end_rates, &w->last, active);
    wide_dense(w, at, y, rates);
    lanes_watch(w, at, y, rates, &middle, active);
    for (int i = 0; i < NG; i++) {
        wide value = wide_fabs(w->last.value[i]), rate = wide_fabs(w->last.rate[i]);
        mask leavable = w->q[NP + model_change_mode[i]] == all(model_change_source[i]);
        wide size = wide_greater(wide_fabs(middle.value[i]), value);
        wide speed = wide_greater(wide_fabs(middle.rate[i]), rate);
        w->now_seen[i] = wide_greater(size, w->seen[i]);
        w->now_fastest[i] = wide_greater(speed, w->fastest[i]);
        wide near = wide_greater(INDICATOR_ROUNDING * w->now_seen[i], all(INDICATOR_FLOOR));
        calm &= is_finite(size + speed);
        calm &= ~leavable | (model_change_timed[i] ? (mask){0} : lanes_quiet(w, &middle, share, near, i));
    }
    return lanes_of(calm);
}

#else

/* Algebraic unknowns are solved for where indicators are looked at, lane by lane. */
unsigned wide_uneventful(Wide *w, wide end, unsigned active) {
    (void)w, (void)end;
    return NG > 0 ? 0 : active;
}

#endif

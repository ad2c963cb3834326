/* Parts of a run between the instants at which what is given switches. */
#include <math.h>

#include "core_state.h"

#ifdef CORE_RECORDS
static const Legs *legs(const Core *c) { return c->legs; }
#else
static const Legs *legs(const Core *c) {
    static const Legs built_in = {MODEL_LEGS, model_leg_begin, model_leg_end, model_leg_longest,
                                  model_leg_jumps};
    (void)c;
    return &built_in;
}
#endif

/* Find the leg again after time was set. */
void core_find_leg(Core *c) {
    const Legs *all = legs(c);
    if (c->leg >= all->count || c->t < all->begin[c->leg]) c->leg = 0;
    while (c->leg + 1 < all->count && c->t >= all->begin[c->leg + 1]) c->leg++;
}

double core_end_of_leg(const Core *c) {
    return c->leg + 1 < legs(c)->count ? legs(c)->end[c->leg] : INFINITY;
}

int core_at_end_of_leg(const Core *c) { return c->t >= core_end_of_leg(c); }

int core_jumps_next(const Core *c) { return legs(c)->jumps[c->leg + 1] != 0; }

double core_longest_step(const Core *c) { return legs(c)->longest[c->leg]; }

/* Go on to where the next leg begins: what jumps there acts, but nothing is fired. */
CoreStatus core_next_leg(Core *c, const Observer *told, int *changed) {
    double seen[ROOM(NREAD)];
    int jumps = core_jumps_next(c);
    c->t = core_end_of_leg(c);
    if (jumps) core_see(c, seen);
    c->t = legs(c)->begin[++c->leg];
    c->last_h = 0;
    core_stale(c);
    return jumps ? core_jump(c, seen, told, changed) : CORE_OK;
}

/* Go on to the leg in which time lies now, or at the end of which. */
CoreStatus core_enter_legs(Core *c, int *changed) {
    double t = c->t;
    CoreStatus status = CORE_OK;
    if (c->leg >= legs(c)->count || t < legs(c)->begin[c->leg]) core_find_leg(c); /* time went back */
    while (status == CORE_OK && c->leg + 1 < legs(c)->count && t >= core_end_of_leg(c))
        status = core_next_leg(c, 0, changed);
    if (c->t < t) {
        c->t = t;
        core_stale(c);
    }
    return status;
}

/* Tell whether there is a next instant at which what is given switches, and when. */
int core_next_time(Core *c, double *time) {
    core_find_leg(c);
    if (c->leg + 1 >= legs(c)->count) return 0;
    *time = legs(c)->begin[c->leg + 1];
    return 1;
}

/* Chattering: which components fire, and whether they do so without end. */
#include <string.h>

#include "core_state.h"

/* Remember that a transition has fired. */
void core_note(Core *c, int change) { c->noted[change] = ++c->notes; }

/* Say which components fired last, by name, each once. */
void core_say_latest(Core *c, int count) {
    const char *last = "", *next;
    long long since = c->notes > count ? c->notes - count : 0;
    for (;; last = next) {
        next = 0;
        for (int i = 0; i < NG; i++) {
            const char *name = model_component[i];
            if (c->noted[i] > since && strcmp(name, last) > 0 && (!next || strcmp(name, next) < 0))
                next = name;
        }
        if (!next) return;
        core_say_more(c, "%s%s", *last ? ", " : "", next);
    }
}

static CoreStatus chatters(Core *c, int count, double since) {
    core_fail(c, CORE_ERROR, "chattering: %g events within %g s at t = %g s, from ", (double)count,
              c->t - since, c->t);
    core_say_latest(c, count);
    core_say_more(c, "; give it a resting speed, hysteresis or some compliance");
    return CORE_ERROR;
}

/* Tell if there are very many events in next to no time, or more in an interval than can be meant. */
CoreStatus core_watch_chatter(Core *c) {
    c->recent[c->landings++ % CHATTER_COUNT] = c->t;
    double oldest = c->recent[c->landings % CHATTER_COUNT];
    if (c->landings >= CHATTER_COUNT && oldest <= c->t && c->t - oldest < CHATTER_WINDOW * c->interval)
        return chatters(c, CHATTER_COUNT, oldest);
    if (c->t - c->mark > c->interval) {
        c->mark = c->t;
        c->mark_count = 0;
    }
    return ++c->mark_count > c->crowd ? chatters(c, c->mark_count, c->mark) : CORE_OK;
}

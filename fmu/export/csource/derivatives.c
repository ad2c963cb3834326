/* Directional and adjoint derivatives by value reference, and rates of outputs. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fmi_common.h"

/* Where the seed or sensitivity of a known (state, input, parameter) stands. */
static double *known(Instance *c, uint32_t ref) {
    if (face_type(ref) != REAL) return NULL;
    if (ref >= REF_STATES && ref < REF_RATES) return &c->x[ref - REF_STATES];
    if (ref >= REF_INPUTS && ref < REF_PARAMETERS) return &c->u[ref - REF_INPUTS];
    if (ref >= REF_PARAMETERS && ref < REF_VARIABLES) return &c->p[ref - REF_PARAMETERS];
    return NULL;
}

/* Where that of an unknown (state, rate, other variable) stands. */
static double *unknown(Instance *c, uint32_t ref) {
    if (face_type(ref) != REAL) return NULL;
    if (ref >= REF_STATES && ref < REF_RATES) return &c->x[ref - REF_STATES];
    if (ref >= REF_RATES && ref < REF_INPUTS) return &c->rates[ref - REF_RATES];
    if (ref >= REF_VARIABLES && ref < REF_MODES) return &c->w[ref - REF_VARIABLES];
    return NULL;
}

typedef double *(*Place)(Instance *c, uint32_t ref);

/* What is sought follows from what is given in ways that are not told by these derivatives. */
static int undefined(Instance *c) {
    if (c->now.phase != INITIALIZATION || NLEAD + NFREE == 0) return !face_ready(c);
    face_refuse(c, "start values are sought here, and no derivatives of that are given");
    return 1;
}

Status face_sensitivities(Instance *c, int adjoint, const uint32_t from[], size_t n, const double seed[],
                          const uint32_t to[], size_t m, double sensitivity[]) {
    Place given = adjoint ? unknown : known, sought = adjoint ? known : unknown;
    if (face_missing(c, n, from, seed) || face_missing(c, m, to, sensitivity) || undefined(c))
        return FMI(Error);
    memset(c->x, 0, sizeof c->x);
    memset(c->u, 0, sizeof c->u);
    memset(c->p, 0, sizeof c->p);
    memset(c->rates, 0, sizeof c->rates);
    memset(c->w, 0, sizeof c->w);
    for (size_t i = 0; i < n; i++) {
        double *place = given(c, from[i]);
        if (!place) return face_bad_reference(c, from[i]);
        if (!isfinite(seed[i])) return face_refuse(c, "a seed is not a finite number");
        *place += seed[i];
    }
    CoreStatus status = adjoint ? core_adjoint(&c->now.core, c->rates, c->w, c->x, c->u, c->p)
                                : core_forward(&c->now.core, c->x, c->u, c->p, c->rates, c->w);
    if (status != CORE_OK) return face_outcome(c, CORE_DISCARD);
    for (size_t i = 0; i < m; i++) {
        const double *place = sought(c, to[i]);
        if (!place) return face_bad_reference(c, to[i]);
        sensitivity[i] = *place;
    }
    return FMI(OK);
}

#define TIME_SHARE \
    1e-6 /* of a second, or of the time: what is apart by it tells how time itself changes numbers */

/* Add what time, and inputs as they go on, change in rates and variables, the states held. */
static CoreStatus add_by_time(Instance *c, Core *there) {
    const double *rates = NULL, *w = NULL;
    double t = core_time(&c->now.core), apart = TIME_SHARE * fmax(1.0, fabs(t));
    for (int side = -1; side <= 1; side += 2) {
        *there = c->now.core;
        CoreStatus status = core_set_time(there, t + side * apart);
        if (status == CORE_OK) status = core_rates(there, &rates);
        for (int i = 0; i < NX && status == CORE_OK; i++) c->rates[i] += side * rates[i] / (2 * apart);
        if (status == CORE_OK) status = core_variables(there, &w);
        for (int i = 0; i < NW && status == CORE_OK; i++) c->w[i] += side * w[i] / (2 * apart);
        if (status != CORE_OK) return status;
    }
    return CORE_OK;
}

Status face_output_derivatives(Instance *c, const uint32_t refs[], const int32_t orders[], size_t n,
                               double values[]) {
    const double *rates = NULL;
    if (face_missing(c, n, refs, values) || face_missing(c, n, orders, orders)) return FMI(Error);
    for (size_t i = 0; i < n; i++)
        if (orders[i] != 1) return face_refuse(c, "only first derivatives of outputs are given");
    if (!n) return FMI(OK);
    if (undefined(c)) return FMI(Error);
    Core *there = malloc(sizeof *there);
    if (!there) return face_refuse(c, "out of memory");
    CoreStatus status = core_rates(&c->now.core, &rates);
    if (status == CORE_OK) {
        memcpy(c->x, rates, sizeof c->x);
        memset(c->u, 0, sizeof c->u);
        memset(c->p, 0, sizeof c->p);
        status = core_forward(&c->now.core, c->x, c->u, c->p, c->rates, c->w);
    }
    if (status == CORE_OK) status = add_by_time(c, there);
    free(there);
    if (status != CORE_OK) return face_outcome(c, CORE_DISCARD);
    for (size_t i = 0; i < n; i++) {
        const double *place = unknown(c, refs[i]);
        if (!place) return face_bad_reference(c, refs[i]);
        values[i] = *place;
    }
    return FMI(OK);
}

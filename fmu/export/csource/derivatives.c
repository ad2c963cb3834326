/* Directional and adjoint derivatives by value reference. */
#include <math.h>
#include <string.h>

#include "fmi_common.h"

/* Where the seed or sensitivity of a known (state, input, parameter) stands. */
static double *known(Instance *c, uint32_t ref) {
    if (ref >= REF_STATES && ref < REF_RATES) return &c->x[ref - REF_STATES];
    if (ref >= REF_INPUTS && ref < REF_PARAMETERS) return &c->u[ref - REF_INPUTS];
    if (ref >= REF_PARAMETERS && ref < REF_VARIABLES) return &c->p[ref - REF_PARAMETERS];
    return NULL;
}

/* Where that of an unknown (state, rate, other variable) stands. */
static double *unknown(Instance *c, uint32_t ref) {
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

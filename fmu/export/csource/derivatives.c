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

static void clear_seeds(Instance *c) {
    memset(c->x, 0, sizeof c->x);
    memset(c->u, 0, sizeof c->u);
    memset(c->p, 0, sizeof c->p);
    memset(c->rates, 0, sizeof c->rates);
    memset(c->w, 0, sizeof c->w);
}

/* What is sought follows from what is given in ways that are not told by these derivatives. */
static int sought(Instance *c, const char *function) {
    if (c->now.phase != INITIALIZATION || NLEAD + NFREE == 0) return face_ready(c, function) != FACE_OK;
    face_refuse(c, function, "start values are sought here, and no derivatives of that are given");
    return 1;
}

typedef double *(*Place)(Instance *c, uint32_t ref);

static FaceStatus put(Instance *c, const char *function, Place place, const uint32_t refs[], size_t n,
                      const double values[]) {
    for (size_t i = 0; i < n; i++) {
        double *where = place(c, refs[i]);
        if (!where) return face_bad_reference(c, function, refs[i]);
        if (!isfinite(values[i])) return face_refuse(c, function, "a seed is not a finite number");
        *where += values[i];
    }
    return FACE_OK;
}

static FaceStatus take(Instance *c, const char *function, Place place, const uint32_t refs[], size_t n,
                       double values[]) {
    for (size_t i = 0; i < n; i++) {
        const double *where = place(c, refs[i]);
        if (!where) return face_bad_reference(c, function, refs[i]);
        values[i] = *where;
    }
    return FACE_OK;
}

FaceStatus face_forward(Instance *c, const char *function, const uint32_t unknowns[], size_t nu,
                        const uint32_t knowns[], size_t nk, const double seed[], double sensitivity[]) {
    if (face_missing(nu, unknowns, sensitivity) || face_missing(nk, knowns, seed))
        return face_refuse(c, function, "an array is missing");
    if (sought(c, function)) return FACE_ERROR;
    clear_seeds(c);
    if (put(c, function, known, knowns, nk, seed) != FACE_OK) return FACE_ERROR;
    if (core_forward(&c->now.core, c->x, c->u, c->p, c->rates, c->w) != CORE_OK)
        return face_outcome(c, function, CORE_DISCARD);
    return take(c, function, unknown, unknowns, nu, sensitivity);
}

FaceStatus face_adjoint(Instance *c, const char *function, const uint32_t unknowns[], size_t nu,
                        const uint32_t knowns[], size_t nk, const double seed[], double sensitivity[]) {
    if (face_missing(nu, unknowns, seed) || face_missing(nk, knowns, sensitivity))
        return face_refuse(c, function, "an array is missing");
    if (sought(c, function)) return FACE_ERROR;
    clear_seeds(c);
    if (put(c, function, unknown, unknowns, nu, seed) != FACE_OK) return FACE_ERROR;
    if (core_adjoint(&c->now.core, c->rates, c->w, c->x, c->u, c->p) != CORE_OK)
        return face_outcome(c, function, CORE_DISCARD);
    return take(c, function, known, knowns, nk, sensitivity);
}

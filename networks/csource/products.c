/* Derivatives of rates and variables, algebraic unknowns following. */
#include "core_state.h"

static CoreStatus prepared(Core *c) {
    CoreStatus status = core_rates(c, 0);
    if (status != CORE_OK || NZ == 0) return status;
    if (core_algebra_factor(c, c->t, c->y)) return CORE_OK;
    core_say(c, "the algebraic equations have no unique solution here");
    return CORE_DISCARD;
}

static void forward(Core *c, const double x[], const double z[], const double p[]) {
    const double *arg[ROOM(MODEL_ARGS)] = {0};
    double *res[ROOM(MODEL_RESULTS)] = {c->results}, tuned = 0;
    for (int i = 0; i < NP; i++)
        if (p[i] != 0) tuned = 1;
    core_arguments(c, c->t, c->y, arg);
    arg[4] = &c->t;
    arg[5] = x;
    arg[6] = z;
    arg[7] = c->of_u;
    arg[8] = p;
    arg[9] = &tuned;
    model_forward(arg, res, c->iw, c->w, 0);
}

CoreStatus core_forward(Core *c, const double x[], const double u[], const double p[], double rates[],
                        double w[]) {
    CoreStatus status = prepared(c);
    if (status != CORE_OK) return status;
    for (int i = 0; i < NA; i++) c->of_u[i] = 0;
    for (int i = 0; i < NU; i++) c->of_u[model_input_at[i]] = model_input_sign[i] * u[i];
    for (int i = 0; i < NY; i++) c->of_y[i] = 0;
    forward(c, x, c->of_y + NX, p);
    if (NZ > 0) {
        for (int i = NX; i < NY; i++) c->of_y[i] = -c->results[i];
        core_factor_solve(&c->algebra, c->of_y, c->full);
        /* Rows of states are those of the identity: x is not in this system, its effect is in the results. */
        forward(c, x, c->of_y + NX, p);
    }
    for (int i = 0; i < NX; i++) rates[i] = c->results[i];
    for (int i = 0; i < NW; i++) w[i] = c->results[NY + i];
    return CORE_OK;
}

static void adjoint(Core *c) {
    const double *arg[ROOM(MODEL_ARGS)] = {0};
    double *res[ROOM(MODEL_RESULTS)] = {c->of_y, c->of_y + NX, c->of_u, c->of_p};
    core_arguments(c, c->t, c->y, arg);
    arg[4] = &c->t;
    arg[5] = c->seeds;
    model_adjoint(arg, res, c->iw, c->w, 0);
}

CoreStatus core_adjoint(Core *c, const double rates[], const double w[], double x[], double u[], double p[]) {
    CoreStatus status = prepared(c);
    if (status != CORE_OK) return status;
    for (int i = 0; i < NX; i++) c->seeds[i] = rates[i];
    for (int i = NX; i < NY; i++) c->seeds[i] = 0;
    for (int i = 0; i < NW; i++) c->seeds[NY + i] = w[i];
    adjoint(c);
    if (NZ > 0) {
        for (int i = 0; i < NX; i++) c->of_y[i] = 0;
        core_factor_solve_transposed(&c->algebra, c->of_y, c->full);
        for (int i = NX; i < NY; i++) c->seeds[i] = -c->of_y[i];
        adjoint(c);
    }
    for (int i = 0; i < NX; i++) x[i] += c->of_y[i];
    for (int i = 0; i < NU; i++) u[i] += model_input_sign[i] * c->of_u[model_input_at[i]];
    for (int i = 0; i < NP; i++) p[i] += c->of_p[i];
    return CORE_OK;
}

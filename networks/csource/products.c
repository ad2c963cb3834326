/* Derivatives of rates and variables, algebraic unknowns following. */
#include "core_state.h"

static CoreStatus prepared(Core *c) {
    CoreStatus status = core_rates(c, 0);
    if (status != CORE_OK || NZ == 0) return status;
    if (core_algebra_factor(c, c->t, c->y)) return CORE_OK;
    return core_fail(c, CORE_DISCARD, "the algebraic equations have no unique solution here");
}

static void forward(Core *c, const double x[], const double z[], const double p[]) {
    double tuned = core_largest(p, NP) > 0;
    Call call = {.arg = {[5] = x, z, c->of_u, p, &tuned}, .res = {c->results}};
    core_evaluate(c, model_forward, c->t, c->y, &call);
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
    Call call = {.arg = {[5] = c->seeds}, .res = {c->of_y, c->of_y + NX, c->of_u, c->of_p}};
    core_evaluate(c, model_adjoint, c->t, c->y, &call);
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

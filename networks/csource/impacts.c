/* What acts at one instant: impulses, new values, and the completion of blocks that modes leave singular. */
#include <math.h>
#include <string.h>

#include "core_state.h"

/* The directions of which a matrix, stored by columns, makes next to nothing, orthonormal, one after the
 * other. Returns how many there are. */
static int null_space(double columns[], double basis[], int n) {
    double strength[ROOM(BLOCK)], most = 1;
    int count = 0;
    core_jacobi(columns, basis, n, n);
    for (int k = 0; k < n; k++) {
        strength[k] = sqrt(core_dot(columns + k * n, columns + k * n, n));
        most = fmax(most, strength[k]);
    }
    for (int k = 0; k < n; k++)
        if (strength[k] <= BLOCK_WEAK * most)
            memmove(basis + count++ * n, basis + k * n, (size_t)n * sizeof *basis);
    return count;
}

static int regular(double lu[], int n) {
    int pivot[ROOM(BLOCK)];
    double least = 1;
    if (!core_dense_factor(lu, n, pivot)) return 0;
    for (int i = 0; i < n; i++) least = fmin(least, fabs(lu[i * n + i]));
    return least > BLOCK_REGULAR;
}

/* Fill in what makes a singular matrix regular such that solutions have least norm. Marks loose unknowns. */
static int completion(Core *c, const double matrix[], int n, double result[], int loose[]) {
    double *work = c->square[0], *left = c->square[1], *right = c->square[2];
    double scale[ROOM(BLOCK)] = {0}, freed[ROOM(BLOCK)] = {0};
    for (int i = 0; i < n * n; i++) {
        result[i] = 0;
        scale[i % n] = fmax(scale[i % n], fabs(matrix[i]));
    }
    for (int i = 0; i < n; i++)
        if (scale[i] == 0) scale[i] = 1;
    for (int i = 0; i < n * n; i++) left[i] = work[i] = matrix[i] / scale[i % n];
    if (regular(work, n)) return 0;
    for (int i = 0; i < n * n; i++) work[i % n * n + i / n] = left[i];
    int weak = null_space(left, right, n);
    if (!weak) return 0;
    int others = null_space(work, left, n);
    for (int k = 0; k < weak && k < others; k++)
        for (int j = 0; j < n; j++) {
            freed[j] = fmax(freed[j], fabs(right[k * n + j]));
            for (int i = 0; i < n; i++) result[j * n + i] += scale[i] * left[k * n + i] * right[k * n + j];
        }
    for (int j = 0; j < n; j++) loose[j] = freed[j] > BLOCK_LOOSE * core_largest(freed, n);
    return 1;
}

CoreStatus core_complete(Core *c) {
    double *q = c->q + NP + NM + NI;
    int loose[ROOM(BLOCK)], at = 0, first = 0;
    c->adrift = 0;
    if (NB == 0) return CORE_OK;
    core_evaluate(c, model_blocks, c->t, c->y, &(Call){.res = {c->blocks}});
    for (int block = 0; block < NB; block++) {
        int n = model_block_size[block];
        for (int i = 0; i < n * n; i++)
            if (!isfinite(c->blocks[at + i]))
                return core_fail(c, CORE_DISCARD, "%s: slopes are not finite", model_block_label[block]);
        if (completion(c, c->blocks + at, n, q + at, loose)) {
            int drifts = 0;
            for (int i = 0; i < n; i++) drifts |= loose[i] && model_block_rate[first + i];
            if (drifts) c->adrift = block + 1;
            else c->shared[block] = 1;
        }
        at += n * n;
        first += n;
    }
    return CORE_OK;
}

/* What stands in for a mode while an impulse acts, -1 if it is itself. */
int core_stands_in(int mode, int value) { return model_in_shock[model_in_shock_start[mode] + value]; }

/* Whether a transition is that of a contact which holds, in an impulse too. */
int core_holds(const Core *c, int i) {
    int mode = model_change_mode[i], target = model_change_target[i];
    return model_change_impulse[i] >= 0 && core_mode(c, mode) == target && core_stands_in(mode, target) >= 0;
}

/* Contacts that already hold and pass a shock on; none if a blow rebounds, which strikes one by one. */
static int partners(Core *c, int shocks[], int stays[], int count) {
    int struck[ROOM(NM)] = {0}, total = count;
    for (int k = 0; k < count; k++) {
        stays[k] = 0;
        struck[model_change_mode[shocks[k]]] = 1;
    }
    for (int k = 0; k < count; k++)
        if (core_stands_in(model_change_mode[shocks[k]], model_change_target[shocks[k]]) < 0) return count;
    for (int i = 0; i < NG; i++) {
        if (struck[model_change_mode[i]] || !core_holds(c, i)) continue;
        shocks[total] = i;
        stays[total++] = 1;
    }
    return total;
}

/* What a unit of one impulse does to the states. */
static void response(Core *c, int impulse, double step[]) {
    for (int i = 0; i < NY; i++) c->value[i] = 0;
    for (int k = model_response_column[impulse]; k < model_response_column[impulse + 1]; k++)
        c->value[model_response_row[k]] = c->response[k];
    for (int i = 0; i < NX; i++) step[i] = c->value[i];
    if (NZ == 0) return;
    for (int i = 0; i < NX; i++) c->value[i] = 0;
    core_factor_solve(&c->algebra, c->value, c->full);
    for (int j = NX; j < NY; j++)
        for (int k = model_slope_column[j]; k < model_slope_column[j + 1]; k++)
            if (model_slope_row[k] < NX) step[model_slope_row[k]] -= c->slope[k] * c->value[j];
}

static CoreStatus immovable(Core *c, const int shocks[], const double effect[], int count) {
    int any = 0;
    for (int i = 0; i < count; i++) {
        int moves = 0;
        for (int j = 0; j < count; j++) moves |= effect[j * count + i] != 0;
        if (moves) continue;
        if (any++) core_say_more(c, ", %s", model_component[shocks[i]]);
        else core_fail(c, CORE_ERROR, "%s", model_component[shocks[i]]);
    }
    if (!any) return CORE_OK;
    core_say_more(
        c, ": a shock meets a motion that is prescribed on both sides; let a Mass move freely, or a Spring "
           "yield, on one of them");
    return CORE_ERROR;
}

/* Find the impulses that give the wanted velocities, none of them pulling, and let them act. */
static CoreStatus collide(Core *c, int shocks[], int stays[], double size[], int *count) {
    double *steps = c->struck, *effect = steps + ROOM(NS) * ROOM(NX), *right = effect + ROOM(NS) * ROOM(NS);
    double wanted[ROOM(NS)];
    for (;;) {
        int n = *count, weakest = 0;
        for (int k = 0; k < n; k++) {
            int i = shocks[k];
            wanted[k] = c->expressions[model_change_after[i]] - c->expressions[model_change_velocity[i]];
            response(c, model_change_impulse[i], steps + k * NX);
        }
        for (int k = 0; k < n * n; k++) effect[k] = 0;
        for (int x = 0; x < NX; x++)
            for (int e = model_velocity_column[x]; e < model_velocity_column[x + 1]; e++)
                for (int k = 0; k < n; k++) {
                    if (model_change_shock[shocks[k]] != model_velocity_row[e]) continue;
                    for (int j = 0; j < n; j++) effect[j * n + k] += c->velocity[e] * steps[j * NX + x];
                }
        CoreStatus status = immovable(c, shocks, effect, n);
        if (status != CORE_OK) return status;
        core_least_norm(effect, right, n, n, 0, wanted, size);
        for (int k = 1; k < n; k++)
            if (size[k] < size[weakest]) weakest = k;
        if (n == 1 || size[weakest] >= 0) break;
        memmove(shocks + weakest, shocks + weakest + 1, (size_t)(n - 1 - weakest) * sizeof *shocks);
        memmove(stays + weakest, stays + weakest + 1, (size_t)(n - 1 - weakest) * sizeof *stays);
        *count = n - 1;
    }
    for (int k = 0; k < *count; k++)
        for (int x = 0; x < NX; x++) c->y[x] += size[k] * steps[k * NX + x];
    return CORE_OK;
}

/* Let those modes hold that stand in for others while an impulse acts. */
CoreStatus core_stand_in(Core *c, Kept *kept) {
    double *modes = core_modes(c);
    memcpy(kept->modes, modes, (NM + NI + NK) * sizeof *modes);
    for (int m = 0; m < NM; m++)
        if (core_stands_in(m, (int)modes[m]) >= 0) modes[m] = core_stands_in(m, (int)modes[m]);
    return core_complete(c);
}

void core_go_back(Core *c, const Kept *kept) {
    memcpy(core_modes(c), kept->modes, (NM + NI + NK) * sizeof *kept->modes);
}

/* Let shocks act, and the contacts that pass them on, which are added to the list. */
CoreStatus core_strike(Core *c, int shocks[], int stays[], double impulses[], int *count) {
    Kept kept;
    *count = partners(c, shocks, stays, *count);
    CoreStatus status = core_stand_in(c, &kept);
    if (status == CORE_OK)
        core_evaluate(c, model_shock, c->t, c->y, &(Call){.res = {c->response, c->velocity}});
    if (status == CORE_OK && NZ > 0 && !core_algebra_factor(c, c->t, c->y))
        status = core_fail(c, CORE_DISCARD, "a shock leaves the algebraic equations without a solution");
    if (status == CORE_OK) status = collide(c, shocks, stays, impulses, count);
    core_go_back(c, &kept);
    return status;
}

/* Give variables new values: states directly, others by the least change of states; what was seen follows. */
void core_reset_variables(Core *c, const int changes[], int count, double seen[]) {
    double given[ROOM(NO)] = {0}, wanted[ROOM(NO)], step[ROOM(NX)];
    int row[ROOM(NO)] = {0}, rows = 0;
    for (int i = 0; i < NO; i++) row[i] = -1;
    for (int k = 0; k < count; k++)
        for (int r = model_reset_start[changes[k]]; r < model_reset_start[changes[k] + 1]; r++) {
            double value = model_reset_sign[r] * c->expressions[model_reset_value[r]];
            if (model_reset_read[r] >= 0) seen[model_reset_read[r]] = value;
            if (model_reset_state[r] >= 0) c->y[model_reset_state[r]] = value;
            else {
                int other = model_reset_other[r];
                if (row[other] < 0) row[other] = rows++;
                given[other] = value;
            }
        }
    if (!rows) return;
    double *right = c->moved + ROOM(NO) * ROOM(NX);
    core_evaluate(c, model_reset, c->t, c->y, &(Call){.res = {c->others, c->other}});
    for (int i = 0; i < NO; i++)
        if (row[i] >= 0) wanted[row[i]] = given[i] - c->others[i];
    for (int i = 0; i < rows * NX; i++) c->moved[i] = 0;
    for (int x = 0; x < NX; x++)
        for (int e = model_other_column[x]; e < model_other_column[x + 1]; e++)
            if (row[model_other_row[e]] >= 0) c->moved[row[model_other_row[e]] * NX + x] = c->other[e];
    core_least_norm(c->moved, right, NX, rows, 1, wanted, step);
    for (int x = 0; x < NX; x++) c->y[x] += step[x];
}

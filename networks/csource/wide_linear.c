/* Linear equations of all lanes at once, by LU with one order of rows for all: a row is taken as long as its
 * pivot is not much smaller than the greatest of its column, in any lane (threshold pivoting). */
#include "wide_core.h"

#define FAIR 0.1    /* share of the greatest above which the row in place is taken */
#define FEEBLE 1e-3 /* share below which a lane cannot go with the others */

/* The row whose pivot is the best share of the greatest in the lane where that is least. */
static int best_row(const wide column[], wide greatest, int k, int n, unsigned active) {
    int best = k;
    double most = -1;
    for (int i = k; i < n; i++) {
        wide share = wide_fabs(column[i]) / greatest;
        double least = INFINITY;
        for (int lane = 0; lane < LANES; lane++)
            if (active >> lane & 1) least = fmin(least, share[lane]);
        if (least > most) {
            most = least;
            best = i;
        }
    }
    return best;
}

/* Factor matrices stored by columns in place. Returns the lanes in which that is to be trusted. */
unsigned wide_factor(wide lu[], int n, int pivot[], unsigned active) {
    for (int k = 0; k < n; k++) {
        wide *column = lu + k * n, greatest = wide_fabs(column[k]);
        for (int i = k + 1; i < n; i++) greatest = wide_greater(wide_fabs(column[i]), greatest);
        pivot[k] = k;
        if (active & ~lanes_of(wide_fabs(column[k]) >= FAIR * greatest)) {
            int best = pivot[k] = best_row(column, greatest, k, n, active);
            for (int j = 0; best != k && j < n; j++) {
                wide kept = lu[j * n + k];
                lu[j * n + k] = lu[j * n + best];
                lu[j * n + best] = kept;
            }
        }
        wide size = wide_fabs(column[k]);
        active &= lanes_of((size >= FEEBLE * greatest) & (size > 0) & is_finite(greatest));
        if (!active) return 0;
        wide inverse = 1 / column[k];
        for (int i = k + 1; i < n; i++) column[i] *= inverse;
        for (int j = k + 1; j < n; j++) {
            wide factor_ = lu[j * n + k];
            for (int i = k + 1; i < n; i++) lu[j * n + i] -= column[i] * factor_;
        }
        column[k] = inverse;
    }
    return active;
}

/* Solve in place, from what `wide_factor` has left, with inverses on the diagonal. */
void wide_solve(const wide lu[], int n, const int pivot[], wide b[]) {
    for (int k = 0; k < n; k++) {
        wide kept = b[k];
        b[k] = b[pivot[k]];
        b[pivot[k]] = kept;
    }
    for (int k = 0; k < n; k++)
        for (int i = k + 1; i < n; i++) b[i] -= lu[k * n + i] * b[k];
    for (int k = n - 1; k >= 0; k--) {
        b[k] *= lu[k * n + k];
        for (int i = 0; i < k; i++) b[i] -= lu[k * n + i] * b[k];
    }
}

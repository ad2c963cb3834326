/* Linear equations of all lanes at once, by LU. Each lane keeps a row in its place as long as the pivot is
 * not much smaller than the greatest of its column (threshold pivoting), whatever its neighbours do. */
#include "wide_core.h"

#define FAIR 0.1 /* share of the greatest above which a row stays */

static void wide_exchange(wide *a, wide *b, mask where) {
    wide kept = *a;
    *a = chosen(where, *b, *a);
    *b = chosen(where, kept, *b);
}

/* The row with the greatest pivot in those lanes, k in the others. */
static wide best_rows(const wide column[], int k, int n, mask where) {
    wide best = wide_fabs(column[k]), row = all(k);
    for (int i = k + 1; i < n; i++) {
        mask better = where & (wide_fabs(column[i]) > best);
        best = chosen(better, wide_fabs(column[i]), best);
        row = chosen(better, all(i), row);
    }
    return row;
}

/* Factor matrices stored by columns in place. Returns the lanes in which they are regular. */
unsigned wide_factor(wide lu[], int n, Pivots *pivots, unsigned active) {
    for (int k = 0; k < n; k++) {
        wide *column = lu + k * n, greatest = wide_fabs(column[k]);
        for (int i = k + 1; i < n; i++) greatest = wide_greater(wide_fabs(column[i]), greatest);
        mask unfair = wide_fabs(column[k]) < FAIR * greatest;
        pivots->moved[k] = lanes_of(unfair) & active;
        if (pivots->moved[k]) {
            wide row = pivots->row[k] = best_rows(column, k, n, unfair);
            for (int i = k + 1; i < n; i++) {
                mask here = row == all(i);
                for (int j = 0; lanes_of(here) && j < n; j++)
                    wide_exchange(lu + j * n + k, lu + j * n + i, here);
            }
        }
        active &= lanes_of((wide_fabs(column[k]) > 0) & is_finite(greatest));
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
void wide_solve(const wide lu[], int n, const Pivots *pivots, wide b[]) {
    for (int k = 0; k < n; k++)
        for (int i = k + 1; pivots->moved[k] && i < n; i++)
            wide_exchange(b + k, b + i, pivots->row[k] == all(i));
    for (int k = 0; k < n; k++)
        for (int i = k + 1; i < n; i++) b[i] -= lu[k * n + i] * b[k];
    for (int k = n - 1; k >= 0; k--) {
        b[k] *= lu[k * n + k];
        for (int i = 0; i < k; i++) b[i] -= lu[k * n + i] * b[k];
    }
}

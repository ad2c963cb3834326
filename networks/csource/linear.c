/* Linear equations: the matrix of a step without states that follow another one (see rosenbrock.c), by LU
 * with row pivoting or, where large, by sparse Householder QR on a fixed pattern; and solutions of least norm
 * by one-sided Jacobi rotations (Golub, Van Loan, Matrix Computations, 5.2, 8.6). */
#include <float.h>
#include <math.h>
#include <string.h>

#include "core_state.h"

#define SWEEPS 60

double core_dot(const double *a, const double *b, int n) {
    double sum = 0;
    for (int i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

double core_largest(const double *a, int n) {
    double largest = 0;
    for (int i = 0; i < n; i++) largest = fmax(largest, fabs(a[i]));
    return largest;
}

static void exchange(double b[], int i, int j) {
    double kept = b[i];
    b[i] = b[j];
    b[j] = kept;
}

/* Factor a matrix stored by columns in place. Returns 0 if it is singular or not finite. */
int core_dense_factor(double lu[], int n, int pivot[]) {
    for (int k = 0; k < n; k++) {
        double *column = lu + k * n;
        int best = k;
        for (int i = k + 1; i < n; i++)
            if (fabs(column[i]) > fabs(column[best])) best = i;
        pivot[k] = best;
        if (!(fabs(column[best]) > 0) || !(fabs(column[best]) <= DBL_MAX)) return 0;
        if (best != k)
            for (int j = 0; j < n; j++) exchange(lu + j * n, k, best);
        for (int i = k + 1; i < n; i++) column[i] /= column[k];
        for (int j = k + 1; j < n; j++) {
            double factor_ = lu[j * n + k];
            if (factor_ != 0)
                for (int i = k + 1; i < n; i++) lu[j * n + i] -= column[i] * factor_;
        }
    }
    return 1;
}

#if MODEL_SPARSE

static void reflect(const Factor *f, int column, double x[]) {
    int begin = model_v_column[column], end = model_v_column[column + 1];
    double size = 0;
    for (int k = begin; k < end; k++) size += f->v[k] * x[model_v_row[k]];
    for (int k = begin; k < end; k++) x[model_v_row[k]] -= f->v[k] * size;
}

/* Columns of v have the length of a diagonal of the unit square; r holds the inverse of its diagonal. */
int core_factor(Factor *f, const double entries[], double x[]) {
    memset(x, 0, NROWS * sizeof *x);
    for (int c = 0; c < NF; c++) {
        int column = model_order[c], last = model_r_column[c + 1] - 1;
        for (int k = model_reduced_column[column]; k < model_reduced_column[column + 1]; k++)
            x[model_place[model_reduced_row[k]]] = entries[k];
        for (int k = model_r_column[c]; k < last; k++) {
            reflect(f, model_r_row[k], x);
            f->r[k] = x[model_r_row[k]];
            x[model_r_row[k]] = 0;
        }
        double rest = 0, head = x[c], size, scale = 0;
        for (int k = model_v_column[c]; k < model_v_column[c + 1]; k++)
            if (model_v_row[k] != c) rest += x[model_v_row[k]] * x[model_v_row[k]];
        size = sqrt(head * head + rest);
        if (!(size > 0) || !(size <= DBL_MAX)) return 0;
        f->r[last] = 1 / head;
        if (rest > 0) {
            x[c] = head <= 0 ? head - size : -rest / (head + size);
            scale = sqrt(2 / (x[c] * x[c] + rest));
            f->r[last] = 1 / size;
        }
        for (int k = model_v_column[c]; k < model_v_column[c + 1]; k++) {
            f->v[k] = scale * x[model_v_row[k]];
            x[model_v_row[k]] = 0;
        }
    }
    return 1;
}

void core_factor_solve(const Factor *f, double b[], double x[]) {
    memset(x, 0, NROWS * sizeof *x);
    for (int i = 0; i < NF; i++) x[model_place[i]] = b[model_kept[i]];
    for (int c = 0; c < NF; c++) reflect(f, c, x);
    for (int c = NF - 1; c >= 0; c--) {
        int last = model_r_column[c + 1] - 1;
        x[c] *= f->r[last];
        for (int k = model_r_column[c]; k < last; k++) x[model_r_row[k]] -= f->r[k] * x[c];
        b[model_kept[model_order[c]]] = x[c];
    }
}

void core_factor_solve_transposed(const Factor *f, double b[], double x[]) {
    memset(x, 0, NROWS * sizeof *x);
    for (int c = 0; c < NF; c++) {
        int last = model_r_column[c + 1] - 1;
        double sum = b[model_kept[model_order[c]]];
        for (int k = model_r_column[c]; k < last; k++) sum -= f->r[k] * x[model_r_row[k]];
        x[c] = sum * f->r[last];
    }
    for (int c = NF - 1; c >= 0; c--) reflect(f, c, x);
    for (int i = 0; i < NF; i++) b[model_kept[i]] = x[model_place[i]];
}

#else

int core_factor(Factor *f, const double entries[], double full[]) {
    (void)full;
    memset(f->lu, 0, NF * NF * sizeof *f->lu);
    for (int j = 0; j < NF; j++)
        for (int k = model_reduced_column[j]; k < model_reduced_column[j + 1]; k++)
            f->lu[j * NF + model_reduced_row[k]] = entries[k];
    return core_dense_factor(f->lu, NF, f->pivot);
}

void core_factor_solve(const Factor *f, double b[], double x[]) {
    for (int i = 0; i < NF; i++) x[i] = b[model_kept[i]];
    for (int k = 0; k < NF; k++) exchange(x, k, f->pivot[k]);
    for (int k = 0; k < NF; k++)
        for (int i = k + 1; i < NF; i++) x[i] -= f->lu[k * NF + i] * x[k];
    for (int k = NF - 1; k >= 0; k--) {
        x[k] /= f->lu[k * NF + k];
        for (int i = 0; i < k; i++) x[i] -= f->lu[k * NF + i] * x[k];
    }
    for (int i = 0; i < NF; i++) b[model_kept[i]] = x[i];
}

void core_factor_solve_transposed(const Factor *f, double b[], double x[]) {
    for (int i = 0; i < NF; i++) x[i] = b[model_kept[i]];
    for (int k = 0; k < NF; k++) {
        for (int i = 0; i < k; i++) x[k] -= f->lu[k * NF + i] * x[i];
        x[k] /= f->lu[k * NF + k];
    }
    for (int k = NF - 1; k >= 0; k--)
        for (int i = k + 1; i < NF; i++) x[k] -= f->lu[k * NF + i] * x[i];
    for (int k = NF - 1; k >= 0; k--) exchange(x, k, f->pivot[k]);
    for (int i = 0; i < NF; i++) b[model_kept[i]] = x[i];
}

#endif

static void rotate(double a[], double b[], int n, double cosine, double sine) {
    for (int i = 0; i < n; i++) {
        double kept = a[i];
        a[i] = cosine * kept - sine * b[i];
        b[i] = sine * kept + cosine * b[i];
    }
}

/* Turn `count` columns until they are orthogonal: A right = U S. `right` begins as the identity. */
void core_jacobi(double columns[], double right[], int length, int count) {
    for (int i = 0; i < count * count; i++) right[i] = i % (count + 1) == 0;
    for (int sweep = 0, turned = 1; turned && sweep < SWEEPS; sweep++) {
        turned = 0;
        for (int i = 0; i < count; i++)
            for (int j = i + 1; j < count; j++) {
                double *a = columns + i * length, *b = columns + j * length;
                double aa = core_dot(a, a, length), bb = core_dot(b, b, length), ab = core_dot(a, b, length);
                if (!(fabs(ab) > 1e-15 * sqrt(aa * bb)) || fabs(ab) < DBL_MIN) continue;
                double lean = (bb - aa) / (2 * ab);
                double tangent = (lean >= 0 ? 1 : -1) / (fabs(lean) + sqrt(1 + lean * lean));
                double cosine = 1 / sqrt(1 + tangent * tangent);
                rotate(a, b, length, cosine, cosine * tangent);
                rotate(right + i * count, right + j * count, count, cosine, cosine * tangent);
                turned = 1;
            }
    }
}

/* Solve in the sense of least squares and least norm: columns x = b, or, transposed, columns' x = b. */
void core_least_norm(double columns[], double right[], int length, int count, int transposed,
                     const double b[], double x[]) {
    double strongest = 0;
    int size = transposed ? length : count;
    core_jacobi(columns, right, length, count);
    for (int k = 0; k < count; k++)
        strongest = fmax(strongest, core_dot(columns + k * length, columns + k * length, length));
    for (int i = 0; i < size; i++) x[i] = 0;
    for (int k = 0; k < count; k++) {
        const double *left = columns + k * length, *turn = right + k * count;
        double strength = core_dot(left, left, length);
        if (!(strength > IMPACT_RANK * IMPACT_RANK * strongest)) continue;
        double share = (transposed ? core_dot(turn, b, count) : core_dot(left, b, length)) / strength;
        for (int i = 0; i < size; i++) x[i] += share * (transposed ? left : turn)[i];
    }
}

/* The passes of the filter and the smoother through one record, for every site alone: stacked_passes.py has
 * the same in NumPy. Arrays are those of `Course`, `Roughness` and `Passed`, the last axis running fastest.
 */
#include <string.h>

#if defined(_WIN32)
#define FACE __declspec(dllexport)
#else
#define FACE __attribute__((visibility("default")))
#endif

typedef long long Count;

typedef struct {
    Count points, states, order, sites, outputs, columns;
    const double *map, *here, *there, *to_x, *to_f, *values, *measured, *kept, *added, *start;
} Course;

/* Results of all records, `record` of `records` being this one, of so many columns. */
typedef struct {
    Count records, record, columns, keep;
    double *innovations, *spreads, *gains, *rows, *ahead;
} Passed;

FACE Count passes_size(int kind) { return (Count)(kind ? sizeof(Passed) : sizeof(Course)); }

/* (x, force) from point k to the next: `T`, and what noise adds to their covariance: `Q`. */
static void transition(const Course *c, Count k, Count site, double *T, double *Q) {
    const Count n = c->states, order = c->order, size = n + order, at = k * c->sites + site;
    const double *kept = c->kept + at * order * order, *added = c->added + at * order * order;

    memset(T, 0, (size_t)(size * size) * sizeof *T);
    for (Count i = 0; i < n; i++) {
        const Count place = (k * n + i) * c->sites + site;
        memcpy(T + i * size, c->map + (k * n + i) * n, (size_t)n * sizeof *T);
        for (Count j = 0; j < order; j++) T[i * size + n + j] = c->there[place] * kept[j];
        T[i * size + n] += c->here[place];
    }
    for (Count i = 0; i < order; i++)
        memcpy(T + (n + i) * size + n, kept + i * order, (size_t)order * sizeof *T);
    if (!Q) return;
    for (Count i = 0; i < size; i++)
        for (Count j = 0; j < size; j++) {
            const double left = i < n ? c->there[(k * n + i) * c->sites + site] : 1.0;
            const double right = j < n ? c->there[(k * n + j) * c->sites + site] : 1.0;
            Q[i * size + j] = left * right * added[(i < n ? 0 : i - n) * order + (j < n ? 0 : j - n)];
        }
}

/* The row of an output at a point: what it sees of states and force. */
static void row_of(const Course *c, Count k, Count output, Count site, double *h) {
    const Count n = c->states, at = k * c->outputs + output;

    memset(h, 0, (size_t)(n + c->order) * sizeof *h);
    memcpy(h, c->to_x + at * n, (size_t)n * sizeof *h);
    h[n] = c->to_f[at * c->sites + site];
}

/* y += a x */
static void add(Count count, double a, const double *restrict x, double *restrict y) {
    for (Count i = 0; i < count; i++) y[i] += a * x[i];
}

static double dot(Count count, const double *x, const double *y) {
    double sum = 0;
    for (Count i = 0; i < count; i++) sum += x[i] * y[i];
    return sum;
}

/* sum over i of x[i] times row i of A, of so many columns */
static void rows_summed(Count rows, Count columns, const double *x, const double *A, double *sum) {
    memset(sum, 0, (size_t)columns * sizeof *sum);
    for (Count i = 0; i < rows; i++)
        if (x[i] != 0) add(columns, x[i], A + i * columns, sum);
}

static void seen(const Course *c, const Passed *p, Count k, Count j, Count site, double *W, double *h,
                 double *foreseen) {
    const Count size = c->states + c->order, width = size + c->columns;
    const Count at = ((k * p->records + p->record) * c->sites + site) * c->outputs + j;
    double *innovation = p->innovations + at * p->columns;
    const double *value = c->values + (k * c->outputs + j) * c->columns;

    row_of(c, k, j, site, h);
    rows_summed(size, width, h, W, foreseen);
    const double spread = dot(size, h, foreseen) + 1;
    for (Count i = 0; i < c->columns; i++) innovation[i] = value[i] - foreseen[size + i];
    p->spreads[at] = spread;
    for (Count i = 0; i < size; i++) h[i] = foreseen[i] / spread;
    for (Count i = 0; i < c->columns; i++) foreseen[size + i] = -innovation[i];
    for (Count i = 0; i < size; i++) add(width, -h[i], foreseen, W + i * width);
    if (p->keep) memcpy(p->gains + at * size, h, (size_t)size * sizeof *h);
}

/* W = T W, and its covariance P on to T P T' + Q */
static void onward(const Course *c, Count k, Count site, double *W, double *moved, double *T, double *Q) {
    const Count size = c->states + c->order, width = size + c->columns;

    transition(c, k, site, T, Q);
    for (Count i = 0; i < size; i++) rows_summed(size, width, T + i * size, W, moved + i * width);
    for (Count i = 0; i < size; i++) {
        memcpy(W + i * width + size, moved + i * width + size, (size_t)c->columns * sizeof *W);
        for (Count j = 0; j < size; j++) Q[i * size + j] += dot(size, moved + i * width, T + j * size);
    }
    for (Count i = 0; i < size; i++)
        for (Count j = 0; j < size; j++) W[i * width + j] = 0.5 * (Q[i * size + j] + Q[j * size + i]);
}

/* How many numbers both passes work in. */
FACE Count passes_room(const Course *c) {
    const Count size = c->states + c->order, width = size + c->columns;
    return 2 * size * width + 2 * size * size + size + width;
}

FACE void passes_forward(const Course *c, const Passed *p, double *room) {
    const Count n = c->states, size = n + c->order, width = size + c->columns;
    double *W = room, *moved = W + size * width, *T = moved + size * width, *Q = T + size * size;
    double *h = Q + size * size, *foreseen = h + size;

    for (Count site = 0; site < c->sites; site++) {
        memset(W, 0, (size_t)(size * width) * sizeof *W);
        for (Count i = 0; i < c->order; i++)
            memcpy(W + (n + i) * width + n, c->start + (site * c->order + i) * c->order,
                   (size_t)c->order * sizeof *W);
        for (Count k = 0; k < c->points; k++) {
            const Count at = (k * p->records + p->record) * c->sites + site;
            if (p->keep) {
                memcpy(p->rows + at * size, W + n * width, (size_t)size * sizeof *W);
                memcpy(p->ahead + at * p->columns, W + n * width + size, (size_t)c->columns * sizeof *W);
            }
            for (Count j = 0; j < c->outputs; j++)
                if (c->measured[k * c->outputs + j] != 0) seen(c, p, k, j, site, W, h, foreseen);
            if (k + 1 < c->points) onward(c, k, site, W, moved, T, Q);
        }
    }
}

/* What an output tells of what came before: of the error `M`, and of the state in its last column. */
static void told_back(const Course *c, const Passed *p, Count k, Count j, Count site, double missed,
                      double *M, double *h, double *told) {
    const Count size = c->states + c->order, width = size + 1;
    const Count at = ((k * p->records + p->record) * c->sites + site) * c->outputs + j;
    const double *gain = p->gains + at * size, live = 1 / p->spreads[at];

    row_of(c, k, j, site, h);
    rows_summed(size, width, gain, M, told);
    const double both = dot(size, gain, told) + live, state = missed * live - told[size];
    add(size, -0.5 * both, h, told);
    for (Count i = 0; i < size; i++) {
        add(size, -h[i], told, M + i * width);
        add(size, -told[i], h, M + i * width);
        M[i * width + size] += h[i] * state;
    }
}

/* M = T' M, and what it tells of the error on to T' M T */
static void backward(const Course *c, Count k, Count site, double *M, double *moved, double *T) {
    const Count size = c->states + c->order, width = size + 1;

    transition(c, k, site, T, 0);
    memset(moved, 0, (size_t)(size * width) * sizeof *moved);
    for (Count i = 0; i < size; i++)
        for (Count j = 0; j < size; j++) add(width, T[j * size + i], M + j * width, moved + i * width);
    for (Count i = 0; i < size; i++) {
        rows_summed(size, size, moved + i * width, T, M + i * width);
        M[i * width + size] = moved[i * width + size];
    }
}

/* `missed`: of all records, (points, records, sites, outputs); `force` and `variance` without outputs. */
FACE void passes_back(const Course *c, const Passed *p, const double *missed, double *force, double *variance,
                      double *room) {
    const Count n = c->states, size = n + c->order, width = size + 1;
    double *M = room, *moved = M + size * width, *T = moved + size * width;
    double *h = T + size * size, *told = h + size;

    for (Count site = 0; site < c->sites; site++) {
        memset(M, 0, (size_t)(size * width) * sizeof *M);
        for (Count k = c->points - 1; k >= 0; k--) {
            const Count at = (k * p->records + p->record) * c->sites + site;
            const double *row = p->rows + at * size;
            for (Count j = c->outputs - 1; j >= 0; j--)
                if (c->measured[k * c->outputs + j] != 0)
                    told_back(c, p, k, j, site, missed[at * c->outputs + j], M, h, told);
            rows_summed(size, width, row, M, told);
            force[at] = told[size];
            variance[at] = row[n] - dot(size, told, row);
            if (k) backward(c, k - 1, site, M, moved, T);
        }
    }
}

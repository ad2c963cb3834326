/* Time-stepping of Moreau and Jean: midpoint rule for what is smooth, set-valued dry friction by projection,
   solved within the step.

   M a + C v + K q = gu u + gw w + gd w' - sum b lambda,   e = b.q + cw w the elongation of an element,
   w(t) a prescribed motion, u(t) a prescribed force. All samples, in and out, are at the middle of steps. */
#include <math.h>

#define NMAX 6
#define CELLS 16
enum {
    FRICTION,
    BRISTLES,
    POWER_OF_SPEED,
    POWER_OF_TRAVEL,
    BILINEAR,
    RIPPLE,
    IWAN,
    CONTACT,
    MAXWELL,
    WARPED,
    CLEARANCE,
    LUGRE,
    CONSTANT,
    LIMITED,
    JENKINS
};

typedef struct {
    double law, cw, b[NMAX], warp[NMAX], load_q[NMAX], load_v[NMAX], load_w, load_wd, p[16];
} Element;

typedef struct {
    double W, Ab[NMAX], lambda, cell[CELLS], e, rate, pull[NMAX], pull_w;
} State;

static double dot(int n, const double *a, const double *b) {
    double sum = 0;
    for (int i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

static double sign(double x) { return (x > 0) - (x < 0); }
static double clip(double x, double low, double high) { return x < low ? low : x > high ? high : x; }

/* p: level forward, level backward, static surplus, its speed, its exponent, load factor, growth, its time,
 * from, to; p[12..14]: share by which it varies with travel, centre and half width of that */
static double level(const double *p, double e, double speed, double load, double t, int backward) {
    double of_speed = p[2] != 0 ? 1 + p[2] * exp(-pow(fabs(speed) / p[3], p[4])) : 1;
    double of_time = p[7] > 0 ? p[6] * (1 - exp(-t / p[7])) : 0;
    double active = p[9] > p[8] ? t >= p[8] && t <= p[9] : 1;
    double of_travel = p[12] != 0 ? 1 + p[12] * cos(M_PI * (e - p[13]) / p[14]) : 1;
    return active * of_travel * (p[backward] * of_speed + p[5] * fabs(load) + of_time);
}

/* What grows from nothing within a time T and stays, if there is one */
static double grown(double T, double t) { return T > 0 ? 1 - exp(-t / T) : 1; }

/* Set-valued friction over a step: slide until the speed is zero, then stick (a = 0) or slide on. `free` is
   the acceleration without this friction, W what a unit of it takes away. */
static double dry(double up, double down, double begin, double free, double W, double h) {
    double first = begin > 0 ? up : begin < 0 ? -down : 0, a = free - W * first, reach = 0;
    if (begin != 0) reach = a * begin < 0 ? fmin(1, -begin / (a * h)) : 1;
    double then = W > 0 ? clip(free / W, -down, up) : free > 0 ? up : -down;
    return reach * first + (1 - reach) * then;
}

/* Jenkins cells in parallel, yield travels spread evenly: p = stiffness, greatest yield travel */
static double iwan(const double *p, double *cell, double e, int keep) {
    double force = 0;
    for (int i = 0; i < CELLS; i++) {
        double yield = p[1] * (i + 0.5) / CELLS, slider = clip(cell[i], e - yield, e + yield);
        force += p[0] / CELLS * (e - slider);
        if (keep) cell[i] = slider;
    }
    return force;
}

/* The same with yield travels that go with a power: p = stiffness, greatest yield travel, power; with 0 all
   cells yield at once */
static double jenkins(const double *p, double *cell, double e, int keep) {
    double force = 0;
    for (int i = 0; i < CELLS; i++) {
        double yield = p[1] * pow((i + 0.5) / CELLS, p[2]), slider = clip(cell[i], e - yield, e + yield);
        force += p[0] / CELLS * (e - slider);
        if (keep) cell[i] = slider;
    }
    return force;
}

/* Unilateral contacts on both flanks of a gap: p = k, d, gap below, gap above, depth over which damping sets
 * in */
static double contact(const double *p, double e, double rate) {
    double side = e > 0 ? 1 : -1, depth = side > 0 ? e - p[3] : -e - p[2];
    if (depth <= 0) return 0;
    double force = p[0] * depth + p[1] * side * rate * fmin(1, depth / p[4]);
    return side * fmax(force, 0);
}

/* A spring and damper behind a gap, p = k, d, half gap. Their deflection relaxes while the gap is open, and
   is swept along by the flanks: a sweeping process. cell = deflection, flank that touched last. */
static double clearance(const double *p, double *cell, double e, double rate, double h, int keep) {
    double k = p[0], d = p[1], relaxed = d > 0 ? cell[0] / (1 + h * k / d) : 0;
    double z = clip(relaxed, e - p[2], e + p[2]), side = sign(z - relaxed);
    double speed = side == cell[1] ? rate : (z - cell[0]) / h;
    if (keep) cell[0] = z, cell[1] = side;
    return side == 0 ? 0 : k * z + d * speed;
}

static double smooth_law(const Element *el, State *s, double h, double t, double load, int keep) {
    const double *p = el->p;
    double e = s->e, rate = s->rate;
    switch ((int)el->law) {
    case BRISTLES: {
        double g = level(p, e, rate, load, t, rate < 0);
        double z = (s->cell[0] + h / 2 * rate) / (1 + h / 2 * p[10] * fabs(rate) / g);
        if (keep) s->cell[0] = 2 * z - s->cell[0];
        return p[10] * z;
    }
    case LUGRE: { /* bristles that also resist being bent: p[11] = damping of theirs */
        double g = level(p, e, rate, load, t, rate < 0);
        double z = (s->cell[0] + h / 2 * rate) / (1 + h / 2 * p[10] * fabs(rate) / g);
        double bent = (z - s->cell[0]) / (h / 2);
        if (keep) s->cell[0] = 2 * z - s->cell[0];
        return p[10] * z + p[11] * bent;
    }
    case POWER_OF_SPEED: return p[0] * grown(p[7], t) * sign(rate) * pow(fabs(rate), p[1]);
    case POWER_OF_TRAVEL: return p[0] * grown(p[7], t) * sign(e) * pow(fabs(e), p[1]);
    case CONSTANT: return p[0];
    case LIMITED: return load - clip(load, -p[0], p[0]); /* what a drive holds back of what it is told */
    case BILINEAR: return e > 0 ? p[0] * e : p[1] * e;
    case RIPPLE: { /* p = size, period, phase; shares and phases of the second and third harmonic */
        double turn = 2 * M_PI * e / p[1];
        return p[0] * (sin(turn + p[2]) + p[3] * sin(2 * turn + p[4]) + p[5] * sin(3 * turn + p[6]));
    }
    case IWAN: return iwan(p, s->cell, e, keep);
    case JENKINS: return jenkins(p, s->cell, e, keep);
    case CONTACT: return contact(p, e, rate);
    case WARPED: return p[0] * e + p[1] * rate;
    case CLEARANCE: return clearance(p, s->cell, e, rate, h, keep);
    case MAXWELL: { /* p = series stiffness, k, d of the spring and damper behind it */
        double z = (s->cell[0] + h / 2 * p[0] * e / p[2]) / (1 + h / 2 * (p[0] + p[1]) / p[2]);
        if (keep) s->cell[0] = 2 * z - s->cell[0];
        return p[0] * (e - z);
    }
    }
    return 0;
}

/* Elongation at a state; a warped element has e = cw w + b.q - amplitude sin(2 pi y/period + phase), y =
 * warp.q */
static void elongate(int n, const Element *el, State *s, const double *q, const double *v, double w,
                     double wd) {
    s->e = dot(n, el->b, q) + el->cw * w;
    s->rate = dot(n, el->b, v) + el->cw * wd;
    for (int i = 0; i < n; i++) s->pull[i] = el->b[i];
    if ((int)el->law == WARPED) {
        double turn = 2 * M_PI / el->p[6], angle = turn * dot(n, el->warp, q) + el->p[7];
        double slope = el->p[5] * turn * cos(angle);
        s->e -= el->p[5] * (sin(angle) - sin(el->p[7]));
        s->rate -= slope * dot(n, el->warp, v);
        for (int i = 0; i < n; i++) s->pull[i] -= slope * el->warp[i];
    }
}

/* out[step][row]: Y row = on q, v, a (NMAX each), u, w, w', w'', sum of cw lambda */
void run(int n, int steps, double h, const double *Ainv, const double *C, const double *K, const double *gu,
         const double *gw, const double *gd, const double *u, const double *w, const double *wd,
         const double *wdd, int count, const Element *elements, State *states, int rows, const double *Y,
         double *out) {
    double q[NMAX] = {0}, v[NMAX] = {0}, free[NMAX], dv[NMAX], qm[NMAX], vm[NMAX], r[NMAX];
    const int width = 3 * NMAX + 5;
    int sweeps = count ? 6 : 1;
    for (int k = 0; k < count; k++) {
        for (int i = 0; i < n; i++) states[k].Ab[i] = dot(n, Ainv + i * n, elements[k].b);
        states[k].W = dot(n, elements[k].b, states[k].Ab);
    }
    for (int j = 0; j < steps; j++) {
        double t = j * h;
        for (int i = 0; i < n; i++) qm[i] = q[i] + h / 2 * v[i];
        for (int i = 0; i < n; i++)
            r[i] = h * (gu[i] * u[j] + gw[i] * w[j] + gd[i] * wd[j] - dot(n, C + i * n, v) -
                        dot(n, K + i * n, qm));
        for (int i = 0; i < n; i++) dv[i] = free[i] = dot(n, Ainv + i * n, r);
        for (int sweep = 0; sweep < sweeps && count; sweep++) {
            int keep = sweep == sweeps - 1;
            double before[NMAX];
            for (int i = 0; i < n; i++) {
                before[i] = dv[i];
                vm[i] = v[i] + dv[i] / 2;
                qm[i] = q[i] + h / 2 * vm[i];
            }
            for (int k = 0; k < count; k++) {
                const Element *el = elements + k;
                State *s = states + k;
                double load =
                    dot(n, el->load_q, qm) + dot(n, el->load_v, vm) + el->load_w * w[j] + el->load_wd * wd[j];
                elongate(n, el, s, qm, vm, w[j], wd[j]);
                if ((int)el->law == FRICTION) {
                    double up = level(el->p, s->e, s->rate, load, t, 0);
                    double down = level(el->p, s->e, s->rate, load, t, 1);
                    double begin = dot(n, el->b, v) + el->cw * (wd[j] - h / 2 * wdd[j]);
                    double end = dot(n, el->b, v) + dot(n, el->b, dv) + el->cw * (wd[j] + h / 2 * wdd[j]);
                    s->lambda = dry(up, down, begin, (end - begin) / h + s->W * s->lambda, s->W, h);
                } else s->lambda = smooth_law(el, s, h, t, load, keep);
                for (int i = 0; i < n; i++) dv[i] = free[i];
                for (int m = 0; m < count; m++) {
                    if ((int)elements[m].law != WARPED)
                        for (int i = 0; i < n; i++) dv[i] -= h * states[m].Ab[i] * states[m].lambda;
                    else
                        for (int i = 0; i < n; i++)
                            dv[i] -= h * states[m].lambda * dot(n, Ainv + i * n, states[m].pull);
                }
            }
            double moved = 0, size = 1e-300;
            for (int i = 0; i < n; i++)
                moved += fabs(dv[i] - before[i]), size += fabs(dv[i]) + h * fabs(v[i]);
            if (!keep && moved < 1e-7 * size)
                sweep = sweeps - 2; /* converged: one last sweep keeps the memory */
        }
        double reaction = 0;
        for (int k = 0; k < count; k++) reaction += elements[k].cw * states[k].lambda;
        for (int i = 0; i < n; i++) vm[i] = v[i] + dv[i] / 2, qm[i] = q[i] + h / 2 * vm[i];
        for (int row = 0; row < rows; row++) {
            const double *y = Y + row * width, *of = y + 3 * NMAX;
            double sum = dot(n, y, qm) + dot(n, y + NMAX, vm) + dot(n, y + 2 * NMAX, dv) / h;
            out[j * rows + row] =
                sum + of[0] * u[j] + of[1] * w[j] + of[2] * wd[j] + of[3] * wdd[j] + of[4] * reaction;
        }
        for (int i = 0; i < n; i++) q[i] += h * vm[i], v[i] += dv[i];
    }
}

int state_size(void) { return sizeof(State); }

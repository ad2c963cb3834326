/* The planetary flywheel inerter on SUNDIALS CVODE: equations (16)-(27) of Ge & Wang, Tables 1-4,
 * N identical planets as one coordinate, housing at rest, rod driven by x1 = A sin(2 pi f t).
 * Build: cc -O2 pfi.c -o pfi -lsundials_cvode -lsundials_nvecserial -lm */
#include <cvode/cvode.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <time.h>
#include <unistd.h>

#define POINTS 1000
#define PI 3.14159265358979323846

/* Tables 1-4, SI units. */
static const double LEAD = 0.010, RING = 0.050, PLANET = 0.017, PRESSURE_ANGLE = 20 * PI / 180;
static const double N = 4, J_P = 1.66e-5, J_R = 1.02e-4, J_S = 2.89e-4 + 2.80e-5;
static const double T_C = 0.1975, T_S = 0.2231, STRIBECK = 5.437e8, T_V = 2.703e-3;
static const double M_R = 1.701, K_S = 1.168e7, C_S = 1.223e3, EPS = 1.006e-7;
static const double K_R = 1.353e9, C_R = 4.671e4, G_R = 1.838e-9, T_PM = 8.067e-4, T_PV = 1.366e-4;

enum { TH_S, W_S, TH_P, W_P, STATES };
enum { SCREW, PLANETS, FRICTIONS };
static const int RATE[FRICTIONS] = {W_S, W_P};
static const double BREAK_AWAY[FRICTIONS] = {T_S, T_PM};

typedef struct {
    int hybrid;
    double rtol, atol, w_smooth, amplitude, frequency, duration;
    double per_lead, r_screw, r_planet, omega; /* 2 pi/P, r_c cos(alpha), r cos(alpha), 2 pi f */
    int mode[FRICTIONS];                       /* -1 backward, 0 stuck, 1 forward; hybrid only */
} Model;

typedef struct {
    long steps, evaluations, events;
    double t[POINTS + 1], force[POINTS + 1];
} Run;

typedef struct {
    double screw, mesh;             /* forces F_d and F_p, N */
    double slope_screw, slope_mesh; /* 1 in contact, 0 in the clearance */
} Contact;

static void check(int flag, const char *call) {
    if (flag < 0) {
        fprintf(stderr, "%s failed: %d\n", call, flag);
        exit(1);
    }
}

/* (20), (24): a dead zone of half-width `half` on the stiffness plus damping force. */
static double dead_zone(double force, double half, double *slope) {
    *slope = fabs(force) >= half;
    return *slope ? force - copysign(half, force) : 0.0;
}

/* (17)-(20), (23), (24). */
static Contact contact(const Model *m, double t, const double *y) {
    const double x1 = m->amplitude * sin(m->omega * t);
    const double v1 = m->amplitude * m->omega * cos(m->omega * t);
    Contact c;
    c.screw = dead_zone(K_S * (x1 - y[TH_S] / m->per_lead) + C_S * (v1 - y[W_S] / m->per_lead), K_S * EPS,
                        &c.slope_screw);
    c.mesh = dead_zone(K_R * (m->r_screw * y[TH_S] - m->r_planet * y[TH_P]) +
                           C_R * (m->r_screw * y[W_S] - m->r_planet * y[W_P]),
                       K_R * G_R, &c.slope_mesh);
    return c;
}

/* Torques on the screw and on one planet, all but friction. */
static void loads(const Model *m, double t, const double *y, double load[FRICTIONS]) {
    const Contact c = contact(m, t, y);
    load[SCREW] = c.screw / m->per_lead - N * c.mesh * m->r_screw;
    load[PLANETS] = c.mesh * m->r_planet;
}

static double screw_level(double w) { return T_C + (T_S - T_C) * exp(-fabs(w) / STRIBECK); }

/* The sign of w: regularised, or that of the mode. */
static double direction(const Model *m, int i, double w) {
    return m->hybrid ? m->mode[i] : tanh(w / m->w_smooth);
}

static double direction_slope(const Model *m, double w) {
    if (m->hybrid) return 0.0;
    const double s = tanh(w / m->w_smooth);
    return (1 - s * s) / m->w_smooth;
}

static int stuck(const Model *m, int i) { return m->hybrid && m->mode[i] == 0; }

/* (16), (21), (25)-(27). */
static int rhs(sunrealtype t, N_Vector state, N_Vector rate, void *data) {
    const Model *m = data;
    const double *y = N_VGetArrayPointer(state);
    double *dy = N_VGetArrayPointer(rate), load[FRICTIONS];
    loads(m, t, y, load);
    const double t_f = screw_level(y[W_S]) * direction(m, SCREW, y[W_S]) + T_V * y[W_S];
    const double t_fp = T_PM * direction(m, PLANETS, y[W_P]) + T_PV * y[W_P];
    dy[TH_S] = y[W_S];
    dy[TH_P] = y[W_P];
    dy[W_S] = stuck(m, SCREW) ? 0.0 : (load[SCREW] - t_f) / (J_S + N * J_R);
    dy[W_P] = stuck(m, PLANETS) ? 0.0 : (load[PLANETS] - t_fp) / J_P;
    return 0;
}

/* The Stribeck slope, below 1e-10 N.m.s/rad, is left out. */
static int jacobian(sunrealtype t, N_Vector state, N_Vector rate, SUNMatrix jac, void *data, N_Vector w1,
                    N_Vector w2, N_Vector w3) {
    (void)rate, (void)w1, (void)w2, (void)w3;
    const Model *m = data;
    const double *y = N_VGetArrayPointer(state), w = y[W_S];
    const Contact c = contact(m, t, y);
    const double friction[FRICTIONS] = {screw_level(w) * direction_slope(m, w) + T_V,
                                        T_PM * direction_slope(m, y[W_P]) + T_PV};
    const double screw = c.slope_screw / (m->per_lead * m->per_lead);
    const double mesh = c.slope_mesh, j_s = J_S + N * J_R;
    const double rs = m->r_screw, rp = m->r_planet;
    SM_ELEMENT_D(jac, TH_S, W_S) = 1;
    SM_ELEMENT_D(jac, TH_P, W_P) = 1;
    if (!stuck(m, SCREW)) {
        SM_ELEMENT_D(jac, W_S, TH_S) = -(screw * K_S + N * mesh * K_R * rs * rs) / j_s;
        SM_ELEMENT_D(jac, W_S, W_S) = -(screw * C_S + N * mesh * C_R * rs * rs + friction[0]) / j_s;
        SM_ELEMENT_D(jac, W_S, TH_P) = N * mesh * K_R * rs * rp / j_s;
        SM_ELEMENT_D(jac, W_S, W_P) = N * mesh * C_R * rs * rp / j_s;
    }
    if (!stuck(m, PLANETS)) {
        SM_ELEMENT_D(jac, W_P, TH_S) = mesh * K_R * rs * rp / J_P;
        SM_ELEMENT_D(jac, W_P, W_S) = mesh * C_R * rs * rp / J_P;
        SM_ELEMENT_D(jac, W_P, TH_P) = -mesh * K_R * rp * rp / J_P;
        SM_ELEMENT_D(jac, W_P, W_P) = -(mesh * C_R * rp * rp + friction[1]) / J_P;
    }
    return 0;
}

/* Falls through zero when slip ends, or when the load on what is stuck reaches break-away. */
static int indicators(sunrealtype t, N_Vector state, sunrealtype *g, void *data) {
    const Model *m = data;
    const double *y = N_VGetArrayPointer(state);
    double load[FRICTIONS];
    loads(m, t, y, load);
    for (int i = 0; i < FRICTIONS; i++)
        g[i] = m->mode[i] ? m->mode[i] * y[RATE[i]] : BREAK_AWAY[i] - fabs(load[i]);
    return 0;
}

/* The loads depend on the continuous state alone, so one pass finds a consistent set of modes. */
static void switch_modes(Model *m, void *cvode, double t, N_Vector state) {
    double *y = N_VGetArrayPointer(state), load[FRICTIONS];
    int found[FRICTIONS];
    check(CVodeGetRootInfo(cvode, found), "CVodeGetRootInfo");
    for (int i = 0; i < FRICTIONS; i++)
        if (found[i]) y[RATE[i]] = 0.0;
    loads(m, t, y, load);
    for (int i = 0; i < FRICTIONS; i++) {
        if (!found[i]) continue;
        const int holds = m->mode[i] != 0 && fabs(load[i]) <= BREAK_AWAY[i];
        m->mode[i] = holds ? 0 : (load[i] > 0 ? 1 : -1);
    }
}

static double force(const Model *m, double t, const double *y) {
    const double a1 = -m->amplitude * m->omega * m->omega * sin(m->omega * t);
    return contact(m, t, y).screw + M_R * a1; /* (22) */
}

/* The rod already moves at t = 0: the screw and the planets start rolling with it. */
static void start(Model *m, double *y) {
    y[TH_S] = y[TH_P] = 0;
    y[W_S] = m->per_lead * m->amplitude * m->omega;
    y[W_P] = y[W_S] * m->r_screw / m->r_planet;
    m->mode[SCREW] = m->mode[PLANETS] = 1;
}

static void add_counters(void *cvode, Run *run) {
    long steps, evaluations;
    check(CVodeGetNumSteps(cvode, &steps), "CVodeGetNumSteps");
    check(CVodeGetNumRhsEvals(cvode, &evaluations), "CVodeGetNumRhsEvals");
    run->steps += steps;
    run->evaluations += evaluations;
}

static void advance(Model *m, void *cvode, N_Vector y, double until, Run *run) {
    double t;
    int flag;
    while ((flag = CVode(cvode, until, y, &t, CV_NORMAL)) == CV_ROOT_RETURN) {
        switch_modes(m, cvode, t, y);
        run->events++;
        add_counters(cvode, run);
        check(CVodeReInit(cvode, t, y), "CVodeReInit");
    }
    check(flag, "CVode");
}

static void solve(Model *m, SUNContext context, Run *run) {
    N_Vector y = N_VNew_Serial(STATES, context);
    SUNMatrix jac = SUNDenseMatrix(STATES, STATES, context);
    SUNLinearSolver linear = SUNLinSol_Dense(y, jac, context);
    void *cvode = CVodeCreate(CV_BDF, context);
    int falling[FRICTIONS] = {-1, -1};
    memset(run, 0, sizeof *run);
    start(m, N_VGetArrayPointer(y));
    check(CVodeInit(cvode, rhs, 0.0, y), "CVodeInit");
    check(CVodeSStolerances(cvode, m->rtol, m->atol), "CVodeSStolerances");
    check(CVodeSetUserData(cvode, m), "CVodeSetUserData");
    check(CVodeSetLinearSolver(cvode, linear, jac), "CVodeSetLinearSolver");
    check(CVodeSetJacFn(cvode, jacobian), "CVodeSetJacFn");
    check(CVodeSetMaxNumSteps(cvode, 100000), "CVodeSetMaxNumSteps");
    if (m->hybrid) {
        check(CVodeRootInit(cvode, FRICTIONS, indicators), "CVodeRootInit");
        check(CVodeSetRootDirection(cvode, falling), "CVodeSetRootDirection");
    }
    run->force[0] = force(m, 0.0, N_VGetArrayPointer(y));
    for (int i = 1; i <= POINTS; i++) {
        run->t[i] = m->duration * i / POINTS;
        advance(m, cvode, y, run->t[i], run);
        run->force[i] = force(m, run->t[i], N_VGetArrayPointer(y));
    }
    add_counters(cvode, run);
    CVodeFree(&cvode);
    SUNLinSolFree(linear);
    SUNMatDestroy(jac);
    N_VDestroy(y);
}

static double now(clockid_t clock) {
    struct timespec t;
    clock_gettime(clock, &t);
    return t.tv_sec + 1e-9 * t.tv_nsec;
}

static int by_value(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *values, int count) {
    qsort(values, count, sizeof *values, by_value);
    return values[count / 2];
}

static void measure(Model *m, SUNContext context, Run *run, int repeats, double *wall, double *cpu) {
    double walls[repeats], cpus[repeats];
    for (int i = 0; i < repeats; i++) {
        walls[i] = now(CLOCK_MONOTONIC);
        cpus[i] = now(CLOCK_PROCESS_CPUTIME_ID);
        solve(m, context, run);
        walls[i] = now(CLOCK_MONOTONIC) - walls[i];
        cpus[i] = now(CLOCK_PROCESS_CPUTIME_ID) - cpus[i];
    }
    *wall = median(walls, repeats);
    *cpu = median(cpus, repeats);
}

static void write_csv(const Run *run, const char *path) {
    FILE *file = fopen(path, "w");
    check(file ? 0 : -1, path);
    fprintf(file, "t,F\n");
    for (int i = 0; i <= POINTS; i++) fprintf(file, "%.17g,%.17g\n", run->t[i], run->force[i]);
    fclose(file);
}

static void usage(void) {
    fputs("pfi smooth|hybrid [-e rtol] [-a atol] [-w w_s] [-A amplitude] [-f frequency]"
          " [-T duration] [-r repeats] [-o csv]\n",
          stderr);
    exit(2);
}

int main(int argc, char **argv) {
    Model m = {0, 1e-6, 1e-8, 0.1, 0.010, 3.0, 1.0, 0, 0, 0, 0, {0, 0}};
    const char *csv = NULL;
    int repeats = 101;
    if (argc < 2 || (strcmp(argv[1], "smooth") && strcmp(argv[1], "hybrid"))) usage();
    m.hybrid = !strcmp(argv[1], "hybrid");
    optind = 2;
    for (int option; (option = getopt(argc, argv, "e:a:w:A:f:T:r:o:")) != -1;) switch (option) {
        case 'e': m.rtol = atof(optarg); break;
        case 'a': m.atol = atof(optarg); break;
        case 'w': m.w_smooth = atof(optarg); break;
        case 'A': m.amplitude = atof(optarg); break;
        case 'f': m.frequency = atof(optarg); break;
        case 'T': m.duration = atof(optarg); break;
        case 'r': repeats = atoi(optarg); break;
        case 'o': csv = optarg; break;
        default: usage();
        }
    if (repeats < 1) usage();
    m.per_lead = 2 * PI / LEAD;
    m.r_screw = (RING - PLANET) * cos(PRESSURE_ANGLE);
    m.r_planet = PLANET * cos(PRESSURE_ANGLE);
    m.omega = 2 * PI * m.frequency;

    SUNContext context;
    Run run;
    check(SUNContext_Create(NULL, &context), "SUNContext_Create");
    double wall, cpu;
    measure(&m, context, &run, repeats, &wall, &cpu);
    printf("wall %.6e s, cpu %.6e s, steps %ld, evaluations %ld, events %ld\n", wall, cpu, run.steps,
           run.evaluations, run.events);
    if (csv) write_csv(&run, csv);
    SUNContext_Free(&context);
    return 0;
}

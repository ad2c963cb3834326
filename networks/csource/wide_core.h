/* What several cores hold side by side while they step together, and what its parts offer each other. */
#ifndef INERTANCE_WIDE_CORE_H
#define INERTANCE_WIDE_CORE_H

#include "core_state.h"
#include "wide.h"

typedef struct {
    wide value[ROOM(NG)], rate[ROOM(NG)];
} WideWatched;

/* What rows LU exchanged: for each column the lanes in which it did, and with which row. */
typedef struct {
    unsigned moved[ROOM(NF)];
    wide row[ROOM(NF)];
} Pivots;

/* A step of each lane from `t` over `h`, from where it stands to `end`. */
typedef struct {
    wide t, h;
    wide y[ROOM(NY)], rates[ROOM(NY)], end[ROOM(NY)], end_rates[ROOM(NY)];
    wide q[ROOM(NQ)], u[ROOM(NA)], u_rate[ROOM(NA)], u_time; /* all inputs at the instants u_time */
    wide free[ROOM(NU)];
    Record *records[ROOM(NU)][LANES]; /* none for inputs that stay constant */
    int recorded[ROOM(NU)];           /* whether any lane has one */

    wide error, worst; /* of the last step: 1 at the tolerance, and the unknown with most of it */

    WideWatched left, last; /* indicators where the step begins and ends */
    wide seen[ROOM(NG)], fastest[ROOM(NG)], now_seen[ROOM(NG)], now_fastest[ROOM(NG)];
    wide largest[ROOM(NZ)];

    /* Scratch. */
    wide slope[ROOM(NSLOPE)], by_time[ROOM(NY)], lu[ROOM(NF * NF)];
    Pivots pivots;
    mask still[ROOM(NY)];
    unsigned any_still;
    wide stage[STAGES][ROOM(NY)], bend[3][ROOM(NY)];
    wide variables[ROOM(NW)];
} Wide;

/* wide_step.c */
unsigned wide_step(Wide *w, unsigned active, double rtol, double atol);
void wide_bend(Wide *w);
void wide_dense(const Wide *w, wide t, wide y[], wide rates[]);
void wide_inputs_at(Wide *w, wide t, unsigned active);

/* wide_linear.c */
unsigned wide_factor(wide lu[], int n, Pivots *pivots, unsigned active);
void wide_solve(const wide lu[], int n, const Pivots *pivots, wide b[]);

/* wide_watch.c */
unsigned wide_uneventful(Wide *w, wide end, unsigned active);

#endif

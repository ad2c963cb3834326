/* Start values: what is given, and what follows from it. */
#ifndef INERTANCE_START_H
#define INERTANCE_START_H

#include "core_state.h"

#define NMET (NFIXED ? NFIXED + NZ : 0)
#define START_ROWS (NAIM > NMET ? NAIM : NMET)
#define START_COLUMNS (NLEAD > NFREE + NZ ? NLEAD : NFREE + NZ)

/* What may be set before a run: states (guesses, where they are sought) and the aims. Numbers only. */
typedef struct {
    double x[ROOM(NX)], aim[ROOM(NAIM)];
} Given;

/* Scratch. */
typedef struct {
    double value[ROOM(START_ROWS)], missing[ROOM(START_ROWS)], step[ROOM(START_COLUMNS)];
    double slope[ROOM(START_ROWS * START_COLUMNS)], kept[ROOM(START_ROWS * START_COLUMNS)];
    double turn[ROOM(START_ROWS * START_ROWS)];
} StartRoom;

void core_given(Given *given);

/* Find start values and the modes they imply, from nothing but what is given, parameters, inputs and time. */
CoreStatus core_begin(Core *c, const Given *given, StartRoom *room);

#endif

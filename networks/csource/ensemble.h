/* Many runs of one network: what is asked of them, and the lanes in which they go. */
#ifndef INERTANCE_ENSEMBLE_H
#define INERTANCE_ENSEMBLE_H

#include "start.h"
#ifdef MODEL_WIDE
#include "wide_core.h"
#else
#define LANES 1
#endif

#if defined(_WIN32)
#define EXPORT __declspec(dllexport)
#else
#define EXPORT __attribute__((visibility("default")))
#endif

#define CROSSING (3 + NQ + NW) /* member, whether a segment begins, instant, constants, what is asked for */

enum { WAITING, ARRIVED, UNSTARTED, STUCK, FAILED }; /* what came of a member */

/* Shared with crew.py, field by field. Arrays of events and messages are drained by whoever calls, when a
 * block pauses. */
typedef struct {
    double begin, stop, interval, rtol, atol;
    const double *outputs;               /* instants, the first one where it begins */
    const double *parameters;            /* (members, NP) */
    const double *guesses, *aims;        /* (members, NX), (members, NAIM): where starts are sought */
    const double *points, *constants; /* (members, NY), (members, NQ): where they are known, else absent */
    const double *free; /* (signals, NU) */
    const Record *records; /* (signals, NU), without instants where an input is constant */
    Legs *legs; /* those that there are */
    const long long *signals_of, *legs_of; /* of each member: its signals, its legs */
    double *values, *ended; /* (members, outputs, NW); until when each member came */
    long long *status, *steps, *rejected;
    char *messages; /* of those that failed, MESSAGE for each */
    long long *message_members;
    double *event_times, *impulses;
    long long *event_members, *changes, *stays;
    double *crossings; /* rows of CROSSING numbers: where members begin, before and after events; or absent */
    long long output_count, member_count, entered, event_count, event_room, message_count, message_room;
    long long crossing_count, crossing_room, crossing_most; /* pauses at room */
    long long most_between; /* steps from one output to the next */
    long long budget, rounds, tried; /* how often lanes may step together, and did; steps of theirs */
} Block;

/* A member on its way. */
typedef struct {
    Core core;
    Travel travel;
    Observer told;
    Block *block;
    Record record[ROOM(NU)];
    long long member, next, counted; /* next output; steps when the last one was written */
    int ahead; /* the lane knows more than the core */
    double crossed; /* instant of the last crossing that is written down */
    int lost; /* there was no room for one */
} Lane;

typedef struct {
    Lane lane[LANES];
    unsigned busy, fresh; /* lanes that have a member; whose core knows more than the lane */
    StartRoom room;
    Given given;
#ifdef MODEL_WIDE
    Wide wide;
#endif
} Crew;

/* member.c */
int member_enters(Crew *crew, Block *block, Lane *lane);
void member_ends(Lane *lane, CoreStatus status);
void member_writes(Lane *lane, double t, const double y[]);
double *member_row(const Lane *lane, long long output);

#endif

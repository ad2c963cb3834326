/* A network as a state machine in C: states, modes, events. No allocation, no global state, no dependency
 * but libm. `Core` holds numbers only, no pointers: copying it saves and restores everything. */
#ifndef INERTANCE_CORE_H
#define INERTANCE_CORE_H

#include "model.h" /* generated: NX states, NZ algebraic unknowns, NU free inputs, NP parameters, NM modes,
                    * NG transitions (one indicator each), NW other variables */

/* CORE_DISCARD: not possible here (equations left the finite numbers); the same core may go on from
 * elsewhere. CORE_ERROR: wrong use, or no way on. Both leave words in core_message. */
typedef enum { CORE_OK, CORE_DISCARD, CORE_ERROR } CoreStatus;

/* What core_advance came to. */
typedef enum { CORE_ARRIVED, CORE_EVENT } CoreStop;

typedef struct Core Core; /* defined in core_state.h, which the faces include to know its size */

/* Defaults: parameters, starts, inputs, modes of the exported network; t = 0. */
void core_reset(Core *c);

/* Numbers by kind; index within the kind. Setting marks what follows from it as stale.
 * A number that is not finite is refused (CORE_ERROR, and `core_message`). */
double core_time(const Core *c);
CoreStatus core_set_time(Core *c, double t);
CoreStatus core_set_states(Core *c, const double x[]);           /* all NX */
CoreStatus core_set_state(Core *c, int i, double value);
CoreStatus core_set_input(Core *c, int i, double value); /* NU inputs, derivatives of inputs included */
CoreStatus core_set_slope(Core *c, int i, double value); /* of an input, over the next core_advance */
CoreStatus core_set_parameter(Core *c, int i, double value); /* checked against its range */
double core_state(const Core *c, int i);
double core_input(const Core *c, int i);
double core_parameter(const Core *c, int i);
int core_mode(const Core *c, int i); /* NM modes */

/* Evaluated when stale; algebraic unknowns are solved first. Pointers stay valid until the next change. */
CoreStatus core_rates(Core *c, const double **rates); /* NX */
CoreStatus core_variables(Core *c, const double **w); /* NW other variables, outputs among them */
CoreStatus core_indicators(Core *c, const double **g); /* NG, with hysteresis: fires when it rises above 0 */

/* Solve for algebraic unknowns and consistent modes at the start. */
CoreStatus core_start(Core *c);

/* Fire transitions at this instant until none is left. `changed`: whether any state jumped. */
CoreStatus core_settle(Core *c, int *changed);

/* Whether core_settle would fire anything here: an integrator outside has stepped over a crossing. */
CoreStatus core_due(Core *c, int *due);

/* Integrate to `stop`, at most: events before it are fired on the way unless `return_early`, in which case
 * it stops on the first event, not yet fired, and says so; core_settle fires it. `fixed_step` > 0 asks for
 * equal steps (real time), without error control. Free inputs go on from where they are by those of their
 * derivatives that are inputs too. On failure the core stands where it got to. */
CoreStatus core_advance(Core *c, double stop, double rtol, double atol, double fixed_step, int return_early,
                        CoreStop *reached);

/* Derivatives of rates and other variables in the direction of states, inputs and parameters, and the
 * adjoint: seeds of rates and variables to sensitivities of states, inputs, parameters (added to what is
 * there). */
CoreStatus core_forward(Core *c, const double x[], const double u[], const double p[], double rates[],
                        double w[]);
CoreStatus core_adjoint(Core *c, const double rates[], const double w[], double x[], double u[], double p[]);

/* What went wrong last, in words: time, component, remedy. */
const char *core_message(const Core *c);

#endif

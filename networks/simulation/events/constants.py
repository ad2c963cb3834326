"""Event constants: where an event lies, what fires there and at the start, when a run is given up.

Both event loops take them from here, the one in Python as they stand, the C core as `constants.h`, which is
written with each program. What only one loop knows stands beside it.
"""

# Indicators
INDICATOR_FLOOR = 1e-12  # indicators, and rates of them, below this are zero: rounding of numbers near 1
INDICATOR_ROUNDING = 1e-12  # likewise this share of the greatest value an indicator has had
RATE_NOISE = 1e-10  # share of its fastest rate below which an indicator neither rises nor falls
LEAVING_RATIO = 10.0  # what falls does not fire until it is so many times the size of zero

# Crossings
CUBIC_CREST = 4 / 27  # share of its slopes at 0 and 1 by which a cubic may rise above its ends
CUBIC_BISECTIONS = 60  # of [0, 1], to the last bit
CUBIC_MISSES = 1e-3  # share of its range by which a cubic that follows an indicator may miss it
SAME_INSTANT = 1e-12  # s, for t of 1 s or less, else a share of t: crossings that near are one event
NARROWEST = 1e-13  # likewise: a bracket that narrow holds its crossing

# How near a crossing is gone to without the integrator. In Python by a step of the trapezoidal rule, which
# knows its error and is refused where that is too great: a long one saves calls and costs nothing. In C along
# the velocity, whose error nobody knows: 1e-3 puts events of loose runs off by 1e-6 s, 1e-6 by 1e-9 s.
HOP = 1e-3  # share of an output interval, or of the stretch between two nodes
SHIFT_SHARE = 1e-6  # share of a step

# Firing
FIRING_ROUNDS = 1000  # at one instant, after which modes are taken to switch for ever
FIRING_TOLD = 20  # of the last events of these, whose components are told
CHATTER_COUNT, CHATTER_WINDOW = 200, 1e-6  # events in that share of an output interval are chattering, ...
CROWD_COUNT = 20_000  # ... and so are as many in a whole one
IMPACT_RANK = 1e-10  # share of the greatest singular value below which an impulse or a reset has no effect
PRESSING_SPEED = 1e-12  # m/s, rad/s: contacts that approach faster pass a shock on
STOP_DEPTH = 1e-9  # m, rad: what is farther beyond a stop is not at rest on it
JUST_BEFORE = 1e-9  # s before it begins, a run asks what its signals were

# Start values
START_ROUNDS = 10  # of start values and modes, until these agree
LEAD_ROUNDS, MEET_ROUNDS = 20, 50  # of states towards what leads them, and of what must be met
START_CLOSE = 1e-13  # change, against 1 + size, at which they are found
START_MISSED = 1e-8  # likewise: by how much they may miss what is wanted
START_WEAK = 1e-12  # share of the greatest singular value below which a direction has none

# Blocks of equations that modes leave singular
BLOCK_REGULAR = 1e-6  # scaled determinant (in C: pivot) above which a block is solved as it is
BLOCK_WEAK = 1e-10  # share of the greatest singular value below which a direction has none
BLOCK_LOOSE = 1e-6  # share of the loosest unknown above which one is loose too

# Algebraic unknowns
NEWTON_ROUNDS = 50
NEWTON_CLOSE = 1e-12  # change, against 1 + size, at which they are found

# Jumps of prescribed motions
RAMP = 2.0**-50  # s: a jump is a ramp so short that finite forces count for nothing
RAMP_SHORTER = 2.0**-4  # times that: whether what moves depends on how short it is
JUMP_ROUNDING = 1e-9  # share of a signal below which it has not jumped ...
JUMP_LATE = 1e-10  # ... and how late an instant may be located, as SAME_INSTANT
JUMP_UNBOUNDED = 1e-6  # share by which a shorter ramp may move what has a bounded force
JUMP_ACCURACY = 1e-10  # of one step along a jump
JUMP_STEP = 2.0**-40  # share of a jump; steps are no shorter
JUMP_FELT_SHARE = 1e-12  # share of the greatest impulse below which none is felt
JUMP_ALIKE = 1e-9  # relative and absolute difference below which modes pass a jump on alike

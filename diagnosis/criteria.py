"""Every threshold of the diagnosis: [unit] what it bounds; what fixed it.

| fixed by | meaning |
|---|---|
| theory | a distribution or a numerical bound, as said |
| nulls | what records of the nominal model with noise reach, with room: benchmarks/blind/nulls.py |
| blind | cases of benchmarks/blind whose labels had been opened |
| data | the resolution of records, runs or floating-point numbers |
| effort | work; a verdict only where it runs out |
| telling | what is told or drawn; no verdict rests on it |
"""

# When something is missing, and when parameters are wrong
NOISE_MISFIT = 1.03  # [noise] rms residual at which nothing is left to find; nulls
COLOURED_MISFIT = 1.1  # [noise] rms residual above which something is left; nulls
MOVED_STANDARD_DEVIATIONS = 3.0  # [sd of the prior] of a parameter that has moved; theory: 0.3 % of them
CERTAIN_RESIDUAL_SHARE = 0.5  # [1] of what was left squared that each effect takes away to be named; blind
CERTAIN_GAP_SHARE = 0.89  # [1] of the squared gap above noise that those named take away together; blind
UNSTEADY_SHARE = 0.1  # [1] of the square of what is left, that an effect takes by changing with time; blind
ALIKE_RIGHT_SHARE = 0.76  # [1] of effects that are there, of those named beside others that are alike; blind
CLEAR_RIGHT_SHARE = 0.95  # [1] the same of those that are clearly better than all others; blind
EXPLAINED_GAP_SHARE = 0.95  # [1] of the gap below which what was found is not all that is missing; blind

# When one model is better than another
CLEAR_STANDARD_ERRORS = 3.0  # [standard errors] by which an effect must beat the model without it; nulls
CLEAR_RESIDUAL_RATIO = 0.5  # [1] of the squared test residual, below which 2 of them suffice; blind
ALIKE_STANDARD_ERRORS = 2.0  # [standard errors] within which models are alike; theory: 95 % of them
ALIKE_RESIDUAL_SHARE = 1e-3  # [1] of the squared test residual within which models are alike; blind
NEARLY_ALIKE_SHARE = 0.01  # [1] the same within which all records together are asked; effort
NEARLY_ALIKE_MODELS = 3  # [1] of these, the nearest; effort
ALIKE_CHI_SQUARED = 10.0  # [chi squared] over all records for models to be alike; theory: 0.2 % of 1 dof
FIRST_EFFECT_SHARE = 0.01  # [1] of the squared test residual that an effect must take away; nulls
FURTHER_EFFECT_SHARE = 0.05  # [1] the same for a further one: less but mends the shapes of those found; blind
LEFT_EFFECT_SHARE = 0.5  # [1] of the square of what is left above noise: enough instead of that; blind
GENERALISATION_SHARE = 0.25  # [1] of what a special case leaves that a generalisation takes away; blind
SURE_GENERALISATION_SHARE = 0.75  # [1] the same, whether or not most stretches tell; blind
HELD_SHARE = 1e-4  # [sd of the prior] of a parameter that is held where it was given; effort
NEARLY_ALL_LEFT = 0.1  # [1] of the squared gap, which what takes nearly all of it leaves at most; blind
ONE_MOTION_RATIO = 1.25  # [1] of what it leaves at two sites, up to which these are in one motion; blind
PART_CHI_SQUARED = 4.0  # [chi squared] that a part, or one more quantity, must win; theory: 5 % of 1 dof
EARLY_END_COST_RATIO = 0.9  # [1] of its cost to which a fit that has ended may still fall; blind
SLIGHT_NOISE_RATIO = 1.2  # [1] by which noise may turn out other, and what was fitted beside it stays; theory
STRETCH_SECONDS = 0.2, 1.0  # [s] shortest and longest by which test residuals are compared; data
LEAST_STRETCHES = 40  # [1] wanted in all test records; theory: errors of a standard error below 12 %

# Which effects are fitted
RUNS_PER_MODEL = 200  # [1] of each, fitted from several starts and probed, for the choice of solver; effort
MOST_EFFECTS = 3  # [1] in a verdict; blind
EFFECTS_BEFORE_LAW = 2  # [1] that leave more than noise beside which a law alone is looked for; effort
LEAST_CHI_SQUARED_GAIN = 40.0  # [chi squared] below which no effect is worth a fit; nulls
CONTENDERS_PER_ROUND = 12  # [1] fitted in each round; effort
CONTENDERS_BESIDE_HELD = 6  # [1] fitted from where parameters that ran away were given; effort
SCREENED_SHARE = 0.6  # [what is missed] that screening must foresee, or parameters hide it; blind
EXCESS_DEVIATIONS = 2.0  # [sd of chi squared] of what is left, to try richer laws; theory: 2 % of right ones
RESERVES_PER_ROUND = 3  # [1] of either kind that are fitted besides if much is left; effort
LOST_MISFIT = 2.0  # [noise] rms residual of a channel above which a model is lost in a stretch; effort
FOLLOWED_DROP_RATIO = 0.95  # [1] of what is missed squared, above which no more is followed; effort
FITS_UNDER_WAY = 3  # [1] at once, and before those are left out that promise much less than was found; effort
HOPELESS_GAIN_RATIO = 0.4  # [1] of the best drop of chi squared kept, below which one is left out; blind
RIVAL_DROP_RATIO = 0.7  # [1] of the best drop of the squared test residual: what may have come close; blind
RIVALS_PER_EFFECT = 5  # [1] that are tried again beside what was found since; effort
RIVALS_SCREENED = 6  # [1] that are tried besides, as screened beside what was found since; effort
BEGINNINGS = 2  # [1] first effects that the search goes on from though they say nothing alone; effort
BEGINNING_COST_RATIO = 0.8  # [1] of the training cost that such a one leaves at most; blind
ALIKE_COST_SHARE = 0.1  # [1] by which its training cost differs from others that were gone on from; effort
HIDDEN_RESIDUAL_SHARE = 0.01  # [1] of the squared test residual above which more is fitted; blind
SERIES_START_SIZES = 0.3, 1.0, 3.0  # [screened size] of effects in series, to start from; blind
FOUND_EFFECT_DEVIATIONS = 10.0  # [own size] by which an effect that was found may still change; effort
SAME_MOTION_GAIN_TOLERANCE = 1e-6  # [1] of gains within which two sites are of one motion; data
DEPENDENT_EIGENVALUE_RATIO = 1e-9  # [1] of the largest below which sizes are not told apart; data
START_SINGULAR_VALUE_RATIO = 1e-8  # [1] of the largest below which start values are not told apart; data
LEAST_INERTIA = 1e-12  # [kg, kg.m2] of a body that is added, as none has none; data
START_DROP_RATIO = 1e-3  # [1] of the squared residual that a new start must promise to be worth a run; effort
TRIED_START_DROP_RATIO = 1.0  # [1] the same on the way of a descent, where a linear answer will do; effort
FAR_COST_RATIO = 2.0  # [1] of the best known cost, above which a model's starts are not refined; effort
START_WON_SHARE = 0.1  # [1] of the drop that is asked for, which a step of it wins, or it is the last; effort
OPENING_SHARE, OPENING_SAMPLES = 0.1, 50  # [record], [1] at least: what tells first where it begins; blind
OPENING_GROWTH = 2.0  # [1] by which an opening is longer than that which was fitted before; effort
OPENING_SIZES = 1.0, 3.0, 10.0, 30.0, 100.0  # [size of a start] that are tried in the first of them; effort
OPENING_STARTS = 3  # [1] of all these from which it is fitted; effort
HORIZON_STEP = 1e-3  # [scale of the prior] of parameters that moves no output by all its range in time; data
START_STEPS, START_HALVINGS = 8, 4  # [1] runs of a record to find where it begins, and shorter steps; effort

# Shapes that are screened, and how they follow in a fit
STRIBECK_SPEED_RATIOS = 0.05, 0.3, 1.0  # [rms speed] of the site; effort
SHEAR_THINNING_SPEED_RATIOS = 0.1, 0.5  # [rms speed] of the site; data: lower ones are like dry friction
EDDY_CURRENT_SPEED_RATIOS = 0.5, 1.5  # [rms speed] of the site; data: from higher ones on it is viscous
RELAXATION_PERIOD_RATIOS = 0.1, 0.5, 2.0  # [half the range over the rms speed] of the site; effort
RIPPLES_PER_TRAVEL = 2, 60  # [1] fewest and most periods in the range of the site; data
MOST_RIPPLES_PER_TRAVEL = 1000  # [1] the same where the residual tells which are promising; effort
RIPPLE_POINTS = 8  # [1] in the shortest period, to find those; theory: 2 and more
RIPPLE_PEAK_POINTS = 4  # [1] in a peak of the residual over distance; theory: 2 and more
RIPPLE_PERIODS = 24  # [1] tried between them; effort
HARMONICS_PER_TRAVEL = 4, 60  # [1] the same with harmonics, which are any law at all over one period; data
HARMONIC_PERIODS = 12  # [1] tried between them, as the fit starts from a ripple without; effort
WAVES_LEAST_SHARE = 0.003  # [power] of waves beside an overtone, below which it is a ripple of its own; blind
FRICTION_PERIOD_RATIOS = 0.6, 2.0, 6.0  # [half the range of the site]; effort: fits converge from each
YIELD_TRAVEL_RATIOS = 0.04, 0.15, 0.6, 2.0  # [half the range of the site]; effort
YIELD_EXPONENTS = 1.0, 2.0, 4.0  # [1] how sharply hysteresis yields; effort
SLIP_TRAVEL_RATIOS = 0.3, 1.0, 3.0  # [half the range of the site] at which all of a joint slips; effort
LEAN_OF_START = 0.1  # [1] by which friction is thought to differ by direction; data
SLIP_SPREADS = 1.0, 2.0  # [1] of where cells of a joint yield; effort
PRESLIDING_TRAVEL_RATIOS = 0.002, 0.008, 0.03, 0.12  # [half the range of the site]; effort
LIMIT_RATIOS = 0.3, 0.5, 0.7, 0.85, 0.95  # [largest size of the input]; effort
SHAPE_FACTOR = 2.0  # [1] by which a shape may change at a time; effort: the grids above are not coarser
SHAPED_DESCENTS = 3  # [1] that go on from where a shape is held; effort
BOUND_TOLERANCE = 1e-6  # [1] of a bound within which it is reached; data
BOUND_SCALE_TOLERANCE = 1e-9  # [scale of the prior] the same for bounds near 0; data

# Descents of a fit
DESCENT_STEPS = 100  # [1] at most; effort
DESCENT_REACH = 30  # [1] steps in which the best model so far must be in sight; blind
DESCENT_RELATIVE_DROP = 1e-4  # [1] of chi squared that a step must promise; effort
DESCENT_CHI_SQUARED_DROP = 1.0  # [chi squared] the same beside it; theory: a standard error
DESCENT_LEAST_RADIUS = 1e-3  # [scale of the prior] below which steps see nothing but roughness; data
PROFILE_CHI_SQUARED_DROP = 1e-2  # [chi squared] that a step of a profile must promise; theory: 1 is an error
PROFILE_LEAST_RADIUS = 1e-6  # [scale of the prior] below which its steps see nothing but roughness; data
PROFILE_RESTARTS = 5  # [1] from where a profile has led to something better; effort
LEAST_SIZE_RATIO = 0.1  # [1] of the largest quantity of a kind: what a small one may be; effort

# What a small change is, by which slopes are judged
PARAMETER_STEP_RATIO = 1e-6  # [scale] of what an effect's quantities do to parameters; theory: eps to the 1/3
CHANNEL_STEP_RATIO = 1e-3  # [1] of a size of an effect on a channel; data
ACTUATOR_BEGIN_STEP = 0.05  # [1] of half of a play, by which it is told how its beginning shows; data
CHANNEL_PROBE_SHARE = 0.01  # [range of the channel] by which a channel is changed in screening; data
CLEARANCE_STEP_RATIO = 0.1  # [1] of a clearance: on a smaller scale impacts make runs rough; data
FMU_STEP_DEVIATIONS = 0.03  # [scale of the prior] of a parameter of an FMU; data
FMU_PROBE_SHARE = 0.01  # [rms of what is there] by which an input or the force at a port is pushed; data
FMU_TRIAL_FORCE = 1e-3  # [N or N.m] of a first push where there is no other; data

# Runs
RELATIVE_TOLERANCES = 1e-7, 1e-5  # [1] finest and coarsest of runs; data
TOLERANCE_OVER_NOISE = 1e-3  # [1] relative tolerance of runs over the share of noise in records; blind
SOLVER_STEPS_PER_SAMPLE = 50  # [1] granted; a model as given that needs more is far too fast; effort
SOLVER_STEPS_RATIO = 20.0  # [1] of what the model as given takes, granted to what is changed in it; effort
IMPACT_STEPS_RATIO = 2  # [1] of these, granted in series; blind: stops of true plays take at most 31 a sample
FMU_STEPS_PER_SAMPLE = 2, 8  # [1] fewest and most communication steps between compared instants; effort
FMU_STEP_ERROR_OVER_NOISE = 0.1  # [noise] by which half the communication step may change a run; data
FMU_RELATIVE_TOLERANCE = 1e-6  # [1] of runs of an FMU; data
COMPARISON_RATE_HZ = 250.0  # [Hz] at which outputs are compared; data: machines move below a tenth of it
LOW_PASS_RATE_SHARE = 0.25  # [compared rate] cut-off of a low pass before what rings; data: 6 % pass at half
FAST_NOISE_RATIO = 1.5  # [noise floor] of what is fast in an input, above which it is signal; data
NOISE_PEAK_STANDARD_DEVIATIONS = 6.0  # [sd] that noise does not exceed, as steps do; theory: 2e-9 of it
STANDSTILL_RANGE_SHARE = 3e-4  # [range of an input] within which it stands still; data: steps of 12 bits
END_SHARE = 0.005  # [record] at its ends that is not compared, as a shift would need more of it; data
LIVELY_RATIO = 10.0  # [mean square of a channel] at its beginning, above which that is compared; data
STANDSTILL_SECONDS = 0.2  # [s] that a standstill lasts, longer than any reversal; data

# Laws made smooth enough to be run, at scales that no record shows
REVERSAL_SPEED_RATIO = 0.01  # [rms speed] within which friction that cannot stick changes sides; data
STICKING_SPEED_RATIO = 0.001  # [rms speed] within which friction at a port is smooth; data
FLANKS_DAMPER_SHARE = 0.02  # [force of a spring] of its damper, from which on it relaxes in play; data
STOP_DEFLECTION_RATIO = 1e-3  # [travel] deflection of a stop under the largest force of its site; data
LEAST_FLANK_RATIO = 0.01  # [compliance of a stop] of flanks that yield; effort
OIL_DAMPER_SHARE = 1e-4  # [damping of a spring in play] of the oil beside it; data
OIL_FORCE_RATIO = 1e-4  # [largest force] of the oil in a clearance at the usual speed; data
PLAY_FORCE_RATIO = 0.02  # [largest force] at which play is taken up; data
SETTLING_SECONDS = 1e-5  # [s] in which a compliance settles; data: 1e-4 still shows beside noise of 1 %
IMPACT_SECONDS = 3e-4  # [s] in which rigid parts that meet settle; data: far below 1/COMPARISON_RATE_HZ
BALLAST_SECONDS = 1e-4  # [s] in which a ballast does beside a gap; data: far below 1/COMPARISON_RATE_HZ
LEAST_FRICTION = 1e-12  # [N or N.m] of an effect that has bristles; data
LEAST_COMPLIANCE = 1e-15  # [m/N or rad/(N.m)] of an effect; data

# Values that no machine has: refused beyond the first, doubtful beyond the second
RIPPLE_PERIODS_PASSED = 1.5, 3.0  # [1] fewest in the range of the site; theory: once it must come back
LEAST_PASSES = 1.5  # [1] of a place, for friction that depends on it; theory: twice, to tell it from time
TURNS_OF_A_SPRING = 20.0, 3.0  # [rev] most in the range of a shaft that a stiffness holds; data
FRICTION_OVER_FORCE = 10.0, 1.0  # [largest force in model and records] of dry friction; data
FRICTION_COEFFICIENT = 10.0, 1.0  # [1] of load-dependent friction; data: dry metal has 0.1 to 1
SENSOR_GAIN_RATIO = 100.0, 2.0  # [1] most of a gain, or of 1 over it, that is no unit and no sign; data
DELAY_RECORD_SHARE = 0.1, 0.03  # [longest record] of delays and lags; data
ADDED_INERTIA_RATIO = 100.0, 3.0  # [largest inertia of the model] that may be added; data
BLOCKED_COMMAND_SHARE = 1.0, 0.5  # [largest command] that an actuator may hold back; theory: all of it
YIELDING_OVER_PLAY = 1e3, 1e3  # [play] by which flanks yield under the largest force; data
KNOWN_STANDARD_DEVIATIONS = 3.0  # [sd] in a value that is known; theory: 0.3 % are 0

# Cautions
SUSPECT_SIGNAL_SHARE = 0.3  # [1] of a signal that is left, above which channels are suspected; blind
UNIT_GAIN_TOLERANCE = 0.02  # [1] by which a gain may miss the ratio of two units; data
ACTIVE_POWER_SHARE = 0.05  # [1] of the power at a port that may come out of it without a word; telling

# Where a gap lies
WINDOW_SECONDS = 0.25  # [s] by which the residual is looked at; telling
WINDOWS_GAP_SHARE = 0.8  # [1] of the gap that windows hold; telling
BAND_POWER_SHARES = 0.1, 0.9  # [1] of the gap's power below the band's ends; telling
SPECTRUM_SEGMENT_SAMPLES = 4096  # [1] at most in a segment of Welch's method; telling
LOCAL_TIME_SHARE = 0.4  # [1] of the time within which a gap is local; telling
EPISODE_TIME_SHARE = 0.1  # [1] of the time below which a gap is an episode that tells of no regime; telling
SLOW_SPEED_SHARE = 0.1  # [largest speed] below which motion reverses; telling
LARGE_MOTION_SHARE = 0.7  # [largest speed or travel] above which motion is fast or far; telling
REGIME_GAP_RATIO = 1.5  # [average gap] that makes a regime; telling

# The next experiment
TRIAL_SECONDS = 10.0  # [s]; telling
TRIAL_FADE_SECONDS = 1.0  # [s]; telling
TRIAL_RATE_HZ = 1000.0  # [Hz]; data
TRIAL_FREQUENCIES = 6  # [1] tried in the band of an input; effort
TRIAL_AMPLITUDE_SHARES = 0.25, 1.0  # [largest that was measured]; effort
INPUT_BAND_ENERGY_SHARES = 0.05, 0.95  # [1] of an input's energy below the band's ends; telling
PEAK_QUANTILE = 0.999  # [1] of a signal that counts as its largest; data
SEPARATING_MISFIT = 2.0  # [noise] rms by which models must part to be told apart; telling
DECISIVE_LOG_ODDS = 3.0  # [1] expected of the right model over another, to play it; theory: odds of 20
REST_SHARE = 0.1  # [largest distance from it] of the middle of an input, within which it rests at 0; data
DESIGN_AMPLITUDE_SHARES = 1.0, 0.3  # [largest allowed] at which each excitation is tried; effort
DESIGN_STEPS = 6  # [1] of a stepped sine; effort
DESIGN_FADE_SHARE = 0.1  # [duration] of a fade at most; telling
DESIGN_SHRINKINGS, DESIGN_SHRINKING = 6, 0.97  # [1] runs until limits hold, and to where; effort
DESIGN_CHECKS = 3  # [1] of the best experiments to which the rivals are refitted; effort
DESIGN_REFIT_SHAPES = 4  # [1] from which rivals are fitted to it, beside their own; effort
SHUTTLE_SHARE = 0.4  # [1] of the time in which what goes to and fro moves; telling
DESIGN_DRAWS = 2  # [1] of other parameters for which an experiment is to tell of them, too; effort
UNTOLD_SHARE = 0.7  # [sd before] above which an experiment tells next to nothing of a parameter; telling
REFINED_AMPLITUDE_FACTORS = 0.5, 0.7, 1.4, 2.0  # [1] tried about the best; effort
REFINED_FREQUENCY_FACTORS = 0.8, 0.9, 1.1, 1.25  # [1] of a sine, tried beside the best; effort
REFINED_SEEDS = 3  # [1] of multisines tried in the band of the best; effort
NEW_SENSOR_NOISE_SHARE = 1e-3  # [range] of noise of a sensor that is proposed; data: a good one

# The report
CHANCE_PROBABILITY = 0.05  # [1] of a test gain without the effect above which it is chance; telling
LEAST_PROBABILITY_TOLD = 1e-6  # [1]; telling
OWN_SIGNATURE_SHARE = 0.02  # [1] of a signature below which the parameters hide it; telling
NEGLIGIBLE_GAIN_SHARE = 1e-3  # [1] of the squared residual below which an effect explains nothing; telling
SITE_SHARE_TOLD = 0.01  # [1] of the gap below which a site is not told; telling
SITES_TOLD = 8  # [1]; telling
WINDOWS_TOLD = 8  # [1]; telling
WINDOW_SHARE_TOLD = 0.01  # [1] of what is left below which a stretch is not told; telling

# The missing force and its law
FORCE_SIZE_RATIO = 10.0  # [size that would explain what is missed] that a force may have; effort: it is free
FORCE_TIMES_AT_FIRST, FORCE_TIMES = 6, 12  # [1] tried for how fast a force changes; effort
FORCE_EVERY = 4  # [1] measurement by which that is told, of so many; effort
FORCE_SAMPLES = 4000  # [1] of all records by which that is told where they are long; effort
FORCE_RUNS, FORCE_MOST_RUNS = 6, 15  # [1] with the force so far, along which it is sought anew; effort
FORCE_WON_SHARE = 0.7  # [what a run missed] that more of them must come below each; effort
FORCE_HALVINGS = 4  # [1] of a force that a run cannot take; effort
FORCE_SHARES = 0.5, 0.25  # [1] of its change that are tried where a run with all of it is farther off; effort
FORCE_SETTLED = 1.02  # [what smoothing promises] that a run with the force may miss; data
LAW_POINTS = 48, 41, 24, 24, 24  # [1] of a curve over position, speed, acceleration, load, time; effort
LAW_POINTS_OF_PAIRS = 12, 15, 9, 9, 9  # [1] of a map over two of them; effort
LAW_MANY_TIMES = 2, 4  # [1] as many points over position, tried while a law misses more; effort
LAW_MOST_POINTS = 200  # [1] over position; effort
LAW_RESOLVED = 1.2  # [what the force leaves] that a law of enough points may miss; effort
LAW_SLOW_SHARE = 0.01  # [largest speed] about which points of speed lie close; data
LAW_FOLDS = 4  # [1] into which a single record is divided to see what a law foresees; effort
LAW_STIFFNESSES = tuple(10.0**n for n in range(-8, 3))  # [1] of a law against bending, tried; effort
LAW_WEAKEST_PRIOR = 1e-9  # [1] against values that nothing tells of; data
LAW_PAIR_SHARE = 0.5  # [1] of what a law of one variable leaves that one of two must come below; effort
LAW_FINER_SHARE = 0.95  # [what free runs miss] below which more points must come to be kept; effort
LAW_FINER = 4  # [1] rows of a table for each point of a smooth law; data
LAW_HELD_SHARE = 1e-3  # [1] of what tells a parameter by which it is held while a law is fitted; data
LAW_POLISHES = 20  # [1] runs with a law in the model, along which it is fitted anew; effort
LAW_STEP_SHARE, LAW_STEP_WITHIN = 0.3, 0.03  # [range of force], [largest speed] of a step at rest; telling
LAW_EVEN_SHARE = 0.03  # [range of force] by which a law may miss a symmetry; telling
LAW_WAVES = 4  # [1] turns from which a law is called a wave; telling
LAW_MEMORY_SHARE = 0.1  # [1] of what is missing that no law of position and speed foresees; telling
LAW_POINTS_DRAWN = 4000  # [1] of a record; telling
FORCE_SUFFICES = 1.2  # [noise] that a run with the force may miss, to be sought from one place only; effort
FORCE_PARAMETER_STEP = 1.0  # [scale of the prior] by which a parameter may move from run to run; data
ALIGNED_ROUNDS, ALIGNED_LEVELS = 6, 33  # [1] of records that are aligned, constants tried in each; effort
FORCE_LAW_STIFFNESS = 1e-4  # [1] of a law drawn through the force before it is fitted to runs; effort
LAW_SITES = 3  # [1] at which laws are tried, the likeliest for a force first; effort
LAW_FORESEEN_SHARE = 0.8  # [1] of what is missing that a law must foresee to be tried in free runs; blind
LAW_SHOWN_SHARE = 0.65  # [1] of the missing force itself that a law may foresee instead; blind
LAW_CLOSED_SHARE = 0.8  # [1] of the gap on the test runs that a law must close; blind
LAW_CHANGING_SHARE = 0.1  # [1] of the square of what it leaves, that it takes by changing with time; blind
LAW_LEAVES_SHARE = 0.5  # [1] of what effects at a site leave that a law in their place may leave; blind
LAW_MANY_PARTS = 3  # [1] effects at a site that a law of one variable replaces if it leaves as little; blind
LAW_LEAST_GAIN = 0.01  # [1] of what is missing that a richer law must foresee more; effort
LOST_SHARE = 0.2  # [standard deviation of an output] by which a run with a law is lost; data
LOST_GAP_SHARE = 0.05  # [what the model without it misses] by which one with play is; data
LOST_LEAST = 4.0  # [noise] by which it is at least; data
LOST_STANDARD_DEVIATIONS = 10.0  # [noise] rms by which a whole run is; data
LOST_SAMPLES = 3  # [1] in a row for which it is; effort
PIECE_SAMPLES = 32  # [1] of a piece at least; data
PIECE_MOST_SAMPLES = 160  # [1] of one that is followed closely; data
PIECE_ROUNDS = 4  # [1] in which records are cut by a law, and the law fitted to the pieces; effort
PIECES = 15  # [1] of a record at most, if they are all of it; effort
PIECES_AT_FIRST = 4  # [1] of a record, however short, before there seem to be too many; effort
PIECES_SPREAD = 24  # [1] of a record, some of which are followed, if not; effort
PIECE_GROWS = 2.0, 1.25  # [1] by which a part grows while a run follows it, and one that does closely; effort
PIECE_FITS = 2  # [1] of an effect to pieces, that are cut by the one before; effort
PIECE_STARTS = 3  # [1] runs in which it is looked for where a piece begins; effort
SIZED_RANGE = 0.5, 2.0  # [size that is likely] within which it is looked for, of what is in series; effort
SIZED_FINENESS = 0.003  # [1] of it, to which it is looked for; effort
SIZED_NEAR = 3.0  # [noise] up to which short runs are near; data
SIZED_FAR = 1e3  # [noise] that what cannot be run is off; effort
SIZED_BEGINS = 32  # [1] in all records, of the runs by which it is sized; effort
SIZED_SAMPLES = 60  # [1] of the runs by which it is sized; effort
LIKENED_POINTS = 4000  # [1] of all records at which effects are likened to a law; effort
LIKENED_VALUES = 1e-12, 1e3, 300  # [SI] first, last and count, of what is in series with a spring; effort
LIKENED_SHAPE_SPREAD = 0.01  # [1] by which shapes of effects are first changed to be liker; effort
PIECE_KEPT = 0.8  # [1] of how far a run is followed after which another piece begins; data
LIKENED_SHARE = 0.8  # [1] of a law that an effect must have to be tried in its place; effort
LOST_LENGTH_SHARE = 0.5  # [distance over which a law changes] by which a run with it is lost; data
LIKENED_LEAST_GAIN = 0.01  # [1] of a law that an effect must have more than a simpler one; effort
PIECE_WON_SHARE = 0.8  # [1] of what a law left before that it must come below to be cut by again; effort

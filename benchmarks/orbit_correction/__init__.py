"""Benchmarks of the orbit correction: the gauge alpha(N) of a state, and N_min.

states    seeded random states, the sets of impulses, and the interface of a peer's solver
cones     the gauge as a cone programme: Clarabel through its own interface
modelled  the same through CVXPY
linear    the square as a linear programme: HiGHS through SciPy and through its own interface
gauges    the gauge for a given number of steps, and the fewest steps, side by side
roots     SciPy's root finders on the paper's system (11)
growth    time against the number of steps
aims      times of our solvers beside the aims
figures   plots of these measurements
measure   all of these measurements
"""

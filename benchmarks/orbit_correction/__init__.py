"""Orbit correction with the fewest impulses: the gauge of a state, and N_min.

states    seeded random states, and ours as contestants
cones     the gauge as a cone programme: Clarabel through its own interface
modelled  the same through CVXPY
linear    the square as a linear programme: HiGHS through SciPy and through its own interface
gauges    the gauge for given steps, and the fewest steps, side by side
roots     SciPy's root finders on the paper's system (11)
growth    time against the number of steps
aims      our solvers against the aims
figures   its plots
measure   everything at once
"""

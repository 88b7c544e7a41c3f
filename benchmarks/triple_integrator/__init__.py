"""Turns about one axis: least time, energy, peak and impulse.

problems     seeded random problems, degenerate classes among them
propagation  the state after a control of constant pieces, in extended precision, by no solver's formula
transfers    least time: ruckig
fixed_time   least energy, peak and impulse for a given time
grids        peak and impulse as linear programmes: Clarabel, HiGHS
collocation  energy and peak by generic tools: SciPy's solve_bvp, CasADi with Ipopt
stacks       throughput of our solvers against the aims and the size of the stack
accuracy     worst miss and gap over a million problems
start        the cost of the first call: imports, compilation, command line
figures      the plots
measure      all tables and plots
"""

"""The solvers side by side with the peers a reader would otherwise use; run ``python -m benchmarks``.

clock        processor time of contestants who take turns
contest      contestants on the same problems, and the rows that come of it
problems     seeded random problems, degenerate classes among them
propagation  where a control given by its pieces leads, in extended precision, by no solver's formula
peers        which peers are installed
transfers    least time: ruckig
fixed_time   least energy, peak and impulse for a given time
grids        peak and impulse as linear programmes: Clarabel, HiGHS
collocation  energy and peak by generic tools: SciPy's solve_bvp, CasADi with Ipopt
stacks       throughput of our solvers against the aims and the size of the stack
accuracy     worst miss and gap over a million problems
start        what the first call costs: imports, compilation, command line
table        rows to CSV, Markdown and terminal
figures      the plots
run          everything at once
"""

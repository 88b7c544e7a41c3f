"""The solvers side by side with the peers a reader would otherwise use; run ``python -m benchmarks``.

clock        processor time of contestants who take turns
problems     seeded random problems, degenerate classes among them
propagation  where a control given by its pieces leads, in extended precision, by no solver's formula
peers        which peers are installed
transfers    least time: ruckig
grids        least peak and least impulse as linear programmes: Clarabel, HiGHS
collocation  least energy and least peak by generic tools: SciPy's solve_bvp, CasADi with Ipopt
stacks       throughput of our solvers against the size of the stack
accuracy     worst residual and gap over a million problems
start        what the first call costs: imports, compilation, command line
table        rows to CSV, Markdown and terminal
figures      the plots
"""

"""The solvers side by side with the peers a reader would otherwise use: ``python -m benchmarks [PAPER ...]``.

papers             which papers are measured, and what measuring one gives
triple_integrator  the first paper
orbit_correction   the second
averaging          the third
clock              processor time of contestants who take turns
contest            contestants on the same problems, and the rows that come of it
peers              which peers are installed
table              rows to CSV, Markdown and terminal
figures            the plot that every paper has
run                measure, print, write
"""

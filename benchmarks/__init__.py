"""Benchmarks of the solvers beside other packages: ``python -m benchmarks [PAPER ...]``.

papers             the papers that are measured, and the result of measuring one
triple_integrator, orbit_correction, averaging, rendezvous
                   the benchmarks of each paper
clock              processor time of contestants that run in turns
contest            contestants on the same problems, and a row of results for each
fresh              seconds of the steps of a script in a fresh process
clarabel_programme linear cone programmes for Clarabel
peers              which of the other packages are installed
table              rows as CSV, Markdown and terminal tables
figures            the plot of accuracy against time
run                measuring, printing and writing
"""

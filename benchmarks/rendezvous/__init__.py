"""Benchmarks of the low-thrust rendezvous: forms of the equations, solve times, stacks of flights.

problems          the problems that are measured
systems           the forms of the equations, compiled with or without derivatives, and their residuals
forms             operations and times of the right-hand sides with 16, 14, 11 and 10 equations
starts            Newton's method from random starts in each form, and the condition of each Jacobian
collocation       SciPy's solve_bvp on the repaired form, with its Jacobian
pykep_peer        pykep's least-time problem, in an interpreter of its own
pykep_least_time  the program that this interpreter runs
integrators       native code, heyoka and SciPy
first_solve       a solve in a fresh process
solves            solve times of several methods
aims              times of our solver against their aims
stacks            flights one by one and many in one call
figures           the plots
measure           all tables and plots
"""

"""Low-thrust rendezvous: forms of the equations, ways to a solution, many flights at once.

problems    the problems measured
systems     a form of the equations compiled, with or without derivatives, and what a flight of it says
forms       operations and times of the right-hand sides with 16, 14, 11 and 10 equations
starts      Newton's method from random starts in each form, and the condition of each Jacobian
collocated  SciPy's solve_bvp on the repaired form, given its Jacobian
elsewhere   pykep's least-time problem, in an interpreter of its own
solves      solve times side by side
aims        our solver against the aims
stacks      flights one by one and in heyoka's vector mode
figures     its plots
measure     everything at once
"""

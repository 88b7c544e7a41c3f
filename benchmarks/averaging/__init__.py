"""Time-optimal control of oscillations by averaging: the first approximation beside the exact problem.

examples     the paper's examples, in two forms the rotor, and a user's own system; stacks of each
aims         averaged solves and the engine's build against the aims
start        first calls in a fresh process
enumeration  all exact extremals for falling epsilon, beside the averaged solve
flows        the exact canonical equations by heyoka, DOP853 and LSODA
collocation  SciPy's solve_bvp from the averaged solution, and where it lands among the extremals
figures      its plots
measure      everything at once
"""

"""Benchmarks of optimal control by averaging: the first approximation compared with the exact problem.

examples     the paper's examples (the rotor with two costs), a system of a user's own, stacks of each
aims         times of averaged solves, compared with the aim
start        first calls in a fresh process, and the time to build a system
enumeration  all exact extremals for decreasing epsilon, compared with the averaged solve
flows        the exact canonical equations by native code, heyoka, DOP853 and LSODA
collocation  SciPy's solve_bvp from the averaged solution, and the extremal that it finds
figures      plots of the results
measure      all tables and plots together
"""

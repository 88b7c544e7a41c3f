"""The meeting on each lap: extremals in equinoctial elements, as a start for Newton's method on flights.

ends             what a transcription needs to know of a transfer
equinoctial      elements of craft and target; costates of the reduced form
cartesian        the same in Cartesian coordinates, which no plane makes singular
hamiltonian      the running cost, the regularised Hamiltonian and its derivatives
transcription    the extremal on a lap, by the midpoint rule and Newton's method
start            first guesses: the best transfers for equations linearised about a given path
shapes           first paths in space, which rise to an apex
descent          paths of least energy in space, by nonlinear least squares
power            a cost between least energy and least time: a power of the thrust
families         continuation to the target, to the bound and to least time
folds            a walk over the duration by arclength, which goes on where the duration turns back
ladder           all transfers of free duration on a lap
"""

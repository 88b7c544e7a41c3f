"""The meeting on each lap: extremals in equinoctial elements, as a start for Newton's method on flights.

equinoctial      elements of craft and target; costates of the reduced form
hamiltonian      the running cost, the regularised Hamiltonian and its derivatives
transcription    the extremal on a lap, by the midpoint rule and Newton's method
start            first guesses: the best transfers for equations linearised about a given path
power            a cost between least energy and least time: a power of the thrust
families         continuation to the target, to the bound and to least time
ladder           all transfers of free duration on a lap
"""

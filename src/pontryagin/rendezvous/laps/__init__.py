"""The meeting on each lap: extremals in equinoctial elements, as a start for Newton's method on flights.

equinoctial      elements of craft and target; costates of the reduced form
hamiltonian      the running cost, the regularised Hamiltonian and its derivatives
transcription    the extremal on a lap, by the midpoint rule and Newton's method
start            a first guess: the best transfer for equations linearised about a given path
families         continuation to the duration, the bound and the cost that are asked for
ladder           all transfers of free duration on a lap
"""

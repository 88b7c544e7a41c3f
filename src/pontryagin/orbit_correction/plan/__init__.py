"""Plans of impulses for the satellite: the fewest steps and, among those, the least peak, energy or fuel.

`thrust` has the three sets of admissible impulses and their gauges for stacks of states. `correction` finds
N_min and the plan of least peak (Theorem 4, Lemma 10). `alternatives` finds plans of the same length with the
least energy or the least fuel.
"""

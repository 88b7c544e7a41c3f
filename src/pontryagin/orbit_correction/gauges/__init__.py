"""The gauge alpha of a state in a 0-controllable set, Lemma 7 and Lemma 9, for each shape of the controls.

`ellipsoids` has the paper's case; `kinks` the disc, whose ellipsoids are flat; `zonotope` the square; `pball`
the p-balls between ball and cube. `general` has the gauge of any `DiscreteSystem`. `columns` has the linear
programme that `pball` and the plans of least fuel solve. `proof` rejects an answer whose bounds do not agree.
"""

"""The gauge alpha of a state in a 0-controllable set, Lemma 7 and Lemma 9, for each shape of the controls.

`ellipsoids` is the paper's case, `kinks` the disc, whose ellipsoids are flat, `zonotope` the square, `pball`
the p-balls between ball and cube. `general` is the gauge of any `DiscreteSystem`. `columns` is the linear
programme beneath `pball` and the plans of least fuel; `proof` refuses an answer whose bounds do not meet.
"""

"""Derivation of the rendezvous (Pimkina & Chelnokov; Sapunkov) in SymPy, from first principles.

One module per step of the argument: `model` has the equations of motion from Newton's law, `principle` the
maximum principle in 16 dimensions, `reduction` the ten equations, `transversality` the moving end. `repair`
finds what the reduction loses and restores it, `terminal` turns the conditions at the end into a law for
the thrust there, `variation` finds those conditions and the slope of the cost by the first variation. `forms`
hands the equations to the solvers; `primer`, `inertial` and `canonical` prove them anew from Cartesian
coordinates. `symbols` prints some as the paper does. `sapunkov` leads from the Kustaanheimo-Stiefel
regularisation to Sapunkov's elements.
"""

"""Derivation of the rendezvous (Pimkina & Chelnokov; Sapunkov) in SymPy, from first principles.

One module for each step of the argument:

model                equations of motion from Newton's law, (2), (3); the target, (5), (6)
principle            maximum principle in 16 dimensions, (7) to (10)
reduction            the ten equations (11), (12), (13), (14) and the Hamiltonian (17)
transversality       the moving end, (16)
repair               the information on the attitude that (15) loses, and the equation that restores it
terminal             (16) and (17) at a meeting as a law for the thrust at t_k
variation            these conditions and the slope of the cost by the first variation
forms                the closed equations that the solvers use, with the optimal thrust
primer, inertial,    independent proofs of the equations, from Cartesian coordinates
canonical
sapunkov             Sapunkov's elements and (1), from the Kustaanheimo-Stiefel regularisation
sapunkov_principle   maximum principle in these elements
equinoctial          Gauss's equations in equinoctial elements; a regular independent variable
quaternion, symbols  Hamilton's quaternions; symbols that print as in the paper
"""

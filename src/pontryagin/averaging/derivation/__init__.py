"""Derivation of the averaged optimum (Akulenko 1977) in SymPy, from first principles.

`principle` derives the canonical equations of a general standard system and eliminates the phase's costate,
`averaged` averages them, `optimum` proves the main result. `ripple` is the simplest example whose Hamiltonian
depends on the phase. The other modules are the examples of section 3, except `correction`: the first
correction of the cost.
"""

"""Derivation of the averaged optimum (Akulenko 1977) in SymPy, from first principles.

`principle` takes a general standard system to its canonical equations and removes the phase's costate,
`averaged` averages them, `optimum` proves the main result. `ripple` is their smallest instance with a phase.
The other modules are the examples of section 3.
"""

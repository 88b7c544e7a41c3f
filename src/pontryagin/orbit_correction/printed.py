"""The paper's worked example as printed at the end of section 7: the problem, N_min, alpha and both tables.

Claims, figures and recordings read the numbers of this example from here. Numbers are strings, so that the
number of printed digits is known.
"""

INTERVAL, PEAK = "0.25", "0.0035"
"""The time between impulses Delta t and the bound alpha_max on an impulse component."""

FEWEST_STEPS, GAUGE = "4", "0.9286"
"""N_min, and alpha, the Minkowski functional of X(4, 0) at z0."""

STATES = (
    ("-0.37787e-2", "-0.39109e-2", "1.41512e-2"),
    ("-0.30870e-2", "0.58472e-2", "1.03056e-2"),
    ("-0.19824e-2", "0.59918e-2", "0.47280e-2"),
    ("0.00698e-2", "0.35937e-2", "0.07851e-2"),
    ("0", "0", "0"),
)
"""The states x*(0) = z0 to x*(4) of the first table, as rows."""

COSTATES = (
    ("0.1294", "0.2360", "-0.9631"),
    ("0.1500", "-0.3167", "-0.9219"),
    ("0.2617", "-0.5720", "-0.6986"),
    ("0.6534", "-0.9623", "0.0850"),
)
"""The adjoint vectors psi(0) to psi(3) of the first table, as rows."""

CONTROLS = (
    ("-0.04354e-2", "-0.24779e-2", "-0.27185e-2"),
    ("-0.08869e-2", "-0.40092e-2", "-0.35862e-2"),
    ("-0.17352e-2", "-0.52475e-2", "-0.01554e-2"),
    ("-0.10099e-2", "-0.38877e-2", "0.01550e-2"),
)
"""The controls u*(0) to u*(3) of the second table, as rows."""

Z0 = tuple(float(number) for number in STATES[0])
"""The initial deviation, as numbers."""

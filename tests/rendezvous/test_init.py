"""Importing the package is cheap."""

import subprocess
import sys


def test_importing_the_package_loads_neither_sympy_nor_an_integrator():
    heavy = "{'sympy', 'heyoka', 'scipy.integrate', 'numba', 'casadi', 'matplotlib'}"
    code = f"import sys, pontryagin.rendezvous as r; r.Orbit; print({heavy} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "set()"

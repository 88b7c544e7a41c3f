"""Numerical methods that no paper owns: flows, arcs, Newton's method, continuation, quadrature."""

"""Numerical methods that know no paper: flows, arcs, Newton's method, continuation, quadrature."""

"""Numerical methods independent of the papers: flows, arcs, Newton's method, continuation, quadrature."""

"""The averaged boundary value problem (2.11), (2.4), (2.12): its solution, certificate and correction."""

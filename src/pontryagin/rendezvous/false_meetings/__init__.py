"""False meetings: extremals that satisfy the paper's ten equations and miss the target."""

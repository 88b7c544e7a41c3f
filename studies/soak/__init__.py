"""The soak: random problems of every solver, certificates on all, foreign solvers on a stratified sample."""

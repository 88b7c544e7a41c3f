"""Figures, tables, recordings and what a notebook shows."""

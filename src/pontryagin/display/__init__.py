"""Figures, tables, recordings, and what notebooks display."""

"""Figures of Akulenko 1977, each a function from a solution to a Matplotlib figure."""

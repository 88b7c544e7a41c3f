"""The manoeuvre, its disturbance, and controls with the motion that they cause, (0.6) to (1.16)."""

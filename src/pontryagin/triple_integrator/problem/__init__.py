"""The manoeuvre, its disturbance, and the motion that a control makes of them, (0.6) to (1.16)."""

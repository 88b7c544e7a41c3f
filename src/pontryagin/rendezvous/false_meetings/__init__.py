"""False meetings: extremals that satisfy the paper's end conditions and miss the target.

`printed_conditions` evaluates (5), (15), (16) and (17); `rotated_target` holds the repaired equations for a
target rotated about the invariant nu*, whose solutions satisfy the printed conditions; `meeting` describes
one solution, and `family` follows the curve of these solutions from a true meeting.
"""

from itertools import chain

from pontryagin.orbit_correction.claims import statement

IN_ORDER = (statement,)
ENTRIES = tuple(chain.from_iterable(part.claim for part in IN_ORDER))

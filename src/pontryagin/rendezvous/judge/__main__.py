"""``python -m pontryagin.rendezvous.judge``: solve the report's cases by the direct method."""

import sys

from pontryagin.rendezvous.judge.table import main

main(sys.argv[1:])

"""``python -m pontryagin.report``: build the report."""

import sys

from pontryagin.report.build import main

if __name__ == "__main__":
    sys.exit(main())

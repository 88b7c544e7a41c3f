"""The array type used in annotations."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
"""An array of double-precision numbers; its shape is stated where it is used."""

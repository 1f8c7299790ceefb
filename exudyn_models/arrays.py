"""Types of arrays."""

import numpy as np
from numpy.typing import NDArray

__all__ = ["Array", "Flags", "Indices"]

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Indices = NDArray[np.int64]

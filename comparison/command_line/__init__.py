"""The command line.

Linear algebra gets one thread, unless the user says otherwise: matrices are small, and where two processes share two
cores, a second thread in each makes both a third to two thirds slower. This stands here because it must
happen before NumPy is imported.
"""

import os

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(name, "1")

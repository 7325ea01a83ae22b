"""Settings that hold for every test."""

import os

# before numpy is loaded: workers must not compete for the cores
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

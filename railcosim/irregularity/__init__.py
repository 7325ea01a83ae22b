"""What rails and wheels are uneven by: spectra, signals that have them, defects, the contact patch.

Pure functions of numbers: no scenario, no files. A drop is in metres, positive where the surface
lies too low; positions run along the rail, wavenumbers W are angular [rad/m], spectra S one-sided:
the variance of the wavenumbers between W1 and W2 is the integral of S over W from W1 to W2.
"""

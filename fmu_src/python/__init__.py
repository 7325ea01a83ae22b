"""Models as FMI 2.0 co-simulation slaves in Python, through pythonfmu."""

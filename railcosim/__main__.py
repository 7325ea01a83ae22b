"""`python -m railcosim` is the command `railcosim`."""

from .cli import main

main()

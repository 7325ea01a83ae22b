"""Railcosim: the passage of a bogie with a wheel flat, from a scenario to a result.

The application joins the track FMU, the vehicle FMU and the master; nothing imports it.
"""

__version__ = "0.1.0"

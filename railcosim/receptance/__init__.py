"""Receptance of the track: displacement over force against frequency, direct and modal."""

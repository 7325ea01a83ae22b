"""Track parameters fitted to measurements."""

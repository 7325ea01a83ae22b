"""What the commands show on the terminal: progress, and tables of results."""

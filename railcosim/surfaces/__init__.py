"""What rail and wheels are uneven by: composed, written for the FMUs, labelled, in numbers."""

"""What turns a model into a functional mock-up unit (FMU)."""

"""The models in C, what compiles them and what writes the resources they start from."""

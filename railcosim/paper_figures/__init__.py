"""The figures of the paper's study: what is run for them, what is said under them."""

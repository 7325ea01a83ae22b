"""The histories of a passage: from the outputs of the FMUs, kept while it runs."""

"""Figures of passages and of studies, one kind a file."""

"""The track: complex modal model of a discretely supported rail with state-dependent supports.

Pure numerics. No files, no co-simulation interface, no vehicle. From the parameters to a model:
`parameters` -> `assembly` -> `modal` -> `reduction` -> `track_model.TrackModel`.
"""

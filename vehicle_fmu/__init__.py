"""The vehicle: rigid wheels in Hertzian contact with a rail whose displacement is given.

Pure numerics. No files, no co-simulation interface, no track. Start at
`vehicle_model.VehicleModel`; the other modules each hold one ingredient of it.
"""

"""One self-contained HTML page about a passage; needs the extra `report`."""

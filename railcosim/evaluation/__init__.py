"""What engineers work out from the result of a passage: functions from datasets to datasets."""

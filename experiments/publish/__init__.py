"""What others read: the report of a run, the findings over all runs, drawings."""

"""The page of the scenario families, and a drawing of each."""

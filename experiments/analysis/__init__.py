"""From the rows of a run to outcomes, rates and costs, and to the comparison of two runs."""

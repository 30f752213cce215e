"""Cases: the queries of the benchmark. Scenario families draw two bodies, their poses and a
motion, aimed at one difficulty.
"""

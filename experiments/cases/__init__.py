"""Cases: what is asked. Scenario families draw two bodies, their poses and a motion, aimed at a
difficulty."""

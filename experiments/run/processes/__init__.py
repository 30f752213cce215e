"""Worker processes: a method that crashes, hangs or fills the memory costs its own row and no
other.
"""

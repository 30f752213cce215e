"""Worker processes: a method that crashes, hangs or exhausts the memory loses only its own row."""

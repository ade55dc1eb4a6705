"""A motion law by itself: its constants, the vibration that it leaves, and what is proved of it. Begin with design."""

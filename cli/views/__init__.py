"""Pictures: figures, scenes, animations, the page."""

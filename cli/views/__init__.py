"""Pictures: figures, scenes, films, the page."""

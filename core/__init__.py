"""The engine: pure functions on floats and arrays, and one lazy design class per kind."""

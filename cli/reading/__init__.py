"""From text to spec: YAML with marks, validation, and what is reported against a file.

Begin with `design_file`.
"""

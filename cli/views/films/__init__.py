"""Moving pictures: frames from a scene, as GIF, MP4 or a page with a player.

Begin with `stage`.
"""

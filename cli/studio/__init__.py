"""The design under the hand: `gearlink studio` shows a file in the browser, every number of it on a slider.

`text` changes values where they stand, `numbers` says what the sliders may do, `study` computes, `page` shows.
"""

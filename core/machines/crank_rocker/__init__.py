"""The crank-rocker as a design: analysis of given links in `design`, links from a task in `synthesis`."""

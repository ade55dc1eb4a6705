"""Published cases: data with their sources, computed by the program itself, shown beside what their sources print."""

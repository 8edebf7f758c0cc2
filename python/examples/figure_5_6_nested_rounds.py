"""Figure 5.6: nested curves of the curve of figure 4.2 at the first to the fifth round, edge-filtered."""

from figure import save
from nested_rows import rows

if __name__ == "__main__":
    save(__doc__, "figure_5_6", lambda small: rows(["edge-filter"], 24 if small else 60, rounds=(1, 2, 3, 4, 5)))

"""Figure 5.5: nested curves, their axes before and after edge filtering.

What the filter takes away in one round is not there to breed further triangles in the next.
"""

from figure import save
from nested_rows import rows

if __name__ == "__main__":
    save(__doc__, "figure_5_5", lambda small: rows(("initial", "edge-filter"), 24 if small else 48))

"""Figure 5.3: nested curves, their axes before and after pole filtering."""

from figure import save
from nested_rows import rows

if __name__ == "__main__":
    save(__doc__, "figure_5_3", lambda small: rows(("initial", "poles"), 24 if small else 48))

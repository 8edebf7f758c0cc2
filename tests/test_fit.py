"""Fitting: the search finds what is known, a fit recovers recipes from their own pictures."""

from __future__ import annotations

import time

import numpy as np
import pytest

import crazing as cz
from crazing.measure import stamp, thin
from crazing.search import minimize


def bowl(x: np.ndarray) -> float:
    return float(((x - [0.2, 0.7, 0.5]) ** 2).sum() + 0.05 * np.sin(40 * x[0]))


def test_search_finds_the_bottom_and_keeps_to_its_budget() -> None:
    calls: list[int] = []
    start, spread = [0.5, 0.5, 0.5], [0.3, 0.3, 0.0]
    found = minimize(bowl, start, spread, budget=300, rng=3, progress=lambda spent, best: calls.append(spent))
    assert bowl(found[0]) < 0.001
    assert calls == list(range(1, 301))
    # What has no spread stays.
    assert found[0][2] == 0.5
    again = minimize(bowl, start, spread, budget=300, rng=3)
    assert all((a == b).all() for a, b in zip(found, again, strict=True))
    other = minimize(bowl, start, spread, budget=300, rng=4)
    assert not (found[0] == other[0]).all()


def test_residuals_find_the_bottom_sooner_than_their_loss() -> None:
    mixed = np.cos(np.arange(96.0).reshape(12, 8) ** 2)

    def residuals(x: np.ndarray) -> np.ndarray:
        return mixed @ (x - np.linspace(0.2, 0.8, 8)) + 0.02 * np.sin(40 * x[0])

    def loss(found: np.ndarray) -> np.ndarray:
        return np.abs(found).mean(axis=-1)

    for seed in (1, 2):
        how = {"budget": 80, "rng": seed}
        blind = minimize(lambda x: float(loss(residuals(x))), [0.5] * 8, [0.3] * 8, **how)
        led = minimize(residuals, [0.5] * 8, [0.3] * 8, loss=loss, **how)
        assert loss(residuals(led[0])) < 0.5 * loss(residuals(blind[0]))
    held = minimize(residuals, [0.5] * 8, [0.3] * 7 + [0.0], loss=loss, budget=60, rng=1)
    assert all(each[7] == 0.5 for each in held)


def test_search_stops_at_its_time_and_in_a_broken_generation() -> None:
    calls: list[int] = []
    minimize(bowl, [0.5] * 3, [0.3] * 3, budget=10**9, ending=0.0, rng=1, progress=lambda n, _: calls.append(n))
    assert calls == [1]
    # 20 is a generation and a quarter.
    assert len(minimize(bowl, [0.5] * 3, [0.3] * 3, budget=20, rng=1)) == 6


@pytest.mark.parametrize(("n", "opening"), [(120, 0.4), (260, 0.75), (150, 1.0)])
def test_the_first_guess_knows_density_and_opening(n: int, opening: float) -> None:
    crack = cz.crack(n=n, opening=opening, rng=5)
    guess = cz.fit(stamp(crack, 700), budget=0)
    assert guess.n == pytest.approx(n, rel=0.3)
    assert guess.opening == pytest.approx(opening, abs=0.15)
    assert guess.thickness > 0


def test_a_fit_recovers_a_recipe_from_its_own_picture() -> None:
    true = cz.Recipe(n=110, relax=1, opening=0.65, rounds=3, slide=0.3, turn=50.0, thickness=0.06)
    mask = stamp(true.crack(rng=2), 400)
    spent: list[tuple[int, float]] = []
    found = cz.fit(mask, budget=32, rng=1, progress=lambda *each: spent.append(each))
    assert [count for count, _ in spent] == list(range(1, 33))
    assert spent[-1][1] <= spent[0][1]
    assert found.opening == pytest.approx(true.opening, abs=0.15)
    assert found.n == pytest.approx(true.n, rel=0.35)
    wanted = {name: (value, 0.0) for name, value in cz.measure(mask).to_dict().items() if np.isfinite(value)}
    score, thesis = (
        np.mean([cz.measure(recipe.crack(rng=seed), raster=400).score(wanted) for seed in (7, 8, 9)])
        for recipe in (found, cz.Recipe(n=110))
    )
    assert score < 0.75 * thesis


def test_a_fit_tells_short_branches_from_long_cracks() -> None:
    true = cz.Recipe(n=150, relax=1, opening=0.9, rounds=3, slide=0.3, turn=50.0, thickness=0.06, tree="kruskal")
    found = cz.fit(stamp(true.crack(rng=2), 400), budget=48, rng=1)
    assert found.tree == "kruskal"
    assert found.opening == pytest.approx(true.opening, abs=0.1)


def test_a_fit_tries_steps_that_its_guess_does_without(monkeypatch: pytest.MonkeyPatch) -> None:
    mask = stamp(cz.crack(n=60, opening=0.5, rng=2), 300)
    tried: list[cz.Recipe] = []
    made = cz.Recipe.crack
    monkeypatch.setattr(cz.Recipe, "crack", lambda self, **how: (tried.append(self), made(self, **how))[1])
    cz.fit(mask, budget=16, rng=1)
    for name in ("tree", "unbend", "rounds", "warp", "rounding", "stubs", "patchiness"):
        values = {getattr(recipe, name) for recipe in tried}
        assert len(values) > 1, name
    # Pulling at what nothing meets is tried left out, and done several times.
    assert {0, 1, 3} <= {recipe.unbend for recipe in tried}


def test_a_seed_and_a_budget_are_a_recipe() -> None:
    mask = stamp(cz.crack(n=60, opening=0.5, rng=2), 300)
    assert cz.fit(mask, budget=3, rng=1) == cz.fit(mask, budget=3, rng=1)
    assert cz.fit(mask, budget=3, rng=1, seconds=1e6) == cz.fit(mask, budget=3, rng=1)


@pytest.mark.parametrize("seconds", [0.0, 40.0, 90.0])
def test_a_fit_keeps_to_its_time_with_the_choice_among_the_best(
    monkeypatch: pytest.MonkeyPatch, seconds: float
) -> None:
    """Search and nothing else kept to it: with none it still measured 57 patterns."""
    mask = stamp(cz.crack(n=20, opening=0.5, rng=2), 150)
    clock, made = [100.0], cz.Recipe.crack

    def slow(self: cz.Recipe, **how: object) -> cz.Crack:
        clock[0] += 1.0
        return made(self, **how)

    monkeypatch.setattr(cz.Recipe, "crack", slow)
    tried: list[int] = []
    with monkeypatch.context() as patch:
        patch.setattr(time, "monotonic", lambda: clock[0])
        cz.fit(mask, seconds=seconds, rng=1, progress=lambda spent, _: tried.append(spent))
    # A pattern a second. Of a choice each candidate takes nine.
    assert tried[-1] >= max(1, (seconds - 54) // 3)
    assert clock[0] - 100 <= max(seconds + 9, 3)
    # With time for all of it, the choice is made.
    assert seconds < 54 or clock[0] - 100 >= 3 * tried[-1] + 54


def test_lines_without_width_say_nothing_of_width() -> None:
    mask = thin(stamp(cz.crack(n=80, opening=0.5, rng=2), 400))
    default = cz.Recipe()
    found = cz.fit(mask, budget=2, rng=1)
    assert (found.thickness, found.hierarchy, found.taper) == (default.thickness, default.hierarchy, default.taper)


@pytest.mark.parametrize("pixels", [8, 13])
def test_broad_lines_that_are_all_alike_are_known_by_their_width(pixels: int) -> None:
    """Lines of any one width once counted as thin: walls with joints of 8 and of 13 pixels had one guess."""
    wall = np.zeros((400, 400), bool)
    for row, top in enumerate(range(10, 400, 40)):
        wall[top : top + pixels] = True
        for left in range(20 + 40 * (row % 2), 400, 80):
            wall[top : top + 40, left : left + pixels] = True
    guess = cz.fit(wall, budget=0)
    drawn = [cz.measure(guess.crack(rng=seed), raster=400).width for seed in range(3)]
    assert np.mean(drawn) == pytest.approx(pixels, rel=0.3)
    assert guess.hierarchy == guess.taper == 0


def test_a_long_mask_is_measured_in_squares() -> None:
    crack = cz.Recipe(n=300, opening=0.6).crack(bounds=(0, 0, 3, 1), rng=4)
    assert cz.fit(stamp(crack, 900), budget=0).n == pytest.approx(100, rel=0.35)


def test_a_mask_without_cracks_is_refused() -> None:
    with pytest.raises(cz.CrazingError, match="no line with an end or a junction"):
        cz.fit(np.zeros((50, 60)))


def test_ground_taken_for_crack_is_refused_at_once() -> None:
    mask = stamp(cz.crack(n=20, rng=1), 100)
    with pytest.raises(ValueError, match=r"crack in 9\d% of its pixels.* dark=True what is dark"):
        cz.fit(~mask)
    assert cz.fit(~mask, dark=True, budget=0) == cz.fit(mask, budget=0)


def test_bad_budgets_are_named() -> None:
    mask = stamp(cz.crack(n=20, rng=1), 100)
    with pytest.raises(ValueError, match="budget"):
        cz.fit(mask, budget=-1)
    with pytest.raises(ValueError, match="seconds"):
        cz.fit(mask, seconds=-1.0)

"""Recipes: TOML there and back, clear refusals, presets that make what they say."""

from __future__ import annotations

import dataclasses
import os
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import crazing as cz


@pytest.mark.parametrize("name", cz.presets())
def test_every_preset_makes_a_crack_and_says_where_it_is_from(name: str) -> None:
    recipe = cz.preset(name)
    assert recipe.title and recipe.citation
    flat, torus = cz.crack(preset=name, n=60, rng=1), cz.crack(preset=name, n=60, period=(2, 1), rng=1)
    assert len(flat.graph.edges) > 20 and flat.period is None
    assert len(torus.graph.edges) > 20 and torus.period == (2, 1) and torus.bounds == (0, 0, 2, 1)
    assert flat == recipe.replace(n=60).crack(rng=1)


def test_the_thesis_is_the_recipe_with_every_step_off() -> None:
    assert cz.crack(rng=7) == cz.Recipe().crack(rng=7)
    assert cz.crack(rng=7) == cz.crack(n=300, opening=1, rounds=0, rng=7)


SPLITTING = [name for name in cz.presets() if cz.preset(name).generator == "splitting"]


def oldest(name: str, seed: int, period: tuple[float, float] | None) -> np.ndarray:
    """Places along the first crack of a preset, from wherever on a torus it starts."""
    c = cz.crack(preset=name, period=period, rng=seed)
    return c.graph.vertices[np.unique(c.graph.edges[c.strand == 0])]


#: Presets that are mazes and warped.
WARPED = [name for name in cz.presets() if cz.preset(name).warp and cz.preset(name).generator == "maze"]


@pytest.mark.parametrize("period", [None, (1, 1)])
@pytest.mark.parametrize(("first", "second"), list(combinations(SPLITTING, 2)))
def test_presets_of_one_seed_have_nothing_to_do_with_each_other(first: str, second: str, period) -> None:
    """Two materials of one scene, both with seed 0, once shared their first crack, place and line."""
    apart = []
    for seed in range(8):
        a, b = (oldest(name, seed, period) for name in (first, second))
        apart.append(np.linalg.norm(a[:, None] - b, axis=-1).min(axis=1).mean())
    assert np.median(apart) > 0.1


def bends(name: str, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Where the vertices of a preset are before its warp, and which way that moves them."""
    bare = cz.preset(name).replace(stubs=0, roughness=0, rounding=0, turn=180, hairpin=180)
    after, before = (r.crack(rng=seed).graph.vertices for r in (bare, bare.replace(warp=0)))
    return before, after - before


@pytest.mark.parametrize(("first", "second"), list(combinations(WARPED, 2)))
def test_presets_of_one_seed_are_not_bent_alike(first: str, second: str) -> None:
    """Mazes of one seed once shared the waves of their warp, whatever they were carved in."""
    alike = []
    for seed in range(6):
        (here, one), (there, other) = bends(first, seed), bends(second, seed)
        nearest = np.argmin(((here[:, None] - there) ** 2).sum(axis=-1), axis=1)
        alike.append(np.corrcoef(one.ravel(), other[nearest].ravel())[0, 1])
    assert np.median(alike) < 0.5


def test_variants_differ_and_the_recipe_of_one_is_one_pattern() -> None:
    how = {"generator": "splitting", "n": 40, "rng": 3}
    plain, other = cz.crack(**how), cz.crack(**how, variant=1)
    assert plain == cz.crack(**how, variant=0) and other == cz.crack(**how, variant=1)
    assert not set(map(tuple, plain.graph.vertices)) & set(map(tuple, other.graph.vertices))
    # Little by little: with one knob turned a little, places are nearly where they were.
    near = cz.crack(**how, variant=1, warp=0.001).graph.vertices
    assert 0 < np.abs(near - other.graph.vertices).max() < 0.01


@settings(max_examples=30, deadline=None)
@given(
    title=st.text(),
    opening=st.floats(0, 1),
    n=st.integers(0, 10**6),
    tree=st.sampled_from(["kruskal", "prim"]),
)
def test_toml_there_and_back(tmp_path_factory, title: str, opening: float, n: int, tree: str) -> None:
    path = tmp_path_factory.mktemp("recipe") / "mine.toml"
    recipe = cz.Recipe(title=title, opening=opening, n=n, tree=tree, citation='a "quote" \\ and\nmore')
    recipe.save(path)
    read = cz.Recipe.load(path)
    assert dataclasses.astuple(read) == dataclasses.astuple(recipe)


FAULTS = {
    "[recipe]\nopning = 1": (
        ValueError,
        r"mine.toml: \[recipe\] has no key 'opning' \(did you mean 'opening'[^)]*\?\); it may have generator, n",
    ),
    "[recipe]\nopening = 2": (ValueError, r"mine.toml: opening is 2.0; a finite number from 0 to 1"),
    "[recipe]\nopening = nan": (ValueError, r"mine.toml: opening is nan"),
    "[recipe]\nopening = 'all'": (TypeError, r"mine.toml: opening is 'all'; a real number"),
    "[recipe]\nn = 1.5": (TypeError, r"mine.toml: n is 1.5; an integer"),
    "[recipe]\ntree = 'oak'": (ValueError, r"mine.toml: tree is 'oak'; one of"),
    "[recipe]\ntree = 3": (ValueError, r"mine.toml: tree is 3; one of"),
    "[recipe]\ntitle = 'x'": (ValueError, r"mine.toml: \[recipe\] has no key 'title'"),
    "title = 3\n[recipe]": (TypeError, r"mine.toml: title is 3; text"),
    "[targets]\nn = 1": (ValueError, r"mine.toml has no table \[recipe\]; it has targets"),
    "": (ValueError, r"mine.toml has no table \[recipe\]; it has nothing"),
    "recipe = 3": (ValueError, r"mine.toml: recipe is 3; one table \[recipe\] is wanted"),
    "[[recipe]]\nn = 9": (ValueError, r"mine.toml: recipe is \[{'n': 9}\]; one table \[recipe\] is wanted"),
    "recipe = [": (ValueError, r"mine.toml is no TOML file"),
    "\udcff": (ValueError, r"mine.toml is no TOML file"),
}


@pytest.mark.parametrize("text", FAULTS)
def test_faults_of_a_file_are_named(tmp_path: Path, text: str) -> None:
    error, message = FAULTS[text]
    path = tmp_path / "mine.toml"
    path.write_bytes(text.encode("utf-8", "surrogateescape"))
    with pytest.raises(error, match=message):
        cz.Recipe.load(path)


@pytest.mark.parametrize("end", ["\n", "\r\n"])
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig"])
def test_files_of_any_editor_are_read(tmp_path: Path, encoding: str, end: str) -> None:
    path = tmp_path / "mine.toml"
    path.write_bytes(f'title = "é"{end}[recipe] # mine{end}n = 9{end}'.encode(encoding))
    assert dataclasses.astuple(cz.Recipe.load(path)) == dataclasses.astuple(cz.Recipe(title="é", n=9))


def test_a_title_of_no_text_is_still_written(tmp_path: Path) -> None:
    """The name of a file, of which a fit makes its title, may be of any bytes."""
    recipe = cz.Recipe(title=os.fsdecode(b"Fit to caf\xe9.png"))
    recipe.save(tmp_path / "mine.toml")
    assert cz.Recipe.load(tmp_path / "mine.toml").title == recipe.title == "Fit to caf?.png"


def test_other_faults_are_named(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="preset is 'marble'; one of"):
        cz.crack(preset="marble")
    with pytest.raises(ValueError, match="the name of a step is 'curl'; one of"):
        cz.crack(curl=1)
    for wrong in (np.zeros((2, 2)), np.zeros((4, 2)), np.arange(3.0), ()):
        with pytest.raises((TypeError, ValueError), match=r"^bounds(\[0\])? (is|has) "):
            cz.crack(n=9, bounds=wrong)
    assert cz.crack(n=9, bounds=np.array([0, 0, 2, 1])).bounds == (0, 0, 2, 1)
    with pytest.raises(ValueError, match="bounds and period are both given"):
        cz.crack(period=(1, 1), bounds=(0, 0, 1, 1))
    with pytest.raises(FileNotFoundError):
        cz.Recipe.load(tmp_path / "none.toml")
    with pytest.raises(TypeError, match="preset='glaze'"):
        cz.crack("glaze")
    with pytest.raises(ValueError, match=r"'thicknes' \(did you mean 'thickness'"):
        cz.crack(thicknes=1)


@pytest.mark.parametrize("idle", [{"opening": 0.5}, {"opening": 1.0}, {"sampler": "laplace"}])
@pytest.mark.parametrize("kind", [{"preset": "glaze"}, {"preset": "glass-impact"}, {"generator": "splitting"}])
def test_what_only_mazes_have_is_refused_elsewhere(kind: dict[str, str], idle: dict[str, object]) -> None:
    with pytest.raises(ValueError, match=f"{next(iter(idle))} is given; it does nothing for the generator"):
        cz.crack(n=30, rng=1, **kind, **idle)
    # A recipe keeps what its generator does not look at.
    recipe = (cz.preset(kind["preset"]) if "preset" in kind else cz.Recipe(**kind)).replace(n=30)
    assert recipe.replace(**idle).crack(rng=1) == recipe.crack(rng=1)


@pytest.mark.parametrize(
    "given", [{"density": np.zeros((3, 3))}, {"density": lambda x, y: 0 * x, "generator": "splitting"}]
)
def test_a_density_of_nothing_is_refused_by_every_generator(given):
    with pytest.raises(cz.CrazingError, match="density is 0 everywhere"):
        cz.crack(n=9, **given)

//! Maps of a crack pattern into arrays that NumPy owns.

use crazing::Watch;
use crazing::levels::Scale;
use crazing::texture::{Maps, Material, Pattern, Sides, View, Window, texture as draw};
use numpy::{Element, PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2, PyReadonlyArrayDyn, PyReadwriteArrayDyn};
use pyo3::prelude::*;

use crate::arrays::{rows, table};
use crate::guard::detached;

/// Vertices, edges, shifts, width, strand and generation of a crack.
type PatternArrays<'py> = (
    PyReadonlyArray2<'py, f64>,
    PyReadonlyArray2<'py, i32>,
    PyReadonlyArray2<'py, i8>,
    PyReadonlyArray2<'py, f64>,
    PyReadonlyArray1<'py, i32>,
    PyReadonlyArray1<'py, i32>,
);

/// Plates on both sides of the edges, the middles of these from the edges' first ends, and the reach of every plate.
type SideArrays<'py> = (PyReadonlyArray2<'py, i32>, PyReadonlyArray2<'py, f64>, PyReadonlyArray1<'py, f64>);

macro_rules! fields {
    ($given:ident, $kind:ident { $($name:ident),* } { $($color:ident),* }) => {
        $kind {
            $($name: $given.get_item(stringify!($name))?.extract()?,)*
            $($color: $given.get_item(stringify!($color))?.extract()?,)*
        }
    };
}

fn material(given: &Bound<'_, PyAny>) -> PyResult<Material> {
    Ok(fields!(given, Material {
        relief, widest, depth, roundness, rim, rim_width, chip, chip_size, fray, curl, curl_width, curl_spread, tilt,
        level, grain, grain_size, tint, mottle, mottle_size, speckle, stretch, dirt_amount, dirt_width, dirt_taper, wear, wear_width, roughness,
        roughness_spread, crack_roughness, debris
    } { plate, crack, dirt, worn }))
}

/// The maps that a dictionary holds, writeable.
type Given<'py, T> = Option<PyReadwriteArrayDyn<'py, T>>;

fn given<'py, T: Element>(maps: &Bound<'py, PyAny>, name: &str) -> PyResult<Given<'py, T>> {
    if maps.contains(name)? { Ok(Some(maps.get_item(name)?.extract()?)) } else { Ok(None) }
}

fn slice<'a, T: Element>(map: &'a mut Given<'_, T>) -> PyResult<Option<&'a mut [T]>> {
    map.as_mut().map(|map| map.as_slice_mut().map_err(PyErr::from)).transpose()
}

/// What [`SideArrays`] borrows, new.
type NewSides<'py> = (Bound<'py, PyArray2<i32>>, Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<f64>>);

fn view<'a>(arrays: &'a PatternArrays<'_>) -> PyResult<Pattern<'a>> {
    let (vertices, edges, shifts, widths, strand, generation) = arrays;
    Ok(Pattern {
        vertices: rows(vertices)?,
        edges: rows(edges)?,
        shifts: rows(shifts)?,
        widths: rows(widths)?,
        strand: strand.as_slice()?,
        generation: generation.as_slice()?,
    })
}

/// The plates beside the edges of a crack, as [`texture`] wants them; on so many threads, 0 for one a core.
#[pyfunction]
pub(crate) fn plates<'py>(
    py: Python<'py>,
    pattern: PatternArrays<'py>,
    bounds: [f64; 4],
    period: Option<[f64; 2]>,
    threads: usize,
) -> PyResult<NewSides<'py>> {
    let pattern = view(&pattern)?;
    let work = |watch: Watch<'_>| crazing::texture::plates(&pattern, bounds, period, watch);
    let found = detached(py, |watch| crazing::in_pool_of(threads, || work(watch)))?;
    let middles =
        found.middles.into_iter().map(|middles| middles.as_flattened().try_into().unwrap_or([0.0; 4])).collect();
    Ok((table(py, found.plates)?, table::<f64, 4>(py, middles)?, PyArray1::from_vec(py, found.reaches)))
}

/// The length of all edges of a crack together, and the width that one end in twenty exceeds; on so many threads, 0 for
/// one a core.
#[pyfunction]
pub(crate) fn extent(
    py: Python<'_>,
    pattern: PatternArrays<'_>,
    period: Option<[f64; 2]>,
    threads: usize,
) -> PyResult<(f64, f64)> {
    let pattern = view(&pattern)?;
    let work = || crazing::texture::extent(&pattern, period);
    detached(py, |_| crazing::in_pool_of(threads, work)).map(|found| (found.length, found.widest))
}

/// Writes the maps in `out`, C-contiguous arrays by name, for a window (top, left, height, width) of a picture that shows
/// `bounds`; the plates of the crack end at `ends`.
#[pyfunction]
#[allow(clippy::too_many_arguments, reason = "the face passes them one by one")]
pub(crate) fn texture(
    py: Python<'_>,
    pattern: PatternArrays<'_>,
    sides: SideArrays<'_>,
    ends: [f64; 4],
    bounds: [f64; 4],
    size: (usize, usize),
    period: Option<[f64; 2]>,
    window: (i64, i64, usize, usize),
    material: &Bound<'_, PyAny>,
    key: [u64; 2],
    threads: usize,
    out: &Bound<'_, PyAny>,
) -> PyResult<()> {
    let material = self::material(material)?;
    let pattern = view(&pattern)?;
    let middles = rows::<f64, 4>(&sides.1)?;
    let middles = middles.as_flattened().as_chunks::<2>().0.as_chunks::<2>().0;
    let sides = Sides { plates: rows(&sides.0)?, middles, reaches: sides.2.as_slice()?, bounds: ends };
    let view = View { bounds, height: size.0, width: size.1, period };
    let (top, left, height, width) = window;
    let window = Window { top, left, height, width };
    let (mut mask, mut color) = (given(out, "mask")?, given(out, "color")?);
    let (mut height, mut normal, mut ao) = (given(out, "height")?, given(out, "normal")?, given(out, "ao")?);
    let (mut roughness, mut wear) = (given(out, "roughness")?, given(out, "wear")?);
    let (mut distance, mut direction) = (given(out, "distance")?, given(out, "direction")?);
    let (mut cell, mut strand, mut generation) =
        (given(out, "cell")?, given(out, "strand")?, given(out, "generation")?);
    let maps = Maps {
        mask: slice(&mut mask)?,
        color: slice(&mut color)?,
        height: slice(&mut height)?,
        normal: slice(&mut normal)?,
        ao: slice(&mut ao)?,
        roughness: slice(&mut roughness)?,
        wear: slice(&mut wear)?,
        distance: slice(&mut distance)?,
        direction: slice(&mut direction)?,
        cell: slice(&mut cell)?,
        strand: slice(&mut strand)?,
        generation: slice(&mut generation)?,
    };
    detached(py, |watch| draw(pattern, sides, &view, window, &material, key, threads, watch, maps))
}

/// Levels of either kind.
#[derive(FromPyObject)]
pub(crate) enum Levels<'py> {
    Shallow(PyReadwriteArrayDyn<'py, u8>),
    Deep(PyReadwriteArrayDyn<'py, u16>),
}

/// Writes C-contiguous numbers as the nearest levels into an array of the same size; `low` is level 0.
#[pyfunction]
pub(crate) fn levels(
    py: Python<'_>,
    numbers: PyReadonlyArrayDyn<'_, f32>,
    low: f32,
    steep: f32,
    out: Levels<'_>,
) -> PyResult<()> {
    let (numbers, scale) = (numbers.as_slice()?, Scale { low, steep });
    match out {
        Levels::Shallow(mut out) => {
            let out = out.as_slice_mut()?;
            detached(py, |_| scale.levels(numbers, out))
        }
        Levels::Deep(mut out) => {
            let out = out.as_slice_mut()?;
            detached(py, |_| scale.levels(numbers, out))
        }
    }
}

//! Measuring of drawings and masks.

use crazing::measure::{self, Drawing, Gauge, Mask};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::arrays::{rows, table};
use crate::guard::{checked, detached};

type Picture<'py> = Bound<'py, PyArray2<bool>>;
type Found<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<i32>>, Bound<'py, PyArray1<f64>>);

/// Vertices, edges, periods crossed by each edge, width at both ends of each edge; the last two may have no row.
#[derive(FromPyObject)]
pub(crate) struct Lines<'py>(
    PyReadonlyArray2<'py, f64>,
    PyReadonlyArray2<'py, i32>,
    PyReadonlyArray2<'py, i8>,
    PyReadonlyArray2<'py, f64>,
);

impl Lines<'_> {
    fn drawing(&self, period: [f64; 2], bounds: Option<[f64; 4]>) -> PyResult<Drawing<'_>> {
        let (vertices, edges) = (rows(&self.0)?, rows(&self.1)?);
        Ok(Drawing { vertices, edges, shifts: rows(&self.2)?, period, widths: rows(&self.3)?, bounds })
    }
}

fn mask(pixels: &PyReadonlyArray2<'_, bool>) -> PyResult<Mask> {
    let (height, width) = (pixels.shape()[0], pixels.shape()[1]);
    checked(Mask::new(pixels.as_slice()?.to_vec(), height, width))
}

fn picture<'py>(py: Python<'py>, found: Mask) -> PyResult<Picture<'py>> {
    PyArray1::from_vec(py, found.pixels).reshape([found.height, found.width])
}

#[pyfunction]
pub(crate) fn thin<'py>(py: Python<'py>, pixels: PyReadonlyArray2<'py, bool>) -> PyResult<Picture<'py>> {
    let mask = mask(&pixels)?;
    let found = detached(py, |watch| measure::thin(&mask, watch))?;
    picture(py, found)
}

/// Vertices, edges, and the width at every vertex, in pixels.
#[pyfunction]
pub(crate) fn trace<'py>(
    py: Python<'py>,
    pixels: PyReadonlyArray2<'py, bool>,
    spur: f64,
    merge: f64,
) -> PyResult<Found<'py>> {
    let mask = mask(&pixels)?;
    let found = detached(py, |watch| measure::trace(&mask, spur, merge, watch))?;
    Ok((table(py, found.graph.vertices)?, table(py, found.graph.edges)?, PyArray1::from_vec(py, found.width)))
}

#[pyfunction]
pub(crate) fn stamp<'py>(
    py: Python<'py>,
    lines: Lines<'py>,
    period: [f64; 2],
    bounds: [f64; 4],
    size: (usize, usize),
) -> PyResult<Picture<'py>> {
    let drawing = lines.drawing(period, None)?;
    let found = detached(py, |watch| measure::stamp(&drawing, bounds, size.0, size.1, watch))?;
    picture(py, found)
}

/// Name and value of every statistic. `gauge` is border, reach, arc, stride, lag, box size, hole.
#[pyfunction]
pub(crate) fn statistics<'py>(
    py: Python<'py>,
    lines: Lines<'py>,
    period: [f64; 2],
    bounds: Option<[f64; 4]>,
    area: f64,
    gauge: [f64; 7],
) -> PyResult<Vec<(&'static str, f64)>> {
    let drawing = lines.drawing(period, bounds)?;
    let [border, reach, arc, stride, lag, box_size, hole] = gauge;
    let gauge = Gauge { border, reach, arc, stride, lag, box_size, hole };
    detached(py, |watch| measure::statistics(&drawing, area, gauge, watch))
}

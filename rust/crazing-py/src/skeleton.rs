//! Curves and skeletons of a diagram.

use crazing::DiagramView;
use crazing::skeleton;
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arrays::{column, rows, rows_mut, table, unwritten};
use crate::diagram::Arrays;
use crate::guard::detached;

type Mask<'py> = Bound<'py, PyArray1<bool>>;

/// Whether each edge is crust by a method that looks at the diagram alone.
#[pyfunction]
pub(crate) fn crust_mask<'py>(py: Python<'py>, arrays: Arrays<'py>, method: &str) -> PyResult<Mask<'py>> {
    let view = arrays.view()?;
    let mask = match method {
        "one-step" => detached(py, |_| skeleton::one_step(view)),
        "gabriel" => detached(py, |_| skeleton::gabriel(view)),
        "nn" => detached(py, |watch| skeleton::nearest(view, watch)),
        _ => return Err(PyValueError::new_err(format!("no crust method {method:?}"))),
    };
    Ok(PyArray1::from_vec(py, mask?))
}

type OneStep<'py> = (Mask<'py>, Table<'py>, Table<'py>);
type Table<'py> = Bound<'py, PyArray2<i32>>;

/// Whether each edge is one-step crust, the edges that are, and the dual edges of the others that are drawn.
#[pyfunction]
pub(crate) fn one_step<'py>(py: Python<'py>, arrays: Arrays<'py>) -> PyResult<OneStep<'py>> {
    // Indices are looked at on the way.
    let view = arrays.unchecked()?;
    let found = detached(py, |_| skeleton::one_step_drawn(view))?;
    let [crust, axis] = found.counts();
    let (crust, axis) = (unwritten::<_, 2>(py, crust)?, unwritten::<_, 2>(py, axis)?);
    let mut held = [crust.readwrite(), axis.readwrite()];
    let [first, second] = &mut held;
    let (first, second) = (rows_mut(first)?, rows_mut(second)?);
    detached(py, |_| {
        found.draw(view, first, second);
        Ok(())
    })?;
    drop(held);
    Ok((PyArray1::from_vec(py, found.into_mask()), crust, axis))
}

/// For every side of every triangle the same side as seen from across.
#[pyfunction]
pub(crate) fn links<'py>(py: Python<'py>, arrays: Arrays<'py>) -> PyResult<Bound<'py, PyArray1<u32>>> {
    let view = arrays.view()?;
    Ok(PyArray1::from_vec(py, detached(py, |_| Ok(skeleton::links(view)))?))
}

/// The one-step crust and the links of a diagram, as its face keeps them.
#[derive(FromPyObject)]
pub(crate) struct Known<'py>(PyReadonlyArray1<'py, bool>, PyReadonlyArray1<'py, u32>);

impl Known<'_> {
    fn of(&self, view: DiagramView<'_>) -> PyResult<skeleton::Known<'_>> {
        Ok(skeleton::Known {
            one_step: column(&self.0, "one_step", view.edges.len())?,
            links: column(&self.1, "links", 3 * view.triangles.len())?,
        })
    }
}

/// Whether each edge is in the two-pass crust.
#[pyfunction]
pub(crate) fn two_pass<'py>(py: Python<'py>, arrays: Arrays<'py>, known: Known<'py>) -> PyResult<Mask<'py>> {
    let view = arrays.view()?;
    let known = known.of(view)?;
    Ok(PyArray1::from_vec(py, detached(py, |_| skeleton::two_pass_among(view, known))?))
}

/// Whether each edge is part of the curve through all samples.
#[pyfunction]
pub(crate) fn curve<'py>(py: Python<'py>, arrays: Arrays<'py>) -> PyResult<Mask<'py>> {
    let view = arrays.view()?;
    Ok(PyArray1::from_vec(py, detached(py, |watch| skeleton::curve(view, watch))?))
}

/// Rows of the edges of the curve through all samples.
#[pyfunction]
pub(crate) fn curve_edges<'py>(py: Python<'py>, arrays: Arrays<'py>) -> PyResult<Bound<'py, PyArray2<i32>>> {
    let view = arrays.view()?;
    table(py, detached(py, |watch| skeleton::curve_edges(view, watch))?)
}

type Floats<'py> = Bound<'py, PyArray1<f64>>;
type Sides<'py> = (Mask<'py>, Mask<'py>, Floats<'py>);

/// Whether each dual edge is inside the rings of the masked edges, whether one passes between its ends, and its arc
/// residual.
#[pyfunction]
pub(crate) fn sides<'py>(
    py: Python<'py>,
    arrays: Arrays<'py>,
    mask: PyReadonlyArray1<'py, bool>,
) -> PyResult<Sides<'py>> {
    let view = arrays.view()?;
    let mask = column(&mask, "mask", view.edges.len())?;
    let (inside, crossed, residuals) = detached(py, |watch| {
        let (rings, inside) = skeleton::Rings::with_inside(view, mask, false, watch)?;
        Ok((inside, rings.walls_between().to_vec(), rings.residuals()))
    })?;
    Ok((PyArray1::from_vec(py, inside), PyArray1::from_vec(py, crossed), PyArray1::from_vec(py, residuals)))
}

/// Whether each dual edge is inside rings that are known and hold no splinters, its arc residual, and its arc.
#[pyfunction]
pub(crate) fn spans<'py>(
    py: Python<'py>,
    arrays: Arrays<'py>,
    boundary: PyReadonlyArray1<'py, bool>,
) -> PyResult<(Mask<'py>, Floats<'py>, Floats<'py>)> {
    let view = arrays.view()?;
    let boundary = column(&boundary, "boundary", view.edges.len())?;
    let (inside, residuals, arcs) = detached(py, |watch| {
        let (rings, inside) = skeleton::Rings::with_inside(view, boundary, true, watch)?;
        let residuals = rings.residuals();
        let arcs = rings.arcs(&residuals);
        Ok((inside, residuals, arcs))
    })?;
    Ok((PyArray1::from_vec(py, inside), PyArray1::from_vec(py, residuals), PyArray1::from_vec(py, arcs)))
}

/// Edges of a boundary that the kept axis passes, and the site opposite each.
#[pyfunction]
pub(crate) fn beyond<'py>(
    py: Python<'py>,
    arrays: Arrays<'py>,
    boundary: PyReadonlyArray1<'py, bool>,
    kept: PyReadonlyArray1<'py, bool>,
) -> PyResult<Table<'py>> {
    let view = arrays.view()?;
    let wanted = view.edges.len();
    let (boundary, kept) = (column(&boundary, "boundary", wanted)?, column(&kept, "kept", wanted)?);
    table(py, detached(py, |_| skeleton::beyond(view, boundary, kept))?)
}

/// Whether each edge joins a site to the next of its ring; `starts` are where the rings start, and the number of sites.
#[pyfunction]
pub(crate) fn ring_edges<'py>(
    py: Python<'py>,
    arrays: Arrays<'py>,
    starts: PyReadonlyArray1<'py, i64>,
) -> PyResult<Mask<'py>> {
    let view = arrays.view()?;
    let starts = starts.as_slice()?;
    Ok(PyArray1::from_vec(py, detached(py, |_| skeleton::ring_edges(view, starts))?))
}

/// An axis without the tips that are no higher than `least`.
#[pyfunction]
pub(crate) fn without_bumps<'py>(
    py: Python<'py>,
    arrays: Arrays<'py>,
    mask: PyReadonlyArray1<'py, bool>,
    axis: PyReadonlyArray1<'py, bool>,
    least: f64,
) -> PyResult<Mask<'py>> {
    let view = arrays.view()?;
    let (mask, axis) = (column(&mask, "mask", view.edges.len())?, column(&axis, "axis", view.edges.len())?);
    let kept = detached(py, |watch| skeleton::Rings::of(view, mask, watch)?.without_bumps(axis, least, watch))?;
    Ok(PyArray1::from_vec(py, kept))
}

/// An axis without what spans less than `least` of its ring, and without what noise of the samples explains.
#[pyfunction]
pub(crate) fn without_hairs<'py>(
    py: Python<'py>,
    arrays: Arrays<'py>,
    mask: PyReadonlyArray1<'py, bool>,
    axis: PyReadonlyArray1<'py, bool>,
    least: f64,
) -> PyResult<Mask<'py>> {
    let view = arrays.view()?;
    let (mask, axis) = (column(&mask, "mask", view.edges.len())?, column(&axis, "axis", view.edges.len())?);
    let kept = detached(py, |watch| skeleton::Rings::of(view, mask, watch)?.without_hairs(axis, least, watch))?;
    Ok(PyArray1::from_vec(py, kept))
}

/// An axis without the edges worth less than `least`, but for those that hold it together.
#[pyfunction]
pub(crate) fn peeled<'py>(
    py: Python<'py>,
    arrays: Arrays<'py>,
    axis: PyReadonlyArray1<'py, bool>,
    worth: PyReadonlyArray1<'py, f64>,
    least: f64,
) -> PyResult<Mask<'py>> {
    let view = arrays.view()?;
    let (axis, worth) = (column(&axis, "axis", view.edges.len())?, column(&worth, "worth", view.edges.len())?);
    Ok(PyArray1::from_vec(py, detached(py, |watch| skeleton::peeled(view, axis, worth, least, watch))?))
}

/// The same grown at its tips along what was taken off, where one way alone spans enough of the boundary.
#[pyfunction]
pub(crate) fn reaching<'py>(
    py: Python<'py>,
    arrays: Arrays<'py>,
    axis: PyReadonlyArray1<'py, bool>,
    worth: PyReadonlyArray1<'py, f64>,
    arcs: PyReadonlyArray1<'py, f64>,
    least: f64,
) -> PyResult<Mask<'py>> {
    let view = arrays.view()?;
    let wanted = view.edges.len();
    let (axis, worth) = (column(&axis, "axis", wanted)?, column(&worth, "worth", wanted)?);
    let arcs = column(&arcs, "arcs", wanted)?;
    Ok(PyArray1::from_vec(py, detached(py, |watch| skeleton::reaching(view, axis, worth, arcs, least, watch))?))
}

/// Which edges are left when branches that measure less are taken off.
#[pyfunction]
pub(crate) fn branches<'py>(
    py: Python<'py>,
    vertices: PyReadonlyArray2<'py, f64>,
    edges: PyReadonlyArray2<'py, i32>,
    radius: PyReadonlyArray1<'py, f64>,
    by_radius: bool,
    least: f64,
) -> PyResult<Mask<'py>> {
    let (vertices, edges) = (rows(&vertices)?, rows(&edges)?);
    let radius = column(&radius, "radius", vertices.len())?;
    let measure = if by_radius { skeleton::Measure::Radius } else { skeleton::Measure::Length };
    let kept = detached(py, |watch| skeleton::branches(vertices, edges, radius, measure, least, watch))?;
    Ok(PyArray1::from_vec(py, kept))
}

/// The rows of edges along the longest path.
#[pyfunction]
pub(crate) fn longest_path<'py>(
    py: Python<'py>,
    vertices: PyReadonlyArray2<'py, f64>,
    edges: PyReadonlyArray2<'py, i32>,
) -> PyResult<Bound<'py, PyArray1<i32>>> {
    let (vertices, edges) = (rows(&vertices)?, rows(&edges)?);
    Ok(PyArray1::from_vec(py, detached(py, |watch| skeleton::longest(vertices, edges, watch))?))
}

/// Two poles a site, by the thesis or by Amenta and Bern.
#[pyfunction]
pub(crate) fn poles<'py>(py: Python<'py>, arrays: Arrays<'py>, amenta: bool) -> PyResult<Bound<'py, PyArray2<i32>>> {
    let view = arrays.view()?;
    table(py, detached(py, |watch| skeleton::poles(view, variant(amenta), watch))?)
}

/// Edges between two poles in the triangulation of sites and poles.
#[pyfunction]
pub(crate) fn poles_axis<'py>(
    py: Python<'py>,
    arrays: Arrays<'py>,
    amenta: bool,
) -> PyResult<Bound<'py, PyArray2<i32>>> {
    let view = arrays.view()?;
    table(py, detached(py, |watch| skeleton::poles_axis(view, variant(amenta), watch))?)
}

fn variant(amenta: bool) -> skeleton::Variant {
    if amenta { skeleton::Variant::Amenta } else { skeleton::Variant::Thesis }
}

type Masks<'py> = (Bound<'py, PyArray1<bool>>, Bound<'py, PyArray1<bool>>);

/// Two-pass crust and edge-filtered axis.
#[pyfunction]
pub(crate) fn edge_filter<'py>(py: Python<'py>, arrays: Arrays<'py>, known: Known<'py>) -> PyResult<Masks<'py>> {
    let view = arrays.view()?;
    let known = known.of(view)?;
    let found = detached(py, |_| skeleton::edge_filter_among(view, known))?;
    Ok((PyArray1::from_vec(py, found.crust), PyArray1::from_vec(py, found.axis)))
}

/// The axis alone, where the crust is known, too.
#[pyfunction]
pub(crate) fn filtered_axis<'py>(py: Python<'py>, arrays: Arrays<'py>, known: Known<'py>) -> PyResult<Mask<'py>> {
    let view = arrays.view()?;
    let known = known.of(view)?;
    Ok(PyArray1::from_vec(py, detached(py, |_| skeleton::filtered_among(view, known))?))
}

/// Edges of the initial axis, by the second triangulation.
#[pyfunction]
pub(crate) fn initial<'py>(py: Python<'py>, arrays: Arrays<'py>) -> PyResult<Bound<'py, PyArray2<i32>>> {
    let view = arrays.view()?;
    table(py, detached(py, |watch| skeleton::second(view, watch))?.axis)
}

/// Dual edges of the masked rows that join two different finite vertices.
#[pyfunction]
pub(crate) fn axis_edges<'py>(
    py: Python<'py>,
    arrays: Arrays<'py>,
    mask: PyReadonlyArray1<'py, bool>,
) -> PyResult<Bound<'py, PyArray2<i32>>> {
    let view = arrays.duals()?;
    let mask = column(&mask, "mask", view.dual_edges.len())?;
    table(py, detached(py, |_| Ok(skeleton::axis_edges(view, mask)))?)
}

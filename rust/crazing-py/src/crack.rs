//! The steps of a crack.

use crazing::crack::{self, Fence, FenceView, Net, NetView, Profile, Straightening};
use numpy::{PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::arrays::{column, rows, table};
use crate::diagram::Arrays;
use crate::guard::{checked, detached};

type Table<'py, T> = Bound<'py, PyArray2<T>>;
type Row<'py, T> = Bound<'py, PyArray1<T>>;

/// A drawing as the face passes it: vertices, edges, shifts, period, cut.
#[derive(FromPyObject)]
pub(crate) struct NetArrays<'py>(
    PyReadonlyArray2<'py, f64>,
    PyReadonlyArray2<'py, i32>,
    PyReadonlyArray2<'py, i8>,
    [f64; 2],
    PyReadonlyArray1<'py, bool>,
);

impl NetArrays<'_> {
    fn view(&self) -> PyResult<NetView<'_>> {
        let Self(vertices, edges, shifts, period, cut) = self;
        let cut = column(cut, "cut", vertices.shape()[0])?;
        let view =
            NetView { vertices: rows(vertices)?, edges: rows(edges)?, shifts: rows(shifts)?, period: *period, cut };
        checked(view.check())?;
        Ok(view)
    }
}

/// A fence as the face passes it: anchors, kites, shifts.
#[derive(FromPyObject)]
pub(crate) struct FenceArrays<'py>(PyReadonlyArray2<'py, f64>, PyReadonlyArray2<'py, i32>, PyReadonlyArray2<'py, i8>);

impl FenceArrays<'_> {
    fn view(&self, net: NetView<'_>) -> PyResult<FenceView<'_>> {
        let view = FenceView { anchors: rows(&self.0)?, kites: rows(&self.1)?, shifts: rows(&self.2)? };
        checked(view.check(net))?;
        Ok(view)
    }
}

type NetOut<'py> = (Table<'py, f64>, Table<'py, i32>, Table<'py, i8>, [f64; 2], Row<'py, bool>);
type FenceOut<'py> = (Table<'py, f64>, Table<'py, i32>, Table<'py, i8>);

fn net_out(py: Python<'_>, net: Net) -> PyResult<NetOut<'_>> {
    let Net { vertices, edges, shifts, period, cut } = net;
    Ok((table(py, vertices)?, table(py, edges)?, table(py, shifts)?, period, PyArray1::from_vec(py, cut)))
}

fn fence_out(py: Python<'_>, fence: Fence) -> PyResult<FenceOut<'_>> {
    Ok((table(py, fence.anchors)?, table(py, fence.kites)?, table(py, fence.shifts)?))
}

/// The shut doors within the bounds, and the kites of all doors.
#[pyfunction]
pub(crate) fn crack_walls<'py>(
    py: Python<'py>,
    arrays: Arrays<'py>,
    open: PyReadonlyArray1<'py, bool>,
    bounds: [f64; 4],
) -> PyResult<(NetOut<'py>, FenceOut<'py>)> {
    let view = arrays.view()?;
    let open = column(&open, "open", view.edges.len())?;
    let found = detached(py, |_| crack::within(view, open, bounds))?;
    Ok((net_out(py, found.net)?, fence_out(py, found.fence)?))
}

/// The same on a torus.
#[pyfunction]
pub(crate) fn crack_walls_on_torus<'py>(
    py: Python<'py>,
    arrays: Arrays<'py>,
    open: PyReadonlyArray1<'py, bool>,
    shifts: PyReadonlyArray2<'py, i8>,
    dual_shifts: PyReadonlyArray2<'py, i8>,
    period: [f64; 2],
) -> PyResult<(NetOut<'py>, FenceOut<'py>)> {
    let view = arrays.view()?;
    let open = column(&open, "open", view.edges.len())?;
    let (shifts, duals) = (rows(&shifts)?, rows(&dual_shifts)?);
    let found = detached(py, |_| crack::on_torus(view, open, shifts, duals, period))?;
    Ok((net_out(py, found.net)?, fence_out(py, found.fence)?))
}

/// The end that each edge end continues into.
#[pyfunction]
pub(crate) fn crack_pairs<'py>(py: Python<'py>, net: NetArrays<'py>) -> PyResult<Row<'py, i32>> {
    let net = net.view()?;
    Ok(PyArray1::from_vec(py, detached(py, |_| Ok(crack::pairs(net)))?))
}

/// The vertices after straightening.
#[pyfunction]
#[allow(clippy::too_many_arguments, reason = "the face passes them one by one")]
pub(crate) fn crack_straighten<'py>(
    py: Python<'py>,
    net: NetArrays<'py>,
    partner: PyReadonlyArray1<'py, i32>,
    fence: FenceArrays<'py>,
    rounds: u32,
    pull: f64,
    slide: f64,
    clamp: f64,
) -> PyResult<Table<'py, f64>> {
    let net = net.view()?;
    let (fence, partner) = (fence.view(net)?, ends(&partner, net)?);
    let how = Straightening { rounds, pull, slide, clamp };
    table(py, detached(py, |watch| crack::straighten(net, partner, fence, how, watch))?)
}

/// The same drawing with all vertices in the period.
#[pyfunction]
pub(crate) fn crack_wrap<'py>(py: Python<'py>, net: NetArrays<'py>) -> PyResult<NetOut<'py>> {
    let net = net.view()?;
    let wrapped = detached(py, |_| Ok(net.wrapped()))?;
    net_out(py, wrapped)
}

type Strands<'py> = (Table<'py, f64>, Row<'py, i32>, Row<'py, i32>, Row<'py, i32>);

/// Widths, and the strand, generation and parent of every edge.
#[pyfunction]
pub(crate) fn crack_widths<'py>(
    py: Python<'py>,
    net: NetArrays<'py>,
    partner: PyReadonlyArray1<'py, i32>,
    width: f64,
    hierarchy: f64,
    taper: f64,
) -> PyResult<Strands<'py>> {
    let net = net.view()?;
    let partner = ends(&partner, net)?;
    let (widths, strands) = detached(py, |_| {
        let strands = crack::strands(net, partner);
        Ok((crack::widths(net, &strands, Profile { width, hierarchy, taper })?, strands))
    })?;
    let parent = strands.of_edge.iter().map(|&strand| strands.parent[strand as usize]).collect();
    let [strand, generation, parent] =
        [strands.of_edge, strands.generation, parent].map(|entries| PyArray1::from_vec(py, entries));
    Ok((table(py, widths)?, strand, generation, parent))
}

/// The partners of edge ends, each an end or -1.
fn ends<'a>(partner: &'a PyReadonlyArray1<'_, i32>, net: NetView<'_>) -> PyResult<&'a [i32]> {
    let ends = 2 * net.edges.len();
    let partner = column(partner, "partner", ends)?;
    checked(crazing::graph::check_indices("partner", partner.as_chunks::<1>().0, -1, ends))?;
    Ok(partner)
}

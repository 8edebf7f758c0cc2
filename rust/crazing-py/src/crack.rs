//! The steps of a crack.

pub(crate) mod branches;
pub(crate) mod course;
pub(crate) mod plates;

use crazing::Point;
use crazing::crack::{self, Aged, Fence, FenceView, Impact, Net, NetView, Profile, Splitting};
use crazing::rng::Key;
use crazing::sample::Density;
use numpy::{PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::arrays::{column, rows, table};
use crate::diagram::Arrays;
use crate::guard::{checked, detached};

pub(crate) type Table<'py, T> = Bound<'py, PyArray2<T>>;
pub(crate) type Row<'py, T> = Bound<'py, PyArray1<T>>;

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
    pub(crate) fn view(&self) -> PyResult<NetView<'_>> {
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
    pub(crate) fn view(&self, net: NetView<'_>) -> PyResult<FenceView<'_>> {
        let view = FenceView { anchors: rows(&self.0)?, kites: rows(&self.1)?, shifts: rows(&self.2)? };
        checked(view.check(net))?;
        Ok(view)
    }
}

pub(crate) type NetOut<'py> = (Table<'py, f64>, Table<'py, i32>, Table<'py, i8>, (f64, f64), Row<'py, bool>);
pub(crate) type FenceOut<'py> = (Table<'py, f64>, Table<'py, i32>, Table<'py, i8>);

pub(crate) fn net_out(py: Python<'_>, net: Net) -> PyResult<NetOut<'_>> {
    let Net { vertices, edges, shifts, period, cut } = net;
    Ok((table(py, vertices)?, table(py, edges)?, table(py, shifts)?, period.into(), PyArray1::from_vec(py, cut)))
}

pub(crate) fn fence_out(py: Python<'_>, fence: Fence) -> PyResult<FenceOut<'_>> {
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

/// The median length of the edges of a diagram.
#[pyfunction]
pub(crate) fn crack_spacing(
    py: Python<'_>,
    sites: PyReadonlyArray2<'_, f64>,
    edges: PyReadonlyArray2<'_, i32>,
    shifts: PyReadonlyArray2<'_, i8>,
    period: [f64; 2],
) -> PyResult<f64> {
    let (sites, edges, shifts) = (rows(&sites)?, rows(&edges)?, rows(&shifts)?);
    checked(crazing::graph::check_indices("edges", edges, 0, sites.len()))?;
    detached(py, |_| Ok(crack::spacing(sites, edges, shifts, period)))
}

/// The end that each edge end continues into.
#[pyfunction]
pub(crate) fn crack_pairs<'py>(py: Python<'py>, net: NetArrays<'py>, sharpest: f64) -> PyResult<Row<'py, i32>> {
    let net = net.view()?;
    Ok(PyArray1::from_vec(py, detached(py, |_| Ok(crack::pairs(net, sharpest)))?))
}

/// The vertices after straightening.
#[pyfunction]
pub(crate) fn crack_straighten<'py>(
    py: Python<'py>,
    net: NetArrays<'py>,
    partner: PyReadonlyArray1<'py, i32>,
    fence: FenceArrays<'py>,
    how: (u32, f64, f64, f64, u32),
) -> PyResult<Table<'py, f64>> {
    let net = net.view()?;
    let (fence, partner) = (fence.view(net)?, ends(&partner, net)?);
    let how = course::straightening(how);
    table(py, detached(py, |watch| crack::straighten(net, partner, fence, how, watch))?)
}

/// The same drawing with all vertices in the period.
#[pyfunction]
pub(crate) fn crack_wrap<'py>(py: Python<'py>, net: NetArrays<'py>) -> PyResult<NetOut<'py>> {
    let net = net.view()?;
    let wrapped = detached(py, |_| Ok(net.wrapped()))?;
    net_out(py, wrapped)
}

pub(crate) type AgedOut<'py> = (NetOut<'py>, FenceOut<'py>, Row<'py, i32>, Row<'py, i32>);

pub(crate) fn aged_out(py: Python<'_>, aged: Aged) -> PyResult<AgedOut<'_>> {
    let [partner, age] = [aged.partner, aged.age].map(|entries| PyArray1::from_vec(py, entries));
    Ok((net_out(py, aged.net)?, fence_out(py, aged.fence)?, partner, age))
}

/// The vertices after a smooth warp.
#[pyfunction]
pub(crate) fn crack_warp<'py>(
    py: Python<'py>,
    net: NetArrays<'py>,
    fence: FenceArrays<'py>,
    amplitude: f64,
    bounds: [f64; 4],
    key: Key,
) -> PyResult<(Table<'py, f64>, Table<'py, f64>)> {
    let net = net.view()?;
    let fence = fence.view(net)?;
    let (vertices, anchors) = detached(py, |watch| crack::warp(net, fence, amplitude, bounds, key, watch))?;
    Ok((table(py, vertices)?, table(py, anchors)?))
}

/// A density as the face passes it: pixels, and their bounds.
#[derive(FromPyObject)]
pub(crate) struct DensityArrays<'py>(PyReadonlyArray2<'py, f64>, [f64; 4]);

impl DensityArrays<'_> {
    pub(crate) fn view(&self) -> PyResult<Density<'_>> {
        let values = self.0.as_slice().unwrap_or_default();
        let density = Density { values, columns: self.0.shape()[1], bounds: self.1 };
        checked(density.check())?;
        Ok(density)
    }
}

/// Cells split again and again.
#[pyfunction]
#[allow(clippy::too_many_arguments, reason = "the face passes them one by one")]
pub(crate) fn crack_split<'py>(
    py: Python<'py>,
    bounds: [f64; 4],
    on_torus: bool,
    cells: usize,
    jitter: f64,
    bend: f64,
    anisotropy: f64,
    angle: f64,
    density: Option<DensityArrays<'py>>,
    key: Key,
) -> PyResult<AgedOut<'py>> {
    let density = density.as_ref().map(DensityArrays::view).transpose()?;
    let how = Splitting { cells, jitter, bend, anisotropy, angle };
    aged_out(py, detached(py, |watch| crack::split(bounds, on_torus, how, density, key, watch))?)
}

/// Spokes and arcs about an impact.
#[pyfunction]
#[allow(clippy::too_many_arguments, reason = "the face passes them one by one")]
pub(crate) fn crack_impact<'py>(
    py: Python<'py>,
    bounds: [f64; 4],
    on_torus: bool,
    source: Point,
    speed: f64,
    cells: usize,
    arcs: f64,
    key: Key,
) -> PyResult<AgedOut<'py>> {
    let how = Impact { source, speed, cells, arcs };
    aged_out(py, detached(py, |watch| crack::impact(bounds, on_torus, how, key, watch))?)
}

/// When the crack gets to both ends of every edge.
#[pyfunction]
pub(crate) fn crack_arrivals<'py>(
    py: Python<'py>,
    net: NetArrays<'py>,
    strand: PyReadonlyArray1<'py, i32>,
    parent: PyReadonlyArray1<'py, i32>,
) -> PyResult<Table<'py, f64>> {
    let net = net.view()?;
    let strand = column(&strand, "strand", net.edges.len())?;
    checked(crazing::graph::check_indices("strand", strand.as_chunks::<1>().0, 0, net.edges.len()))?;
    let parent = column(&parent, "parent", net.edges.len())?;
    table(py, detached(py, |_| Ok(crack::arrivals(net, strand, parent)))?)
}

type Strands<'py> = (Table<'py, f64>, Row<'py, i32>, Row<'py, i32>, Row<'py, i32>);

/// How wide cracks are, as the face passes it: the fields of a `Profile` in order.
#[derive(FromPyObject)]
pub(crate) struct Widths(f64, f64, f64, f64, f64, f64, f64, Point, f64, f64);

impl Widths {
    pub(crate) fn profile(self) -> Profile {
        let Self(width, hierarchy, shrink, taper, abutting, unevenness, unit, source, reach, fade) = self;
        Profile { width, hierarchy, shrink, taper, abutting, unevenness, unit, source, reach, fade }
    }
}

/// Widths, and the strand, generation and parent of every edge.
#[pyfunction]
pub(crate) fn crack_widths<'py>(
    py: Python<'py>,
    net: NetArrays<'py>,
    partner: PyReadonlyArray1<'py, i32>,
    age: PyReadonlyArray1<'py, i32>,
    origin: PyReadonlyArray1<'py, i32>,
    widths: Widths,
    key: Key,
) -> PyResult<Strands<'py>> {
    let (net, profile) = (net.view()?, widths.profile());
    let partner = ends(&partner, net)?;
    let age = age.as_slice().unwrap_or_default();
    let origin = if origin.is_empty() { &[] } else { column(&origin, "origin", net.edges.len())? };
    let looks = detached(py, |watch| crack::looks(net, partner, age, origin, (profile, key), watch))?;
    let [strand, generation, parent] =
        [looks.strand, looks.generation, looks.parent].map(|entries| PyArray1::from_vec(py, entries));
    Ok((table(py, looks.widths)?, strand, generation, parent))
}

/// The ages of edges, or none.
pub(crate) fn ages<'a>(age: &'a PyReadonlyArray1<'_, i32>, net: NetView<'_>) -> PyResult<&'a [i32]> {
    if age.len() == 0 { Ok(&[]) } else { column(age, "age", net.edges.len()) }
}

/// The partners of edge ends, each an end or -1.
pub(crate) fn ends<'a>(partner: &'a PyReadonlyArray1<'_, i32>, net: NetView<'_>) -> PyResult<&'a [i32]> {
    let ends = 2 * net.edges.len();
    let partner = column(partner, "partner", ends)?;
    checked(crazing::graph::check_indices("partner", partner.as_chunks::<1>().0, -1, ends))?;
    Ok(partner)
}

//! Steps of a crack that add, divide or leave out edges.

use crazing::crack::{self, Aged, Fence};
use crazing::rng::Key;
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

use super::{AgedOut, FenceArrays, NetArrays, aged_out, ages, course, ends, fence_out, net_out};
use crate::guard::detached;

/// The drawing with stubs, its fence, partners and ages.
#[pyfunction]
#[allow(clippy::too_many_arguments, reason = "the face passes them one by one")]
pub(crate) fn crack_stubs<'py>(
    py: Python<'py>,
    net: NetArrays<'py>,
    fence: FenceArrays<'py>,
    partner: PyReadonlyArray1<'py, i32>,
    age: PyReadonlyArray1<'py, i32>,
    bounds: [f64; 4],
    how: (f64, f64, f64, f64),
    key: Key,
) -> PyResult<AgedOut<'py>> {
    let net = net.view()?;
    let (fence, partner) = (fence.view(net)?, ends(&partner, net)?);
    let age = ages(&age, net)?;
    let aged = detached(py, |watch| {
        let grown = crack::stubs(net, partner, fence, bounds, course::stubs(how), key, watch)?;
        let age = grown.ages(age);
        Ok(Aged { net: grown.net, fence: grown.fence, partner: grown.partner, age })
    })?;
    aged_out(py, aged)
}

/// The drawing parted where cracks turn back.
#[pyfunction]
pub(crate) fn crack_part<'py>(
    py: Python<'py>,
    net: NetArrays<'py>,
    fence: FenceArrays<'py>,
    partner: PyReadonlyArray1<'py, i32>,
    age: PyReadonlyArray1<'py, i32>,
    turn: (f64, f64, f64),
) -> PyResult<AgedOut<'py>> {
    let net = net.view()?;
    let (fence, partner) = (fence.view(net)?, ends(&partner, net)?);
    let age = ages(&age, net)?;
    aged_out(py, detached(py, |watch| crack::part(net, partner, fence, age, course::turning(turn), watch))?)
}

/// The rough drawing, a fence that nothing can move behind, its partners, and the edge that each piece is of.
#[pyfunction]
pub(crate) fn crack_roughen<'py>(
    py: Python<'py>,
    net: NetArrays<'py>,
    partner: PyReadonlyArray1<'py, i32>,
    fence: FenceArrays<'py>,
    how: (f64, f64, f64, f64, f64),
    key: Key,
) -> PyResult<AgedOut<'py>> {
    let net = net.view()?;
    let (fence, partner) = (fence.view(net)?, ends(&partner, net)?);
    let (rough, fence) = detached(py, |watch| {
        let rough = crack::roughen(net, partner, fence, course::roughness(how), key, watch)?;
        let fence = Fence::shut(rough.net.view());
        Ok((rough, fence))
    })?;
    let [partner, origin] = [rough.partner, rough.origin].map(|entries| PyArray1::from_vec(py, entries));
    Ok((net_out(py, rough.net)?, fence_out(py, fence)?, partner, origin))
}

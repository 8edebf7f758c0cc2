//! Steps of a crack that add, divide or leave out edges.

use crazing::crack::{self, Fence, Roughness, Stubs};
use crazing::rng::Key;
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

use super::{AgedOut, FenceArrays, NetArrays, Row, ends, fence_out, net_out};
use crate::guard::detached;

/// The drawing with stubs, its fence and partners, and the edge that each piece is of.
#[pyfunction]
pub(crate) fn crack_stubs<'py>(
    py: Python<'py>,
    net: NetArrays<'py>,
    partner: PyReadonlyArray1<'py, i32>,
    fence: FenceArrays<'py>,
    bounds: [f64; 4],
    how: (f64, f64, f64, f64),
    key: Key,
) -> PyResult<AgedOut<'py>> {
    let net = net.view()?;
    let (fence, partner) = (fence.view(net)?, ends(&partner, net)?);
    let how = Stubs { rate: how.0, length: how.1, spread: how.2, lean: how.3 };
    let grown = detached(py, |watch| crack::stubs(net, partner, fence, bounds, how, key, watch))?;
    let [partner, origin] = [grown.partner, grown.origin].map(|entries| PyArray1::from_vec(py, entries));
    Ok((net_out(py, grown.net)?, fence_out(py, grown.fence)?, partner, origin))
}

/// Which edges stay when cracks are parted where they turn back.
#[pyfunction]
pub(crate) fn crack_parted<'py>(
    py: Python<'py>,
    net: NetArrays<'py>,
    partner: PyReadonlyArray1<'py, i32>,
    sharpest: f64,
    reach: f64,
) -> PyResult<Row<'py, bool>> {
    let net = net.view()?;
    let partner = ends(&partner, net)?;
    let stays = detached(py, |watch| crack::parted(net, partner, sharpest, reach, watch))?;
    Ok(PyArray1::from_vec(py, stays))
}

/// The rough drawing, a fence that nothing can move behind, its partners, and the edge that each piece is of.
#[pyfunction]
#[allow(clippy::too_many_arguments, reason = "the face passes them one by one")]
pub(crate) fn crack_roughen<'py>(
    py: Python<'py>,
    net: NetArrays<'py>,
    partner: PyReadonlyArray1<'py, i32>,
    fence: FenceArrays<'py>,
    amplitude: f64,
    hurst: f64,
    unit: f64,
    grain: f64,
    rounding: f64,
    key: Key,
) -> PyResult<AgedOut<'py>> {
    let net = net.view()?;
    let (fence, partner) = (fence.view(net)?, ends(&partner, net)?);
    let how = Roughness { amplitude, hurst, unit, grain, rounding };
    let (rough, fence) = detached(py, |watch| {
        let rough = crack::roughen(net, partner, fence, how, key, watch)?;
        let fence = Fence::shut(rough.net.view());
        Ok((rough, fence))
    })?;
    let [partner, origin] = [rough.partner, rough.origin].map(|entries| PyArray1::from_vec(py, entries));
    Ok((net_out(py, rough.net)?, fence_out(py, fence)?, partner, origin))
}

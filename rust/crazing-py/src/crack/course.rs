//! All steps of a recipe in one call.

use crazing::crack::{self, Course, Pattern, Roughness, Straightening, Stubs, Turning};
use crazing::rng::Key;
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

use super::{FenceArrays, NetArrays, Row, Table, Widths, ends};
use crate::arrays::table;
use crate::guard::detached;

/// The steps as the face passes them: numbers in the order of the fields, and keys.
#[derive(FromPyObject)]
pub(crate) struct Steps(
    Option<Straight>,
    Option<(f64, Key)>,
    Option<f64>,
    Option<(f64, f64, f64)>,
    Option<((f64, f64, f64, f64), Key)>,
    Option<(Rough, Key)>,
    Option<f64>,
    (Widths, Key),
);

type Straight = (u32, f64, f64, f64, u32);
type Rough = (f64, f64, f64, f64, f64);

/// How straight, from what the face passes.
pub(crate) fn straightening((rounds, pull, slide, clamp, unbend): Straight) -> Straightening {
    Straightening { rounds, pull, slide, clamp, unbend }
}

/// How sharply cracks may turn, from what the face passes.
pub(crate) fn turning((sharpest, reach, spacing): (f64, f64, f64)) -> Turning {
    Turning { sharpest, reach, spacing }
}

/// How many stubs, from what the face passes.
pub(crate) fn stubs((rate, length, spread, lean): (f64, f64, f64, f64)) -> Stubs {
    Stubs { rate, length, spread, lean }
}

/// How rough, from what the face passes.
pub(crate) fn roughness((amplitude, hurst, unit, grain, rounding): Rough) -> Roughness {
    Roughness { amplitude, hurst, unit, grain, rounding }
}

impl Steps {
    fn course(self) -> Course {
        let Self(straight, warp, turn, hooks, grown, rough, detail, (widths, key)) = self;
        Course {
            straightening: straight.map(straightening),
            warp,
            turn,
            hooks: hooks.map(turning),
            stubs: grown.map(|(how, key)| (stubs(how), key)),
            roughness: rough.map(|(how, key)| (roughness(how), key)),
            detail,
            widths: (widths.profile(), key),
        }
    }
}

/// Vertices, edges, shifts, widths, strand, generation, parent.
type PatternOut<'py> =
    (Table<'py, f64>, Table<'py, i32>, Table<'py, i8>, Table<'py, f64>, Row<'py, i32>, Row<'py, i32>, Row<'py, i32>);

/// The pattern of a drawing after all steps.
#[pyfunction]
pub(crate) fn crack_course<'py>(
    py: Python<'py>,
    net: NetArrays<'py>,
    fence: FenceArrays<'py>,
    partner: PyReadonlyArray1<'py, i32>,
    age: PyReadonlyArray1<'py, i32>,
    bounds: [f64; 4],
    steps: Steps,
) -> PyResult<PatternOut<'py>> {
    let net = net.view()?;
    let (fence, partner) = (fence.view(net)?, ends(&partner, net)?);
    let (age, how) = (age.as_slice().unwrap_or_default(), steps.course());
    let Pattern { net, looks } = detached(py, |watch| crack::course(net, fence, partner, age, bounds, how, watch))?;
    let [strand, generation, parent] =
        [looks.strand, looks.generation, looks.parent].map(|entries| PyArray1::from_vec(py, entries));
    let (vertices, edges, shifts) = (table(py, net.vertices)?, table(py, net.edges)?, table(py, net.shifts)?);
    Ok((vertices, edges, shifts, table(py, looks.widths)?, strand, generation, parent))
}

//! The way of a drawing through the steps of a recipe: what no step changes is not copied, what none needs any more is
//! let go.

use std::borrow::Cow;

use super::fence::{Fence, FenceView};
use super::hooks::{Turning, apart};
use super::net::{Ends, NONE, Net, NetView};
use super::pattern::{Pattern, finished};
use super::roughen::{Chains, Detail, Roughness, Trace, trace};
use super::straighten::{Straightening, straightened};
use super::strand::{Runs, paired, strands};
use super::stubs::{Stubs, grown};
use super::warp::warp;
use super::width::Profile;
use crate::error::Result;
use crate::graph::Point;
use crate::parallel;
use crate::rng::Key;
use crate::watch::Watch;

/// The steps of a recipe in their order, those that are wanted, each with the key it draws by.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Course {
    /// See [`super::straighten`].
    pub straightening: Option<Straightening>,
    /// See [`warp`]: its amplitude.
    pub warp: Option<(f64, Key)>,
    /// See [`super::pairs`]: the sharpest turn.
    pub turn: Option<f64>,
    /// See [`super::parted`].
    pub hooks: Option<Turning>,
    /// See [`super::stubs`].
    pub stubs: Option<(Stubs, Key)>,
    /// See [`super::roughen`].
    pub roughness: Option<(Roughness, Key)>,
    /// The grain of rough edges where it is finer than that of the roughness, data units: there only what is longer than
    /// the crack is wide wanders.
    pub detail: Option<f64>,
    /// See [`super::widths`].
    pub widths: (Profile, Key),
}

/// A drawing on its way; see [`Net`], [`Fence`] and [`super::Aged`].
struct Stage<'a> {
    vertices: Cow<'a, [Point]>,
    edges: Cow<'a, [[i32; 2]]>,
    shifts: Cow<'a, [[i8; 2]]>,
    period: Point,
    cut: Cow<'a, [bool]>,
    anchors: Cow<'a, [Point]>,
    kites: Cow<'a, [[i32; 4]]>,
    turns: Cow<'a, [[i8; 6]]>,
    partner: Cow<'a, [i32]>,
    age: Cow<'a, [i32]>,
}

/// Takes a drawing through the steps: the same bits as step after step.
///
/// # Errors
/// Those of the steps.
pub fn course(
    net: NetView<'_>,
    fence: FenceView<'_>,
    partner: &[i32],
    age: &[i32],
    bounds: [f64; 4],
    how: Course,
    watch: Watch<'_>,
) -> Result<Pattern> {
    let needs_ends = how.straightening.is_some() || how.turn.is_some();
    let (mut stage, ends) =
        parallel::join(net.edges.len(), || Stage::of(net, fence, partner, age), || needs_ends.then(|| Ends::of(net)));
    if let (Some(how), Some(ends)) = (how.straightening, &ends) {
        stage.vertices = straightened(stage.net(), ends, &stage.partner, stage.fence(), how, watch)?.into();
    }
    // Before cracks are followed and parted: a warp bends them, and may turn them back.
    if let Some((amplitude, key)) = how.warp {
        let (vertices, anchors) = warp(stage.net(), stage.fence(), amplitude, bounds, key, watch)?;
        (stage.vertices, stage.anchors) = (vertices.into(), anchors.into());
    }
    if let (Some(sharpest), Some(ends)) = (how.turn, &ends) {
        stage.partner = paired(stage.net(), ends, sharpest).into();
        stage.age = Cow::default();
    }
    match how.hooks {
        Some(turn) => {
            let ends = ends.unwrap_or_else(|| Ends::of(stage.net()));
            let parted = apart(stage.net(), ends, &stage.partner, stage.fence(), &stage.age, turn, watch)?;
            stage = Stage::owning(parted.net, parted.fence, parted.partner, parted.age);
        }
        None => drop(ends),
    }
    watch.poll()?;
    if let Some((how, key)) = how.stubs {
        let (net, fence, partner, age) = stage.into_owned();
        let grown = grown(net, partner, fence, bounds, how, key, watch)?;
        let age = grown.ages(&age);
        stage = Stage::owning(grown.net, grown.fence, grown.partner, age);
    }
    let (trace, runs) = stage.traced(&how, watch)?;
    // What no step needs any more makes room: memory that was never used is slow to come by.
    (stage.anchors, stage.kites, stage.turns, stage.partner) = Default::default();
    finished(stage.net(), trace, (runs, &stage.age), how.widths, watch)
}

/// The anchors of a fence in the order in which kites meet them, without the shifts: sites lie in memory as they were
/// given, at random, and every step asks for those about each edge.
fn in_order(fence: FenceView<'_>, vertices: usize) -> Fence {
    let mut number = vec![NONE; fence.anchors.len()];
    let (mut order, mut kites) = (Vec::with_capacity(fence.anchors.len()), Vec::with_capacity(fence.kites.len()));
    let mut numbered = |corner: i32| {
        if (corner as usize) < vertices || corner == NONE {
            return corner;
        }
        let old = corner as usize - vertices;
        if number[old] == NONE {
            number[old] = (vertices + order.len()) as i32;
            order.push(old);
        }
        number[old]
    };
    kites.extend(fence.kites.iter().map(|kite| kite.map(&mut numbered)));
    let anchors = parallel::map(order.len(), |i| fence.anchors[order[i]]);
    Fence { anchors, kites, shifts: Vec::new() }
}

impl<'a> Stage<'a> {
    fn of(net: NetView<'a>, fence: FenceView<'a>, partner: &'a [i32], age: &'a [i32]) -> Self {
        let near = in_order(fence, net.vertices.len());
        Self {
            vertices: net.vertices.into(),
            edges: net.edges.into(),
            shifts: net.shifts.into(),
            period: net.period,
            cut: net.cut.into(),
            anchors: near.anchors.into(),
            kites: near.kites.into(),
            turns: fence.shifts.into(),
            partner: partner.into(),
            age: age.into(),
        }
    }

    fn owning(net: Net, fence: Fence, partner: Vec<i32>, age: Vec<i32>) -> Self {
        Self {
            vertices: net.vertices.into(),
            edges: net.edges.into(),
            shifts: net.shifts.into(),
            period: net.period,
            cut: net.cut.into(),
            anchors: fence.anchors.into(),
            kites: fence.kites.into(),
            turns: fence.shifts.into(),
            partner: partner.into(),
            age: age.into(),
        }
    }

    fn net(&self) -> NetView<'_> {
        let Self { vertices, edges, shifts, period, cut, .. } = self;
        NetView { vertices, edges, shifts, period: *period, cut }
    }

    fn fence(&self) -> FenceView<'_> {
        FenceView { anchors: &self.anchors, kites: &self.kites, shifts: &self.turns }
    }

    /// Where its edges lie, rough where that is wanted, and which of them follow one another.
    fn traced(&self, how: &Course, watch: Watch<'_>) -> Result<(Trace, Runs)> {
        match how.roughness {
            Some(rough) => {
                // Both follow edge after edge, which takes one thread.
                let (net, partner) = (self.net(), &self.partner);
                let (chains, runs) = parallel::join(net.edges.len(), || Chains::of(net, watch), || Runs::of(partner));
                let widths = |moved: NetView<'_>| {
                    let found = strands(moved, partner, &self.age);
                    super::widths(moved, &found, how.widths.0, how.widths.1)
                };
                let detail = how.detail.filter(|&grain| grain < rough.0.grain);
                let detail = detail.map(|grain| Detail { grain, widths: &widths });
                Ok((trace(net, chains?, partner, self.fence(), rough, detail.as_ref(), watch)?, runs))
            }
            None => {
                let starts = (0..=self.edges.len()).collect();
                Ok((Trace { vertices: self.vertices.to_vec(), starts, ends: None }, Runs::of(&self.partner)))
            }
        }
    }

    fn into_owned(self) -> (Net, Fence, Vec<i32>, Vec<i32>) {
        let net = Net {
            vertices: self.vertices.into_owned(),
            edges: self.edges.into_owned(),
            shifts: self.shifts.into_owned(),
            period: self.period,
            cut: self.cut.into_owned(),
        };
        let fence = Fence {
            anchors: self.anchors.into_owned(),
            kites: self.kites.into_owned(),
            shifts: self.turns.into_owned(),
        };
        (net, fence, self.partner.into_owned(), self.age.into_owned())
    }
}

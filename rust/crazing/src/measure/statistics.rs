//! All statistics of a drawing.

use super::angles::{Corner, corners, ends_at};
use super::bounds::on_border;
use super::lines::{self, Orientation};
use super::network::{Drawing, Network};
use super::{boxes, bridges, faces, widths};
use crate::error::Result;
use crate::graph;
use crate::incidence::Incidence;
use crate::watch::Watch;

/// With what lengths a drawing is measured, in its own unit. A length of 0 measures exactly where that can be.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Gauge {
    /// Nodes this near the bounds do not count.
    pub border: f64,
    /// How far from a node the direction of a segment is taken; 0 is along its first edge.
    pub reach: f64,
    /// Step along a segment for its length over its chord.
    pub arc: f64,
    /// Step along a segment for orientation.
    pub stride: f64,
    /// Smallest lag of roughness, the others are 3 and 9 times that; 0 takes a twentieth of the mean segment between
    /// junctions, or of a sixteenth of the mean edge where that is longer.
    pub lag: f64,
    /// Smallest of five box sizes, each twice the one before; 0 takes a sixteenth of the same length.
    pub box_size: f64,
    /// Cells smaller than this are faults of the drawing.
    pub hole: f64,
}

/// Name and value of every statistic; NaN where there is nothing to measure.
pub type Statistics = Vec<(&'static str, f64)>;

/// A junction of three segments is a T where the largest angle is at least this many degrees.
const STRAIGHT: f64 = 155.0;
/// Segments whose chord is a smaller part of the mean segment are nearly closed: their length over chord has no bound.
const SHORTEST: f64 = 1.0 / 3.0;
/// Lags and boxes are no smaller than for segments of this part of the mean edge: with the dead ends of a comb, or edges
/// that are cut at the bounds, there is more to step along than any number of edges would say.
const FINEST: f64 = 1.0 / 16.0;
const LAGS: [f64; 3] = [1.0, 3.0, 9.0];
const LEVELS: usize = 5;

/// Measures a drawing. `area` is that of the picture. `O(n log n)`.
///
/// # Errors
/// As [`Drawing::check`]; [`crate::Error::Interrupted`].
///
/// # Source
/// Sanderson, Nixon: The use of topology in fracture network characterization (2015); Domokos, Jerolmack, Kun, Török:
/// Plato's cube and the natural geometry of fragmentation (2020).
pub fn statistics(drawing: &Drawing<'_>, area: f64, gauge: Gauge, watch: Watch<'_>) -> Result<Statistics> {
    drawing.check(watch)?;
    let network = Network::of(drawing, watch)?;
    let at = ends_at(&network);
    let border = on_border(drawing, gauge.border);
    let picture = Picture { drawing, network: &network, at: &at, border: &border, gauge, watch };
    let mut found = picture.nodes();
    found.extend(picture.mosaic());
    found.extend(picture.connection(area)?);
    let between = picture.between();
    found.extend(picture.cells(&found)?);
    found.extend(picture.segments(&between));
    found.extend(picture.shape(mean(&lengths(&network, &between)))?);
    found.extend(picture.widths(area));
    // The sum of nothing is -0.
    found.iter_mut().for_each(|(_, value)| *value += 0.0);
    Ok(found)
}

struct Picture<'a> {
    drawing: &'a Drawing<'a>,
    network: &'a Network,
    at: &'a Incidence,
    border: &'a [bool],
    gauge: Gauge,
    watch: Watch<'a>,
}

impl Picture<'_> {
    fn counted(&self) -> impl Iterator<Item = i32> + '_ {
        let inner = self.network.degree.iter().zip(self.border).filter(|&(_, &border)| !border);
        inner.map(|(&degree, _)| degree).filter(|&degree| degree > 0 && degree != 2)
    }

    fn nodes(&self) -> Statistics {
        let share = |wanted: fn(i32) -> bool| fraction(self.counted().map(wanted));
        let ends: f64 = self.counted().map(f64::from).sum();
        let free = self.counted().filter(|&degree| degree == 1).count() as f64;
        let junctions = self.junctions();
        vec![
            ("nodes", self.counted().count() as f64),
            ("junctions", junctions),
            ("i_nodes", share(|degree| degree == 1)),
            ("y_nodes", share(|degree| degree == 3)),
            ("x_nodes", share(|degree| degree > 3)),
            ("mean_degree", ends / (free + junctions)),
            ("connections_per_branch", 2.0 * (ends - free) / ends),
        ]
    }

    fn junctions(&self) -> f64 {
        self.counted().filter(|&degree| degree > 2).count() as f64
    }

    fn mosaic(&self) -> Statistics {
        let corners = corners(self.drawing, self.network, self.at, self.gauge.reach, |vertex| !self.border[vertex]);
        let triple: Vec<&Corner> = corners.iter().filter(|corner| corner.degree == 3).collect();
        let all: Vec<f64> = triple.iter().flat_map(|corner| corner.angles.iter().copied()).collect();
        let largest: Vec<f64> = triple.iter().map(|c| c.angles.iter().copied().fold(0.0, f64::max)).collect();
        let smallest: Vec<f64> = triple.iter().map(|c| c.angles.iter().copied().fold(360.0, f64::min)).collect();
        let tees = largest.iter().filter(|&&angle| angle >= STRAIGHT).count() as f64;
        let ends: f64 = corners.iter().map(|corner| f64::from(corner.degree)).sum();
        let (n, p) = ((ends - tees) / corners.len() as f64, 1.0 - tees / corners.len() as f64);
        vec![
            ("t_share", tees / triple.len() as f64),
            ("largest_angle", median(largest)),
            ("smallest_angle", median(smallest)),
            ("near_right", fraction(all.iter().map(|angle| (angle - 90.0).abs() <= 20.0))),
            ("near_even", fraction(all.iter().map(|angle| (angle - 120.0).abs() <= 15.0))),
            ("angle_sd", deviation(&all)),
            ("mosaic_n", n),
            ("mosaic_v", 2.0 * n / (n - p - 1.0)),
        ]
    }

    fn connection(&self, area: f64) -> Result<Statistics> {
        let pieces = graph::components(self.drawing.vertices.len(), self.drawing.edges, self.watch)?.count as f64;
        let used = self.network.degree.iter().filter(|&&degree| degree > 0).count() as f64;
        let loops = self.drawing.edges.len() as f64 - used + pieces;
        let total: f64 = self.network.length.iter().sum();
        let is_bridge = bridges::bridges(self.network, self.at, self.watch)?;
        let tips = self.tips();
        let is_dead = |segment: usize| tips[2 * segment] || tips[2 * segment + 1];
        let part = |wanted: &dyn Fn(usize) -> bool| {
            (0..self.network.count()).filter(|&s| wanted(s)).map(|s| self.network.length[s]).sum::<f64>() / total
        };
        Ok(vec![
            ("components", pieces),
            ("loops", loops),
            ("loops_per_junction", loops / self.junctions()),
            ("dead_end_length", part(&is_dead)),
            ("bridge_length", part(&|segment| is_bridge[segment])),
            ("length", total),
            ("intensity", total / area),
        ])
    }

    /// Whether each end of a segment is free.
    fn tips(&self) -> Vec<bool> {
        let free = |end: usize| {
            let vertex = self.network.ends[end / 2][end % 2] as usize;
            self.network.degree[vertex] == 1 && !self.border[vertex]
        };
        (0..2 * self.network.count()).map(free).collect()
    }

    fn cells(&self, found: &[(&'static str, f64)]) -> Result<Statistics> {
        let mut areas = faces::cells(self.drawing, self.network, self.at, self.watch)?;
        areas.retain(|&area| area >= self.gauge.hole);
        let logs: Vec<f64> = areas.iter().map(|&area| libm::log(area)).collect();
        let junctions = found.iter().find(|entry| entry.0 == "junctions").map_or(0.0, |entry| entry.1);
        let enough = |value: f64| if areas.len() > 1 { value } else { f64::NAN };
        Ok(vec![
            ("cells", areas.len() as f64),
            ("cells_per_junction", areas.len() as f64 / junctions),
            ("cell_area", mean(&areas)),
            ("cell_cv", enough(deviation(&areas) / mean(&areas))),
            ("cell_log_sd", enough(deviation(&logs))),
        ])
    }

    /// Segments between two junctions that count, or all where there are none.
    fn between(&self) -> Vec<usize> {
        let is_inner = |vertex: u32| !self.border[vertex as usize] && self.network.degree[vertex as usize] > 2;
        let whole = |&s: &usize| self.network.ends[s].into_iter().all(is_inner) && self.network.way[s] != [0.0; 2];
        let found: Vec<usize> = (0..self.network.count()).filter(whole).collect();
        if found.is_empty() { (0..self.network.count()).collect() } else { found }
    }

    fn segments(&self, between: &[usize]) -> Statistics {
        let lengths = lengths(self.network, between);
        let chord = |s: usize| libm::hypot(self.network.way[s][0], self.network.way[s][1]);
        let least = mean(&lengths) * SHORTEST;
        let long = between.iter().filter(|&&s| chord(s) >= least);
        let arc = |s: usize| lines::length(&lines::points(self.drawing, self.network, s, self.gauge.arc));
        let ratios: Vec<f64> = long.map(|&s| arc(s) / chord(s)).collect();
        vec![
            ("segments", self.network.count() as f64),
            ("segment_length", mean(&lengths)),
            ("segment_cv", deviation(&lengths) / mean(&lengths)),
            ("tortuosity", mean(&ratios)),
        ]
    }

    fn shape(&self, unit: f64) -> Result<Statistics> {
        let mut orientation = Orientation::default();
        for segment in 0..self.network.count() {
            self.watch.poll_at(segment)?;
            orientation.add(&lines::points(self.drawing, self.network, segment, self.gauge.stride));
        }
        let sane = unit > 0.0;
        let edge = self.network.length.iter().sum::<f64>() / self.drawing.edges.len() as f64;
        let unit = unit.max(FINEST * edge);
        let lag = if self.gauge.lag > 0.0 { self.gauge.lag } else { unit / 20.0 };
        let size = if self.gauge.box_size > 0.0 { self.gauge.box_size } else { unit / 16.0 };
        let dimension = if sane { boxes::dimension(self.drawing, size, LEVELS, self.watch)? } else { f64::NAN };
        let mut rough = LAGS.map(|times| times * lag);
        for lag in &mut rough {
            *lag = self.roughness(*lag)?;
        }
        let rough: Vec<f64> = rough.into_iter().filter(|x| x.is_finite()).collect();
        Ok(vec![
            ("orientation", orientation.order()),
            ("direction", orientation.direction()),
            ("roughness", if sane { mean(&rough) } else { f64::NAN }),
            ("box_dimension", dimension),
        ])
    }

    /// Root mean square of second differences at one lag, over the lag.
    fn roughness(&self, lag: f64) -> Result<f64> {
        let (mut sum, mut count) = (0.0, 0);
        for segment in 0..self.network.count() {
            self.watch.poll_at(segment)?;
            let (more, times) = lines::roughness(self.drawing, self.network, segment, lag);
            (sum, count) = (sum + more, count + times);
        }
        Ok((sum / count as f64).sqrt())
    }

    fn widths(&self, area: f64) -> Statistics {
        if self.drawing.widths.is_empty() {
            return ["width", "width_cv", "width_ratio", "taper", "area_fraction"].map(|name| (name, f64::NAN)).into();
        }
        let found = widths::widths(self.drawing, self.network, &self.tips());
        vec![
            ("width", found.mean),
            ("width_cv", found.cv),
            ("width_ratio", found.ratio),
            ("taper", found.taper),
            ("area_fraction", found.area / area),
        ]
    }
}

fn lengths(network: &Network, segments: &[usize]) -> Vec<f64> {
    segments.iter().map(|&s| network.length[s]).collect()
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Root mean square about the mean.
fn deviation(values: &[f64]) -> f64 {
    let middle = mean(values);
    (values.iter().map(|x| (x - middle) * (x - middle)).sum::<f64>() / values.len() as f64).sqrt()
}

fn fraction(flags: impl Iterator<Item = bool>) -> f64 {
    let (count, held) = flags.fold((0, 0), |(count, held), flag| (count + 1, held + u32::from(flag)));
    f64::from(held) / f64::from(count)
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    match values.len() {
        0 => f64::NAN,
        n => f64::midpoint(values[(n - 1) / 2], values[n / 2]),
    }
}

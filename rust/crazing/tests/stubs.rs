//! Laws of stubs: how many, how long, and that nothing else changes.
#![allow(clippy::unwrap_used, missing_docs)]

mod drawings;
mod families;

use crazing::crack::{Fence, Net, Stubs, pairs, strands, stubs};
use crazing::{Point, Watch};
use drawings::*;
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig { cases: 80, ..ProptestConfig::default() })]

    #[test]
    fn stubs_are_short_strands_of_their_own_and_change_nothing_else((walls, bounds, n, seed) in any_drawing()) {
        let (net, fence) = (walls.net, walls.fence);
        let partner = pairs(net.view(), 1.0);
        let grown = stubs_of(&net, &partner, &fence, bounds, unit(bounds, n), seed);
        let count = grown.origin.iter().filter(|&&edge| edge < 0).count();
        prop_assert_eq!(grown.net.vertices.len(), net.vertices.len() + 2 * count);
        prop_assert_eq!(grown.net.edges.len(), net.edges.len() + 2 * count);
        prop_assert_eq!(&grown.net.vertices[..net.vertices.len()], &net.vertices[..]);
        prop_assert_eq!(loops(grown.net.view()), loops(net.view()));
        let (before, after) = (strands(net.view(), &partner, &[]), strands(grown.net.view(), &grown.partner, &[]));
        prop_assert_eq!(after.length.len(), before.length.len() + count);
        let (degrees, old) = (grown.net.view().degrees(), net.view().degrees());
        prop_assert_eq!(&degrees[..old.len()], &old[..]);
        let mut run = vec![0.0; net.edges.len()];
        for (k, &origin) in grown.origin.iter().enumerate() {
            if origin >= 0 {
                run[origin as usize] += grown.net.view().length(k);
                continue;
            }
            let [foot, tip] = grown.net.edges[k].map(|vertex| degrees[vertex as usize]);
            prop_assert_eq!((foot, tip), (3, 1));
            prop_assert_eq!(&grown.partner[2 * k..2 * k + 2], &[-1, -1]);
        }
        for (k, run) in run.into_iter().enumerate() {
            let length = net.view().length(k);
            prop_assert!((run - length).abs() <= 1e-9 * length.max(bounds[2].abs().max(bounds[3].abs()) * 1e-6), "{run} {length}");
        }
        let none = Stubs { rate: 0.0, length: 1.0, spread: 0.0, lean: 0.0 };
        let bare = stubs(net.view(), &partner, fence.view(), bounds, none, [seed, 3], Watch::default()).unwrap();
        prop_assert_eq!((&bare.net, &bare.fence, &bare.partner), (&net, &fence, &partner));
    }
}

#[test]
fn as_many_stubs_as_asked_as_long_as_asked() {
    // Far apart, so that nothing is in the way.
    let lines = 40;
    let vertices: Vec<Point> =
        (0..lines).flat_map(|i| [[0.0, 10.0 * f64::from(i)], [100.0, 10.0 * f64::from(i)]]).collect();
    let edges: Vec<[i32; 2]> = (0..lines).map(|i| [2 * i, 2 * i + 1]).collect();
    let net = Net { cut: vec![false; vertices.len()], vertices, edges, ..Net::default() };
    let anchor = |i: i32, side: f64| [50.0, 10.0 * f64::from(i) + side];
    let fence = Fence {
        anchors: (0..lines).flat_map(|i| [anchor(i, 4.9), anchor(i, -4.9)]).collect(),
        kites: (0..lines).map(|i| [2 * i, 2 * i + 1, 2 * lines + 2 * i, 2 * lines + 2 * i + 1]).collect(),
        shifts: Vec::new(),
    };
    let how = Stubs { rate: 0.001, length: 0.4, spread: 0.2, lean: 0.0 };
    let partner = vec![-1; 2 * net.edges.len()];
    let bounds = [0.0, -10.0, 100.0, 10.0 * f64::from(lines)];
    let (mut count, mut logs, mut left) = (0, 0.0, 0);
    for seed in 0..300 {
        let grown = stubs(net.view(), &partner, fence.view(), bounds, how, [seed, 7], Watch::default()).unwrap();
        for k in (0..grown.origin.len()).filter(|&k| grown.origin[k] < 0) {
            let [x, y] = grown.net.view().along(2 * k as u32);
            assert!(x.abs() < 1e-9, "at right angles");
            count += 1;
            logs += y.abs().ln();
            left += u32::from(y > 0.0);
        }
    }
    // 4 a drawing, 1200 in all, less a tenth: near its ends the triangles about an edge are low. One deviation is 35.
    assert!((1000..1200).contains(&count), "{count}");
    assert!((logs / f64::from(count) - 0.4_f64.ln()).abs() < 0.05);
    assert!((0.42..0.58).contains(&(f64::from(left) / f64::from(count))));
}

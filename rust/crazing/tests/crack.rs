//! Laws of the steps of a crack, on point sets that make trouble, in the plane and on a torus.
#![allow(clippy::unwrap_used, missing_docs)]

mod drawings;
mod families;

use crazing::crack::{Fence, Profile, Rough, Roughness, looks, pairs, roughen, straighten, strands, warp, widths};
use crazing::{Point, Watch};
use drawings::*;
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig { cases: 80, ..ProptestConfig::default() })]

    #[test]
    fn no_step_makes_edges_cross((walls, bounds, n, seed) in any_drawing()) {
        let (net, fence) = (walls.net, walls.fence);
        let partner = pairs(net.view(), std::f64::consts::PI);
        // Roundings of copies on a torus, and of far Voronoi vertices, are no fault of the steps.
        prop_assume!(crossings(net.view()) == 0 && paves(net.view(), &fence));
        let straight = straighten(net.view(), &partner, fence.view(), HARD, Watch::default()).unwrap();
        let net = moved(&net, straight);
        prop_assert_eq!(crossings(net.view()), 0);
        prop_assert!(paves(net.view(), &fence));
        let bent = warp(net.view(), fence.view(), unit(bounds, n), bounds, [seed, 4], Watch::default()).unwrap();
        let (net, fence) = (moved(&net, bent.0), Fence { anchors: bent.1, ..fence });
        prop_assert_eq!(crossings(net.view()), 0);
        prop_assert!(paves(net.view(), &fence));
        let grown = stubs_of(&net, &partner, &fence, bounds, unit(bounds, n), seed);
        prop_assert_eq!(crossings(grown.net.view()), 0);
        prop_assert!(paves(grown.net.view(), &grown.fence));
        // Stubs can be moved again, behind the fence that they divided.
        let again = straighten(grown.net.view(), &grown.partner, grown.fence.view(), HARD, Watch::default()).unwrap();
        let net = moved(&grown.net, again);
        prop_assert_eq!(crossings(net.view()), 0);
        let rough = rough_of(&net, &grown.partner, &grown.fence, unit(bounds, n), seed);
        prop_assert_eq!(crossings(rough.net.view()), 0);
    }

    #[test]
    fn nodes_and_cut_ends_are_pinned((walls, bounds, n, seed) in any_drawing()) {
        let (net, fence) = (walls.net, walls.fence);
        let partner = pairs(net.view(), std::f64::consts::PI);
        let straight = straighten(net.view(), &partner, fence.view(), HARD, Watch::default()).unwrap();
        let (bent, _) = warp(net.view(), fence.view(), unit(bounds, n), bounds, [seed, 4], Watch::default()).unwrap();
        let rough = rough_of(&net, &partner, &fence, unit(bounds, n), seed);
        for (vertex, degree) in net.view().degrees().into_iter().enumerate() {
            let before = net.vertices[vertex];
            if net.cut[vertex] {
                prop_assert_eq!(before, straight[vertex]);
                prop_assert_eq!(before, bent[vertex]);
            }
            if net.cut[vertex] || degree != 2 {
                prop_assert_eq!(before, rough.net.vertices[vertex]);
            }
            // A free tip lies on no chord.
            if degree == 1 {
                prop_assert_eq!(before, straight[vertex]);
            }
        }
        prop_assert_eq!(&rough.net.cut[..net.cut.len()], &net.cut[..]);
        prop_assert_eq!(loops(rough.net.view()), loops(net.view()));
    }

    #[test]
    fn strands_are_runs_of_partners_and_abut_their_parents((walls, bounds, n, seed) in any_drawing()) {
        let (net, fence) = (walls.net, walls.fence);
        let partner = pairs(net.view(), 1.0);
        let grown = stubs_of(&net, &partner, &fence, bounds, unit(bounds, n), seed);
        let rough = rough_of(&grown.net, &grown.partner, &grown.fence, unit(bounds, n), seed);
        for (net, partner) in [(&net, &partner), (&grown.net, &grown.partner), (&rough.net, &rough.partner)] {
            for (end, &other) in partner.iter().enumerate().filter(|(_, other)| **other >= 0) {
                prop_assert_eq!(partner[other as usize], end as i32);
                prop_assert_eq!(net.view().vertex(other as u32), net.view().vertex(end as u32));
            }
            let found = strands(net.view(), partner, &[]);
            let mut seen = vec![0; net.edges.len()];
            for (strand, run) in (0..found.run.len()).map(|strand| found.along(strand)).enumerate() {
                for &entry in run {
                    seen[entry as usize / 2] += 1;
                    prop_assert_eq!(found.of_edge[entry as usize / 2], strand as i32);
                }
                for pair in run.windows(2) {
                    prop_assert_eq!(partner[(pair[0] ^ 1) as usize], pair[1] as i32);
                }
                let parent = found.parent[strand];
                let generation = found.generation[run[0] as usize / 2];
                prop_assert!(parent < strand as i32);
                if parent < 0 {
                    prop_assert_eq!(generation, 0);
                    continue;
                }
                let older = found.along(parent as usize);
                prop_assert_eq!(generation, found.generation[older[0] as usize / 2] + 1);
                let tips = [run[0], run[run.len() - 1] ^ 1].map(|end| net.view().vertex(end));
                prop_assert!(older.iter().any(|&end| [end, end ^ 1].iter().any(|&e| tips.contains(&net.view().vertex(e)))));
            }
            prop_assert!(seen.iter().all(|&times| times == 1));
            // All at once they are what they are one by one.
            let profile = Profile { width: 1.0, unevenness: 0.4, unit: unit(bounds, n), fade: 0.5, ..Profile::default() };
            let seen = looks(net.view(), partner, &[], &[], (profile, [seed, 9]), Watch::default()).unwrap();
            prop_assert_eq!(seen.widths, widths(net.view(), &found, profile, [seed, 9]).unwrap());
            prop_assert_eq!((seen.strand, seen.generation), (found.of_edge.clone(), found.generation.clone()));
            let parent: Vec<i32> = found.of_edge.iter().map(|&strand| found.parent[strand as usize]).collect();
            prop_assert_eq!(seen.parent, parent);
        }
    }

    #[test]
    fn finer_pieces_move_nothing_and_are_as_wide(
        trouble in 0..TROUBLES.len(), n in 4_usize..34, torus in any::<bool>(), opening in 0.0..0.9, seed in 0_u64..1000,
    ) {
        let (walls, bounds) = drawn(TROUBLES[trouble], n, torus, opening, seed);
        let (net, fence, unit) = (walls.net, walls.fence, unit(bounds, n));
        let partner = pairs(net.view(), 1.0);
        let profile = Profile { width: 1.0, unevenness: 0.4, unit, fade: 0.5, ..Profile::default() };
        let cut = |grain: f64| {
            let how = Roughness { amplitude: 0.1, hurst: 0.6, unit, grain: grain * unit, rounding: 0.5 };
            let rough = roughen(net.view(), &partner, fence.view(), how, [seed, 3], Watch::default()).unwrap();
            let (partner, origin) = (&rough.partner, &rough.origin);
            let looks = looks(rough.net.view(), partner, &[], origin, (profile, [seed, 9]), Watch::default()).unwrap();
            (rough, looks)
        };
        let ((coarse, wide), (fine, as_wide)) = (cut(0.3), cut(0.02));
        prop_assert!(coarse.net.edges.len() <= fine.net.edges.len());
        let (mut next, mut from) = (0, 0);
        for edge in 0..net.edges.len() as i32 {
            let count = |origin: &[i32], from: usize| origin[from..].iter().take_while(|of| **of == edge).count();
            let (few, many) = (count(&coarse.origin, from), count(&fine.origin, next));
            prop_assert!(few > 0 && many % few == 0);
            for (i, j) in (0..few).map(|i| (from + i, next + i * (many / few))) {
                let place = |rough: &Rough, k: usize| rough.net.vertices[rough.net.edges[k][0] as usize];
                prop_assert_eq!(place(&coarse, i), place(&fine, j));
                prop_assert_eq!(wide.widths[i][0], as_wide.widths[j][0]);
                prop_assert_eq!(wide.widths[i][1], as_wide.widths[j + many / few - 1][1]);
                prop_assert_eq!((wide.strand[i], wide.parent[i]), (as_wide.strand[j], as_wide.parent[j]));
            }
            (from, next) = (from + few, next + many);
        }
    }

    #[test]
    fn shifts_on_a_torus_add_up(trouble in 0..TROUBLES.len(), n in 4_usize..34, opening in 0.0..0.9, seed in 0_u64..1000) {
        let (walls, bounds) = drawn(TROUBLES[trouble], n, true, opening, seed);
        let (net, fence) = (walls.net, walls.fence);
        let partner = pairs(net.view(), 1.0);
        let grown = stubs_of(&net, &partner, &fence, bounds, unit(bounds, n), seed);
        let rough = rough_of(&grown.net, &grown.partner, &grown.fence, unit(bounds, n), seed);
        let sums = |shifts: &[[i8; 2]], origin: &[i32], count: usize| {
            let mut sums = vec![[0_i32; 2]; count];
            for (shift, &edge) in shifts.iter().zip(origin).filter(|(_, edge)| **edge >= 0) {
                (0..2).for_each(|i| sums[edge as usize][i] += i32::from(shift[i]));
            }
            sums
        };
        let whole: Vec<[i32; 2]> = net.shifts.iter().map(|shift| shift.map(i32::from)).collect();
        prop_assert_eq!(&sums(&grown.net.shifts, &grown.origin, net.edges.len()), &whole);
        let pieces: Vec<[i32; 2]> = grown.net.shifts.iter().map(|shift| shift.map(i32::from)).collect();
        prop_assert_eq!(&sums(&rough.net.shifts, &rough.origin, grown.net.edges.len()), &pieces);
        let wrapped = rough.net.view().wrapped();
        for k in 0..rough.net.edges.len() {
            let (before, after) = (rough.net.view().along(2 * k as u32), wrapped.view().along(2 * k as u32));
            prop_assert!((0..2).all(|i| (before[i] - after[i]).abs() < 1e-12));
        }
        prop_assert!(wrapped.vertices.iter().all(|p| (0..2).all(|i| (0.0..net.period[i]).contains(&p[i]))));
    }
}

#[test]
fn a_vertex_that_happens_to_lie_on_the_bounds_stays_there() {
    for seed in 0..20 {
        let (walls, bounds) = drawn("grid", 31, false, 0.3, seed);
        // Found by the laws above: the Voronoi vertices of a grid of side 5 may lie on bounds at 5.5.
        let on_side = |p: &Point| (0..2).any(|i| p[i] == bounds[i] || p[i] == bounds[i + 2]);
        assert!(walls.net.vertices.iter().zip(&walls.net.cut).all(|(p, &cut)| cut == on_side(p)));
        let (net, fence) = (walls.net, walls.fence);
        let (bent, _) = warp(net.view(), fence.view(), 1.0, bounds, [seed, 4], Watch::default()).unwrap();
        assert_eq!(crossings(moved(&net, bent).view()), 0);
    }
}

//! How deep within walls every triangle lies.

use super::DiagramView;
use crate::error::{Error, Result};
use crate::sets::DisjointSets;
use crate::watch::Watch;

/// For every triangle the fewest of the edges `wall` that a way from infinity to it crosses: 0 outside, and by the
/// even-odd rule inside where the number is odd.
///
/// # Errors
/// [`Error::BadLength`], [`Error::Interrupted`].
pub fn depths(view: DiagramView<'_>, wall: &[bool], watch: Watch<'_>) -> Result<Vec<i32>> {
    if wall.len() != view.edges.len() {
        return Err(Error::BadLength { array: "wall", found: wall.len(), wanted: view.edges.len() });
    }
    let outside = view.triangles.len();
    let place = |t: i32| if t == -1 { outside } else { t as usize };
    // What no wall parts is one room: there are few of them, and few pairs that share walls.
    let mut rooms = DisjointSets::new(outside + 1);
    for (k, dual) in view.dual_edges.iter().enumerate().filter(|&(k, _)| !wall[k]) {
        watch.poll_at(k)?;
        rooms.unite(place(dual[0]), place(dual[1]));
    }
    let mut beside: Vec<[usize; 2]> = Vec::new();
    for (dual, _) in view.dual_edges.iter().zip(wall).filter(|(_, wall)| **wall) {
        let [a, b] = dual.map(|t| rooms.lowest(place(t)));
        let pair = [a.min(b), a.max(b)];
        if a != b && beside.last() != Some(&pair) {
            beside.push(pair);
        }
    }
    let depth = of_rooms(outside + 1, rooms.lowest(outside), beside, watch)?;
    Ok((0..outside).map(|t| depth[rooms.lowest(t)]).collect())
}

/// How many walls lie between a room and each of the others, -1 where there is no way; `beside` are those that share a
/// wall.
fn of_rooms(count: usize, from: usize, mut beside: Vec<[usize; 2]>, watch: Watch<'_>) -> Result<Vec<i32>> {
    beside.sort_unstable();
    beside.dedup();
    beside.extend_from_within(..);
    let half = beside.len() / 2;
    beside[half..].iter_mut().for_each(|pair| pair.reverse());
    beside.sort_unstable();
    let mut depth = vec![-1; count];
    depth[from] = 0;
    let mut met = vec![from];
    let mut next = 0;
    while let Some(&room) = met.get(next) {
        watch.poll_at(next)?;
        next += 1;
        let first = beside.partition_point(|pair| pair[0] < room);
        for &[_, other] in beside[first..].iter().take_while(|pair| pair[0] == room) {
            if depth[other] == -1 {
                depth[other] = depth[room] + 1;
                met.push(other);
            }
        }
    }
    Ok(depth)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::Point;

    #[test]
    fn rings_within_rings_are_counted() {
        // Squares about the middle of a grid, walls between sites equally far from it.
        let points: Vec<Point> = (0..81).map(|i| [f64::from(i % 9) - 4.0, f64::from(i / 9) - 4.0]).collect();
        let diagram = crate::diagram::diagram(&points, Watch::default()).unwrap_or_default();
        let far = |site: i32| points[site as usize].map(f64::abs).into_iter().fold(0.0, f64::max);
        let is_wall = |&[a, b]: &[i32; 2]| {
            let [p, q] = [points[a as usize], points[b as usize]];
            far(a) == far(b) && (p[0] == q[0] || p[1] == q[1])
        };
        let wall: Vec<bool> = diagram.edges.iter().map(is_wall).collect();
        let found = depths(diagram.view(), &wall, Watch::default()).unwrap_or_default();
        assert_eq!(found.len(), 128);
        for (corners, depth) in diagram.triangles.iter().zip(found) {
            let middle = |axis: usize| corners.iter().map(|&site| points[site as usize][axis]).sum::<f64>() / 3.0;
            assert_eq!(depth, 4 - middle(0).abs().max(middle(1).abs()) as i32);
        }
        // Where every edge is a wall, a way leads over the neighbour that lies one less deep.
        let shut = depths(diagram.view(), &vec![true; wall.len()], Watch::default()).unwrap_or_default();
        for (t, &depth) in shut.iter().enumerate() {
            let beside = diagram.dual_edges.iter().filter(|dual| dual.contains(&(t as i32))).flatten();
            let least = beside.filter(|&&other| other != t as i32).map(|&other| shut.get(other as usize).unwrap_or(&0));
            assert_eq!(least.min(), Some(&(depth - 1)));
        }
    }
}

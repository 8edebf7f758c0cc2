//! Edges cut into pieces: what each piece is of.

use crate::crack::net::{NONE, NetView};
use crate::parallel;

/// Piece `i` of edge `k` is edge `starts[k] + i`; the inner vertices follow the old ones in the order of the pieces.
pub(in crate::crack) fn pieces_of(net: NetView<'_>, starts: &[usize]) -> Vec<[i32; 2]> {
    let old = net.vertices.len();
    let mut pieces = vec![[0; 2]; starts[net.edges.len()]];
    parallel::grouped(
        net.edges.len(),
        |k| starts[k],
        &mut pieces,
        |range, pieces| {
            let first = starts[range.start];
            for k in range {
                for piece in starts[k]..starts[k + 1] {
                    // The vertex after the piece; every edge before has one piece more than inner vertices.
                    let after = (old + piece - k) as i32;
                    pieces[piece - first] = [after - 1, after];
                }
                pieces[starts[k] - first][0] = net.edges[k][0];
                pieces[starts[k + 1] - 1 - first][1] = net.edges[k][1];
            }
        },
    );
    pieces
}

/// The last piece of an edge crosses what the edge crosses.
pub(in crate::crack) fn shifts_of(net: NetView<'_>, starts: &[usize]) -> Vec<[i8; 2]> {
    let mut shifts = vec![[0; 2]; if net.shifts.is_empty() { 0 } else { starts[net.edges.len()] }];
    net.shifts.iter().zip(&starts[1..]).for_each(|(&shift, &end)| shifts[end - 1] = shift);
    shifts
}

/// Pieces of one edge continue each other; its ends go on as before.
pub(super) fn partners_of(partner: &[i32], starts: &[usize]) -> Vec<i32> {
    let end_of = |end: i32| match end {
        NONE => NONE,
        _ if end % 2 == 0 => 2 * starts[end as usize / 2] as i32,
        _ => 2 * starts[end as usize / 2 + 1] as i32 - 1,
    };
    let edges = partner.len() / 2;
    let mut partners = vec![NONE; 2 * starts[edges]];
    parallel::grouped(
        edges,
        |k| 2 * starts[k],
        &mut partners,
        |range, partners| {
            let first = 2 * starts[range.start];
            for k in range {
                let (start, end) = (2 * starts[k], 2 * starts[k + 1]);
                for near in (start + 1..end - 1).step_by(2) {
                    partners[near - first] = near as i32 + 1;
                    partners[near + 1 - first] = near as i32;
                }
                partners[start - first] = end_of(partner[2 * k]);
                partners[end - 1 - first] = end_of(partner[2 * k + 1]);
            }
        },
    );
    partners
}

/// `value` of each edge, for each of its pieces.
pub(in crate::crack) fn repeated(starts: &[usize], value: impl Fn(usize) -> i32 + Sync + Send) -> Vec<i32> {
    let edges = starts.len() - 1;
    let mut values = vec![0; starts[edges]];
    parallel::grouped(
        edges,
        |k| starts[k],
        &mut values,
        |range, values| {
            let first = starts[range.start];
            range.for_each(|k| values[starts[k] - first..starts[k + 1] - first].fill(value(k)));
        },
    );
    values
}

//! Signs that decide, exact for every input: a filter in floating point, then integers, then expansions.
//!
//! The caller keeps coordinates within 2^±200 of 1 (see [`crate::diagram::scale`]), so that nothing here over- or
//! underflows.

mod cotangent;
pub mod expansion;

pub use cotangent::{Cotangent, in_pencil, power};

use crate::graph::Point;
use expansion::{Expansion, two_sum};

/// Bound on the relative rounding error of the filtered sums below: each is a polynomial of degree at most 4 in
/// coordinate differences, with fewer than 12 roundings on any path from a difference to the result.
pub(crate) const FILTER: f64 = 16.0 * f64::EPSILON;

/// Sign of the area of the triangle `a b c`: positive when counter-clockwise.
pub fn orientation(a: Point, b: Point, c: Point) -> f64 {
    let coord = |p: Point| robust::Coord { x: p[0], y: p[1] };
    robust::orient2d(coord(a), coord(b), coord(c))
}

/// Sign of how far `d` lies inside the circle through `a b c`, which are counter-clockwise; zero on it.
pub fn in_circle(a: Point, b: Point, c: Point, d: Point) -> f64 {
    let coord = |p: Point| robust::Coord { x: p[0], y: p[1] };
    robust::incircle(coord(a), coord(b), coord(c), coord(d))
}

/// Sign of `(p - r) · (q - r)`: positive when the angle `p r q` is acute, zero when it is right.
pub fn apex_sign(p: Point, q: Point, r: Point) -> f64 {
    let (a, b) = ([p[0] - r[0], p[1] - r[1]], [q[0] - r[0], q[1] - r[1]]);
    let (x, y) = (a[0] * b[0], a[1] * b[1]);
    let dot = x + y;
    if dot.abs() > FILTER * (x.abs() + y.abs()) { dot.signum() } else { exact_apex(p, q, r).0.sign() }
}

/// Sign of `|a - p| - |b - p|`: negative when `a` is nearer to `p` than `b`.
pub fn nearer_sign(p: Point, a: Point, b: Point) -> f64 {
    let square = |q: Point| (q[0] - p[0]) * (q[0] - p[0]) + (q[1] - p[1]) * (q[1] - p[1]);
    let (left, right) = (square(a), square(b));
    let value = left - right;
    if value.abs() > FILTER * (left + right) {
        return value.signum();
    }
    let square = |q: Point| {
        let [x, y] = [Expansion::difference(q[0], p[0]), Expansion::difference(q[1], p[1])];
        x.times(&x).plus(&y.times(&y))
    };
    square(a).minus(&square(b)).sign()
}

/// Sign of `(a - b) · (q - p)`: negative when `a` lies farther back than `b` along the direction from `p` to `q`.
pub fn projection_sign(p: Point, q: Point, a: Point, b: Point) -> f64 {
    let (x, y) = ((a[0] - b[0]) * (q[0] - p[0]), (a[1] - b[1]) * (q[1] - p[1]));
    if (x + y).abs() > FILTER * (x.abs() + y.abs()) {
        return (x + y).signum();
    }
    let along = |axis: usize| Expansion::difference(a[axis], b[axis]).times(&Expansion::difference(q[axis], p[axis]));
    along(0).plus(&along(1)).sign()
}

/// The one-step test (Gold and Snoeyink 2001) of edge `pq` with the opposite corners `r` and `s` on its two sides.
///
/// Not negative when some circle through `p` and `q` contains neither circumcentre, i.e. when the angles at `r` and
/// `s` add up to at most 90°: then `pq` is crust. Zero is the tie.
pub fn one_step_sign(p: Point, q: Point, r: Point, s: Point) -> f64 {
    let (value, error) = one_step_value(p, q, r, s);
    if value.abs() > error {
        return value.signum();
    }
    one_step_integer(p, q, r, s).unwrap_or_else(|| {
        let ((dot_r, cross_r), (dot_s, cross_s)) = (exact_apex(p, q, r), exact_apex(p, q, s));
        dot_r.times(&dot_s).plus(&cross_r.times(&cross_s)).sign()
    })
}

/// The number whose sign [`one_step_sign`] gives, rounded, and a bound on the error of that.
#[inline]
pub fn one_step_value(p: Point, q: Point, r: Point, s: Point) -> (f64, f64) {
    let ([dot_r, cross_r], [size_dot_r, size_cross_r]) = apex(p, q, r);
    let ([dot_s, cross_s], [size_dot_s, size_cross_s]) = apex(p, q, s);
    (dot_r * dot_s + cross_r * cross_s, FILTER * (size_dot_r * size_dot_s + size_cross_r * size_cross_s))
}

/// Dot and cross product of the two sides at `r`, and the sums of the absolute values of their terms.
#[inline]
fn apex(p: Point, q: Point, r: Point) -> ([f64; 2], [f64; 2]) {
    let (ax, ay) = (p[0] - r[0], p[1] - r[1]);
    let (bx, by) = (q[0] - r[0], q[1] - r[1]);
    let (xx, yy, xy, yx) = (ax * bx, ay * by, ax * by, ay * bx);
    ([xx + yy, xy - yx], [xx.abs() + yy.abs(), xy.abs() + yx.abs()])
}

/// The test in 128-bit integers, when every difference is a multiple of one power of two and small enough: grids
/// and pixel contours are all ties, and this is many times faster than expansions.
fn one_step_integer(p: Point, q: Point, r: Point, s: Point) -> Option<f64> {
    let exact = |a: f64, b: f64| match two_sum(a, -b) {
        (difference, 0.0) => Some(difference),
        _ => None,
    };
    let mut sides = [0.0; 8];
    for (slot, (a, b)) in
        sides.iter_mut().zip([(p, r), (q, r), (p, s), (q, s)].iter().flat_map(|(a, b)| [(a[0], b[0]), (a[1], b[1])]))
    {
        *slot = exact(a, b)?;
    }
    let largest = sides.iter().fold(0.0_f64, |m, d| m.max(d.abs()));
    // Multiplying by a power of two is exact; differences end up below 2^30, the result below 2^123.
    let unit = libm::ldexp(1.0, 29 - libm::ilogb(largest));
    let mut whole = [0_i128; 8];
    for (slot, side) in whole.iter_mut().zip(sides) {
        let scaled = side * unit;
        if scaled.fract() != 0.0 {
            return None;
        }
        *slot = i128::from(scaled as i64);
    }
    let [ax, ay, bx, by, cx, cy, dx, dy] = whole;
    let value = (ax * bx + ay * by) * (cx * dx + cy * dy) + (ax * by - ay * bx) * (cx * dy - cy * dx);
    Some(value.signum() as f64)
}

/// Dot and cross product of the two sides at a corner, exactly.
fn exact_apex(p: Point, q: Point, r: Point) -> (Expansion, Expansion) {
    let (ax, ay) = (Expansion::difference(p[0], r[0]), Expansion::difference(p[1], r[1]));
    let (bx, by) = (Expansion::difference(q[0], r[0]), Expansion::difference(q[1], r[1]));
    (ax.times(&bx).plus(&ay.times(&by)), ax.times(&by).minus(&ay.times(&bx)))
}

/// Circumcentre of a triangle that is not flat, constructed relative to one corner and rounded.
///
/// The error, in circumradii, is some 1e-15 over the sine of the angle at that corner: a corner with a small angle
/// is exchanged for the one opposite the longest side, and a nearly flat triangle is evaluated exactly.
pub fn circumcentre(a: Point, b: Point, c: Point) -> Point {
    circumcentre_at(a, b, c).unwrap_or_else(|| {
        let square = |p: Point, q: Point| (p[0] - q[0]).powi(2) + (p[1] - q[1]).powi(2);
        let (ab, bc, ca) = (square(a, b), square(b, c), square(c, a));
        let [a, b, c] = if ab > bc.max(ca) {
            [c, a, b]
        } else if ca > bc {
            [b, c, a]
        } else {
            [a, b, c]
        };
        circumcentre_at(a, b, c).unwrap_or_else(|| circumcentre_exact(a, b, c))
    })
}

/// None when the sine of the angle at `a` is below 1e-4.
#[inline]
fn circumcentre_at(a: Point, b: Point, c: Point) -> Option<Point> {
    let (bx, by) = (b[0] - a[0], b[1] - a[1]);
    let (cx, cy) = (c[0] - a[0], c[1] - a[1]);
    let area = bx * cy - by * cx;
    let (b2, c2) = (bx * bx + by * by, cx * cx + cy * cy);
    // What underflows is none, too.
    let is_wide = area * area > 1e-8 * (b2 * c2);
    if !is_wide {
        return None;
    }
    let half = 0.5 / area;
    Some([a[0] + (cy * b2 - by * c2) * half, a[1] + (bx * c2 - cx * b2) * half])
}

fn circumcentre_exact(a: Point, b: Point, c: Point) -> Point {
    let (bx, by) = (Expansion::difference(b[0], a[0]), Expansion::difference(b[1], a[1]));
    let (cx, cy) = (Expansion::difference(c[0], a[0]), Expansion::difference(c[1], a[1]));
    let area = bx.times(&cy).minus(&by.times(&cx)).estimate();
    let b2 = bx.times(&bx).plus(&by.times(&by));
    let c2 = cx.times(&cx).plus(&cy.times(&cy));
    let x = cy.times(&b2).minus(&by.times(&c2)).estimate();
    let y = bx.times(&c2).minus(&cx.times(&b2)).estimate();
    [a[0] + x / area * 0.5, a[1] + y / area * 0.5]
}

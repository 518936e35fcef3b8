//! Exact volumes of the part of a sphere in a slab and in a box.
//!
//! | symbol | meaning |
//! |---|---|
//! | R | radius of the sphere [m] |
//! | a, b, c | distances of three faces from its centre, over R [-] |
//! | S, A | area of the part of the sphere, and of the faces, beyond all three |
//!
//! A cap beyond c has the volume pi R^3 (1 - c)^2 (2 + c) / 3. A box is an alternating sum over its corners of
//! the part beyond x > a, y > b, z > c. By the divergence theorem that part has the volume
//!
//! V = R^3 (S - a Aa - b Ab - c Ac) / 3.
//!
//! S is the integral over z of the angle of the circle at z that lies beyond a and b (Archimedes), whose primitive is
//! closed; each A is the part of a disc beyond two lines. Valid for any place of the faces; errors are those of rounding,
//! some 1e-15 R^3. Every angle is the `atan2` of one rounded root, so that its error cancels where the root vanishes.
//!
//! Source: the division of the overlap into spherical and plane parts follows S. Strobl, A. Formella, T. Pöschel,
//! *J. Comput. Phys.* 311 (2016) 158; the primitive is elementary.

use std::f64::consts::{FRAC_PI_2, PI};

use libm::atan2;

/// Volume of a sphere [m3].
#[must_use]
pub fn sphere(radius: f64) -> f64 {
    4.0 / 3.0 * PI * radius * radius * radius
}

/// Volume [m3] of the part of a sphere beyond a plane at `distance` [m] from its centre, which may be negative.
#[must_use]
pub fn beyond(radius: f64, distance: f64) -> f64 {
    let c = distance.clamp(-radius, radius);
    PI / 3.0 * (radius - c) * (radius - c) * (2.0 * radius + c)
}

/// Volume [m3] of the part of a sphere between two parallel planes at the distances `low` < `high` [m] from its centre.
#[must_use]
pub fn in_slab(radius: f64, low: f64, high: f64) -> f64 {
    if low >= radius || high <= -radius {
        0.0
    } else if low <= -radius && high >= radius {
        sphere(radius)
    } else {
        beyond(radius, low) - beyond(radius, high)
    }
}

/// Volume [m3] of the part of a sphere in a box, whose corners `low` < `high` [m] are given from its centre.
#[must_use]
pub fn in_box(radius: f64, low: [f64; 3], high: [f64; 3]) -> f64 {
    let faces: [[f64; 2]; 3] =
        std::array::from_fn(|axis| [low[axis], high[axis]].map(|face| (face / radius).clamp(-1.0, 1.0)));
    if faces.iter().any(|[low, high]| *low >= 1.0 || *high <= -1.0) {
        return 0.0;
    }
    let is_cut = |axis: &usize| faces[*axis][0] > -1.0 || faces[*axis][1] < 1.0;
    let mut cut = (0..3).filter(is_cut);
    match (cut.next(), cut.next()) {
        (None, _) => sphere(radius),
        (Some(axis), None) => in_slab(radius, low[axis], high[axis]),
        _ => {
            let mut volume = 0.0;
            for corner in 0..8usize {
                let side = |axis: usize| corner >> axis & 1;
                let part = octant(faces[0][side(0)], faces[1][side(1)], faces[2][side(2)]);
                volume += if corner.count_ones().is_multiple_of(2) { part } else { -part };
            }
            volume.max(0.0) * radius * radius * radius
        }
    }
}

/// Volume of the part of the unit ball beyond three faces in [-1, 1].
fn octant(a: f64, b: f64, c: f64) -> f64 {
    if a >= 1.0 || b >= 1.0 || c >= 1.0 {
        return 0.0;
    }
    (sphere_beyond(a, b, c) - a * disc_beyond(b, c, a) - b * disc_beyond(a, c, b) - c * disc_beyond(a, b, c)) / 3.0
}

/// The root of 1 - a^2 - b^2, zero where that is negative.
fn root(a: f64, b: f64) -> f64 {
    ((1.0 - a) * (1.0 + a) - b * b).max(0.0).sqrt()
}

/// Area of the part of the unit sphere beyond three faces.
fn sphere_beyond(a: f64, b: f64, c: f64) -> f64 {
    let height = root(a, b);
    let mut area = 0.0;
    // The edge of the faces a and b is inside the sphere between these heights: the two arcs overlap once.
    let (low, high) = (c.max(-height), height);
    if high > low {
        area += arcs(a, low, high) + arcs(b, low, high) - FRAC_PI_2 * (high - low);
    }
    for (low, high) in [(c, -height), (c.max(height), 1.0)] {
        if high > low {
            area += match (a < 0.0, b < 0.0) {
                (false, false) => 0.0,
                (true, false) => 2.0 * arcs(b, low, high),
                (false, true) => 2.0 * arcs(a, low, high),
                (true, true) => 2.0 * (arcs(a, low, high) + arcs(b, low, high) - PI * (high - low)),
            };
        }
    }
    area
}

/// Integral from `low` to `high` of half the angle of the circle of the unit sphere at z that lies beyond a face `a`.
fn arcs(a: f64, low: f64, high: f64) -> f64 {
    let reach = root(a, 0.0);
    let primitive = |z: f64| {
        let root = ((reach - z) * (reach + z)).max(0.0).sqrt();
        // A face through the centre halves every circle, also the one that is a point.
        let half_angle = if a == 0.0 { FRAC_PI_2 } else { atan2(root, a) };
        z * half_angle + atan2(a * z, root) - a * atan2(z, root)
    };
    let (from, to) = (low.clamp(-reach, reach), high.clamp(-reach, reach));
    let outside = (high - low) - (to - from);
    let cut = if to > from { primitive(to) - primitive(from) } else { 0.0 };
    cut + if a < 0.0 { PI * outside } else { 0.0 }
}

/// Area of the part beyond the lines a and b of the disc that the unit ball has at `height`.
fn disc_beyond(a: f64, b: f64, height: f64) -> f64 {
    let squared = (1.0 - height) * (1.0 + height);
    let chord = |side: f64| root(height, side);
    // Where a line misses the disc its half angle is 0 or pi.
    let half_angle = |side: f64| atan2(chord(side), side);
    let length = |side: f64, other: f64| (chord(side) - other.max(-chord(side))).max(0.0);
    let angle = if a * a + b * b < squared {
        half_angle(a) + half_angle(b) - FRAC_PI_2
    } else {
        match (a < 0.0, b < 0.0) {
            (false, false) => return 0.0,
            (true, false) => 2.0 * half_angle(b),
            (false, true) => 2.0 * half_angle(a),
            (true, true) => 2.0 * (half_angle(a) + half_angle(b) - PI),
        }
    };
    0.5 * (squared * angle - a * length(a, b) - b * length(b, a))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const EVERYTHING: [f64; 2] = [-2.0, 2.0];
    /// Rounding of some sums of numbers near the volume of the unit ball [m3].
    const ROUNDING: f64 = 5e-15;

    fn cut(x: [f64; 2], y: [f64; 2], z: [f64; 2]) -> f64 {
        in_box(1.0, [x[0], y[0], z[0]], [x[1], y[1], z[1]])
    }

    #[test]
    fn halves_quarters_and_octants_are_exact() {
        let (upper, whole) = ([0.0, 3.0], sphere(1.0));
        let parts = [
            (cut(upper, EVERYTHING, EVERYTHING), 2.0),
            (cut(upper, upper, EVERYTHING), 4.0),
            (cut(upper, upper, upper), 8.0),
        ];
        for (part, share) in parts {
            assert!((part - whole / share).abs() < ROUNDING, "{share}: off by {:e}", part - whole / share);
        }
    }

    #[test]
    fn a_cube_inside_keeps_its_volume_and_one_around_keeps_the_sphere() {
        let inside = [-0.5, 0.5];
        assert!((cut(inside, inside, inside) - 1.0).abs() < 2e-15);
        let inscribed = [-(1.0f64 / 3.0).sqrt(), (1.0f64 / 3.0).sqrt()];
        assert!((cut(inscribed, inscribed, inscribed) - (inscribed[1] * 2.0).powi(3)).abs() < 5e-15);
        assert_eq!(cut([-1.0, 1.0], EVERYTHING, EVERYTHING).to_bits(), sphere(1.0).to_bits());
    }

    #[test]
    fn two_parallel_cuts_beside_a_third_are_a_difference_of_caps() {
        // The wedge between two crossed slabs by adding it to its three complements.
        let (x, y) = ([-0.3, 0.6], [0.1, 0.7]);
        let parts: f64 = [[-2.0, 0.1], y, [0.7, 2.0]].iter().map(|y| cut(x, *y, EVERYTHING)).sum();
        assert!((parts - in_slab(1.0, -0.3, 0.6)).abs() < 3e-15);
    }

    proptest! {
        #[test]
        fn parts_of_a_split_box_add_up(
            low in prop::array::uniform3(-1.2f64..0.9),
            edge in prop::array::uniform3(0.0f64..2.0),
            share in 0.0f64..1.0,
            axis in 0usize..3,
            radius in 0.1f64..10.0,
        ) {
            let low = low.map(|face| face * radius);
            let high: [f64; 3] = std::array::from_fn(|k| low[k] + edge[k] * radius);
            let middle = low[axis] + share * (high[axis] - low[axis]);
            let (mut first, mut second) = (high, low);
            first[axis] = middle;
            second[axis] = middle;
            let whole = in_box(radius, low, high);
            let parts = in_box(radius, low, first) + in_box(radius, second, high);
            prop_assert!((whole - parts).abs() < 1e-13 * radius.powi(3), "{whole} {parts}");
        }

        #[test]
        fn axes_are_alike_and_mirrors_change_nothing(
            low in prop::array::uniform3(-1.2f64..0.9),
            edge in prop::array::uniform3(0.0f64..2.0),
        ) {
            let high: [f64; 3] = std::array::from_fn(|k| low[k] + edge[k]);
            let volume = in_box(1.0, low, high);
            let turned = |v: [f64; 3]| [v[1], v[2], v[0]];
            prop_assert!((volume - in_box(1.0, turned(low), turned(high))).abs() < 1e-13);
            prop_assert!((volume - in_box(1.0, [-high[0], low[1], low[2]], [-low[0], high[1], high[2]])).abs() < 1e-13);
        }

        #[test]
        fn the_slope_over_a_face_is_the_area_of_its_disc(a in -0.9f64..0.9, b in -0.9f64..0.9, c in -0.9f64..0.9) {
            let step = 1e-6;
            let slope = (octant(a, b, c + step) - octant(a, b, c - step)) / (2.0 * step);
            prop_assert!((slope + disc_beyond(a, b, c)).abs() < 1e-8, "{slope}");
        }
    }
}

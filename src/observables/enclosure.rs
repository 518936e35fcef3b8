//! What planes, one cylinder and the domain enclose: its volume, and the area of its faces.
//!
//! A face is a polygon, clipped by all other planes (I. E. Sutherland, G. W. Hodgman, *Commun. ACM* 17 (1974) 32); the
//! volume of a polyhedron is a third of the sum over its faces of area times distance from a point. A cylinder
//! is exact where every plane is parallel or perpendicular to its axis: its cross-section is then a polygon cut by a circle.

use std::f64::consts::TAU;

use libm::atan2;

use crate::Vector;
use crate::bodies::BodyShape;
use crate::domain::Domain;

/// Largest sine and cosine of what counts as parallel and perpendicular [-].
const ALIGNED: f64 = 1e-9;

/// One side of a plane.
#[derive(Clone, Copy, Debug)]
pub struct HalfSpace {
    /// A point of the plane [m].
    pub point: Vector,
    /// Unit normal into the half-space [-].
    pub inward: Vector,
}

impl HalfSpace {
    fn height(&self, of: &Vector) -> f64 {
        (of - self.point).dot(&self.inward)
    }

    /// The slab between two heights [m] over `point` along the unit vector `up`.
    #[must_use]
    pub fn slab(point: Vector, up: Vector, low: f64, high: f64) -> [Self; 2] {
        [Self { point: point + up * low, inward: up }, Self { point: point + up * high, inward: -up }]
    }
}

/// The inside of a cylinder.
#[derive(Clone, Copy, Debug)]
struct Bore {
    point: Vector,
    axis: Vector,
    radius: f64,
}

/// The part of space on the inner side of every wall.
#[derive(Clone, Debug)]
pub struct Enclosure {
    spaces: Vec<HalfSpace>,
    bore: Option<Bore>,
    center: Vector,
    size: f64,
}

impl Enclosure {
    /// What walls (a point and a shape each), the domain and `more` planes enclose.
    ///
    /// # Errors
    /// There is more than one cylinder.
    pub fn new(walls: &[(Vector, BodyShape)], domain: &Domain, more: &[HalfSpace]) -> Result<Self, String> {
        let size = domain.length.norm();
        let mut enclosure = Self { spaces: Vec::new(), bore: None, center: domain.min + domain.length * 0.5, size };
        for (point, shape) in walls {
            match *shape {
                BodyShape::Plane { normal } => enclosure.add(HalfSpace { point: *point, inward: normal }),
                BodyShape::Cylinder { axis, radius } if enclosure.bore.is_none() => {
                    enclosure.bore = Some(Bore { point: *point, axis, radius });
                }
                BodyShape::Cylinder { .. } => return Err("what two cylinders enclose is not computed".to_owned()),
            }
        }
        for axis in 0..3 {
            let mut inward = Vector::zeros();
            inward[axis] = 1.0;
            enclosure.add(HalfSpace { point: domain.min, inward });
            enclosure.add(HalfSpace { point: domain.min + domain.length, inward: -inward });
        }
        for space in more {
            enclosure.add(*space);
        }
        Ok(enclosure)
    }

    /// Adds a plane unless it is there already.
    fn add(&mut self, new: HalfSpace) {
        let same = |old: &HalfSpace| {
            (old.inward - new.inward).norm() < ALIGNED && new.height(&old.point).abs() < 1e-14 * self.size
        };
        if !self.spaces.iter().any(same) {
            self.spaces.push(new);
        }
    }

    /// The part of a plane inside all other planes.
    fn face(&self, of: &HalfSpace, spaces: &[HalfSpace]) -> Vec<Vector> {
        let first = of.inward.cross(&Vector::ith(of.inward.iamin(), 1.0)).normalize();
        let second = of.inward.cross(&first);
        let middle = self.center - of.inward * of.height(&self.center);
        // A square larger than any section of the domain.
        let corner = |u: f64, v: f64| middle + (first * u + second * v) * (2.0 * self.size);
        let mut polygon = vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
        for space in spaces {
            let parallel = space.inward.cross(&of.inward).norm() < ALIGNED;
            if parallel && space.inward.dot(&of.inward) > 0.0 && space.height(&of.point).abs() < 1e-14 * self.size {
                continue;
            }
            polygon = clip(&polygon, space);
        }
        polygon
    }

    /// Planes parallel to the axis of the cylinder, and the range along it [m] that the others leave.
    fn section(&self, bore: &Bore) -> Result<(Vec<HalfSpace>, f64, f64), String> {
        let (mut along, mut low, mut high) = (Vec::new(), f64::NEG_INFINITY, f64::INFINITY);
        for space in &self.spaces {
            let cosine = space.inward.dot(&bore.axis);
            let height = (space.point - bore.point).dot(&bore.axis);
            if cosine.abs() < ALIGNED {
                along.push(*space);
            } else if space.inward.cross(&bore.axis).norm() > ALIGNED {
                return Err("a plane oblique to the axis of a cylinder: what they enclose is not computed".to_owned());
            } else if cosine > 0.0 {
                low = low.max(height);
            } else {
                high = high.min(height);
            }
        }
        Ok((along, low, high.max(low)))
    }

    /// Area of a cross-section of the cylinder [m2].
    fn cross_section(&self, bore: &Bore, along: &[HalfSpace]) -> f64 {
        let polygon = self.face(&HalfSpace { point: bore.point, inward: bore.axis }, along);
        disc_in_polygon(&polygon, bore)
    }

    /// Its volume [m3].
    ///
    /// # Errors
    /// A plane is oblique to the axis of the cylinder.
    pub fn volume(&self) -> Result<f64, String> {
        if let Some(bore) = &self.bore {
            let (along, low, high) = self.section(bore)?;
            return Ok(self.cross_section(bore, &along) * (high - low));
        }
        let cone = |space: &HalfSpace| area(&self.face(space, &self.spaces)) * space.height(&self.center);
        Ok(self.spaces.iter().map(cone).sum::<f64>() / 3.0)
    }

    /// Area of the face that a wall has [m2].
    ///
    /// # Errors
    /// A plane is oblique to the axis of the cylinder, or the domain does not hold the cylinder.
    pub fn area(&self, point: Vector, shape: &BodyShape) -> Result<f64, String> {
        match (shape, &self.bore) {
            (BodyShape::Plane { normal }, bore) => {
                let wall = HalfSpace { point, inward: *normal };
                let Some(bore) = bore else { return Ok(area(&self.face(&wall, &self.spaces))) };
                let (mut along, low, high) = self.section(bore)?;
                if normal.dot(&bore.axis).abs() > 0.5 {
                    let height = (point - bore.point).dot(&bore.axis);
                    let inside = height >= low - ALIGNED * self.size && height <= high + ALIGNED * self.size;
                    return Ok(if inside { self.cross_section(bore, &along) } else { 0.0 });
                }
                let distance = wall.height(&bore.point);
                let half = ((bore.radius - distance) * (bore.radius + distance)).max(0.0).sqrt();
                along.extend(HalfSpace::slab(bore.point, normal.cross(&bore.axis), -half, half));
                along.extend(HalfSpace::slab(bore.point, bore.axis, low, high));
                Ok(area(&self.face(&wall, &along)))
            }
            (BodyShape::Cylinder { .. }, Some(bore)) => {
                let (along, low, high) = self.section(bore)?;
                let cut = along.iter().any(|space| space.height(&bore.point) < bore.radius * (1.0 - ALIGNED));
                if cut {
                    return Err("planes or the domain cut the cylinder lengthwise: its area is not computed".to_owned());
                }
                Ok(TAU * bore.radius * (high - low))
            }
            (BodyShape::Cylinder { .. }, None) => Err("the cylinder is none of the walls".to_owned()),
        }
    }
}

/// The part of a convex polygon inside a half-space.
fn clip(polygon: &[Vector], space: &HalfSpace) -> Vec<Vector> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (k, to) in polygon.iter().enumerate() {
        let from = &polygon[(k + polygon.len() - 1) % polygon.len()];
        let (before, after) = (space.height(from), space.height(to));
        if (before < 0.0) != (after < 0.0) {
            kept.push(from + (to - from) * (before / (before - after)));
        }
        if after >= 0.0 {
            kept.push(*to);
        }
    }
    kept
}

fn area(polygon: &[Vector]) -> f64 {
    let fan = polygon.windows(2).skip(1).map(|edge| (edge[0] - polygon[0]).cross(&(edge[1] - polygon[0])));
    0.5 * fan.sum::<Vector>().norm()
}

/// Area of the part of a convex polygon across the axis that lies inside the cylinder [m2]: the sum over its edges of the
/// part of the disc seen from the axis through that edge.
fn disc_in_polygon(polygon: &[Vector], bore: &Bore) -> f64 {
    let squared = bore.radius * bore.radius;
    let sector = |from: &Vector, to: &Vector| 0.5 * squared * angle(from, to, &bore.axis);
    let mut sum = 0.0;
    for (k, end) in polygon.iter().enumerate() {
        let (from, to) = (polygon[(k + polygon.len() - 1) % polygon.len()] - bore.point, end - bore.point);
        let edge = to - from;
        let length = edge.norm();
        if length == 0.0 {
            continue;
        }
        let along = edge / length;
        let start = from.dot(&along);
        let foot = from - along * start;
        let half = (squared - foot.norm_squared()).max(0.0).sqrt();
        let (first, last) = ((-half).clamp(start, start + length), half.clamp(start, start + length));
        if last > first {
            let (entry, exit) = (foot + along * first, foot + along * last);
            let triangle = 0.5 * entry.cross(&exit).dot(&bore.axis);
            sum += sector(&from, &entry) + triangle + sector(&exit, &to);
        } else {
            sum += sector(&from, &to);
        }
    }
    sum.abs()
}

/// Angle from one vector to another about an axis.
fn angle(from: &Vector, to: &Vector, axis: &Vector) -> f64 {
    atan2(from.cross(to).dot(axis), from.dot(to))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn unit_domain() -> Domain {
        Domain { min: Vector::zeros(), length: Vector::new(1.0, 2.0, 3.0), periodic: [false; 3] }
    }

    fn plane(point: [f64; 3], normal: [f64; 3]) -> (Vector, BodyShape) {
        (point.into(), BodyShape::Plane { normal: Vector::from(normal).normalize() })
    }

    #[test]
    fn a_domain_without_walls_is_a_box() {
        let enclosure = Enclosure::new(&[], &unit_domain(), &[]).unwrap();
        assert!((enclosure.volume().unwrap() - 6.0).abs() < 1e-14);
    }

    #[test]
    fn an_oblique_plane_halves_a_box() {
        let wall = plane([0.0, 1.0, 1.5], [0.0, 3.0, 2.0]);
        let enclosure = Enclosure::new(&[wall], &unit_domain(), &[]).unwrap();
        assert!((enclosure.volume().unwrap() - 3.0).abs() < 1e-14);
        assert!((enclosure.area(wall.0, &wall.1).unwrap() - 13f64.sqrt() * 2.0 / 2.0).abs() < 1e-14);
    }

    #[test]
    fn a_wall_on_a_face_of_the_domain_counts_once() {
        let floor = plane([5.0, 5.0, 0.0], [0.0, 0.0, 1.0]);
        let side = plane([0.25, 0.0, 0.0], [1.0, 0.0, 0.0]);
        let enclosure = Enclosure::new(&[floor, side], &unit_domain(), &[]).unwrap();
        assert!((enclosure.volume().unwrap() - 4.5).abs() < 1e-14);
        assert!((enclosure.area(floor.0, &floor.1).unwrap() - 1.5).abs() < 1e-14);
        assert!((enclosure.area(side.0, &side.1).unwrap() - 6.0).abs() < 1e-14);
    }

    #[test]
    fn a_cylinder_and_its_floor_are_exact() {
        let bore = (Vector::new(0.5, 1.0, 0.0), BodyShape::Cylinder { axis: Vector::z(), radius: 0.5 });
        let floor = plane([0.0, 0.0, 1.0], [0.0, 0.0, 1.0]);
        let slab = HalfSpace::slab(Vector::zeros(), Vector::z(), 1.5, 2.0);
        let enclosure = Enclosure::new(&[bore, floor], &unit_domain(), &[]).unwrap();
        assert!((enclosure.volume().unwrap() - PI * 0.25 * 2.0).abs() < 1e-14);
        assert!((enclosure.area(floor.0, &floor.1).unwrap() - PI * 0.25).abs() < 1e-14);
        assert!((enclosure.area(bore.0, &bore.1).unwrap() - TAU).abs() < 1e-14);
        let part = Enclosure::new(&[bore, floor], &unit_domain(), &slab).unwrap();
        assert!((part.volume().unwrap() - PI * 0.125).abs() < 1e-14);
        // A wall through the axis halves it, and is itself a strip.
        let half = plane([0.5, 0.0, 0.0], [1.0, 0.0, 0.0]);
        let halved = Enclosure::new(&[bore, floor, half], &unit_domain(), &[]).unwrap();
        assert!((halved.volume().unwrap() - PI * 0.25).abs() < 1e-14);
        assert!((halved.area(half.0, &half.1).unwrap() - 2.0).abs() < 1e-14);
        assert!(halved.area(bore.0, &bore.1).is_err());
    }
}

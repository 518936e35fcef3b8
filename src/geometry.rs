//! Contact geometry: sphere against sphere, plane and the inside of a cylinder give the same description.

use crate::Vector;

/// What particle i touches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Surface {
    /// Another sphere.
    Sphere,
    /// A plane.
    Plane,
    /// The inside of a cylinder.
    Cylinder {
        /// Unit vector along its axis [-].
        axis: Vector,
        /// Its radius [m], whatever curvature a mirror gives it.
        bore: f64,
    },
}

/// Where two bodies touch, seen from particle i.
#[derive(Clone, Copy, Debug)]
pub struct ContactGeometry {
    /// Unit normal from j to i [-].
    pub normal: Vector,
    /// Overlap, positive in contact [m].
    pub overlap: f64,
    /// Radius of i [m].
    pub radius_i: f64,
    /// Radius of j [m]; infinite for a plane, negative inside a cylinder.
    pub radius_j: f64,
    /// What j is.
    pub surface: Surface,
}

impl ContactGeometry {
    /// The normal one step `dt` [s] earlier, from the present normal and the velocity [m/s] of i less that of j over the
    /// step: both schemes move centres by exactly velocity times dt. Bodies do not turn.
    #[must_use]
    #[allow(clippy::inline_always, reason = "the batch of contacts is vectorised only where laws are inlined")]
    #[inline(always)]
    pub fn previous_normal(&self, velocity: &Vector, dt: f64) -> Vector {
        let (velocity, other) = match self.surface {
            Surface::Sphere => (*velocity, self.radius_j),
            Surface::Plane => return self.normal,
            Surface::Cylinder { axis, bore } => (velocity - axis * velocity.dot(&axis), -bore),
        };
        // Inside a cylinder the distance is negative: the normal points to the axis.
        let distance = self.radius_i + other - self.overlap;
        let branch = self.normal - velocity * (dt / distance);
        branch * (1.0 / branch.norm())
    }

    /// R* = `Ri` `Rj` / (`Ri` + `Rj`), `Ri` at a plane, `Ri` `Rc` / (`Rc` - `Ri`) inside a cylinder of radius `Rc` [m].
    #[must_use]
    #[inline(always)]
    pub fn effective_radius(&self) -> f64 {
        if self.radius_j.is_infinite() { self.radius_i } else { crate::material::reduced(self.radius_i, self.radius_j) }
    }
}

/// Two spheres: centres [m] and radii [m]. None where the centres coincide.
#[must_use]
pub fn sphere_sphere(center_i: Vector, radius_i: f64, center_j: Vector, radius_j: f64) -> Option<ContactGeometry> {
    let branch = center_i - center_j;
    let squared = branch.norm_squared();
    (squared > 0.0).then(|| spheres(branch, squared, radius_i, radius_j))
}

/// Two spheres from their branch vector (from j to i) [m] and its square [m2], which is not zero.
#[must_use]
#[inline(always)]
pub fn spheres(branch: Vector, squared: f64, radius_i: f64, radius_j: f64) -> ContactGeometry {
    let distance = squared.sqrt();
    ContactGeometry {
        normal: branch * (1.0 / distance),
        overlap: radius_i + radius_j - distance,
        radius_i,
        radius_j,
        surface: Surface::Sphere,
    }
}

/// A sphere and a plane through `point` [m] with the unit `normal` into the region of the particles.
#[must_use]
pub fn sphere_plane(center: Vector, radius: f64, point: Vector, normal: Vector) -> ContactGeometry {
    let distance = (center - point).dot(&normal);
    ContactGeometry {
        normal,
        overlap: radius - distance,
        radius_i: radius,
        radius_j: f64::INFINITY,
        surface: Surface::Plane,
    }
}

/// A sphere inside a cylinder of `bore` [m] about the axis through `point` [m] along the unit vector `axis`. None where
/// the centre lies on the axis.
#[must_use]
pub fn sphere_cylinder(center: Vector, radius: f64, point: Vector, axis: Vector, bore: f64) -> Option<ContactGeometry> {
    let arm = center - point;
    let radial = arm - axis * arm.dot(&axis);
    let distance = radial.norm();
    (distance > 0.0).then(|| ContactGeometry {
        normal: -radial / distance,
        overlap: radius + distance - bore,
        radius_i: radius,
        radius_j: -bore,
        surface: Surface::Cylinder { axis, bore },
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_point_from_j_to_i_and_overlap_is_positive_in_contact() {
        let contact = sphere_sphere(Vector::new(1.5, 0.0, 0.0), 1.0, Vector::zeros(), 1.0).unwrap();
        assert_eq!(contact.normal, Vector::new(1.0, 0.0, 0.0));
        assert!((contact.overlap - 0.5).abs() < 1e-15);
        assert!((contact.effective_radius() - 0.5).abs() < 1e-15);
    }

    #[test]
    fn a_plane_is_the_limit_of_a_large_sphere() {
        let (center, radius) = (Vector::new(0.3, 0.2, 0.9), 1.0);
        let plane = sphere_plane(center, radius, Vector::zeros(), Vector::z());
        let large = 1e8;
        let sphere = sphere_sphere(center, radius, Vector::new(0.3, 0.2, -large), large).unwrap();
        assert!((plane.overlap - sphere.overlap).abs() < 1e-7);
        assert!((plane.effective_radius() / sphere.effective_radius() - 1.0 - 1e-8).abs() < 1e-12);
    }

    #[test]
    fn inside_a_cylinder_the_curvature_is_subtracted() {
        let center = Vector::new(0.3, 0.0, 4.0);
        let contact = sphere_cylinder(center, 0.2, Vector::zeros(), Vector::z(), 0.45).unwrap();
        assert_eq!(contact.normal, Vector::new(-1.0, 0.0, 0.0));
        assert!((contact.overlap - 0.05).abs() < 1e-15);
        assert!((contact.effective_radius() - 0.2 * 0.45 / 0.25).abs() < 1e-15);
        assert!(sphere_cylinder(Vector::z(), 0.2, Vector::zeros(), Vector::z(), 0.45).is_none());
    }
}

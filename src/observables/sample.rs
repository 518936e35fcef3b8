//! The state at one time, and what several observables need of it.

use std::sync::OnceLock;

use super::system::{Partner, System};
use super::touching::{self, Touching};
use crate::Vector;
use crate::bodies::BodyShape;
use crate::geometry::{self, ContactGeometry};

/// A row of a column.
pub type Row = [f64; 3];

/// The contacts of one sample.
#[derive(Clone, Copy, Debug)]
pub struct Contacts<'a> {
    /// Indices (M, 2) of the first particle and of the second, or N + the index of the body.
    pub pair: &'a [[u32; 2]],
    /// Force on the first [N].
    pub force: &'a [Row],
}

/// Columns of one sample; those that are absent make an observable that needs them an error.
#[derive(Clone, Copy, Debug)]
pub struct State<'a> {
    /// Centres (N, 3), also outside the box [m].
    pub position: &'a [Row],
    /// Velocities (N, 3) [m/s].
    pub velocity: Option<&'a [Row]>,
    /// Angular velocities (N, 3) [rad/s].
    pub angular_velocity: Option<&'a [Row]>,
    /// Sums of contact forces on the particles (N, 3) [N].
    pub force: Option<&'a [Row]>,
    /// Forces of the particles on the bodies (B, 3) [N].
    pub body_force: Option<&'a [Row]>,
    /// Points of the bodies (B, 3), where they move [m].
    pub body_point: Option<&'a [Row]>,
    /// Radii (N), where they change [m].
    pub radius: Option<&'a [f64]>,
    /// Contacts.
    pub contacts: Option<Contacts<'a>>,
}

/// A contact with its force.
#[derive(Clone, Copy, Debug)]
pub struct Contact {
    /// The first particle.
    pub particle: usize,
    /// What it touches.
    pub partner: Partner,
    /// Force on the particle [N].
    pub force: Vector,
    /// Unit normal to the particle [-].
    pub normal: Vector,
    /// Centre of the particle, in the box [m].
    pub center: Vector,
    /// From the other centre, or from the point of the body that is touched, to the particle [m].
    pub branch: Vector,
    /// The middle of the overlap of two particles, or the point of the body [m].
    pub place: Vector,
}

impl Contact {
    /// Force along the normal, positive where it pushes [N].
    #[must_use]
    pub fn normal_force(&self) -> f64 {
        self.force.dot(&self.normal)
    }

    /// Force across the normal, on the particle [N].
    #[must_use]
    pub fn tangential_force(&self) -> Vector {
        self.force - self.normal * self.normal_force()
    }
}

/// The state at one time.
#[derive(Debug)]
pub struct Sample<'a> {
    /// What does not change.
    pub system: &'a System,
    /// Columns.
    pub state: State<'a>,
    centers: Vec<Vector>,
    touching: OnceLock<Touching>,
    contacts: OnceLock<Result<Vec<Contact>, String>>,
}

impl<'a> Sample<'a> {
    /// A sample; `state` has the lengths that `system` asks for.
    #[must_use]
    pub fn new(system: &'a System, state: State<'a>) -> Self {
        let centers = state.position.iter().map(|row| system.domain.wrap(Vector::from(*row)).0).collect();
        Self { system, state, centers, touching: OnceLock::new(), contacts: OnceLock::new() }
    }

    /// Centres (N) in the box [m].
    #[must_use]
    pub fn centers(&self) -> &[Vector] {
        &self.centers
    }

    /// Radii (N) of the moment [m].
    #[must_use]
    pub fn radius(&self) -> &[f64] {
        self.state.radius.unwrap_or(&self.system.radius)
    }

    /// A point of a wall [m].
    #[must_use]
    pub fn point(&self, body: usize) -> Vector {
        self.state.body_point.map_or(self.system.bodies[body].point, |points| points[body].into())
    }

    /// Points and shapes of all walls.
    #[must_use]
    pub fn walls(&self) -> Vec<(Vector, BodyShape)> {
        self.system.bodies.iter().enumerate().map(|(at, body)| (self.point(at), body.shape)).collect()
    }

    /// A wall that must be a plane: its point [m] and unit normal.
    ///
    /// # Errors
    /// There is no wall of this name, or it is no plane.
    pub fn plane(&self, name: &str) -> Result<(Vector, Vector), String> {
        let at = self.system.body(name)?;
        match self.system.bodies[at].shape {
            BodyShape::Plane { normal } => Ok((self.point(at), normal)),
            BodyShape::Cylinder { .. } => Err(format!("body {name} is a cylinder, expected a plane")),
        }
    }

    /// Force of the particles on a wall [N].
    ///
    /// # Errors
    /// There is no such wall, or the record has no forces on bodies.
    pub fn body_force(&self, name: &str) -> Result<Vector, String> {
        let at = self.system.body(name)?;
        Ok(needed(self.state.body_force, "body_force")?[at].into())
    }

    /// Who touches whom, by geometry.
    pub fn touching(&self) -> &Touching {
        self.touching.get_or_init(|| touching::find(self))
    }

    /// Contact geometry of a particle with a wall; none on the axis of a cylinder.
    #[must_use]
    pub fn at_wall(&self, particle: usize, body: usize) -> Option<ContactGeometry> {
        let (center, radius, point) = (self.centers[particle], self.radius()[particle], self.point(body));
        match self.system.bodies[body].shape {
            BodyShape::Plane { normal } => Some(geometry::sphere_plane(center, radius, point, normal)),
            BodyShape::Cylinder { axis, radius: bore } => geometry::sphere_cylinder(center, radius, point, axis, bore),
        }
    }

    /// The recorded contacts with their geometry.
    ///
    /// # Errors
    /// The record has no contacts, or a contact whose normal is not defined.
    pub fn contacts(&self) -> Result<&[Contact], String> {
        self.contacts.get_or_init(|| self.located()).as_deref().map_err(Clone::clone)
    }

    fn located(&self) -> Result<Vec<Contact>, String> {
        let contacts = self
            .state
            .contacts
            .ok_or("it needs contacts (contact_start, contact_pair, contact_force), which this record does not have")?;
        let located = |(pair, force): (&[u32; 2], &Row)| {
            let [first, second] = pair.map(|index| index as usize);
            let undefined = || format!("contact of {first} with {second}: its normal is not defined");
            let (center, radius) = (self.centers[first], self.radius());
            let bodies_from = self.centers.len();
            let (partner, normal, branch, place);
            if second < bodies_from {
                partner = Partner::Particle(second);
                branch = self.system.domain.nearest(center - self.centers[second]);
                let distance = branch.norm();
                normal = Some(branch / distance).filter(|_| distance > 0.0).ok_or_else(undefined)?;
                let overlap = radius[first] + radius[second] - distance;
                place = center - normal * (radius[first] - 0.5 * overlap);
            } else {
                partner = Partner::Body(second - bodies_from);
                let at = self.at_wall(first, second - bodies_from).ok_or_else(undefined)?;
                normal = at.normal;
                branch = normal * (radius[first] - at.overlap);
                place = center - branch;
            }
            Ok(Contact { particle: first, partner, force: (*force).into(), normal, center, branch, place })
        };
        contacts.pair.iter().zip(contacts.force).map(located).collect()
    }
}

/// A column that an observable needs.
///
/// # Errors
/// The record does not have it.
pub fn needed<'a, T: ?Sized>(column: Option<&'a T>, name: &str) -> Result<&'a T, String> {
    column.ok_or_else(|| format!("it needs the column {name}, which this record does not have"))
}

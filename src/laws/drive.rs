//! One contact on its own: driven along a prescribed path, or free to collide.
//!
//! Both move as the codes do: x(n+1) = x(n) + v dt, force at x(n+1) with v. The contact is born and dies as in a
//! simulation.

use nalgebra::Rotation3;

use crate::Vector;
use crate::error::Error;
use crate::geometry::{self, ContactGeometry, Surface};

use super::model::{Action, ContactModel};
use super::{Contact, Losses, PairLaw, Surroundings};

/// Two bodies that touch: i is a sphere, j a sphere or a plane through its position with the normal +x.
#[derive(Clone, Copy, Debug)]
pub struct Couple {
    /// Mixed values; effective radius and mass are filled in.
    pub pair: PairLaw,
    /// Radii of i and j [m]; that of a plane is infinite, or finite for codes that give it one.
    pub radii: [f64; 2],
    /// Masses of i and j [kg]; infinite for a body.
    pub masses: [f64; 2],
    /// What j is: a sphere or a plane.
    pub surface: Surface,
}

/// Motion of a body.
#[derive(Clone, Copy, Debug)]
pub struct Motion {
    /// Centre [m].
    pub position: Vector,
    /// Velocity [m/s].
    pub velocity: Vector,
    /// Angular velocity [rad/s].
    pub angular_velocity: Vector,
}

/// A contact at one time.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Number of steps since the start.
    pub step: u64,
    /// The contact.
    pub contact: Contact,
    /// Force and moments; None without contact.
    pub action: Option<Action>,
}

/// A part of a path. Vectors are in a frame in which j rests, i starts on the +x axis, and which turns.
#[derive(Clone, Copy, Debug)]
pub struct Stage {
    /// Number of steps.
    pub steps: u64,
    /// Velocity of i [m/s].
    pub velocity: Vector,
    /// Angular velocities of i and j [rad/s].
    pub angular_velocities: [Vector; 2],
    /// Angular velocity of the frame, in space [rad/s].
    pub turn: Vector,
}

/// A prescribed path.
#[derive(Clone, Debug)]
pub struct Path {
    /// Overlap at the start, negative for a gap [m].
    pub overlap: f64,
    /// Time step [s].
    pub dt: f64,
    /// Parts in order.
    pub stages: Vec<Stage>,
}

/// A contact and what it remembers.
#[derive(Clone, Debug)]
pub struct Single<M: ContactModel> {
    model: M,
    couple: Couple,
    shared: M::Shared,
    history: M::History,
    /// What acts on the contact.
    pub surroundings: Surroundings,
    /// Losses since the start, but for the dashpot along the normal.
    pub losses: Losses,
}

impl Couple {
    /// Two spheres of one density [kg/m3].
    #[must_use]
    pub fn spheres(pair: PairLaw, radii: [f64; 2], density: f64) -> Self {
        let masses = radii.map(|radius| density * 4.0 / 3.0 * std::f64::consts::PI * radius * radius * radius);
        Self { pair, radii, masses, surface: Surface::Sphere }
    }

    /// A sphere on a plane.
    #[must_use]
    pub fn on_plane(pair: PairLaw, radius: f64, density: f64) -> Self {
        let sphere = Self::spheres(pair, [radius; 2], density);
        let [mass, _] = sphere.masses;
        Self { radii: [radius, f64::INFINITY], masses: [mass, f64::INFINITY], surface: Surface::Plane, ..sphere }
    }

    /// Moments of inertia of solid spheres [kg m2].
    #[must_use]
    pub fn moments_of_inertia(&self) -> [f64; 2] {
        [0, 1].map(|at| 0.4 * self.masses[at] * self.radii[at] * self.radii[at])
    }

    fn geometry(&self, motions: &[Motion; 2]) -> Option<ContactGeometry> {
        let [i, j] = motions;
        let [radius_i, radius_j] = self.radii;
        match self.surface {
            Surface::Sphere => geometry::sphere_sphere(i.position, radius_i, j.position, radius_j),
            _ => Some(ContactGeometry {
                radius_j,
                ..geometry::sphere_plane(i.position, radius_i, j.position, Vector::x())
            }),
        }
    }

    fn pair(&self, geometry: &ContactGeometry) -> PairLaw {
        let [i, j] = self.masses;
        let effective_mass = if j.is_finite() { crate::material::reduced(i, j) } else { i };
        PairLaw { effective_radius: geometry.effective_radius(), effective_mass, ..self.pair }
    }
}

impl<M: ContactModel> Single<M> {
    /// A contact that remembers nothing.
    #[must_use]
    pub fn new(model: M, couple: Couple) -> Self {
        let (shared, history) = (M::Shared::default(), M::History::default());
        Self { model, couple, shared, history, surroundings: Surroundings::default(), losses: Losses::default() }
    }

    /// Evaluates the contact at the end of a step `dt` [s]. None where the centres coincide.
    pub fn evaluate(&mut self, step: u64, motions: &[Motion; 2], dt: f64) -> Option<Sample> {
        let geometry = self.couple.geometry(motions)?;
        let [i, j] = motions;
        let contact = Contact {
            pair: self.couple.pair(&geometry),
            geometry,
            velocity: i.velocity - j.velocity,
            angular_i: i.angular_velocity,
            angular_j: j.angular_velocity,
            masses: self.couple.masses,
        };
        self.model.advance(&mut self.shared, &self.surroundings, dt);
        let action = if self.model.alive(geometry.overlap, &self.history) {
            Some(self.model.evaluate(&contact, &self.shared, dt, &mut self.history))
        } else {
            self.history = M::History::default();
            None
        };
        if let Some(action) = &action {
            self.losses = self.losses + action.losses;
        }
        Some(Sample { step, contact, action })
    }

    /// Lets both bodies fly for `steps` of `dt` [s] from velocities half a step before the start; a plane stays. `visit`
    /// sees every evaluation.
    ///
    /// # Errors
    /// The centres meet.
    pub fn fly(
        &mut self,
        mut motions: [Motion; 2],
        dt: f64,
        steps: u64,
        mut visit: impl FnMut(&Sample, &[Motion; 2]),
    ) -> Result<[Motion; 2], Error> {
        let (masses, inertia) = (self.couple.masses, self.couple.moments_of_inertia());
        for step in 0..=steps {
            let sample = self.evaluate(step, &motions, dt).ok_or_else(coincide)?;
            visit(&sample, &motions);
            if let Some(action) = sample.action {
                let torques = [action.torque_i, action.torque_j];
                for (at, sign) in [(0, 1.0), (1, -1.0)] {
                    if masses[at].is_finite() {
                        motions[at].velocity += action.force * (sign * dt / masses[at]);
                        motions[at].angular_velocity += torques[at] * (dt / inertia[at]);
                    }
                }
            }
            for motion in &mut motions {
                motion.position += motion.velocity * dt;
            }
        }
        Ok(motions)
    }

    /// Drives the contact along `path`; `visit` sees every evaluation and the rotation of the frame.
    ///
    /// # Errors
    /// The path turns a plane, has a time step that is not positive, or brings a centre to the other body.
    pub fn drive(&mut self, path: &Path, mut visit: impl FnMut(&Sample, &Rotation3<f64>)) -> Result<(), Error> {
        let refuse = |reason: String| Error::Scene { scene: "path".into(), reason };
        let plane = self.couple.surface != Surface::Sphere;
        if plane && path.stages.iter().any(|stage| stage.turn.norm_squared() > 0.0) {
            return Err(refuse("turn: a plane does not turn; only a pair of spheres may".into()));
        }
        if path.dt.is_nan() || path.dt <= 0.0 {
            return Err(refuse(format!("dt = {} s: positive", path.dt)));
        }
        let [radius_i, radius_j] = self.couple.radii;
        let distance = radius_i + if plane { 0.0 } else { radius_j } - path.overlap;
        let mut place = Vector::x() * distance;
        let mut frame = Rotation3::identity();
        let rest = Motion { position: place, velocity: Vector::zeros(), angular_velocity: Vector::zeros() };
        let mut motions = [rest, Motion { position: Vector::zeros(), ..rest }];
        visit(&self.evaluate(0, &motions, 0.0).ok_or_else(coincide)?, &frame);
        let mut step = 0;
        for stage in &path.stages {
            // From the start of the stage, so that rounding does not pile up in the frame.
            let start = frame;
            let after = |steps: f64| Rotation3::new(stage.turn * (steps * path.dt)) * start;
            for done in 0..stage.steps {
                place += stage.velocity * path.dt;
                let middle = after(done as f64 + 0.5);
                frame = after(done as f64 + 1.0);
                let position = frame * place;
                motions[0].velocity = (position - motions[0].position) / path.dt;
                motions[0].position = position;
                for (motion, angular) in motions.iter_mut().zip(&stage.angular_velocities) {
                    motion.angular_velocity = middle * angular + stage.turn;
                }
                step += 1;
                let sample = self.evaluate(step, &motions, path.dt).ok_or_else(coincide)?;
                if sample.contact.geometry.overlap >= radius_i {
                    return Err(refuse(format!("step {step}: the path brings the centre of i to the surface of j")));
                }
                visit(&sample, &frame);
            }
        }
        Ok(())
    }
}

fn coincide() -> Error {
    Error::Scene { scene: "contact".into(), reason: "the centres coincide".into() }
}

//! What disks and the laws of two dimensions ask of a case.

use super::Checker;
use crate::case::model::NormalLaw;
use crate::case::protocol::{Action, Body, Load, Motion, Shape};
use crate::case::schema::Geometry;
use crate::case::source::ParticleSource;

impl Checker<'_> {
    pub(super) fn disks(&mut self) {
        let case = self.case;
        if let Geometry::Disks { height } = &case.geometry {
            self.positive("geometry.height", *height);
            if case.gravity[1].si() != 0.0 {
                self.add("gravity.1", format!("{:?}", case.gravity[1]), "disks move in the x-z plane: 0 along y");
            }
            for (i, body) in case.bodies.iter().enumerate() {
                match &body.shape {
                    Shape::Plane { normal, .. } if normal[1].get() == 0.0 => {}
                    Shape::Plane { normal, .. } => {
                        let key = format!("bodies.{i}.shape.normal.1");
                        self.add(key, normal[1].get(), "disks move in the x-z plane: 0 along y");
                    }
                    _ => self.add(format!("bodies.{i}.shape.kind"), "no plane", "disks touch planes only"),
                }
            }
            self.in_one_plane();
        }
        if matches!(case.model.normal, NormalLaw::LudingSintering { .. }) && case.output.energies {
            let allowed =
                "false beside the law `luding_sintering`: heat works on its contacts, and no ledger counts that";
            self.add("output.energies", true, allowed);
        }
        if case.output.contact_states && !case.output.contacts {
            self.add("output.contact_states", true, "only where samples hold contacts: contacts = true");
        }
        for (i, body) in case.bodies.iter().enumerate() {
            self.bounded(&format!("bodies.{i}.motion"), &body.motion);
        }
        for (i, stage) in case.stages.iter().enumerate() {
            for (j, action) in stage.actions.iter().enumerate() {
                let at = format!("stages.{i}.actions.{j}");
                match action {
                    Action::SetMotion { motion, .. } => self.bounded(&format!("{at}.motion"), motion),
                    Action::Strain { body, from, .. } if !self.parallel(body, from) => {
                        self.add(format!("{at}.from"), from, format!("a plane parallel to {body}, as which it is one"));
                    }
                    _ => {}
                }
            }
        }
    }

    /// All disks have one place across their plane.
    fn in_one_plane(&mut self) {
        let case = self.case;
        let mut first = None;
        for (i, source) in case.particles.iter().enumerate() {
            let (key, [low, high]) = match source {
                ParticleSource::Single { position, .. } => ("position.1", [position[1]; 2]),
                ParticleSource::Random { region, .. } => ("region.1.1", [region[0][1], region[1][1]]),
                ParticleSource::Lattice { origin, count, noise, .. } => {
                    if count[1] != 1 || noise.si() > 0.0 {
                        let allowed = "a lattice of disks has one site along y and no noise";
                        self.add(format!("particles.{i}.count.1"), count[1], allowed);
                    }
                    ("origin.1", [origin[1]; 2])
                }
                _ => continue,
            };
            let place = *first.get_or_insert(low);
            if low != place || high != place {
                let allowed = format!("disks move in one plane: y = {place:?}");
                self.add(format!("particles.{i}.{key}"), format!("{high:?}"), allowed);
            }
        }
    }

    /// A line stress acts on the length between two parallel planes.
    fn bounded(&mut self, at: &str, motion: &Motion) {
        if let Motion::Servo { load: Load::LineStress { between: [one, other], .. }, .. } = motion
            && !self.parallel(one, other)
        {
            self.add(format!("{at}.load.between"), format!("{one}, {other}"), "two different parallel planes");
        }
    }

    /// Whether two bodies are different parallel planes; a body that does not exist is another problem.
    fn parallel(&self, one: &str, other: &str) -> bool {
        let plane = |name: &str| self.case.bodies.iter().find(|body| body.name == name);
        let normal = |body: &Body| match &body.shape {
            Shape::Plane { normal, .. } => Some(crate::Vector::from(normal.map(crate::case::quantity::Number::get))),
            _ => None,
        };
        match (plane(one), plane(other)) {
            (Some(one), Some(other)) if one.name != other.name => match (normal(one), normal(other)) {
                (Some(one), Some(other)) => one.cross(&other).norm() <= 1e-9 * one.norm() * other.norm(),
                _ => false,
            },
            (Some(_), Some(_)) => false,
            _ => true,
        }
    }
}

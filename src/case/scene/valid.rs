//! Scenes that come from elsewhere than a case: checked before they run.

use std::collections::HashSet;

use super::duration::MOST_STEPS;
use super::{SCHEMA, Scene, SceneAction, SceneShape};
use crate::Vector;
use crate::case::protocol::Action;
use crate::case::schema::{Boundary, Case};
use crate::domain::Domain;
use crate::error::{Error, Problem};
use crate::laws::registry::{Normal, Specification};
use crate::simulation::SKIN;

const AXES: [&str; 3] = ["x", "y", "z"];

/// Refuses walls that do not fit the periodic axes or the particles, and periodic axes without room for two cutoffs.
pub fn room(case: &Case, scene: &Scene) -> Result<(), Problem> {
    for (i, body) in scene.bodies.iter().enumerate() {
        if let Some((key, value, allowed)) = scene.misfit(&body.shape) {
            return Err(Problem::new(format!("bodies.{i}.shape.{key}"), value, allowed));
        }
    }
    let radii = || scene.particles.iter().map(|particle| particle.radius);
    let cutoff = 2.0 * radii().fold(0.0, f64::max) + SKIN * radii().fold(f64::INFINITY, f64::min);
    match Domain::new(&scene.domain).too_short(cutoff) {
        Some(axis) => {
            let allowed = format!(
                "the periodic axis {} is {:e} m long, at least two cutoffs, {:e} m, are needed",
                AXES[axis],
                scene.domain.max[axis] - scene.domain.min[axis],
                2.0 * cutoff
            );
            Err(Problem::new(format!("domain.max.{axis}"), format!("{:?}", case.domain.max[axis]), allowed))
        }
        None => Ok(()),
    }
}

/// Refuses temperatures at which the law or a radius vanishes.
pub fn heat(case: &Case, scene: &Scene, laws: &Specification) -> Result<(), Problem> {
    let stages = case.stages.iter().enumerate();
    let actions = stages.flat_map(|(i, stage)| stage.actions.iter().enumerate().map(move |(j, action)| (i, j, action)));
    let ramps = actions.filter_map(|(i, j, action)| match action {
        Action::RampTemperature { to, .. } => Some((format!("stages.{i}.actions.{j}.to"), to.si())),
        _ => None,
    });
    let start = case.temperature.map(|temperature| ("temperature".to_owned(), temperature.si()));
    for (key, temperature) in start.into_iter().chain(ramps) {
        let value = || format!("{temperature} K");
        if let Normal::LudingSintering(law) = laws.normal
            && law.softened(temperature) <= 0.0
        {
            let most = law.melting_temperature + 18.0 * law.melting_range;
            return Err(Problem::new(key, value(), format!("k1(T) is 0 there: at most {most} K")));
        }
        let expansions = scene.materials.iter().filter_map(|material| material.expansion);
        if expansions.into_iter().any(|expansion| expansion.factor(temperature) <= 0.0) {
            return Err(Problem::new(key, value(), "thermal expansion leaves no radius there"));
        }
    }
    Ok(())
}

impl Scene {
    /// Checks what the engine takes for granted.
    ///
    /// # Errors
    /// The scene is of another version, or an index, a number or a pair is not what a run needs.
    pub fn check(&self) -> Result<(), Error> {
        self.problem().map_or(Ok(()), |reason| Err(Error::Scene { scene: self.name(), reason }))
    }

    fn problem(&self) -> Option<String> {
        if self.schema != SCHEMA {
            return Some(format!("schema = {}: this build reads schema {SCHEMA}", self.schema));
        }
        if !(self.time_step.is_normal() && self.time_step > 0.0) {
            return Some(format!("time_step = {} s: must be positive", self.time_step));
        }
        if self.steps as f64 > MOST_STEPS {
            return Some(format!("steps = {}: at most {MOST_STEPS:e}", self.steps));
        }
        if self.output_every == 0 {
            return Some("output_every = 0: at least 1".to_owned());
        }
        let laws = match self.model.specification(&self.mirror) {
            Ok(laws) => laws,
            Err(problem) => return Some(problem.to_string()),
        };
        let cylinders = self.bodies.iter().any(|body| matches!(body.shape, SceneShape::Cylinder { .. }));
        if let Err(problem) = self.mirror.check(cylinders) {
            return Some(problem.to_string());
        }
        self.indices()
            .or_else(|| self.staged())
            .or_else(|| self.numbers(&laws))
            .or_else(|| self.paths())
            .or_else(|| self.values(&laws))
            .or_else(|| self.missing_pair())
    }

    fn indices(&self) -> Option<String> {
        let count = self.materials.len();
        let sides = |(i, between): (usize, [usize; 2])| between.map(|at| (format!("pairs.{i}.between"), at));
        let pairs = self.pairs.iter().map(|pair| pair.between).enumerate().flat_map(sides);
        let bodies = self.bodies.iter().enumerate().map(|(i, body)| (format!("bodies.{i}.material"), body.material));
        let particles = self.particles.iter().enumerate();
        let particles = particles.map(|(i, particle)| (format!("particles.{i}.material"), particle.material));
        let (key, at) = pairs.chain(bodies).chain(particles).find(|(_, at)| *at >= count)?;
        Some(format!("{key} = {at}: there are {count} materials, counted from 0"))
    }

    /// Stages last as long as the run, in whole samples, and change what is there.
    fn staged(&self) -> Option<String> {
        if self.stages.is_empty() {
            return None;
        }
        let steps = self.stages.iter().map(|stage| stage.steps).sum::<u64>();
        if steps != self.steps {
            return Some(format!("stages: {steps} steps, the run has {}", self.steps));
        }
        for (i, stage) in self.stages.iter().enumerate() {
            let every = stage.output_every.unwrap_or(self.output_every);
            if stage.steps == 0 || every == 0 || !stage.steps.is_multiple_of(every) {
                return Some(format!("stages.{i}.steps = {}: a multiple of output_every = {every}", stage.steps));
            }
            for (j, action) in stage.actions.iter().enumerate() {
                let key = format!("stages.{i}.actions.{j}");
                match action {
                    SceneAction::SetMotion { body, .. }
                    | SceneAction::Remove { body }
                    | SceneAction::Strain { body, .. }
                        if *body >= self.bodies.len() =>
                    {
                        return Some(format!("{key}.body = {body}: there are {} bodies", self.bodies.len()));
                    }
                    SceneAction::SetPair { pair } if self.pair(pair.between[0], pair.between[1]).is_none() => {
                        return Some(format!("{key}.pair.between = {:?}: the scene states no such pair", pair.between));
                    }
                    _ => {}
                }
            }
        }
        None
    }

    fn numbers(&self, laws: &Specification) -> Option<String> {
        let positive = |value: f64| value.is_normal() && value > 0.0;
        for (i, pair) in self.pairs.iter().enumerate() {
            if laws.asks().effective_young && !positive(pair.effective_young) {
                return Some(format!("pairs.{i}.effective_young = {} Pa: must be positive", pair.effective_young));
            }
            if pair.damping_ratio < 0.0 {
                return Some(format!("pairs.{i}.damping_ratio = {}: must not be negative", pair.damping_ratio));
            }
        }
        for (i, body) in self.bodies.iter().enumerate() {
            let (key, direction) = match &body.shape {
                SceneShape::Plane { normal, .. } => ("normal", normal),
                SceneShape::Cylinder { axis, .. } => ("axis", axis),
            };
            if (Vector::from(*direction).norm() - 1.0).abs() > 1e-9 {
                return Some(format!("bodies.{i}.shape.{key} = {direction:?}: must have the length 1"));
            }
            if let Some((key, value, allowed)) = self.misfit(&body.shape) {
                return Some(format!("bodies.{i}.shape.{key} = {value}: {allowed}"));
            }
        }
        let mut places = HashSet::new();
        for (i, particle) in self.particles.iter().enumerate() {
            let values = [
                ("radius", particle.radius, "m"),
                ("mass", particle.mass, "kg"),
                ("moment_of_inertia", particle.moment_of_inertia, "kg m2"),
            ];
            if let Some((name, value, unit)) = values.into_iter().find(|(_, value, _)| !positive(*value)) {
                return Some(format!("particles.{i}.{name} = {value} {unit}: must be positive"));
            }
            // `+ 0.0` makes one zero of two.
            if !places.insert(particle.position.map(|coordinate| (coordinate + 0.0).to_bits())) {
                return Some(format!("particles.{i}.position = {:?}: another particle is there", particle.position));
            }
        }
        None
    }

    /// Every driven particle has one path, which lasts as long as the run.
    fn paths(&self) -> Option<String> {
        let mut seen = HashSet::new();
        for (i, drive) in self.drives.iter().enumerate() {
            if drive.particle >= self.particles.len() || !seen.insert(drive.particle) {
                let count = self.particles.len();
                return Some(format!("drives.{i}.particle = {}: one of {count} particles, each once", drive.particle));
            }
            let steps = drive.legs.iter().map(|leg| leg.steps).sum::<u64>();
            if steps != self.steps {
                return Some(format!("drives.{i}.legs: {steps} steps, the run has {}", self.steps));
            }
        }
        None
    }

    /// What is wrong with a wall in this box and among these particles: key of the shape, value, what is allowed. Along
    /// a periodic axis a wall must be the same everywhere.
    fn misfit(&self, shape: &SceneShape) -> Option<(&'static str, String, String)> {
        let periodic = |axis: usize| self.domain.boundary[axis] == Boundary::Periodic;
        match shape {
            SceneShape::Plane { normal, .. } => {
                let axis = (0..3).find(|axis| periodic(*axis) && normal[*axis] != 0.0)?;
                let allowed = format!("has a component along {}, along which the box is periodic", AXES[axis]);
                Some(("normal", format!("{normal:?}"), allowed))
            }
            SceneShape::Cylinder { axis: direction, radius, .. } => {
                let across = |axis: usize| (0..3).any(|other| other != axis && direction[other] != 0.0);
                if let Some(axis) = (0..3).find(|axis| periodic(*axis) && across(*axis)) {
                    let allowed = format!("the box is periodic along {}: only an axis along it fits", AXES[axis]);
                    return Some(("axis", format!("{direction:?}"), allowed));
                }
                let largest = self.particles.iter().map(|particle| particle.radius).fold(0.0, f64::max);
                let allowed = format!("must be above the largest radius of the particles, {largest:e} m");
                let too_narrow = radius.is_nan() || *radius <= largest;
                too_narrow.then(|| ("radius", format!("{radius:e} m"), allowed))
            }
        }
    }

    /// Values that the laws ask of every pair.
    fn values(&self, laws: &Specification) -> Option<String> {
        let asked = laws.asks();
        let set = self.stages.iter().flat_map(|stage| &stage.actions).filter_map(|action| match action {
            SceneAction::SetPair { pair } => Some(pair),
            _ => None,
        });
        for (i, pair) in self.pairs.iter().chain(set).enumerate() {
            let given = [
                ("effective_shear", asked.effective_shear, pair.effective_shear),
                ("friction", asked.friction, pair.friction),
                ("rolling_friction", asked.rolling_friction, pair.rolling_friction),
                ("twisting_friction", asked.twisting_friction, pair.twisting_friction),
                ("work_of_adhesion", asked.work_of_adhesion, pair.work_of_adhesion),
            ];
            for (name, asked, value) in given {
                match value {
                    None if asked => return Some(format!("pairs.{i}.{name} = nothing: the laws of the model need it")),
                    Some(value) if !(value >= 0.0 && value.is_finite()) => {
                        return Some(format!("pairs.{i}.{name} = {value}: must not be negative"));
                    }
                    _ => {}
                }
            }
        }
        None
    }

    /// A contact without a pair would have no force.
    fn missing_pair(&self) -> Option<String> {
        let mut counts = vec![0u64; self.materials.len()];
        for particle in &self.particles {
            counts[particle.material] += 1;
        }
        let present = || counts.iter().enumerate().filter(|(_, count)| **count > 0);
        for (first, count) in present() {
            let partners = present().map(|(second, _)| second).filter(|second| *second != first || *count > 1);
            let mut partners = partners.chain(self.bodies.iter().map(|body| body.material));
            if let Some(second) = partners.find(|second| self.pair(first, *second).is_none()) {
                let (first, second) = (&self.materials[first].name, &self.materials[second].name);
                return Some(format!(
                    "pairs: nothing between {first} and {second}, which can touch; every such pair is stated"
                ));
            }
        }
        None
    }
}

//! Stages with their actions, and what is measured in them.

use std::collections::HashSet;

use super::{Checker, is_name};
use crate::case::model::NormalLaw;
use crate::case::protocol::{Action, Course, End, HeatTarget};
use crate::case::quantity::Duration;

impl Checker<'_> {
    pub(super) fn stages(&mut self) {
        let case = self.case;
        if case.stages.is_empty() {
            self.add("stages", "[]", "a case has at least one stage");
        }
        self.distinct("stages", case.stages.iter().map(|stage| &stage.name));
        for (i, stage) in case.stages.iter().enumerate() {
            self.end(&format!("stages.{i}.end"), &stage.end);
            if let Some(output) = &stage.output {
                self.every(format!("stages.{i}.output.every"), output.every);
            }
            self.one_drive_each(i, &stage.actions);
            let timed = matches!(stage.end, End::Duration { .. } | End::Contacts { .. });
            for (j, action) in stage.actions.iter().enumerate() {
                self.action(&format!("stages.{i}.actions.{j}"), action);
                let over = match action {
                    Action::Strain { .. } => "strain",
                    Action::RampTemperature { .. } => "ramp_temperature",
                    Action::RampLoad { .. } => "ramp_load",
                    _ => continue,
                };
                if !timed {
                    let allowed =
                        "lasts the whole stage, so that the stage ends by time: end = { kind = \"duration\" }";
                    self.add(format!("stages.{i}.actions.{j}.do"), over, allowed);
                }
            }
        }
        self.temperatures();
    }

    fn one_drive_each(&mut self, stage: usize, actions: &[Action]) {
        let mut seen = HashSet::new();
        for (j, action) in actions.iter().enumerate() {
            if let Action::Drive { particle, .. } = action
                && !seen.insert(particle)
            {
                let key = format!("stages.{stage}.actions.{j}.particle");
                self.add(key, particle, "another action of this stage drives it; a particle has one path");
            }
        }
    }

    fn end(&mut self, at: &str, end: &End) {
        let at_most = |check: &mut Self, value: Duration| check.positive(format!("{at}.at_most"), value);
        match end {
            End::Duration { value } => self.positive(format!("{at}.value"), *value),
            End::Contacts { value } => {
                self.number(format!("{at}.value"), *value, |value| value > 0.0, "must be positive");
            }
            End::AtRest { kinetic_energy, at_most: limit } => {
                let key = format!("{at}.kinetic_energy");
                self.number(&key, *kinetic_energy, |value| value > 0.0, "must be positive");
                if self.case.gravity.iter().all(|component| component.si() == 0.0) {
                    self.add(key, kinetic_energy.get(), "its unit m g d needs gravity; kind = \"balanced\" needs none");
                }
                at_most(self, *limit);
            }
            End::Balanced { ratio, at_most: limit } => {
                self.number(format!("{at}.ratio"), *ratio, |value| value > 0.0, "must be positive");
                at_most(self, *limit);
            }
            End::Load { body, load, at_most: limit, .. } => {
                self.known_body(format!("{at}.body"), body);
                self.load(&format!("{at}.load"), load);
                at_most(self, *limit);
            }
        }
    }

    fn action(&mut self, at: &str, action: &Action) {
        match action {
            Action::SetPair { between, values } => {
                self.between(&format!("{at}.between"), between);
                self.pair_values(&format!("{at}.values"), values);
            }
            Action::SetMotion { body, motion } => {
                self.known_body(format!("{at}.body"), body);
                self.motion(&format!("{at}.motion"), motion);
            }
            Action::Remove { body } => self.known_body(format!("{at}.body"), body),
            Action::Strain { body, from, strain } => {
                self.known_body(format!("{at}.body"), body);
                self.known_body(format!("{at}.from"), from);
                self.number(format!("{at}.strain"), *strain, |value| value < 1.0, "must be below 1");
            }
            Action::RampTemperature { target, to } => {
                if let HeatTarget::Body { name } = target {
                    self.known_body(format!("{at}.target.name"), name);
                }
                self.positive(format!("{at}.to"), *to);
            }
            Action::RampLoad { body, to } => {
                self.known_body(format!("{at}.body"), body);
                self.load(&format!("{at}.to"), to);
            }
            Action::SetRelaxationTime { value } => self.positive(format!("{at}.value"), *value),
            Action::SetGravity { .. } => {}
            Action::SetDrag { rate } => self.not_negative(format!("{at}.rate"), *rate),
            Action::Deposit { particles } => self.source(&format!("{at}.particles"), particles),
            Action::Drive { particle, course, .. } => {
                let stated = self.case.particles.len();
                if !self.case.particles.iter().any(crate::case::source::ParticleSource::makes_many)
                    && *particle as usize >= stated
                {
                    self.add(format!("{at}.particle"), particle, format!("the case states {stated} particles, from 0"));
                }
                if let Course::Sinusoid { frequency } = course {
                    self.positive(format!("{at}.course.frequency"), *frequency);
                }
            }
        }
    }

    /// A temperature of the start is stated where something asks for it.
    fn temperatures(&mut self) {
        let case = self.case;
        if let Some(temperature) = case.temperature {
            self.positive("temperature", temperature);
            let expansions = case.materials.iter().filter_map(crate::case::scene::expansion);
            if expansions.into_iter().any(|expansion| expansion.factor(temperature.si()) <= 0.0) {
                let value = format!("{} K", temperature.si());
                self.add("temperature", value, "thermal expansion leaves no radius there");
            }
        }
        let heated =
            |action: &Action| matches!(action, Action::RampTemperature { target: HeatTarget::Particles {}, .. });
        let asked = case.model.heat.is_some()
            || matches!(case.model.normal, NormalLaw::LudingSintering { .. })
            || case.stages.iter().flat_map(|stage| &stage.actions).any(heated);
        match (&case.start_from, case.temperature) {
            (None, None) if asked => {
                self.add("temperature", "nothing", "the model or a stage needs it: a temperature in K");
            }
            (Some(_), Some(temperature)) => {
                self.add("temperature", format!("{temperature:?}"), "a case with start_from takes it from there");
            }
            _ => {}
        }
    }

    pub(super) fn observables(&mut self) {
        let case = self.case;
        let stages: Vec<_> = case.stages.iter().map(|stage| stage.name.as_str()).collect();
        let bodies: Vec<_> = case.bodies.iter().map(|body| body.name.as_str()).collect();
        for (i, observable) in case.observables.iter().enumerate() {
            let key = |name: &str| format!("observables.{i}.{name}");
            self.known(key("stage"), &observable.stage, "stage", &stages);
            let allowed = |value| (0.0..=1.0).contains(&value);
            self.number(key("average"), observable.average, allowed, "a share of the stage, in [0, 1]");
            self.problems.extend(observable.measure.problems(&key("measure"), &bodies));
            if let Some(other) = &observable.minus {
                let before: Vec<_> = case.observables[..i].iter().map(|one| one.name.as_str()).collect();
                self.known(key("minus"), other, "observable before this one", &before);
            }
        }
        self.distinct("observables", case.observables.iter().map(|observable| &observable.name));
        let names: Vec<_> = case.observables.iter().map(|observable| observable.name.as_str()).collect();
        for (i, gate) in case.gates.iter().enumerate() {
            if gate.check.of_ensemble() {
                self.known(format!("gates.{i}.quantity"), &gate.quantity, "observable in this case", &names);
            } else if !is_name(&gate.quantity, "-_") {
                self.add(format!("gates.{i}.quantity"), &gate.quantity, "a name has letters, digits, `-` and `_`");
            }
        }
    }
}

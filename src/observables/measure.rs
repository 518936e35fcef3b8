//! Measures the record of any code: observables over samples, and their means over the end of a stage.

use std::ops::Range;

use rayon::prelude::*;
use serde::Deserialize;

use super::sample::{Contacts, Row, Sample, State};
use super::system::System;
use super::{coordination, forces, motion, packing, stress, walls};
use crate::case::measure::{Measure, Observable};
use crate::error::Error;

/// The contacts of all samples in one row.
#[derive(Clone, Copy, Debug)]
pub struct ContactColumns<'a> {
    /// Where the contacts of each sample begin, and the end of the last (T + 1).
    pub start: &'a [usize],
    /// Indices (M, 2) of the first particle and of the second, or N + the index of the body.
    pub pair: &'a [[u32; 2]],
    /// Force on the first (M, 3) [N].
    pub force: &'a [Row],
}

/// Columns of a record, sample after sample.
#[derive(Clone, Copy, Debug, Default)]
pub struct Columns<'a> {
    /// Times (T) [s].
    pub time: &'a [f64],
    /// Centres (T, N, 3), also outside the box [m].
    pub position: &'a [Row],
    /// Velocities (T, N, 3) [m/s].
    pub velocity: Option<&'a [Row]>,
    /// Angular velocities (T, N, 3) [rad/s].
    pub angular_velocity: Option<&'a [Row]>,
    /// Sums of contact forces on the particles (T, N, 3) [N].
    pub force: Option<&'a [Row]>,
    /// Forces of the particles on the bodies (T, B, 3) [N].
    pub body_force: Option<&'a [Row]>,
    /// Points of the bodies (T, B, 3), where they move [m].
    pub body_point: Option<&'a [Row]>,
    /// Radii (T, N), where they change [m].
    pub radius: Option<&'a [f64]>,
    /// Contacts.
    pub contacts: Option<ContactColumns<'a>>,
}

/// An observable by its name; what a case says about its stage does not matter here.
#[derive(Clone, Debug, Deserialize)]
pub struct Named {
    /// Name.
    pub name: String,
    /// What is measured.
    pub measure: Measure,
}

impl From<&Observable> for Named {
    fn from(observable: &Observable) -> Self {
        Self { name: observable.name.clone(), measure: observable.measure.clone() }
    }
}

/// An observable over the samples of a record.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Name.
    pub name: String,
    /// SI unit, `-` for a number.
    pub unit: &'static str,
    /// How many numbers a sample has; none for one number that is no list.
    pub width: Option<usize>,
    /// Values (T, width).
    pub values: Vec<f64>,
}

impl Series {
    /// Values of one sample.
    #[must_use]
    pub fn row(&self, sample: usize) -> &[f64] {
        let width = self.width.unwrap_or(1);
        self.values.get(sample * width..(sample + 1) * width).unwrap_or_default()
    }

    /// Mean over the last `share` in [0, 1] of the samples of a stage; a share of 0 is its last sample. Values that are not
    /// defined (NaN) make the mean NaN; so does a stage without samples.
    #[must_use]
    pub fn mean(&self, stage: Range<usize>, share: f64) -> Vec<f64> {
        // Rounding of the share does not drop a sample that lies on its beginning.
        const ON: f64 = 1e-9;
        let last = stage.end.saturating_sub(1);
        let span = last.saturating_sub(stage.start) as f64;
        let counts = |sample: &usize| (*sample - stage.start) as f64 >= (1.0 - share) * span - ON;
        let chosen: Vec<_> = stage.clone().filter(counts).collect();
        let mean = |at: usize| {
            let values = chosen.iter().map(|sample| self.row(*sample).get(at).copied().unwrap_or(f64::NAN));
            values.sum::<f64>() / chosen.len() as f64
        };
        (0..self.width.unwrap_or(1)).map(mean).collect()
    }
}

/// Measures every sample of a record. Samples are measured in parallel, each by itself: the number of threads changes no
/// bit.
///
/// # Errors
/// A column has a wrong length, a measure a value that is not allowed, or an observable needs what the record does not have.
pub fn series(observables: &[Named], system: &System, columns: &Columns) -> Result<Vec<Series>, Error> {
    let names = system.body_names();
    for (i, named) in observables.iter().enumerate() {
        let problems = named.measure.problems("measure", &names);
        if let Some(problem) = problems.into_iter().next() {
            return Err(Error::Measure { observable: named.name.clone(), reason: problem.to_string() });
        }
        if observables[..i].iter().any(|other| other.name == named.name) {
            let reason = "another one has this name; names differ".to_owned();
            return Err(Error::Measure { observable: named.name.clone(), reason });
        }
    }
    columns.check(system).map_err(|reason| Error::Columns { reason })?;
    let samples = columns.time.len();
    let states: Vec<_> = (0..samples).map(|at| columns.state(at, system)).collect();
    let measured: Vec<Vec<Vec<f64>>> = (0..samples)
        .into_par_iter()
        .map(|at| {
            let sample = Sample::new(system, states[at]);
            let value = |named: &Named| {
                let measured = match &named.measure {
                    Measure::MomentumChange { samples } => change(system, columns.time, &states, at, *samples),
                    measure => one(measure, &sample),
                };
                measured.map_err(|reason| Error::Measure {
                    observable: named.name.clone(),
                    reason: format!("sample {at}: {reason}"),
                })
            };
            observables.iter().map(value).collect()
        })
        .collect::<Result<_, Error>>()?;
    let column = |(i, named): (usize, &Named)| Series {
        name: named.name.clone(),
        unit: named.measure.unit(),
        width: named.measure.width(),
        values: measured.iter().flat_map(|row| row[i].iter().copied()).collect(),
    };
    Ok(observables.iter().enumerate().map(column).collect())
}

fn change(system: &System, time: &[f64], states: &[State], at: usize, samples: u32) -> Result<Vec<f64>, String> {
    let first = at.saturating_sub(samples as usize);
    if first == at {
        return Ok(vec![0.0]);
    }
    motion::momentum_change(system, &time[first..=at], &states[first..=at]).map(|value| vec![value])
}

/// Measures one sample: one number, or as many as the measure has.
///
/// # Errors
/// The observable needs what the sample does not have.
pub fn one(measure: &Measure, sample: &Sample) -> Result<Vec<f64>, String> {
    let number = match measure {
        Measure::PackingProfile { bins } => return packing::profile(sample, bins),
        Measure::WallStressProfile { body, component, bins } => {
            return walls::stress_profile(sample, body, *component, bins);
        }
        Measure::WallMobilisation { body, direction } => return walls::mobilisation(sample, body, direction),
        Measure::WallMobilisationProfile { body, bins } => return walls::mobilisation_profile(sample, body, bins),
        Measure::NormalForceDistribution { count, up_to } => {
            return forces::distribution(sample, *count as usize, up_to.get());
        }
        Measure::StressTensor { region, part } => return stress::tensor(sample, region, *part),
        Measure::PackingFraction { region, radii } => packing::fraction(sample, region, *radii)?,
        Measure::PackingFractionByCenter { floor } => packing::by_center(sample, floor)?,
        Measure::Coordination { region, bodies } => coordination::coordination(sample, region, *bodies)?,
        Measure::CoordinationWithoutRattlers { region, least_contacts, bodies } => {
            coordination::without_rattlers(sample, region, *least_contacts, *bodies)?
        }
        Measure::RattlerShare { region, least_contacts } => {
            coordination::rattler_share(sample, region, *least_contacts)?
        }
        Measure::WallForce { body, direction } => walls::force(sample, body, direction)?,
        Measure::WallStress { body, direction } => walls::stress(sample, body, direction)?,
        Measure::WallLineStress { body, direction, between } => walls::line_stress(sample, body, direction, between)?,
        Measure::WeightShare { bodies } => walls::weight_share(sample, bodies)?,
        Measure::Distance { between } => walls::distance(sample, between)?,
        Measure::NormalForces { statistic } => forces::normal(sample, *statistic)?,
        Measure::Mobilisation { statistic, contacts } => forces::mobilisation(sample, *statistic, *contacts)?,
        Measure::Overlaps { statistic } => coordination::overlaps(sample, *statistic),
        Measure::KineticEnergy { part } => motion::kinetic_energy(sample, *part)?,
        Measure::MomentumResidual {} => motion::momentum_residual(sample)?,
        Measure::LargestFragment {} => coordination::largest_fragment(sample),
        Measure::MomentumChange { .. } => return Err("it needs a window of samples".to_owned()),
        Measure::Temperature { .. } | Measure::HeatFlow { .. } => {
            return Err("it needs temperatures, which records do not have".to_owned());
        }
    };
    Ok(vec![number])
}

/// The rows of one sample.
fn rows<T>(column: Option<&[T]>, at: usize, length: usize) -> Option<&[T]> {
    column.map(|column| &column[at * length..(at + 1) * length])
}

impl<'a> Columns<'a> {
    /// The columns of one sample; lengths were checked.
    fn state(&self, at: usize, system: &System) -> State<'a> {
        let (particles, bodies) = (system.radius.len(), system.bodies.len());
        let contacts = self.contacts.map(|contacts| {
            let range = contacts.start[at]..contacts.start[at + 1];
            Contacts { pair: &contacts.pair[range.clone()], force: &contacts.force[range] }
        });
        State {
            position: &self.position[at * particles..(at + 1) * particles],
            velocity: rows(self.velocity, at, particles),
            angular_velocity: rows(self.angular_velocity, at, particles),
            force: rows(self.force, at, particles),
            body_force: rows(self.body_force, at, bodies),
            body_point: rows(self.body_point, at, bodies),
            radius: rows(self.radius, at, particles),
            contacts,
        }
    }

    /// Refuses columns of wrong lengths, places that are no numbers, and contacts of what is not there.
    fn check(&self, system: &System) -> Result<(), String> {
        let (samples, particles, bodies) = (self.time.len(), system.radius.len(), system.bodies.len());
        let lengths = [
            ("position", Some(self.position.len()), particles),
            ("velocity", self.velocity.map(<[_]>::len), particles),
            ("angular_velocity", self.angular_velocity.map(<[_]>::len), particles),
            ("force", self.force.map(<[_]>::len), particles),
            ("body_force", self.body_force.map(<[_]>::len), bodies),
            ("body_point", self.body_point.map(<[_]>::len), bodies),
            ("radius", self.radius.map(<[_]>::len), particles),
        ];
        for (name, found, each) in lengths {
            if let Some(found) = found.filter(|found| *found != samples * each) {
                return Err(format!("{name} has {found} rows, expected {samples} samples of {each}"));
            }
        }
        if particles == 0 {
            return Err("radius has no values, expected at least one particle".to_owned());
        }
        if let Some(at) = self.position.iter().position(|row| !row.iter().all(|x| x.is_finite())) {
            let (sample, particle) = (at / particles, at % particles);
            return Err(format!("position of particle {particle} in sample {sample} is not finite"));
        }
        if let Some(at) = self.radius.and_then(|radius| radius.iter().position(|r| !(*r > 0.0 && r.is_finite()))) {
            return Err(format!("radius of particle {} in sample {} is not positive", at % particles, at / particles));
        }
        self.contacts.map_or(Ok(()), |contacts| contacts.check(samples, particles, bodies))
    }
}

impl ContactColumns<'_> {
    fn check(&self, samples: usize, particles: usize, bodies: usize) -> Result<(), String> {
        let rows = self.pair.len();
        if self.force.len() != rows {
            return Err(format!("contact_force has {} rows, expected {rows} as in contact_pair", self.force.len()));
        }
        let rises = self.start.windows(2).all(|pair| pair[0] <= pair[1]);
        if self.start.len() != samples + 1
            || !rises
            || self.start.first() != Some(&0)
            || self.start.last() != Some(&rows)
        {
            return Err(format!("contact_start must have {} values that rise from 0 to {rows}", samples + 1));
        }
        let allowed = |[first, second]: &[u32; 2]| {
            let (first, second) = (*first as usize, *second as usize);
            first < particles && second < particles + bodies && first != second
        };
        match self.pair.iter().position(|pair| !allowed(pair)) {
            Some(at) => {
                let [first, second] = self.pair[at];
                Err(format!(
                    "contact_pair.{at} = [{first}, {second}]: the first is one of {particles} particles, the second \
                     another one or {particles} + the index of one of {bodies} bodies"
                ))
            }
            None => Ok(()),
        }
    }
}

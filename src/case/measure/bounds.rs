//! What the values of a measure may be, and what a measure gives: its unit and how many numbers.

use super::{Bins, Measure, Region, Statistic};
use crate::case::quantity::Number;
use crate::error::Problem;

/// Largest number of bins or classes.
const MOST_BINS: f64 = 10_000.0;
/// Share of a bin by which a range may miss a whole number of them.
const WHOLE: f64 = 1e-6;

impl Bins {
    /// Number of bins.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "bounds are checked before")]
    pub fn count(&self) -> usize {
        self.ratio().round().clamp(0.0, MOST_BINS) as usize
    }

    fn ratio(&self) -> f64 {
        (self.to.si() - self.from.si()) / self.width.si()
    }

    /// Boundaries of a bin [m].
    #[must_use]
    pub fn bounds(&self, bin: usize) -> [f64; 2] {
        let edge = |k: usize| {
            let share = k as f64 / self.count() as f64;
            self.from.si() * (1.0 - share) + self.to.si() * share
        };
        [edge(bin), edge(bin + 1)]
    }

    /// The bin of a place [m], if it is in one.
    #[must_use]
    pub fn bin(&self, place: f64) -> Option<usize> {
        let count = self.count();
        if !(self.from.si() <= place && place < self.to.si()) {
            return None;
        }
        // A quotient may be rounded across a boundary: the boundaries themselves decide.
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the place is in the range")]
        let guess = (((place - self.from.si()) / self.width.si()) as usize).min(count - 1);
        let near = guess.saturating_sub(1)..(guess + 2).min(count);
        near.into_iter().find(|bin| self.bounds(*bin)[0] <= place && place < self.bounds(*bin)[1])
    }
}

impl Measure {
    /// SI unit of what it gives, `-` for a number.
    #[must_use]
    pub fn unit(&self) -> &'static str {
        match self {
            Self::WallForce { .. } => "N",
            Self::NormalForces { statistic } if *statistic != Statistic::NegativeShare => "N",
            Self::WallStress { .. } | Self::WallStressProfile { .. } | Self::StressTensor { .. } => "Pa",
            Self::WallLineStress { .. } => "N/m",
            Self::Distance { .. } => "m",
            Self::Temperature { .. } => "K",
            Self::HeatFlow { .. } => "W",
            _ => "-",
        }
    }

    /// How many numbers it gives for a sample; none where it gives one, which is no list.
    #[must_use]
    pub fn width(&self) -> Option<usize> {
        match self {
            Self::PackingProfile { bins }
            | Self::WallStressProfile { bins, .. }
            | Self::WallMobilisationProfile { bins, .. } => Some(bins.count()),
            Self::NormalForceDistribution { count, .. } => Some(*count as usize),
            Self::StressTensor { .. } => Some(9),
            _ => None,
        }
    }

    /// What is not allowed in it: `at` is the path of its key, `bodies` are the names of the bodies.
    #[must_use]
    pub fn problems(&self, at: &str, bodies: &[&str]) -> Vec<Problem> {
        let mut check = Bounds { at, bodies, problems: Vec::new() };
        check.measure(self);
        check.problems
    }
}

struct Bounds<'a> {
    at: &'a str,
    bodies: &'a [&'a str],
    problems: Vec<Problem>,
}

impl Bounds<'_> {
    fn add(&mut self, key: &str, value: impl ToString, allowed: impl Into<String>) {
        self.problems.push(Problem::new(format!("{}.{key}", self.at), value, allowed));
    }

    fn measure(&mut self, measure: &Measure) {
        match measure {
            Measure::PackingFraction { region, .. }
            | Measure::Coordination { region, .. }
            | Measure::StressTensor { region, .. }
            | Measure::Temperature { region } => self.region(region),
            Measure::CoordinationWithoutRattlers { region, least_contacts, .. }
            | Measure::RattlerShare { region, least_contacts } => {
                self.region(region);
                if !(1..=12).contains(least_contacts) {
                    self.add("least_contacts", least_contacts, "from 1 to 12 contacts");
                }
            }
            Measure::PackingFractionByCenter { floor } => self.body("floor", floor),
            Measure::PackingProfile { bins } => self.bins(bins),
            Measure::WallForce { body, direction }
            | Measure::WallStress { body, direction }
            | Measure::WallMobilisation { body, direction } => {
                self.body("body", body);
                self.direction(direction);
            }
            Measure::WallLineStress { body, direction, between } => {
                self.body("body", body);
                self.direction(direction);
                self.two_bodies(between);
            }
            Measure::WallStressProfile { body, bins, .. } | Measure::WallMobilisationProfile { body, bins } => {
                self.body("body", body);
                self.bins(bins);
            }
            Measure::WeightShare { bodies } => {
                if bodies.is_empty() {
                    self.add("bodies", "[]", "at least one body");
                }
                for (i, name) in bodies.iter().enumerate() {
                    self.body(&format!("bodies.{i}"), name);
                    if bodies[..i].contains(name) {
                        self.add(&format!("bodies.{i}"), name, "this body is named already");
                    }
                }
            }
            Measure::Distance { between } => self.two_bodies(between),
            Measure::HeatFlow { body } => self.body("body", body),
            Measure::NormalForceDistribution { count, up_to } => {
                if *count == 0 || f64::from(*count) > MOST_BINS {
                    self.add("count", count, format!("from 1 to {MOST_BINS} classes"));
                }
                if up_to.get() <= 0.0 {
                    self.add("up_to", up_to.get(), "must be positive");
                }
            }
            Measure::MomentumChange { samples } => {
                if *samples == 0 {
                    self.add("samples", samples, "at least 1 interval");
                }
            }
            Measure::NormalForces { .. }
            | Measure::Mobilisation { .. }
            | Measure::Overlaps { .. }
            | Measure::KineticEnergy { .. }
            | Measure::MomentumResidual {}
            | Measure::LargestFragment {} => {}
        }
    }

    fn body(&mut self, key: &str, name: &str) {
        if !self.bodies.contains(&name) {
            let known = if self.bodies.is_empty() { "none".to_owned() } else { self.bodies.join(", ") };
            self.add(key, name, format!("no such body (known: {known})"));
        }
    }

    fn two_bodies(&mut self, names: &[String; 2]) {
        for (side, name) in names.iter().enumerate() {
            self.body(&format!("between.{side}"), name);
        }
        if names[0] == names[1] {
            self.add("between.1", &names[1], "two different bodies");
        }
    }

    fn direction(&mut self, vector: &[Number; 3]) {
        if vector.iter().all(|component| component.get() == 0.0) {
            self.add("direction", "[0, 0, 0]", "a direction is not zero");
        }
    }

    fn bins(&mut self, bins: &Bins) {
        let ratio = bins.ratio();
        if bins.width.si() <= 0.0 {
            self.add("bins.width", format!("{:?}", bins.width), "must be positive");
        } else if bins.to <= bins.from {
            let allowed = format!("must be above {}.bins.from = {:?}", self.at, bins.from);
            self.add("bins.to", format!("{:?}", bins.to), allowed);
        } else if ratio > MOST_BINS {
            self.add(
                "bins.width",
                format!("{:?}", bins.width),
                format!("at most {MOST_BINS} bins between from and to"),
            );
        } else if ratio < 0.5 || (ratio - ratio.round()).abs() > WHOLE {
            let allowed = format!("a whole number of bins between from and to, not {ratio:.6}");
            self.add("bins.width", format!("{:?}", bins.width), allowed);
        }
    }

    fn region(&mut self, region: &Region) {
        match region {
            Region::Everything {} => {}
            Region::Box { min, max } => {
                for axis in 0..3 {
                    if min[axis].si() >= max[axis].si() {
                        let allowed = format!("must be above {}.region.min.{axis} = {:?}", self.at, min[axis]);
                        self.add(&format!("region.max.{axis}"), format!("{:?}", max[axis]), allowed);
                    }
                }
            }
            Region::Bed { floor, above_floor, below_surface } => {
                self.body("region.floor", floor);
                for (key, value) in [("above_floor", above_floor), ("below_surface", below_surface)] {
                    if value.si() < 0.0 {
                        self.add(&format!("region.{key}"), format!("{value:?}"), "must not be negative");
                    }
                }
            }
        }
    }
}

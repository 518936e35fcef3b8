//! Checks that the schema cannot express: ranges, names that must exist, what excludes what.

mod bodies;
mod disks;
mod model;
mod sources;
mod stages;

use std::collections::HashSet;

use super::gate::{Check, Matched};
use super::quantity::{Kind, Number, Quantity};
use super::schema::{Case, SCHEMA, TimeStep};
use super::tag;
use crate::error::Problem;

/// Most variants of one case.
const VARIANTS: usize = 10_000;
/// Most steps between two samples.
const EVERY: u64 = 1_000_000_000;
/// Deepest refinement: a step divided by 4096.
const FINEST: u32 = 12;

/// Checks what must hold before sweeps are applied.
pub fn sweeps(case: &Case) -> Vec<Problem> {
    let mut check = Checker { case, problems: Vec::new() };
    if case.schema != SCHEMA {
        check.add("schema", case.schema, format!("this build reads schema {SCHEMA}"));
    }
    if !is_name(&case.name, "-") {
        check.add("name", &case.name, "a name has letters, digits and `-`");
    }
    let mut variants: usize = 1;
    for (i, axis) in case.vary.iter().enumerate() {
        if axis.points.is_empty() {
            check.add(format!("vary.{i}.points"), "[]", "an axis has at least one point");
        }
        variants = variants.saturating_mul(axis.points.len());
        let mut seen = HashSet::new();
        for (j, point) in axis.points.iter().enumerate() {
            let key = format!("vary.{i}.points.{j}.label");
            if !is_name(&point.label, "-_.=") {
                check.add(&key, &point.label, "a label has letters, digits and `-`, `_`, `.`, `=`");
            }
            if !seen.insert(&point.label) {
                check.add(&key, &point.label, "another point of this axis has this label; labels of one axis differ");
            }
            if let Some(set) = point.set.keys().find(|set| set.split('.').next() == Some("vary")) {
                check.add(format!("vary.{i}.points.{j}.set"), set, "a sweep cannot set a sweep");
            }
        }
    }
    if variants > VARIANTS {
        check.add("vary", format!("{variants} variants"), format!("at most {VARIANTS} variants"));
    }
    check.problems
}

/// Checks one variant.
pub fn case(case: &Case) -> Vec<Problem> {
    let mut check = Checker { case, problems: Vec::new() };
    check.domain();
    check.model();
    check.materials();
    check.pairs();
    check.bodies();
    check.disks();
    check.sources();
    check.missing_pairs();
    check.time();
    check.stages();
    check.gates();
    check.observables();
    check.ensemble();
    check.problems
}

fn is_name(text: &str, extra: &str) -> bool {
    !text.is_empty() && text.chars().all(|c| c.is_ascii_alphanumeric() || extra.contains(c))
}

/// A case and the problems found in it so far.
struct Checker<'a> {
    case: &'a Case,
    problems: Vec<Problem>,
}

impl Checker<'_> {
    fn add(&mut self, key: impl Into<String>, value: impl ToString, allowed: impl Into<String>) {
        self.problems.push(Problem::new(key, value, allowed));
    }

    fn distinct<'a>(&mut self, key: &str, names: impl Iterator<Item = &'a String>) {
        let mut seen = HashSet::new();
        for (i, name) in names.enumerate() {
            let key = format!("{key}.{i}.name");
            if !is_name(name, "-_") {
                self.add(&key, name, "a name has letters, digits, `-` and `_`");
            }
            if !seen.insert(name) {
                self.add(&key, name, "another one has this name; names differ");
            }
        }
    }

    /// Whether `name` is one of the `known` ones.
    fn known(&mut self, key: impl Into<String>, name: &str, what: &str, known: &[&str]) -> bool {
        let found = known.contains(&name);
        if !found {
            let known = if known.is_empty() { "none".to_owned() } else { known.join(", ") };
            self.add(key, name, format!("no such {what} (known: {known})"));
        }
        found
    }

    fn known_material(&mut self, key: impl Into<String>, name: &str) -> bool {
        let names: Vec<_> = self.case.materials.iter().map(|material| material.name.as_str()).collect();
        self.known(key, name, "material", &names)
    }

    fn known_body(&mut self, key: impl Into<String>, name: &str) {
        let names: Vec<_> = self.case.bodies.iter().map(|body| body.name.as_str()).collect();
        self.known(key, name, "body", &names);
    }

    fn is_rigid(&self, name: &str) -> bool {
        self.case.materials.iter().any(|material| material.name == name && material.rigid)
    }

    fn positive<K: Kind>(&mut self, key: impl Into<String>, value: Quantity<K>) {
        if value.si() <= 0.0 {
            self.add(key, format!("{value:?}"), "must be positive");
        }
    }

    fn not_negative<K: Kind>(&mut self, key: impl Into<String>, value: Quantity<K>) {
        if value.si() < 0.0 {
            self.add(key, format!("{value:?}"), "must not be negative");
        }
    }

    fn number(&mut self, key: impl Into<String>, value: Number, allowed: impl Fn(f64) -> bool, text: &str) {
        if !allowed(value.get()) {
            self.add(key, value.get(), text);
        }
    }

    fn direction(&mut self, key: impl Into<String>, vector: &[Number; 3]) {
        if vector.iter().all(|component| component.get() == 0.0) {
            self.add(key, "[0, 0, 0]", "a direction is not zero");
        }
    }

    /// Lower and upper corner of a box.
    fn corners<K: Kind>(&mut self, keys: [&str; 2], min: &[Quantity<K>; 3], max: &[Quantity<K>; 3]) {
        for axis in 0..3 {
            if min[axis].si() >= max[axis].si() {
                let allowed = format!("must be above {}.{axis} = {:?}", keys[0], min[axis]);
                self.add(format!("{}.{axis}", keys[1]), format!("{:?}", max[axis]), allowed);
            }
        }
    }

    fn domain(&mut self) {
        let domain = &self.case.domain;
        self.corners(["domain.min", "domain.max"], &domain.min, &domain.max);
    }

    fn time(&mut self) {
        match &self.case.time.step {
            TimeStep::Fixed { value } => self.positive("time.step.value", *value),
            TimeStep::ContactFraction { steps_per_contact } if *steps_per_contact < 10 => {
                self.add("time.step.steps_per_contact", steps_per_contact, "at least 10 steps per contact");
            }
            TimeStep::RayleighFraction { fraction } => {
                let allowed = |value| value > 0.0 && value <= 1.0;
                self.number("time.step.fraction", *fraction, allowed, "a fraction lies in (0, 1]");
            }
            TimeStep::ContactFraction { .. } => {}
        }
        if self.case.time.refinements > 6 {
            self.add("time.refinements", self.case.time.refinements, "at most 6 refinements");
        }
        if let Some(finest) = self.case.time.finest
            && !(self.case.time.refinements + 3..=FINEST).contains(&finest)
        {
            self.add("time.finest", finest, format!("above time.refinements + 2, and at most {FINEST}"));
        }
        self.every("output.every", self.case.output.every);
    }

    fn every(&mut self, key: impl Into<String>, every: u64) {
        if every == 0 || every > EVERY {
            self.add(key, every, format!("from 1 to {EVERY} steps"));
        }
    }

    fn gates(&mut self) {
        let case = self.case;
        for (i, gate) in case.gates.iter().enumerate() {
            let key = |name: &str| format!("gates.{i}.{name}");
            self.number(key("bound"), gate.bound, |value| value > 0.0, "must be positive");
            let fine = matches!(gate.check, Check::Finest | Check::Extrapolated);
            let matched = gate.check == Check::Matched;
            match (fine || matched || gate.check == Check::Reference, &gate.reference) {
                (true, None) => {
                    self.add(key("reference"), "nothing", "this check names a closed form of reference/analytic");
                }
                (false, Some(name)) => {
                    self.add(
                        key("reference"),
                        name,
                        "only the checks reference, finest, extrapolated and matched name a closed form",
                    );
                }
                _ => {}
            }
            match &gate.matched {
                None if matched => {
                    self.add(
                        key("matched"),
                        "nothing",
                        "check = \"matched\" states two codes, each at a point of a sweep",
                    );
                }
                Some(_) if !matched => {
                    self.add(key("matched"), "two codes", "only check = \"matched\" states them");
                }
                Some(sides) => self.matched(&key("matched"), sides),
                None => {}
            }
            match (gate.check == Check::Convergence, gate.order) {
                (true, None) => {
                    self.add(key("order"), "nothing", "check = \"convergence\" states the interval of the order");
                }
                (false, Some(order)) => {
                    let order = format!("{:?}", order.map(Number::get));
                    self.add(key("order"), order, "only check = \"convergence\" states an order");
                }
                (true, Some([low, high])) if low > high => {
                    self.add(key("order"), format!("[{}, {}]", low.get(), high.get()), "an interval rises");
                }
                _ => {}
            }
            if gate.check == Check::Convergence && case.time.refinements == 0 {
                self.add("time.refinements", 0, "a gate with check = \"convergence\" needs at least 1 refinement");
            }
            if fine && case.time.finest.is_none() {
                self.add("time.finest", "nothing", "gates with the checks finest and extrapolated need it");
            }
            if gate.check.of_ensemble() != case.gates[0].check.of_ensemble() {
                let allowed =
                    "the gates of a case judge either ensembles, whose trajectories are not kept, or single runs";
                self.add(key("check"), tag(gate, "check"), allowed);
            }
            if gate.check.of_ensemble() && case.ensemble.is_none() {
                self.add(key("check"), tag(gate, "check"), "it judges an ensemble: the case states [ensemble]");
            }
        }
    }

    /// Sides of a matched pair name codes and points that there are.
    fn matched(&mut self, at: &str, sides: &Matched) {
        let labels: Vec<_> =
            self.case.vary.iter().flat_map(|axis| &axis.points).map(|point| point.label.as_str()).collect();
        for (name, side) in [("left", &sides.left), ("right", &sides.right)] {
            self.known(format!("{at}.{name}.code"), &side.code, "code", &["liggghts", "yade", "lammps"]);
            self.known(format!("{at}.{name}.point"), &side.point, "point of a sweep", &labels);
        }
    }

    fn ensemble(&mut self) {
        let Some(ensemble) = &self.case.ensemble else { return };
        let mut seen = HashSet::new();
        if ensemble.seeds.is_empty() {
            self.add("ensemble.seeds", "[]", "an ensemble has at least one seed");
        }
        for (i, seed) in ensemble.seeds.iter().enumerate() {
            if !seen.insert(seed) {
                self.add(format!("ensemble.seeds.{i}"), seed, "seeds differ");
            }
        }
    }
}

//! Checks that the schema cannot express: ranges, names that must exist, what excludes what.

use std::collections::HashSet;

use super::model::{Damping, NormalLaw};
use super::protocol::{Body, Motion, Shape};
use super::schema::{Case, Check, Domain, Gate, Material, Pair, ParticleSource, SCHEMA, TimeStep};
use crate::error::Problem;

type Problems = Vec<Problem>;

/// Checks what must hold before sweeps are applied.
pub fn sweeps(case: &Case) -> Problems {
    let mut problems = Vec::new();
    if case.schema != SCHEMA {
        problems.push(Problem::new("schema", case.schema, format!("this build reads schema {SCHEMA}")));
    }
    if !is_name(&case.name, "-") {
        problems.push(Problem::new("name", &case.name, "letters, digits and `-`"));
    }
    for (i, axis) in case.vary.iter().enumerate() {
        if axis.points.is_empty() {
            problems.push(Problem::new(format!("vary.{i}.points"), "[]", "at least one point"));
        }
        let mut seen = HashSet::new();
        for (j, point) in axis.points.iter().enumerate() {
            let key = format!("vary.{i}.points.{j}.label");
            if !is_name(&point.label, "-_.=") {
                problems.push(Problem::new(&key, &point.label, "letters, digits and `-`, `_`, `.`, `=`"));
            }
            if !seen.insert(&point.label) {
                problems.push(Problem::new(&key, &point.label, "labels of one axis differ"));
            }
        }
    }
    problems
}

/// Checks one variant.
pub fn case(case: &Case) -> Problems {
    let mut problems = Vec::new();
    domain(&case.domain, &mut problems);
    for (i, material) in case.materials.iter().enumerate() {
        check_material(i, material, &mut problems);
    }
    distinct("materials", case.materials.iter().map(|material| &material.name), &mut problems);
    for (i, pair) in case.pairs.iter().enumerate() {
        check_pair(i, pair, case, &mut problems);
    }
    for (i, body) in case.bodies.iter().enumerate() {
        check_body(i, body, case, &mut problems);
    }
    distinct("bodies", case.bodies.iter().map(|body| &body.name), &mut problems);
    for (i, source) in case.particles.iter().enumerate() {
        particles(i, source, case, &mut problems);
    }
    if case.particles.is_empty() == case.start_from.is_none() {
        problems.push(Problem::new("particles", "[]", "either particles or start_from, not both"));
    }
    missing_pairs(case, &mut problems);
    time(case, &mut problems);
    distinct("stages", case.stages.iter().map(|stage| &stage.name), &mut problems);
    if case.stages.is_empty() {
        problems.push(Problem::new("stages", "[]", "at least one stage"));
    }
    for (i, gate) in case.gates.iter().enumerate() {
        check_gate(i, gate, &mut problems);
    }
    if case.output.every == 0 {
        problems.push(Problem::new("output.every", 0, "at least 1"));
    }
    problems
}

fn is_name(text: &str, extra: &str) -> bool {
    !text.is_empty() && text.chars().all(|c| c.is_ascii_alphanumeric() || extra.contains(c))
}

fn distinct<'a>(key: &str, names: impl Iterator<Item = &'a String>, problems: &mut Problems) {
    let mut seen = HashSet::new();
    for (i, name) in names.enumerate() {
        if !is_name(name, "-_") {
            problems.push(Problem::new(format!("{key}.{i}.name"), name, "letters, digits, `-` and `_`"));
        }
        if !seen.insert(name) {
            problems.push(Problem::new(format!("{key}.{i}.name"), name, "names differ"));
        }
    }
}

fn positive(key: impl Into<String>, value: Option<f64>, unit: &str, problems: &mut Problems) {
    match value {
        Some(value) if value > 0.0 => {}
        Some(value) => problems.push(Problem::new(key, format!("{value} {unit}"), "must be positive")),
        None => problems.push(Problem::new(key, "nothing", "must be given")),
    }
}

fn not_negative(key: String, value: f64, unit: &str, problems: &mut Problems) {
    if value < 0.0 {
        problems.push(Problem::new(key, format!("{value} {unit}"), "must not be negative"));
    }
}

fn domain(domain: &Domain, problems: &mut Problems) {
    for axis in 0..3 {
        let (low, high) = (domain.min[axis].si(), domain.max[axis].si());
        if low >= high {
            problems.push(Problem::new(
                format!("domain.max.{axis}"),
                format!("{high} m"),
                format!("must be above domain.min.{axis} = {low} m"),
            ));
        }
    }
}

fn check_material(i: usize, material: &Material, problems: &mut Problems) {
    let key = |name: &str| format!("materials.{i}.{name}");
    if material.rigid {
        let given = material.young.is_some() || material.poisson.is_some() || material.density.is_some();
        if given {
            problems.push(Problem::new(key("rigid"), true, "a rigid material has no young, poisson or density"));
        }
        return;
    }
    positive(key("young"), material.young.map(super::quantity::Quantity::si), "Pa", problems);
    positive(key("density"), material.density.map(super::quantity::Quantity::si), "kg/m3", problems);
    match material.poisson.map(super::quantity::Number::get) {
        Some(value) if value > -1.0 && value < 0.5 => {}
        Some(value) => problems.push(Problem::new(key("poisson"), value, "must lie between -1 and 0.5")),
        None => problems.push(Problem::new(key("poisson"), "nothing", "must be given")),
    }
}

fn index_of(case: &Case, name: &str) -> Option<usize> {
    case.materials.iter().position(|material| material.name == name)
}

fn known_material(key: String, name: &str, case: &Case, problems: &mut Problems) -> bool {
    let known = index_of(case, name).is_some();
    if !known {
        let names: Vec<_> = case.materials.iter().map(|material| material.name.as_str()).collect();
        problems.push(Problem::new(key, name, format!("no such material (known: {})", names.join(", "))));
    }
    known
}

fn check_pair(i: usize, pair: &Pair, case: &Case, problems: &mut Problems) {
    let mut rigid = 0;
    for (side, name) in pair.between.iter().enumerate() {
        if known_material(format!("pairs.{i}.between.{side}"), name, case, problems) {
            rigid += usize::from(index_of(case, name).is_some_and(|at| case.materials[at].rigid));
        }
    }
    if rigid == 2 {
        problems.push(Problem::new(format!("pairs.{i}.between"), pair.between.join(", "), "two rigid materials have no contact law"));
    }
    let same = |other: &Pair| {
        let [a, b] = &pair.between;
        other.between == [a.clone(), b.clone()] || other.between == [b.clone(), a.clone()]
    };
    if case.pairs[..i].iter().any(same) {
        problems.push(Problem::new(format!("pairs.{i}.between"), pair.between.join(", "), "each pair stands once"));
    }
    let key = |name: &str| format!("pairs.{i}.values.{name}");
    let values = &pair.values;
    match &values.damping {
        Some(Damping::Restitution { value }) if !(0.0..=1.0).contains(&value.get()) => {
            problems.push(Problem::new(key("damping.value"), value.get(), "a restitution lies in [0, 1]"));
        }
        Some(Damping::Ratio { value }) => not_negative(key("damping.value"), value.get(), "", problems),
        None if matches!(case.model.normal, NormalLaw::Hertz { .. }) => {
            problems.push(Problem::new(key("damping"), "nothing", "the law `hertz` needs it: { kind = \"none\" | \"restitution\" | \"ratio\" }"));
        }
        _ => {}
    }
    let coefficients = [
        ("friction", values.friction),
        ("rolling_friction", values.rolling_friction),
        ("twisting_friction", values.twisting_friction),
    ];
    for (name, value) in coefficients {
        not_negative(key(name), value.map_or(0.0, super::quantity::Number::get), "", problems);
    }
    not_negative(key("work_of_adhesion"), values.work_of_adhesion.map_or(0.0, super::quantity::Quantity::si), "J/m2", problems);
}

fn check_body(i: usize, body: &Body, case: &Case, problems: &mut Problems) {
    known_material(format!("bodies.{i}.material"), &body.material, case, problems);
    let direction = |key: &str, vector: &[super::quantity::Number; 3], problems: &mut Problems| {
        if vector.iter().all(|component| component.get() == 0.0) {
            problems.push(Problem::new(format!("bodies.{i}.{key}"), "[0, 0, 0]", "a direction is not zero"));
        }
    };
    match &body.shape {
        Shape::Plane { normal, .. } => direction("shape.normal", normal, problems),
        Shape::Cylinder { axis, radius, .. } => {
            direction("shape.axis", axis, problems);
            positive(format!("bodies.{i}.shape.radius"), Some(radius.si()), "m", problems);
        }
        Shape::Mesh { scale, .. } => positive(format!("bodies.{i}.shape.scale"), Some(scale.si()), "m", problems),
    }
    match &body.motion {
        Motion::Fixed | Motion::Prescribed { .. } => {}
        Motion::Servo { direction: along, mass, .. } | Motion::Sprung { direction: along, mass, .. } => {
            direction("motion.direction", along, problems);
            positive(format!("bodies.{i}.motion.mass"), Some(mass.si()), "kg", problems);
        }
        Motion::Oscillating { direction: along, .. } => direction("motion.direction", along, problems),
    }
}

fn particles(i: usize, source: &ParticleSource, case: &Case, problems: &mut Problems) {
    let (ParticleSource::Single { material, .. }
    | ParticleSource::Random { material, .. }
    | ParticleSource::Lattice { material, .. }
    | ParticleSource::File { material, .. }) = source;
    if known_material(format!("particles.{i}.material"), material, case, problems)
        && index_of(case, material).is_some_and(|at| case.materials[at].rigid)
    {
        problems.push(Problem::new(format!("particles.{i}.material"), material, "a particle has mass: its material is not rigid"));
    }
    if let ParticleSource::Single { radius, position, .. } = source {
        positive(format!("particles.{i}.radius"), Some(radius.si()), "m", problems);
        for (axis, coordinate) in position.iter().enumerate() {
            let (low, high) = (case.domain.min[axis].si(), case.domain.max[axis].si());
            if coordinate.si() < low || coordinate.si() > high {
                problems.push(Problem::new(
                    format!("particles.{i}.position.{axis}"),
                    format!("{} m", coordinate.si()),
                    format!("outside its box, which reaches from {low} m to {high} m"),
                ));
            }
        }
    }
}

/// Every pair that can touch must be stated.
fn missing_pairs(case: &Case, problems: &mut Problems) {
    let mut sources: Vec<(&str, bool)> = Vec::new();
    for source in &case.particles {
        let (name, many) = match source {
            ParticleSource::Single { material, .. } => (material.as_str(), false),
            ParticleSource::Random { material, .. }
            | ParticleSource::Lattice { material, .. }
            | ParticleSource::File { material, .. } => (material.as_str(), true),
        };
        sources.push((name, many));
    }
    let mut touching = Vec::new();
    for (i, (first, many)) in sources.iter().enumerate() {
        if *many {
            touching.push((*first, *first));
        }
        touching.extend(sources[i + 1..].iter().map(|(second, _)| (*first, *second)));
        touching.extend(case.bodies.iter().map(|body| (*first, body.material.as_str())));
    }
    for (a, b) in touching {
        let stated = case.pairs.iter().any(|pair| {
            let [c, d] = &pair.between;
            (c == a && d == b) || (c == b && d == a)
        });
        if !stated {
            problems.push(Problem::new("pairs", format!("no [[pairs]] between {a} and {b}"), "every pair of materials that can touch is stated"));
        }
    }
}

fn time(case: &Case, problems: &mut Problems) {
    match &case.time.step {
        TimeStep::Fixed { value } => positive("time.step.value", Some(value.si()), "s", problems),
        TimeStep::ContactFraction { steps_per_contact } if *steps_per_contact < 10 => {
            problems.push(Problem::new("time.step.steps_per_contact", steps_per_contact, "at least 10"));
        }
        TimeStep::RayleighFraction { fraction } if fraction.get() <= 0.0 || fraction.get() > 1.0 => {
            problems.push(Problem::new("time.step.fraction", fraction.get(), "between 0 and 1"));
        }
        _ => {}
    }
    if case.time.refinements > 6 {
        problems.push(Problem::new("time.refinements", case.time.refinements, "at most 6"));
    }
}

fn check_gate(i: usize, gate: &Gate, problems: &mut Problems) {
    let key = |name: &str| format!("gates.{i}.{name}");
    positive(key("bound"), Some(gate.bound.get()), "", problems);
    if (gate.check == Check::Reference) != gate.reference.is_some() {
        problems.push(Problem::new(key("reference"), format!("{:?}", gate.reference), "a closed form is named if and only if check = \"reference\""));
    }
    if (gate.check == Check::Convergence) != gate.order.is_some() {
        problems.push(Problem::new(key("order"), format!("{:?}", gate.order), "an interval is given if and only if check = \"convergence\""));
    }
}

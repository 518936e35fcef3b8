//! `summary.json`: what a run came to, by name, with value and unit.

use std::collections::BTreeMap;

use serde_json::json;

use crate::case::scene::Scene;
use crate::error::Error;
use crate::observables::measure::{Columns, ContactColumns, Named, series};
use crate::observables::system::System;
use crate::record::{DISSIPATED, Recorder};

/// Observables of a run by name, with value and unit: those that every run has, and those of the case.
///
/// # Errors
/// An observable of the case is not defined for the record.
pub fn summary(scene: &Scene, recorder: &Recorder) -> Result<serde_json::Value, Error> {
    let last = |name| recorder.last(name).unwrap_or_default();
    let largest = |name| recorder.values(name).iter().copied().fold(0.0, |a: f64, b| a.max(b.abs()));
    let balance = |sample: usize| {
        let column = |name| recorder.values(name).get(sample).copied().unwrap_or_default();
        let held = column("energy_kinetic") + column("energy_elastic") + column("energy_gravity");
        DISSIPATED.iter().fold(held, |sum, name| sum + column(name)) - column("energy_body_work")
    };
    let samples = recorder.values("time").len();
    let largest_residual = (0..samples).map(|sample| (balance(sample) - balance(0)).abs()).fold(0.0, f64::max);
    let entered = last("energy_entered");
    let residual = (entered > 0.0).then(|| largest_residual / entered);
    let value = |value: f64, unit: &str| json!({"value": value, "unit": unit});
    let mut found = json!({
        "scene": scene.name(),
        "observables": {
            "time": value(scene.time_step * scene.steps as f64, "s"),
            "steps": value(scene.steps as f64, "-"),
            "largest_force_component": value(largest("force"), "N"),
        },
    });
    if scene.energies {
        let energies = json!({
            "kinetic_energy": value(last("energy_kinetic"), "J"),
            "elastic_energy": value(last("energy_elastic"), "J"),
            "viscous_dissipation": value(last("energy_viscous"), "J"),
            "frictional_dissipation": value(last("energy_frictional"), "J"),
            "rolling_dissipation": value(last("energy_rolling"), "J"),
            "plastic_dissipation": value(last("energy_plastic"), "J"),
            "carried_dissipation": value(last("energy_carried"), "J"),
            "energy_residual": json!({"value": residual, "unit": "-"}),
        });
        if let (Some(into), Some(energies)) = (found["observables"].as_object_mut(), energies.as_object()) {
            into.extend(energies.clone());
        }
    }
    for (name, measured) in measured(scene, recorder)? {
        found["observables"][name] = measured;
    }
    Ok(found)
}

/// The observables of the case: the mean over the last share of the stage, less that of the observable it names.
fn measured(scene: &Scene, recorder: &Recorder) -> Result<BTreeMap<String, serde_json::Value>, Error> {
    let rows = |name: &str| Some(recorder.values(name).as_chunks().0);
    let contacts = recorder.contact_columns();
    let columns = Columns {
        time: recorder.values("time"),
        position: rows("position").unwrap_or_default(),
        velocity: rows("velocity"),
        angular_velocity: rows("angular_velocity"),
        force: rows("force"),
        body_force: rows("body_force"),
        body_point: rows("body_point"),
        radius: Some(recorder.values("radius")).filter(|radius| !radius.is_empty()),
        contacts: contacts.as_ref().map(|(start, pair, force)| ContactColumns { start, pair, force }),
    };
    let mut means: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
    let mut found = BTreeMap::new();
    let (mut first, mut end) = (0, 0);
    for (index, stage) in scene.stages.iter().enumerate() {
        // The sample at which a stage begins belongs to the stage before; the start of the run to the first.
        end += stage.steps;
        let last = recorder.samples_until(end);
        let samples = first..last;
        first = last;
        let asked: Vec<_> = scene.observables.iter().filter(|one| one.stage == stage.name).collect();
        let named: Vec<Named> = asked.iter().map(|one| Named::from(*one)).collect();
        for (one, series) in asked.iter().zip(series(&named, &System::of(&scene.at_stage(index)), &columns)?) {
            let mut mean = series.mean(samples.clone(), one.average.get());
            if let Some(other) = one.minus.as_deref().and_then(|other| means.get(other)) {
                mean.iter_mut().zip(other).for_each(|(value, other)| *value -= other);
            }
            let value = if series.width.is_none() { json!(mean[0]) } else { json!(mean) };
            found.insert(one.name.clone(), json!({"value": value, "unit": series.unit}));
            means.insert(&one.name, mean);
        }
    }
    Ok(found)
}

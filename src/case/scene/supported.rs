//! What this build computes of what the schema can say.

use crate::case::measure::Measure;
use crate::case::protocol::{Action, End, Motion, Shape, Stage};
use crate::case::schema::{Case, Geometry};
use crate::case::source::ParticleSource;
use crate::case::tag;
use crate::error::Problem;

fn refuse(key: impl Into<String>, value: impl ToString, what: &str) -> Result<(), Problem> {
    Err(Problem::new(key, value, format!("this version computes only {what}")))
}

/// Refuses by name what the schema can say and this build does not compute.
pub fn supported(case: &Case) -> Result<(), Problem> {
    if !matches!(case.geometry, Geometry::Spheres {}) {
        return refuse("geometry.kind", tag(&case.geometry, "kind"), "`spheres`");
    }
    heat(case)?;
    if let Some(start) = &case.start_from {
        return refuse("start_from.case", &start.case, "cases that state their particles");
    }
    for (i, source) in case.particles.iter().enumerate() {
        let computed = matches!(
            source,
            ParticleSource::Single { .. } | ParticleSource::Random { .. } | ParticleSource::Lattice { .. }
        );
        if !computed {
            let what = "particles of the kinds `single`, `random` and `lattice`";
            return refuse(format!("particles.{i}.kind"), tag(source, "kind"), what);
        }
    }
    for (i, body) in case.bodies.iter().enumerate() {
        if matches!(body.shape, Shape::Mesh { .. }) {
            let kind = tag(&body.shape, "kind");
            return refuse(format!("bodies.{i}.shape.kind"), kind, "the shapes `plane` and `cylinder`");
        }
        if !matches!(body.motion, Motion::Fixed {} | Motion::Prescribed { .. }) {
            return refuse(
                format!("bodies.{i}.motion.kind"),
                tag(&body.motion, "kind"),
                "`fixed` and `prescribed` bodies",
            );
        }
    }
    stages(&case.stages)?;
    for (i, observable) in case.observables.iter().enumerate() {
        if matches!(
            observable.measure,
            Measure::Temperature { .. } | Measure::HeatFlow { .. } | Measure::WallLineStress { .. }
        ) {
            let kind = tag(&observable.measure, "kind");
            return refuse(format!("observables.{i}.measure.kind"), kind, "measures of spheres without heat");
        }
    }
    Ok(())
}

fn heat(case: &Case) -> Result<(), Problem> {
    match &case.model.heat {
        Some(heat) => refuse("model.heat.law", tag(heat, "law"), "cases without heat"),
        None => Ok(()),
    }
}

fn stages(stages: &[Stage]) -> Result<(), Problem> {
    for (i, stage) in stages.iter().enumerate() {
        for (j, action) in stage.actions.iter().enumerate() {
            match action {
                Action::Drive { .. }
                | Action::SetPair { .. }
                | Action::SetGravity { .. }
                | Action::SetMotion { motion: Motion::Fixed {} | Motion::Prescribed { .. }, .. } => {}
                Action::SetMotion { motion, .. } => {
                    let key = format!("stages.{i}.actions.{j}.motion.kind");
                    return refuse(key, tag(motion, "kind"), "`fixed` and `prescribed` bodies");
                }
                _ => {
                    let key = format!("stages.{i}.actions.{j}.do");
                    let what = "the actions `drive`, `set_gravity`, `set_motion` and `set_pair`";
                    return refuse(key, tag(action, "do"), what);
                }
            }
        }
        if !matches!(stage.end, End::Duration { .. } | End::Contacts { .. }) {
            let kind = tag(&stage.end, "kind");
            return refuse(format!("stages.{i}.end.kind"), kind, "stages that end by `duration` or `contacts`");
        }
        if let Some(output) = &stage.output {
            let key = format!("stages.{i}.output.every");
            return refuse(key, output.every, "cases with one sampling interval, [output]");
        }
    }
    Ok(())
}

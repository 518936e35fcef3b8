//! What this build computes of what the schema can say.

use crate::case::measure::Measure;
use crate::case::protocol::{Action, End, HeatTarget, Load, Motion, Shape, Stage};
use crate::case::schema::Case;
use crate::case::source::ParticleSource;
use crate::case::tag;
use crate::error::Problem;

fn refuse(key: impl Into<String>, value: impl ToString, what: &str) -> Result<(), Problem> {
    Err(Problem::new(key, value, format!("this version computes only {what}")))
}

/// Refuses by name what the schema can say and this build does not compute.
pub fn supported(case: &Case) -> Result<(), Problem> {
    heat(case)?;
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
        motion(&format!("bodies.{i}.motion"), &body.motion)?;
    }
    stages(&case.stages)?;
    for (i, observable) in case.observables.iter().enumerate() {
        if matches!(observable.measure, Measure::Temperature { .. } | Measure::HeatFlow { .. }) {
            let kind = tag(&observable.measure, "kind");
            return refuse(format!("observables.{i}.measure.kind"), kind, "measures without heat");
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

fn motion(key: &str, motion: &Motion) -> Result<(), Problem> {
    match motion {
        Motion::Sprung { .. } => {
            let what = "`fixed`, `prescribed`, `servo` and `oscillating` bodies";
            refuse(format!("{key}.kind"), tag(motion, "kind"), what)
        }
        Motion::Servo { load: Load::Pressure { .. }, .. } => {
            refuse(format!("{key}.load.kind"), "pressure", "loads of the kinds `force` and `line_stress`")
        }
        _ => Ok(()),
    }
}

fn stages(stages: &[Stage]) -> Result<(), Problem> {
    for (i, stage) in stages.iter().enumerate() {
        for (j, action) in stage.actions.iter().enumerate() {
            match action {
                Action::Drive { .. }
                | Action::SetPair { .. }
                | Action::SetGravity { .. }
                | Action::Remove { .. }
                | Action::Strain { .. }
                | Action::RampTemperature { target: HeatTarget::Particles {}, .. }
                | Action::SetRelaxationTime { .. } => {}
                Action::SetMotion { motion: to, .. } => motion(&format!("stages.{i}.actions.{j}.motion"), to)?,
                Action::RampTemperature { .. } => {
                    let key = format!("stages.{i}.actions.{j}.target.kind");
                    return refuse(key, "body", "the temperature of `particles`");
                }
                _ => {
                    let key = format!("stages.{i}.actions.{j}.do");
                    let what = "the actions `drive`, `ramp_temperature`, `remove`, `set_gravity`, `set_motion`, `set_pair`, \
                                `set_relaxation_time` and `strain`";
                    return refuse(key, tag(action, "do"), what);
                }
            }
        }
        if !matches!(stage.end, End::Duration { .. } | End::Contacts { .. }) {
            let kind = tag(&stage.end, "kind");
            return refuse(format!("stages.{i}.end.kind"), kind, "stages that end by `duration` or `contacts`");
        }
    }
    Ok(())
}

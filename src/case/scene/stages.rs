//! The stages of a run: what changes at their beginnings.

use serde::{Deserialize, Serialize};

use super::{Scene, SceneMotion, mixed, si};
use crate::case::model::PairValues;
use crate::case::protocol::Action;
use crate::case::schema::Case;
use crate::material::PairProperties;

/// One stage of a run.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "docs/formats.md describes every field")]
pub struct SceneStage {
    pub name: String,
    pub steps: u64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub output_every: Option<u64>,
    pub actions: Vec<SceneAction>,
}

/// What changes at the beginning of a stage: after the sample of that step, before the next step.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(tag = "do", rename_all = "snake_case", deny_unknown_fields)]
#[expect(missing_docs, reason = "docs/formats.md describes every field")]
pub enum SceneAction {
    SetPair { pair: PairProperties },
    SetMotion { body: usize, motion: SceneMotion },
    SetGravity { value: [f64; 3] },
    Remove { body: usize },
    Strain { body: usize, from: usize, strain: f64 },
    RampTemperature { to: f64 },
    SetRelaxationTime { value: f64 },
}

impl Scene {
    /// The scene with the pairs, motions and gravity that hold in a stage; all else is that of the start.
    #[must_use]
    pub fn at_stage(&self, index: usize) -> Self {
        let mut scene = self.clone();
        for action in self.stages.iter().take(index + 1).flat_map(|stage| &stage.actions) {
            match action {
                SceneAction::SetPair { pair } => {
                    let [first, second] = pair.between;
                    let same = |old: &&mut PairProperties| [[first, second], [second, first]].contains(&old.between);
                    if let Some(old) = scene.pairs.iter_mut().find(same) {
                        *old = *pair;
                    }
                }
                SceneAction::SetMotion { body, motion } => {
                    if let Some(body) = scene.bodies.get_mut(*body) {
                        body.motion = motion.clone();
                    }
                }
                SceneAction::SetGravity { value } => scene.gravity = *value,
                SceneAction::Remove { .. }
                | SceneAction::Strain { .. }
                | SceneAction::RampTemperature { .. }
                | SceneAction::SetRelaxationTime { .. } => {}
            }
        }
        scene
    }
}

/// The stages of a case, `steps` long each. A run of one stage in which nothing is measured needs none; neither do
/// driven particles, whose paths have their own.
pub fn resolve(case: &Case, scene: &Scene, steps: &[u64]) -> Vec<SceneStage> {
    let changes = |action: &Action| !matches!(action, Action::Drive { .. });
    let heated = case.temperature.is_some() || case.start_from.is_some();
    if !heated && case.observables.is_empty() && !case.stages.iter().flat_map(|stage| &stage.actions).any(changes) {
        return Vec::new();
    }
    let mut values: Vec<PairValues> = case.pairs.iter().map(|pair| pair.values.clone()).collect();
    let stages = case.stages.iter().zip(steps).map(|(stage, steps)| SceneStage {
        name: stage.name.clone(),
        steps: *steps,
        output_every: stage.output.as_ref().map(|output| output.every << scene.refinement),
        actions: stage.actions.iter().filter_map(|action| resolved(case, scene, &mut values, action)).collect(),
    });
    stages.collect()
}

/// An action in SI and by index. None for a change of materials that the scene does not have.
fn resolved(case: &Case, scene: &Scene, values: &mut [PairValues], action: &Action) -> Option<SceneAction> {
    let index = |name: &String| scene.bodies.iter().position(|one| one.name == *name);
    match action {
        Action::SetPair { between: [first, second], values: new } => {
            let stated =
                |[one, other]: &[String; 2]| [one, other] == [first, second] || [other, one] == [first, second];
            let at = case.pairs.iter().position(|pair| stated(&pair.between))?;
            values[at].update(new);
            let index = |name: &String| scene.materials.iter().position(|material| material.name == *name);
            let between = [index(first)?, index(second)?];
            Some(SceneAction::SetPair { pair: mixed(&scene.materials, between, &values[at]) })
        }
        Action::SetMotion { body, motion } => {
            Some(SceneAction::SetMotion { body: index(body)?, motion: super::bodies::motion(case, motion) })
        }
        Action::SetGravity { value } => Some(SceneAction::SetGravity { value: si(value) }),
        Action::Remove { body } => Some(SceneAction::Remove { body: index(body)? }),
        Action::Strain { body, from, strain } => {
            Some(SceneAction::Strain { body: index(body)?, from: index(from)?, strain: strain.get() })
        }
        Action::RampTemperature { to, .. } => Some(SceneAction::RampTemperature { to: to.si() }),
        Action::SetRelaxationTime { value } => Some(SceneAction::SetRelaxationTime { value: value.si() }),
        _ => None,
    }
}

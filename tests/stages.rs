//! Stages change pairs, motions and gravity when they begin, and the record keeps the contacts of every sample.

#![allow(clippy::unwrap_used, reason = "tests")]

use std::path::Path;

use crossgrain::case::{self, scene::Scene};
use crossgrain::record::Recorder;
use crossgrain::simulation::{self, Options};

/// A sphere that slides on a floor, whose friction a second stage changes.
fn slider(stages: &str) -> Scene {
    let text = format!(
        r#"schema = 1
name = "slider"
question = "Does a stage change what it says?"
level = "L1"
source = "made for this test"
geometry = {{ kind = "spheres" }}
gravity = [0, 0, "-10 m/s2"]
[domain]
min = ["-1 m", "-1 m", "-1 m"]
max = ["1 m", "1 m", "1 m"]
boundary = ["open", "open", "open"]
[[materials]]
name = "glass"
young = "10 MPa"
poisson = 0.3
density = "2500 kg/m3"
[[pairs]]
between = ["glass", "glass"]
values = {{ damping = {{ kind = "restitution", value = 0.5 }}, friction = 0.25 }}
[model]
normal = {{ law = "hertz", force_cut = "on" }}
tangential = {{ law = "mindlin", history = "default" }}
moments = {{ law = "free" }}
[[bodies]]
name = "floor"
material = "glass"
shape = {{ kind = "plane", point = [0, 0, 0], normal = [0, 0, 1] }}
motion = {{ kind = "fixed" }}
[[particles]]
kind = "single"
material = "glass"
radius = "5 mm"
position = [0, 0, "5 mm"]
velocity = ["1 m/s", 0, 0]
angular_velocity = [0, 0, 0]
[time]
step = {{ kind = "fixed", value = "10 us" }}
{stages}
[output]
every = 100
contacts = true
"#
    );
    case::Stated::parse("slider.toml", &text, &[]).unwrap().load().unwrap().scenes.remove(0)
}

const SETTLE: &str = "[[stages]]\nname = \"settle\"\nend = { kind = \"duration\", value = \"20 ms\" }\n";

fn second(action: &str) -> String {
    let stage = "[[stages]]\nname = \"changed\"\nend = { kind = \"duration\", value = \"20 ms\" }\n";
    format!("{SETTLE}{stage}[[stages.actions]]\n{action}\n")
}

fn run(scene: &Scene) -> Recorder {
    simulation::run(scene, &Options::threads(1), &|_| {}).unwrap()
}

/// Velocity along x over the second stage: first and last sample [m/s].
fn speeds(recorder: &Recorder) -> [f64; 2] {
    let along: Vec<f64> = recorder.values("velocity").iter().copied().step_by(3).collect();
    [along[20], along[40]]
}

#[test]
fn friction_that_is_switched_off_no_longer_brakes() {
    let changed = "do = \"set_pair\"\nbetween = [\"glass\", \"glass\"]\nvalues = { friction = 0 }";
    let [begin, end] = speeds(&run(&slider(&second(changed))));
    let [before, after] = speeds(&run(&slider(&second(
        "do = \"set_pair\"\nbetween = [\"glass\", \"glass\"]\nvalues = { friction = 0.25 }",
    ))));
    assert!((begin - before).abs() < 1e-15, "{begin} {before}: nothing changes before the stage");
    assert!((end - begin).abs() < 1e-6, "{begin} {end}: nothing brakes");
    // mu g t = 0.25 x 10 x 0.02, while it slides.
    assert!((before - after - 0.05).abs() < 2e-3, "{before} {after}");
}

#[test]
fn a_pair_keeps_what_a_stage_does_not_mention() {
    let scene = slider(&second("do = \"set_pair\"\nbetween = [\"glass\", \"glass\"]\nvalues = { friction = 0.1 }"));
    let [before, after] = [scene.at_stage(0), scene.at_stage(1)].map(|scene| scene.pairs[0]);
    assert_eq!((before.friction, after.friction), (Some(0.25), Some(0.1)));
    assert_eq!(before.damping_ratio.to_bits(), after.damping_ratio.to_bits());
}

#[test]
fn a_floor_that_begins_to_move_drags() {
    let dragged =
        "do = \"set_motion\"\nbody = \"floor\"\nmotion = { kind = \"prescribed\", velocity = [\"2 m/s\", 0, 0] }";
    let [begin, end] = speeds(&run(&slider(&second(dragged))));
    assert!((end - begin - 0.05).abs() < 2e-3, "{begin} {end}");
}

#[test]
fn gravity_that_turns_pulls_along() {
    let turned = "do = \"set_gravity\"\nvalue = [\"5 m/s2\", 0, \"-10 m/s2\"]";
    let [begin, end] = speeds(&run(&slider(&second(turned))));
    assert!((end - begin - (5.0 - 2.5) * 0.02).abs() < 2e-3, "{begin} {end}");
}

#[test]
fn recorded_contacts_make_up_the_force_on_every_particle() {
    let recorder = run(&slider(SETTLE));
    let (start, pair, force) = recorder.contact_columns().unwrap();
    assert_eq!(start.len(), 22);
    let total = recorder.values("force").as_chunks::<3>().0;
    for sample in 0..21 {
        let own = start[sample]..start[sample + 1];
        assert!(pair[own.clone()].iter().all(|pair| *pair == [0, 1]), "the floor is the body after the one particle");
        for axis in 0..3 {
            let sum: f64 = force[own.clone()].iter().map(|force| force[axis]).sum();
            assert!((sum - total[sample][axis]).abs() < 1e-15, "sample {sample}");
        }
    }
}

#[test]
fn stages_that_do_not_fit_the_run_are_refused() {
    let mut scene = slider(&second("do = \"set_gravity\"\nvalue = [0, 0, 0]"));
    scene.stages[1].steps += 1;
    let error = simulation::run(&scene, &Options::threads(1), &|_| {}).err().unwrap().to_string();
    assert!(error.contains("stages: 4001 steps, the run has 4000"), "{error}");
}

#[test]
fn the_summary_holds_the_observables_of_the_case() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("summary-of-stages");
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    let case = folder.join("case.toml");
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cross_check/cases/hysteretic_assembly.toml");
    std::fs::copy(path, &case).unwrap();
    let status = std::process::Command::new(env!("CARGO_BIN_EXE_crossgrain"))
        .args(["run", case.to_str().unwrap(), "--variant", "quick", "--set", "ensemble.seeds=[1]"])
        .args(["--set", "particles.0.count=[4, 4, 4]", "--set", "domain.max=[0.042, 0.042, 0.042]"])
        .args(["--set", "stages.0.end.value=\"10 ms\"", "--set", "stages.1.end.value=\"10 ms\""])
        .args(["--out", folder.join("out").to_str().unwrap()])
        .status()
        .unwrap();
    assert!(status.success());
    let text = std::fs::read_to_string(folder.join("out/summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&text).unwrap();
    let coordination = &summary["observables"]["coordination"];
    assert_eq!(coordination["unit"], "-");
    assert!(coordination["value"].as_f64().unwrap() > 0.0);
}

//! Boxes of sintering disks: temperature and radii, servo walls, branches, and the same bits whichever way they are run.

#![allow(clippy::unwrap_used, reason = "tests")]

use std::fs;
use std::path::{Path, PathBuf};

use crossgrain::case;
use crossgrain::case::scene::Scene;
use crossgrain::record::Recorder;
use crossgrain::simulation::{self, Checkpoints, Options};

/// A short protocol with few disks.
const SHORT: [&str; 6] = [
    "particles.0.count=40",
    "stages.0.end.value=0.02 s",
    "stages.1.end.value=2 ms",
    "stages.2.end.value=4 ms",
    "output.every=2000",
    "vary=[]",
];

fn cases() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("cross_check/cases")
}

fn scene(overrides: &[&str]) -> Scene {
    let overrides: Vec<String> = SHORT.iter().chain(overrides).map(|text| (*text).to_owned()).collect();
    let loaded = case::read(&cases().join("sintering_box.toml"), &overrides).unwrap().load().unwrap();
    loaded.scenes[0].clone()
}

fn run(scene: &Scene, options: &Options) -> Recorder {
    simulation::run(scene, options, &|_| {}).unwrap()
}

/// Every number of a record.
fn bits(recorder: Recorder) -> Vec<u64> {
    use crossgrain::record::Values;
    let (_, columns) = recorder.finish();
    let column = |values| match values {
        Values::Real(values) => values.into_iter().map(f64::to_bits).collect::<Vec<_>>(),
        Values::Count(values) => values.into_iter().map(i64::cast_unsigned).collect(),
    };
    columns.into_iter().flat_map(|found| column(found.values)).collect()
}

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

#[test]
fn threads_and_a_stop_in_the_sintering_stage_change_no_bit() {
    let scene = scene(&[]);
    let whole = bits(run(&scene, &Options::threads(1)));
    assert!(whole == bits(run(&scene, &Options::threads(2))));
    let file = folder("stopped-sintering").join("checkpoint.npz");
    // One checkpoint, in the middle of the last stage.
    let sinter = scene.steps - scene.stages[2].steps / 2;
    let checkpoints = Some(Checkpoints { file: file.clone(), steps: Some(sinter), interval: None });
    let options = Options { checkpoints, ..Options::threads(1) };
    assert!(whole == bits(run(&scene, &options)));
    assert!(file.is_file());
    // This run goes on from it.
    assert!(whole == bits(run(&scene, &options)));
}

#[test]
fn radii_and_stiffness_follow_the_temperature() {
    let scene = scene(&[]);
    let record = run(&scene, &Options::threads(1));
    let temperature = record.values("temperature");
    assert!((temperature[0] - 353.15).abs() < 1e-9 && (record.last("temperature").unwrap() - 413.15).abs() < 1e-9);
    let radius = record.values("radius");
    let count = scene.particles.len();
    for (hot, particle) in radius[radius.len() - count..].iter().zip(&scene.particles) {
        assert!((hot / particle.radius - 1.002 / 0.996).abs() < 1e-12);
    }
    let law = record.values("law_state");
    assert!(law[0] > 0.999e5 && law[law.len() - 2] < 0.6e5, "{} {}", law[0], law[law.len() - 2]);
}

#[test]
fn servo_walls_come_to_rest_under_their_load() {
    let scene = scene(&["stages.0.end.value=0.15 s", "output.every=500"]);
    let record = run(&scene, &Options::threads(1));
    let pressed = record.samples_until(scene.stages[0].steps);
    // They swing at some 70 Hz: the mean over the last third of the stage.
    let window = pressed * 2 / 3..pressed;
    let (force, point) = (record.values("body_force"), record.values("body_point"));
    // Bodies are left, bottom, right, top; the length of the right wall is the height of the box.
    let mean = |of: &dyn Fn(usize) -> f64| window.clone().map(of).sum::<f64>() / window.len() as f64;
    for (side, across) in [(6, 11), (11, 6)] {
        let ratio = mean(&|at| force[12 * at + side] / (10.0 * point[12 * at + across]));
        assert!((ratio - 1.0).abs() < 0.05, "{ratio}");
    }
    assert!(point[12 * pressed - 6] < 0.03 && point[12 * pressed - 1] < 0.03);
}

/// Two files, one of which starts from the other at the beginning of its cooling.
fn branch(at: &Path, change: &str) -> (PathBuf, PathBuf) {
    let whole = fs::read_to_string(cases().join("sintering_three.toml")).unwrap();
    let short = whole
        .replace("value = \"0.2 s\"", "value = \"0.01 s\"")
        .replace("value = \"0.1 s\" }\n", "value = \"2 ms\" }\n");
    let short = short.replace("value = \"1 s\" }", "value = \"3 ms\" }").replace("every = 16667", "every = 1000");
    let (before, _) = short.split_once("[[observables]]").unwrap();
    let ending =
        "[ensemble]\nseeds = [1]\n[output]\nevery = 1000\ncontacts = true\ncontact_states = true\nenergies = false\n";
    fs::write(at.join("whole.toml"), format!("{before}{ending}")).unwrap();
    let (head, rest) = before.split_once("[[particles]]").unwrap();
    let (_, stages) = rest.split_once("[time]").unwrap();
    let (time, stages) = stages.split_once("[[stages]]").unwrap();
    let (_, cooling) = stages.split_once("[[stages]]\nname = \"cool\"").unwrap();
    let head = head.replace("temperature = 353.15\n", "").replace("friction = 0,", "friction = 0.5,");
    // Walls are smooth throughout.
    let head = head.replacen(
        "between = [\"grain\", \"wall\"]\nvalues = { friction = 0.5",
        "between = [\"grain\", \"wall\"]\nvalues = { friction = 0",
        1,
    );
    let start = format!("[start_from]\ncase = \"whole\"\nstage = \"sinter\"\n{change}");
    let child = format!("{head}{start}\n[time]{time}[[stages]]\nname = \"cool\"{cooling}{ending}");
    fs::write(at.join("branch.toml"), child).unwrap();
    (at.join("whole.toml"), at.join("branch.toml"))
}

#[test]
fn a_branch_goes_on_as_the_whole_run_does() {
    let at = folder("branch");
    let (whole, branch) = branch(&at, "");
    let load = |path: &Path| case::read(path, &[]).unwrap().load().unwrap().scenes[0].clone();
    let (whole, branch) = (load(&whole), load(&branch));
    let first = bits(run(&branch, &Options::threads(1)));
    let states = Options { states: Some(at.join("states")), ..Options::threads(1) };
    assert!(first == bits(run(&branch, &states)));
    assert!(fs::read_dir(at.join("states")).unwrap().count() == 1);
    assert!(first == bits(run(&branch, &states)), "from the saved state");
    let (whole, branch) = (run(&whole, &Options::threads(1)), run(&branch, &Options::threads(1)));
    for column in ["position", "velocity", "angular_velocity", "force", "body_point", "radius", "law_state"] {
        let (long, short) = (whole.values(column), branch.values(column));
        assert!(!short.is_empty() && long[long.len() - short.len()..] == *short, "{column}");
    }
}

#[test]
fn a_start_that_is_not_there_is_refused() {
    for (change, expected) in [
        ("at = \"4 ms\"\n", "start_from.at = 4e-3 s: the stage sinter lasts 3"),
        ("variant = \"p=7\"\n", "start_from.variant = p=7: no such variant (known: )"),
    ] {
        let (_, path) = branch(&folder("start-that-is-not-there"), change);
        let error = case::read(&path, &[]).unwrap().load().unwrap_err().to_string();
        assert!(error.contains(expected), "{error}");
    }
    let (_, path) = branch(&folder("stage-that-is-not-there"), "");
    let set = ["start_from.stage=melt".to_owned()];
    let error = case::read(&path, &set).unwrap().load().unwrap_err().to_string();
    assert!(error.contains("no such stage (known: press, heat, sinter, cool, relax)"), "{error}");
}

#[test]
fn overrides_reach_the_case_that_a_case_starts_from() {
    let (_, path) = branch(&folder("override-of-a-start"), "");
    let set = ["start.time.step.value=1.5e-7 s".to_owned()];
    let loaded = case::read(&path, &set).unwrap().load().unwrap();
    let start = loaded.scenes[0].start.as_ref().unwrap();
    assert!((start.scene.time_step - 1.5e-7).abs() < 1e-20 && (loaded.scenes[0].time_step - 3e-7).abs() < 1e-20);
}

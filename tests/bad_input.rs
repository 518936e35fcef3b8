//! Bad input is refused: the message names the file, the line, the key, the value and what is allowed.
//!
//! Each file of tests/inputs/bad says in its first lines what its message holds (`# expect: ...`), which overrides it is
//! read with (`# set: ...`), and marks the line that the message must name (`# <- here`). A file that cannot hold
//! comments has them in `NAME.expect`, one a line.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

use std::path::{Path, PathBuf};
use std::process::Command;

use crossgrain::case;
use crossgrain::case::scene::Scene;
use crossgrain::cli::parse_scene;
use crossgrain::simulation;

struct Bad {
    path: PathBuf,
    expected: Vec<String>,
    overrides: Vec<String>,
    line: Option<usize>,
}

fn bad_files() -> Vec<Bad> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/inputs/bad");
    let mut paths: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    paths.sort();
    paths.into_iter().map(bad_file).collect()
}

fn bad_file(path: PathBuf) -> Bad {
    let text = String::from_utf8_lossy(&std::fs::read(&path).unwrap()).into_owned();
    let lines = |prefix: &str| text.lines().filter_map(|line| line.strip_prefix(prefix)).map(str::to_owned).collect();
    let sidecar = path.with_extension("toml.expect");
    let expected: Vec<String> = if sidecar.exists() {
        std::fs::read_to_string(sidecar).unwrap().lines().map(str::to_owned).collect()
    } else {
        lines("# expect: ")
    };
    assert!(!expected.is_empty(), "{}: says nothing of its message", path.display());
    let line = text.lines().position(|line| line.ends_with("# <- here")).map(|index| index + 1);
    Bad { overrides: lines("# set: "), expected, line, path }
}

fn assert_clear(bad: &Bad, message: &str) {
    let file = bad.path.file_name().unwrap().to_str().unwrap();
    assert!(message.contains(file), "{file} is not named: {message}");
    for expected in &bad.expected {
        assert!(message.contains(expected), "{file}: no `{expected}` in: {message}");
    }
    if let Some(line) = bad.line {
        let place = message.split(file).nth(1).unwrap().strip_prefix(':').unwrap_or_default();
        let named = place.split(|c: char| !c.is_ascii_digit()).next().unwrap_or_default();
        assert_eq!(named, line.to_string(), "{message}");
    }
    assert!(!message.trim_end().contains('\n'), "{file}: more than one line: {message}");
}

#[test]
fn bad_cases_are_refused_with_file_line_key_value_and_what_is_allowed() {
    let files = bad_files();
    assert!(files.len() >= 90, "only {} bad inputs were found", files.len());
    for bad in files {
        match case::read(&bad.path, &bad.overrides).and_then(case::Stated::load) {
            Ok(_) => panic!("{} is accepted", bad.path.display()),
            Err(error) => assert_clear(&bad, &error.to_string()),
        }
    }
}

#[test]
fn the_command_refuses_bad_cases_with_exit_code_2_and_one_line() {
    let out = std::env::temp_dir().join(format!("crossgrain-bad-input-{}", std::process::id()));
    for bad in bad_files() {
        let mut command = Command::new(env!("CARGO_BIN_EXE_crossgrain"));
        if bad.overrides.is_empty() {
            command.arg("check").arg(&bad.path);
        } else {
            command.arg("run").arg(&bad.path).arg("--out").arg(&out);
            for text in &bad.overrides {
                command.arg("--set").arg(text);
            }
        }
        let done = command.output().unwrap();
        let message = String::from_utf8(done.stderr).unwrap();
        assert_eq!(done.status.code(), Some(2), "{}: {message}", bad.path.display());
        assert!(!message.contains("panicked"), "{message}");
        assert_clear(&bad, &message);
    }
    assert!(!out.exists(), "a refused case left output");
}

#[test]
fn what_is_no_file_is_refused() {
    for path in ["tests/inputs/bad/there-is-none.toml", "tests/inputs/bad"] {
        let done = Command::new(env!("CARGO_BIN_EXE_crossgrain")).arg("check").arg(path).output().unwrap();
        let message = String::from_utf8(done.stderr).unwrap();
        assert_eq!(done.status.code(), Some(2), "{message}");
        assert!(message.contains(path) && !message.contains("panicked"), "{message}");
    }
}

/// Two spheres that approach a plane, as a scene to spoil.
fn scene() -> serde_json::Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/inputs/good/plane.toml");
    let loaded = case::read(&path, &[]).and_then(case::Stated::load).unwrap();
    serde_json::to_value(&loaded.scenes[0]).unwrap()
}

/// The message about a scene whose value at `pointer` is replaced.
fn refusal(pointer: &str, value: serde_json::Value) -> String {
    let mut json = scene();
    *json.pointer_mut(pointer).unwrap() = value;
    let run = |scene: Scene| simulation::run(&scene, &simulation::Options::threads(1), &|_| {});
    match parse_scene("spoiled.json", &json.to_string()).and_then(run) {
        Ok(_) => panic!("{pointer} is accepted"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn bad_scenes_are_refused_by_name() {
    let cases: [(&str, serde_json::Value, &[&str]); 15] = [
        ("/schema", 7.into(), &["schema = 7", "reads schema 1"]),
        ("/time_step", 0.0.into(), &["time_step = 0 s", "must be positive"]),
        ("/steps", 5_000_000_000u64.into(), &["steps = 5000000000", "at most"]),
        ("/output_every", 0.into(), &["output_every = 0", "at least 1"]),
        ("/particles/0/material", 9.into(), &["particles.0.material = 9", "there are 2 materials"]),
        ("/bodies/0/material", 9.into(), &["bodies.0.material = 9", "there are 2 materials"]),
        ("/pairs/0/between/1", 9.into(), &["pairs.0.between = 9", "there are 2 materials"]),
        ("/pairs", serde_json::json!([]), &["nothing between soft and wall"]),
        ("/pairs/0/effective_young", (-1.0).into(), &["pairs.0.effective_young = -1 Pa", "must be positive"]),
        ("/pairs/0/damping_ratio", (-1.0).into(), &["pairs.0.damping_ratio = -1", "must not be negative"]),
        ("/particles/0/mass", 0.0.into(), &["particles.0.mass = 0 kg", "must be positive"]),
        ("/bodies/0/shape/normal/2", 0.0.into(), &["bodies.0.shape.normal", "must have the length 1"]),
        ("/model/normal/law", "jkr".into(), &["spoiled.json", "unknown field `force_cut`"]),
        ("/particles/0/radius", serde_json::Value::Null, &["spoiled.json", "expected f64"]),
        ("/materials/0/name", 3.into(), &["spoiled.json", "expected a string"]),
    ];
    for (pointer, value, expected) in cases {
        let message = refusal(pointer, value);
        for text in expected {
            assert!(message.contains(text), "{pointer}: no `{text}` in: {message}");
        }
    }
}

/// A mirror of YADE that asks for what YADE does not compute.
#[test]
fn options_that_a_mirrored_code_does_not_have_are_refused() {
    let arms = serde_json::json!({ "slip": "mid_overlap", "torque": "mid_overlap" });
    let options = serde_json::json!({
        "history": "displacement", "rotation": "small_angles", "order": "rotate_first", "increment": "present",
        "cap": "elastic", "friction": "total", "pair_arms": arms, "wall_arms": arms,
    });
    let mut json = scene();
    json["model"]["tangential"] = serde_json::json!({ "law": "mindlin", "history": "default" });
    for pair in json["pairs"].as_array_mut().unwrap() {
        pair["friction"] = 0.3.into();
    }
    json["mirror"]["code"] = "yade".into();
    json["mirror"]["start"] = "staggered".into();
    json["mirror"]["tangential"] = options;
    let refused = |json: &serde_json::Value| {
        let scene = parse_scene("spoiled.json", &json.to_string()).unwrap();
        simulation::run(&scene, &simulation::Options::threads(1), &|_| {}).err().map(|error| error.to_string())
    };
    let message = refused(&json).unwrap();
    for text in ["model.tangential.options", "displacement", "native[yade] mirrors the options of that code only"] {
        assert!(message.contains(text), "no `{text}` in: {message}");
    }
    json["mirror"]["tangential"]["history"] = "force".into();
    assert_eq!(refused(&json), None);
    for (key, value, text) in [
        ("cylinder_curvature", serde_json::json!(0.5), "mirror.cylinder_curvature = 0.5: native[yade] mirrors nothing"),
        (
            "plane_radius_factor",
            serde_json::json!(5),
            "mirror.plane_radius_factor = 5.0: native[yade] mirrors 1, 2 and",
        ),
        ("start", "synchronized".into(), "mirror.start = synchronized: native[yade] mirrors staggered"),
    ] {
        let mut spoiled = json.clone();
        spoiled["mirror"][key] = value;
        let message = refused(&spoiled).unwrap();
        assert!(message.contains(text), "no `{text}` in: {message}");
    }
}

#[test]
fn two_particles_of_a_scene_at_one_place_are_refused() {
    let mut json = scene();
    let particle = json["particles"][0].clone();
    json["particles"].as_array_mut().unwrap().push(particle);
    json["pairs"].as_array_mut().unwrap().push(serde_json::json!(
        {"between": [0, 0], "effective_young": 1e6, "effective_shear": null, "damping_ratio": 0.0, "restitution": null}
    ));
    let scene = parse_scene("scene.json", &json.to_string()).unwrap();
    let error = simulation::run(&scene, &simulation::Options::threads(1), &|_| {}).err().unwrap().to_string();
    assert!(error.contains("particles.1.position") && error.contains("another particle is there"), "{error}");
}

#[test]
fn the_command_refuses_scenes_that_are_none() {
    let folder = std::env::temp_dir().join(format!("crossgrain-bad-scene-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let whole = scene().to_string();
    let huge = whole.replacen("\"time_step\":", "\"time_step\":1e999,\"was\":", 1);
    for (name, text) in [("empty", ""), ("cut", &whole[..whole.len() / 2]), ("list", "[]"), ("huge", &huge)] {
        let path = folder.join(format!("{name}.json"));
        std::fs::write(&path, text).unwrap();
        let mut command = Command::new(env!("CARGO_BIN_EXE_crossgrain"));
        let done = command.arg("run-scene").arg(&path).arg("--out").arg(folder.join("out")).output().unwrap();
        let message = String::from_utf8(done.stderr).unwrap();
        assert_eq!(done.status.code(), Some(2), "{name}: {message}");
        assert!(message.contains(&format!("{name}.json")) && message.contains("line 1"), "{message}");
        assert!(!message.contains("panicked"), "{message}");
    }
    std::fs::remove_dir_all(folder).unwrap();
}

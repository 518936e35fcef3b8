//! A run that is killed at any moment goes on to the same bits.

#![allow(clippy::unwrap_used, clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "tests")]

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;

/// A small bed that falls on a floor.
fn bed() -> String {
    let mut case = r#"schema = 1
name = "falling-bed"
question = "Does a killed run go on to the same bits?"
level = "L3"
source = "made for this test"
geometry = { kind = "spheres" }
gravity = [0, 0, "-9.81 m/s2"]
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
values = { damping = { kind = "restitution", value = 0.7 }, friction = 0.5 }
[model]
normal = { law = "hertz", force_cut = "on" }
tangential = { law = "mindlin", history = "default" }
moments = { law = "free" }
[[bodies]]
name = "floor"
material = "glass"
shape = { kind = "plane", point = [0, 0, 0], normal = [0, 0, 1] }
motion = { kind = "fixed" }
[time]
step = { kind = "fixed", value = "5e-6 s" }
[[stages]]
name = "fall"
end = { kind = "duration", value = "0.06 s" }
[[stages]]
name = "slide"
end = { kind = "duration", value = "0.04 s" }
[[stages.actions]]
do = "set_motion"
body = "floor"
motion = { kind = "prescribed", velocity = ["0.1 m/s", 0, 0] }
[[stages.actions]]
do = "set_pair"
between = ["glass", "glass"]
values = { damping = { kind = "restitution", value = 0.4 }, friction = 0.2 }
[[stages.actions]]
do = "set_gravity"
value = [0, "1 m/s2", "-9 m/s2"]
[output]
every = 1000
contacts = true
"#
    .to_owned();
    for k in 0..150 {
        let place =
            [k % 5, k / 5 % 5, k / 25].map(|cell| 3.0 + 6.0 * f64::from(cell) + 0.1 * f64::from((k * 7 + cell) % 11));
        let _ = write!(
            case,
            "[[particles]]\nkind = \"single\"\nmaterial = \"glass\"\nradius = \"2.4 mm\"\n\
             position = [\"{:.3} mm\", \"{:.3} mm\", \"{:.3} mm\"]\nvelocity = [0, 0, \"-0.5 m/s\"]\nangular_velocity = [0, 0, 0]\n",
            place[0], place[1], place[2]
        );
    }
    case
}

fn crossgrain(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_crossgrain"));
    command.args(arguments).stdout(Stdio::null());
    command
}

fn columns(folder: &Path) -> Vec<u8> {
    fs::read(folder.join("record").join("columns.npz")).unwrap()
}

/// Kills a run `kills` times, each after a random while, and compares what comes of it.
fn killed(kills: u32, name: &str) {
    let root = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&root);
    fs::create_dir_all(&root).unwrap();
    let case = root.join("case.toml");
    fs::write(&case, bed()).unwrap();
    let case = case.to_str().unwrap();
    let (whole, broken) = (root.join("whole"), root.join("broken"));
    assert!(crossgrain(&["run", case, "--out", whole.to_str().unwrap()]).status().unwrap().success());
    let mut resumed = 0;
    let mut wait = 40;
    for kill in 0..kills {
        let folder = broken.to_str().unwrap();
        let mut child = if broken.join("run.json").is_file() && !broken.join("summary.json").is_file() {
            resumed += 1;
            crossgrain(&["resume", folder]).spawn().unwrap()
        } else {
            crossgrain(&["run", case, "--out", folder, "--checkpoint-steps", "150"]).spawn().unwrap()
        };
        std::thread::sleep(Duration::from_millis(wait));
        child.kill().unwrap();
        child.wait().unwrap();
        wait = (wait * 31 + 17 * u64::from(kill)) % 130;
    }
    assert!(resumed > 0);
    assert!(crossgrain(&["resume", broken.to_str().unwrap()]).status().unwrap().success());
    assert!(columns(&whole) == columns(&broken), "{kills} kills changed the record");
}

#[test]
fn three_kills_change_no_bit() {
    killed(3, "three-kills");
}

#[test]
#[ignore = "long: twenty kills"]
fn twenty_kills_change_no_bit() {
    killed(20, "twenty-kills");
}

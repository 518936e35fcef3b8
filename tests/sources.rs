//! Sources of particles: random insertion and lattices keep what they promise, the same bits for a seed.

#![allow(clippy::unwrap_used, reason = "tests")]

use std::path::Path;

use crossgrain::Vector;
use crossgrain::case::Stated;
use crossgrain::case::scene::{Scene, SceneParticle};
use crossgrain::domain::Domain;

fn text(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/inputs/good").join(name);
    std::fs::read_to_string(path).unwrap()
}

fn scenes(text: &str, overrides: &[&str]) -> Vec<Scene> {
    let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
    Stated::parse("sources.toml", text, &overrides).and_then(Stated::load).unwrap().scenes
}

fn bits(scene: &Scene) -> Vec<u64> {
    let values = |p: &SceneParticle| [p.position, p.velocity, [p.radius, p.mass, p.moment_of_inertia]].concat();
    scene.particles.iter().flat_map(values).map(f64::to_bits).collect()
}

/// The largest overlap of two particles by the definition: every pair, nearest images [m].
fn largest_overlap(scene: &Scene) -> f64 {
    let domain = Domain::new(&scene.domain);
    let mut largest = f64::NEG_INFINITY;
    for (i, one) in scene.particles.iter().enumerate() {
        for other in &scene.particles[..i] {
            let mut branch = Vector::from(one.position) - Vector::from(other.position);
            for axis in (0..3).filter(|axis| domain.periodic[*axis]) {
                branch[axis] -= domain.length[axis] * (branch[axis] / domain.length[axis]).round();
            }
            largest = largest.max(one.radius + other.radius - branch.norm());
        }
    }
    largest
}

#[test]
fn random_particles_do_not_overlap_and_stay_in_their_region() {
    for scene in scenes(&text("random.toml"), &[]) {
        assert_eq!(scene.particles.len(), 151);
        let largest = largest_overlap(&scene);
        assert!(largest <= 1e-18, "overlap of {largest:e} m");
        for particle in &scene.particles[..150] {
            let [x, y, z] = particle.position;
            assert!((-1e-2..1e-2).contains(&x) && (-1e-2..1e-2).contains(&y) && (-9e-3..2e-3).contains(&z));
            assert!(particle.velocity.iter().all(|v| v.abs() <= 0.2), "{:?}", particle.velocity);
        }
        assert!(bits(&scene)[..9] != bits(&scene)[9..18], "particles must differ");
    }
}

#[test]
fn random_particles_reach_across_periodic_faces() {
    let touching = |scene: &Scene| scene.particles.iter().any(|p| p.position[0].abs() + p.radius > 1e-2);
    assert!(scenes(&text("random.toml"), &[]).iter().all(touching));
}

#[test]
fn random_particles_keep_clear_of_walls() {
    let tube = r#"
[[bodies]]
name = "tube"
material = "soft"
shape = { kind = "cylinder", point = [0, 0, 0], axis = [0, 0, 1], radius = "6 mm" }
motion = { kind = "fixed" }
"#;
    let open = [r#"domain.boundary=["open", "open", "open"]"#, "particles.0.count=60"];
    for scene in scenes(&format!("{}{tube}", text("random.toml")), &open) {
        for particle in &scene.particles {
            let [x, y, _] = particle.position;
            assert!(x.hypot(y) + particle.radius <= 6e-3 * (1.0 + 1e-12), "{:?}", particle.position);
        }
    }
}

#[test]
fn a_seed_gives_the_same_bits_and_another_seed_others() {
    for name in ["random.toml", "lattice.toml"] {
        let (once, again) = (scenes(&text(name), &[]), scenes(&text(name), &[]));
        assert_eq!(once.iter().map(|scene| scene.seed).collect::<Vec<_>>(), [Some(1), Some(2)]);
        assert!(once.iter().zip(&again).all(|(one, other)| bits(one) == bits(other)));
        assert!(bits(&once[0]) != bits(&once[1]));
        assert!(once[0].name().ends_with("/seed=1") && once[1].name().ends_with("/seed=2"));
    }
}

#[test]
fn the_places_of_a_source_do_not_depend_on_refinements() {
    let scenes = scenes(&text("random.toml"), &["time.refinements=1", "ensemble.seeds=[5]"]);
    assert_eq!(scenes.iter().map(|scene| scene.refinement).collect::<Vec<_>>(), [0, 1]);
    assert_eq!(bits(&scenes[0]), bits(&scenes[1]));
}

/// Kolmogorov-Smirnov distance of a sample from the uniform distribution between two values [-].
fn distance_from_uniform(mut sample: Vec<f64>, low: f64, high: f64) -> f64 {
    sample.sort_by(f64::total_cmp);
    let count = sample.len() as f64;
    let steps = sample.iter().enumerate().map(|(k, value)| {
        let expected = (value - low) / (high - low);
        ((k + 1) as f64 / count - expected).abs().max((k as f64 / count - expected).abs())
    });
    steps.fold(0.0, f64::max)
}

#[test]
fn radii_places_and_velocities_are_uniform() {
    let dilute =
        ["particles.0.count=4000", r#"particles.0.radius={ kind = "uniform", min = "1e-5 m", max = "5e-5 m" }"#];
    let scene = scenes(&text("random.toml"), &dilute).remove(0);
    let random = &scene.particles[..4000];
    // Kolmogorov-Smirnov: above 1.95 / sqrt(n) once in a thousand seeds, and the seed is fixed.
    let bound = 1.95 / 4000f64.sqrt();
    let column = |value: &dyn Fn(&SceneParticle) -> f64, low: f64, high: f64| {
        distance_from_uniform(random.iter().map(value).collect(), low, high)
    };
    let radius = column(&|p| p.radius, 1e-5, 5e-5);
    let height = column(&|p| p.position[2], -9e-3, 2e-3);
    let speed = column(&|p| p.velocity[1], -0.2, 0.2);
    assert!(radius < bound && height < bound && speed < bound, "{radius} {height} {speed}, bound {bound}");
    // A sphere that looks for its place later must not stand elsewhere in the list: neighbours in it are independent.
    let mean = random.windows(2).map(|two| (two[0].radius - 3e-5) * (two[1].radius - 3e-5)).sum::<f64>() / 3999.0;
    assert!(mean.abs() < 4.0 / 3999f64.sqrt() * (4e-5f64.powi(2) / 12.0), "correlation of neighbours: {mean:e}");
}

#[test]
fn a_lattice_has_its_sites_up_to_the_noise() {
    let scene = scenes(&text("lattice.toml"), &[]).remove(0);
    assert_eq!(scene.particles.len(), 8 * 4 * 3);
    let mut largest = 0.0f64;
    for (k, particle) in scene.particles.iter().enumerate() {
        let site = [k % 8, k / 8 % 4, k / 32];
        for axis in 0..3 {
            let stated = [-1e-2, -8e-3, -8e-3][axis] + 2.5e-3 * site[axis] as f64;
            let mut off = particle.position[axis] - stated;
            if axis == 0 {
                off -= 2e-2 * (off / 2e-2).round();
            }
            largest = largest.max(off.abs());
        }
        assert!((-1e-2..1e-2).contains(&particle.position[0]), "noise re-enters a periodic axis");
        assert!(particle.velocity.iter().all(|v| *v == 0.0));
    }
    assert!((1.9e-4..=2e-4).contains(&largest), "largest displacement {largest:e} m, 0.2 mm are stated");
}

#[test]
fn a_large_bed_is_checked_for_overlaps() {
    let many = [
        "particles.0.count=20000",
        r#"particles.0.radius={ kind = "equal", value = "0.2 mm" }"#,
        r#"particles.0.region=[["-1 cm", "-1 cm", "-9 mm"], ["1 cm", "1 cm", "9 mm"]]"#,
        "ensemble.seeds=[3]",
    ];
    let scene = scenes(&text("random.toml"), &many).remove(0);
    assert_eq!(scene.particles.len(), 20_001);
    let lattice = scenes(&text("lattice.toml"), &["particles.0.spacing=2.1e-3", "allow_initial_overlap=true"]);
    assert!(largest_overlap(&lattice[0]) > 0.0, "the noise must push some sites together");
    let overrides = ["particles.0.spacing=2.1e-3".to_owned()];
    let refused = Stated::parse("lattice.toml", &text("lattice.toml"), &overrides).and_then(Stated::load);
    assert!(refused.unwrap_err().to_string().contains("particles.0.spacing = overlap of"));
}

//! Adhesive and hysteretic normal forces that LIGGGHTS, YADE and LAMMPS were measured with.

use crossgrain::Vector;
use crossgrain::laws::drive::{Couple, Path, Single, Stage};
use crossgrain::laws::model::{Composed, Free, Frictionless};
use crossgrain::laws::normal::cohesive::{Cohesive, DashpotLimit};
use crossgrain::laws::normal::dmt::Dmt;
use crossgrain::laws::normal::hertz::Hertz;
use crossgrain::laws::normal::hysteretic_branches::Rule;
use crossgrain::laws::normal::luding_hysteretic::LudingHysteretic;
use crossgrain::laws::normal::{sjkr, sjkr2};
use crossgrain::laws::{Approach, NormalLaw, PairLaw};

use super::scenes::{self, digits};

const RADIUS: f64 = 1e-3;

/// Overlaps and forces of a path of legs (steps, velocity) [m/s].
fn legs<N: NormalLaw>(normal: N, couple: Couple, overlap: f64, dt: f64, legs: &[(u64, f64)]) -> Vec<[f64; 2]> {
    let model = Composed { normal, tangential: Frictionless, moments: Free };
    let stages = legs
        .iter()
        .map(|(steps, velocity)| Stage {
            steps: *steps,
            velocity: Vector::x() * *velocity,
            angular_velocities: [Vector::zeros(); 2],
            turn: Vector::zeros(),
        })
        .collect();
    let mut seen = Vec::new();
    Single::new(model, couple)
        .drive(&Path { overlap, dt, stages }, |sample, _| {
            let force = sample.action.map_or(0.0, |action| action.force.x);
            seen.push([sample.contact.geometry.overlap, force]);
        })
        .unwrap();
    seen
}

fn least(seen: &[[f64; 2]]) -> [f64; 2] {
    *seen.iter().min_by(|a, b| a[1].total_cmp(&b[1])).unwrap()
}

/// R 1 mm, E 1e7 Pa, W 0.05 J/m2, pulled apart from 2 um at 1 nm per step.
fn adhesive() -> Couple {
    Couple::spheres(PairLaw { work_of_adhesion: 0.05, ..scenes::pair(0.0, 0.0) }, [RADIUS; 2], 2500.0)
}

#[test]
fn dmt_starts_and_pulls_off_as_yade_and_lammps() {
    let seen = legs(Dmt::new(true), adhesive(), 2e-6, 1e-6, &[(6000, 1e-3)]);
    digits("start", seen[0][1], 0.000_306_257_75, 2e-8);
    // The last sample of LAMMPS is at 1 nm; YADE's at 2e-16 m.
    let at = seen.iter().find(|[overlap, _]| (overlap - 1e-9).abs() < 1e-13).unwrap();
    digits("lammps at 1 nm", at[1], -0.000_157_074_45, 4e-8);
    let touch = legs(Dmt::new(true), adhesive(), 1e-16, 1e-6, &[]);
    digits("yade at touch", touch[0][1], -0.000_157_079_63, 4e-8);
    digits("2 pi W R*", touch[0][1], -std::f64::consts::TAU * 0.05 * 0.5e-3, 1e-8);
    assert!(seen.iter().all(|[overlap, force]| *overlap > 0.0 || *force == 0.0));
}

#[test]
fn area_laws_have_the_forces_of_liggghts() {
    let base = Hertz { force_cut: true };
    let (energy_density, dashpot_limit) = (37_500.0, DashpotLimit::Base);
    let first = Cohesive { base, attraction: sjkr::Lens { energy_density }, dashpot_limit };
    let second = Cohesive { base, attraction: sjkr2::Linear { energy_density }, dashpot_limit };
    let seen = legs(first, adhesive(), 2e-6, 1e-6, &[(2500, 1e-3)]);
    digits("sjkr start", seen[0][1], 0.000_227_835_75, 3e-8);
    digits("sjkr least", least(&seen)[1], -9.025_263_1e-6, 1e-7);
    digits("sjkr where", least(&seen)[0], 2.3e-7, 1e-6);
    let seen = legs(second, adhesive(), 2e-6, 1e-6, &[(2500, 1e-3)]);
    digits("sjkr2 start", seen[0][1], -7.901_511_9e-6, 1e-7);
    digits("sjkr2 least", least(&seen)[1], -7.221_457_3e-5, 1e-8);
    digits("sjkr2 where", least(&seen)[0], 9.19e-7, 1e-6);
    let model = Composed { normal: second, tangential: Frictionless, moments: Free };
    let mut pull_off = 0.0;
    Single::new(model, adhesive())
        .drive(&Path { overlap: 1e-6, dt: 1.0, stages: vec![] }, |sample, _| {
            pull_off = sample.action.unwrap().normal.pull_off;
        })
        .unwrap();
    digits("sjkr2 closed form", -pull_off, -7.221_458_7e-5, 2e-8);
}

fn luding(rule: Rule) -> LudingHysteretic {
    LudingHysteretic {
        loading: 1000.0,
        unloading: 4000.0,
        cohesive: 800.0,
        plasticity_depth: 0.05,
        dashpot: 0.0,
        force_cut: false,
        rule,
    }
}

#[test]
fn hysteresis_has_the_peaks_minima_and_ends_of_liggghts_and_yade() {
    let couple = Couple::spheres(scenes::pair(0.0, 0.0), [RADIUS; 2], 2500.0);
    // Steps of 1 nm in, out and in; peak, minimum, its overlap; ends of hooke/hysteresis, luding and LudingPM.
    let part = (
        [20_000, 15_000, 10_000],
        [0.019_999_5, -0.005_327_6, 6.6595e-6],
        [0.013_587_587_5, 0.013_588_276_3, 0.013_587_422_3],
    );
    let beyond =
        ([90_000, 70_000, 30_000], [0.159_998, -0.033_327_6, 4.165_95e-5], [0.049_999_5, 0.049_999_5, 0.049_999_5]);
    for (steps, [peak, minimum, place], ends) in [part, beyond] {
        let path: Vec<(u64, f64)> = steps.into_iter().zip([-1e-2, 1e-2, -1e-2]).collect();
        for (rule, end) in [Rule::SelfConsistent, Rule::OldStiffness, Rule::LudingPm].into_iter().zip(ends) {
            let seen = legs(luding(rule), couple, -0.5e-9, 1e-7, &path);
            let high = seen.iter().map(|row| row[1]).fold(0.0, f64::max);
            // The measured minimum is that of every tenth step.
            let tenth: Vec<[f64; 2]> = seen.iter().step_by(10).copied().collect();
            digits(&format!("{rule:?} peak"), high, peak, 1e-9);
            digits(&format!("{rule:?} minimum"), least(&tenth)[1], minimum, 1e-9);
            digits(&format!("{rule:?} place"), least(&tenth)[0], place, 1e-9);
            digits(&format!("{rule:?} end"), seen[seen.len() - 1][1], end, 5e-9);
        }
    }
}

#[test]
fn differences_after_the_limit_of_cohesion_are_those_measured() {
    let couple = Couple::spheres(scenes::pair(0.0, 0.0), [RADIUS; 2], 2500.0);
    let path = [(20_000, -1e-2), (15_000, 1e-2), (10_000, -1e-2)];
    let run = |rule| legs(luding(rule), couple, -0.5e-9, 1e-7, &path);
    let [own, old, yade] = [Rule::SelfConsistent, Rule::OldStiffness, Rule::LudingPm].map(run);
    // Measured every tenth step.
    let far = |a: &[[f64; 2]], b: &[[f64; 2]]| {
        a.iter().zip(b).step_by(10).map(|(a, b)| (a[1] - b[1]).abs()).fold(0.0, f64::max)
    };
    digits("luding against hooke/hysteresis", far(&old, &own), 1.056e-6, 5e-4);
    digits("LudingPM against hooke/hysteresis", far(&yade, &own), 4.737e-7, 5e-4);
    digits("LudingPM against luding", far(&yade, &old), 8.540e-7, 5e-4);
}

#[test]
fn at_walls_liggghts_takes_2r_and_yade_is_elastic() {
    let couple = Couple::on_plane(scenes::pair(0.0, 0.0), RADIUS, 2500.0);
    let path = [(20_000, -1e-2), (20_000, 1e-2)];
    let yade = legs(luding(Rule::LudingPm), couple, -0.5e-9, 1e-7, &path);
    for [overlap, force] in yade.iter().filter(|row| row[0] > 1e-8) {
        assert!((force / overlap - 4000.0).abs() < 1e-6);
    }
    let plain = legs(luding(Rule::OldStiffness), couple, -0.5e-9, 1e-7, &path);
    let limit = 4.0 / 3.0 * 0.05 * 2.0 * RADIUS;
    let stiffness = 1000.0 + 3000.0 * 19.9995e-6 / limit;
    let slope = (plain[20_000][1] - plain[20_100][1]) / 100e-9;
    digits("unloading at a wall", slope, stiffness, 1e-6);
}

#[test]
fn yade_has_no_force_at_a_wall_until_the_overlap_exceeds_its_first_value() {
    let at_body = |overlap| Approach { overlap, normal_velocity: 0.0, radii: [RADIUS; 2], at_body: true };
    let couple = Couple::on_plane(scenes::pair(0.0, 0.0), RADIUS, 2500.0);
    let mut history = Default::default();
    let force =
        |overlap, history: &mut _| luding(Rule::LudingPm).evaluate(&couple.pair, &at_body(overlap), &(), history).force;
    for overlap in [0.0, 3e-7, 2e-7, 3e-7] {
        assert!(force(overlap, &mut history).to_bits() == 0, "{overlap}");
    }
    for overlap in [3.1e-7, 2e-7, 1e-7] {
        assert!((force(overlap, &mut history) / overlap - 4000.0).abs() < 1e-9, "{overlap}");
    }
}

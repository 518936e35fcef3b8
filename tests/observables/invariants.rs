//! What may not change an observable: the order of particles, crossed faces, shifts, threads.

use crossgrain::observables::measure::{Columns, Named, series};
use crossgrain::observables::system::System;
use proptest::prelude::*;
use serde_json::{Value, json};

use super::{Row, State, measure, plane};

/// A loose pack with overlaps in a box that is periodic along x and y, on a floor.
fn pack(seed: u64, count: usize) -> State {
    let mut state = seed;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    let position = (0..count).map(|_| [next() * 5.0, next() * 5.0, 0.4 + next() * 3.0]).collect();
    let mut pack = State::new(
        position,
        0.5,
        [5.0, 5.0, 5.0],
        ["periodic", "periodic", "open"],
        json!([plane("floor", [0.0; 3], [0.0, 0.0, 1.0])]),
    );
    pack.system["radius"] = (0..count).map(|_| 0.2 + 0.4 * next()).collect();
    pack
}

fn geometric() -> Vec<Value> {
    let box_region = json!({"kind": "box", "min": [-1, 0.5, 0.5], "max": [1.5, 4, 2.5]});
    let bed = json!({"kind": "bed", "floor": "floor", "above_floor": 0.5, "below_surface": 0.3});
    let mut asked = vec![
        json!({"kind": "packing_fraction_by_center", "floor": "floor"}),
        json!({"kind": "packing_profile", "bins": {"axis": "x", "from": 0, "to": 5, "width": 0.5}}),
        json!({"kind": "largest_fragment"}),
        json!({"kind": "overlaps", "statistic": "largest"}),
    ];
    for region in [json!({"kind": "everything"}), box_region, bed] {
        asked.push(json!({"kind": "packing_fraction", "region": region, "radii": "present"}));
        asked.push(json!({"kind": "coordination", "region": region}));
        asked.push(json!({"kind": "coordination_without_rattlers", "region": region, "least_contacts": 3}));
        asked.push(json!({"kind": "rattler_share", "region": region, "least_contacts": 3}));
    }
    asked
}

fn close(first: &[f64], second: &[f64]) -> bool {
    first.iter().zip(second).all(|(a, b)| (a - b).abs() < 1e-11 * (1.0 + a.abs()) || (a.is_nan() && b.is_nan()))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn numbers_of_particles_and_crossed_faces_change_nothing(
        seed in 0u64..1_000_000, turn in 0usize..60, hops in prop::array::uniform2(-3i32..4),
    ) {
        let state = pack(seed, 60);
        let mut other = state.clone();
        other.position.rotate_left(turn);
        for key in ["radius", "mass", "moment_of_inertia"] {
            other.system[key].as_array_mut().unwrap().rotate_left(turn);
        }
        for (at, row) in other.position.iter_mut().enumerate() {
            let hop = if at % 2 == 0 { hops } else { [hops[1], -hops[0]] };
            row[0] += 5.0 * f64::from(hop[0]);
            row[1] += 5.0 * f64::from(hop[1]);
        }
        for kind in geometric() {
            let (first, second) = (state.list(kind.clone()), other.list(kind.clone()));
            prop_assert!(close(&first, &second), "{kind}: {first:?} {second:?}");
        }
    }

    #[test]
    fn a_shift_along_a_periodic_axis_changes_nothing_but_places(seed in 0u64..1_000_000, shift in 0.0f64..5.0) {
        let state = pack(seed, 60);
        let mut other = state.clone();
        other.position.iter_mut().for_each(|row| row[1] += shift);
        for kind in geometric().into_iter().filter(|kind| kind["region"]["kind"] != "box") {
            let (first, second) = (state.list(kind.clone()), other.list(kind.clone()));
            prop_assert!(close(&first, &second), "{kind}: {first:?} {second:?}");
        }
    }

    #[test]
    fn contacts_are_those_of_a_count_over_all_pairs(seed in 0u64..1_000_000) {
        let state = pack(seed, 60);
        let radius: Vec<f64> = serde_json::from_value(state.system["radius"].clone()).unwrap();
        let mut contacts = 0;
        for i in 0..60 {
            for j in 0..i {
                let mut branch: Row = std::array::from_fn(|axis| state.position[i][axis] - state.position[j][axis]);
                branch[..2].iter_mut().for_each(|x| *x -= 5.0 * (*x / 5.0).round());
                let distance = branch.iter().map(|x| x * x).sum::<f64>().sqrt();
                contacts += usize::from(distance < radius[i] + radius[j]);
            }
        }
        let mean = state.number(json!({"kind": "coordination", "region": {"kind": "everything"}}));
        prop_assert_eq!(mean, 2.0 * contacts as f64 / 60.0);
    }
}

#[test]
fn threads_change_no_bit() {
    let state = pack(7, 60);
    let system = System::parse(&state.system.to_string()).unwrap();
    let time: Vec<_> = (0..9).map(f64::from).collect();
    let position: Vec<Row> = (0..9)
        .flat_map(|k| state.position.iter().map(move |row| [row[0] + 0.1 * f64::from(k), row[1], row[2]]))
        .collect();
    let columns = Columns { time: &time, position: &position, ..Columns::default() };
    let asked: Vec<_> = geometric()
        .into_iter()
        .enumerate()
        .map(|(at, kind)| Named { name: format!("observable-{at}"), measure: measure(kind) })
        .collect();
    let bits = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let all = pool.install(|| series(&asked, &system, &columns)).unwrap();
        all.into_iter().flat_map(|one| one.values).map(f64::to_bits).collect::<Vec<_>>()
    };
    let one = bits(1);
    assert!([2, 3, 8].into_iter().all(|threads| bits(threads) == one));
}

//! Observables against crystals, forces and balances whose values are known, and against what may not change them.

#![allow(clippy::unwrap_used, clippy::float_cmp, clippy::needless_pass_by_value, reason = "tests; counts are exact")]

#[path = "observables/invariants.rs"]
mod invariants;

use std::f64::consts::{PI, SQRT_2};

use crossgrain::case::measure::Measure;
use crossgrain::observables::measure::{Columns, ContactColumns, Named, Series, series};
use crossgrain::observables::system::System;
use serde_json::{Value, json};

type Row = [f64; 3];

/// A state of the tests: columns of one sample and the system as JSON.
#[derive(Clone)]
struct State {
    position: Vec<Row>,
    velocity: Vec<Row>,
    system: Value,
    body_force: Vec<Row>,
    pair: Vec<[u32; 2]>,
    force: Vec<Row>,
}

fn measure(value: Value) -> Measure {
    serde_json::from_value(value).unwrap()
}

impl State {
    /// Spheres of one radius and density in a box.
    fn new(position: Vec<Row>, radius: f64, length: Row, boundary: [&str; 3], bodies: Value) -> Self {
        let count = position.len();
        let mass = 2500.0 * 4.0 / 3.0 * PI * radius.powi(3);
        let system = json!({
            "radius": vec![radius; count], "mass": vec![mass; count],
            "moment_of_inertia": vec![0.4 * mass * radius * radius; count],
            "gravity": [0, 0, -9.81], "domain": {"min": [0, 0, 0], "max": length, "boundary": boundary},
            "bodies": bodies, "friction": [{"between": [0, 0], "value": 0.5}],
        });
        let bodies = system["bodies"].as_array().unwrap().len();
        let zero = vec![[0.0; 3]; count];
        let body_force = vec![[0.0; 3]; bodies];
        Self { velocity: zero, position, system, body_force, pair: Vec::new(), force: Vec::new() }
    }

    fn series(&self, measure: &Measure) -> Result<Series, String> {
        let system = System::parse(&self.system.to_string())?;
        let start = [0, self.pair.len()];
        let columns = Columns {
            time: &[0.0],
            position: &self.position,
            velocity: Some(&self.velocity),
            body_force: Some(&self.body_force),
            contacts: Some(ContactColumns { start: &start, pair: &self.pair, force: &self.force }),
            ..Columns::default()
        };
        let named = Named { name: "it".to_owned(), measure: measure.clone() };
        series(&[named], &system, &columns).map(|mut all| all.remove(0)).map_err(|error| error.to_string())
    }

    fn list(&self, value: Value) -> Vec<f64> {
        self.series(&measure(value)).unwrap().values
    }

    fn number(&self, value: Value) -> f64 {
        self.list(value)[0]
    }
}

/// `cells`^3 cells of a crystal of touching spheres of diameter 1, overlapping by `overlap`, in a periodic box.
fn crystal(basis: &[Row], edge: f64, cells: u32, overlap: f64) -> State {
    let edge = edge * (1.0 - overlap);
    let mut position = Vec::new();
    for cell in 0..cells.pow(3) {
        let corner = [cell % cells, cell / cells % cells, cell / cells / cells].map(f64::from);
        position.extend(basis.iter().map(|at| std::array::from_fn(|axis| (corner[axis] + at[axis]) * edge)));
    }
    State::new(position, 0.5, [edge * f64::from(cells); 3], ["periodic"; 3], json!([]))
}

const FCC: [Row; 4] = [[0.0, 0.0, 0.0], [0.5, 0.5, 0.0], [0.5, 0.0, 0.5], [0.0, 0.5, 0.5]];

fn plane(name: &str, point: Row, normal: Row) -> Value {
    json!({"name": name, "shape": {"kind": "plane", "point": point, "normal": normal}})
}

fn everything() -> Value {
    json!({"kind": "everything"})
}

#[test]
fn packing_fractions_of_crystals_are_exact_in_every_region() {
    let cases = [(crystal(&FCC, SQRT_2, 3, 0.0), PI / (3.0 * SQRT_2)), (crystal(&[[0.0; 3]], 1.0, 3, 0.0), PI / 6.0)];
    for (state, exact) in cases {
        let edge = state.system["domain"]["max"][0].as_f64().unwrap() / 3.0;
        // Any box of one period holds the packing fraction of the crystal, wherever it lies.
        let around = json!({"kind": "box", "min": [0.3, -0.2, 0.11], "max": [0.3 + edge, edge - 0.2, 0.11 + edge]});
        for region in [everything(), around] {
            let kind = json!({"kind": "packing_fraction", "region": region, "radii": "present"});
            assert!((state.number(kind) - exact).abs() < 1e-12, "{exact}");
        }
        let bins = json!({"axis": "y", "from": 0.17, "to": 0.17 + edge, "width": edge / 8.0});
        let profile = state.list(json!({"kind": "packing_profile", "bins": bins}));
        assert!((profile.iter().sum::<f64>() / 8.0 - exact).abs() < 1e-12, "{exact}");
        assert!(profile.iter().any(|share| (share - exact).abs() > 1e-3), "a crystal has layers");
    }
}

#[test]
fn a_bed_of_layers_has_the_fraction_of_its_slab_and_of_its_centre() {
    // Simple cubic layers on a floor, walls at the sides; heights of the centres 0.5, 1.5 ... 9.5.
    let mut position = Vec::new();
    for at in 0..160u32 {
        position.push([at % 4, at / 4 % 4, at / 16].map(|k| f64::from(k) + 0.5));
    }
    let walls = json!([plane("floor", [0.0; 3], [0.0, 0.0, 1.0]), plane("side", [4.0, 0.0, 0.0], [-1.0, 0.0, 0.0]),]);
    let mut state = State::new(position, 0.5, [6.0, 4.0, 30.0], ["open", "periodic", "open"], walls);
    let bed = json!({"kind": "bed", "floor": "floor", "above_floor": 2, "below_surface": 2.5});
    let in_bed = state.number(json!({"kind": "packing_fraction", "region": bed, "radii": "present"}));
    assert!((in_bed - PI / 6.0).abs() < 1e-13);
    let by_center = state.number(json!({"kind": "packing_fraction_by_center", "floor": "floor"}));
    assert!((by_center - PI / 6.0).abs() < 1e-13);
    // The sum over a profile is the volume of the particles.
    let bins = json!({"axis": "z", "from": 0, "to": 12, "width": 0.75});
    let profile = state.list(json!({"kind": "packing_profile", "bins": bins}));
    assert!((profile.iter().sum::<f64>() * 0.75 * 16.0 - 160.0 * PI / 6.0).abs() < 1e-11);
    // A moved floor moves the bed; a region above the surface is empty.
    state.system["bodies"][0]["shape"]["point"] = json!([0, 0, 0.25]);
    let moved = state.number(json!({"kind": "packing_fraction_by_center", "floor": "floor"}));
    assert!((moved - 160.0 * PI / 6.0 / (2.0 * 16.0 * 4.75)).abs() < 1e-13);
    state.system["bodies"][0]["shape"]["point"] = json!([0, 0, -1]);
    assert!(state.number(json!({"kind": "packing_fraction_by_center", "floor": "floor"})).is_nan(), "below the domain");
    let above = json!({"kind": "bed", "floor": "floor", "above_floor": 20, "below_surface": 0});
    assert!(state.number(json!({"kind": "packing_fraction", "region": above, "radii": "present"})).is_nan());
}

#[test]
fn coordination_of_crystals_is_theirs_even_in_one_cell() {
    for (basis, edge, exact) in [(&FCC[..], SQRT_2, 12.0), (&FCC[..1], 1.0, 6.0)] {
        for cells in [1, 2, 3] {
            let state = crystal(basis, edge, cells, 1e-6);
            let kind = json!({"kind": "coordination", "region": everything()});
            assert_eq!(state.number(kind), exact, "{cells} cells");
            assert_eq!(
                state.number(json!({"kind": "rattler_share", "region": everything(), "least_contacts": 4})),
                0.0
            );
            assert_eq!(state.number(json!({"kind": "largest_fragment"})), 1.0);
            let overlap = state.number(json!({"kind": "overlaps", "statistic": "mean"}));
            assert!((overlap - 1e-6).abs() < 1e-12, "{overlap}");
            let apart = crystal(basis, edge, cells, -1e-6);
            assert_eq!(apart.number(json!({"kind": "coordination", "region": everything()})), 0.0);
            assert!(apart.number(json!({"kind": "overlaps", "statistic": "mean"})).is_nan());
        }
    }
}

#[test]
fn rattlers_fall_one_after_the_other() {
    // A cube of eight on a floor, and a chain of two on it that nothing else holds.
    let step = 1.0 - 1e-6;
    let mut position: Vec<Row> =
        (0..8u32).map(|at| [at & 1, at >> 1 & 1, at >> 2].map(|k| f64::from(k) * step + 0.5 - 1e-7)).collect();
    position.push([0.5, 0.5, 0.5 + 2.0 * step]);
    position.push([0.5, 0.5, 0.5 + 3.0 * step]);
    let floor = plane("floor", [0.0; 3], [0.0, 0.0, 1.0]);
    let state = State::new(position, 0.5, [8.0; 3], ["open"; 3], json!([floor]));
    let at =
        |kind: &str, least: u32| state.number(json!({"kind": kind, "region": everything(), "least_contacts": least}));
    // 12 edges and 2 contacts of the chain; the cube itself has 12.
    assert_eq!(state.number(json!({"kind": "coordination", "region": everything()})), 28.0 / 10.0);
    assert_eq!(state.number(json!({"kind": "coordination", "region": everything(), "bodies": true})), 32.0 / 10.0);
    assert_eq!(at("rattler_share", 1), 0.0);
    assert_eq!(at("rattler_share", 2), 0.2);
    assert_eq!(at("coordination_without_rattlers", 2), 3.0);
    // The floor holds the four at the bottom, but without the four on top they have two neighbours and the floor.
    assert_eq!(at("rattler_share", 4), 1.0);
    assert!(at("coordination_without_rattlers", 4).is_nan());
}

/// Two spheres pressed together along x between two walls with 3 N, sheared along z with 1.2 N.
fn pressed() -> State {
    let walls = json!([plane("left", [0.0; 3], [1.0, 0.0, 0.0]), plane("right", [1.98, 0.0, 0.0], [-1.0, 0.0, 0.0]),]);
    let mut state =
        State::new(vec![[0.495, 1.0, 1.0], [1.485, 1.0, 5.0]], 0.5, [4.0; 3], ["open", "periodic", "periodic"], walls);
    state.pair = vec![[1, 0], [0, 2], [1, 3]];
    state.force = vec![[3.0, 0.0, 1.2], [3.0, 0.0, 1.2], [-3.0, 0.0, -1.2]];
    state.body_force = vec![[-3.0, 0.0, -1.2], [3.0, 0.0, 1.2]];
    state
}

#[test]
fn forces_of_two_pressed_spheres_are_split_by_geometry() {
    let state = pressed();
    let tensor = state.list(json!({"kind": "stress_tensor", "region": everything(), "part": "contacts"}));
    let volume = 1.98 * 16.0;
    // Branches along x: from wall to wall, 1.98 m in all.
    for (k, expected) in [(0, 3.0 * 1.98 / volume), (6, 1.2 * 1.98 / volume)] {
        assert!((tensor[k] - expected).abs() < 1e-14, "{tensor:?}");
    }
    assert!([1, 2, 3, 4, 5, 7, 8].iter().all(|k| tensor[*k].abs() < 1e-15), "{tensor:?}");
    let half = json!({"kind": "box", "min": [0.5, 0, 0], "max": [1.5, 4, 4]});
    let part = state.list(json!({"kind": "stress_tensor", "region": half, "part": "contacts"}));
    assert!((part[0] - 3.0 * 0.99 / 16.0).abs() < 1e-14, "only the contact of the two lies in it: {part:?}");
    assert!((state.number(json!({"kind": "normal_forces", "statistic": "mean"})) - 3.0).abs() < 1e-14);
    assert!(state.number(json!({"kind": "normal_forces", "statistic": "standard_deviation"})).abs() < 1e-14);
    for contacts in ["particles", "bodies", "all"] {
        let mean = state.number(json!({"kind": "mobilisation", "statistic": "mean", "contacts": contacts}));
        assert!((mean - 1.2 / 1.5).abs() < 1e-14);
    }
    let mut sliding = state.clone();
    sliding.force[1][2] = 1.499;
    let share = sliding.number(json!({"kind": "mobilisation", "statistic": "sliding_share", "contacts": "all"}));
    assert!((share - 1.0 / 3.0).abs() < 1e-15);
    let density = state.list(json!({"kind": "normal_force_distribution", "count": 4, "up_to": 2}));
    assert_eq!(density.iter().sum::<f64>() * 0.5, 1.0, "{density:?}");
    let mut pulled = state;
    pulled.force[0] = [-1.0, 0.0, 0.0];
    assert_eq!(pulled.number(json!({"kind": "normal_forces", "statistic": "negative_share"})), 1.0);
}

#[test]
fn wall_loads_of_the_bodies_and_of_their_contacts_are_equal() {
    let state = pressed();
    let stress = state.number(json!({"kind": "wall_stress", "body": "left", "direction": [-2, 0, 0]}));
    assert!((stress - 3.0 / 16.0).abs() < 1e-15);
    assert_eq!(state.number(json!({"kind": "wall_force", "body": "right", "direction": [0, 0, 1]})), 1.2);
    assert!((state.number(json!({"kind": "distance", "between": ["left", "right"]})) - 1.98).abs() < 1e-15);
    let bins = json!({"axis": "z", "from": 0, "to": 4, "width": 0.5});
    for (component, total) in [("normal", 3.0), ("shear", 1.2)] {
        let kind = json!({"kind": "wall_stress_profile", "body": "right", "component": component, "bins": bins});
        let profile = state.list(kind);
        assert!((profile.iter().sum::<f64>() * 0.5 * 4.0 - total).abs() < 1e-14);
        // The second sphere is at z = 5, that is at 1 in the periodic box.
        assert!((profile[2] * 2.0 - total).abs() < 1e-14, "{profile:?}");
    }
    let whole = state.number(json!({"kind": "wall_mobilisation", "body": "left", "direction": [0, 0, 1]}));
    assert!((whole - 0.8).abs() < 1e-15);
    let slabs = state.list(json!({"kind": "wall_mobilisation_profile", "body": "left", "bins": bins}));
    assert!((slabs[2] - 0.8).abs() < 1e-15 && slabs[1].is_nan());
}

#[test]
fn shares_of_the_weight_are_those_of_the_forces() {
    let mut state = pressed();
    let weight = 2.0 * state.system["mass"][0].as_f64().unwrap() * 9.81;
    state.body_force = vec![[-3.0, 0.0, -0.25 * weight], [3.0, 0.0, -0.75 * weight]];
    let share = |bodies: Value| state.number(json!({"kind": "weight_share", "bodies": bodies}));
    assert!((share(json!(["left"])) - 0.25).abs() < 1e-14);
    assert!((share(json!(["left", "right"])) - 1.0).abs() < 1e-14);
    state.velocity = vec![[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]];
    let energy = state.number(json!({"kind": "kinetic_energy", "part": "translational"}));
    assert!((energy - 0.5 / 9.81).abs() < 1e-15, "v^2 / 2 over g d");
    let kinetic = state.list(json!({"kind": "stress_tensor", "region": everything(), "part": "kinetic"}));
    assert!((kinetic[0] - weight / 9.81 / (1.98 * 16.0)).abs() < 1e-12 && kinetic[4] == 0.0);
}

#[test]
fn momentum_is_missing_where_a_force_is() {
    let system = System::parse(&pressed().system.to_string()).unwrap();
    let mass: f64 = system.mass.iter().sum();
    let weight = mass * 9.81;
    // Free fall of both, then a floor that carries all of it.
    let time = [0.0, 0.1, 0.2];
    let fall = |t: f64| [0.0, 0.0, -9.81 * t];
    let velocity: Vec<Row> = time.iter().flat_map(|t| [fall(*t); 2]).collect();
    let position = [[0.495, 1.0, 1.0], [1.485, 1.0, 1.0]].repeat(3);
    let named = |name: &str, kind: Value| Named { name: name.to_owned(), measure: measure(kind) };
    let asked = [
        named("change", json!({"kind": "momentum_change", "samples": 2})),
        named("residual", json!({"kind": "momentum_residual"})),
    ];
    let force = vec![[0.0; 3]; 6];
    let mut body_force = vec![[0.0; 3]; 6];
    let measured = |body_force: &[Row]| {
        let columns = Columns {
            time: &time,
            position: &position,
            velocity: Some(&velocity),
            force: Some(&force),
            body_force: Some(body_force),
            ..Columns::default()
        };
        series(&asked, &system, &columns).unwrap()
    };
    let free = measured(&body_force);
    assert!(free[0].values[0] == 0.0 && free[0].values[1..].iter().all(|value| *value < 1e-15), "{:?}", free[0]);
    assert_eq!(free[1].values, [0.0; 3]);
    body_force[3][2] = -weight;
    let wrong = measured(&body_force);
    assert!((wrong[0].values[2] - 0.5).abs() < 1e-14, "half of the window lacks a force: {:?}", wrong[0]);
    assert!((wrong[1].values[1] - 1.0).abs() < 1e-14);
}

#[test]
fn means_cover_the_last_share_of_a_stage() {
    let values = (0..11).map(f64::from).collect();
    let of = Series { name: "it".to_owned(), unit: "-", width: None, values };
    assert_eq!(of.mean(0..11, 0.0), [10.0]);
    assert_eq!(of.mean(0..11, 0.2), [9.0]);
    assert_eq!(of.mean(0..11, 1.0), [5.0]);
    assert_eq!(of.mean(2..5, 0.5), [3.5]);
    assert!(of.mean(3..3, 1.0)[0].is_nan());
    let list = Series { width: Some(2), ..of };
    assert_eq!(list.mean(0..2, 1.0), [1.0, 2.0]);
}

#[test]
fn what_a_record_lacks_is_named_and_never_zero() {
    let state = pressed();
    let system = System::parse(&state.system.to_string()).unwrap();
    let bare = Columns { time: &[0.0], position: &state.position, ..Columns::default() };
    let bins = json!({"axis": "z", "from": 0, "to": 4, "width": 1});
    let cases = [
        (json!({"kind": "normal_forces", "statistic": "mean"}), "contacts"),
        (json!({"kind": "normal_force_distribution", "count": 3, "up_to": 3}), "contacts"),
        (json!({"kind": "mobilisation", "statistic": "mean", "contacts": "all"}), "contacts"),
        (json!({"kind": "stress_tensor", "region": {"kind": "everything"}, "part": "contacts"}), "contacts"),
        (json!({"kind": "stress_tensor", "region": {"kind": "everything"}, "part": "kinetic"}), "column velocity"),
        (json!({"kind": "wall_stress_profile", "body": "left", "component": "normal", "bins": bins}), "contacts"),
        (json!({"kind": "wall_mobilisation", "body": "left", "direction": [0, 0, 1]}), "contacts"),
        (json!({"kind": "wall_force", "body": "left", "direction": [0, 0, 1]}), "column body_force"),
        (json!({"kind": "weight_share", "bodies": ["left"]}), "column body_force"),
        (json!({"kind": "momentum_residual"}), "column body_force"),
        (json!({"kind": "kinetic_energy", "part": "total"}), "column velocity"),
        (json!({"kind": "temperature", "region": {"kind": "everything"}}), "temperatures"),
        (json!({"kind": "wall_force", "body": "lid", "direction": [0, 0, 1]}), "no such body (known: left, right)"),
        (json!({"kind": "rattler_share", "region": {"kind": "everything"}, "least_contacts": 0}), "from 1 to 12"),
    ];
    for (kind, expected) in cases {
        let named = Named { name: "it".to_owned(), measure: measure(kind.clone()) };
        let message = series(&[named], &system, &bare).unwrap_err().to_string();
        assert!(message.starts_with("observable it: ") && message.contains(expected), "{kind}: {message}");
    }
}

#[test]
fn columns_that_do_not_fit_are_refused() {
    let state = pressed();
    let system = System::parse(&state.system.to_string()).unwrap();
    let refused = |columns: Columns, expected: &str| {
        let message = series(&[], &system, &columns).unwrap_err().to_string();
        assert!(message.contains(expected), "{message}");
    };
    let good = Columns { time: &[0.0], position: &state.position, ..Columns::default() };
    refused(Columns { time: &[0.0, 1.0], ..good }, "position has 2 rows, expected 2 samples of 2");
    refused(Columns { body_force: Some(&state.body_force[..1]), ..good }, "body_force has 1 rows");
    refused(Columns { position: &[[f64::NAN; 3]; 2], ..good }, "position of particle 0 in sample 0 is not finite");
    let contacts = |start, pair| Some(ContactColumns { start, pair, force: &state.force });
    refused(Columns { contacts: contacts(&[0, 2], &state.pair), ..good }, "contact_start must have 2 values");
    refused(Columns { contacts: contacts(&[0, 3], &[[0, 1], [0, 4], [1, 1]]), ..good }, "contact_pair.1 = [0, 4]");
    refused(Columns { contacts: contacts(&[0, 2], &state.pair[..2]), ..good }, "contact_force has 3 rows");
}

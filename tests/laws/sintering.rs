//! The law of long-time sintering: rows T3, T5, T6, T8 and T23ix of its specification, and its invariants.

use crossgrain::laws::normal::luding_sintering::{Brittle, Cooling, LudingSintering, Sliding};
use crossgrain::laws::{Approach, NormalLaw, NormalState, PairLaw, Surroundings};
use proptest::prelude::*;

/// k1, k2 and kc [N/m], fluid overlap [m], temperatures [K]: table 1 of the paper.
const LOADING: f64 = 1e5;
const UNLOADING: f64 = 2e5;
const FLUID: f64 = 2e-4;
const LIMIT: f64 = 4e-4;
const CELSIUS: f64 = 273.15;

fn law(cooling: Cooling) -> LudingSintering {
    LudingSintering {
        k1: LOADING,
        k2: UNLOADING,
        kc: 1e5,
        fluid_overlap: FLUID,
        dashpot: 0.0,
        melting_temperature: 120.0 + CELSIUS,
        melting_range: 10.0,
        relaxation_time: 1e3,
        cooling,
        sliding: Sliding::Off,
    }
}

fn at(overlap: f64) -> Approach {
    Approach { overlap, normal_velocity: 0.0, radii: [1e-3; 2], at_body: false }
}

/// The state of a contact at an overlap [m], with k1(T,t) [N/m] one step ago and now.
fn evaluate(law: &LudingSintering, overlap: f64, [before, now]: [f64; 2], largest: &mut f64) -> NormalState {
    let pair = PairLaw { cohesive: true, ..PairLaw::default() };
    let shared = (now, before);
    if law.renews(&shared) {
        law.renew(&shared, largest);
    }
    law.evaluate(&pair, &at(overlap), &shared, largest)
}

fn close(left: f64, right: f64, bound: f64) -> bool {
    (left - right).abs() <= bound * right.abs()
}

#[test]
fn unloading_stiffness_is_linear_up_to_the_fluid_limit() {
    let branches = law(Cooling::Lagged).branches();
    for share in [0.0, 0.1, 0.35, 0.8, 1.0, 1.5, 3.0] {
        let expected = LOADING + (UNLOADING - LOADING) * f64::min(share, 1.0);
        assert!(close(branches.stiffness(share * LIMIT), expected, 1e-12));
    }
    // The cold offset at the limit is the fluid overlap.
    assert!(close(law(Cooling::Lagged).offset(LIMIT, LOADING), FLUID, 1e-12));
}

#[test]
fn cohesion_grows_with_the_unloading_stiffness() {
    let law = law(Cooling::Lagged);
    let slope = |largest: f64| {
        let mut memory = largest;
        let small = 1e-3 * largest;
        let force = evaluate(&law, small, [LOADING; 2], &mut memory).elastic;
        // On the limit, the force is that of the branch that the contact has fallen to.
        assert!(close(force, -0.5 * law.branches().stiffness(memory) * small, 1e-12));
        evaluate(&law, 0.5 * largest, [LOADING; 2], &mut largest.clone()).pull_off / largest
    };
    assert!(slope(0.8 * LIMIT) > slope(0.4 * LIMIT));
}

#[test]
fn the_fluid_branch_comes_first_and_keeps_what_it_remembers() {
    let law = law(Cooling::Lagged);
    let hot = law.softened(140.0 + CELSIUS);
    // The offset of the hot contact passes the fluid overlap at 0.2033 mm, where K is 1.508e5 N/m.
    let mut largest = 2.1e-4;
    let stiffness = law.branches().stiffness(largest);
    for overlap in [1.99e-4, 2.05e-4, 2.6e-4, 3.5e-4] {
        let state = evaluate(&law, overlap, [hot; 2], &mut largest);
        assert!(close(state.elastic, stiffness * (overlap - FLUID), 1e-12));
        assert!(close(largest, 2.1e-4, 1e-15));
    }
    let onset = law.largest(FLUID, hot);
    assert!(close(onset, 2.033e-4, 1e-2) && close(law.branches().stiffness(onset), 1.507e5, 1e-3));
}

#[test]
fn heating_leaves_what_a_contact_remembers() {
    let law = law(Cooling::Lagged);
    let mut largest = 8.3e-5;
    let cold = law.offset(largest, LOADING);
    let mut loading = LOADING;
    for _ in 0..50 {
        let next = 0.97 * loading;
        evaluate(&law, 8.2e-5, [loading, next], &mut largest);
        loading = next;
    }
    assert!(close(largest, 8.3e-5, 1e-15));
    assert!(law.offset(largest, loading) > cold);
}

/// Cools a contact from what 1 s at 140 °C leaves of k1 to that of 80 °C in `steps`.
fn cooled(law: &LudingSintering, start: f64, steps: u32) -> [f64; 4] {
    let (hot, cold) = (0.01978 * LOADING, law.softened(80.0 + CELSIUS));
    let (mut largest, mut loading) = (start, hot);
    for step in 1..=steps {
        let next = hot + (cold - hot) * f64::from(step) / f64::from(steps);
        largest = law.cooled(largest, loading, next);
        loading = next;
    }
    [hot, cold, law.offset(start, hot), largest]
}

#[test]
fn implicit_cooling_keeps_the_offset() {
    let law = law(Cooling::Implicit);
    for start in [1e-6, 8.3e-5, 1.5e-4, 2.0e-4] {
        let [_, cold, offset, largest] = cooled(&law, start, 1000);
        assert!(close(law.offset(largest, cold), offset, 1e-12), "{start}");
    }
}

#[test]
fn lagged_cooling_keeps_its_invariant_to_first_order() {
    let law = law(Cooling::Lagged);
    let invariant = |loading: f64, largest: f64| {
        (LOADING - loading) * largest + 0.5 * (UNLOADING - LOADING) / LIMIT * largest * largest
    };
    let error = |steps: u32| {
        let [hot, cold, _, largest] = cooled(&law, 8.3e-5, steps);
        assert!(largest < LIMIT);
        (invariant(cold, largest) / invariant(hot, 8.3e-5) - 1.0).abs()
    };
    assert!(error(10_000) < 1e-3, "{}", error(10_000));
    let ratio = error(1_000) / error(10_000);
    assert!((8.0..12.0).contains(&ratio), "{ratio}");
    // The offset itself grows: 8.16e-5 to 1.077e-4 m.
    let [_, cold, offset, largest] = cooled(&law, 8.3e-5, 100_000);
    assert!(close(offset, 8.16e-5, 1e-3) && close(law.offset(largest, cold), 1.077e-4, 1e-3));
}

#[test]
fn a_fluid_contact_keeps_its_largest_overlap_when_it_cools() {
    // Its offset is the fluid overlap, which the cold contact reaches at l: what is beyond l has nothing to keep.
    for cooling in [Cooling::Lagged, Cooling::Implicit] {
        let [_, cold, _, largest] = cooled(&law(cooling), 1.5 * LIMIT, 1000);
        assert!(close(largest, 1.5 * LIMIT, 1e-15));
        assert!(law(cooling).offset(largest, cold) >= FLUID);
    }
}

/// k1(T,t) after `time` [s] at a temperature [K] in steps of `dt` [s], from the cold value.
fn relaxed(law: &LudingSintering, start: f64, temperature: f64, relaxation: f64, time: f64, dt: f64) -> f64 {
    let here = Surroundings { temperature, temperature_before: temperature, relaxation_time: Some(relaxation) };
    (0..(time / dt).round() as u64).fold(start, |now, _| law.relaxed(now, &here, dt))
}

#[test]
fn stiffness_relaxes_as_the_closed_form() {
    let law = law(Cooling::Lagged);
    let temperature = 118.0 + CELSIUS;
    let (start, target) = (law.softened(20.0 + CELSIUS), law.softened(temperature));
    for time in [1.0, 10.0, 100.0, 1000.0] {
        // Equation 11 with t0 = 10 s.
        let exact = target * (1.0 - 1.0 / (1.0 / (1.0 - start / target) - time / 10.0));
        assert!(close(relaxed(&law, start, temperature, 10.0, time, 0.01), exact, 1e-3), "{time}");
    }
    assert!(relaxed(&law, start, temperature, 10.0, 1000.0, 0.01) <= 1.02 * target);
}

#[test]
fn the_first_rate_rises_with_temperature() {
    let law = law(Cooling::Lagged);
    let mut last = 0.0;
    // (k1(T) - k1)^2 / (k1(T) k1), from the cold stiffness, as the specification tabulates it.
    for (temperature, tabulated) in [(118.0, 0.27), (140.0, 53.6), (160.0, 2980.0)] {
        let dt = 1e-9;
        let now = relaxed(&law, LOADING, temperature + CELSIUS, 0.1, dt, dt);
        let rate = (LOADING - now) / dt * 0.1 / LOADING;
        let target = law.softened(temperature + CELSIUS) / LOADING;
        assert!(close(rate, (target - 1.0) * (target - 1.0) / target, 1e-2), "{temperature}: {rate}");
        assert!(close(rate, tabulated, 1e-2), "{temperature}: {rate}");
        assert!(rate > last);
        last = rate;
    }
}

#[test]
fn the_protocol_brings_the_tabulated_stiffness() {
    let law = law(Cooling::Lagged);
    let tabulated =
        [(1e-4, 0.94848), (0.01, 0.16999), (0.02, 0.10037), (0.05, 0.05269), (0.2, 0.02690), (1.0, 0.01978)];
    for (sintering, expected) in tabulated {
        let (dt, mut shared) = (1e-5, (0.0, 0.0));
        let temperature = |t: f64| {
            let heated = ((t - 0.2) / 0.1).clamp(0.0, 1.0) - ((t - 0.3 - sintering) / 0.1).clamp(0.0, 1.0);
            80.0 + 60.0 * heated + CELSIUS
        };
        let mut hot = 0.0;
        for step in 0..((0.5 + sintering) / dt).round() as u64 {
            let t = step as f64 * dt;
            let sinters = t >= 0.3 && t < 0.3 + sintering - 0.5 * dt;
            let surroundings = Surroundings {
                temperature: temperature(t),
                temperature_before: temperature((t - dt).max(0.0)),
                relaxation_time: Some(if sinters { 0.1 } else { 1e3 }),
            };
            law.advance(&mut shared, &surroundings, dt);
            if sinters {
                hot = shared.0;
            }
        }
        assert!(close(hot / LOADING, expected, 1e-2), "{sintering}: {}", hot / LOADING);
        assert!(shared.0 / LOADING >= 0.999, "{sintering}: {}", shared.0 / LOADING);
    }
}

#[test]
fn a_sliding_contact_does_not_pull() {
    let pulled = |sliding: Sliding| {
        let law = LudingSintering { sliding, ..law(Cooling::Lagged) };
        let mut largest = 3e-4;
        let shared = (LOADING, LOADING);
        let state = evaluate(&law, 1e-4, [LOADING; 2], &mut largest);
        assert!(state.elastic < 0.0);
        let finished = if sliding == Sliding::Brittle {
            Brittle(law).finish(state, true, 1e-4, &shared, &mut largest)
        } else {
            law.finish(state, true, 1e-4, &shared, &mut largest)
        };
        (finished.force, largest)
    };
    let (force, largest) = pulled(Sliding::Cut);
    assert!(force.to_bits() == 0 && close(largest, 3e-4, 1e-15));
    let (force, largest) = pulled(Sliding::Brittle);
    let law = law(Cooling::Lagged);
    assert!(force.to_bits() == 0 && close(law.offset(largest, LOADING), 1e-4, 1e-12));
    assert!(pulled(Sliding::Off).0 < 0.0);
}

proptest! {
    #[test]
    fn what_has_an_offset_is_found_from_it(largest in 1e-9..6e-4f64, share in 0.01..0.9999f64) {
        let law = law(Cooling::Implicit);
        let loading = share * LOADING;
        let found = law.largest(law.offset(largest, loading), loading);
        prop_assert!(close(found, largest, 1e-9), "{} {}", found, largest);
    }

    #[test]
    fn no_energy_is_gained_on_a_closed_path(
        turns in proptest::collection::vec(0.0..1.0f64, 1..8),
        share in 0.05..1.0f64,
    ) {
        let law = law(Cooling::Lagged);
        let loading = share * LOADING;
        let (mut largest, mut work, mut scale, mut overlap, mut last) = (0.0, 0.0, 1e-15, 1e-9f64, 0.0);
        for target in turns.iter().map(|turn| 1e-9 + turn * 5e-4).chain([1e-9]) {
            let from = overlap;
            for step in 1..=4000 {
                let next = from + (target - from) * f64::from(step) / 4000.0;
                let force = evaluate(&law, next, [loading; 2], &mut largest).elastic;
                prop_assert!(force <= UNLOADING * next && force >= -UNLOADING * next);
                work += 0.5 * (force + last) * (next - overlap);
                (last, overlap) = (force, next);
                scale = work.max(scale);
            }
        }
        prop_assert!(work > -1e-3 * scale, "{} {}", work, scale);
    }
}

//! Materials, pairs, and what the laws of the model ask of them.

use super::Checker;
use crate::case::model::{
    Damping, HeatLaw, MomentLaw, NormalLaw, RollingDashpot, RollingStiffness, Tail, TangentialLaw, Twisting, Unloading,
};
use crate::case::quantity::Quantity;
use crate::case::schema::{Material, Pair};
use crate::case::tag;

/// Laws that are Hertz or built on it.
fn elastic(law: &NormalLaw) -> bool {
    matches!(
        law,
        NormalLaw::Hertz { .. }
            | NormalLaw::Jkr {}
            | NormalLaw::Dmt { .. }
            | NormalLaw::Sjkr { .. }
            | NormalLaw::Sjkr2 { .. }
    )
}

impl Checker<'_> {
    fn needs_elasticity(&self) -> bool {
        let model = &self.case.model;
        elastic(&model.normal) || matches!(model.tangential, TangentialLaw::Mindlin { .. })
    }

    pub(super) fn model(&mut self) {
        let model = &self.case.model;
        let key = |name: &str| format!("model.normal.{name}");
        match &model.normal {
            NormalLaw::Hertz { .. } | NormalLaw::Jkr {} | NormalLaw::Dmt { .. } => {}
            NormalLaw::Sjkr { energy_density, .. } | NormalLaw::Sjkr2 { energy_density, .. } => {
                self.not_negative(key("energy_density"), *energy_density);
            }
            NormalLaw::LudingHysteretic { k1, kp, kc, plasticity_depth, dashpot, .. } => {
                self.positive(key("k1"), *k1);
                if kp <= k1 {
                    self.add(key("kp"), format!("{kp:?}"), format!("must be above k1 = {k1:?}"));
                }
                self.not_negative(key("kc"), *kc);
                self.number(key("plasticity_depth"), *plasticity_depth, |value| value > 0.0, "must be positive");
                self.not_negative(key("dashpot"), *dashpot);
            }
            NormalLaw::LinearSpringDashpot { stiffness, dashpot, .. } => {
                self.positive(key("stiffness"), *stiffness);
                self.not_negative(key("dashpot"), *dashpot);
            }
            NormalLaw::LudingSintering {
                k1, k2, kc, fluid_overlap, dashpot, melting_range, relaxation_time, ..
            } => {
                self.positive(key("k1"), *k1);
                if k2 <= k1 {
                    self.add(key("k2"), format!("{k2:?}"), format!("must be above k1 = {k1:?}"));
                }
                self.not_negative(key("kc"), *kc);
                self.positive(key("fluid_overlap"), *fluid_overlap);
                self.not_negative(key("dashpot"), *dashpot);
                self.positive(key("melting_range"), *melting_range);
                self.positive(key("relaxation_time"), *relaxation_time);
            }
            NormalLaw::WaltonCohesive { pull_off, build_up, soften, unloading, tail, damping_ratio } => {
                self.not_negative(key("pull_off"), *pull_off);
                self.number(key("build_up"), *build_up, |value| (0.0..1.0).contains(&value), "lies in [0, 1)");
                self.number(key("soften"), *soften, |value| value > 0.0 && value <= 1.0, "lies in (0, 1]");
                if let Unloading::ConstantRatio { value } = unloading {
                    self.number(key("unloading.value"), *value, |value| value >= 1.0, "must be at least 1");
                }
                match tail {
                    Tail::None {} => {}
                    Tail::Linear { length, .. } => self.positive(key("tail.length"), *length),
                    Tail::VanDerWaals { cut_off, .. } => self.positive(key("tail.cut_off"), *cut_off),
                }
                self.number(key("damping_ratio"), *damping_ratio, |value| value >= 0.0, "must not be negative");
            }
        }
        self.partners();
        self.moments();
        if let Some(HeatLaw::ConductionAndRadiation { emissivity, reach }) = &model.heat {
            let allowed = |value| value > 0.0 && value <= 1.0;
            self.number("model.heat.emissivity", *emissivity, allowed, "lies in (0, 1]");
            self.number("model.heat.reach", *reach, |value| value >= 1.0, "must be at least 1");
        }
    }

    /// Values of a rolling spring.
    fn moments(&mut self) {
        let MomentLaw::ElasticPlasticRolling { stiffness, dashpot, twisting, .. } = &self.case.model.moments else {
            return;
        };
        let key = |name: &str| format!("model.moments.{name}");
        match stiffness {
            RollingStiffness::Tangential {} => {}
            RollingStiffness::Constant { value }
            | RollingStiffness::PerRadiusSquared { value }
            | RollingStiffness::Normal { value } => {
                self.number(key("stiffness.value"), *value, |value| value > 0.0, "must be positive");
            }
        }
        match dashpot {
            RollingDashpot::None {} => {}
            RollingDashpot::CriticalShare { value } | RollingDashpot::PerRadiusSquared { value } => {
                self.number(key("dashpot.value"), *value, |value| value >= 0.0, "must not be negative");
            }
        }
        if let Twisting::Constant { stiffness, dashpot, arm } = twisting {
            self.number(key("twisting.stiffness"), *stiffness, |value| value > 0.0, "must be positive");
            self.number(key("twisting.dashpot"), *dashpot, |value| value >= 0.0, "must not be negative");
            if let Some(arm) = arm {
                self.positive(key("twisting.arm"), *arm);
            }
        }
    }

    /// Tangential and moment laws that stand only beside one normal law.
    fn partners(&mut self) {
        let model = &self.case.model;
        let normal = tag(&model.normal, "law");
        let wanted = match &model.tangential {
            TangentialLaw::LudingSintering { .. } => "luding_sintering",
            TangentialLaw::WaltonFriction { .. } => "walton_cohesive",
            TangentialLaw::Frictionless {} | TangentialLaw::Mindlin { .. } | TangentialLaw::LinearHistory { .. } => {
                &normal
            }
        };
        if wanted != normal {
            let allowed = format!("stands beside the normal law `{wanted}`, not `{normal}`");
            self.add("model.tangential.law", tag(&model.tangential, "law"), allowed);
        }
        if matches!(model.moments, MomentLaw::WaltonBendingTwisting { .. }) && normal != "walton_cohesive" {
            let allowed = format!("stands beside the normal law `walton_cohesive`, not `{normal}`");
            self.add("model.moments.law", tag(&model.moments, "law"), allowed);
        }
    }

    pub(super) fn materials(&mut self) {
        let case = self.case;
        for (i, material) in case.materials.iter().enumerate() {
            self.material(i, material);
        }
        self.distinct("materials", case.materials.iter().map(|material| &material.name));
    }

    fn material(&mut self, i: usize, material: &Material) {
        let key = |name: &str| format!("materials.{i}.{name}");
        if material.rigid {
            if material.young.is_some() || material.poisson.is_some() || material.density.is_some() {
                self.add(key("rigid"), true, "a rigid material has no young, poisson or density");
            }
        } else {
            let elastic = self.needs_elasticity();
            let plastic = matches!(self.case.model.normal, NormalLaw::WaltonCohesive { .. });
            let required = [
                ("density", material.density.is_none()),
                ("young", elastic && material.young.is_none()),
                ("poisson", elastic && material.poisson.is_none()),
                ("yield_strength", plastic && material.yield_strength.is_none()),
            ];
            for (name, _) in required.into_iter().filter(|(_, missing)| *missing) {
                self.add(key(name), "nothing", "the laws of the model need it, or the material is rigid = true");
            }
        }
        for (name, value) in [("young", material.young), ("yield_strength", material.yield_strength)] {
            if let Some(value) = value {
                self.positive(key(name), value);
            }
        }
        if let Some(density) = material.density {
            self.positive(key("density"), density);
        }
        if let Some(poisson) = material.poisson {
            self.number(key("poisson"), poisson, |value| value > -1.0 && value < 0.5, "must lie between -1 and 0.5");
        }
        self.thermal(i, material);
    }

    fn thermal(&mut self, i: usize, material: &Material) {
        let key = |name: &str| format!("materials.{i}.thermal.{name}");
        let heat = self.case.model.heat.is_some();
        let Some(thermal) = &material.thermal else {
            if heat {
                self.add(format!("materials.{i}.thermal"), "nothing", "[model.heat] needs it of every material");
            }
            return;
        };
        self.positive(key("reference_temperature"), thermal.reference_temperature);
        let given = [
            ("conductivity", thermal.conductivity.map(Quantity::si)),
            ("heat_capacity", thermal.heat_capacity.map(Quantity::si)),
            ("contact_young", thermal.contact_young.map(Quantity::si)),
        ];
        for (name, value) in given {
            match value {
                Some(value) if value <= 0.0 => self.add(key(name), value, "must be positive"),
                None if heat && !material.rigid => self.add(key(name), "nothing", "[model.heat] needs it"),
                _ => {}
            }
        }
    }

    pub(super) fn pairs(&mut self) {
        let case = self.case;
        for (i, pair) in case.pairs.iter().enumerate() {
            self.between(&format!("pairs.{i}.between"), &pair.between);
            let same = |other: &Pair| {
                let [a, b] = &pair.between;
                other.between == [a.clone(), b.clone()] || other.between == [b.clone(), a.clone()]
            };
            if case.pairs[..i].iter().any(same) {
                self.add(format!("pairs.{i}.between"), pair.between.join(", "), "stated before; each pair stands once");
            }
            self.pair_needs(i, pair);
            self.pair_values(&format!("pairs.{i}.values"), &pair.values);
        }
    }

    /// Two names of materials that have a contact law.
    pub(super) fn between(&mut self, key: &str, names: &[String; 2]) {
        let mut rigid = 0;
        for (side, name) in names.iter().enumerate() {
            self.known_material(format!("{key}.{side}"), name);
            rigid += usize::from(self.is_rigid(name));
        }
        if rigid == 2 {
            self.add(key, names.join(", "), "two rigid materials have no contact law");
        }
    }

    /// What the laws of the model ask of every pair.
    fn pair_needs(&mut self, i: usize, pair: &Pair) {
        let (model, values) = (&self.case.model, &pair.values);
        let elastic = elastic(&model.normal);
        let sticky = matches!(model.normal, NormalLaw::Jkr {} | NormalLaw::Dmt { .. });
        let sintering = matches!(model.normal, NormalLaw::LudingSintering { .. });
        let frictional = !matches!(model.tangential, TangentialLaw::Frictionless {});
        let rolling =
            matches!(model.moments, MomentLaw::ElasticPlasticRolling { .. } | MomentLaw::ConstantTorque { .. });
        let (normal, tangential) = (tag(&model.normal, "law"), tag(&model.tangential, "law"));
        let damping = "{ kind = \"none\" | \"restitution\" | \"ratio\" }";
        let needs = [
            ("damping", elastic && values.damping.is_none(), &normal, damping),
            ("work_of_adhesion", sticky && values.work_of_adhesion.is_none(), &normal, "an energy per area"),
            ("cohesive", sintering && values.cohesive.is_none(), &normal, "true or false"),
            ("friction", frictional && values.friction.is_none(), &tangential, "a coefficient"),
            (
                "rolling_friction",
                rolling && values.rolling_friction.is_none(),
                &tag(&model.moments, "law"),
                "a coefficient",
            ),
        ];
        for (name, missing, law, what) in needs {
            if missing {
                self.add(format!("pairs.{i}.values.{name}"), "nothing", format!("the law `{law}` needs it: {what}"));
            }
        }
    }

    pub(super) fn pair_values(&mut self, at: &str, values: &crate::case::model::PairValues) {
        match &values.damping {
            Some(Damping::Restitution { value }) => {
                let allowed = |value| (0.0..=1.0).contains(&value);
                self.number(format!("{at}.damping.value"), *value, allowed, "a restitution lies in [0, 1]");
            }
            Some(Damping::Ratio { value }) => {
                self.number(format!("{at}.damping.value"), *value, |value| value >= 0.0, "must not be negative");
            }
            Some(Damping::None {}) | None => {}
        }
        let coefficients = [
            ("friction", values.friction),
            ("rolling_friction", values.rolling_friction),
            ("twisting_friction", values.twisting_friction),
        ];
        for (name, value) in coefficients {
            if let Some(value) = value {
                self.number(format!("{at}.{name}"), value, |value| value >= 0.0, "must not be negative");
            }
        }
        if let Some(value) = values.work_of_adhesion {
            self.not_negative(format!("{at}.work_of_adhesion"), value);
        }
    }
}

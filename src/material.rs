//! Materials and the only place of mixing rules.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | E, G | Young's and shear modulus of a solid, G = E / (2 (1 + nu)) | Pa |
//! | nu | Poisson's ratio | - |
//! | rho | density | kg/m3 |
//! | E*, G* | effective moduli of a pair | Pa |
//! | R*, m* | effective radius and mass of a pair | m, kg |
//! | beta | fraction of critical damping | - |
//!
//! Sources: Johnson, *Contact Mechanics* (1985), eqs. 4.23 and 7.43 for E* and G*; Thornton, *Granular Dynamics,
//! Contact Mechanics and Particle System Simulations* (2015) for the Rayleigh time.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use crate::laws::PairLaw;

/// A solid, or an ideal one that does not deform.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Name.
    pub name: String,
    /// An ideal solid of infinite stiffness; the other values are then absent.
    pub rigid: bool,
    /// Young's modulus [Pa].
    pub young: Option<f64>,
    /// Poisson's ratio [-].
    pub poisson: Option<f64>,
    /// Density [kg/m3].
    pub density: Option<f64>,
    /// Thermal expansion of radii, where it has one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub expansion: Option<Expansion>,
}

/// Linear thermal expansion: a(T) = a(`T_r`) (1 + e (T - `T_r`)), whatever the mass.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Expansion {
    /// e [1/K].
    pub coefficient: f64,
    /// `T_r`, at which the case gives the radii [K].
    pub reference_temperature: f64,
}

impl Expansion {
    /// a(T) / a(`T_r`) at a temperature [K].
    #[must_use]
    pub fn factor(&self, temperature: f64) -> f64 {
        1.0 + self.coefficient * (temperature - self.reference_temperature)
    }
}

impl Material {
    /// Normal compliance (1 - nu^2) / E [1/Pa]; zero for a rigid solid.
    #[must_use]
    pub fn normal_compliance(&self) -> f64 {
        match (self.young, self.poisson) {
            (Some(young), Some(poisson)) if !self.rigid => (1.0 - poisson * poisson) / young,
            _ => 0.0,
        }
    }

    /// Tangential compliance (2 - nu) / G [1/Pa]; zero for a rigid solid.
    #[must_use]
    pub fn tangential_compliance(&self) -> f64 {
        match (self.young, self.poisson) {
            (Some(young), Some(poisson)) if !self.rigid => 2.0 * (2.0 - poisson) * (1.0 + poisson) / young,
            _ => 0.0,
        }
    }

    /// Time in which a Rayleigh wave runs around a sphere of `radius` [m]: pi R sqrt(rho / G) / (0.1631 nu + 0.8766)
    /// [s]. No explicit integration is stable far above it.
    #[must_use]
    pub fn rayleigh_time(&self, radius: f64) -> Option<f64> {
        let (young, poisson, density) = (self.young?, self.poisson?, self.density?);
        let shear = young / (2.0 * (1.0 + poisson));
        Some(PI * radius * (density / shear).sqrt() / (0.1631 * poisson + 0.8766))
    }
}

/// What two materials make together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PairProperties {
    /// Indices of the two materials.
    pub between: [usize; 2],
    /// E* [Pa].
    pub effective_young: f64,
    /// G* [Pa].
    pub effective_shear: Option<f64>,
    /// Fraction of critical damping beta [-].
    pub damping_ratio: f64,
    /// Restitution as the case asked for it [-], if it did.
    pub restitution: Option<f64>,
    /// Coefficient of friction [-], where a law asks for it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction: Option<f64>,
    /// Coefficient of rolling friction [-], where a law asks for it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rolling_friction: Option<f64>,
    /// Coefficient of twisting friction [-], where a law asks for it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub twisting_friction: Option<f64>,
    /// Work of adhesion W [J/m2], where a law asks for it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub work_of_adhesion: Option<f64>,
    /// Whether the contact may pull, where a law asks for it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cohesive: Option<bool>,
}

impl PairProperties {
    /// What a law sees of a contact of this pair with R* [m] and m* [kg].
    #[must_use]
    #[inline(always)]
    #[allow(clippy::inline_always, reason = "formed anew at every contact")]
    pub fn law(&self, effective_radius: f64, effective_mass: f64) -> PairLaw {
        PairLaw {
            effective_young: self.effective_young,
            effective_shear: self.effective_shear.unwrap_or_default(),
            friction: self.friction.unwrap_or_default(),
            effective_radius,
            effective_mass,
            damping_ratio: self.damping_ratio,
            rolling_friction: self.rolling_friction.unwrap_or_default(),
            twisting_friction: self.twisting_friction.unwrap_or_default(),
            work_of_adhesion: self.work_of_adhesion.unwrap_or_default(),
            cohesive: self.cohesive.unwrap_or_default(),
        }
    }
}

/// 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2 [Pa]; infinite for two rigid solids.
#[must_use]
pub fn effective_young(first: &Material, second: &Material) -> f64 {
    1.0 / (first.normal_compliance() + second.normal_compliance())
}

/// 1/G* = (2 - nu1)/G1 + (2 - nu2)/G2 [Pa]; infinite for two rigid solids.
#[must_use]
pub fn effective_shear(first: &Material, second: &Material) -> f64 {
    1.0 / (first.tangential_compliance() + second.tangential_compliance())
}

/// a b / (a + b): the effective radius or mass of two spheres.
#[must_use]
#[inline(always)]
pub fn reduced(a: f64, b: f64) -> f64 {
    a * b / (a + b)
}

/// beta = -ln e / sqrt(ln^2 e + pi^2), and 1 at e = 0: the fraction of critical damping whose linear oscillator, never
/// cut, rebounds with restitution e. It holds for Hertz with the dashpot of [`crate::laws::normal::hertz`] too, because
/// overlap^(5/4) obeys a linear equation (Antypov, Elliott, *EPL* 94 (2011) 50004).
#[must_use]
pub fn damping_ratio(restitution: f64) -> f64 {
    if restitution <= 0.0 {
        return 1.0;
    }
    let logarithm = libm::log(restitution);
    // `0.0 -` and not a sign: e = 1 must give +0.
    (0.0 - logarithm) / (logarithm * logarithm + PI * PI).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn solid(young: f64, poisson: f64) -> Material {
        Material {
            name: "solid".into(),
            rigid: false,
            young: Some(young),
            poisson: Some(poisson),
            density: Some(2500.0),
            expansion: None,
        }
    }

    fn rigid() -> Material {
        Material { name: "wall".into(), rigid: true, young: None, poisson: None, density: None, expansion: None }
    }

    #[test]
    fn equal_solids_mix_to_the_textbook_moduli() {
        let glass = solid(1e7, 0.3);
        let young = effective_young(&glass, &glass);
        let shear = effective_shear(&glass, &glass);
        assert!((young / (1e7 / (2.0 * 0.91)) - 1.0).abs() < 1e-15);
        assert!((shear / (1e7 / (4.0 * 1.7 * 1.3)) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn a_rigid_partner_adds_no_compliance() {
        let glass = solid(1e7, 0.3);
        assert!((effective_young(&glass, &rigid()) / (1e7 / 0.91) - 1.0).abs() < 1e-15);
        assert!(effective_young(&rigid(), &rigid()).is_infinite());
    }

    #[test]
    fn damping_ratio_spans_none_to_critical() {
        assert!(damping_ratio(1.0).to_bits() == 0.0f64.to_bits());
        assert!((damping_ratio(0.0) - 1.0).abs() < 1e-15);
        assert!((damping_ratio(0.5) - 0.215_453_8).abs() < 1e-7);
    }
}

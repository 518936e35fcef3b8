//! Physical quantities of the case file: a number in SI units, or a string such as `"2.5 mm"` whose unit is checked.

use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, Deserializer, Visitor};
use serde::{Deserialize, Serialize, Serializer};

/// Exponents of metre, kilogram, second and kelvin.
type Dimension = [i32; 4];

/// A kind of quantity: its dimension and the SI unit that stands in messages.
pub trait Kind: Copy {
    /// Name of the kind in messages.
    const NAME: &'static str;
    /// The SI unit as written in a case file.
    const UNIT: &'static str;
}

/// A finite number of one kind, in SI units.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
pub struct Quantity<K>(f64, PhantomData<K>);

impl<K: Kind> Quantity<K> {
    /// Wraps an SI value.
    #[must_use]
    pub const fn new(value: f64) -> Self {
        Self(value, PhantomData)
    }

    /// The value in SI units.
    #[must_use]
    pub const fn si(self) -> f64 {
        self.0
    }
}

impl<K: Kind> fmt::Debug for Quantity<K> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.0, K::UNIT)
    }
}

macro_rules! kinds {
    ($($(#[$doc:meta])* $alias:ident, $kind:ident, $name:literal, $unit:literal;)*) => {$(
        #[doc = concat!("Marker of the kind `", $name, "`.")]
        #[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
        pub struct $kind;
        impl Kind for $kind {
            const NAME: &'static str = $name;
            const UNIT: &'static str = $unit;
        }
        $(#[$doc])*
        pub type $alias = Quantity<$kind>;
    )*};
}

kinds! {
    /// A length [m].
    Length, LengthKind, "length", "m";
    /// A time [s].
    Duration, DurationKind, "time", "s";
    /// A speed [m/s].
    Speed, SpeedKind, "speed", "m/s";
    /// An acceleration [m/s2].
    Acceleration, AccelerationKind, "acceleration", "m/s2";
    /// An angular velocity [rad/s].
    AngularSpeed, AngularSpeedKind, "angular speed", "rad/s";
    /// A density [kg/m3].
    Density, DensityKind, "density", "kg/m3";
    /// A pressure or a modulus [Pa].
    Pressure, PressureKind, "pressure", "Pa";
    /// A mass [kg].
    Mass, MassKind, "mass", "kg";
    /// A stiffness, or a stress of two dimensions [N/m].
    Stiffness, StiffnessKind, "stiffness", "N/m";
    /// A dashpot constant [kg/s].
    Dashpot, DashpotKind, "dashpot constant", "kg/s";
    /// A force [N].
    Force, ForceKind, "force", "N";
    /// An energy per area [J/m2].
    SurfaceEnergy, SurfaceEnergyKind, "surface energy", "J/m2";
    /// A temperature [K].
    Temperature, TemperatureKind, "temperature", "K";
    /// A frequency [Hz].
    Frequency, FrequencyKind, "frequency", "Hz";
    /// A thermal conductivity [W/(m K)].
    Conductivity, ConductivityKind, "thermal conductivity", "W/m/K";
    /// A specific heat capacity [J/(kg K)].
    HeatCapacity, HeatCapacityKind, "heat capacity", "J/kg/K";
    /// A coefficient of thermal expansion [1/K].
    Expansion, ExpansionKind, "thermal expansion", "1/K";
}

/// Symbols of units that a case file may use: name, scale to SI, dimension.
const UNITS: &[(&str, f64, Dimension)] = &[
    ("m", 1.0, [1, 0, 0, 0]),
    ("g", 1e-3, [0, 1, 0, 0]),
    ("s", 1.0, [0, 0, 1, 0]),
    ("K", 1.0, [0, 0, 0, 1]),
    ("Hz", 1.0, [0, 0, -1, 0]),
    ("N", 1.0, [1, 1, -2, 0]),
    ("Pa", 1.0, [-1, 1, -2, 0]),
    ("J", 1.0, [2, 1, -2, 0]),
    ("W", 1.0, [2, 1, -3, 0]),
    ("rad", 1.0, [0, 0, 0, 0]),
];

const PREFIXES: &[(&str, i32)] =
    &[("G", 9), ("M", 6), ("k", 3), ("c", -2), ("m", -3), ("u", -6), ("µ", -6), ("n", -9), ("p", -12)];

/// Scale as an exponent of ten times a factor, so that `"48 GPa"` is exactly 48e9.
#[derive(Clone, Copy)]
struct Unit {
    exponent: i32,
    dimension: Dimension,
}

fn symbol(text: &str) -> Option<Unit> {
    let known = |name: &str| UNITS.iter().find(|unit| unit.0 == name);
    let base = |unit: &(&str, f64, Dimension)| Unit { exponent: if unit.0 == "g" { -3 } else { 0 }, dimension: unit.2 };
    if let Some(unit) = known(text) {
        return Some(base(unit));
    }
    PREFIXES.iter().find_map(|(prefix, power)| {
        let unit = base(known(text.strip_prefix(prefix)?)?);
        Some(Unit { exponent: unit.exponent + power, dimension: unit.dimension })
    })
}

/// Reads `kg/m3`, `N/m`, `W/m/K`, `1/K`: factors joined by `*`, `/` or a blank, each with an optional integer power.
fn parse_unit(text: &str) -> Result<Unit, String> {
    let mut total = Unit { exponent: 0, dimension: [0; 4] };
    let mut sign = 1;
    for part in text.split_inclusive(['/', '*', ' ']) {
        let factor = part.trim_end_matches(['/', '*', ' ']);
        let digits = factor.find(|c: char| c.is_ascii_digit() || c == '-' || c == '^');
        let (name, power) = match digits {
            Some(0) if factor == "1" => ("", 1),
            Some(at) => {
                let power = factor[at..].trim_start_matches('^');
                let power: i32 = power.parse().map_err(|_| format!("`{power}` is not a power"))?;
                if !(-9..=9).contains(&power) {
                    return Err(format!("the power {power} is beyond 9"));
                }
                (&factor[..at], power)
            }
            None => (factor, 1),
        };
        if !name.is_empty() {
            let unit = symbol(name).ok_or_else(|| format!("unknown unit `{name}`"))?;
            total.exponent += sign * power * unit.exponent;
            for (sum, exponent) in total.dimension.iter_mut().zip(unit.dimension) {
                *sum += sign * power * exponent;
            }
        }
        sign = if part.ends_with('/') { -1 } else { 1 };
    }
    Ok(total)
}

/// The kind with its article.
fn one(kind: &str) -> String {
    format!("{} {kind}", if kind.starts_with('a') { "an" } else { "a" })
}

/// Reads `"2.5 mm"` as a quantity of the kind whose SI unit is `expected`.
fn parse(text: &str, kind: &str, expected: &str) -> Result<f64, String> {
    let wanted = parse_unit(expected)?;
    let text = text.trim();
    let (number, unit) = text.split_once(' ').unwrap_or((text, ""));
    let number: f64 = number
        .parse()
        .map_err(|_| format!("`{text}` does not start with a number, expected {} such as `1 {expected}`", one(kind)))?;
    if unit.is_empty() {
        return Err(format!("`{text}` has no unit, expected {} such as `1 {expected}`", one(kind)));
    }
    let unit = unit.trim();
    let given =
        parse_unit(unit).map_err(|why| format!("{why} in `{text}`, expected {} such as `1 {expected}`", one(kind)))?;
    if given.dimension != wanted.dimension {
        return Err(format!("`{text}` is not {}, expected a unit such as `{expected}`", one(kind)));
    }
    // One multiplication or division by an exact power of ten keeps decimal input correctly rounded.
    let exponent = given.exponent - wanted.exponent;
    let scale = 10f64.powi(exponent.abs());
    Ok(if exponent >= 0 { number * scale } else { number / scale })
}

struct QuantityVisitor<K>(PhantomData<K>);

impl<K: Kind> Visitor<'_> for QuantityVisitor<K> {
    type Value = Quantity<K>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} in {} or a string such as `1 {}`", one(K::NAME), K::UNIT, K::UNIT)
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<Self::Value, E> {
        if value.is_finite() {
            Ok(Quantity::new(value))
        } else {
            Err(E::custom(format!("{value} is not a finite number, expected {} such as `1 {}`", one(K::NAME), K::UNIT)))
        }
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<Self::Value, E> {
        self.visit_f64(value as f64)
    }

    fn visit_u64<E: de::Error>(self, value: u64) -> Result<Self::Value, E> {
        self.visit_f64(value as f64)
    }

    fn visit_str<E: de::Error>(self, value: &str) -> Result<Self::Value, E> {
        let number = parse(value, K::NAME, K::UNIT).map_err(E::custom)?;
        if number.is_finite() {
            Ok(Quantity::new(number))
        } else {
            Err(E::custom(format!(
                "`{value}` is not a finite number, expected {} such as `1 {}`",
                one(K::NAME),
                K::UNIT
            )))
        }
    }
}

impl<'de, K: Kind> Deserialize<'de> for Quantity<K> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(QuantityVisitor(PhantomData))
    }
}

impl<K: Kind> Serialize for Quantity<K> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_f64(self.0)
    }
}

impl<K: Kind> JsonSchema for Quantity<K> {
    fn schema_name() -> Cow<'static, str> {
        K::NAME.replace(' ', "_").into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": format!("{} in {}, as a number or as a string with a unit.", one(K::NAME), K::UNIT),
            "anyOf": [
                {"type": "number"},
                {"type": "string", "pattern": r"^\s*[-+]?[0-9.]+([eE][-+]?[0-9]+)? [A-Za-zµ0-9*/^ -]+$"},
            ],
        })
    }
}

/// A finite number without a unit [-].
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd, Serialize, JsonSchema)]
#[serde(transparent)]
pub struct Number(f64);

impl Number {
    /// Wraps a value.
    #[must_use]
    pub const fn new(value: f64) -> Self {
        Self(value)
    }

    /// The value [-].
    #[must_use]
    pub const fn get(self) -> f64 {
        self.0
    }
}

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let value = f64::deserialize(deserializer)?;
        if value.is_finite() {
            Ok(Self(value))
        } else {
            Err(de::Error::custom(format!("{value} is not a finite number, expected a number without unit")))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str, kind: &str, unit: &str) -> Result<f64, String> {
        parse(text, kind, unit)
    }

    #[test]
    fn units_scale_to_si_without_rounding_twice() {
        let cases = [
            ("2.5 mm", "m", 2.5e-3),
            ("48 GPa", "Pa", 48e9),
            ("10 um", "m", 1e-5),
            ("2.5 g/cm3", "kg/m3", 2500.0),
            ("0.3 W/m/K", "W/m/K", 0.3),
            ("1e-4 1/K", "1/K", 1e-4),
            ("9.81 m/s2", "m/s2", 9.81),
            ("0.05 N/m", "J/m2", 0.05),
            ("3 rad/s", "Hz", 3.0),
        ];
        for (text, unit, value) in cases {
            assert_eq!(read(text, "quantity", unit), Ok(value), "{text}");
        }
    }

    #[test]
    fn wrong_units_are_named() {
        assert!(read("2 m", "pressure", "Pa").unwrap_err().contains("not a pressure"));
        assert!(read("2 furlong", "length", "m").unwrap_err().contains("unknown unit `furlong`"));
        assert!(read("2", "length", "m").unwrap_err().contains("has no unit"));
        assert!(read("fast", "speed", "m/s").unwrap_err().contains("does not start with a number"));
    }
}

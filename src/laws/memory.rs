//! What a contact or a law remembers, as numbers that a checkpoint can hold.

use crate::Vector;

/// Memory of a fixed number of values; the default is that of a new contact.
pub trait Memory: Copy + Default + Send + Sync + 'static {
    /// Number of values.
    const WIDTH: usize;

    /// Appends the values.
    fn save(&self, into: &mut Vec<f64>);

    /// Takes the values back, in the same order and to the same bits; missing ones are zero.
    fn restore(values: &mut impl Iterator<Item = f64>) -> Self;
}

impl Memory for () {
    const WIDTH: usize = 0;

    fn save(&self, _: &mut Vec<f64>) {}

    fn restore(_: &mut impl Iterator<Item = f64>) -> Self {}
}

impl Memory for f64 {
    const WIDTH: usize = 1;

    fn save(&self, into: &mut Vec<f64>) {
        into.push(*self);
    }

    fn restore(values: &mut impl Iterator<Item = f64>) -> Self {
        values.next().unwrap_or_default()
    }
}

impl Memory for bool {
    const WIDTH: usize = 1;

    fn save(&self, into: &mut Vec<f64>) {
        into.push(f64::from(u8::from(*self)));
    }

    fn restore(values: &mut impl Iterator<Item = f64>) -> Self {
        values.next().unwrap_or_default() > 0.0
    }
}

impl Memory for Vector {
    const WIDTH: usize = 3;

    fn save(&self, into: &mut Vec<f64>) {
        into.extend([self.x, self.y, self.z]);
    }

    fn restore(values: &mut impl Iterator<Item = f64>) -> Self {
        let mut next = || values.next().unwrap_or_default();
        let (x, y, z) = (next(), next(), next());
        Self::new(x, y, z)
    }
}

impl<A: Memory, B: Memory> Memory for (A, B) {
    const WIDTH: usize = A::WIDTH + B::WIDTH;

    fn save(&self, into: &mut Vec<f64>) {
        self.0.save(into);
        self.1.save(into);
    }

    fn restore(values: &mut impl Iterator<Item = f64>) -> Self {
        let first = A::restore(values);
        (first, B::restore(values))
    }
}

impl<A: Memory, B: Memory, C: Memory> Memory for (A, B, C) {
    const WIDTH: usize = A::WIDTH + B::WIDTH + C::WIDTH;

    fn save(&self, into: &mut Vec<f64>) {
        self.0.save(into);
        self.1.save(into);
        self.2.save(into);
    }

    fn restore(values: &mut impl Iterator<Item = f64>) -> Self {
        let first = A::restore(values);
        let second = B::restore(values);
        (first, second, C::restore(values))
    }
}

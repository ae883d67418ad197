//! Numbers of several boxes at once, one in each lane of a vector.

#![allow(clippy::needless_range_loop, reason = "loops over lanes become vectors")]

use std::ops::{Deref, DerefMut};

/// Number of boxes expanded at once.
pub const BOXES: usize = 8;

/// One f64 for each box, in one cache line: a vector that crosses a border is read at half the speed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub struct Lane(pub [f64; BOXES]);

impl Lane {
    /// 0 in every lane.
    pub const ZERO: Self = Self([0.0; BOXES]);

    /// Applies a function in every lane.
    #[inline(always)]
    pub fn each(self, function: impl Fn(f64) -> f64) -> Self {
        let mut out = self;
        for lane in 0..BOXES {
            out.0[lane] = function(self.0[lane]);
        }
        out
    }

    /// Makes a lane from the number of each box.
    #[inline(always)]
    pub fn from_fn(number: impl FnMut(usize) -> f64) -> Self {
        Self(std::array::from_fn(number))
    }

    /// x + y.
    #[inline(always)]
    pub fn plus(&self, other: &Self) -> Self {
        let mut out = Self::ZERO;
        for lane in 0..BOXES {
            out.0[lane] = self.0[lane] + other.0[lane];
        }
        out
    }

    /// x y.
    #[inline(always)]
    pub fn times(&self, other: &Self) -> Self {
        let mut out = Self::ZERO;
        for lane in 0..BOXES {
            out.0[lane] = self.0[lane] * other.0[lane];
        }
        out
    }
}

impl Deref for Lane {
    type Target = [f64; BOXES];

    #[inline(always)]
    fn deref(&self) -> &Self::Target {
        &self.0
    }
}

impl DerefMut for Lane {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut Self::Target {
        &mut self.0
    }
}

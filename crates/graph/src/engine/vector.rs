//! Vectors of f64 in registers, one type for each instruction set.
//!
//! Arrays are no substitute: a compiler that meets a block of them in a loop over instructions
//! keeps it in memory. Measured on an AVX-512 machine: see docs/dev/experiments.md.

#![allow(unsafe_code, reason = "vector instructions are called after asking for them")]

#[cfg(target_arch = "x86_64")]
use std::arch::x86_64::*;

use crate::graph::InstructionSet;
#[cfg(target_arch = "x86_64")]
use crate::graph::widest;

/// A vector of `LANES` lanes; all operations are correctly rounded.
pub(super) trait Vector: Copy {
    const LANES: usize;
    /// Loads the first lanes of a slice, which must have enough of them.
    fn load(from: &[f64]) -> Self;
    fn store(self, to: &mut [f64]);
    fn splat(value: f64) -> Self;
    fn add(self, other: Self) -> Self;
    fn sub(self, other: Self) -> Self;
    fn mul(self, other: Self) -> Self;
    fn div(self, other: Self) -> Self;
    fn neg(self) -> Self;
    fn abs(self) -> Self;
    fn sqrt(self) -> Self;
    /// Returns `self * b + c`, rounded once.
    fn mul_add(self, b: Self, c: Self) -> Self;
    /// Returns `self * b - c`, rounded once.
    fn mul_sub(self, b: Self, c: Self) -> Self;
    /// Returns `c - self * b`, rounded once.
    fn neg_mul_add(self, b: Self, c: Self) -> Self;
}

/// Work on blocks, compiled for each type of vector.
pub(super) trait BlockKernel {
    /// Runs the work. Mark the implementation, and everything it calls, `#[inline(always)]`.
    fn run<V: Vector>(self);
}

/// Runs work with these vectors, which the processor must have, or with the baseline's.
pub(super) fn with_vectors(vectors: InstructionSet, work: impl BlockKernel) {
    match vectors {
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx512 if widest() == InstructionSet::Avx512 => {
            // SAFETY: the processor has the features that the function is compiled for.
            unsafe { avx512(work) }
        }
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx2 if widest() != InstructionSet::Baseline => {
            // SAFETY: as above; every processor with AVX-512 has them too.
            unsafe { avx2(work) }
        }
        _ => work.run::<TwoLanes>(),
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq")]
fn avx512(work: impl BlockKernel) {
    work.run::<Eight>();
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn avx2(work: impl BlockKernel) {
    work.run::<Four>();
}

/// Two lanes in plain Rust: SSE2 and NEON have registers of this width.
#[derive(Clone, Copy)]
pub(super) struct TwoLanes([f64; 2]);

impl TwoLanes {
    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self(self.0.map(f))
    }

    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self([f(self.0[0], other.0[0]), f(self.0[1], other.0[1])])
    }
}

impl Vector for TwoLanes {
    const LANES: usize = 2;
    #[inline(always)]
    fn load(from: &[f64]) -> Self {
        Self([from[0], from[1]])
    }
    #[inline(always)]
    fn store(self, to: &mut [f64]) {
        to[..2].copy_from_slice(&self.0);
    }
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self([value; 2])
    }
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, |x, y| x + y)
    }
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |x, y| x - y)
    }
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |x, y| x * y)
    }
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.zip(other, |x, y| x / y)
    }
    #[inline(always)]
    fn neg(self) -> Self {
        self.map(|x| -x)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        self.map(f64::abs)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.map(f64::sqrt)
    }
    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        Self([self.0[0].mul_add(b.0[0], c.0[0]), self.0[1].mul_add(b.0[1], c.0[1])])
    }
    #[inline(always)]
    fn mul_sub(self, b: Self, c: Self) -> Self {
        self.mul_add(b, c.neg())
    }
    #[inline(always)]
    fn neg_mul_add(self, b: Self, c: Self) -> Self {
        self.neg().mul_add(b, c)
    }
}

/// One type of x86-64 registers: each operation is one instruction.
#[cfg(target_arch = "x86_64")]
macro_rules! registers {
    ($(#[$doc:meta])* $name:ident($register:ty) $lanes:literal $load:ident $store:ident $splat:ident
     { $($method:ident($($other:ident)*) = $instruction:ident;)* }
     abs = |$x:ident| $abs:expr; neg = |$y:ident| $neg:expr;) => {
        $(#[$doc])*
        #[derive(Clone, Copy)]
        pub(super) struct $name($register);

        // SAFETY of all that follows: values of this type are only made inside functions that are
        // compiled for, and called on, processors with these registers; memory is in bounds because
        // it is a checked slice.
        impl Vector for $name {
            const LANES: usize = $lanes;
            #[inline(always)]
            fn load(from: &[f64]) -> Self {
                let from = &from[..$lanes];
                // SAFETY: see above.
                Self(unsafe { $load(from.as_ptr()) })
            }
            #[inline(always)]
            fn store(self, to: &mut [f64]) {
                let to = &mut to[..$lanes];
                // SAFETY: see above.
                unsafe { $store(to.as_mut_ptr(), self.0) }
            }
            #[inline(always)]
            fn splat(value: f64) -> Self {
                // SAFETY: see above.
                Self(unsafe { $splat(value) })
            }
            $(
                #[inline(always)]
                fn $method(self $(, $other: Self)*) -> Self {
                    // SAFETY: see above.
                    Self(unsafe { $instruction(self.0 $(, $other.0)*) })
                }
            )*
            #[inline(always)]
            fn abs(self) -> Self {
                let $x = self.0;
                // SAFETY: see above.
                Self(unsafe { $abs })
            }
            #[inline(always)]
            fn neg(self) -> Self {
                let $y = self.0;
                // SAFETY: see above.
                Self(unsafe { $neg })
            }
        }
    };
}

#[cfg(target_arch = "x86_64")]
registers! {
    /// Eight lanes, by AVX-512F and AVX-512DQ.
    Eight(__m512d) 8 _mm512_loadu_pd _mm512_storeu_pd _mm512_set1_pd
    {
    add(other) = _mm512_add_pd;
    sub(other) = _mm512_sub_pd;
    mul(other) = _mm512_mul_pd;
    div(other) = _mm512_div_pd;
    sqrt() = _mm512_sqrt_pd;
    mul_add(b c) = _mm512_fmadd_pd;
    mul_sub(b c) = _mm512_fmsub_pd;
    neg_mul_add(b c) = _mm512_fnmadd_pd;
    }
    abs = |x| _mm512_andnot_pd(_mm512_set1_pd(-0.0), x);
    neg = |x| _mm512_xor_pd(_mm512_set1_pd(-0.0), x);
}

#[cfg(target_arch = "x86_64")]
registers! {
    /// Four lanes, by AVX2 and FMA.
    Four(__m256d) 4 _mm256_loadu_pd _mm256_storeu_pd _mm256_set1_pd
    {
    add(other) = _mm256_add_pd;
    sub(other) = _mm256_sub_pd;
    mul(other) = _mm256_mul_pd;
    div(other) = _mm256_div_pd;
    sqrt() = _mm256_sqrt_pd;
    mul_add(b c) = _mm256_fmadd_pd;
    mul_sub(b c) = _mm256_fmsub_pd;
    neg_mul_add(b c) = _mm256_fnmadd_pd;
    }
    abs = |x| _mm256_andnot_pd(_mm256_set1_pd(-0.0), x);
    neg = |x| _mm256_xor_pd(_mm256_set1_pd(-0.0), x);
}

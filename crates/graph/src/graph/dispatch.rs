//! Run-time dispatch to the widest vector instructions that the processor has.
//!
//! The binary is built for the baseline of its architecture. A loop over lanes vectorises to
//! whatever the function it is inlined into may use, so the same source is compiled once for each
//! instruction set here. Nothing is contracted or reordered: every set gives the same bits.
//!
//! Measured gain on an AVX-512 machine, with slots on cache-line borders: 1.4 to 1.9 on the f64
//! tapes of `benches/tapes.rs`, 2.1 on balls.

#![allow(unsafe_code, reason = "a function with target features is called after asking for them")]

/// A computation that is inlined into functions compiled for several instruction sets.
pub trait Kernel {
    /// Runs the computation. Mark the implementation, and everything it calls, `#[inline(always)]`.
    fn run(self);
}

/// An instruction set that the computation is compiled for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(not(target_arch = "x86_64"), allow(dead_code, reason = "made on x86-64 only"))]
pub enum InstructionSet {
    /// 512 bits, with conversions of 64-bit integers.
    Avx512,
    /// 256 bits, with fused multiply-add.
    Avx2,
    /// The baseline of the architecture.
    Baseline,
}

/// Finds the widest instruction set of this processor.
pub fn widest() -> InstructionSet {
    #[cfg(target_arch = "x86_64")]
    {
        let has_fused_sums = is_x86_feature_detected!("fma");
        let has_avx512 =
            is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq");
        if has_fused_sums && has_avx512 {
            return InstructionSet::Avx512;
        }
        if has_fused_sums && is_x86_feature_detected!("avx2") {
            return InstructionSet::Avx2;
        }
    }
    InstructionSet::Baseline
}

/// Names the processor features that tapes use beyond the baseline of the architecture.
pub fn vector_features() -> &'static [&'static str] {
    match widest() {
        InstructionSet::Avx512 => &["avx512f", "avx512dq"],
        InstructionSet::Avx2 => &["avx2", "fma"],
        InstructionSet::Baseline => &[],
    }
}

/// Runs the computation with the widest vectors available.
pub fn with_widest_vectors(work: impl Kernel) {
    match widest() {
        // SAFETY: the processor has the features that the function is compiled for.
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx512 => unsafe { avx512(work) },
        // SAFETY: as above.
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx2 => unsafe { avx2(work) },
        _ => work.run(),
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq")]
fn avx512(work: impl Kernel) {
    work.run();
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn avx2(work: impl Kernel) {
    work.run();
}

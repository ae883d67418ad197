//! Work compiled for the widest vectors that this processor has, chosen at run time.
//!
//! The binary is built for the baseline of its architecture. A loop over lanes vectorises to
//! whatever the function it is inlined into may use, so the same source is compiled once for each
//! instruction set here. Nothing is contracted or reordered: every set gives the same bits.
//!
//! Measured gain on an AVX-512 machine, with slots on cache-line borders: 1.4 to 1.9 on the f64
//! tapes of `benches/tapes.rs`, 2.1 on balls.

#![allow(unsafe_code, reason = "a function with target features is called after asking for them")]

/// A piece of work that is inlined into functions compiled for several instruction sets.
pub(super) trait Work {
    /// Does it; to be marked `#[inline(always)]`, like all that it calls.
    fn run(self);
}

/// The processor's features that tapes are run with, beyond the baseline of its architecture.
pub fn vector_features() -> &'static [&'static str] {
    #[cfg(target_arch = "x86_64")]
    {
        if is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq") {
            return &["avx512f", "avx512dq"];
        }
        if is_x86_feature_detected!("avx2") {
            return &["avx2"];
        }
    }
    &[]
}

/// Does the work with the widest vectors there are.
pub(super) fn with_widest_vectors(work: impl Work) {
    #[cfg(target_arch = "x86_64")]
    {
        if is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq") {
            // SAFETY: the processor has the features that the function is compiled for.
            return unsafe { avx512(work) };
        }
        if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
            // SAFETY: as above.
            return unsafe { avx2(work) };
        }
    }
    work.run();
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq")]
fn avx512(work: impl Work) {
    work.run();
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn avx2(work: impl Work) {
    work.run();
}

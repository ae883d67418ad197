//! Jumps, calls, and arithmetic on addresses.

use super::{Encoder, Pointer};

/// Place in the code to which jumps and calls go.
#[derive(Clone, Copy, Debug)]
pub struct Label(usize);

/// Jump to a place that is not known yet.
#[derive(Debug)]
pub struct Jump(usize);

/// Bytes of a jump or a call.
const JUMP: usize = 5;

impl Encoder {
    /// Returns the present place.
    pub fn label(&self) -> Label {
        Label(self.bytes.len())
    }

    /// Jumps to a place that is given by `land`.
    pub fn jump(&mut self) -> Jump {
        let jump = Jump(self.bytes.len());
        self.bytes.extend([0xe9, 0, 0, 0, 0]);
        jump
    }

    /// Ends a jump here.
    pub fn land(&mut self, jump: &Jump) {
        let distance = (self.bytes.len() - jump.0 - JUMP) as i32;
        self.bytes[jump.0 + 1..jump.0 + JUMP].copy_from_slice(&distance.to_le_bytes());
    }

    /// Calls the subroutine that begins at a label.
    pub fn call(&mut self, label: Label) {
        let distance = label.0 as i64 - (self.bytes.len() + JUMP) as i64;
        self.bytes.push(0xe8);
        self.bytes.extend((distance as i32).to_le_bytes());
    }

    /// Ends a subroutine.
    pub fn give_back(&mut self) {
        self.bytes.push(0xc3);
    }

    /// Ends a function: vzeroupper; ret.
    pub fn end(&mut self) {
        self.bytes.extend([0xc5, 0xf8, 0x77, 0xc3]);
    }

    /// Counts rcx down, and jumps back to a label until it is 0.
    pub fn repeat(&mut self, label: Label) {
        // dec rcx; jnz
        self.bytes.extend([0x48, 0xff, 0xc9, 0x0f, 0x85]);
        let back = label.0 as i64 - (self.bytes.len() + 4) as i64;
        self.bytes.extend((back as i32).to_le_bytes());
    }

    /// Moves an address on by this many f64.
    pub fn advance(&mut self, pointer: Pointer, numbers: i32) {
        // add pointer, bytes
        self.bytes.extend([0x48, 0x81, 0xc0 | pointer.number()]);
        self.bytes.extend((8 * numbers).to_le_bytes());
    }

    /// Keeps the address in rdi, in r8.
    pub fn keep(&mut self) {
        // mov r8, rdi
        self.bytes.extend([0x49, 0x89, 0xf8]);
    }

    /// Moves an address to this distance, in f64, from the one that was kept.
    pub fn point(&mut self, pointer: Pointer, numbers: i32) {
        // lea pointer, [r8 + bytes]
        self.bytes.extend([0x49, 0x8d, 0b10 << 6 | pointer.number() << 3]);
        self.bytes.extend((8 * numbers).to_le_bytes());
    }
}

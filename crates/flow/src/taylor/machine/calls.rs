//! Subroutines for the products of operations.
//!
//! A function of many products keeps the address of the memory in r8, moves the rows and copies to
//! those of a product, and calls a subroutine that is the same for all. All jumps are calls, returns,
//! and one jump over the subroutines, so that nothing is left to predict.

use super::encode::{BaseRegister, TaylorEncoder};

/// Beginning of a subroutine.
#[derive(Clone, Copy)]
pub(super) struct Label(usize);

/// Jump to a place that is not known yet.
pub(super) struct Jump(usize);

/// Bytes of a jump or a call.
const JUMP: usize = 5;

impl TaylorEncoder {
    /// Jumps to what follows the subroutines.
    pub(super) fn jump(&mut self) -> Jump {
        let jump = Jump(self.bytes.len());
        self.bytes.extend([0xe9, 0, 0, 0, 0]);
        jump
    }

    /// Ends a jump, and keeps the address of the memory.
    pub(super) fn land(&mut self, jump: &Jump) {
        let distance = (self.bytes.len() - jump.0 - JUMP) as i32;
        self.bytes[jump.0 + 1..jump.0 + JUMP].copy_from_slice(&distance.to_le_bytes());
        // mov r8, rdi
        self.bytes.extend([0x49, 0x89, 0xf8]);
    }

    /// Begins a subroutine.
    pub(super) fn label(&self) -> Label {
        Label(self.bytes.len())
    }

    /// Ends a subroutine.
    pub(super) fn give_back(&mut self) {
        self.bytes.push(0xc3);
    }

    /// Calls a subroutine.
    pub(super) fn call(&mut self, label: Label) {
        let distance = label.0 as i64 - (self.bytes.len() + JUMP) as i64;
        self.bytes.push(0xe8);
        self.bytes.extend((distance as i32).to_le_bytes());
    }

    /// Moves the rows and the copies to these distances, in f64, from the beginning of memory.
    pub(super) fn point(&mut self, rows: i32, copies: i32) {
        // lea rdi, [r8 + rows]; lea rsi, [r8 + copies]
        for (operand, distance) in [(0xb8, rows), (0xb0, copies)] {
            self.bytes.extend([0x49, 0x8d, operand]);
            self.bytes.extend((8 * distance).to_le_bytes());
        }
    }

    /// Moves the sums on by this many f64.
    pub(super) fn next_sums(&mut self, numbers: i32) {
        // add rcx, numbers
        self.bytes.extend([0x48, 0x81, 0xc1]);
        self.bytes.extend((8 * numbers).to_le_bytes());
    }

    /// Records that a base is moved by up to this many f64 in the course of the function.
    pub(super) fn moves(&mut self, base: BaseRegister, most: i32) {
        self.touched[base as usize].1 += most;
    }
}

#[cfg(test)]
mod tests {
    use iced_x86::Register::{None as Nothing, R8, RCX, RDI, RSI};
    use iced_x86::{Decoder, DecoderOptions, Mnemonic, OpKind};

    use super::*;

    #[test]
    fn a_disassembler_reads_calls_and_addresses() {
        let mut to = TaylorEncoder::default();
        let jump = to.jump();
        let label = to.label();
        to.give_back();
        let landed = to.label();
        to.land(&jump);
        to.point(40, 1 << 20);
        to.call(label);
        to.next_sums(40);
        let decoder = Decoder::with_ip(64, &to.bytes, 0, DecoderOptions::NONE);
        let found: Vec<_> = decoder.into_iter().collect();
        let [jump, back, keep, rows, copies, call, sums] = found[..] else { panic!("{found:?}") };
        assert_eq!((jump.mnemonic(), jump.near_branch_target()), (Mnemonic::Jmp, landed.0 as u64));
        assert_eq!(back.mnemonic(), Mnemonic::Ret);
        assert_eq!(keep.mnemonic(), Mnemonic::Mov);
        assert_eq!((keep.op_register(0), keep.op_register(1)), (R8, RDI));
        for (found, register, distance) in [(rows, RDI, 320), (copies, RSI, 8 << 20)] {
            assert_eq!((found.mnemonic(), found.op_register(0)), (Mnemonic::Lea, register));
            assert_eq!(found.op_kind(1), OpKind::Memory);
            assert_eq!((found.memory_base(), found.memory_index()), (R8, Nothing));
            assert_eq!(found.memory_displacement64(), distance);
        }
        assert_eq!((call.mnemonic(), call.near_branch_target()), (Mnemonic::Call, label.0 as u64));
        assert_eq!((sums.mnemonic(), sums.op_register(0)), (Mnemonic::Add, RCX));
        assert_eq!(sums.immediate(1), 320);
    }
}

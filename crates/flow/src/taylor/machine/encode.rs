//! Instructions of an expansion, encoded with the range of memory they touch.
//!
//! Operands in memory are a base register and a distance in f64. A function of many products keeps
//! the address of the memory, moves the rows and copies to those of a product, and calls a
//! subroutine that is the same for all. All jumps are calls, returns, and one jump over the
//! subroutines, so that nothing is left to predict.

use liouville::assembler::{Encoder, Operand, OperandOrder, PairInstruction, Pointer, SumSigns};
pub(super) use liouville::assembler::{Jump, Label, PairSelection, Register, Width};

/// Memory that a base register points to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum BaseRegister {
    /// The rows, at an order.
    Rows,
    /// The copies, at an order.
    Copies,
    /// Slopes, scales and weights.
    Constants,
    /// Inner sums, or their parts.
    Sums,
}

impl BaseRegister {
    fn pointer(self) -> Pointer {
        match self {
            BaseRegister::Rows => Pointer::Rdi,
            BaseRegister::Copies => Pointer::Rsi,
            BaseRegister::Constants => Pointer::Rdx,
            BaseRegister::Sums => Pointer::Rcx,
        }
    }
}

/// Address of a number in memory, or of the first of several.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct At(pub(super) BaseRegister, pub(super) i32);

/// Encoded instructions, and the range of memory they touch.
#[derive(Debug, Default)]
pub(super) struct TaylorEncoder {
    encoder: Encoder,
    /// The least and the largest distance from each base, the latter exclusive.
    pub(super) touched: [(i32, i32); 4],
}

impl TaylorEncoder {
    /// All bytes so far.
    pub(super) fn bytes(&self) -> &[u8] {
        self.encoder.bytes()
    }

    /// Sets register = 0 in all lanes.
    pub(super) fn zero(&mut self, register: Register) {
        self.encoder.zero(register);
    }

    /// Loads numbers to a register.
    pub(super) fn load(&mut self, width: Width, register: Register, from: At) {
        let from = self.operand(width, from);
        self.encoder.load(width, register, from);
    }

    /// Stores a register to numbers.
    pub(super) fn store(&mut self, width: Width, register: Register, to: At) {
        let to = self.touch(width, to);
        self.encoder.store(width, to, register);
    }

    /// Sets register = x · y.
    pub(super) fn multiply(&mut self, width: Width, register: Register, x: Register, y: At) {
        let y = self.operand(width, y);
        self.encoder.pair(width, PairInstruction::Mul, [register, x], y);
    }

    /// Sets register = x / y.
    pub(super) fn divide(&mut self, width: Width, register: Register, x: Register, y: At) {
        let y = self.operand(width, y);
        self.encoder.pair(width, PairInstruction::Div, [register, x], y);
    }

    /// Sets register = √x.
    pub(super) fn square_root(&mut self, width: Width, register: Register, x: At) {
        let x = self.operand(width, x);
        self.encoder.square_root(width, register, x);
    }

    /// Sets register = register + x · y, rounded once.
    pub(super) fn fused(&mut self, width: Width, register: Register, x: Register, y: At) {
        let y = self.operand(width, y);
        self.encoder.fused(width, (OperandOrder::O231, SumSigns::Add), [register, x], y);
    }

    /// Sets register = register + x · y, or register - x · y, rounded once, vectors.
    pub(super) fn fused_with(
        &mut self,
        width: Width,
        negative: bool,
        [register, x, y]: [Register; 3],
    ) {
        let signs = if negative { SumSigns::NegAdd } else { SumSigns::Add };
        let y = Operand::Register(y);
        self.encoder.fused(width, (OperandOrder::O231, signs), [register, x], y);
    }

    /// Sets register = x + y, vectors.
    pub(super) fn add(&mut self, width: Width, register: Register, x: Register, y: Register) {
        self.encoder.pair(width, PairInstruction::Add, [register, x], Operand::Register(y));
    }

    /// Interleaves the even or odd numbers of x and y: x₀ y₀ x₂ y₂ … or x₁ y₁ x₃ y₃ …
    pub(super) fn mix(&mut self, width: Width, odd: bool, registers: [Register; 3]) {
        self.encoder.mix(width, odd, registers);
    }

    /// Joins pairs of x and pairs of y.
    pub(super) fn pairs(&mut self, width: Width, which: PairSelection, registers: [Register; 3]) {
        self.encoder.pairs(width, which, registers);
    }

    /// Ends a function.
    pub(super) fn end(&mut self) {
        self.encoder.end();
    }

    /// Jumps to what follows the subroutines.
    pub(super) fn jump(&mut self) -> Jump {
        self.encoder.jump()
    }

    /// Ends a jump, and keeps the address of the memory.
    pub(super) fn land(&mut self, jump: &Jump) {
        self.encoder.land(jump);
        self.encoder.keep();
    }

    /// Begins a subroutine.
    pub(super) fn label(&self) -> Label {
        self.encoder.label()
    }

    /// Ends a subroutine.
    pub(super) fn give_back(&mut self) {
        self.encoder.give_back();
    }

    /// Calls a subroutine.
    pub(super) fn call(&mut self, label: Label) {
        self.encoder.call(label);
    }

    /// Moves the rows and the copies to these distances, in f64, from the beginning of memory.
    pub(super) fn point(&mut self, rows: i32, copies: i32) {
        self.encoder.point(BaseRegister::Rows.pointer(), rows);
        self.encoder.point(BaseRegister::Copies.pointer(), copies);
    }

    /// Moves the sums on by this many f64.
    pub(super) fn next_sums(&mut self, numbers: i32) {
        self.encoder.advance(BaseRegister::Sums.pointer(), numbers);
    }

    /// Records that a base is moved by up to this many f64 in the course of the function.
    pub(super) fn moves(&mut self, base: BaseRegister, most: i32) {
        self.touched[base as usize].1 += most;
    }

    fn operand(&mut self, width: Width, at: At) -> Operand {
        let (pointer, distance) = self.touch(width, at);
        Operand::Memory(pointer, distance)
    }

    fn touch(&mut self, width: Width, At(base, distance): At) -> (Pointer, i32) {
        let (least, most) = &mut self.touched[base as usize];
        *least = (*least).min(distance);
        *most = (*most).max(distance + width.numbers() as i32);
        (base.pointer(), distance)
    }
}

#[cfg(test)]
mod tests {
    use iced_x86::{Decoder, DecoderOptions, Instruction, Mnemonic, OpKind, Register as Iced};

    use super::*;

    /// Assembles some instructions and reads them back.
    fn all(emit: impl FnOnce(&mut TaylorEncoder)) -> Vec<Instruction> {
        let mut to = TaylorEncoder::default();
        emit(&mut to);
        Decoder::with_ip(64, to.bytes(), 0, DecoderOptions::NONE).into_iter().collect()
    }

    #[test]
    fn a_disassembler_reads_what_was_meant() {
        for (base, pointer) in [
            (BaseRegister::Rows, Iced::RDI),
            (BaseRegister::Copies, Iced::RSI),
            (BaseRegister::Constants, Iced::RDX),
            (BaseRegister::Sums, Iced::RCX),
        ] {
            let at = At(base, -9);
            let width = Width::Four;
            let found = all(|to| {
                to.load(width, 1, at);
                to.multiply(width, 1, 2, at);
                to.divide(width, 1, 2, at);
                to.fused(width, 1, 2, at);
                to.square_root(width, 1, at);
                to.store(width, 1, at);
            });
            let expected = [
                (Mnemonic::Vmovupd, 1),
                (Mnemonic::Vmulpd, 2),
                (Mnemonic::Vdivpd, 2),
                (Mnemonic::Vfmadd231pd, 2),
                (Mnemonic::Vsqrtpd, 1),
                (Mnemonic::Vmovupd, 0),
            ];
            assert_eq!(found.len(), expected.len(), "{found:?}");
            for (found, (mnemonic, operand)) in found.iter().zip(expected) {
                assert_eq!(found.mnemonic(), mnemonic, "{found:?}");
                assert_eq!(found.op_kind(operand), OpKind::Memory, "{found:?}");
                assert_eq!(found.memory_base(), pointer, "{found:?}");
                assert_eq!(found.memory_displacement64() as i64, -72, "{found:?}");
            }
        }
        let found = all(|to| {
            to.add(Width::Eight, 1, 2, 3);
            to.fused_with(Width::Eight, false, [1, 2, 3]);
            to.fused_with(Width::Eight, true, [1, 2, 3]);
        });
        let expected = [Mnemonic::Vaddpd, Mnemonic::Vfmadd231pd, Mnemonic::Vfnmadd231pd];
        assert_eq!(found.len(), expected.len(), "{found:?}");
        for (found, mnemonic) in found.iter().zip(expected) {
            let registers = [0, 1, 2].map(|operand| found.op_register(operand));
            assert_eq!(registers, [Iced::ZMM1, Iced::ZMM2, Iced::ZMM3], "{found:?}");
            assert_eq!(found.mnemonic(), mnemonic, "{found:?}");
        }
    }

    #[test]
    fn what_is_touched_is_known() {
        let mut assembler = TaylorEncoder::default();
        assembler.load(Width::Eight, 1, At(BaseRegister::Rows, 5));
        assembler.store(Width::One, 1, At(BaseRegister::Copies, -1));
        assembler.fused(Width::Four, 2, 1, At(BaseRegister::Sums, 8));
        assert_eq!(assembler.touched, [(0, 13), (-1, 0), (0, 0), (0, 12)], "to the last number");
        assembler.moves(BaseRegister::Sums, 16);
        assert_eq!(assembler.touched[BaseRegister::Sums as usize], (0, 28), "as it moves on");
    }
}

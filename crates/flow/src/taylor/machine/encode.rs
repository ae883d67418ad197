//! Encoding of the few x86-64 instructions that an expansion needs.
//!
//! Operands in memory are a base register and a distance in f64; encodings are those of the Intel
//! SDM, vol. 2A, 2.3 (VEX) and 2.7 (EVEX). The tests read everything back with a disassembler.
//! Addresses are moved, and subroutines called, in `calls`.

/// Number of a register; vectors use the same sixteen.
pub(super) type Register = u8;

/// Memory that a base register points to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum BaseRegister {
    /// The rows, at an order: rdi.
    Rows,
    /// The copies, at an order: rsi.
    Copies,
    /// Slopes, scales and weights: rdx.
    Constants,
    /// Inner sums, or their parts: rcx.
    Sums,
}

/// Address of a number in memory, or of the first of several.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct At(pub(super) BaseRegister, pub(super) i32);

/// Number of f64 in an operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Width {
    One,
    /// Four numbers, with AVX2 and FMA.
    Four,
    /// Eight numbers, with AVX-512F.
    Eight,
}

impl Width {
    pub(super) fn numbers(self) -> usize {
        match self {
            Width::One => 1,
            Width::Four => 4,
            Width::Eight => 8,
        }
    }
}

/// Selection of pairs of neighbours among four or eight numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PairSelection {
    /// Pairs of the first half.
    Lower,
    /// Pairs of the second half.
    Upper,
    /// First and third pairs.
    Even,
    /// Second and fourth pairs.
    Odd,
}

/// Opcode maps, and prefixes in compressed form.
const MAP_0F: u8 = 1;
const MAP_0F38: u8 = 2;
const MAP_0F3A: u8 = 3;
const PACKED: u8 = 1;
const SCALAR: u8 = 3;

/// Encoded instructions, and the range of memory they touch.
#[derive(Debug, Default)]
pub(super) struct TaylorEncoder {
    pub(super) bytes: Vec<u8>,
    /// The least and the largest distance from each base, the latter exclusive.
    pub(super) touched: [(i32, i32); 4],
}

impl TaylorEncoder {
    /// Sets register = 0 in all lanes.
    pub(super) fn zero(&mut self, register: Register) {
        // vxorpd of 128 bits clears the bits above them.
        let high = (register >> 3 ^ 1) & 1;
        let first = high << 7 | 1 << 6 | high << 5 | MAP_0F;
        let low = register & 7;
        let fields = 0b11 << 6 | low << 3 | low;
        self.bytes.extend([0xc4, first, (!register & 15) << 3 | PACKED, 0x57, fields]);
    }

    /// Loads numbers to a register.
    pub(super) fn load(&mut self, width: Width, register: Register, from: At) {
        self.plain(width, 0x10, register, 0, from);
    }

    /// Stores a register to numbers.
    pub(super) fn store(&mut self, width: Width, register: Register, to: At) {
        self.plain(width, 0x11, register, 0, to);
    }

    /// Sets register = x · y.
    pub(super) fn multiply(&mut self, width: Width, register: Register, x: Register, y: At) {
        self.plain(width, 0x59, register, x, y);
    }

    /// Sets register = x / y.
    pub(super) fn divide(&mut self, width: Width, register: Register, x: Register, y: At) {
        self.plain(width, 0x5e, register, x, y);
    }

    /// Sets register = √x.
    pub(super) fn square_root(&mut self, width: Width, register: Register, x: At) {
        // Of one number the upper half of the result is copied from a register.
        let upper = if width == Width::One { register } else { 0 };
        self.plain(width, 0x51, register, upper, x);
    }

    /// Sets register = register + x · y, rounded once.
    pub(super) fn fused(&mut self, width: Width, register: Register, x: Register, y: At) {
        let opcode = if width == Width::One { 0xb9 } else { 0xb8 };
        self.instruction(width, MAP_0F38, PACKED, 1, [opcode, register, x], y);
    }

    /// Sets register = register + x · y, or register - x · y, rounded once, vectors.
    pub(super) fn fused_with(
        &mut self,
        width: Width,
        negative: bool,
        [register, x, y]: [Register; 3],
    ) {
        let opcode = if negative { 0xbc } else { 0xb8 };
        self.between(width, MAP_0F38, [opcode, register, x, y]);
    }

    /// Sets register = x + y, vectors.
    pub(super) fn add(&mut self, width: Width, register: Register, x: Register, y: Register) {
        self.between(width, MAP_0F, [0x58, register, x, y]);
    }

    /// Interleaves the even or odd numbers of x and y: x₀ y₀ x₂ y₂ … or x₁ y₁ x₃ y₃ …
    pub(super) fn mix(&mut self, width: Width, odd: bool, [register, x, y]: [Register; 3]) {
        self.between(width, MAP_0F, [0x14 + u8::from(odd), register, x, y]);
    }

    /// Joins pairs of x and pairs of y: of four numbers the first or the second pair of each, of
    /// eight the two selected.
    pub(super) fn pairs(
        &mut self,
        width: Width,
        which: PairSelection,
        [register, x, y]: [Register; 3],
    ) {
        let (opcode, choice) = match (width, which) {
            (Width::Eight, PairSelection::Lower) => (0x23, 0x44),
            (Width::Eight, PairSelection::Upper) => (0x23, 0xee),
            (Width::Eight, PairSelection::Even) => (0x23, 0x88),
            (Width::Eight, PairSelection::Odd) => (0x23, 0xdd),
            (_, PairSelection::Lower | PairSelection::Even) => (0x06, 0x20),
            (_, PairSelection::Upper | PairSelection::Odd) => (0x06, 0x31),
        };
        self.between(width, MAP_0F3A, [opcode, register, x, y]);
        self.bytes.push(choice);
    }

    /// Ends a function.
    pub(super) fn end(&mut self) {
        // vzeroupper; ret
        self.bytes.extend([0xc5, 0xf8, 0x77, 0xc3]);
    }

    fn plain(&mut self, width: Width, opcode: u8, register: Register, x: Register, at: At) {
        let prefix = if width == Width::One { SCALAR } else { PACKED };
        let wide = u8::from(width == Width::Eight);
        self.instruction(width, MAP_0F, prefix, wide, [opcode, register, x], at);
    }

    /// Encodes a vector instruction without a memory operand.
    fn between(&mut self, width: Width, map: u8, [opcode, register, x, y]: [u8; 4]) {
        let not = |register: Register| (register >> 3 ^ 1) & 1;
        let first = not(register) << 7 | 1 << 6 | not(y) << 5 | map;
        let wide = u8::from(width == Width::Eight || map == MAP_0F38);
        let second = wide << 7 | (!x & 15) << 3 | 1 << 2 | PACKED;
        match width {
            Width::Eight => self.bytes.extend([0x62, first | 1 << 4, second, 0b0100_1000]),
            _ => self.bytes.extend([0xc4, first, second]),
        }
        self.bytes.extend([opcode, 0b11 << 6 | (register & 7) << 3 | y & 7]);
    }

    fn instruction(
        &mut self,
        width: Width,
        map: u8,
        prefix: u8,
        wide: u8,
        [opcode, register, x]: [u8; 3],
        At(base, distance): At,
    ) {
        // Bits of registers in prefixes are inverted; bases are below 8.
        let first = ((register >> 3 ^ 1) & 1) << 7 | 0b11 << 5 | map;
        let second = wide << 7 | (!x & 15) << 3 | prefix;
        match width {
            Width::Eight => self.bytes.extend([0x62, first | 1 << 4, second | 1 << 2, 0b0100_1000]),
            Width::Four => self.bytes.extend([0xc4, first, second | 1 << 2]),
            Width::One => self.bytes.extend([0xc4, first, second]),
        }
        let number = match base {
            BaseRegister::Rows => 7,
            BaseRegister::Copies => 6,
            BaseRegister::Constants => 2,
            BaseRegister::Sums => 1,
        };
        let operand = (register & 7) << 3 | number;
        // A short distance counts whole vectors of eight.
        match i8::try_from(distance / 8) {
            Ok(short) if width == Width::Eight && distance % 8 == 0 => {
                self.bytes.extend([opcode, 0b01 << 6 | operand, short.cast_unsigned()]);
            }
            _ => {
                self.bytes.extend([opcode, 0b10 << 6 | operand]);
                self.bytes.extend((8 * distance).to_le_bytes());
            }
        }
        let (least, most) = &mut self.touched[base as usize];
        *least = (*least).min(distance);
        *most = (*most).max(distance + width.numbers() as i32);
    }
}

#[cfg(test)]
mod tests {
    use iced_x86::{Decoder, DecoderOptions, Instruction, Mnemonic, OpKind, Register as Iced};

    use super::*;

    const BASES: [(BaseRegister, Iced); 4] = [
        (BaseRegister::Rows, Iced::RDI),
        (BaseRegister::Copies, Iced::RSI),
        (BaseRegister::Constants, Iced::RDX),
        (BaseRegister::Sums, Iced::RCX),
    ];

    /// Assembles a single instruction and reads it back.
    fn one(emit: impl FnOnce(&mut TaylorEncoder)) -> Instruction {
        let mut assembler = TaylorEncoder::default();
        emit(&mut assembler);
        let mut decoder = Decoder::with_ip(64, &assembler.bytes, 0, DecoderOptions::NONE);
        let found = decoder.decode();
        assert!(!found.is_invalid(), "{:02x?}", assembler.bytes);
        assert_eq!(found.len(), assembler.bytes.len(), "one: {:02x?}", assembler.bytes);
        found
    }

    fn named(width: Width, register: Register) -> Iced {
        let first = match width {
            Width::One => Iced::XMM0,
            Width::Four => Iced::YMM0,
            Width::Eight => Iced::ZMM0,
        };
        first + u32::from(register)
    }

    #[test]
    fn a_disassembler_reads_what_was_meant() {
        for (base, pointer) in BASES {
            for distance in [-9, -1, 0, 1, 8, 15, 16, 1000, 1 << 20] {
                for register in 0..16 {
                    let x = (register * 7 + 5) % 16;
                    let at = At(base, distance);
                    let assert_memory = |found: &Instruction, operand| {
                        assert_eq!(found.op_kind(operand), OpKind::Memory, "{found:?}");
                        assert_eq!(found.memory_base(), pointer, "{found:?}");
                        assert_eq!(found.memory_index(), Iced::None, "{found:?}");
                        let bytes = found.memory_displacement64() as i64;
                        assert_eq!(bytes, 8 * i64::from(distance), "{found:?}");
                        assert!(!found.is_broadcast(), "{found:?}");
                        assert_eq!(found.op_mask(), Iced::None, "{found:?}");
                    };
                    for width in [Width::One, Width::Four, Width::Eight] {
                        let is_one = width == Width::One;
                        let moves = if is_one { Mnemonic::Vmovsd } else { Mnemonic::Vmovupd };
                        let found = one(|to| to.load(width, register, at));
                        assert_eq!(found.mnemonic(), moves, "load");
                        assert_eq!(found.op_register(0), named(width, register), "{found:?}");
                        assert_memory(&found, 1);
                        let found = one(|to| to.store(width, register, at));
                        assert_eq!(found.mnemonic(), moves, "store");
                        assert_eq!(found.op_register(1), named(width, register), "{found:?}");
                        assert_memory(&found, 0);
                        let found = one(|to| to.fused(width, register, x, at));
                        let fused =
                            if is_one { Mnemonic::Vfmadd231sd } else { Mnemonic::Vfmadd231pd };
                        assert_eq!(found.mnemonic(), fused, "fused");
                        assert_eq!(found.op_register(0), named(width, register), "{found:?}");
                        assert_eq!(found.op_register(1), named(width, x), "{found:?}");
                        assert_memory(&found, 2);
                    }
                    for width in [Width::One, Width::Four, Width::Eight] {
                        let one_or = |one, more| if width == Width::One { one } else { more };
                        let product = one(|to| to.multiply(width, register, x, at));
                        let quotient = one(|to| to.divide(width, register, x, at));
                        for (found, mnemonic) in [
                            (product, one_or(Mnemonic::Vmulsd, Mnemonic::Vmulpd)),
                            (quotient, one_or(Mnemonic::Vdivsd, Mnemonic::Vdivpd)),
                        ] {
                            assert_eq!(found.mnemonic(), mnemonic, "{found:?}");
                            assert_eq!(found.op_register(0), named(width, register), "{found:?}");
                            assert_eq!(found.op_register(1), named(width, x), "{found:?}");
                            assert_memory(&found, 2);
                        }
                        let found = one(|to| to.square_root(width, register, at));
                        let root = one_or(Mnemonic::Vsqrtsd, Mnemonic::Vsqrtpd);
                        assert_eq!(found.mnemonic(), root, "{found:?}");
                        assert_eq!(found.op_register(0), named(width, register), "{found:?}");
                        assert_memory(&found, if width == Width::One { 2 } else { 1 });
                    }
                    let found = one(|to| to.zero(register));
                    assert_eq!(found.mnemonic(), Mnemonic::Vxorpd, "zero");
                    for operand in 0..3 {
                        assert_eq!(
                            found.op_register(operand),
                            named(Width::One, register),
                            "{found:?}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn a_disassembler_reads_what_is_done_between_registers() {
        for width in [Width::Four, Width::Eight] {
            for register in 0..16 {
                let [x, y] = [(register * 7 + 5) % 16, (register * 3 + 11) % 16];
                let assert_three = |found: &Instruction, mnemonic| {
                    assert_eq!(found.mnemonic(), mnemonic, "{found:?}");
                    for (operand, own) in [register, x, y].into_iter().enumerate() {
                        let own = named(width, own);
                        assert_eq!(found.op_register(operand as u32), own, "{found:?}");
                    }
                    assert_eq!(found.op_mask(), Iced::None, "{found:?}");
                };
                assert_three(&one(|to| to.add(width, register, x, y)), Mnemonic::Vaddpd);
                let fused = |negative| one(|to| to.fused_with(width, negative, [register, x, y]));
                assert_three(&fused(false), Mnemonic::Vfmadd231pd);
                assert_three(&fused(true), Mnemonic::Vfnmadd231pd);
                let mixed = |odd| one(|to| to.mix(width, odd, [register, x, y]));
                assert_three(&mixed(false), Mnemonic::Vunpcklpd);
                assert_three(&mixed(true), Mnemonic::Vunpckhpd);
                let pairs = [
                    PairSelection::Lower,
                    PairSelection::Upper,
                    PairSelection::Even,
                    PairSelection::Odd,
                ];
                let choices = match width {
                    Width::Eight => [0x44, 0xee, 0x88, 0xdd],
                    _ => [0x20, 0x31, 0x20, 0x31],
                };
                for (which, choice) in pairs.into_iter().zip(choices) {
                    let found = one(|to| to.pairs(width, which, [register, x, y]));
                    let is_eight = width == Width::Eight;
                    let shuffle =
                        if is_eight { Mnemonic::Vshuff64x2 } else { Mnemonic::Vperm2f128 };
                    assert_three(&found, shuffle);
                    assert_eq!(found.immediate(3), choice, "{found:?}");
                }
            }
        }
    }

    #[test]
    fn what_is_touched_is_known() {
        let mut assembler = TaylorEncoder::default();
        assembler.load(Width::Eight, 1, At(BaseRegister::Rows, 5));
        assembler.store(Width::One, 1, At(BaseRegister::Copies, -1));
        assembler.fused(Width::Four, 2, 1, At(BaseRegister::Sums, 8));
        assert_eq!(assembler.touched, [(0, 13), (-1, 0), (0, 0), (0, 12)], "to the last number");
    }
}

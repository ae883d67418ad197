//! Encoding of the x86-64 instructions that machine code here is made of.
//!
//! AVX-512 has a prefix of its own (EVEX, Intel SDM vol. 2A, 2.7), with 32 registers of eight
//! numbers; AVX2 has the older one (VEX, 2.3), with 16 of four, and so have single numbers. Opcodes
//! are the same. What an operand in memory may touch is up to those who emit it. The tests read
//! everything back with a disassembler.

mod jumps;
#[cfg(test)]
mod tests;

pub use jumps::{Jump, Label};

/// Number of f64 in an operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Width {
    /// One number, with the prefix of AVX2.
    One,
    /// Four numbers, with AVX2 and FMA.
    Four,
    /// Eight numbers, with AVX-512F and AVX-512DQ.
    Eight,
}

impl Width {
    /// Number of f64.
    pub fn numbers(self) -> usize {
        match self {
            Width::One => 1,
            Width::Four => 4,
            Width::Eight => 8,
        }
    }

    /// Number of registers.
    pub fn registers(self) -> usize {
        match self {
            Width::One | Width::Four => 16,
            Width::Eight => 32,
        }
    }
}

/// Number of a vector register.
pub type Register = u8;

/// Register with an address.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pointer {
    /// First argument of a function.
    Rdi,
    /// Second argument.
    Rsi,
    /// Third argument.
    Rdx,
    /// Fourth argument, or a number of turns.
    Rcx,
}

impl Pointer {
    fn number(self) -> u8 {
        match self {
            Pointer::Rdi => 7,
            Pointer::Rsi => 6,
            Pointer::Rdx => 2,
            Pointer::Rcx => 1,
        }
    }
}

/// Location of an operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operand {
    /// A register.
    Register(Register),
    /// Memory, at a distance in f64 from an address.
    Memory(Pointer, i32),
}

/// Instructions with two sources.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PairInstruction {
    /// x + y
    Add,
    /// x - y
    Sub,
    /// x y
    Mul,
    /// x / y
    Div,
    /// Bits that are set in both.
    And,
    /// Bits that are set in one of them.
    Or,
    /// Bits that are set in just one of them.
    Xor,
    /// All bits where the comparison holds, else none.
    Compare(Comparison),
}

impl PairInstruction {
    fn opcode(self) -> u8 {
        match self {
            PairInstruction::Add => 0x58,
            PairInstruction::Sub => 0x5c,
            PairInstruction::Mul => 0x59,
            PairInstruction::Div => 0x5e,
            PairInstruction::And => 0x54,
            PairInstruction::Or => 0x56,
            PairInstruction::Xor => 0x57,
            PairInstruction::Compare(_) => 0xc2,
        }
    }
}

/// Comparisons; with a NaN only those with "not" hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Comparison {
    /// x > y
    Greater,
    /// Not x > y.
    NotGreater,
    /// Not x ≥ y.
    NotAtLeast,
}

impl Comparison {
    /// Predicate, of those that raise no exception.
    fn predicate(self) -> u8 {
        match self {
            Comparison::Greater => 0x1e,
            Comparison::NotGreater => 0x1a,
            Comparison::NotAtLeast => 0x19,
        }
    }
}

/// Operand order of a fused sum, by the source that the result replaces (the first is the target,
/// the third may be in memory).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OperandOrder {
    /// target · third ± second
    O132,
    /// second · target ± third
    O213,
    /// second · third ± target
    O231,
}

/// Signs of a fused sum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SumSigns {
    /// x y + z
    Add,
    /// x y - z
    Sub,
    /// -x y + z
    NegAdd,
}

/// Selection of pairs of neighbours among four or eight numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PairSelection {
    /// Pairs of the first half.
    Lower,
    /// Pairs of the second half.
    Upper,
    /// First and third pairs.
    Even,
    /// Second and fourth pairs.
    Odd,
}

/// Opcodes in the map 0F.
const LOAD: u8 = 0x10;
const STORE: u8 = 0x11;
const SQUARE_ROOT: u8 = 0x51;
const INTERLEAVE: u8 = 0x14;
const XOR: u8 = 0x57;
/// Opcode in the map 0F38: the bits of a mask to whole numbers.
const SPREAD: u8 = 0x38;
/// Mask register that comparisons use.
const MASK: Register = 1;
/// Opcode maps.
const MAP_0F: u8 = 1;
const MAP_0F38: u8 = 2;
const MAP_0F3A: u8 = 3;
/// Prefixes 66, F3 and F2 in compressed form.
const PACKED: u8 = 1;
const OF_MASKS: u8 = 2;
const SCALAR: u8 = 3;

/// Opcode with its map and its compressed prefix.
#[derive(Clone, Copy)]
struct Opcode {
    map: u8,
    prefix: u8,
    number: u8,
}

impl Opcode {
    /// An operation in the map 0F.
    fn plain(width: Width, number: u8) -> Self {
        let prefix = if width == Width::One { SCALAR } else { PACKED };
        Self { map: MAP_0F, prefix, number }
    }
}

/// Instructions encoded one after another.
#[derive(Debug, Default)]
pub struct Encoder {
    bytes: Vec<u8>,
}

impl Encoder {
    /// All bytes so far.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Returns all bytes.
    pub fn into_bytes(self) -> Vec<u8> {
        self.bytes
    }

    /// Sets register = 0, in all of its numbers.
    pub fn zero(&mut self, register: Register) {
        // vxorpd of 128 bits clears the bits above them.
        let xor = Opcode { map: MAP_0F, prefix: PACKED, number: XOR };
        self.vector(Width::One, xor, register, register, Operand::Register(register));
    }

    /// Loads a register.
    pub fn load(&mut self, width: Width, register: Register, from: Operand) {
        self.vector(width, Opcode::plain(width, LOAD), register, 0, from);
    }

    /// Stores a register to memory.
    pub fn store(&mut self, width: Width, to: (Pointer, i32), register: Register) {
        let to = Operand::Memory(to.0, to.1);
        self.vector(width, Opcode::plain(width, STORE), register, 0, to);
    }

    /// Emits `target = x op y`. Operations on bits, and comparisons, are of vectors.
    pub fn pair(
        &mut self,
        width: Width,
        pair: PairInstruction,
        [target, x]: [Register; 2],
        y: Operand,
    ) {
        let opcode = match pair {
            PairInstruction::And | PairInstruction::Or | PairInstruction::Xor => {
                Opcode { map: MAP_0F, prefix: PACKED, number: pair.opcode() }
            }
            _ => Opcode::plain(width, pair.opcode()),
        };
        let PairInstruction::Compare(comparison) = pair else {
            return self.vector(width, opcode, target, x, y);
        };
        if width == Width::Eight {
            // To a mask, and from there to a register.
            self.vector(width, opcode, MASK, x, y);
            self.bytes.push(comparison.predicate());
            let spread = Opcode { map: MAP_0F38, prefix: OF_MASKS, number: SPREAD };
            self.vector(width, spread, target, 0, Operand::Register(MASK));
        } else {
            self.vector(width, opcode, target, x, y);
            self.bytes.push(comparison.predicate());
        }
    }

    /// Emits `target = √x`.
    pub fn square_root(&mut self, width: Width, target: Register, x: Operand) {
        // Of one number the upper half of the result is copied from a register.
        let upper = if width == Width::One { target } else { 0 };
        self.vector(width, Opcode::plain(width, SQUARE_ROOT), target, upper, x);
    }

    /// Emits a fused sum of target, second and third, rounded once.
    pub fn fused(
        &mut self,
        width: Width,
        (order, signs): (OperandOrder, SumSigns),
        [target, second]: [Register; 2],
        third: Operand,
    ) {
        let order = match order {
            OperandOrder::O132 => 0x98,
            OperandOrder::O213 => 0xa8,
            OperandOrder::O231 => 0xb8,
        };
        let signs = match signs {
            SumSigns::Add => 0,
            SumSigns::Sub => 2,
            SumSigns::NegAdd => 4,
        };
        let number = order + signs + u8::from(width == Width::One);
        let opcode = Opcode { map: MAP_0F38, prefix: PACKED, number };
        self.vector(width, opcode, target, second, third);
    }

    /// Interleaves the even or odd numbers of x and y: x₀ y₀ x₂ y₂ … or x₁ y₁ x₃ y₃ …
    pub fn mix(&mut self, width: Width, odd: bool, [target, x, y]: [Register; 3]) {
        let opcode = Opcode { map: MAP_0F, prefix: PACKED, number: INTERLEAVE + u8::from(odd) };
        self.vector(width, opcode, target, x, Operand::Register(y));
    }

    /// Joins pairs of x and pairs of y: of four numbers the first or the second pair of each, of
    /// eight the two selected.
    pub fn pairs(&mut self, width: Width, which: PairSelection, [target, x, y]: [Register; 3]) {
        let (number, choice) = match (width, which) {
            (Width::Eight, PairSelection::Lower) => (0x23, 0x44),
            (Width::Eight, PairSelection::Upper) => (0x23, 0xee),
            (Width::Eight, PairSelection::Even) => (0x23, 0x88),
            (Width::Eight, PairSelection::Odd) => (0x23, 0xdd),
            (_, PairSelection::Lower | PairSelection::Even) => (0x06, 0x20),
            (_, PairSelection::Upper | PairSelection::Odd) => (0x06, 0x31),
        };
        let opcode = Opcode { map: MAP_0F3A, prefix: PACKED, number };
        self.vector(width, opcode, target, x, Operand::Register(y));
        self.bytes.push(choice);
    }

    /// Encodes a vector instruction: `register` and `place` in the ModRM byte, `second` in the
    /// prefix.
    fn vector(
        &mut self,
        width: Width,
        opcode: Opcode,
        register: Register,
        second: Register,
        place: Operand,
    ) {
        // The last field of ModRM, and bits 3 and 4 of the register that it names.
        let (low, bit3, bit4) = match place {
            Operand::Register(r) => (r & 7, r >> 3 & 1, r >> 4 & 1),
            Operand::Memory(pointer, _) => (pointer.number(), 0, 0),
        };
        // Register bits in prefixes are inverted.
        let not = |bit: u8| (bit & 1) ^ 1;
        let Opcode { map, prefix, number } = opcode;
        let first = not(register >> 3) << 7 | not(bit3) << 5 | map;
        let middle = (!second & 15) << 3 | prefix;
        match width {
            Width::Eight => self.bytes.extend([
                0x62,
                first | not(bit4) << 6 | not(register >> 4) << 4,
                0x80 | middle | 1 << 2,
                // Bits 6 and 5: 512 bits.
                0b10 << 5 | not(second >> 4) << 3,
            ]),
            Width::One | Width::Four => {
                // Of these instructions only the fused ones use the topmost bit.
                let wide = u8::from(map == MAP_0F38) << 7;
                let vector = u8::from(width == Width::Four) << 2;
                self.bytes.extend([0xc4, first | 1 << 6, wide | middle | vector]);
            }
        }
        self.bytes.push(number);
        let fields = (register & 7) << 3 | low;
        match place {
            Operand::Register(_) => self.bytes.push(0b11 << 6 | fields),
            Operand::Memory(_, distance) => self.memory(width, distance, fields),
        }
    }

    /// Encodes ModRM and displacement of an operand in memory.
    fn memory(&mut self, width: Width, distance: i32, fields: u8) {
        let bytes = 8 * distance;
        // In EVEX a displacement of one byte counts vectors.
        let unit = if width == Width::Eight { 64 } else { 1 };
        match i8::try_from(bytes / unit) {
            Ok(short) if bytes % unit == 0 => {
                self.bytes.extend([0b01 << 6 | fields, short.cast_unsigned()]);
            }
            _ => {
                self.bytes.push(0b10 << 6 | fields);
                self.bytes.extend(bytes.to_le_bytes());
            }
        }
    }
}

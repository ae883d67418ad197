//! Encoding of the few x86-64 instructions that a program needs.
//!
//! AVX-512 has a different prefix (EVEX, Intel SDM vol. 2A, 2.7), with 32 registers of 8 lanes;
//! AVX2 has the older one (VEX, 2.3), with 16 of 4. Opcodes are the same. The tests read everything
//! back with a disassembler.

#[cfg(test)]
mod tests;

/// Vector width of an instruction set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Width {
    /// AVX2 and FMA: 4 lanes.
    Four,
    /// AVX-512F and AVX-512DQ: 8 lanes.
    Eight,
}

impl Width {
    pub(super) fn lanes(self) -> usize {
        match self {
            Width::Four => 4,
            Width::Eight => 8,
        }
    }

    pub(super) fn registers(self) -> usize {
        match self {
            Width::Four => 16,
            Width::Eight => 32,
        }
    }

    fn bytes(self) -> i32 {
        8 * self.lanes() as i32
    }
}

/// Number of a vector register.
pub(super) type Register = u8;

/// Area of memory, with a register that points to it; places are numbered vector by vector. Inputs
/// and outputs are rows of several vectors, and each turn of the loop begins some vectors further
/// on; the frame holds the same vectors in every turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Area {
    Inputs,
    Outputs,
    Frame,
}

/// Location of a vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum VectorLocation {
    Register(Register),
    Memory(Area, u32),
}

/// Instructions with two sources.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PairInstruction {
    Add,
    Sub,
    Mul,
    Div,
    And,
    Or,
    Xor,
    /// All bits where the comparison holds, else none.
    Compare(Comparison),
}

/// Comparisons; with a NaN only those with "not" hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Comparison {
    Greater,
    NotGreater,
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

impl PairInstruction {
    fn opcode(self) -> u8 {
        match self {
            PairInstruction::Add => 0x58,
            PairInstruction::Sub => 0x5c,
            PairInstruction::Mul => 0x59,
            PairInstruction::Div => 0x5e,
            PairInstruction::And => 0x54,
            PairInstruction::Or => 0x56,
            PairInstruction::Compare(_) => 0xc2,
            PairInstruction::Xor => 0x57,
        }
    }
}

/// Operand order of a fused sum, by the source that the result replaces (the first is the target,
/// the third may be in memory).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum OperandOrder {
    /// target · third ± second
    O132,
    /// second · target ± third
    O213,
    /// second · third ± target
    O231,
}

/// Signs of a fused sum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SumSigns {
    /// x y + z
    Add,
    /// x y - z
    Sub,
    /// -x y + z
    NegAdd,
}

/// Opcodes in the map 0F.
const LOAD: u8 = 0x10;
const STORE: u8 = 0x11;
const SQUARE_ROOT: u8 = 0x51;
/// Opcode in the map 0F38: the bits of a mask to whole lanes.
const SPREAD: u8 = 0x38;
/// Mask register that comparisons use.
const MASK: u8 = 1;
/// Opcode maps.
const MAP_0F: u8 = 1;
const MAP_0F38: u8 = 2;
/// Prefix 66 in compressed form: packed doubles.
const PACKED_DOUBLE: u8 = 1;
/// Prefix F3 in compressed form: masks.
const BROADER: u8 = 2;

/// Encoder of a loop under construction, with the extent of the memory it touches.
#[derive(Debug)]
pub(super) struct Assembler {
    width: Width,
    bytes: Vec<u8>,
    extent: MemoryExtent,
}

/// Extent of the memory touched in each area; of inputs and outputs in vectors, until it is known
/// how many make a row.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct MemoryExtent {
    /// Number of rows of inputs.
    pub(super) inputs: usize,
    /// Number of rows of outputs.
    pub(super) outputs: usize,
    /// Number of vectors of the frame.
    pub(super) frame: usize,
}

/// Code of a function of the areas and the number of turns, `extern "sysv64"`, whose only effect is
/// to read and write within its extent.
#[derive(Debug)]
pub(super) struct Assembly {
    pub(super) bytes: Vec<u8>,
    pub(super) width: Width,
    /// Number of vectors that a turn computes.
    pub(super) copies: usize,
    pub(super) extent: MemoryExtent,
}

impl Assembler {
    pub(super) fn new(width: Width) -> Self {
        Self { width, bytes: Vec::new(), extent: MemoryExtent::default() }
    }

    /// Loads a register: `target = source`.
    pub(super) fn load(&mut self, target: Register, source: VectorLocation) {
        self.vector(MAP_0F, LOAD, target, 0, source);
    }

    /// Stores a register to memory.
    pub(super) fn store(&mut self, area: Area, index: u32, source: Register) {
        self.vector(MAP_0F, STORE, source, 0, VectorLocation::Memory(area, index));
    }

    /// Emits `target = x op y`.
    pub(super) fn pair(
        &mut self,
        pair: PairInstruction,
        target: Register,
        x: Register,
        y: VectorLocation,
    ) {
        let PairInstruction::Compare(comparison) = pair else {
            self.vector(MAP_0F, pair.opcode(), target, x, y);
            return;
        };
        match self.width {
            Width::Four => {
                self.vector(MAP_0F, pair.opcode(), target, x, y);
                self.bytes.push(comparison.predicate());
            }
            Width::Eight => {
                // To a mask, and from there to a register.
                self.vector(MAP_0F, pair.opcode(), MASK, x, y);
                self.bytes.push(comparison.predicate());
                self.prefix(MAP_0F38, BROADER, target, 0, [0, 0]);
                self.bytes.extend([SPREAD, 0b11 << 6 | (target & 7) << 3 | MASK]);
            }
        }
    }

    /// Emits `target = √x`.
    pub(super) fn square_root(&mut self, target: Register, x: VectorLocation) {
        self.vector(MAP_0F, SQUARE_ROOT, target, 0, x);
    }

    /// Emits a fused sum of target, second and third.
    pub(super) fn fused(
        &mut self,
        order: OperandOrder,
        signs: SumSigns,
        target: Register,
        second: Register,
        third: VectorLocation,
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
        self.vector(MAP_0F38, order + signs, target, second, third);
    }

    /// Closes the loop: advances by some vectors in every row, and repeats for the number of turns.
    pub(super) fn finish(mut self, copies: usize) -> Assembly {
        let step = (self.width.bytes() * copies as i32).to_le_bytes();
        // add rdi, step; add rdx, step; dec rcx; jnz to the beginning; vzeroupper; ret
        for add in [[0x48, 0x81, 0xc7], [0x48, 0x81, 0xc2]] {
            self.bytes.extend(add.into_iter().chain(step));
        }
        self.bytes.extend([0x48, 0xff, 0xc9, 0x0f, 0x85]);
        let back = -(self.bytes.len() as i32 + 4);
        self.bytes.extend(back.to_le_bytes());
        self.bytes.extend([0xc5, 0xf8, 0x77, 0xc3]);
        let in_row = crate::engine::ROW_STATES / self.width.lanes();
        let MemoryExtent { inputs, outputs, frame } = self.extent;
        // The last turn begins this far behind the first.
        let rows = |vectors: usize| match vectors {
            0 => 0,
            vectors => (vectors + in_row - copies).div_ceil(in_row),
        };
        let extent = MemoryExtent { inputs: rows(inputs), outputs: rows(outputs), frame };
        Assembly { bytes: self.bytes, width: self.width, copies, extent }
    }

    /// Encodes a vector instruction: `register` and `place` in the ModRM byte, `second` in the
    /// prefix.
    fn vector(&mut self, map: u8, opcode: u8, register: u8, second: u8, place: VectorLocation) {
        // Bits 3 and 4 of the register in the place.
        let (low, bit3, bit4) = match place {
            VectorLocation::Register(r) => (r & 7, r >> 3 & 1, r >> 4 & 1),
            VectorLocation::Memory(area, index) => {
                self.touch(area, index);
                (base(area), 0, 0)
            }
        };
        self.prefix(map, PACKED_DOUBLE, register, second, [bit3, bit4]);
        self.bytes.push(opcode);
        let register = (register & 7) << 3;
        match place {
            VectorLocation::Register(_) => self.bytes.push(0b11 << 6 | register | low),
            VectorLocation::Memory(_, index) => self.memory(index, register | low),
        }
    }

    /// Encodes the prefix, with bits 3 and 4 of the register that the last field of ModRM names.
    fn prefix(&mut self, map: u8, kind: u8, register: u8, second: u8, [bit3, bit4]: [u8; 2]) {
        // Register bits in prefixes are inverted.
        let not = |bit: u8| (bit & 1) ^ 1;
        match self.width {
            Width::Eight => self.bytes.extend([
                0x62,
                not(register >> 3) << 7
                    | not(bit4) << 6
                    | not(bit3) << 5
                    | not(register >> 4) << 4
                    | map,
                0x80 | (!second & 15) << 3 | 1 << 2 | kind,
                // Bits 6 and 5: 512 bits.
                0b10 << 5 | not(second >> 4) << 3,
            ]),
            Width::Four => self.bytes.extend([
                0xc4,
                not(register >> 3) << 7 | 1 << 6 | not(bit3) << 5 | map,
                // Of these instructions only the fused ones use the topmost bit.
                u8::from(map == MAP_0F38) << 7 | (!second & 15) << 3 | 1 << 2 | kind,
            ]),
        }
    }

    /// Encodes ModRM and displacement of a place in memory.
    fn memory(&mut self, index: u32, fields: u8) {
        let width = self.width.bytes();
        let offset = index as i32 * width;
        // In EVEX a displacement of one byte counts vectors.
        let unit = if self.width == Width::Eight { width } else { 1 };
        match i8::try_from(offset / unit) {
            Ok(short) => self.bytes.extend([0b01 << 6 | fields, short as u8]),
            Err(_) => {
                self.bytes.push(0b10 << 6 | fields);
                self.bytes.extend(offset.to_le_bytes());
            }
        }
    }

    fn touch(&mut self, area: Area, index: u32) {
        let extent = match area {
            Area::Inputs => &mut self.extent.inputs,
            Area::Outputs => &mut self.extent.outputs,
            Area::Frame => &mut self.extent.frame,
        };
        *extent = (*extent).max(index as usize + 1);
    }
}

/// Number of the register that points to an area: rdi, rdx, rsi.
fn base(area: Area) -> u8 {
    match area {
        Area::Inputs => 7,
        Area::Outputs => 2,
        Area::Frame => 6,
    }
}

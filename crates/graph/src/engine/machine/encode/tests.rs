//! Tests of the encoder: a disassembler reads its code back.

use iced_x86::{Decoder, DecoderOptions, Instruction, Mnemonic, OpKind, Register as Iced};

use super::*;

const WIDTHS: [Width; 2] = [Width::Four, Width::Eight];
const PAIRS: [(PairInstruction, Mnemonic); 7] = [
    (PairInstruction::Add, Mnemonic::Vaddpd),
    (PairInstruction::Sub, Mnemonic::Vsubpd),
    (PairInstruction::Mul, Mnemonic::Vmulpd),
    (PairInstruction::Div, Mnemonic::Vdivpd),
    (PairInstruction::And, Mnemonic::Vandpd),
    (PairInstruction::Or, Mnemonic::Vorpd),
    (PairInstruction::Xor, Mnemonic::Vxorpd),
];
const FUSED: [(OperandOrder, SumSigns, Mnemonic); 9] = [
    (OperandOrder::O132, SumSigns::Add, Mnemonic::Vfmadd132pd),
    (OperandOrder::O213, SumSigns::Add, Mnemonic::Vfmadd213pd),
    (OperandOrder::O231, SumSigns::Add, Mnemonic::Vfmadd231pd),
    (OperandOrder::O132, SumSigns::Sub, Mnemonic::Vfmsub132pd),
    (OperandOrder::O213, SumSigns::Sub, Mnemonic::Vfmsub213pd),
    (OperandOrder::O231, SumSigns::Sub, Mnemonic::Vfmsub231pd),
    (OperandOrder::O132, SumSigns::NegAdd, Mnemonic::Vfnmadd132pd),
    (OperandOrder::O213, SumSigns::NegAdd, Mnemonic::Vfnmadd213pd),
    (OperandOrder::O231, SumSigns::NegAdd, Mnemonic::Vfnmadd231pd),
];

fn decoded(bytes: &[u8]) -> Instruction {
    let mut decoder = Decoder::with_ip(64, bytes, 0, DecoderOptions::NONE);
    let instruction = decoder.decode();
    assert!(!instruction.is_invalid(), "{bytes:02x?}");
    assert_eq!(instruction.len(), bytes.len(), "one instruction: {bytes:02x?}");
    instruction
}

fn vector(width: Width, register: Register) -> Iced {
    let first = match width {
        Width::Four => Iced::YMM0,
        Width::Eight => Iced::ZMM0,
    };
    first + u32::from(register)
}

fn places(width: Width) -> Vec<VectorLocation> {
    let registers = (0..width.registers() as u8).map(VectorLocation::Register);
    let indices = [0, 1, 3, 4, 15, 16, 17, 127, 128, 100_000];
    let areas = [Area::Inputs, Area::Outputs, Area::Frame];
    let memory =
        areas.iter().flat_map(|area| indices.map(|index| VectorLocation::Memory(*area, index)));
    registers.chain(memory).collect()
}

fn assert_operand(width: Width, found: &Instruction, operand: u32, place: VectorLocation) {
    match place {
        VectorLocation::Register(register) => {
            assert_eq!(found.op_register(operand), vector(width, register), "{place:?}");
        }
        VectorLocation::Memory(area, index) => {
            let register = match area {
                Area::Inputs => Iced::RDI,
                Area::Outputs => Iced::RDX,
                Area::Frame => Iced::RSI,
            };
            let distance = 8 * width.lanes() as u64;
            assert_eq!(found.op_kind(operand), OpKind::Memory, "{place:?}");
            assert_eq!(found.memory_base(), register, "{place:?}");
            assert_eq!(found.memory_index(), Iced::None, "{place:?}");
            assert!(!found.is_broadcast(), "{place:?}");
            assert_eq!(found.memory_displacement64(), u64::from(index) * distance, "{place:?}");
        }
    }
    assert_eq!(found.op_mask(), Iced::None, "no lane is masked");
}

/// Assembles a single instruction and reads it back.
fn one(width: Width, emit: impl FnOnce(&mut Assembler)) -> Instruction {
    let mut assembler = Assembler::new(width);
    emit(&mut assembler);
    decoded(&assembler.bytes)
}

#[test]
fn a_disassembler_reads_what_was_meant() {
    for width in WIDTHS {
        let registers = 0..width.registers() as u8;
        for (place, target) in places(width)
            .into_iter()
            .flat_map(|place| registers.clone().step_by(3).map(move |target| (place, target)))
        {
            let second = (target * 7 + 5) % width.registers() as u8;
            let found = one(width, |to| to.load(target, place));
            assert_eq!(found.mnemonic(), Mnemonic::Vmovupd, "load");
            assert_operand(width, &found, 0, VectorLocation::Register(target));
            assert_operand(width, &found, 1, place);
            let found = one(width, |to| to.square_root(target, place));
            assert_eq!(found.mnemonic(), Mnemonic::Vsqrtpd, "square root");
            assert_operand(width, &found, 0, VectorLocation::Register(target));
            assert_operand(width, &found, 1, place);
            if let VectorLocation::Memory(area, index) = place {
                let found = one(width, |to| to.store(area, index, target));
                assert_eq!(found.mnemonic(), Mnemonic::Vmovupd, "store");
                assert_operand(width, &found, 0, place);
                assert_operand(width, &found, 1, VectorLocation::Register(target));
            }
            let three = |found: &Instruction| {
                assert_operand(width, found, 0, VectorLocation::Register(target));
                assert_operand(width, found, 1, VectorLocation::Register(second));
                assert_operand(width, found, 2, place);
            };
            for (pair, mnemonic) in PAIRS {
                let found = one(width, |to| to.pair(pair, target, second, place));
                assert_eq!(found.mnemonic(), mnemonic, "{pair:?}");
                three(&found);
            }
            for (order, signs, mnemonic) in FUSED {
                let found = one(width, |to| to.fused(order, signs, target, second, place));
                assert_eq!(found.mnemonic(), mnemonic, "{order:?} {signs:?}");
                three(&found);
            }
        }
    }
}

#[test]
fn comparisons_are_read_back_with_their_predicates() {
    let comparisons =
        [(Comparison::Greater, 30), (Comparison::NotGreater, 26), (Comparison::NotAtLeast, 25)];
    for width in WIDTHS {
        for (place, (comparison, predicate)) in
            places(width).into_iter().flat_map(|place| comparisons.map(|one| (place, one)))
        {
            for (target, second) in [(0, 5), (9, 13), (width.registers() as u8 - 1, 2)] {
                let mut assembler = Assembler::new(width);
                assembler.pair(PairInstruction::Compare(comparison), target, second, place);
                let decoder = Decoder::with_ip(64, &assembler.bytes, 0, DecoderOptions::NONE);
                let found: Vec<Instruction> = decoder.into_iter().collect();
                assert_eq!(found[0].mnemonic(), Mnemonic::Vcmppd, "{width:?}");
                assert_eq!(found[0].immediate(3), predicate, "{comparison:?}");
                assert_operand(width, &found[0], 1, VectorLocation::Register(second));
                assert_operand(width, &found[0], 2, place);
                let result = match width {
                    Width::Four => &found[0],
                    Width::Eight => {
                        assert_eq!(found[0].op_register(0), Iced::K1, "to a mask");
                        assert_eq!(found[1].mnemonic(), Mnemonic::Vpmovm2q, "and from it");
                        assert_eq!(found[1].op_register(1), Iced::K1, "the same mask");
                        &found[1]
                    }
                };
                assert_operand(width, result, 0, VectorLocation::Register(target));
                assert_eq!(found.len(), if width == Width::Four { 1 } else { 2 }, "no more");
            }
        }
    }
}

#[test]
fn a_loop_ends_and_goes_back_to_its_beginning() {
    for (width, copies) in
        WIDTHS.into_iter().flat_map(|width| [1, 2, 4].map(|copies| (width, copies)))
    {
        let in_row = (crate::engine::ROW_STATES / width.lanes()) as u32;
        let mut assembler = Assembler::new(width);
        assembler.load(3, VectorLocation::Memory(Area::Inputs, 4 * in_row + copies - 1));
        assembler.store(Area::Outputs, 2 * in_row, 3);
        assembler.pair(PairInstruction::Add, 1, 3, VectorLocation::Memory(Area::Frame, 9));
        let assembly = assembler.finish(copies as usize);
        let extent = MemoryExtent { inputs: 5, outputs: 3, frame: 10 };
        assert_eq!(assembly.extent, extent, "all memory that is touched");
        let mut beyond = Assembler::new(width);
        beyond.load(3, VectorLocation::Memory(Area::Inputs, 4 * in_row + copies));
        assert_eq!(beyond.finish(copies as usize).extent.inputs, 6, "in the last turn");
        let decoder = Decoder::with_ip(64, &assembly.bytes, 0, DecoderOptions::NONE);
        let found: Vec<Instruction> = decoder.into_iter().collect();
        let mnemonics: Vec<Mnemonic> = found[3..].iter().map(|one| one.mnemonic()).collect();
        let expected = [
            Mnemonic::Add,
            Mnemonic::Add,
            Mnemonic::Dec,
            Mnemonic::Jne,
            Mnemonic::Vzeroupper,
            Mnemonic::Ret,
        ];
        assert_eq!(mnemonics, expected, "the end of the loop");
        for (add, register) in found[3..5].iter().zip([Iced::RDI, Iced::RDX]) {
            assert_eq!(add.op_register(0), register, "rows go on");
            let step = 8 * u64::from(copies) * width.lanes() as u64;
            assert_eq!(add.immediate(1), step, "by the vectors of a turn");
        }
        assert_eq!(found[5].op_register(0), Iced::RCX, "turns are counted");
        assert_eq!(found[6].near_branch_target(), 0, "back to the beginning");
    }
}

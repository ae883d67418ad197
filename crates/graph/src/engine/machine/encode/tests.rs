//! Tests of loops: a disassembler reads their code back.

use iced_x86::{Decoder, DecoderOptions, Instruction, Mnemonic, OpKind, Register as Iced};

use super::*;

const WIDTHS: [Width; 2] = [Width::Four, Width::Eight];

#[test]
fn areas_have_pointers_of_their_own() {
    for width in WIDTHS {
        for (area, pointer) in
            [(Area::Inputs, Iced::RDI), (Area::Outputs, Iced::RDX), (Area::Frame, Iced::RSI)]
        {
            for index in [0, 1, 15, 16, 17, 127, 128, 100_000] {
                let mut assembler = Assembler::new(width);
                assembler.store(area, index, 3);
                let bytes = assembler.encoder.bytes();
                let found = Decoder::with_ip(64, bytes, 0, DecoderOptions::NONE).decode();
                assert_eq!(found.op_kind(0), OpKind::Memory, "{area:?}");
                assert_eq!(found.memory_base(), pointer, "{area:?}");
                let distance = u64::from(index) * 8 * width.numbers() as u64;
                assert_eq!(found.memory_displacement64(), distance, "place {index}");
            }
        }
    }
}

#[test]
fn a_loop_ends_and_goes_back_to_its_beginning() {
    for (width, copies) in
        WIDTHS.into_iter().flat_map(|width| [1, 2, 4].map(|copies| (width, copies)))
    {
        let in_row = (crate::engine::ROW_STATES / width.numbers()) as u32;
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
            let step = 8 * u64::from(copies) * width.numbers() as u64;
            assert_eq!(add.immediate(1), step, "by the vectors of a turn");
        }
        assert_eq!(found[5].op_register(0), Iced::RCX, "turns are counted");
        assert_eq!(found[6].near_branch_target(), 0, "back to the beginning");
    }
}

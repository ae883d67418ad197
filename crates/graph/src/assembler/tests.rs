//! Tests of the encoder: a disassembler reads its code back.

use iced_x86::{Decoder, DecoderOptions, Instruction, Mnemonic, OpKind, Register as Iced};

use super::*;

const WIDTHS: [Width; 3] = [Width::One, Width::Four, Width::Eight];
const POINTERS: [(Pointer, Iced); 4] = [
    (Pointer::Rdi, Iced::RDI),
    (Pointer::Rsi, Iced::RSI),
    (Pointer::Rdx, Iced::RDX),
    (Pointer::Rcx, Iced::RCX),
];
/// Distances on both sides of those that fit one byte.
const DISTANCES: [i32; 16] =
    [-1025, -1024, -17, -16, -9, -1, 0, 1, 8, 15, 16, 1000, 1016, 1024, 1 << 20, -(1 << 20)];
/// Instructions of vectors, with their names for one number.
const PAIRS: [(PairInstruction, Mnemonic, Option<Mnemonic>); 7] = [
    (PairInstruction::Add, Mnemonic::Vaddpd, Some(Mnemonic::Vaddsd)),
    (PairInstruction::Sub, Mnemonic::Vsubpd, Some(Mnemonic::Vsubsd)),
    (PairInstruction::Mul, Mnemonic::Vmulpd, Some(Mnemonic::Vmulsd)),
    (PairInstruction::Div, Mnemonic::Vdivpd, Some(Mnemonic::Vdivsd)),
    (PairInstruction::And, Mnemonic::Vandpd, None),
    (PairInstruction::Or, Mnemonic::Vorpd, None),
    (PairInstruction::Xor, Mnemonic::Vxorpd, None),
];
const FUSED: [(OperandOrder, SumSigns, Mnemonic, Mnemonic); 9] = [
    (OperandOrder::O132, SumSigns::Add, Mnemonic::Vfmadd132pd, Mnemonic::Vfmadd132sd),
    (OperandOrder::O213, SumSigns::Add, Mnemonic::Vfmadd213pd, Mnemonic::Vfmadd213sd),
    (OperandOrder::O231, SumSigns::Add, Mnemonic::Vfmadd231pd, Mnemonic::Vfmadd231sd),
    (OperandOrder::O132, SumSigns::Sub, Mnemonic::Vfmsub132pd, Mnemonic::Vfmsub132sd),
    (OperandOrder::O213, SumSigns::Sub, Mnemonic::Vfmsub213pd, Mnemonic::Vfmsub213sd),
    (OperandOrder::O231, SumSigns::Sub, Mnemonic::Vfmsub231pd, Mnemonic::Vfmsub231sd),
    (OperandOrder::O132, SumSigns::NegAdd, Mnemonic::Vfnmadd132pd, Mnemonic::Vfnmadd132sd),
    (OperandOrder::O213, SumSigns::NegAdd, Mnemonic::Vfnmadd213pd, Mnemonic::Vfnmadd213sd),
    (OperandOrder::O231, SumSigns::NegAdd, Mnemonic::Vfnmadd231pd, Mnemonic::Vfnmadd231sd),
];

/// Assembles some instructions and reads them back.
fn all(emit: impl FnOnce(&mut Encoder)) -> Vec<Instruction> {
    let mut encoder = Encoder::default();
    emit(&mut encoder);
    let decoder = Decoder::with_ip(64, encoder.bytes(), 0, DecoderOptions::NONE);
    let found: Vec<Instruction> = decoder.into_iter().collect();
    assert!(found.iter().all(|one| !one.is_invalid()), "{:02x?}", encoder.bytes());
    found
}

fn one(emit: impl FnOnce(&mut Encoder)) -> Instruction {
    let found = all(emit);
    assert_eq!(found.len(), 1, "one instruction: {found:?}");
    found[0]
}

fn vector(width: Width, register: Register) -> Iced {
    let first = match width {
        Width::One => Iced::XMM0,
        Width::Four => Iced::YMM0,
        Width::Eight => Iced::ZMM0,
    };
    first + u32::from(register)
}

fn places(width: Width) -> Vec<Operand> {
    let registers = (0..width.registers() as u8).map(Operand::Register);
    let memory = POINTERS
        .iter()
        .flat_map(|(pointer, _)| DISTANCES.map(|distance| Operand::Memory(*pointer, distance)));
    registers.chain(memory).collect()
}

fn assert_operand(width: Width, found: &Instruction, operand: u32, place: Operand) {
    match place {
        Operand::Register(register) => {
            assert_eq!(found.op_register(operand), vector(width, register), "{place:?}");
        }
        Operand::Memory(pointer, distance) => {
            let base = POINTERS.iter().find(|(own, _)| *own == pointer).map(|(_, base)| *base);
            assert_eq!(found.op_kind(operand), OpKind::Memory, "{place:?}");
            assert_eq!(Some(found.memory_base()), base, "{place:?}");
            assert_eq!(found.memory_index(), Iced::None, "{place:?}");
            assert!(!found.is_broadcast(), "{place:?}");
            let bytes = found.memory_displacement64() as i64;
            assert_eq!(bytes, 8 * i64::from(distance), "{place:?}");
        }
    }
    assert_eq!(found.op_mask(), Iced::None, "no number is masked");
}

/// Calls a test for all widths and places, with some registers.
fn for_all(test: impl Fn(Width, Operand, [Register; 2])) {
    for width in WIDTHS {
        let registers = width.registers() as u8;
        for place in places(width) {
            for target in (0..registers).step_by(3).chain([registers - 1]) {
                test(width, place, [target, (target * 7 + 5) % registers]);
            }
        }
    }
}

#[test]
fn a_disassembler_reads_moves_and_roots() {
    for_all(|width, place, [target, _]| {
        let named = |one, more| if width == Width::One { one } else { more };
        let root = one(|to| to.square_root(width, target, place));
        assert_eq!(root.mnemonic(), named(Mnemonic::Vsqrtsd, Mnemonic::Vsqrtpd), "square root");
        assert_operand(width, &root, 0, Operand::Register(target));
        assert_operand(width, &root, if width == Width::One { 2 } else { 1 }, place);
        let Operand::Memory(pointer, distance) = place else { return };
        let moves = named(Mnemonic::Vmovsd, Mnemonic::Vmovupd);
        let load = one(|to| to.load(width, target, place));
        assert_eq!(load.mnemonic(), moves, "load");
        assert_operand(width, &load, 0, Operand::Register(target));
        assert_operand(width, &load, 1, place);
        let store = one(|to| to.store(width, (pointer, distance), target));
        assert_eq!(store.mnemonic(), moves, "store");
        assert_operand(width, &store, 0, place);
        assert_operand(width, &store, 1, Operand::Register(target));
    });
}

#[test]
fn a_disassembler_reads_loads_between_registers() {
    for width in [Width::Four, Width::Eight] {
        for register in 0..width.registers() as u8 {
            let found = one(|to| to.load(width, 1, Operand::Register(register)));
            assert_eq!(found.mnemonic(), Mnemonic::Vmovupd, "load");
            assert_operand(width, &found, 0, Operand::Register(1));
            assert_operand(width, &found, 1, Operand::Register(register));
        }
    }
}

#[test]
fn a_disassembler_reads_what_was_meant() {
    for_all(|width, place, [target, second]| {
        let three = |found: &Instruction| {
            assert_operand(width, found, 0, Operand::Register(target));
            assert_operand(width, found, 1, Operand::Register(second));
            assert_operand(width, found, 2, place);
        };
        for (pair, of_vectors, of_one) in PAIRS {
            let mnemonic = if width == Width::One { of_one } else { Some(of_vectors) };
            let Some(mnemonic) = mnemonic else { continue };
            let found = one(|to| to.pair(width, pair, [target, second], place));
            assert_eq!(found.mnemonic(), mnemonic, "{pair:?}");
            three(&found);
        }
        for (order, signs, of_vectors, of_one) in FUSED {
            let found = one(|to| to.fused(width, (order, signs), [target, second], place));
            let mnemonic = if width == Width::One { of_one } else { of_vectors };
            assert_eq!(found.mnemonic(), mnemonic, "{order:?} {signs:?}");
            three(&found);
        }
    });
}

#[test]
fn comparisons_are_read_back_with_their_predicates() {
    let comparisons =
        [(Comparison::Greater, 30), (Comparison::NotGreater, 26), (Comparison::NotAtLeast, 25)];
    for_all(|width, place, [target, second]| {
        for (comparison, predicate) in comparisons.into_iter().filter(|_| width != Width::One) {
            let pair = PairInstruction::Compare(comparison);
            let found = all(|to| to.pair(width, pair, [target, second], place));
            assert_eq!(found[0].mnemonic(), Mnemonic::Vcmppd, "{width:?}");
            assert_eq!(found[0].immediate(3), predicate, "{comparison:?}");
            assert_operand(width, &found[0], 1, Operand::Register(second));
            assert_operand(width, &found[0], 2, place);
            let expected = match width {
                Width::Eight => {
                    assert_eq!(found[0].op_register(0), Iced::K1, "to a mask");
                    assert_eq!(found[1].mnemonic(), Mnemonic::Vpmovm2q, "and from it");
                    assert_eq!(found[1].op_register(1), Iced::K1, "the same mask");
                    2
                }
                _ => 1,
            };
            assert_operand(width, &found[expected - 1], 0, Operand::Register(target));
            assert_eq!(found.len(), expected, "no more");
        }
    });
}

#[test]
fn a_disassembler_reads_what_moves_numbers_between_registers() {
    for width in [Width::Four, Width::Eight] {
        let registers = width.registers() as u8;
        for target in 0..registers {
            let [x, y] = [(target * 7 + 5) % registers, (target * 3 + 11) % registers];
            let three = |found: &Instruction, mnemonic| {
                assert_eq!(found.mnemonic(), mnemonic, "{found:?}");
                for (operand, own) in [target, x, y].into_iter().enumerate() {
                    assert_operand(width, found, operand as u32, Operand::Register(own));
                }
            };
            let mixed = |odd| one(|to| to.mix(width, odd, [target, x, y]));
            three(&mixed(false), Mnemonic::Vunpcklpd);
            three(&mixed(true), Mnemonic::Vunpckhpd);
            let pairs = [
                PairSelection::Lower,
                PairSelection::Upper,
                PairSelection::Even,
                PairSelection::Odd,
            ];
            let (shuffle, choices) = match width {
                Width::Eight => (Mnemonic::Vshuff64x2, [0x44, 0xee, 0x88, 0xdd]),
                _ => (Mnemonic::Vperm2f128, [0x20, 0x31, 0x20, 0x31]),
            };
            for (which, choice) in pairs.into_iter().zip(choices) {
                let found = one(|to| to.pairs(width, which, [target, x, y]));
                three(&found, shuffle);
                assert_eq!(found.immediate(3), choice, "{found:?}");
            }
        }
    }
    for register in 0..16 {
        let found = one(|to| to.zero(register));
        assert_eq!(found.mnemonic(), Mnemonic::Vxorpd, "zero");
        let own = Operand::Register(register);
        (0..3).for_each(|operand| assert_operand(Width::One, &found, operand, own));
    }
}

#[test]
fn a_disassembler_reads_jumps_calls_and_addresses() {
    let mut landed = 0;
    let found = all(|to| {
        let jump = to.jump();
        let label = to.label();
        to.give_back();
        landed = to.bytes().len() as u64;
        to.land(&jump);
        to.keep();
        to.point(Pointer::Rdi, 40);
        to.point(Pointer::Rsi, 1 << 20);
        to.call(label);
        to.advance(Pointer::Rcx, 40);
        to.repeat(label);
        to.end();
    });
    let [jump, back, keep, rows, copies, call, sums, down, again, ..] = found[..] else {
        panic!("{found:?}")
    };
    assert_eq!((jump.mnemonic(), jump.near_branch_target()), (Mnemonic::Jmp, landed));
    assert_eq!(back.mnemonic(), Mnemonic::Ret);
    assert_eq!(keep.mnemonic(), Mnemonic::Mov);
    assert_eq!((keep.op_register(0), keep.op_register(1)), (Iced::R8, Iced::RDI));
    for (found, register, distance) in [(rows, Iced::RDI, 320), (copies, Iced::RSI, 8 << 20)] {
        assert_eq!((found.mnemonic(), found.op_register(0)), (Mnemonic::Lea, register));
        assert_eq!(found.op_kind(1), OpKind::Memory);
        assert_eq!((found.memory_base(), found.memory_index()), (Iced::R8, Iced::None));
        assert_eq!(found.memory_displacement64(), distance);
    }
    let subroutine = jump.next_ip();
    assert_eq!((call.mnemonic(), call.near_branch_target()), (Mnemonic::Call, subroutine));
    assert_eq!((sums.mnemonic(), sums.op_register(0)), (Mnemonic::Add, Iced::RCX));
    assert_eq!(sums.immediate(1), 320);
    assert_eq!((down.mnemonic(), down.op_register(0)), (Mnemonic::Dec, Iced::RCX));
    assert_eq!((again.mnemonic(), again.near_branch_target()), (Mnemonic::Jne, subroutine));
    let end: Vec<Mnemonic> = found[9..].iter().map(Instruction::mnemonic).collect();
    assert_eq!(end, [Mnemonic::Vzeroupper, Mnemonic::Ret]);
}

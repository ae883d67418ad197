"""The native part: text, JSON and bytes. Its interface is that of this package alone."""

from os import PathLike
from typing import final

VERSION: str

_Given = str | list[str]
_Settings = list[tuple[str, str]]
_Problem = tuple[int, str, str]
_Data = tuple[list[str], bytearray]
_Place = tuple[str | None, str | None, list[_Given]]
_Counts = tuple[int | None, int | None, int | None]

@final
class Case:
    def __new__(cls, text: str, name: str, settings: _Settings) -> Case: ...
    @staticmethod
    def open(path: str | PathLike[str], settings: _Settings) -> Case: ...
    @property
    def name(self) -> str: ...
    @property
    def text(self) -> str: ...
    @property
    def title(self) -> str: ...
    @property
    def source(self) -> str: ...
    @property
    def system(self) -> str: ...
    @property
    def digest(self) -> str: ...
    @property
    def remarks(self) -> list[str]: ...
    @property
    def state(self) -> list[str]: ...
    @property
    def parameters(self) -> list[tuple[str, str]]: ...
    @property
    def claims(self) -> list[tuple[str, str, str | None]]: ...

@final
class Function:
    @property
    def shapes(self) -> list[list[int]]: ...
    def __call__(self, states: bytes) -> bytearray: ...

@final
class Job:
    def __new__(
        cls, case: Case, settings: list[str], arguments: list[str], table: str | None
    ) -> Job: ...
    @property
    def key(self) -> str: ...
    @property
    def units(self) -> int: ...
    def file_name(self, index: int, count: int) -> str: ...
    def is_part(self, index: int, count: int, text: str) -> bool: ...
    def part(self, index: int, count: int, threads: int | None) -> str: ...
    def report(self, texts: list[str]) -> str: ...
    def chart(
        self, texts: list[str]
    ) -> tuple[list[tuple[str, bytearray]], bytearray, list[_Problem]]: ...
    def section(self, texts: list[str]) -> tuple[_Data, list[_Problem]]: ...
    def exponents(self, texts: list[str]) -> str: ...

def answer(
    case: Case,
    settings: list[str],
    arguments: list[str],
    table: str | None,
    threads: int | None,
) -> str: ...
def save(folder: str | PathLike[str], name: str, text: str) -> None: ...
def canonical(name: str) -> str | None: ...
def catalogue() -> list[str]: ...
def run(arguments: list[str]) -> int: ...
def check(
    case: Case, sampling: tuple[int, int, str], mutants: bool, motion: bool, threads: int | None
) -> str: ...
def search(
    case: Case,
    scope: tuple[int, int, bool],
    terms: list[str],
    conditions: str | None,
    ansatz: int | None,
    kinds: tuple[bool, bool],
    poisson: str | None,
    limits: tuple[float | None, float, int],
    threads: int | None,
) -> str: ...
def report(case: Case, format: str, seed: int, threads: int | None) -> str: ...
def function(case: Case, formulas: list[str] | None, seed: int, index: int) -> Function: ...
def parameter_values(
    case: Case, seed: int, index: int
) -> list[tuple[str, list[int], list[str]]]: ...
def program(
    case: Case, formulas: list[str] | None, abbreviations: list[tuple[str, str]]
) -> str: ...
def orbits(
    case: Case,
    given: list[_Given | None],
    samples: tuple[str, str, str | None],
    double_double: bool,
    draw: tuple[int, int],
    threads: int | None,
) -> tuple[list[str], list[tuple[bytearray, str | None, _Problem | None]]]: ...
def section(
    case: Case,
    place: _Place,
    counts: _Counts,
    course: tuple[str | None, bool],
    seed: int,
    threads: int | None,
) -> tuple[_Data, list[_Problem]]: ...
def surface(
    case: Case,
    texts: tuple[str, str | None],
    launch: tuple[str | None, list[_Given | None]],
    counts: tuple[int, int],
    course: tuple[str | None, bool],
    seed: int,
    threads: int | None,
) -> tuple[_Data, list[_Problem]]: ...
def chart(
    case: Case,
    texts: tuple[str, str],
    size: list[int],
    time: float,
    place: _Place,
    state: str | None,
    seed: int,
    threads: int | None,
) -> tuple[list[tuple[str, bytearray]], bytearray, list[_Problem]]: ...
def exponents(
    case: Case,
    given: list[_Given | None],
    names: list[str],
    time: float,
    modes: tuple[bool, bool],
    draw: tuple[int, int],
    threads: int | None,
) -> str: ...

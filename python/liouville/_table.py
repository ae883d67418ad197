"""Sequences of records that become tables of pandas, Arrow and notebooks."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from html import escape
from typing import Any, Generic, TypeVar, overload

Record = TypeVar("Record")


class Table(Sequence, Generic[Record]):
    """A sequence of records."""

    def _records(self) -> list[Record]:
        raise NotImplementedError

    def to_dicts(self) -> list[dict[str, Any]]:
        """Rows with plain values, all with the same keys."""
        raise NotImplementedError

    def __len__(self) -> int:
        return len(self._records())

    def __iter__(self) -> Iterator[Record]:
        return iter(self._records())

    @overload
    def __getitem__(self, place: int) -> Record: ...
    @overload
    def __getitem__(self, place: slice) -> list[Record]: ...
    def __getitem__(self, place):
        return self._records()[place]

    def to_pandas(self):
        """Rows as a `pandas.DataFrame`."""
        import pandas

        return pandas.DataFrame(self.to_dicts())

    def to_arrow(self):
        """Rows as a `pyarrow.Table`, which polars and DuckDB read without a copy."""
        import pyarrow

        return pyarrow.Table.from_pylist(self.to_dicts())


def html(caption: str, rows: list[dict[str, Any]], colour=lambda row: "") -> str:
    """Rows as an HTML table; `colour` gives the colour of a row's last cell."""
    if not rows:
        return f"<p>{escape(caption)}</p>"
    head = "".join(f"<th style='text-align:left'>{escape(str(name))}</th>" for name in rows[0])
    body = []
    for row in rows:
        style = f"text-align:left;{colour(row)}"
        cells = "".join(
            f"<td style='{style}'>{escape('' if value is None else str(value))}</td>"
            for value in row.values()
        )
        body.append(f"<tr>{cells}</tr>")
    return (
        f"<table><caption style='text-align:left'>{escape(caption)}</caption>"
        f"<thead><tr>{head}</tr></thead><tbody>{''.join(body)}</tbody></table>"
    )

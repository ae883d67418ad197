"""Jobs in parts: on the workers of a Dask cluster, or one after another; files to resume from."""

from __future__ import annotations

import functools
import json
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from . import _liouville as native
from .bodies import BodyTable, written
from .described import Described

MOST_PARTS = 1000
"""Largest number of parts that is chosen where none is given."""
MOTIONS = 8
"""Motions of a part where their number is not given: as many as one thread follows at once."""
STATES = 1 << 24
"""States of a part of a sweep where their number is not given."""
BODIES = 200
"""Bodies of a part of `check` where their number is not given: a second or two."""
REPORTS = 10
"""Bodies of a part of `report` where their number is not given: some seconds."""
RETRIES = 3
"""Number of further attempts at a part after an error on a worker."""


@dataclass(frozen=True)
class Recipe:
    """A job as workers receive it."""

    text: str
    name: str
    settings: tuple[tuple[str, str], ...]
    arguments: tuple[str, ...]
    table: str | None = None

    def job(self) -> native.Job:
        """The job, ready to compute."""
        case = native.Case(self.text, self.name, list(self.settings))
        settings = [f"{name}={value}" for name, value in self.settings]
        return native.Job(case, settings, list(self.arguments), self.table)


@dataclass(frozen=True)
class Share:
    """Ways to share a job: the workers of a client, a number of parts, a folder for their files."""

    client: Any
    parts: int | None
    out: str | Path | None
    threads: int | None

    def __bool__(self) -> bool:
        """Whether a job in parts is asked for."""
        return (self.client, self.parts, self.out) != (None, None, None)

    def refuse(self) -> None:
        """Refuses what belongs to a table of bodies where there is none."""
        if self:
            raise ValueError("client, parts and out are for a table of bodies: give settings")

    def run(
        self,
        case: Described,
        command: tuple[str, ...],
        options: dict[str, Any],
        *,
        words: Iterable[str] = (),
        table: str | None = None,
        units: int = MOTIONS,
    ) -> tuple[native.Job, list[str]]:
        """Computes a job about a case; returns it with the texts of its parts.

        `table` is the text of the file that the words name, `units` the number of units of a part
        where the number of parts is not given.
        """
        settings = tuple(case._settings.items())
        given = [f"--set={name}={value}" for name, value in settings]
        arguments = (*command, case.name, *given, *words, *worded(options))
        recipe = Recipe(case.text, case.name, settings, arguments, table)
        return _run(recipe, self, units)

    def section(
        self, case: Described, given: list[Any], options: dict[str, Any]
    ) -> tuple[native.Job, list[str]]:
        """Follows motions through a section."""
        words, text = begun(given)
        return self.run(case, ("motion", "section"), options, words=words, table=text)

    def exponents(
        self, case: Described, given: list[Any], names: list[str], options: dict[str, Any]
    ) -> dict[str, Any]:
        """Exponents of motions with these names."""
        words, text = begun(given)
        job, texts = self.run(case, ("motion", "exponents"), options, words=words, table=text)
        found = json.loads(job.exponents(texts))
        for name, motion in zip(names, found["motions"], strict=True):
            motion["start"] = name
        return found

    def bodies(
        self, case: Described, command: str, table: BodyTable, options: dict[str, Any]
    ) -> dict[str, Any]:
        """Answers of `check` or `report` about a table of bodies."""
        name, text = written(table)
        share = self if self else Share(None, 1, None, self.threads)
        words = [f"--settings={name}"]
        units = BODIES if command == "check" else REPORTS
        wanted = options | {"json": True}
        job, texts = share.run(case, (command,), wanted, words=words, table=text, units=units)
        return json.loads(job.report(texts))

    def sweep(
        self, case: Described, claims: Iterable[str], options: dict[str, Any]
    ) -> dict[str, Any]:
        """Residuals of claims; in one part if none are asked for."""
        share = self if self else Share(None, 1, None, self.threads)
        words = [f"--claim={claim}" for claim in claims]
        job, texts = share.run(case, ("sweep",), options, words=words, units=STATES)
        return json.loads(job.report(texts))


@functools.lru_cache(maxsize=4)
def _job(recipe: Recipe) -> native.Job:
    return recipe.job()


def _known(job: native.Job, index: int, count: int, path: Path) -> str | None:
    """Text of a part that is there and whole; a file of something else does not count as there."""
    try:
        text = path.read_text(encoding="utf-8")
    except (FileNotFoundError, UnicodeDecodeError):
        return None
    return text if job.is_part(index, count, text) else None


def _same(recipe: Recipe) -> Recipe:
    """The recipe as a result of its own, which tasks refer to in place of holding it."""
    return recipe


def _compute(recipe: Recipe, index: int, count: int, folder: str | None, name: str) -> str:
    """A part on a worker, which keeps it in the folder if it sees the folder."""
    job = _job(recipe)
    shared = Path(folder) if folder and Path(folder).is_dir() else None
    if shared and (text := _known(job, index, count, shared / name)) is not None:
        return text
    text = job.part(index, count, 1)
    if shared:
        native.save(shared, name, text)
    return text


def _run(recipe: Recipe, share: Share, units: int) -> tuple[native.Job, list[str]]:
    """Computes all parts of a job that are not in the folder yet.

    The number of parts does not depend on that of the workers, so that a later run finds the parts
    of an earlier one.
    """
    client, parts, out, threads = share.client, share.parts, share.out, share.threads
    job = recipe.job()
    count = parts if parts is not None else max(1, min(MOST_PARTS, job.units // units))
    if not isinstance(count, int) or count < 1:
        raise ValueError("parts is a number of parts, 1 or more")
    first = job.file_name(1, count)
    names = {k: first.replace("-0001-of-", f"-{k:04}-of-") for k in range(1, count + 1)}
    texts: dict[int, str] = {}
    folder = None
    if out is not None:
        folder = Path(out).expanduser().absolute()
        folder.mkdir(parents=True, exist_ok=True)
        known = ((k, _known(job, k, count, folder / name)) for k, name in names.items())
        texts = {index: text for index, text in known if text is not None}
    missing = [index for index in names if index not in texts]
    found: Iterable[tuple[int, str]]
    if client is None:
        found = ((index, job.part(index, count, threads)) for index in missing)
    else:
        found = _on(client, recipe, job.key, missing, count, folder, names)
    for index, text in found:
        texts[index] = text
        if folder and _known(job, index, count, folder / names[index]) is None:
            native.save(folder, names[index], text)
    return job, [texts[index] for index in sorted(texts)]


def _on(
    client: Any,
    recipe: Recipe,
    key: str,
    missing: list[int],
    count: int,
    folder: Path | None,
    names: dict[int, str],
) -> Iterable[tuple[int, str]]:
    """Parts as workers finish them. Those of a worker that is lost are computed by another.

    The recipe is a task too: it is sent once, and made again if the worker that holds it is lost.
    """
    from distributed import as_completed

    if getattr(client, "asynchronous", False):
        raise TypeError("client is a synchronous client: Client(...), without asynchronous=True")
    place = None if folder is None else str(folder)
    shared = client.submit(_same, recipe, retries=RETRIES)
    futures = {
        client.submit(
            _compute,
            shared,
            index,
            count,
            place,
            names[index],
            key=f"liouville-{key}-{index:04}-of-{count:04}",
            retries=RETRIES,
        ): index
        for index in missing
    }
    try:
        for future, text in as_completed(list(futures), with_results=True):
            yield futures.pop(future), text
            future.release()
    finally:
        client.cancel([*futures, shared])


def begun(given: list[str | list[str] | None]) -> tuple[list[str], str | None]:
    """Arguments for the starts of motions, and the text of the file that they name."""
    if None in given:
        raise ValueError("give the starts: a drawn state has no name")
    if given and all(isinstance(one, list) for one in given):
        lines = [",".join(one) for one in given if isinstance(one, list)]
        return ["--starts=starts.csv"], "\n".join(lines) + "\n"
    words = [one if isinstance(one, str) else ",".join(one or []) for one in given]
    return [f"--start={word}" for word in words], None


def worded(values: dict[str, Any]) -> list[str]:
    """Arguments of a command, without those that are not given."""
    found = []
    for name, value in values.items():
        option = "--" + name.replace("_", "-")
        if value is True:
            found.append(option)
        elif value is not None and value is not False:
            found.append(f"{option}={value}")
    return found

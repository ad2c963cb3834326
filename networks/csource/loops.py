"""Loops: long rows of statements, as CasADi writes them, told once for each form that elements repeat.

A thousand springs make a thousand times the same statements. What is used once goes into the expression that
uses it; expressions that differ only in the places they read and write become one loop; and what reads
another's result comes after it. Compilers take more than their share of time for long functions, so what is
left is dealt out to functions of their own.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

READ = re.compile(r"(w|arg\[\d+\])\[(\d+)\]")
STATEMENT = re.compile(r"  (w|res\[\d+\])\[(\d+)\]=(.*);\n")
MOST_READS, FEWEST_MEMBERS, PART_LENGTH = 24, 4, 200
PLACEHOLDER = "{}"
Place = tuple[str, int]


@dataclass(eq=False)
class _Value:
    """An expression: its text, with a hole for everything it reads."""

    text: str
    reads: list[_Value | Place]
    uses: int = 0
    level: int = 0
    place: Place | None = None

    @property
    def is_leaf(self) -> bool:
        """Whether it is a number or a copy."""
        return self.text == PLACEHOLDER or not self.reads

    def absorb(self) -> None:
        """Take in what is read by this alone."""
        pieces, reads, room = list[str](), list[_Value | Place](), MOST_READS - len(self.reads)
        for read in self.reads:
            if isinstance(read, _Value) and (read.is_leaf or (read.uses == 1 and len(read.reads) <= room)):
                room -= len(read.reads)
                pieces.append(_bracketed(read.text))
                reads += read.reads
                read.uses -= 1
            else:
                pieces.append(PLACEHOLDER)
                reads.append(read)
        self.text, self.reads = self.text.format(*pieces), reads
        self.level = 1 + max((read.level for read in reads if isinstance(read, _Value)), default=0)


_Loop = list[_Value]  # of one form, which do not read each other's results


def looped(statements: Sequence[str], name: str) -> tuple[str, str, int]:
    """Return functions that do what statements do, calls of them, and the room they need in `w`."""
    values = _values(statements)
    loops = _loops([value for value in values if value.uses])
    room = _give_places(loops)
    pieces = [piece for loop in loops for piece in _written(loop)]
    functions, calls = "", ""
    for number in range(0, len(pieces), PART_LENGTH):
        part = f"{name}_{number // PART_LENGTH}"
        body = "".join(pieces[number : number + PART_LENGTH])
        functions += f"PART void {part}(const double **arg, double **res, double *w) {{\n{body}}}\n\n"
        calls += f"  {part}(arg, res, w);\n"
    return functions, calls, room


def _values(statements: Sequence[str]) -> list[_Value]:
    """Return the values that statements make, results among them, those that are read once joined."""
    held: dict[int, _Value] = {}
    values: list[_Value] = []
    for statement in statements:
        match = STATEMENT.fullmatch(statement)
        if match is None:
            raise ValueError(f"not a statement of a program: {statement!r}")
        target, place, text = match.group(1), int(match.group(2)), match.group(3)
        reads = [held[int(at)] if kind == "w" else (kind, int(at)) for kind, at in READ.findall(text)]
        for read in reads:
            if isinstance(read, _Value):
                read.uses += 1
        value = _Value(READ.sub(PLACEHOLDER, text), reads)
        values.append(value)
        if target == "w":
            held[place] = value
        else:
            value.uses, value.place = 1, (target, place)
    for value in values:
        value.absorb()
    return values


def _loops(values: Sequence[_Value]) -> list[_Loop]:
    loops: dict[tuple[object, ...], _Loop] = {}
    for value in values:
        arrays = [read[0] if isinstance(read, tuple) else "w" for read in value.reads]
        key = value.level, value.place and value.place[0], value.text, *arrays
        loops.setdefault(key, []).append(value)
    return sorted(loops.values(), key=lambda loop: loop[0].level)


def _give_places(loops: Sequence[_Loop]) -> int:
    """Put what is no result side by side into `w`, and return how much that is."""
    homeless = [value for loop in loops for value in loop if value.place is None]
    for room, value in enumerate(homeless):
        value.place = "w", room
    return len(homeless)


def _written(loop: _Loop) -> Iterator[str]:
    places = [[_place(value), *map(_place, value.reads)] for value in loop]
    if len(places) < FEWEST_MEMBERS:
        for row in places:
            target, *read = (f"{array}[{at}]" for array, at in row)
            yield f"  {target}={loop[0].text.format(*read)};\n"
        return
    tables, names = "", []
    for number, entries in enumerate(zip(*places, strict=True)):
        where = _line([at for _, at in entries])
        if where is None:
            where = f"t{number}[k]"
            told = ",".join(str(at) for _, at in entries)
            tables += f"static const int t{number}[] = {{{told}}};\n"
        names.append(f"{entries[0][0]}[{where}]")
    filled = f"{names[0]}={loop[0].text.format(*names[1:])};"
    yield f"  {{{tables}for (int k = 0; k < {len(places)}; k++) {filled}}}\n"


def _place(read: _Value | Place) -> Place:
    if isinstance(read, tuple):
        return read
    assert read.place is not None
    return read.place


def _line(places: list[int]) -> str | None:
    """Return places as an expression in k, if they lie on a line."""
    begin, step = places[0], places[1] - places[0]
    if any(place != begin + k * step for k, place in enumerate(places)):
        return None
    return f"{begin}+{step}*k" if step else f"{begin}"


def _bracketed(text: str) -> str:
    return text if text == PLACEHOLDER or text[0] == "(" else f"({text})"

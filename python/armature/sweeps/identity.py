# SPDX-License-Identifier: Apache-2.0
"""What tells one experiment from another: digests of files, libraries and functions."""
from __future__ import annotations

import hashlib
import inspect
import re
import types
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

#: Begins the names of entries that are files which points name: new points may name new ones.
FILE = "file "

_FILE_NAME = re.compile(r"[\w./${}~+-]+\.(?:yaml|yml|xml|cpf|urdf|json|csv|lua|policy|so)\b")


def digest_of(file: Path, library_folders: Sequence[str] = ()) -> str:
    """Of a deployment or another file, of all files that it and they name, and of component libraries
    in these folders that they name.

    What looks like a file's name and is one counts, in comments, too: too much rather than too
    little. The libraries of the runtime itself are left out.
    """
    digest = hashlib.sha256()
    words: set[str] = set()
    waiting, seen = [file], {file}
    while waiting:
        file = waiting.pop()
        content = file.read_bytes()
        digest.update(content)
        if file.suffix == ".so":
            continue
        text = content.decode("utf-8", "replace")
        words.update(re.findall(r"\w+", text))
        for named in _files_in(text, [file.parent]):
            if named not in seen:
                seen.add(named)
                waiting.append(named)
    for folder in library_folders:
        for library in sorted(Path(folder).glob("lib*.so")):
            if library.stem.removeprefix("lib") in words:
                digest.update(library.read_bytes())
    return digest.hexdigest()[:16]


def files_named_by(points: Iterable[Mapping[str, Any]], folders: Sequence[Path]) -> dict[str, str]:
    """The digests of files that values of these points name, as seen from one of `folders`."""
    texts = {str(value) for point in points for value in point.values() if not _is_plain_number(value)}
    files = {file for text in texts for file in _files_in(text, folders)}
    return {f"{FILE}{file}": digest_of(file) for file in sorted(files)}


def _files_in(text: str, folders: Sequence[Path]) -> list[Path]:
    names = sorted(set(_FILE_NAME.findall(text)))
    places = [(folder / name.replace("${here}", ".")).resolve() for name in names for folder in folders]
    return [place for place in places if place.is_file()]


def _is_plain_number(value: Any) -> bool:
    return isinstance(value, (bool, int, float))


def source_of(subject: Any) -> str:
    """Its name, and a digest of what it does: of its text, or its code where there is no text, of its
    defaults, and of the values and functions around it that it uses, as far as they are in its module
    and plain; of an object that is called, of its class and plain values."""
    described = subject if hasattr(subject, "__qualname__") else type(subject)
    if hasattr(subject, "func"):  # a partial
        described = subject.func
    name = f"{getattr(described, '__module__', '')}.{getattr(described, '__qualname__', '')}"
    parts = [_text_of(subject, set())]
    if described is type(subject):
        parts += [_class_text(described, set()), _text_of(getattr(subject, "__dict__", {}), set())]
    elif isinstance(subject, type):
        parts.append(_class_text(subject, set()))
    return f"{name} {_short_digest(' '.join(parts).encode('utf-8', 'backslashreplace'))}"


def _short_digest(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()[:16]


def _text_of(value: Any, seen: set[int]) -> str:
    """Equal in every process for equal values; of what is not plain, only the kind."""
    if value is None or isinstance(value, (bool, int, float, complex, str, bytes)):
        return repr(value)
    if id(value) in seen:
        return "again"
    seen.add(id(value))
    if isinstance(value, types.FunctionType):
        return _function_text(value, seen)
    if isinstance(value, types.MethodType):
        return f"{_text_of(value.__func__, seen)} of {_text_of(value.__self__, seen)}"
    if isinstance(value, types.CodeType):
        return _code_text(value, seen)
    if isinstance(value, (type, types.ModuleType)):
        return value.__name__
    if isinstance(value, Mapping):
        return f"{{{', '.join(f'{_text_of(k, seen)}: {_text_of(v, seen)}' for k, v in value.items())}}}"
    if isinstance(value, (set, frozenset)):
        return f"{{{', '.join(sorted(_text_of(one, seen) for one in value))}}}"
    if isinstance(value, (list, tuple)):
        return f"[{', '.join(_text_of(one, seen) for one in value)}]"
    if hasattr(value, "func") and hasattr(value, "keywords"):
        return f"{_text_of(value.func, seen)} {_text_of(value.args, seen)} {_text_of(value.keywords, seen)}"
    if hasattr(value, "dtype") and hasattr(value, "tobytes") and not value.dtype.hasobject:
        return f"{value.dtype} {value.shape} {_short_digest(value.tobytes())}"
    return f"a {type(value).__qualname__}"


def _function_text(function: types.FunctionType, seen: set[int]) -> str:
    names = _names_in(function.__code__)
    around = {name: one for name, one in function.__globals__.items() if name in names}
    for name, cell in zip(function.__code__.co_freevars, function.__closure__ or ()):
        around[name] = _content_of(cell)
    used = {
        name: one for name, one in sorted(around.items())
        if not isinstance(one, types.FunctionType) or one.__module__ == function.__module__
    }  # fmt: skip
    defaults = (function.__defaults__, function.__kwdefaults__)
    return f"{_source(function) or _code_text(function.__code__, seen)} {_text_of(defaults, seen)} {_text_of(used, seen)}"


def _content_of(cell: types.CellType) -> Any:
    try:
        return cell.cell_contents
    except ValueError:  # not yet
        return None


def _class_text(described: type, seen: set[int]) -> str:
    """Its bases are others'; its text has its methods, but not what is around them."""
    return f"{_source(described)} {_text_of(dict(vars(described)), seen)}"


def _source(described: Any) -> str:
    try:
        return inspect.getsource(described)
    except (OSError, TypeError, IndexError, SyntaxError):
        return ""


def _code_text(code: types.CodeType, seen: set[int]) -> str:
    return f"{code.co_code!r} {code.co_names} {code.co_varnames} {_text_of(code.co_consts, seen)}"


def _names_in(code: types.CodeType) -> set[str]:
    inner = (one for one in code.co_consts if isinstance(one, types.CodeType))
    return set(code.co_names).union(*(_names_in(one) for one in inner))

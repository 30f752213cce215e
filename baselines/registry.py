# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The registry of methods: find them by name, and make them from specifications in a
configuration or on the command line.
"""

from __future__ import annotations

import difflib
import importlib
import importlib.metadata
import importlib.util
import pkgutil
from functools import cache
from itertools import product
from math import inf
from pathlib import Path
from types import ModuleType

from . import declaration
from .contract import Method
from .label import parse
from .native import library


class UnknownMethod(ValueError):
    """No method has this name, or its specification is invalid; the message gives the remedy."""


GROUP = (  # entry points of installed packages that provide a method or a list of them
    "ofg.methods"
)


@cache
def methods() -> dict[str, type[Method]]:
    """name -> class of every method in `baselines/` and of installed packages, by name. Imports
    no engine of `baselines/`.
    """
    import baselines

    found: dict[str, type[Method]] = {}
    for module in pkgutil.iter_modules(baselines.__path__):
        _collect(importlib.import_module(f"baselines.{module.name}"), found)
    for entry in importlib.metadata.entry_points(group=GROUP):
        _add(_entered(entry), found)
    return dict(sorted(found.items()))


def load_file(path) -> dict[str, type[Method]]:
    """Load the methods of a user's Python file, which ends with METHODS = [Class, ...]; they join
    `methods()`.

    ValueError if the file does not exist or declares none.
    """
    path = Path(path).resolve()
    module = run_file(
        path, f"Method file {path.name}", f"baselines_file_{path.stem}", "METHODS = [Class, ...]"
    )
    found: dict[str, type[Method]] = {}
    _collect(module, found)
    if not found:
        raise ValueError(
            f"Method file {path.name} declares no method; end it with METHODS = [Class, ...], where"
            " each Class is a subclass of baselines.contract.Method."
        )
    known = methods()
    for name in found:
        if name in known and not getattr(known[name], "__module__", "").startswith(
            "baselines_file_"
        ):
            raise ValueError(
                f"Method file {path.name}: the name '{name}' is taken by {known[name].__module__};"
                " choose another."
            )
    known.update(found)
    return found


def run_file(path: Path, what: str, name: str, defines: str) -> ModuleType:
    """The module called `name` made from a user's Python file. ValueError, which begins with
    `what`, if the file does not exist or is not a Python file.
    """
    if not path.is_file():
        raise ValueError(
            f"{what} does not exist; give the path of a Python file that defines {defines}."
        )
    spec = importlib.util.spec_from_file_location(name, path)
    if spec is None:
        raise ValueError(f"{what} is not a Python file; its name must end in .py.")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def make(spec: str) -> list[Method]:
    """'ofg k=4,8 toi=velocity' -> the configurations that it names: commas separate values, whose
    type is the default's.

    UnknownMethod with the closest names; MissingEngine if the method's engine is not installed.
    """
    try:
        name, chosen = parse(spec)
    except ValueError as error:
        raise UnknownMethod(str(error)) from None
    cls = _find(name)
    choices = {}
    for key, values in chosen.items():
        if key not in cls.parameters:
            known = (
                ", ".join(f"{k} (default {v})" for k, v in cls.parameters.items()) or "no parameter"
            )
            raise UnknownMethod(
                f"Method specification '{spec}': '{name}' has no parameter '{key}'; it has {known}."
            )
        choices[key] = [
            (
                inf
                if value == "inf" and key in cls.unlimited
                else _typed(value, cls.parameters[key], key, spec)
            )
            for value in values.split(",")
        ]
    return [cls(**dict(zip(choices, combination))) for combination in product(*choices.values())]


def available(cls: type[Method]) -> str | None:
    """None if the method's engine can be imported here or is built, else the reason and the
    remedy.
    """
    if cls.engine in library.ENGINES:
        return library.missing(cls.engine)
    try:
        found = importlib.util.find_spec(cls.imports) is not None
    except (ImportError, ValueError):
        found = False
    return (
        None
        if found
        else f"{cls.engine} is not installed; install it with: pip install {cls.engine}"
    )


def version(cls: type[Method]) -> str:
    """Version of the engine, as in the manifest; 'absent' if it is not installed."""
    if found := library.version(cls.engine):
        return found
    try:
        return importlib.metadata.version(cls.engine)
    except importlib.metadata.PackageNotFoundError:
        return "absent"


def _entered(entry) -> list[type[Method]]:
    """The methods of an entry point, which names a subclass of Method or a list of them."""
    try:
        loaded = entry.load()
    except Exception as error:
        raise ValueError(
            f"The entry point '{entry.name}' of the group {GROUP} cannot be loaded "
            f"({type(error).__name__}: {error}); repair or uninstall its package."
        ) from error
    found = list(loaded) if isinstance(loaded, (list, tuple)) else [loaded]
    if not found or not all(isinstance(cls, type) and issubclass(cls, Method) for cls in found):
        raise ValueError(
            f"The entry point '{entry.name}' of the group {GROUP} names {loaded!r}; it must name a"
            " subclass of baselines.contract.Method or a list of them."
        )
    return found


def _collect(module: ModuleType, found: dict[str, type[Method]]) -> None:
    _add(getattr(module, "METHODS", ()), found)


def _add(classes, found: dict[str, type[Method]]) -> None:
    for cls in classes:
        if wrong := declaration.fault(cls):
            raise ValueError(f"The methods of {_file(cls)}: {wrong}")
        if cls.name in found:
            raise ValueError(
                f"Two methods are named '{cls.name}': {found[cls.name].__module__} and"
                f" {cls.__module__}; rename one."
            )
        found[cls.name] = cls


def _file(cls) -> str:
    """The file in which a class is defined, for error messages."""
    return getattr(cls, "__module__", "a user's file").removeprefix("baselines_file_")


def _find(name: str) -> type[Method]:
    known = methods()
    if name in known:
        return known[name]
    close = difflib.get_close_matches(name, known, n=3, cutoff=0.4)
    closest = f" Closest: {', '.join(close)}." if close else ""
    raise UnknownMethod(
        f"No method is named '{name}'.{closest} `ofg-bench list` prints all {len(known)}; give "
        "your own method by its file."
    )


def _typed(text: str, default, key: str, spec: str):
    if isinstance(default, bool):
        if text.lower() in ("true", "yes", "on", "1"):
            return True
        if text.lower() in ("false", "no", "off", "0"):
            return False
    else:
        try:
            return type(default)(text)
        except ValueError:
            pass
    raise UnknownMethod(
        f"Method specification '{spec}': {key}={text} is not of type {type(default).__name__} (the"
        f" default is {default})."
    )

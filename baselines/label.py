# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The label of a method: its name, then parameter=value for each parameter that is named."""

from __future__ import annotations


def name_of(label: str) -> str:
    """'ofg k=8' -> 'ofg'. An empty label gives an empty string."""
    return next(iter(label.split()), "")


def parse(label: str) -> tuple[str, dict[str, str]]:
    """'ofg k=4,8 toi=velocity' -> ('ofg', {'k': '4,8', 'toi': 'velocity'}).

    ValueError for a word that is not of the form parameter=value.
    """
    name, *words = label.split() or [""]
    chosen = {}
    for word in words:
        key, _, value = word.partition("=")
        if not value:
            raise ValueError(
                f"Method specification '{label}': '{word}' is not of the form parameter=value or"
                " parameter=value,value."
            )
        chosen[key] = value
    return name, chosen


def curve_of(label: str) -> str:
    """'ofg k=8 repairs=all' -> 'ofg repairs=all': the label without its first parameter.

    The methods of one accuracy-speed curve have this in common.
    """
    name, *words = label.split()
    return " ".join([name, *words[1:]])

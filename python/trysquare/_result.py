# SPDX-License-Identifier: Apache-2.0
"""Results are views of the JSON that the command prints: one home for names, units and reasons."""

from __future__ import annotations

import dataclasses
import types
import typing
from collections.abc import Mapping
from typing import Any, TypeVar

Cls = TypeVar("Cls", bound="Result")

_SUFFIX = "_reason"


@dataclasses.dataclass(frozen=True, kw_only=True)
class Result:
    """Part of a result. `why` says why a member is None, by the member's name."""

    why: Mapping[str, str] = dataclasses.field(default_factory=dict, repr=False)

    @classmethod
    def from_json(cls: type[Cls], json: Mapping[str, Any], **more: Any) -> Cls:
        """Members from the keys of the same names, part by part. A key that is unknown is left out.

        json: one object of the JSON.  more: members that are not in it.  Raises KeyError when a key is missing.
        """
        hints = _hints_of(cls)
        values: dict[str, Any] = dict(more)
        for field in dataclasses.fields(cls):
            if field.name in values or field.name == "why":
                continue
            if field.name in json:
                values[field.name] = _converted(json[field.name], hints[field.name])
            elif field.default is dataclasses.MISSING and field.default_factory is dataclasses.MISSING:
                raise KeyError(f"{cls.__name__}.{field.name}")
        values["why"] = {key[: -len(_SUFFIX)]: text for key, text in json.items() if key.endswith(_SUFFIX)}
        return cls(**values)


def _hints_of(cls: type) -> dict[str, Any]:
    hints: dict[str, Any] = _HINTS.get(cls, {})
    if not hints:
        hints = _HINTS[cls] = typing.get_type_hints(cls)
    return hints


_HINTS: dict[type, dict[str, Any]] = {}


def _converted(value: Any, hint: Any) -> Any:
    """The JSON value as the type of a member."""
    origin, arguments = typing.get_origin(hint), typing.get_args(hint)
    if origin in (typing.Union, types.UnionType):
        if value is None:
            return None
        return _converted(value, next(each for each in arguments if each is not type(None)))
    if isinstance(hint, type) and issubclass(hint, Result):
        return hint.from_json(value)
    if origin is list:
        return [_converted(each, arguments[0]) for each in value]
    if origin is tuple:
        return tuple(value)
    if origin is dict:
        return {key: _converted(each, arguments[1]) for key, each in value.items()}
    return value

"""Writes docs/case-keys.md, the tables of all keys of a case file, from the schema of the installed engine.

Run it after a change of the schema: `.venv/bin/python docs/case_keys.py`.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import crossgrain

PAGE = Path(__file__).with_name("case-keys.md")
TAGS = ("kind", "law", "do")
HEAD = """# Keys of the case file

This page is generated from the JSON schema (`crossgrain schema`) by `docs/case_keys.py`. [](cases.md) explains how the
parts fit together and which of them this version computes. A key that is not listed is an error; so is a missing key
that is not marked as optional.

"""
Schema = dict[str, Any]


def page() -> str:
    """The whole page."""
    schema: Schema = json.loads(crossgrain.schema())
    definitions: dict[str, Schema] = schema.pop("$defs")
    parts = [HEAD, _section("Case", schema)]
    tables = {name: entry for name, entry in definitions.items() if not _is_quantity(name, entry)}
    parts += [_section(name, tables[name]) for name in sorted(tables)]
    quantities = sorted(name for name, entry in definitions.items() if _is_quantity(name, entry))
    parts.append("## Quantities\n\n| quantity | meaning |\n|---|---|\n")
    parts += [f"| {_words(name)} | {_cell(definitions[name])} |\n" for name in quantities]
    return "".join(parts)


def _is_quantity(name: str, entry: Schema) -> bool:
    return name == "Number" or (name.islower() and "anyOf" in entry)


def _words(name: str) -> str:
    return name.replace("_", " ").lower()


def _cell(entry: Schema) -> str:
    return " ".join(str(entry.get("description", "")).split()).replace("|", "\\|")


def _section(name: str, entry: Schema) -> str:
    text = f"## {name}\n\n{_cell(entry)}\n\n"
    if "oneOf" not in entry:
        if "enum" in entry:
            return text + "\n".join(f"- `{value}`" for value in entry["enum"]) + "\n\n"
        return text + _keys(entry, tag=None)
    words = [choice for choice in entry["oneOf"] if "const" in choice]
    if words:
        rows = [f'| `"{choice["const"]}"` | {_cell(choice)} |\n' for choice in words]
        text += "| word | meaning |\n|---|---|\n" + "".join(rows) + "\n"
    for choice in entry["oneOf"]:
        if "properties" in choice:
            tag = next(key for key in TAGS if "const" in choice["properties"].get(key, {}))
            text += f'`{tag} = "{choice["properties"][tag]["const"]}"`: {_cell(choice)}\n\n' + _keys(choice, tag)
    return text


def _keys(entry: Schema, tag: str | None) -> str:
    """The table of the keys of an object, those that must be given first."""
    required: list[str] = entry.get("required", [])
    names = [name for name in entry.get("properties", {}) if name != tag]
    if not names:
        return ""
    rows = ["| key | value | meaning |\n|---|---|---|\n"]
    for name in sorted(names, key=lambda name: (name not in required, names.index(name))):
        value = entry["properties"][name]
        mark = "" if name in required else " (optional)"
        rows.append(f"| `{name}` | {_type(value)}{mark} | {_cell(value)} |\n")
    return "".join(rows) + "\n"


def _type(value: Schema) -> str:
    if "$ref" in value:
        name = str(value["$ref"]).rpartition("/")[2]
        if name == "Number" or name.islower():
            return f"[{_words(name)}](#quantities)"
        return f"[{name}](#{name.lower()})"
    for key in ("anyOf", "allOf", "oneOf"):
        if key in value:
            return " or ".join(_type(choice) for choice in value[key] if choice.get("type") != "null")
    kind: str | list[str] = value["type"]
    word = kind if isinstance(kind, str) else next(item for item in kind if item != "null")
    if word == "array":
        item = _type(value["items"])
        return f"{value['minItems']} x {item}" if "minItems" in value else f"list of {item}"
    return {"object": "table"}.get(word, word)


if __name__ == "__main__":
    PAGE.write_text(page())

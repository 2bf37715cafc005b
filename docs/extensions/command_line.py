# SPDX-License-Identifier: BSD-3-Clause
"""The directive `command-line`: every command of `bathyal` with its arguments and options, read
from the program itself whenever the documentation is built."""

from __future__ import annotations

import re
from collections.abc import Iterator
from enum import Enum
from typing import Any

import typer
from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from bathyal.cli import app as program


def commands() -> Iterator[tuple[str, Any]]:
    """Each command with its full name, groups unfolded, in the order of the program's help."""
    yield from _below("bathyal", typer.main.get_command(program))


def _below(name: str, command: Any) -> Iterator[tuple[str, Any]]:
    for verb, child in command.commands.items():
        if hasattr(child, "commands"):
            yield from _below(f"{name} {verb}", child)
        else:
            yield f"{name} {verb}", child


def page() -> str:
    """The reference in Markdown: a section a command, a table a group of options."""
    general = _table(typer.main.get_command(program).params, "bathyal")
    return "\n".join([*general, *(line for name, c in commands() for line in _section(name, c))])


def _section(name: str, command: Any) -> list[str]:
    shown = [parameter for parameter in command.params if not getattr(parameter, "hidden", False)]
    arguments = [parameter for parameter in shown if parameter.param_type_name == "argument"]
    usage = " ".join([name, *(_argument_name(each) for each in arguments), "[OPTIONS]"])
    lines = [f"## {name}", "", f"`{usage}`", "", _prose(command.help), ""]
    groups: dict[str, list[Any]] = {}
    for parameter in shown:
        panel = "Arguments" if parameter in arguments else _panel(parameter)
        groups.setdefault(panel, []).append(parameter)
    for panel in sorted(groups, key=lambda panel: panel != "Arguments"):
        lines += _table(groups[panel], panel)
    return lines


def _panel(parameter: Any) -> str:
    return getattr(parameter, "rich_help_panel", None) or "Options"


def _table(parameters: list[Any], title: str) -> list[str]:
    rows = [f"| {_names(each)} | {_cell(each)} |" for each in parameters]
    return [f"| {title} | |", "|---|---|", *rows, ""]


def _argument_name(parameter: Any) -> str:
    name = str(parameter.metavar or parameter.name.upper())
    return f"{name}..." if parameter.nargs == -1 and not name.endswith("...") else name


def _names(parameter: Any) -> str:
    if parameter.param_type_name == "argument":
        return f"`{_argument_name(parameter)}`"
    names = ", ".join(f"`{name}`" for name in [*parameter.opts, *parameter.secondary_opts])
    return names if parameter.is_flag else f"{names} {_value(parameter)}"


def _value(parameter: Any) -> str:
    kind = parameter.type_descriptor.annotation
    if parameter.metavar:
        return f"*{parameter.metavar}*"
    if isinstance(kind, type) and issubclass(kind, Enum):
        return "*" + "* or *".join(str(each.value) for each in kind) + "*"
    return f"*{getattr(kind, '__name__', kind)}*".lower()


def _cell(parameter: Any) -> str:
    text = _prose(getattr(parameter, "help", None) or "")
    default = parameter.default
    if isinstance(default, (int, float, str)) and not isinstance(default, bool) and default != "":
        text += f" Default: {getattr(default, 'value', default)}."
    if getattr(parameter, "multiple", False):
        text += " May be given several times."
    return text.replace("|", "\\|").strip()


def _prose(text: str | None) -> str:
    """Help as the terminal shows it, without Rich's marks and click's page breaks."""
    text = (text or "").replace("\b", "").replace("\f", "")
    plain = re.sub(r"(?<!\\)\[/?[a-z ]*\]", "", text).replace("\\[", "[")
    return re.sub(r"([*_<>])", r"\\\1", re.sub(r"[ \t]*\n[ \t]*", "\n", plain).strip())


class CommandLine(SphinxDirective):
    """Put the reference where the directive is."""

    def run(self) -> list[nodes.Node]:
        """Parse the page as Markdown."""
        return self.parse_text_to_nodes(page(), allow_section_headings=True)


def setup(app: Sphinx) -> dict[str, bool]:
    """Add the directive."""
    app.add_directive("command-line", CommandLine)
    return {"parallel_read_safe": True, "parallel_write_safe": True}

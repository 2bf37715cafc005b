# SPDX-License-Identifier: BSD-3-Clause
"""How the command line talks: results on stdout, progress, warnings and errors on stderr."""

from __future__ import annotations

import io
import signal
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import typer
from rich.console import Console
from rich.markup import escape
from rich.progress import (
    BarColumn,
    Progress,
    SpinnerColumn,
    Task,
    TextColumn,
    TimeElapsedColumn,
)
from rich.table import Table
from rich.text import Text
from typer.core import TyperGroup

from bathyal._core import Error
from bathyal.cli.signals import Terminated, signals_raise
from bathyal.io.files import shown

Tell = Callable[[float, str], None]


class Commands(TyperGroup):
    """Turns an error into one line and an exit code; usage errors are typer's own."""

    def invoke(self, ctx: Any) -> Any:
        err = Console(stderr=True, highlight=False)
        try:
            with signals_raise():
                return super().invoke(ctx)
        except Terminated:
            err.print("[red]terminated[/]")
            raise typer.Exit(128 + signal.SIGTERM) from None
        except KeyboardInterrupt:
            err.print("[red]interrupted[/]")
            raise typer.Exit(128 + signal.SIGINT) from None
        except Exception as error:
            if hasattr(error, "exit_code") or isinstance(error, typer.Abort | BrokenPipeError):
                raise  # typer's own
            if ctx.params.get("debug"):
                err.print_exception()
            err.print(f"[red]error:[/] {escape(_one_line(error))}", soft_wrap=True)
            raise typer.Exit(1) from None


def _one_line(error: Exception) -> str:
    if isinstance(error, OSError) and error.strerror:
        name = f"{error.filename}: " if error.filename else ""
        return f"{name}{error.strerror}"
    text = " ".join(str(error).split())
    if isinstance(error, MemoryError):
        return f"not enough memory: {text}" if text else "not enough memory"
    if isinstance(error, Error | OSError | ValueError):
        return text
    return f"{type(error).__name__}: {text} (a fault of bathyal itself; --debug shows where)"


class Talk:
    """Prints results on stdout, progress and warnings on stderr."""

    def __init__(self, *, json: bool, quiet: bool) -> None:
        _replace_what_cannot_be_printed()
        self.json = json
        self.quiet = quiet
        self.out = Console(highlight=False)
        self.err = Console(stderr=True, highlight=False)

    @contextmanager
    def progress(self) -> Iterator[Any]:
        """A function `step(name)` for stages; it draws only on a terminal. ``with step(name) as
        tell:`` gives ``tell(share, text)`` to a stage that knows how far it is."""
        if self.json or self.quiet or not self.err.is_terminal:
            yield _silent
            return
        bar = Progress(
            SpinnerColumn(), TextColumn("{task.description}", markup=False), _Share(bar_width=30),
            TimeElapsedColumn(), console=self.err, transient=True,
        )  # fmt: skip

        @contextmanager
        def step(name: str) -> Iterator[Tell]:
            task = bar.add_task(name, total=None)
            try:
                yield lambda share, text: bar.update(
                    task, total=1.0, completed=share, description=text or name, refresh=True
                )
            finally:
                bar.remove_task(task)

        with bar:
            yield step

    def result(self, data: dict[str, Any], rows: dict[str, str], title: str = "") -> None:
        """A table for people, or JSON."""
        from bathyal.io.json import json_text

        if self.json:
            sys.stdout.write(json_text(data, encoding=sys.stdout.encoding or "utf-8"))
        elif not self.quiet:
            table = Table(show_header=False, box=None, title=title or None, title_justify="left")
            table.add_column(style="dim")
            table.add_column(overflow="fold")
            for name, value in rows.items():
                table.add_row(name, escape(value))
            self.out.print(table)

    def brief(self, data: dict[str, Any], text: str, folder: Path, files: Sequence[Path]) -> None:
        """The first sight of a result and which files hold the rest of it, or JSON."""
        if self.json:
            self.result(data, {})
        elif not self.quiet:
            verdict, *others = text.splitlines()
            names = " ".join(shown(file.name) for file in files)
            self.out.print(f"[bold]{escape(verdict)}[/]", soft_wrap=True)
            self.out.print(
                escape("\n".join([*others, f"Written to {shown(folder)}: {names}"])), soft_wrap=True
            )

    def verdict(self, data: dict[str, Any], text: str) -> None:
        """The first sight of a result that no files go with, or JSON."""
        if self.json:
            self.result(data, {})
        elif not self.quiet:
            first, *others = text.splitlines()
            self.out.print(f"[bold]{escape(first)}[/]", soft_wrap=True)
            self.out.print(escape("\n".join(others)), soft_wrap=True)

    def warn(self, warnings: list[str]) -> None:
        """Warnings go to stderr, also where the rest is quiet."""
        if not self.json:
            for warning in warnings:
                self.err.print(f"[yellow]warning:[/] {escape(warning)}", soft_wrap=True)


def _replace_what_cannot_be_printed() -> None:
    """Names of files may hold bytes, and a terminal may know few characters: neither is a reason to
    end a job that is done."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


class _Share(BarColumn):
    """A bar for the stages that report how far they are."""

    def render(self, task: Task) -> Any:
        return Text() if task.total is None else super().render(task)


@contextmanager
def _silent(_: str) -> Iterator[Tell]:
    yield lambda share, text: None

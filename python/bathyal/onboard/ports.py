# SPDX-License-Identifier: BSD-3-Clause
"""Where bytes go: pseudo-terminals, TCP and UDP on this machine alone."""

from __future__ import annotations

import fcntl
import os
import select
import socket
import termios
import time
import tty
from abc import ABC, abstractmethod
from array import array
from pathlib import Path

from bathyal._core import Error

LOOPBACK = "127.0.0.1"
_PIECE = 65536
_MOST_WAITING = 1 << 20
_GRACE = 0.2  # for a program to read on, at the end [s]


class Port(ABC):
    """A stream of bytes to programs on this machine."""

    name: str

    @abstractmethod
    def write(self, given: bytes) -> int:
        """Sends what can be sent without waiting. Returns how many bytes."""

    @abstractmethod
    def read(self) -> bytes:
        """What has come; b"" if nothing has."""

    @abstractmethod
    def handles(self) -> list[int]:
        """On which to wait for bytes."""

    @abstractmethod
    def close(self) -> None:
        """Ends it."""

    def ready(self, seconds: float) -> bool:
        """Waits so long for a program that listens; whether there is one, or there may be."""
        return True

    def wait(self, seconds: float) -> bool:
        """Until bytes come, at most so long. Returns whether they have."""
        return bool(select.select(self.handles(), [], [], max(0.0, seconds))[0])


class PtyPort(Port):
    """A pseudo-terminal, at a path that is a link to it.

    Parameters
    ----------
    path : Path
        Made; a link that another run has left is replaced.

    Raises
    ------
    Error
        Where there is another file.
    """

    def __init__(self, path: Path) -> None:
        if path.is_symlink() and os.readlink(path).startswith("/dev/pts/"):
            path.unlink()
        if path.exists() or path.is_symlink():
            raise Error(f"port: {path} is there already, and is no link to a pseudo-terminal")
        self._main, self._other = os.openpty()
        tty.setraw(self._other)
        os.set_blocking(self._main, False)
        self.device = os.ttyname(self._other)
        os.symlink(self.device, path)
        self.path = path
        self.name = str(path)

    def write(self, given: bytes) -> int:
        try:
            return os.write(self._main, given) if given else 0
        except BlockingIOError:
            return 0

    def read(self) -> bytes:
        try:
            return os.read(self._main, _PIECE)
        except BlockingIOError:
            return b""

    def handles(self) -> list[int]:
        return [self._main]

    def _unread(self) -> int:
        """Bytes that nobody has read yet."""
        count = array("i", [0])
        fcntl.ioctl(self._other, termios.FIONREAD, count)
        return count[0]

    def close(self) -> None:
        end = time.monotonic() + _GRACE
        time.sleep(0.01)  # the kernel hands bytes over a little later
        before = self._unread()
        while before and time.monotonic() < end:  # what is not read is lost with the port
            time.sleep(0.002)
            if (now := self._unread()) < before:
                before, end = now, time.monotonic() + _GRACE
        if self.path.is_symlink() and os.readlink(self.path) == self.device:
            self.path.unlink()
        os.close(self._main)
        os.close(self._other)


class TcpPort(Port):
    """A server that programs on this machine connect to; each gets everything from then on.

    A program that leaves a megabyte unread is cut off.

    Parameters
    ----------
    number : int
        0: any that is free.

    Raises
    ------
    Error
        Where the port is taken.
    """

    def __init__(self, number: int) -> None:
        self._server = bound(socket.SOCK_STREAM, number, "tcp")
        self._server.listen()
        self._clients: dict[socket.socket, bytearray] = {}  # what they have not taken yet
        self.number = int(self._server.getsockname()[1])
        self.name = f"tcp:{self.number}"

    def _accept(self) -> None:
        while True:
            try:
                client, _ = self._server.accept()
            except BlockingIOError:
                return
            client.setblocking(False)
            client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            self._clients[client] = bytearray()

    def _drop(self, client: socket.socket) -> None:
        del self._clients[client]
        client.close()

    def write(self, given: bytes) -> int:
        self._accept()
        sent = len(given) if self._clients else 0
        for client, waiting in list(self._clients.items()):
            waiting += given
            try:
                del waiting[: client.send(waiting)]
            except BlockingIOError:
                pass
            except OSError:
                waiting += bytes(_MOST_WAITING)
            if len(waiting) >= _MOST_WAITING:
                self._drop(client)
        return sent

    def read(self) -> bytes:
        self._accept()
        pieces = []
        for client in list(self._clients):
            try:
                piece = client.recv(_PIECE)
            except BlockingIOError:
                continue
            except OSError:
                piece = b""
            if piece:
                pieces.append(piece)
            else:
                self._drop(client)
        return b"".join(pieces)

    def ready(self, seconds: float) -> bool:
        if not self._clients:
            select.select([self._server], [], [], max(0.0, seconds))
            self._accept()
        return bool(self._clients)

    def handles(self) -> list[int]:
        return [self._server.fileno(), *(client.fileno() for client in self._clients)]

    def close(self) -> None:
        for client in self._clients:
            client.close()
        self._server.close()


class DatagramPort:
    """Datagrams on this machine; answers go to whom the last one came from.

    Parameters
    ----------
    number : int
        0: any that is free.

    Raises
    ------
    Error
        Where the port is taken.
    """

    def __init__(self, number: int) -> None:
        self._socket = bound(socket.SOCK_DGRAM, number, "udp")
        self._peer: tuple[str, int] | None = None
        self.number = int(self._socket.getsockname()[1])
        self.name = f"udp:{self.number}"

    def receive(self, seconds: float) -> bytes | None:
        """The next one; None if there is none so long."""
        if not select.select([self._socket], [], [], max(0.0, seconds))[0]:
            return None
        given, peer = self._socket.recvfrom(_PIECE)
        self._peer = (str(peer[0]), int(peer[1]))
        return given

    def answer(self, given: bytes) -> None:
        """To whom the last one came from."""
        if self._peer is not None:
            self._socket.sendto(given, self._peer)

    def close(self) -> None:
        """Ends it."""
        self._socket.close()


def bound(kind: socket.SocketKind, number: int, scheme: str) -> socket.socket:
    """A socket at a port of this machine.

    Raises
    ------
    Error
        Where it is taken.
    """
    made = socket.socket(socket.AF_INET, kind)
    made.setblocking(False)
    if kind == socket.SOCK_STREAM:
        made.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        made.bind((LOOPBACK, number))
    except OSError as error:
        made.close()
        raise Error(f"port: {scheme}:{number} cannot be opened: {error.strerror}") from error
    return made

"""Fills a store of `lekalo serve` as a page would: fill_store.py LEKALO LAYOUT STORE

Two people edit the layout, one takes a command back and does it again, the other takes one back; a copy of the
layout gets a photograph and goes back to an earlier revision.
"""

import base64
import json
import os
import signal
import socket
import struct
import subprocess
import sys
import urllib.request

PNG = base64.b64decode(
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNkYPhfDwAChwGA60e6kgAAAABJRU5ErkJggg==")


class Page:
    """A WebSocket to one layout."""

    def __init__(self, port, layout, author):
        self.socket = socket.create_connection(("127.0.0.1", port))
        self.socket.sendall((
            f"GET /ws?layout={layout}&author={author} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\n"
            "Connection: Upgrade\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n"
            "Sec-WebSocket-Protocol: lekalo.1\r\n\r\n").encode())
        self.stream = self.socket.makefile("rb")
        assert b"101" in self.stream.readline()
        while self.stream.readline() != b"\r\n":
            pass
        self.seq = 0

    def hear(self):
        first, length = self.stream.read(2)
        length &= 127
        if length == 126:
            length, = struct.unpack(">H", self.stream.read(2))
        elif length == 127:
            length, = struct.unpack(">Q", self.stream.read(8))
        assert first & 15 == 1, first
        return json.loads(self.stream.read(length))

    def ask(self, **message):
        self.seq += 1
        data = json.dumps({**message, "seq": self.seq}).encode()
        size = struct.pack(">B", 128 | len(data)) if len(data) < 126 else struct.pack(">BH", 254, len(data))
        self.socket.sendall(b"\x81" + size + bytes(4) + data)
        while True:
            said = self.hear()
            if said["type"] in ("done", "refused") and said["seq"] == self.seq:
                assert said["type"] == "done", said
                return

    def command(self, text, mode="strict"):
        self.ask(type="command", mode=mode, text=text)


def ask(port, method, target, body=None):
    request = urllib.request.Request(f"http://127.0.0.1:{port}/api/layouts{target}", body, method=method)
    return json.load(urllib.request.urlopen(request))


lekalo, layout, store = sys.argv[1:]
server = subprocess.Popen([lekalo, "serve", layout, "--store", store, "--port", "0"], stdout=subprocess.PIPE, text=True)
port = int(server.stdout.readline().strip().rstrip("/").rsplit(":", 1)[1])
shoes = int(server.stdout.readline().strip().rsplit("=", 1)[1])
anna, boris = Page(port, shoes, "anna"), Page(port, shoes, "boris")
anna.command("move 1 by 0.5 0", "free")
anna.command("add-defect hide scar 2 outline 300 300 320 300 310 330")
boris.command("fit tongue hide 0")
anna.ask(type="undo")
anna.ask(type="redo")
boris.command("lock 2")
boris.ask(type="undo")
anna.command("grade-defect hide scar 5")
boris.command("remove 3")
second = ask(port, "POST", f"/{shoes}/copy?name=second", b"")["id"]
ask(port, "PUT", f"/{second}/photo?stock=hide&pixels=10,20,110,20&mm=0,0,200.5,0", PNG)
page = Page(port, second, "anna")
page.command("remove 4")
ask(port, "POST", f"/{second}/restore?revision=0", b"")
server.send_signal(signal.SIGTERM)
assert server.wait() == 0
assert not os.path.exists(store + "-wal")

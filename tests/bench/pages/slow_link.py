# SPDX-License-Identifier: Apache-2.0
"""A link of a stated bandwidth to a port of this computer, whose ends stop reading when it is full."""

import socket
import threading
import time

BLOCK = 1448  # bytes: a packet; the smallest buffers that the system gives hold a few more
OVERSLEPT_S = 0.005


class SlowLink:
    """Forwards connections until close(); all of them share the bandwidth towards the client."""

    def __init__(self, port, bytes_per_second):
        self.target = port
        self.bytes_per_second = bytes_per_second
        self.free_at = time.monotonic()
        self.turn = threading.Lock()
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.port = self.listener.getsockname()[1]
        threading.Thread(target=self.accept, daemon=True).start()

    def close(self):
        self.listener.close()

    def accept(self):
        while True:
            try:
                client, _ = self.listener.accept()
            except OSError:
                return
            server = socket.socket()
            server.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, BLOCK)
            server.connect(("127.0.0.1", self.target))
            client.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, BLOCK)
            for ends in ((client, server, lambda size: None), (server, client, self.wait_for_turn)):
                threading.Thread(target=self.forward, args=ends, daemon=True).start()

    def wait_for_turn(self, size):
        with self.turn:
            # Compensates for oversleeping.
            self.free_at = (max(self.free_at, time.monotonic() - OVERSLEPT_S)
                            + size / self.bytes_per_second)
            until = self.free_at
        time.sleep(max(0, until - time.monotonic()))

    @staticmethod
    def forward(source, sink, wait_for_turn):
        try:
            while block := source.recv(BLOCK):
                wait_for_turn(len(block))
                sink.sendall(block)
        except OSError:
            pass  # one end has closed; so does the other
        for end in (source, sink):
            try:
                end.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass  # closed before

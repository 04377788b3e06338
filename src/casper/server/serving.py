"""The server's work: requests are read ahead by one thread and answered, in order, by the one that called."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any, BinaryIO

from casper.engine.domain.domain import Domain
from casper.server.ahead import CANCEL, Ahead
from casper.server.conversation import Conversation
from casper.server.methods import METHODS
from casper.server.mistakes import told
from casper.server.protocol import Answer, Message, ProtocolError, Request, failure, line_of, result
from casper.server.schema import document
from casper.server.signatures import arguments
from casper.server.stopping import Stopper, stopped

LONGEST_LINE = 1 << 24
LONGEST_TIME = 60.0


class Server:
    """Answers lines about one domain.

    Args:
        domain: what is asked.
        longest_time: seconds that a request may take which only asks; what changes something is never stopped.
        longest_line: bytes of a line.
    """

    def __init__(self, domain: Domain, longest_time: float = LONGEST_TIME, longest_line: int = LONGEST_LINE) -> None:
        self.conversation = Conversation(domain)
        self._stopper = Stopper(longest_time)
        self._ahead = Ahead(longest_line, self._stopper.stop)

    def serve(self, source: BinaryIO, sink: BinaryIO) -> None:
        """Answer every line of the source until it ends. Blocks.

        Requests can be stopped where this is called from the main thread.
        """
        threading.Thread(target=self._ahead.read, args=(source,), daemon=True).start()
        with self._stopper.ready():
            while (message := self._ahead.next()) is not None:
                answers = self.answers(message)
                if answers:
                    sink.write(line_of(answers if message.is_batch else answers[0]))
                if self._ahead.is_empty:
                    sink.flush()
        sink.flush()

    def answers(self, message: Message) -> list[Answer]:
        """What is answered to a line: one object for each request of it that wants an answer."""
        return [answer for request in message.requests if (answer := self._answer(request)) is not None]

    def _answer(self, request: Request) -> Answer | None:
        try:
            answer = result(request.id, self._worked(request))
        except ProtocolError as mistake:
            answer = failure(request.id, mistake)
        finally:
            self._ahead.answered(request)
        return answer if request.answers else None

    def _worked(self, request: Request) -> Any:
        if request.mistake is not None:
            raise request.mistake
        if request.method == CANCEL:
            return isinstance(request.params, Mapping) and request.params["found"]
        if self._ahead.is_cancelled(request):
            raise stopped("cancelled")
        if request.method == "rpc.discover":
            return document()
        method = METHODS.get(request.method)
        if method is None:
            known = ", ".join([*METHODS, CANCEL])
            raise ProtocolError("method", f"there is no method {request.method!r}; there are {known}")
        given = arguments(method.run, request.params)

        work: Callable[[], Any] = partial(method.run, self.conversation, **given)
        if method.of_base:
            work = partial(self.conversation.remembered.of, (request.method, *sorted(given.items())), work)
        return told(work if method.changes else partial(self._stopper.run, request.id, work))

"""Who is let in: by a name of this machine, from no other page, with the token or its cookie."""

from __future__ import annotations

import asyncio
from typing import Any

import pytest

from gearlink.cli.studio.command import Guard

OWN = {"host": "127.0.0.1:8123"}


def _asked(query: str = "", kind: str = "http", **headers: str) -> tuple[int | str, dict[str, str]]:
    """Status and headers of the answer; of a websocket whether it is closed or passed on."""
    sent: list[dict[str, Any]] = []

    async def app(_scope: Any, _receive: Any, send: Any) -> None:
        if kind == "websocket":
            await send({"type": "websocket.accept"})
        else:
            await send({"type": "http.response.start", "status": 200, "headers": []})

    async def receive() -> dict[str, Any]:
        return {"type": "websocket.connect"}

    async def send(message: dict[str, Any]) -> None:
        sent.append(message)

    given = [(name.encode(), value.encode()) for name, value in headers.items()]
    scope = {"type": kind, "query_string": query.encode(), "headers": given}
    asyncio.run(Guard(app, 8123, "secret")(scope, receive, send))
    first = sent[0]
    told = {key.decode(): value.decode() for key, value in first.get("headers", ())}
    return first.get("status", first["type"]), told


def test_the_address_opens_the_page_and_leaves_a_cookie() -> None:
    status, headers = _asked("token=secret", **OWN)
    assert status == 200
    assert headers["set-cookie"].startswith("gearlink-studio-8123=secret; ")
    assert "SameSite=Strict" in headers["set-cookie"]
    assert "https:" not in headers["content-security-policy"]
    assert _asked(cookie="other=1; gearlink-studio-8123=secret", **OWN)[0] == 200
    assert _asked(kind="websocket", cookie="gearlink-studio-8123=secret", origin="http://localhost:8123", **OWN)[0] == (
        "websocket.accept"
    )


@pytest.mark.parametrize("kind", ["http", "websocket"])
@pytest.mark.parametrize(
    ("query", "headers"),
    [
        ("", OWN),
        ("token=Secret", OWN),
        ("", OWN | {"cookie": "gearlink-studio-8124=secret"}),
        ("token=secret", {"host": "example.org:8123"}),
        ("token=secret", {"host": "127.0.0.1"}),
        ("token=secret", {}),
        ("token=secret", OWN | {"origin": "http://example.org"}),
        ("token=secret", OWN | {"origin": "null"}),
    ],
)
def test_nobody_else_is_let_in(kind: str, query: str, headers: dict[str, str]) -> None:
    assert _asked(query, kind, **headers)[0] in (403, "websocket.close")

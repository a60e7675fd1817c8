"""Starlette's client for tests, on the httpx that is at hand."""

import warnings

with warnings.catch_warnings():
    # It would have its own successor of httpx instead, for what is tested here the same.
    warnings.filterwarnings("ignore", message="Using `httpx` with `starlette.testclient`")
    from starlette.testclient import TestClient, WebSocketDenialResponse, WebSocketTestSession

__all__ = ["TestClient", "WebSocketDenialResponse", "WebSocketTestSession"]

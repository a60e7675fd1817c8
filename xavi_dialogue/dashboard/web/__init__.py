"""The web server of the dashboard, and its messages to browsers."""

MISSING = "the dashboard needs more packages: pip install starlette uvicorn websockets"

"""The messages of the bus, by name."""

from xavi_dialogue.bus.messages import (
    AliveReport,
    AnyMessage,
    AskReply,
    AskRequest,
    CancelReply,
    CancelRequest,
    EventReport,
    EvidenceRequest,
    Failure,
    ForgetReply,
    ForgetRequest,
    HistoryReply,
    HistoryRequest,
    SceneReport,
    TraceReport,
    TurnReport,
    WhatIfRequest,
    schema_name,
)

#: Messages whose schemas the car serves; the service serves those of all others.
CAR_MESSAGES = ("scene", "trace", "event_report")
#: Every message by its name under `@schema/`.
MESSAGES: dict[str, type[AnyMessage]] = {
    schema_name(kind).removeprefix("xavi.").partition("/")[0]: kind
    for kind in (
        *(SceneReport, TraceReport, EventReport, AskRequest, AskReply, HistoryRequest),
        *(HistoryReply, TurnReport, ForgetRequest, ForgetReply, CancelRequest, CancelReply),
        *(EvidenceRequest, WhatIfRequest, AliveReport, Failure),
    )
}

"""Contracted: auxiliaries that are written short and may be one of two."""

from typing import Final

from xavi_dialogue.nlu.grammar.lexicon import Leaf

#: Verbs whose participle is as their base: "if he'd come out" is "had".
_AS_PARTICIPLES: Final = frozenset(
    {"hit", "cut", "let", "set", "put", "shut", "come", "become", "run"}
)


def with_would(aux: list[str], verb: Leaf | None, *, negated: bool) -> None:
    """Put "would" for the "had" of "he'd wait" and "he'd have gone", in place."""
    if aux[-2:-1] == ["have-past"] and aux[-1].startswith("have-"):
        aux[-2] = "modal-would"
    if verb is None or verb.form != "base" or verb.words[0] in _AS_PARTICIPLES:
        return
    if aux[-1:] == ["have-past"] and not negated:
        aux[-1] = "modal-would"

"""Somebody else: any other road user than those spoken of."""

from typing import Final

from xavi_dialogue.domain.terms import Described

#: "anybody else", "no one else", "another one".
SOMEBODY_ELSE: Final = Described(other=True, definite=False)

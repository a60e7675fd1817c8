"""Fields of values in the reference, with their types and comments as they stand in the code.

Values are made by the program, so what they hold is shown in place of how they are constructed.
"""

import ast
import inspect
import io
import textwrap
import tokenize

#: Fields that the library keeps for itself.
INTERNAL = {"Ride": {"record", "known", "again", "digest"}}


def fields(value):
    """Return name, type and comment of each annotated field of a class, in order."""
    source = textwrap.dedent(inspect.getsource(value))
    (found,) = ast.parse(source).body
    comments = {
        token.start[0]: token.string.lstrip("#: ")
        for token in tokenize.generate_tokens(io.StringIO(source).readline)
        if token.type == tokenize.COMMENT
    }
    return [
        (node.target.id, ast.unparse(node.annotation).strip("'"), comments.get(node.end_lineno, ""))
        for node in found.body
        if isinstance(node, ast.AnnAssign)
        and isinstance(node.target, ast.Name)
        and node.target.id not in INTERNAL.get(value.__name__, ())
    ]


def described(value):
    """Return the fields of a class as lines of reStructuredText."""
    lines = ["", ".. rubric:: Fields", ""]
    for name, kind, comment in fields(value):
        more = " – " + comment.replace("`", "``") if comment else ""
        lines.append(f"- **{name}** (``{kind}``){more}")
    return [*lines, ""] if len(lines) > 3 else []


def describe(app, what, name, value, options, lines):
    """Add the fields of a class to its docstring."""
    if what == "class":
        lines += described(value)


def sign(app, what, name, value, options, signature, returns):
    """Leave out how a class is constructed: no name of the library is meant to be."""
    return ("", "") if what == "class" else None


def setup(app):
    """Take part in a build of the site."""
    app.connect("autodoc-process-docstring", describe)
    app.connect("autodoc-process-signature", sign)
    return {"parallel_read_safe": True}

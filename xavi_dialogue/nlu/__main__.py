"""Debug command: `python -m xavi_dialogue.nlu TEXT` prints how a text is read."""

import sys

from xavi_dialogue.nlu.notation import reading_line
from xavi_dialogue.nlu.parse import Parser


def main(arguments: list[str]) -> None:
    """Print the readings of a text, or of each line of standard input."""
    parser = Parser()
    texts = [" ".join(arguments)] if arguments else [line.strip() for line in sys.stdin]
    for text in texts:
        if not arguments:
            sys.stdout.write(f"> {text}\n")
        readings = parser.read(text)
        for reading in readings if arguments else readings[:1]:
            sys.stdout.write(f"{reading_line(reading)}\n")
        if arguments:
            shares = " ".join(f"{s.text}/{s.share[:4]}[{s.part}]" for s in readings[0].shares)
            sys.stdout.write(f"      {shares}\n")


if __name__ == "__main__":
    main(sys.argv[1:])

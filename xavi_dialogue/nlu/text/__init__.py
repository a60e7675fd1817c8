"""Text: what was typed or dictated becomes words, with what each may have been meant to be."""

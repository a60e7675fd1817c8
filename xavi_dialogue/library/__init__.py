"""The library: what `import xavi_dialogue` offers to programs and notebooks."""

from xavi_dialogue.process.kernel_cache import find_place

find_place()  # before anything loads numba, which looks for its cache then

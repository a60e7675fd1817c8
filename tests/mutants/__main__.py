"""`python -m tests.mutants`."""

import sys

from tests.mutants.main import main

sys.exit(main())

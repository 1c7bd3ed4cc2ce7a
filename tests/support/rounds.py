"""How many random rounds a test makes: few in a landing (scripts/test), ALGEBRA3D_EFFORT times as many in scripts/nightly.

tests/support/rounds.h says the same for the unit tests.
"""
import os

EFFORT = max(1, int(os.environ.get("ALGEBRA3D_EFFORT", "1")))
# Whether a test has its full size, or all of its choices, where a landing makes do with less.
IS_THOROUGH = EFFORT > 1


def rounds(usual):
    return usual * EFFORT

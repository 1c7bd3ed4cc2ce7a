"""--help as the first argument prints what a script says of itself, and nothing is done."""
import sys


def show_help(text):
    if sys.argv[1:2] in (["-h"], ["--help"]):
        print(text.strip())
        sys.exit(0)

#!/usr/bin/env python3
"""Holds what a machine can hold of the project's language and of its references.

    check_docs.py voice ROOT
        lines, sentences and headings of the documentation; how comments in the sources begin and end
    check_docs.py references ROOT [--lekalo PROGRAM] [--compiler CXX]
        links, files, names and options that the documentation mentions exist; its code compiles

Each finding is a line FILE:LINE: and a sentence. The exit status is 1 if there is any, else 0.
"""
import argparse
import os
import sys

from references import references
from voice import voice


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["voice", "references"])
    parser.add_argument("root")
    parser.add_argument("--lekalo")
    parser.add_argument("--compiler")
    words = parser.parse_args()
    words.root = os.path.abspath(words.root)
    if words.what == "voice":
        findings = voice(words.root)
    else:
        lekalo = words.lekalo if words.lekalo and os.path.exists(words.lekalo) else None
        findings = references(words.root, lekalo, words.compiler)
    for f in findings:
        print(f"{f.path}:{f.line}: {f.text}")
    if findings:
        print(f"{len(findings)} findings.")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())

"""Offences against the voice that are still allowed. To be taken away, with baseline.txt and the option --baseline
of check_docs.py, when none is left."""
import collections
import os

def folder_of(path):
    parts = path.split("/")
    depth = 3 if path.startswith("include/lekalo/") else 2
    return "/".join(parts[:depth]) if len(parts) > depth else os.path.dirname(path) or "."


def counts(findings):
    return collections.Counter((folder_of(f.path), f.rule) for f in findings)


def beyond_baseline(findings, path):
    allowed = collections.Counter()
    with open(path, encoding="utf-8") as file:
        for line in file:
            if line.strip() and not line.startswith("#"):
                folder, rule, count = line.split()
                allowed[folder, rule] = int(count)
    now = counts(findings)
    for (folder, rule), count in sorted(allowed.items()):
        if now[folder, rule] < count:
            print(f"note: {folder} has {now[folder, rule]} of {count} offences against '{rule}' left; "
                  "lower the baseline.")
    return [f for f in findings if now[folder_of(f.path), f.rule] > allowed[folder_of(f.path), f.rule]]

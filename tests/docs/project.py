"""The files of the project, and the parts of its pages."""
import collections
import functools
import os
import re

Finding = collections.namedtuple("Finding", "path line rule text")

SOURCE_FOLDERS = ["include", "src", "apps", "bindings", "web/src"]
SOURCE_ENDINGS = (".hpp", ".cpp", ".ts")
GENERATED = ("build/", "demo-out/", "test-out/", "web/dist", "web/node_modules")


def lines_of(root, path):
    with open(os.path.join(root, path), encoding="utf-8", errors="replace") as file:
        return file.read().split("\n")


@functools.lru_cache(maxsize=None)
def all_files(root):
    """Every file of the project, relative to its root, sorted."""
    found = []
    for folder, names, files in os.walk(root):
        relative = os.path.relpath(folder, root)
        names[:] = sorted(name for name in names
                          if not name.startswith((".", "__")) and not is_generated(join(relative, name) + "/"))
        found += [join(relative, name) for name in files]
    return sorted(found)


def join(folder, name):
    return name if folder == "." else folder + "/" + name


def is_generated(path):
    return any(path.startswith(start) for start in GENERATED)


def pages(root):
    return [path for path in all_files(root) if path.endswith(".md")]


def sources(root):
    return [path for path in all_files(root)
            if path.endswith(SOURCE_ENDINGS) and any(path.startswith(f + "/") for f in SOURCE_FOLDERS)]


ITEM = re.compile(r"^\s*([*-]|\d+\.|\([0-9a-z]\))\s+")
FENCE = re.compile(r"^\s*```(.*)$")
Block = collections.namedtuple("Block", "line info lines")


def split_page(lines):
    """The page without its fenced code (blank lines in its place), and the fenced blocks."""
    prose, blocks, block = [], [], None
    for number, line in enumerate(lines, 1):
        fence = FENCE.match(line)
        if fence and block is None:
            block = Block(number, fence.group(1).split(), [])
        elif fence:
            blocks.append(block)
            block = None
        elif block is not None:
            block.lines.append(line)
        prose.append("" if fence or block is not None else line)
    return prose, blocks


def is_prose(line):
    """False for tables, pictures, comments and code that is set off by four spaces or more."""
    text = line.lstrip()
    return not (text.startswith(("|", "![", "<!--")) or (line.startswith("    ") and not ITEM.match(line)))


def paragraphs(prose):
    """(line number, text) of each paragraph and each item of a list, headings and tables left out."""
    start, words = 0, []
    for number, line in enumerate(prose + [""], 1):
        text = line.strip()
        ends = not text or text.startswith(("|", "#", "![", "<!--")) or ITEM.match(line)
        if ends and words:
            yield start, " ".join(words)
            words = []
        if not text or text.startswith(("|", "#", "![", "<!--")):
            continue
        if not words:
            if line.startswith("    ") and not ITEM.match(line):
                continue  # a formula
            start = number
        words.append(ITEM.sub("", line).strip())


COMMENT = re.compile(r"^\s*//+!?(?![</!])(.*)$")
TOOL_WORDS = re.compile(r"clang-format|NOLINT|eslint|prettier|@ts-|SPDX|https?://")


def comment_blocks(lines):
    """(first line number, texts) of each paragraph of comments on lines of their own."""
    start, block = 0, []
    for number, line in enumerate(lines + [""], 1):
        match = COMMENT.match(line)
        text = match.group(1) if match else ""
        if match and text.strip() and not TOOL_WORDS.search(text):
            if not block:
                start = number
            block.append(text[1:] if text.startswith(" ") else text)
        elif block:
            yield start, block
            block = []

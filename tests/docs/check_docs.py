#!/usr/bin/env python3
"""Holds what a machine can hold of the project's language and of its references.

    check_docs.py voice ROOT [--baseline FILE]
        lines, sentences and headings of the documentation; how comments in the sources begin and end
    check_docs.py references ROOT [--lekalo PROGRAM] [--compiler CXX]
        links, files, names and options that the documentation mentions exist; its code compiles
    check_docs.py baseline ROOT
        prints the counts of today's offences against the voice, a line for each folder and rule

Each finding is a line FILE:LINE: and a sentence. The exit status is 1 if there is any, else 0. With a baseline a
folder may have as many offences against a rule as the file says, and no more.
"""
import argparse
import collections
import difflib
import functools
import glob
import json
import os
import re
import subprocess
import sys
import tempfile

Finding = collections.namedtuple("Finding", "path line rule text")

SOURCE_FOLDERS = ["include", "src", "apps", "bindings", "web/src"]
SOURCE_ENDINGS = (".hpp", ".cpp", ".ts")
GENERATED = ("build/", "demo-out/", "test-out/", "web/dist", "web/node_modules", "cmake-build")


# ---------------------------------------------------------------------------------------------------------
# Files

def lines_of(root, path):
    with open(os.path.join(root, path), encoding="utf-8", errors="replace") as file:
        return file.read().split("\n")


@functools.lru_cache(maxsize=None)
def all_files(root):
    """Every file of the project, relative to its root, sorted."""
    found = []
    for folder, names, files in os.walk(root):
        relative = os.path.relpath(folder, root)
        names[:] = sorted(n for n in names if not n.startswith(".git") and not is_generated(join(relative, n) + "/"))
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


# ---------------------------------------------------------------------------------------------------------
# Markdown

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


# ---------------------------------------------------------------------------------------------------------
# Voice of the documentation

WIDEST_LINE = 100
MOST_WORDS = 40
HEADINGS = ["Goal", "Steps", "Bounds", "Limits", "What failed"]
PAGES_OF_TESTS = ["docs/nc-samples.md"]  # a test writes it and compares its bytes
PAGES_OF_ANOTHER_SHAPE = ["docs/design/house.md", "docs/design/extending.md"]
SENTENCE_ENDS = re.compile(r"(?<=[.?!:;])[\"')*`]*\s+")


def check_line_length(root):
    for path in pages(root):
        if not (path.startswith("docs/") or path == "README.md") or path in PAGES_OF_TESTS:
            continue
        prose, _ = split_page(lines_of(root, path))
        for number, line in enumerate(prose, 1):
            bare = re.sub(r"\]\([^)]*\)", "]()", line)
            if len(bare) > WIDEST_LINE and is_prose(line):
                yield Finding(path, number, "long-line",
                              f"this line has {len(bare)} characters; prose has at most {WIDEST_LINE}.")


def check_sentences(root):
    for path in pages(root):
        if not (path.startswith(("docs/design/", "docs/measurements/")) or path == "README.md"):
            continue
        prose, _ = split_page(lines_of(root, path))
        for number, text in paragraphs(prose):
            for sentence in SENTENCE_ENDS.split(text):
                words = len(sentence.split())
                if words > MOST_WORDS:
                    yield Finding(path, number, "long-sentence",
                                  f"the sentence \"{sentence[:50]}...\" has {words} words; it may have {MOST_WORDS}.")


def check_headings(root):
    for path in pages(root):
        if not path.startswith("docs/design/") or path in PAGES_OF_ANOTHER_SHAPE:
            continue
        prose, _ = split_page(lines_of(root, path))
        found = [(number, line[3:].strip()) for number, line in enumerate(prose, 1) if line.startswith("## ")]
        names = [name for _, name in found]
        for name in ("Goal", "Steps"):
            if name not in names:
                yield Finding(path, 1, "headings", f"the page has no section \"## {name}\".")
        last = -1
        for number, name in found:
            place = HEADINGS.index(name) if name in HEADINGS else None
            if place is None:
                yield Finding(path, number, "headings",
                              f"the section \"{name}\" is none of {', '.join(HEADINGS)}; make it a part of one of them.")
            elif place <= last:
                yield Finding(path, number, "headings",
                              f"the section \"{name}\" stands too late; the order is {', '.join(HEADINGS)}.")
            else:
                last = place


# ---------------------------------------------------------------------------------------------------------
# Voice of the comments

OPENINGS = ["Of", "What", "Whether", "Where", "Which", "As who"]
COMMENT = re.compile(r"^\s*//+!?(?![</!])(.*)$")
TOOL_WORDS = re.compile(r"clang-format|NOLINT|eslint|prettier|@ts-|SPDX|https?://")
COLUMN_LIMIT = re.compile(r"^ColumnLimit:\s*(\d+)", re.M)
SHORT_LINE = 40
TAG = re.compile(r"\\(?:pre|param|return|see)\b[^.]*$")  # the words after a tag need not be a sentence


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


def is_set_off(text):
    """Code, a formula, a row of a list: not a line of running text."""
    return text.startswith("  ") or bool(ITEM.match(text)) or text.lstrip().startswith(("\\", "@", "|", "```"))


def check_openings(root):
    for path in sources(root):
        for number, block in comment_blocks(lines_of(root, path)):
            text = block[0].strip()
            opening = next((o for o in OPENINGS if re.match(re.escape(o) + r"\b", text)), None)
            if text == "The same." or (text.startswith("The same.") and len(block) == 1):
                opening = "The same."
            if opening:
                yield Finding(path, number, "opening",
                              f"the comment begins with \"{opening}\"; begin with its subject, and give it a verb.")


def check_endings(root):
    for path in sources(root):
        for number, block in comment_blocks(lines_of(root, path)):
            text = block[-1].rstrip()
            if any(is_set_off(line) for line in block) or TAG.search(" ".join(block)):
                continue
            if not re.search(r"[.:?!;,`}\])]$|\.[\"')]$", text):
                yield Finding(path, number + len(block) - 1, "ending", "the comment ends without a full stop.")


def check_torn(root):
    limit = column_limit(root)
    for path in sources(root):
        lines = lines_of(root, path)
        for number, block in comment_blocks(lines):
            for place in range(len(block) - 1):
                line, text, following = lines[number - 1 + place].rstrip(), block[place], block[place + 1]
                if is_set_off(text) or text.endswith((":", ";")) or not following.lstrip()[:1].islower():
                    continue
                if is_set_off(following) and not any("\\" in before for before in block[:place + 1]):
                    continue  # a formula; after a tag it is the tag's own text
                if len(line) < SHORT_LINE and len(line) + 1 + len(following.split()[0]) <= limit:
                    yield Finding(path, number + place, "torn",
                                  "the comment breaks off here although the next word has room; wrap it anew.")


def column_limit(root):
    path = os.path.join(root, ".clang-format")
    match = COLUMN_LIMIT.search(open(path, encoding="utf-8").read()) if os.path.exists(path) else None
    return int(match.group(1)) if match else 110


VOICE = [check_line_length, check_sentences, check_headings, check_openings, check_endings, check_torn]


def voice(root):
    return [finding for check in VOICE for finding in check(root)]


# ---------------------------------------------------------------------------------------------------------
# References: links

LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")


def anchors(root, path):
    """The anchors that a page's headings get, as the usual hosts make them."""
    found = set()
    prose, _ = split_page(lines_of(root, path))
    for line in prose:
        match = re.match(r"^#+\s+(.*)$", line)
        if match:
            text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", match.group(1)).strip().lower()
            slug = re.sub(r"[^\w\- ]", "", text).replace(" ", "-")
            count = sum(1 for f in found if f == slug or re.fullmatch(re.escape(slug) + r"-\d+", f))
            found.add(slug if not count else f"{slug}-{count}")
    return found


def check_links(root):
    for path in pages(root):
        prose, _ = split_page(lines_of(root, path))
        for number, line in enumerate(prose, 1):
            for target in LINK.findall(re.sub(r"`[^`]*`", "", line)):
                if re.match(r"[a-z]+:", target):
                    continue
                file, _, anchor = target.partition("#")
                place = os.path.normpath(join(os.path.dirname(path) or ".", file)) if file else path
                if not os.path.exists(os.path.join(root, place)):
                    yield Finding(path, number, "link", f"the link leads to {target}, which does not exist{nearest(root, place)}")
                elif anchor and place.endswith(".md") and anchor not in anchors(root, place):
                    yield Finding(path, number, "link", f"{place} has no heading for the anchor #{anchor}.")


# ---------------------------------------------------------------------------------------------------------
# References: files

ENDINGS = r"\.(?:md|hpp|cpp|h|ts|mjs|js|py|sh|cmake|json|csv|svg|png|nc|ngc|txt|commands|dxf|in)"
CODE_ENDINGS = (".md", ".hpp", ".cpp", ".ts", ".mjs", ".py", ".sh", ".cmake")
KINDS = ["unit", "property", "differential", "corpus", "determinism", "e2e", "oracle", "parity"]
PLACE = re.compile(r"^[\w.{},*+-]+(?:/[\w.{},*+-]+)*/?$")


def expand_braces(text):
    match = re.search(r"\{([^{}]*)\}", text)
    if not match:
        return [text]
    return [whole for part in match.group(1).split(",")
            for whole in expand_braces(text[:match.start()] + part + text[match.end():])]


@functools.lru_cache(maxsize=None)
def file_index(root):
    """Every ending of every path at a slash, and the same without the file's ending and with its folders."""
    index = set()
    for path in all_files(root):
        parts = path.split("/")
        for start in range(len(parts)):
            tail = "/".join(parts[start:])
            index.add(tail)
            index.add(re.sub(r"(_test)?\.[a-z]+$", "", tail))
            index.add(re.sub(r"\.[a-z]+$", "", tail))
            for end in range(start + 1, len(parts)):
                index.add("/".join(parts[start:end]))
    return index


@functools.lru_cache(maxsize=None)
def first_folders(root):
    """The folders that a path in the documentation may begin with."""
    found = {path.split("/")[0] for path in all_files(root) if "/" in path}
    for start in ("src", "include/lekalo", "docs", "tests", "apps", "web", "bindings"):
        depth = start.count("/") + 1
        found |= {path.split("/")[depth] for path in all_files(root)
                  if path.startswith(start + "/") and path.count("/") > depth}
    return found


def is_there(root, place):
    place = re.sub(r"(?<![a-z])[A-Z]{2,}(?![a-z])", "*", place.rstrip("/"))
    if "*" not in place:
        return place in file_index(root)
    pattern = re.compile(re.escape(place).replace(r"\*", "[^ ]*") + r"$")
    return any(pattern.match(known) for known in file_index(root))


def nearest(root, place):
    """The end of a sentence: where a file of this name is, or one of nearly this name."""
    name = os.path.basename(place.rstrip("/"))
    files = all_files(root)
    same = [path for path in files if os.path.basename(path) == name]
    if not same:
        stem = re.sub(r"\.[a-z]+$", "", name).replace("*", "")
        same = [path for path in files if re.sub(r"\.[a-z]+$", "", os.path.basename(path)) == stem]
    if not same:  # dxf_writer.cpp may have become dxf/writer.cpp
        words = [w for w in re.split(r"[_./*]+", re.sub(r"\.[a-z]+$", "", place)) if w]
        same = [path for path in files if path.endswith(CODE_ENDINGS) and len(words) > 1
                and re.split(r"[_./]+", re.sub(r"\.[a-z]+$", "", path))[-2:] == words[-2:]]
    if not same:
        close = difflib.get_close_matches(name, {os.path.basename(path) for path in files}, 1, 0.75)
        same = [path for path in files if close and os.path.basename(path) == close[0]]
    return f"; the nearest is {same[0]}." if same else "."


def code_words(root, path):
    """(line number, word) of everything in backticks, page by page; a word may go on in the next line."""
    prose, _ = split_page(lines_of(root, path))
    block = []
    for number, line in enumerate(prose + [""], 1):
        if line.strip():
            block = block or [number]
            block.append(line.strip())
        elif block:
            start, text, block = block[0], "\n".join(block[1:]), []
            for match in re.finditer(r"`([^`]+)`", text):
                yield start + text.count("\n", 0, match.start()), match.group(1).replace("\n", " ")


def names_a_file(root, word):
    if not PLACE.match(word) or is_generated(word) or word.startswith("."):
        return False
    if "/" in word.rstrip("/"):
        return expand_braces(word)[0].split("/")[0] in first_folders(root)
    return word.endswith(CODE_ENDINGS) and not word.startswith("*")


def check_files(root):
    for path in pages(root):
        if path == "CHANGELOG.md":  # it tells what was
            continue
        for number, word in code_words(root, path):
            for piece in re.split(r"[\s;,]+(?![^{]*\})", word):
                if not names_a_file(root, piece):
                    continue
                for place in expand_braces(piece):
                    if not is_there(root, place):
                        yield Finding(path, number, "file", f"the file `{place}` does not exist{nearest(root, place)}")


def check_files_of_comments(root):
    """Pages that comments in the sources name, with the steps and sections they name."""
    for path in sources(root):
        for number, line in enumerate(lines_of(root, path), 1):
            for place in re.findall(r"\bdocs/[\w/.-]+\.md\b", line):
                if not os.path.exists(os.path.join(root, place)):
                    yield Finding(path, number, "file", f"the comment names {place}, which does not exist{nearest(root, place)}")
            for step, place in re.findall(r"\b[Ss]teps? (\d+) of (docs/design/[\w-]+\.md)", line):
                if os.path.exists(os.path.join(root, place)) and not has_step(root, place, step):
                    yield Finding(path, number, "file", f"{place} has no step {step}.")


def has_step(root, path, step):
    return any(re.match(rf"^\s*{step}\. ", line) for line in lines_of(root, path))


# ---------------------------------------------------------------------------------------------------------
# References: names

WORDS_OF_STYLE = {"CamelCase", "snake_case", "member_"}
NAME = re.compile(r"^(?:[A-Za-z_]\w*::)*[A-Za-z_]\w*(?:\(\))?$")
WORDS_OF = ("include/", "src/", "apps/", "bindings/", "web/src/", "tests/", "bench/", "fuzz/", "cmake/", "tools/",
            "CMakeLists.txt", "CMakePresets.json", "examples/", "docs/schema/", "docs/formats.md", "docs/protocol.md")


@functools.lru_cache(maxsize=None)
def known_names(root):
    """Every word of the sources, of the tests and of the build."""
    found = set()
    for path in all_files(root):
        if path.startswith(WORDS_OF) and not path.startswith(("tests/corpus/data", "tests/docs")) \
                and path.endswith((".hpp", ".cpp", ".ts", ".py", ".sh", ".cmake", ".txt", ".json", ".mjs", ".in", ".md", ".h")):
            with open(os.path.join(root, path), encoding="utf-8", errors="replace") as file:
                found |= set(re.findall(r"[A-Za-z_]\w*", file.read()))
    return found


def is_a_name(word):
    """A name that only a source can have: with an underscore, a scope, or capitals inside."""
    if not NAME.match(word) or word.startswith("std::") or word in WORDS_OF_STYLE:
        return False
    bare = word.removesuffix("()")
    return "::" in bare or "_" in bare.strip("_") or bool(re.match(r"^k?[A-Z][a-z0-9]+[A-Z]", bare))


def check_names(root):
    for path in pages(root):
        if path == "CHANGELOG.md":
            continue
        for number, word in code_words(root, path):
            if not is_a_name(word):
                continue
            if is_a_program(root, word):
                continue
            missing = [part for part in word.removesuffix("()").split("::")
                       if part not in known_names(root) and not is_there(root, part)]
            if missing:
                close = difflib.get_close_matches(missing[0], known_names(root), 1, 0.7)
                hint = f"; the nearest is {close[0]}." if close else "."
                yield Finding(path, number, "name", f"no source has the name `{missing[0]}`{hint}")


def is_a_program(root, word):
    """property_io_shape_tree is tests/property/io_shape_tree_test.cpp, bench_scan is bench/scan.cpp."""
    kind, _, name = word.partition("_")
    if kind in KINDS:
        return is_there(root, f"tests/{kind}/{name}_test.cpp")
    return kind == "bench" and is_there(root, f"bench/{name}.cpp")


def check_programs(root):
    """Tests and benchmarks in commands: LEKALO_CASES=10 property_io_shape_tree --gtest_filter=..."""
    pattern = re.compile(r"(?<![\w./-])(?:\S*/)?((?:%s|bench)_[a-z]\w+)" % "|".join(KINDS))
    for path in pages(root):
        if path == "CHANGELOG.md":
            continue
        for number, word in code_words(root, path):
            for program in pattern.findall(word):
                if not is_a_program(root, program) and program not in known_names(root) \
                        and not is_there(root, program):
                    kind, _, name = program.partition("_")
                    place = f"bench/{name}.cpp" if kind == "bench" else f"tests/{kind}/{name}_test.cpp"
                    yield Finding(path, number, "name", f"no program is called {program}{nearest(root, place)}")


# ---------------------------------------------------------------------------------------------------------
# References: options

OPTION = re.compile(r"(?<![\w-])--[a-z][a-z0-9-]*")
OPTIONS_OF_OTHERS = {"--gtest", "--preset", "--workflow", "--install", "--help"}
COMMAND = re.compile(r"(?:^|[\s;&(`])(?:build/release/)?lekalo ([a-z]+)\s(.*)$")


@functools.lru_cache(maxsize=None)
def options_of_sources(root):
    found = set(OPTIONS_OF_OTHERS)
    for path in all_files(root):
        if path.startswith(("apps/", "src/", "bench/", "tools/", "tests/", "fuzz/", "web/", "test.sh", "demo.sh")) \
                and path.endswith((".cpp", ".hpp", ".sh", ".mjs", ".py", ".cmake", ".ts")) \
                and not path.startswith("tests/docs"):
            with open(os.path.join(root, path), encoding="utf-8", errors="replace") as file:
                text = file.read()
            found |= set(OPTION.findall(text))
            if path.endswith(".cpp"):  # some are put together: "--" and the word
                found |= {"--" + word for word in re.findall(r'"([a-z][a-z-]*)"', text)}
    return found


def check_options(root):
    for path in pages(root):
        if path == "CHANGELOG.md":
            continue
        for number, line in enumerate(lines_of(root, path), 1):
            for option in OPTION.findall(line):
                if option not in options_of_sources(root):
                    close = difflib.get_close_matches(option, options_of_sources(root), 1, 0.7)
                    hint = f"; the nearest is {close[0]}." if close else "."
                    yield Finding(path, number, "option", f"no program has an option {option}{hint}")


def command_lines(lines):
    """(line number, command, rest) of what is called in code, lines that end in a backslash joined."""
    number = 0
    while number < len(lines):
        start, text = number, lines[number]
        while text.endswith("\\") and number + 1 < len(lines):
            number += 1
            text = text[:-1] + " " + lines[number]
        number += 1
        text = re.sub(r"\s#.*$", "", text)
        for part in re.split(r"&&|;|\|", text):
            match = COMMAND.search(part.strip() + " ")
            if match:
                yield start + 1, match.group(1), match.group(2)


def check_commands(root, lekalo):
    """What lekalo is called with in the pages: each command takes its options, each example is there."""
    options = functools.lru_cache(maxsize=None)(lambda command: options_of_command(lekalo, command))
    for path in pages(root):
        if path == "CHANGELOG.md":
            continue
        lines = lines_of(root, path)
        code = [line if line.startswith("    ") or in_fence else "" for line, in_fence in with_fences(lines)]
        for number, command, rest in command_lines(code):
            for place in re.findall(r"(?<!\S)examples/[\w./-]+", rest):
                if not os.path.exists(os.path.join(root, place)):
                    yield Finding(path, number, "example", f"the example {place} does not exist{nearest(root, place)}")
            for option in OPTION.findall(rest):
                if lekalo and option not in options(command):
                    yield Finding(path, number, "option", f"lekalo {command} has no option {option}.")


def with_fences(lines):
    inside = False
    for line in lines:
        fence = FENCE.match(line)
        if fence:
            inside = not inside
        yield line, inside and not fence


def options_of_command(lekalo, command):
    told = subprocess.run([lekalo, command, "--help"], capture_output=True, text=True, check=False)
    return set(OPTION.findall(told.stdout + told.stderr)) | {"--help"}


# ---------------------------------------------------------------------------------------------------------
# References: code in pages

def check_json(root):
    for path in pages(root):
        for block in split_page(lines_of(root, path))[1]:
            if block.info[:1] == ["json"] and "fragment" not in block.info:
                try:
                    json.loads("\n".join(block.lines))
                except ValueError as error:
                    yield Finding(path, block.line, "code", f"this is no JSON: {error}; say \"json fragment\" if it is a part of one.")


def check_cpp(root, compiler):
    """Code that is quoted from a file is left to the test that compiles the file."""
    for path in pages(root):
        lines = lines_of(root, path)
        for block in split_page(lines)[1]:
            if block.info[:1] == ["cpp"] and "fragment" not in block.info and not quoted_file(lines, block):
                error = compile_error(root, compiler, block.lines)
                if error:
                    yield Finding(path, block.line, "code", f"this does not compile: {error}")


def compile_error(root, compiler, lines):
    """The first error of the compiler. Code without an #include is a function's body."""
    text = "\n".join(lines) + "\n"
    if "#include" not in text:
        modules = sorted(set(re.findall(r"lekalo::(\w+)", text)))
        headers = [h for m in modules for h in sorted(glob.glob(os.path.join(root, "include/lekalo", m, "*.hpp")))]
        text = "".join(f'#include "{h}"\n' for h in headers) + "#include <cassert>\nvoid code() {\n" + text + "}\n"
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "code.cpp")
        with open(file, "w", encoding="utf-8") as out:
            out.write(text)
        told = subprocess.run([*compiler.split(), "-std=c++20", "-fsyntax-only", "-I", os.path.join(root, "include"), file],
                              capture_output=True, text=True, check=False)
    if told.returncode == 0:
        return None
    return next((l for l in told.stderr.split("\n") if "error" in l), told.stderr.strip()).split("error: ")[-1]


def quoted_file(lines, block):
    """The file that a comment <!-- code of FILE --> above a block names."""
    above = next((line for line in reversed(lines[:block.line - 1]) if line.strip()), "")
    match = re.match(r"^<!-- code of (\S+) -->$", above.strip())
    return match.group(1) if match else None


def check_quoted(root):
    """The lines of quoted code stand in their file, in this order."""
    for path in pages(root):
        lines = lines_of(root, path)
        for block in split_page(lines)[1]:
            source = quoted_file(lines, block)
            if not source:
                continue
            if not os.path.exists(os.path.join(root, source)):
                yield Finding(path, block.line, "code",
                              f"the code is said to be of {source}, which does not exist{nearest(root, source)}")
                continue
            rest = iter([" ".join(line.split()) for line in lines_of(root, source)])
            for offset, line in enumerate(block.lines, 1):
                text = " ".join(line.split())
                if text and text not in rest:
                    yield Finding(path, block.line + offset, "code",
                                  f"this line does not stand in {source} where it should.")
                    break


def references(root, lekalo=None, compiler=None):
    found = [finding for check in (check_links, check_files, check_files_of_comments, check_names, check_programs,
                                   check_options, check_json, check_quoted) for finding in check(root)]
    found += check_commands(root, lekalo)
    if compiler:
        found += check_cpp(root, compiler)
    return found


# ---------------------------------------------------------------------------------------------------------
# Baseline: to be taken away with its file and its option when no offences are left

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
            print(f"note: {folder} has {now[folder, rule]} of {count} offences against '{rule}' left; lower the baseline.")
    return [f for f in findings if now[folder_of(f.path), f.rule] > allowed[folder_of(f.path), f.rule]]


# ---------------------------------------------------------------------------------------------------------

def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["voice", "references", "baseline"])
    parser.add_argument("root")
    parser.add_argument("--baseline")
    parser.add_argument("--lekalo")
    parser.add_argument("--compiler")
    words = parser.parse_args()
    words.root = os.path.abspath(words.root)
    if words.what == "baseline":
        for (folder, rule), count in sorted(counts(voice(words.root)).items()):
            print(folder, rule, count)
        return 0
    if words.what == "voice":
        findings = voice(words.root)
        if words.baseline:
            findings = beyond_baseline(findings, words.baseline)
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

"""What the documentation mentions exists: links, files, names, options, examples; its code compiles."""
import difflib
import functools
import glob
import json
import os
import re
import subprocess
import tempfile

from project import FENCE, Finding, all_files, comment_blocks, is_generated, join, lines_of, pages, sources, split_page

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
                    yield Finding(path, number, "link",
                                  f"the link leads to {target}, which does not exist{nearest(root, place)}")
                elif anchor and place.endswith(".md") and anchor not in anchors(root, place):
                    yield Finding(path, number, "link", f"{place} has no heading for the anchor #{anchor}.")


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
    place = re.sub(r"NAME|KIND|MODULE|TOPIC", "*", place.rstrip("/"))
    if "*" not in place:
        return place in file_index(root)
    pattern = re.compile(re.escape(place).replace(r"\*", "[^ ]*") + r"$")
    return any(pattern.match(known) for known in file_index(root))


def nearest(root, place):
    """The end of a sentence: where a file of this name is, or one of nearly this name."""
    found = files_like(root, place)
    if not found:
        return "."
    best = max(found, key=lambda path: (len(os.path.commonprefix([path, place])), path.endswith((".hpp", ".h")), path))
    return f"; the nearest is {best}."


def stem(path):
    return re.sub(r"\.[a-z]+$", "", os.path.basename(path.rstrip("/*")))


def files_like(root, place):
    """Files of this name, whatever their ending; then FOLDER/NAME for FOLDER_NAME, or what the last word names; then
    files of nearly this name."""
    every = all_files(root)
    files = [path for path in every if path.endswith(CODE_ENDINGS)]
    name, base = stem(place).rstrip("_"), os.path.basename(place)
    folder, _, word = name.partition("_")
    found = ([path for path in every if os.path.basename(path) == base]
             or [path for path in files if stem(path) == name]
             or [path for path in files if path.split("/")[-2:-1] == [folder] and stem(path) == (word or stem(path))]
             or [path for path in files if word and stem(path) in (word, word.replace("_", ""))])
    close = [] if found else similar(base, map(os.path.basename, every))
    return found or [path for path in every if os.path.basename(path) in close]


def similar(word, words):
    return difflib.get_close_matches(word, set(words), 1, 0.8)


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
    """Pages that comments in the sources name, with the steps and the sections that they name."""
    for path in sources(root):
        lines = lines_of(root, path)
        for number, line in enumerate(lines, 1):
            for place in re.findall(r"\bdocs/[\w/.-]+\.md\b", line):
                if not os.path.exists(os.path.join(root, place)):
                    yield Finding(path, number, "file",
                                  f"the comment names {place}, which does not exist{nearest(root, place)}")
        for number, block in comment_blocks(lines):
            text = " ".join(line.strip() for line in block)
            for step, place in re.findall(r"\b(?:[Ss]teps?|[Rr]ule) (\d+[a-z]?) of (docs/design/[\w-]+\.md)", text):
                if os.path.exists(os.path.join(root, place)) and not has_step(root, place, step):
                    yield Finding(path, number, "file", f"{place} has no step {step}.")
            for place, section in re.findall(r"\b(docs/[\w/-]+\.md), \"([^\"]+)\"", text):
                if os.path.exists(os.path.join(root, place)) and not has_section(root, place, section):
                    yield Finding(path, number, "file", f"{place} has no section \"{section}\".")


def has_section(root, path, section):
    """A heading, or a paragraph that begins with the words in bold or as code."""
    pattern = re.compile(rf"^\s*(#+ |[*]+|`){re.escape(section)}\b", re.IGNORECASE)
    return any(pattern.match(line) for line in lines_of(root, path))


def has_step(root, path, step):
    """Steps are items of a list, or headings."""
    return any(re.match(rf"^\s*(#+ )?{step}\. ", line) for line in lines_of(root, path))


WORDS_OF_STYLE = {"CamelCase", "snake_case", "member_", "kConstant"}
NAME = re.compile(r"^(?:[A-Za-z_]\w*::)*[A-Za-z_]\w*(?:\(\))?$")
WORDS_OF = ("include/", "src/", "apps/", "bindings/", "web/src/", "tests/", "bench/", "fuzz/", "cmake/", "tools/",
            "CMakeLists.txt", "CMakePresets.json", "examples/", "docs/schema/", "docs/formats.md", "docs/protocol.md")
ENDINGS_WITH_NAMES = (".hpp", ".cpp", ".ts", ".py", ".sh", ".cmake", ".txt", ".json", ".mjs", ".in", ".md", ".h")


@functools.lru_cache(maxsize=None)
def known_names(root):
    """Every word of the sources, of the tests and of the build."""
    found = set()
    for path in all_files(root):
        if path.startswith(WORDS_OF) and not path.startswith(("tests/corpus/data", "tests/docs")) \
                and path.endswith(ENDINGS_WITH_NAMES):
            with open(os.path.join(root, path), encoding="utf-8", errors="replace") as file:
                found |= set(re.findall(r"[A-Za-z_]\w*", file.read()))
    return found


def is_a_name(word):
    """A name that only a source can have: with an underscore, a scope, or capitals inside."""
    if not NAME.match(word) or word.startswith("std::") or word in WORDS_OF_STYLE:
        return False
    bare = word.removesuffix("()")
    return "::" in bare or "_" in bare.strip("_") or bool(re.match(r"^(k[A-Z]|[A-Z][a-z0-9]+[A-Z])", bare))


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
                close = similar(missing[0], known_names(root))
                hint = f"; the nearest is {close[0]}." if close else nearest(root, missing[0])
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


def said(lekalo, *words):
    told = subprocess.run([lekalo, *words], capture_output=True, text=True, check=False)
    return told.stdout + told.stderr


def options_of_command(lekalo, *command):
    return set(OPTION.findall(said(lekalo, *command, "--help"))) | {"--help"}


LITERAL = re.compile(r'"((?:[^"\\\n]|\\.)*)"')


def check_messages(root, lekalo):
    """Options that messages advise: some command takes each."""
    commands = re.findall(r"^  ([a-z]+) ", said(lekalo, "--help").partition("Subcommands:")[2], re.M)
    options = options_of_command(lekalo).union(*(options_of_command(lekalo, command) for command in commands))
    for path in sources(root):
        # apps/step is a program of its own, which need not be built.
        if not path.startswith(("src/", "apps/", "include/")) or path.startswith("apps/step/"):
            continue
        for number, line in enumerate(lines_of(root, path), 1):
            for option in OPTION.findall(" ".join(LITERAL.findall(line.partition("// ")[0]))):
                if option not in options:
                    close = difflib.get_close_matches(option, options, 1, 0.7)
                    hint = f"; the nearest is {close[0]}." if close else "."
                    yield Finding(path, number, "option", f"no command has an option {option}{hint}")


def check_json(root):
    for path in pages(root):
        for block in split_page(lines_of(root, path))[1]:
            if block.info[:1] == ["json"] and "fragment" not in block.info:
                try:
                    json.loads("\n".join(block.lines))
                except ValueError as error:
                    yield Finding(path, block.line, "code",
                                  f"this is no JSON: {error}; say \"json fragment\" if it is a part of one.")


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
        told = subprocess.run([compiler, "-std=c++20", "-fsyntax-only", "-I", os.path.join(root, "include"), file],
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
    if lekalo:
        found += check_messages(root, lekalo)
    if compiler:
        found += check_cpp(root, compiler)
    return found

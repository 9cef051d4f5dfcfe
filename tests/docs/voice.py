"""The voice of the documentation and of the comments, as far as a machine can hold it."""
import os
import re

from project import ITEM, Finding, comment_blocks, is_prose, lines_of, pages, paragraphs, sources, split_page

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
                              f"the section \"{name}\" is none of {', '.join(HEADINGS)}; "
                              "make it a part of one of them.")
            elif place <= last:
                yield Finding(path, number, "headings",
                              f"the section \"{name}\" stands too late; the order is {', '.join(HEADINGS)}.")
            else:
                last = place


OPENINGS = ["Of", "What", "Whether", "Where", "Which", "As who"]
COLUMN_LIMIT = re.compile(r"^ColumnLimit:\s*(\d+)", re.M)
SHORT_LINE = 40
SECTION_RULE = re.compile(r"^-{4} \S.* -{4,}$")  # a heading between functions, a line of its own
TAG = re.compile(r"\\(?:pre|param|return|see)\b[^.]*$")  # the words after a tag need not be a sentence


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
            if len(block) == 1 and SECTION_RULE.match(text):
                continue
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

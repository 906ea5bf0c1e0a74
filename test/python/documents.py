"""Reads the documents of docs/ for the tests that hold them to what they say."""

import re


def read_blocks(path, mark):
    """The code blocks of a Markdown file that follow the comment <!-- mark -->."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    return re.findall(r"<!-- %s -->\n```\w*\n(.*?)```" % re.escape(mark), text, flags=re.S)


def read_tables(path):
    """The tables of a Markdown file: title of its column 1 -> rows of cells, in order."""
    tables = {}
    rows = None
    with open(path, encoding="utf-8") as file:
        for line in file:
            if not line.startswith("|"):
                rows = None
                continue
            cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
            if rows is None:
                rows = tables.setdefault(cells[0], [])
            elif not set(cells[0]) <= set("-: "):
                rows.append(cells)
    return tables

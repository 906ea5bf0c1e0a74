"""Maps and scenarios as the programs of the field write them, each with what it means.

A right answer is the rows of the map (`.` free, `@` occupied, `?` unknown) or the ways of the
robots; a refusal is the place that the message has to name.
"""

import os
import struct
import zlib

ROWS = ["....", ".@..", "...."]
WAYS = [[0, 0, 3, 2], [3, 0, 0, 2]]
HEADER = "type octile\nheight 3\nwidth 4\nmap\n"
BODY = "....\n.@..\n....\n"
MAP = HEADER + BODY
ROW = "0\tm.map\t4\t3\t0\t0\t3\t2\t5\n"
ROW_BACK = "0\tm.map\t4\t3\t3\t0\t0\t2\t5\n"
SCENARIO = "version 1\n" + ROW + ROW_BACK
YAML = ("image: %s\nresolution: 0.05\norigin: [-1.5, 2.0, 0.25]\nnegate: 0\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.196\n")
WHITE, BLACK, GREY = 254, 0, 205
SAMPLES = [[{".": WHITE, "@": BLACK}[cell] for cell in row] for row in ROWS]

# File name: bytes or text, and the rows that are read or the place of the refusal.
MAPS = {
    "plain.map": (MAP, ROWS),
    "no_type.map": (MAP.replace("type octile\n", ""), ROWS),
    "width_first.map": ("type octile\nwidth 4\nheight 3\nmap\n" + BODY, ROWS),
    "type_last.map": ("width 4\nheight 3\ntype octile\nmap\n" + BODY, ROWS),
    "capitals.map": ("Type Octile\nHeight 3\nWIDTH 4\nMap\n" + BODY, ROWS),
    "tabs_in_header.map": ("type\toctile\nheight\t3\nwidth \t4\nmap\t\n" + BODY, ROWS),
    "blanks_behind_rows.map": (HEADER + "....  \n.@.. \n....\t\n", ROWS),
    "carriage_returns.map": (MAP.replace("\n", "\r\n"), ROWS),
    "old_carriage_returns.map": (MAP.replace("\n", "\r"), ROWS),
    "byte_order_mark.map": ("\ufeff" + MAP, ROWS),
    "empty_last_lines.map": (MAP + "\n  \n\n", ROWS),
    "empty_lines.map": (HEADER + "\n....\n\n.@..\n....\n", ROWS),
    "no_last_line_feed.map": (MAP[:-1], ROWS),
    "every_symbol.map": ("height 2\nwidth 4\nmap\n.GSE\n@OTW\n", ["....", "@@@@"]),
    "twice.map": (MAP + "\n" + MAP, "twice.map:9: "),
    "long_row.map": (HEADER + "....\n.@...\n....\n", "long_row.map:6: "),
    "short_row.map": (HEADER + "....\n.@.\n....\n", "short_row.map:6: "),
    "blank_cells.map": (HEADER + "....\n.@ .\n....\n", "blank_cells.map:6: "),
    "missing_row.map": (HEADER + "....\n.@..\n", "missing_row.map:7: "),
    "extra_row.map": (MAP + "....\n", "extra_row.map:8: "),
    "strange_symbol.map": (HEADER + "....\n.#..\n....\n", "strange_symbol.map:6: "),
    "other_type.map": (MAP.replace("octile", "hex"), "other_type.map:1: "),
    "two_heights.map": ("height 3\nheight 4\n" + BODY, "two_heights.map:2: "),
    "not_a_map.map": ("4,4\n" + BODY, "not_a_map.map:1: "),
    "empty.map": ("", "empty.map:1: "),
}

# Text of a scenario for ROWS, and the ways or the place of the refusal.
SCENARIOS = {
    "plain.scen": (SCENARIO, WAYS),
    "version_1_0.scen": (SCENARIO.replace("version 1", "version 1.0"), WAYS),
    "capital_version.scen": (SCENARIO.replace("version", "Version"), WAYS),
    "no_version.scen": (ROW + ROW_BACK, WAYS),
    "empty_lines.scen": ("\nversion 1\n\n" + ROW + "\n" + ROW_BACK + "\n\n", WAYS),
    "carriage_returns.scen": (SCENARIO.replace("\n", "\r\n"), WAYS),
    "old_carriage_returns.scen": (SCENARIO.replace("\n", "\r"), WAYS),
    "byte_order_mark.scen": ("\ufeff" + SCENARIO, WAYS),
    "blank_behind_row.scen": (SCENARIO.replace("5\n", "5 \n"), WAYS),
    "tab_behind_row.scen": (SCENARIO.replace("5\n", "5.0\t\n"), WAYS),
    "several_tabs.scen": (SCENARIO.replace("\t", "\t\t"), WAYS),
    "blanks.scen": (SCENARIO.replace("\t", "  "), WAYS),
    "name_with_blanks.scen": (SCENARIO.replace("m.map", "old town.map"), WAYS),
    "name_among_blanks.scen": (SCENARIO.replace("\t", " ").replace("m.map", "my old town.map"),
                               WAYS),
    "name_in_utf_8.scen": (SCENARIO.replace("m.map", "K\u00f6ln.map"), WAYS),
    "no_length.scen": (SCENARIO.replace("\t5\n", "\n"), WAYS),
    "infinite_length.scen": (SCENARIO.replace("\t5\n", "\tinf\n"), WAYS),
    "no_last_line_feed.scen": (SCENARIO[:-1], WAYS),
    "other_version.scen": (SCENARIO.replace("version 1", "version 2"), "other_version.scen:1: "),
    "hidden_column.scen": (SCENARIO.replace("0\t0\t3", "0\t\t3"), "hidden_column.scen:2: "),
    "extra_column.scen": (SCENARIO.replace("5\n", "5\t6\n"), "extra_column.scen:2: "),
    "other_size.scen": (SCENARIO.replace("4\t3\t3", "3\t4\t3"), "other_size.scen:3: "),
    "fraction.scen": (SCENARIO.replace("3\t2", "2.5\t2"), "fraction.scen:2: "),
    "word_as_length.scen": (SCENARIO.replace("5\n", "far\n"), "word_as_length.scen:2: "),
    "on_a_wall.scen": (SCENARIO.replace("3\t2\t5", "1\t1\t5"), "on_a_wall.scen:2: "),
    "outside.scen": (SCENARIO.replace("3\t2\t5", "3\t3\t5"), "outside.scen:2: "),
    "no_rows.scen": ("version 1\n", "no_rows.scen:2: "),
    "empty.scen": ("", "empty.scen:1: "),
}


def pgm(kind="P5", maxval=255, samples=None, end=b"", header_end="\n"):
    rows = samples or SAMPLES
    head = "%s\n# CREATOR: a map saver\n%d %d\n%d%s" % (kind, len(rows[0]), len(rows), maxval,
                                                        header_end)
    if kind == "P2":
        return (head + "\n".join(" ".join(map(str, row)) for row in rows)).encode() + end
    form = ">H" if maxval > 255 else "B"
    return head.encode() + b"".join(struct.pack(form, s) for row in rows for s in row) + end


def png(colour_type=0, bits=8, interlaced=False, extra=b"", pixel=None, end=b""):
    """A PNG of SAMPLES; `pixel` gives the bits of one sample's pixel as text of 0 and 1."""
    pixel = pixel or (lambda sample: format(sample * (2 ** bits - 1) // 255, "0%db" % bits))

    def row_bytes(samples):
        text = "".join(map(pixel, samples))
        text += "0" * (-len(text) % 8)
        return b"\0" + bytes(int(text[i:i + 8], 2) for i in range(0, len(text), 8))

    passes = [(0, 0, 1, 1)]
    if interlaced:
        passes = [(0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4),
                  (1, 0, 2, 2), (0, 1, 1, 2)]
    data = b"".join(row_bytes(row[x::step_x]) for x, y, step_x, step_y in passes
                    for row in SAMPLES[y::step_y] if row[x::step_x])

    def chunk(name, body):
        checksum = zlib.crc32(name + body) & 0xffffffff
        return struct.pack(">I", len(body)) + name + body + struct.pack(">I", checksum)

    head = struct.pack(">IIBBBBB", len(SAMPLES[0]), len(SAMPLES), bits, colour_type, 0, 0,
                       int(interlaced))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + (chunk(*extra) if extra else b"") +
            chunk(b"IDAT", zlib.compress(data)) + chunk(b"IEND", b"") + end)


def byte_pairs(*channels):
    """A pixel of 8 bits a channel: the sample itself where a channel is None."""
    return lambda sample: "".join(format(sample if c is None else c, "08b") for c in channels)


WITH_GREY = [[WHITE, BLACK, GREY]]

# Picture, keys of the YAML that differ, and the rows or the place of the refusal.
PICTURES = {
    "plain.pgm": (pgm(), {}, ROWS),
    "last_line_feed.pgm": (pgm(end=b"\n"), {}, ROWS),
    "last_carriage_return.pgm": (pgm(end=b"\r\n"), {}, ROWS),
    "plain_text.pgm": (pgm("P2", end=b"\n"), {}, ROWS),
    "sixteen_bits.pgm": (pgm(maxval=65535, samples=[[s * 257 for s in row] for row in SAMPLES]),
                         {}, ROWS),
    "unknown.pgm": (pgm(samples=WITH_GREY), {}, [".@?"]),
    "colours.ppm": (b"P6 2 1 255 " + bytes([WHITE] * 3 + [BLACK] * 3), {}, [".@"]),
    "colours_in_text.ppm": (b"P3\n2 1 255\n254 254 254 0 0 0\n", {}, [".@"]),
    "bits.pbm": (b"P4 4 2\n\x40\x00\n", {}, [".@..", "...."]),
    "bits_in_text.pbm": (b"P1\n4 2\n0100 0 0 0 0\n", {}, [".@..", "...."]),
    "more_bytes.pgm": (pgm(end=b"more"), {}, "more_bytes.pgm: byte %d: " % len(pgm())),
    "cut_off.pgm": (pgm()[:-1], {}, "cut_off.pgm: byte %d: " % (len(pgm()) - 1)),
    "carriage_return_before_samples.pgm": (pgm(header_end="\r\n"), {},
                                           "carriage_return_before_samples.pgm: byte %d: " %
                                           (len(pgm()) - 12)),
    "plain.png": (png(), {}, ROWS),
    "interlaced.png": (png(interlaced=True), {}, ROWS),
    "one_bit.png": (png(bits=1, pixel=lambda s: "1" if s else "0"), {}, ROWS),
    "one_bit_interlaced.png": (png(bits=1, interlaced=True, pixel=lambda s: "1" if s else "0"), {},
                               ROWS),
    "two_bits.png": (png(bits=2, pixel=lambda s: "11" if s else "00"), {}, ROWS),
    "sixteen_bits.png": (png(bits=16), {}, ROWS),
    "colours.png": (png(2, pixel=byte_pairs(None, None, None)), {}, ROWS),
    "grey_and_alpha.png": (png(4, pixel=byte_pairs(None, 255)), {}, ROWS),
    "colours_and_alpha.png": (png(6, interlaced=True, pixel=byte_pairs(None, None, None, 255)), {},
                              ROWS),
    "palette.png": (png(3, bits=1, pixel=lambda s: "0" if s else "1",
                        extra=(b"PLTE", bytes([WHITE] * 3 + [BLACK] * 3))), {}, ROWS),
    "last_line_feed.png": (png(end=b"\n"), {}, ROWS),
    "twice.png": (png() + png(), {}, "twice.png: byte %d: " % len(png())),
    "cut_off.png": (png()[:-3], {}, "cut_off.png: byte %d: " % (len(png()) - 3)),
    "negate_False.pgm": (pgm(), {"negate": "False"}, ROWS),
    "negate_no.pgm": (pgm(), {"negate": "no"}, ROWS),
    "negate_True.pgm": (pgm(), {"negate": "True"},
                        [row.translate(str.maketrans(".@", "@.")) for row in ROWS]),
    "mode_Trinary.pgm": (pgm(), {"mode": "Trinary"}, ROWS),
    "mode_SCALE.pgm": (pgm(), {"mode": "SCALE"}, ROWS),
    "mode_Raw.pgm": (pgm(samples=[[0, 100, 255]]), {"mode": "Raw"}, [".@?"]),
    "negate_2.pgm": (pgm(), {"negate": "2"}, "negate_2.yaml:4: "),
    "mode_odd.pgm": (pgm(), {"mode": "odd"}, "mode_odd.yaml:7: "),
}


def yaml_of(picture, keys):
    lines = dict(line.split(": ", 1) for line in (YAML % picture).splitlines())
    lines.update(keys)
    return "".join("%s: %s\n" % pair for pair in lines.items())


def write_files(folder):
    """Writes everything. Returns (map, scenario or None, rows, ways or None, refusal or None)."""
    def write(name, content):
        with open(os.path.join(folder, name), "wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode("utf-8"))

    cases = []
    for name, (text, answer) in MAPS.items():
        write(name, text)
        cases.append((name, None, answer, None))
    for name, (text, answer) in SCENARIOS.items():
        write(name, text)
        cases.append(("plain.map", name, ROWS, answer))
    for name, (picture, keys, answer) in PICTURES.items():
        yaml = os.path.splitext(name)[0] + ("_png" if name.endswith("png") else "") + ".yaml"
        write(name, picture)
        write(yaml, yaml_of(name, keys))
        cases.append((yaml, None, answer, None))
        if answer == ROWS:
            cases.append((yaml, "plain.scen", ROWS, WAYS))
    return [case_of(*case) for case in cases]


def case_of(map_name, scenario, rows, ways):
    for answer in (rows, ways):
        if isinstance(answer, str):
            return map_name, scenario, None, None, answer
    return map_name, scenario, rows, ways, None

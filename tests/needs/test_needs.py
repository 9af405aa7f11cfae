"""What a scene does not use is not executed: no call, no instruction, no allocation, no byte of it.

Runs the scenes of app/features.h: natively for --stats, under callgrind for calls and instructions, under dhat for
blocks and bytes. To whom an instruction belongs tells the linker's map: code of a source file is what the linker placed
from its object file, templates shared between files left out.

    test_needs.py PROGRAM NEEDS NEEDS_BARE [-v]     (as tests/CMakeLists.txt calls it)
"""

import bisect
import collections
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77  # what tests/CMakeLists.txt tells ctest
MOST_OVER = 0.005  # of the instructions, for all optional terms together


class LinkerMap:
    """Which source file, or which function, has the code at an address."""

    def __init__(self, program):
        text = pathlib.Path(f"{program}.map").read_text()
        text = text[text.index("Linker script and memory map"):]
        # Not .text.startup (constructors of tables, before main), and not .text._Z... (templates of many files).
        section = re.compile(r"^ \.text(?:\.unlikely|\.hot)?\s+0x([0-9a-f]+)\s+0x([0-9a-f]+) (\S+)$", re.M)
        self.program = pathlib.Path(program).name
        pieces = []
        for start, size, where in section.findall(text):
            member = re.search(r"softreel_(\w+)\.a\((.*)\.cpp\.o\)", where)
            if member and int(size, 16) > 0:
                pieces.append((int(start, 16), int(size, 16), member[1] + "/" + member[2]))
        self.pieces = sorted(pieces)
        self.starts = [piece[0] for piece in self.pieces]
        self.files = {piece[2] for piece in pieces}

    def file_at(self, address):
        at = bisect.bisect_right(self.starts, address) - 1
        if at < 0 or address >= self.pieces[at][0] + self.pieces[at][1]:
            return None
        return self.pieces[at][2]


def belongs(code, file, function):
    """The scene reader asks for the catalogue's names (sim/catalogue.h): functions without arguments, of no feature."""
    if "::" in code:
        return function.startswith(code)
    return file == member_of(code) and not re.fullmatch(r"softreel::sim::\w+\(\)", function)


def member_of(code):
    """Libraries know no folders within folders: sim/minimizers/newton is sim/newton there."""
    parts = code.split("/")
    return f"{parts[0]}/{parts[-1]}"


def read_callgrind(path, linker_map):
    """{dump: {(file, function): [calls, instructions]}} of our own code, and {dump: all instructions}."""
    program = linker_map.program
    dumps, totals, name, function, skip, ours, called_ours = {}, {}, None, "", False, False, False
    with open(path, encoding="utf-8", errors="replace") as lines:
        for line in lines:
            if line.startswith("0x"):
                if skip:  # what a call cost with all that it called
                    skip = False
                    continue
                if not ours:
                    continue
                address, cost = line.split()
                file = linker_map.file_at(int(address, 16))
                if file:
                    dumps[name][(file, function)][1] += int(cost)
            elif line.startswith("fn="):
                function = line[3:].strip()
            elif line.startswith("cfn="):
                called = line[4:].strip()
            elif line.startswith("calls="):
                count, target = line[6:].split()
                file = linker_map.file_at(int(target, 16)) if called_ours else None
                if file:
                    dumps[name][(file, called)][0] += int(count)
                skip, called_ours = True, ours
            elif line.startswith("ob="):
                ours = called_ours = line.rstrip().endswith(f"/{program}")
            elif line.startswith("cob="):
                called_ours = line.rstrip().endswith(f"/{program}")
            elif line.startswith("desc: Trigger: Client Request: "):
                name = line.split(": ", 3)[3].strip()
                dumps[name] = collections.defaultdict(lambda: [0, 0])
            elif line.startswith("desc: Trigger:"):
                name = "the rest"
                dumps[name] = collections.defaultdict(lambda: [0, 0])
            elif line.startswith("summary:"):
                totals[name] = int(line.split()[1])
    return dumps, totals


def callgrind(needs, folder, which, extra=()):
    out = folder / f"callgrind.{which}.{needs.name}"
    command = ["valgrind", "--tool=callgrind", "--instr-atstart=no", "--combine-dumps=yes", *extra,
               f"--callgrind-out-file={out}", needs, folder / f"callgrind_{which}_{needs.name}", which]
    run(command)
    return out


def run(command, cwd=None):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False, cwd=cwd)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


class Judge:
    def __init__(self, table):
        self.features = table["features"]
        self.base = set(table["base"])
        self.failures = []

    def used(self, row):
        """Names of the features that the scene of a row uses."""
        if row is None:
            return self.base
        return (self.base - set(row["without"])) | set(row["brings"]) | {row["name"]}

    def runs_code_of(self, row):
        return self.used(row) | set(row["shares_code"] if row else [])

    def check(self, holds, what):
        if not holds:
            self.failures.append(what)

    def dump(self, row_name, used, counts):
        """Of one run: nothing of what is not used, something of what is."""
        zero = 0
        for feature in self.features:
            for code in feature["code"]:
                mine = [cost for (file, function), cost in counts.items() if belongs(code, file, function)]
                calls, instructions = (sum(column) for column in zip(*mine)) if mine else (0, 0)
                if feature["name"] in used:
                    if feature["name"] == row_name:
                        self.check(calls > 0 and instructions > 0,
                                   f"{row_name}: {code} of '{feature['name']}' is not executed, so it proves nothing")
                    continue
                zero += 1
                called = sorted({f for (file, f), cost in counts.items() if belongs(code, file, f) and any(cost)})
                self.check(calls == 0 and instructions == 0,
                           f"{row_name}: does not use '{feature['name']}', but {calls} calls and {instructions} "
                           f"instructions of {code}: {'; '.join(called)[:300]}")
        return zero


def check_allocations(judge, needs, linker_map, folder):
    out = folder / "dhat.json"
    run(["valgrind", "--tool=dhat", f"--dhat-out-file={out}", "--num-callers=100", needs, folder / "dhat", "base"])
    data = json.loads(out.read_text())
    frames = []
    for text in data["ftbl"]:
        match = re.match(r"0x([0-9A-F]+): (.*?)(?: \(in .*)?$", text)
        frames.append((linker_map.file_at(int(match[1], 16) - 1), match[2]) if match else (None, text))
    for feature in judge.features:
        if feature["name"] in judge.base:
            continue
        blocks = size = 0
        for point in data["pps"]:
            if any(belongs(code, *frames[f]) for f in point["fs"] for code in feature["code"]):
                blocks, size = blocks + point["tbk"], size + point["tb"]
        judge.check(blocks == 0, f"base: does not use '{feature['name']}', but it allocates {blocks} blocks, {size} bytes")
    ours = sum(point["tbk"] for point in data["pps"] if any(frames[f][0] == "sim/membrane" for f in point["fs"]))
    judge.check(ours > 0, "dhat sees no allocation of sim/membrane, so it proves nothing")
    print(f"allocations: 0 blocks, 0 bytes of what the base scene does not use ({ours} of sim/membrane)")


def has_key(stats, path):
    for key in path.split("."):
        if key not in stats:
            return False
        stats = stats[key]
    return True


def check_stats(judge, program, folder):
    """Natively: the bill names each feature, and its stages and counters are in --stats with it alone."""
    keys = {(key, feature["name"]) for feature in judge.features for key in feature["stats"]}
    named = set()
    for row in [None, *judge.features]:
        number = 0 if row is None else 1 + judge.features.index(row)
        place = folder / str(number)
        arguments = ["simulate", "scene.toml"] if row is None else list(row["arguments"])
        if "--stats" not in arguments:
            arguments += ["--stats", "stats.json"]
        run([program, *arguments, "--threads", "1", "--quiet", "-o", "native"], cwd=place)
        stats = json.loads((place / "stats.json").read_text())
        name, used = ("base" if row is None else row["name"]), judge.used(row)
        for feature in judge.features:
            if feature["name"] in stats["needs"]:
                named.add(feature["name"])
                judge.check(feature["name"] in used, f"{name}: the bill needs '{feature['name']}'")
            elif feature["name"] in stats["left_out"]:
                named.add(feature["name"])
                judge.check(feature["name"] not in used, f"{name}: the bill leaves '{feature['name']}' out")
        for key, feature in keys:
            owners = {f for k, f in keys if k == key}
            judge.check(has_key(stats, key) == bool(owners & used) or (not (row and row["drawn"]) and "render" in key),
                        f"{name}: {key} of '{feature}' is {'there' if has_key(stats, key) else 'missing'}")
    print(f"stats: {len(keys)} keys there with their feature alone; {len(named)} features named by the bill")


def check_optional_terms(judge, needs, bare, folder):
    _, full = read_callgrind(callgrind(needs, folder, "pair"), LinkerMap(needs))
    _, without = read_callgrind(callgrind(bare, folder, "pair"), LinkerMap(bare))
    gone = LinkerMap(needs).files - LinkerMap(bare).files
    judge.check("sim/bending" in gone and "sim/collider_friction" in gone, "terms are still in the bare program")
    for name in ("base", "implicit steps"):
        over = full[name] / without[name] - 1
        judge.check(abs(over) <= MOST_OVER, f"{name}: all optional terms together cost {100 * over:.3f} %")
        print(f"{name}: {full[name]:,} instructions, {without[name]:,} without {', '.join(sorted(gone))}: {100 * over:+.3f} %")


def main():
    program, needs, bare = (pathlib.Path(argument) for argument in sys.argv[1:4])
    if not shutil.which("valgrind"):
        print("not run: valgrind is missing (sh app/setup.sh test installs it)")
        sys.exit(1 if os.environ.get("CI") == "true" else SKIPPED)
    judge = Judge(json.loads(run([needs, "--list"])))
    linker_map = LinkerMap(needs)
    for feature in judge.features:
        for code in feature["code"]:
            judge.check("::" in code or member_of(code) in linker_map.files, f"'{feature['name']}': there is no code of {code}")
    with tempfile.TemporaryDirectory(prefix="softreel_needs_") as name:
        folder = pathlib.Path(name)
        # Mesa keeps compiled shaders here; optimizing them is left out, since they draw a few hundred pixels.
        os.environ["MESA_SHADER_CACHE_DIR"] = str(folder / "shaders")
        os.environ["GALLIVM_PERF"] = "nopt"
        out = callgrind(needs, folder, "all", ["--dump-instr=yes", "--dump-line=no", "--compress-strings=no",
                                               "--compress-pos=no"])
        dumps, _ = read_callgrind(out, linker_map)
        zero = 0
        rows = {"base": None, "base, drawn": None}
        rows.update({f["name"]: f for f in judge.features if not f["drawn"]})
        for row_name, row in rows.items():
            zero += judge.dump(row_name, judge.runs_code_of(row), dumps[row_name])
        print(f"calls and instructions: {zero} counts of code that a scene does not use, in {len(rows)} scenes")
        check_allocations(judge, needs, linker_map, folder)
        check_stats(judge, program, folder / "callgrind_all_needs")
        check_optional_terms(judge, needs, bare, folder)
    for failure in judge.failures:
        print("FAILED", failure)
    sys.exit(1 if judge.failures else 0)


main()

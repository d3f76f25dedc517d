"""Compares the includes of each room with docs/architecture.md and with the rooms that are declared in CMake.
usage: check_rooms.py CHECKOUT ROOMS, with the lines "FOLDER: ROOM..." that evalcts_write_rooms() writes"""
import pathlib
import re
import sys

SOURCES = {".cpp", ".h", ".hpp", ".c", ".def"}
# Tests and benchmarks go with the room; examples are built as their users build them.
OTHERS = {"tests", "benchmarks", "examples", "generated", "published", "subjects", "packages", "out"}


def allowed_edges(text):
    """Returns the table of docs/architecture.md: folder -> names of the rooms that it may use."""
    rows = re.findall(r"^\| `([\w/]+)` \|.*\|([^|]*)\|$", text, re.M)
    return {folder: set(re.findall(r"`(\w+)`", uses)) for folder, uses in rows}


def declared_edges(text):
    edges = {}
    for folder, uses in re.findall(r"^([\w/]+): ?(.*)$", text, re.M):
        edges.setdefault(folder, set()).update(uses.split())
    return edges


def included_edges(root, folder, public):
    """Returns the rooms whose headers the sources of a room include, each with a place, and complaints."""
    edges, complaints = {}, []
    here = root / folder
    for file in sorted(here.rglob("*")):
        parts = file.relative_to(here).parts
        if file.suffix not in SOURCES or OTHERS & set(parts):
            continue
        for number, line in enumerate(file.read_text(errors="replace").splitlines(), 1):
            found = re.match(r'\s*#\s*include ([<"])([^">]+)[">]', line)
            if not found:
                continue
            place, header = f"{file.relative_to(root)}:{number}", found[2]
            owner = public.get(header)
            if found[1] == "<":
                if owner:
                    edges.setdefault(owner, place)
                elif header.startswith(("evalcts/", "reference/")):
                    complaints.append(f"{place}: no room has the public header {header}")
            elif owner:
                edges.setdefault(owner, place)
            else:
                places = [(start / header).resolve() for start in (file.parent, here, root)]
                exists = next((path for path in places if path.exists()), None)
                if exists and not exists.is_relative_to(here.resolve()):
                    complaints.append(f"{place}: {header} is private to another room")
    return edges, complaints


def cycle_in(edges):
    state = {}

    def visit(room, path):
        if state.get(room) == "done":
            return None
        if room in path:
            return path[path.index(room):] + [room]
        for used in sorted(edges.get(room, ())):
            if found := visit(used, path + [room]):
                return found
        state[room] = "done"
        return None

    for room in sorted(edges):
        if found := visit(room, []):
            return found
    return None


def check(root, rooms_text):
    allowed = allowed_edges((root / "docs/architecture.md").read_text())
    declared = declared_edges(rooms_text)
    name = {folder: folder.split("/")[-1] for folder in allowed}
    complaints = [f"{folder}: not in the table of docs/architecture.md" for folder in declared if folder not in allowed]
    complaints += [f"{folder}: CMake knows no such room" for folder in allowed if folder not in declared]
    public = {}
    for folder in allowed:
        for include in (root / folder).rglob("include"):
            for header in include.rglob("*"):
                if header.is_file():
                    public[str(header.relative_to(include))] = name[folder]
    known = set(name.values())
    for folder in sorted(set(allowed) & set(declared)):
        edges, wrong = included_edges(root, folder, public)
        complaints += wrong
        edges.pop(name[folder], None)
        for room, place in sorted(edges.items()):
            if room not in declared[folder]:
                complaints.append(f"{place}: {name[folder]} does not declare that it uses {room}")
        for room in sorted(declared[folder] - set(edges)):
            complaints.append(f"{folder}: declares {room}, but includes nothing of it")
        for room in sorted(declared[folder] - allowed[folder]):
            complaints.append(f"{folder}: docs/architecture.md does not allow it to use {room}")
        for room in sorted(allowed[folder] - known):
            complaints.append(f"{folder}: docs/architecture.md names {room}, which is no room")
    cycle = cycle_in({name[folder]: uses for folder, uses in allowed.items()})
    if cycle:
        complaints.append("cycle: " + " -> ".join(cycle))
    return complaints, len(allowed), sum(map(len, declared.values()))


def main():
    complaints, rooms, edges = check(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]).read_text())
    print("\n".join(complaints) if complaints else f"{rooms} rooms, {edges} edges, all of them allowed")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())

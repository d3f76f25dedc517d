"""Lists comments that are hard to understand without the code below them because they begin with a bare interrogative or
preposition, such as "Whether it is set" or "Of the map." CONTRIBUTING.md has the rule.
usage: check_comments.py CHECKOUT"""
import pathlib
import re
import subprocess
import sys

# A comment never begins with one of these, even if it has a verb: a noun phrase or a condition with "if" says the same.
INTERROGATIVES = {"What", "Whatever", "Whether", "Where", "Wherever", "Who", "Whoever", "Whose", "Whom", "How", "Which", "Those", "Of"}
# A comment may begin with one of these if a sentence follows.
PREPOSITIONS = {"For", "With", "Without", "From", "To", "In", "By", "At", "On", "Into", "Upon", "Under", "Behind", "Beside", "That"}
# "As long as it holds, ..." is a sentence; "As the functions above." is not.
AS = re.compile(r"As (?!long as |soon as |in |of |a result|if )")
# A word that may be a verb. It is better to miss a fragment than to reject a sentence, so all words in -s and -ed are verbs.
VERB = re.compile(r"\b(?:\w+s|\w+ed|have|do|can|could|may|might|must|shall|should|will|would|need|cannot|were|come|came|go|went|"
                  r"give|gave|take|took|make|made|hold|held|lie|lay|get|got|put|set|let|stay|stand|say|call|use|add|lose|lost|"
                  r"keep|kept|read|write|return|become|became|draw|mean|begin|end|fail|pass|run|leave|left|see|throw)\b")


def is_fragment(text):
    """Returns true if the text of a comment begins with a bare interrogative or preposition."""
    word = re.match(r"\w+", text)
    if not word:
        return False
    if word[0] in INTERROGATIVES or AS.match(text):
        # A question is allowed.
        return not re.match(r"[^.:;]*\?", text)
    sentence = re.split(r"[.;:](?:\s|$)", text, 1)[0]
    return word[0] in PREPOSITIONS and not VERB.search(sentence[word.end():])


def comments(text, is_c):
    """Yields the line and the text of each comment that has lines of its own; adjacent lines are one comment."""
    lines = text.splitlines()
    i = 0
    while i < len(lines):
        start = i
        if is_c and (opening := re.match(r"\s*/\*+\s*", lines[i])):
            while "*/" not in lines[i] and i + 1 < len(lines):
                i += 1
            body = " ".join(re.sub(r"^\s*\*", "", line) for line in lines[start:i + 1])[opening.end():]
            yield start + 1, " ".join(body.replace("*/", "").split())
        elif re.match(r"\s*//" if is_c else r"\s*#(?!!)", lines[i]):
            body = []
            while i < len(lines) and (found := re.match(r"\s*(?://+!?<?|#+)(.*)" if is_c else r"\s*#+(.*)", lines[i])):
                if is_c and not lines[i].lstrip().startswith("//"):
                    break
                body.append(found[1])
                i += 1
            i -= 1
            yield start + 1, " ".join(" ".join(body).split())
        i += 1


def main():
    root = pathlib.Path(sys.argv[1])
    listed = subprocess.run(["git", "-c", "safe.directory=*", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=root,
                            capture_output=True, text=True, check=True)
    found = 0
    for name in sorted(filter(None, listed.stdout.split("\0"))):
        path = pathlib.Path(name)
        is_c = path.suffix in (".cpp", ".h", ".hpp", ".c", ".def")
        is_script = path.suffix in (".py", ".sh", ".cmake") or path.name in ("CMakeLists.txt", "evalcts")
        if not (is_c or is_script) or not (root / path).is_file():
            continue
        for line, text in comments((root / path).read_text(errors="replace"), is_c):
            if is_fragment(text):
                found += 1
                print(f"{name}:{line}: {text[:100]}")
    print(f"{found} comments begin with a bare interrogative or preposition")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

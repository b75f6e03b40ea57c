"""Writes the comparisons of test_results.f90: each member of the type rsc_result with the variable of its name.

usage: results_variables.py rsc_results.f90 OUTPUT
"""
import re
import sys

with open(sys.argv[1], encoding="utf-8") as module:
    body = re.search(r"type :: rsc_result\n(.*?)\n  contains", module.read(), flags=re.S)[1]
lines = []
for line in re.sub(r"!.*", "", body).splitlines():
    kind, colons, names = line.partition("::")
    if colons and not kind.strip().startswith("character") and "int64" not in kind:
        for name in re.findall(r"(\w+)(?:\([:,]+\))?(?: = \w+)?(?:,|$)", names.strip()):
            values = f"[r%{name}]" if "real64" in kind else f"real([r%{name}], real64)"
            lines.append(f"    call same(id, '{name}', {values}, shape(r%{name}))")
assert len(lines) > 60
with open(sys.argv[2], "w", encoding="utf-8") as out:
    out.write("\n".join(lines) + "\n")

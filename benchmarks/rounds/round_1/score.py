"""score.py results.jsonl: tables with 95 % Wilson intervals."""
import json
import sys
from collections import Counter

rows = [json.loads(x) for x in open(sys.argv[1])]
VERDICTS = ("unknown", "ambiguous", "named", "clean", "none")

def rate(k, n):
    """k of n as '12/20 60 % [39, 78]' (Wilson)."""
    if n == 0: return "-"
    p, z = k / n, 1.96
    mid, half = (p + z * z / 2 / n) / (1 + z * z / n), z / (1 + z * z / n) * (p * (1 - p) / n + z * z / 4 / n / n) ** .5
    return f"{k}/{n} {100 * p:.0f} % [{100 * max(0, mid - half):.0f}, {100 * (mid + half):.0f}]"

def table(title, head, lines):
    print(f"\n**{title}**\n\n|{'|'.join(head)}|\n|{'---|' * len(head)}")
    for x in lines: print("|" + "|".join(map(str, x)) + "|")

def exact(r): return r["verdict"] == "named" and sorted(map(tuple, r["found"])) == sorted(map(tuple, r["truth"]))

def verdicts(rs):
    c = Counter(r["verdict"] for r in rs)
    return [c[v] for v in VERDICTS]

def wrong_joint(r):
    """Named, and some cause lies in a joint that is none of the truth's."""
    joints = {j for _, j in r["truth"]}
    return r["verdict"] == "named" and any(j not in joints for _, j in r["found"])

def confounded_right(r):
    options = {tuple(x) for x in r["alternatives"] + r["found"]}
    return r["verdict"] == "ambiguous" and all(tuple(t) in options for t in r["truth"]) and len(options) <= 4

ok = [r for r in rows if not r["error"]]
print(f"{len(rows)} cases, {len(rows) - len(ok)} errors, {sum(r['seconds'] for r in ok):.0f} s of engine (longest {max(r['seconds'] for r in ok):.1f} s)")
for r in rows:
    if r["error"]: print("error", r["i"], r["group"], r["kind"], r["error"])
group = {g: [r for r in ok if r["group"] == g] for g in ("library", "outside", "near", "confounded", "clean")}
lib = group["library"]
line = lambda name, rs: [name, rate(sum(map(exact, rs)), len(rs)), *verdicts(rs)]
head = ("exact set", *VERDICTS)
big, small = [r for r in lib if r["ratio"] >= 1], [r for r in lib if r["ratio"] < 1]
table("library: exact set of (effect, joint)", ("cases", *head), [line("ratio >= 1", big), line("ratio 0.5", small)]
      + [line(f"ratio {x}", [r for r in big if r["ratio"] == x]) for x in (1, 2, 4)]
      + [line(f"{m} cause(s), ratio >= 1", [r for r in big if len(r["truth"]) == m]) for m in (1, 2, 3)])
share = lambda e: rate(sum(any(x[0] == e and x in r["found"] for x in r["truth"]) and r["verdict"] == "named" for r in big if any(x[0] == e for x in r["truth"])),
                       sum(any(x[0] == e for x in r["truth"]) for r in big))
table("library, ratio >= 1: effect among the named ones, in the right joint", ("effect", "found"), [(e, share(e)) for e in sorted({x[0] for r in big for x in r["truth"]})])
for g in ("outside", "near"):
    rs = group[g]
    kinds = sorted({r["kind"] for r in rs})
    new = lambda name, x: [name, rate(sum(r["verdict"] == "unknown" for r in x), len(x)), *verdicts(x), rate(sum(map(wrong_joint, x)), len(x))]
    table(f"{g}: verdicts", ("kind", "unknown", *VERDICTS, "named, wrong joint"), [new("all", rs)] + [new(f"ratio {x}", [r for r in rs if r["ratio"] == x]) for x in (1, 2, 4)]
          + [new(k, [r for r in rs if r["kind"] == k]) for k in kinds])
con = group["confounded"]
pick = lambda name, x: [name, rate(sum(map(confounded_right, x)), len(x)), *verdicts(x)]
table("confounded: ambiguous, the true one among <= 4", ("kind", "right", *VERDICTS), [pick("all", con)] + [pick(k, [r for r in con if r["kind"] == k]) for k in sorted({r["kind"] for r in con})])
clean = group["clean"]
table("clean", ("cases", "clean", *VERDICTS), [["all", rate(sum(r["verdict"] == "clean" for r in clean), len(clean)), *verdicts(clean)]]
      + [[p, rate(sum(r["verdict"] == "clean" for r in x), len(x)), *verdicts(x)] for p in sorted({r["pattern"] for r in clean}) for x in [[r for r in clean if r["pattern"] == p]]])
cov = [(c, r) for r in ok for c in r["coverage"]]
named = [(c, r) for c, r in cov if exact(r)]
table("95 % intervals that hold the true size", ("parameter", "named exactly", "effect found right"),
      [["all", *(rate(sum(c[-1] for c, _ in x), len(x)) for x in (named, cov))]]
      + [[f"{k[0]}.{k[1]}", *(rate(sum(c[-1] for c, _ in x if tuple(c[:2]) == k), sum(tuple(c[:2]) == k for c, _ in x)) for x in (named, cov))] for k in sorted({tuple(c[:2]) for c, _ in cov})])

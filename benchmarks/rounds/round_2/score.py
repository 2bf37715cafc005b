"""Tables of a run of round 2: score.py OUT.jsonl [ANOTHER.jsonl]. Shares with 95 % Wilson intervals."""
import collections, json, math, sys

VERDICTS = ["clean", "named", "ambiguous", "unknown", "none", None]

def wilson(hits):
    n, k, z = len(hits), sum(hits), 1.96
    middle, half = k / n + z * z / (2 * n), z * math.sqrt(k / n * (1 - k / n) / n + z * z / (4 * n * n))
    return "%3d/%3d %3.0f %% [%2.0f, %3.0f]" % (k, n, 100 * k / n, 100 * (middle - half) / (1 + z * z / n), 100 * (middle + half) / (1 + z * z / n))

def table(title, rows, key, measure):
    print("\n" + title)
    groups = collections.defaultdict(list)
    for r in rows:
        for name in (str(key(r)), "~ all"):
            groups[name].append(bool(measure(r)))
    for name in sorted(groups):
        print("  %-34s %s" % (name, wilson(groups[name])))

def verdicts(title, rows, *keys):
    groups = collections.Counter()
    for r in rows:
        for name in [str(key(r)) for key in keys] + ["~ all"]:
            groups[name, r["verdict"]] += 1
    print("\n%s: verdicts\n  %-34s" % (title, "") + "".join("%10s" % (v or "error") for v in VERDICTS))
    for name in sorted({k[0] for k in groups}):
        print("  %-34s" % name + "".join("%10d" % groups[name, v] for v in VERDICTS))

def same(a, b):
    return sorted(map(str, a)) == sorted(map(str, b))

def wrongly_named(r):
    """A near miss named, and the near effect at its joint is not among the names."""
    return r["verdict"] == "named" and not any(f[:2] == r["near"] for f in r["found"])

def report(rows):
    part = lambda group: [r for r in rows if r["group"] == group]
    kind, ratio, size = (lambda r: r["kind"]), (lambda r: "ratio %g" % r["ratio"]), (lambda r: "%d causes" % len(r["truth"]))
    named, unknown = (lambda r: r["verdict"] == "named"), (lambda r: r["verdict"] == "unknown")
    exact, false = (lambda r: named(r) and r["exact"]), (lambda r: named(r) and r["false"])
    alone = lambda r: wrongly_named(r) and len(r["found"]) == 1 and r["found"][0][1] not in (None, r["near"][1])
    among = lambda r: r["verdict"] == "ambiguous" and len(r["alternatives"]) <= 4 and any(same([a], r["truth"]) for a in r["alternatives"])
    print("%d cases, %d errors, %.0f s of one process" % (len(rows), sum(r["error"] is not None for r in rows), sum(r["seconds"] for r in rows)))
    sets, half = part("library"), part("library_half")
    for key in (kind, ratio, size):
        table("Library, ratio >= 1: exact set of (effect, joint), verdict named", sets, key, exact)
    table("  exact set, whatever the verdict", sets, size, lambda r: r["exact"])
    table("  named, where no rival of no more freedom lies within chi2 25", [r for r in sets if r["rival"] is None or r["rival"] >= 25], size, exact)
    table("  named, with the leading joints of couplings, too", sets, size, lambda r: named(r) and same(r["found"], r["truth"]))
    table("  a false name", sets, size, false)
    table("Library, ratio 0.5: exact set, named", half, kind, exact)
    table("  a false name", half, size, false)
    table("Outside: unknown", part("outside"), kind, unknown)
    table("Outside: unknown", part("outside"), ratio, unknown)
    table("Outside: named, which is false", part("outside"), kind, named)
    table("Near: named, without the near effect at its joint", part("near"), kind, wrongly_named)
    table("Near: named alone with a wrong joint", part("near"), kind, alone)
    table("Confounded: ambiguous, the true one among <= 4 alternatives", part("confounded"), kind, among)
    table("Confounded: named, one of the pair", part("confounded"), kind, lambda r: named(r) and any(same(r["found"], [a]) for a in r["accept"]))
    table("Clean: clean", part("clean"), lambda r: "with covariates" if r["given"] else "without", lambda r: r["verdict"] == "clean")
    for group in ("library", "library_half", "outside", "near", "confounded", "clean"):
        verdicts(group, part(group), kind, ratio)
    inside = [("%s %s" % tuple(c[:2]), c[-1]) for r in sets + half for c in r["coverage"]]
    table("True size inside the 95 % interval, where named right", inside, lambda c: c[0], lambda c: c[1])
    for r in rows:
        if r["error"]:
            print("error", r["i"], r["kind"], r["error"])

if __name__ == "__main__":
    for path in sys.argv[1:]:
        print("=== " + path)
        with open(path) as file:
            report([json.loads(line) for line in file])

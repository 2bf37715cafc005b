"""score.py RESULTS.jsonl ...: tables with 95 % Wilson intervals."""
import collections
import json
import math
import sys

VERDICTS = ("unknown", "named", "ambiguous", "clean", "none")


def wilson(k, n, z=1.959964):
    if n == 0:
        return "    –"
    p = k / n
    c = (p + z * z / (2 * n)) / (1 + z * z / n)
    h = z / (1 + z * z / n) * math.sqrt(p * (1 - p) / n + z * z / (4 * n * n))
    return "%5.1f %% [%4.1f, %5.1f] (%d/%d)" % (100 * p, 100 * max(c - h, 0), 100 * min(c + h, 1), k, n)


def split(rows, key):
    d = collections.defaultdict(list)
    for r in rows:
        d[key(r)].append(r)
    return [(k, d[k]) for k in sorted(d, key=str)]


def line(name, rows, tests):
    print("  %-34s n=%-4d " % (name, len(rows)) + "  ".join("%s %s" % (t, wilson(sum(bool(f(r)) for r in rows), len(rows))) for t, f in tests))


def table(title, rows, tests, keys):
    print("\n## " + title)
    if not rows:
        print("  no cases")
        return
    line("all", rows, tests)
    for word, key in keys:
        print("  by " + word)
        for k, part in split(rows, key):
            line(str(k), part, tests)


RATIO = ("ratio", lambda r: r["ratio"])
KIND = ("kind", lambda r: r["kind"])
BOTH = ("kind and ratio", lambda r: "%s, %g" % (r["kind"], r["ratio"]))


def verdict(v):
    return v, lambda r: r["verdict"] == v


def pairs(r, k):
    return {tuple(v) for v in r[k] or []}


def near_right(r):
    """Alone, the near library effect, at the right joint where there is one."""
    if r["verdict"] != "named" or len(r["found"]) != 1:
        return False
    e, j = r["found"][0]
    return e in (r["near_effects"] or []) and (r["near_joint"] is None or j == r["near_joint"])


def near_wrong(r):
    """Named alone with a joint that is not the truth's (where the truth has none: with any joint)."""
    if r["verdict"] != "named" or len(r["found"]) != 1:
        return False
    j = r["found"][0][1]
    return j is not None and j != r["near_joint"]


def alone(r):
    return r["verdict"] == "named" and len(r["found"]) == 1


def conf_list(r):
    return pairs(r, "alternatives") | (pairs(r, "found") if len(r["found"]) == 1 else set())


def conf_hit(r):
    """Ambiguous, a true cause in a list of at most four (the leading one counted)."""
    c = conf_list(r)
    return r["verdict"] == "ambiguous" and len(c) <= 4 and pairs(r, "truth") <= c


def conf_all(r):
    """Ambiguous, and at least two of the acceptable ones are in that list of at most four."""
    c = conf_list(r)
    return r["verdict"] == "ambiguous" and len(c) <= 4 and len(c & pairs(r, "accept")) >= 2


def main():
    rows = []
    for p in sys.argv[1:]:
        rows += [json.loads(s) for s in open(p) if s.strip()]
    bad = [r for r in rows if r["error"]]
    rows = [r for r in rows if not r["error"]]
    print("cases %d, errors %d" % (len(rows), len(bad)))
    for r in bad:
        print("  error", r["i"], r["group"], r["kind"], r["error"])
    if not rows:
        return
    print("seconds a case: mean %.2f, greatest %.2f" % (sum(r["seconds"] for r in rows) / len(rows), max(r["seconds"] for r in rows)))
    g = collections.defaultdict(list)
    for r in rows:
        g[r["group"]].append(r)
    lib = g["library"]
    tests = [("exact and named", lambda r: r["verdict"] == "named" and r["exact"]), ("exact, any verdict", lambda r: r["exact"])]
    for title, part in (("library, ratio >= 1", [r for r in lib if r["ratio"] >= 1]), ("library, ratio 0.5", [r for r in lib if r["ratio"] < 1])):
        table(title, part, tests, [RATIO, ("number of causes", lambda r: r["causes"]), KIND, ("repeated poses", lambda r: r["repeat"]),
                                   ("whether another library cause with no more parameters fits within 4 sigma²", lambda r: any(r["rivals"].values()))])
        print("  each true cause found (effect and joint), and the size of the lists")
        c = collections.defaultdict(list)
        for r in part:
            for t in pairs(r, "truth"):
                c[t[0]].append(t in pairs(r, "found"))
        for k in sorted(c):
            print("    %-20s %s" % (k, wilson(sum(c[k]), len(c[k]))))
        line("verdicts", part, [verdict(v) for v in VERDICTS])
    vt = [verdict(v) for v in VERDICTS]
    table("outside", g["outside"], vt, [RATIO, KIND, BOTH])
    own = [r for r in g["near"] if r["planned"] == "near"]
    moved = [r for r in g["near"] if r["planned"] != "near"]
    nt = [("alone, wrong joint", near_wrong), ("alone, the near effect", near_right), ("alone", alone)] + vt
    table("near misses (own kinds)", own, nt, [RATIO, KIND, BOTH])
    table("near misses moved from outside (three library effects explain > 80 %)", moved, [("alone", alone)] + vt, [RATIO, KIND])
    table("near misses, both", own + moved, [("alone, wrong joint (own kinds)", lambda r: r["planned"] == "near" and near_wrong(r))] + vt, [RATIO])
    ct = [("true among <= 4, ambiguous", conf_hit), ("two acceptable among <= 4", conf_all), verdict("ambiguous")] + vt[:2] + vt[3:]
    conf = g["confounded"]
    table("confounded", conf, ct, [RATIO, KIND, ("number acceptable", lambda r: len(r["accept"]))])
    table("confounded without many", [r for r in conf if not r["many"]], ct, [RATIO])
    table("confounded, many", [r for r in conf if r["many"]], ct, [RATIO])
    table("clean", g["clean"], [verdict(v) for v in ("clean", "named", "ambiguous", "unknown", "none")],
          [("repeated poses", lambda r: r["repeat"]), ("sessions", lambda r: "session" in r["cov"]), ("design", lambda r: r["design"]),
           ("style", lambda r: r["style"])])
    print("\n## coverage of 95 % intervals where the cause is named right")
    for title, keep in (("verdict named, exact", lambda r: r["group"] == "library" and r["verdict"] == "named" and r["exact"]),
                        ("any, the cause among those found", lambda r: r["group"] == "library")):
        print("  " + title)
        every = [(r["ratio"], v) for r in rows if keep(r) for v in r["inside"]]
        print("    %-34s %s" % ("all", wilson(sum(v[6] for _, v in every), len(every))))
        for k in sorted({v[0] for _, v in every}):
            part = [v for _, v in every if v[0] == k]
            print("    %-34s %s" % (k, wilson(sum(v[6] for v in part), len(part))))
        for k in sorted({a for a, _ in every}):
            part = [v for a, v in every if a == k]
            print("    ratio %-28g %s" % (k, wilson(sum(v[6] for v in part), len(part))))


if __name__ == "__main__":
    main()

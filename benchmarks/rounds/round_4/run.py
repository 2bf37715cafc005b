"""run.py OUT.jsonl START STOP: the engine over cases START..STOP-1, two processes."""
import os

for _v in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[_v] = "1"
import json
import multiprocessing
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))


def cause(e):
    j = getattr(e, "joint", None)
    return [e.name, None if j is None or int(j) < 0 else int(j)]


def plain(v):
    return None if v is None else float(v)


def one(i):
    import bathyal
    import generate
    t0 = time.time()
    d = generate.case(i)
    made = time.time() - t0
    row = {k: d.get(k) for k in ("i", "group", "planned", "kind", "ratio", "causes", "truth", "params", "accept", "many", "rivals",
                                 "near_joint", "near_effects", "share", "explained_by", "design", "repeat", "sigma")}
    row.update(style=d["arm"]["style"], poses=len(d["q"]), made=made, cov=sorted(d["cov"]), verdict=None, found=[], alternatives=[],
               inside=[], error=None)
    try:
        arm = generate.engine_arm(d["arm"])
        t1 = time.time()
        rep = bathyal.diagnose(arm, bathyal.Tracked(d["q"], d["p"], covariates=d["cov"]), num_threads=1)
        row["seconds"] = time.time() - t1
        row["verdict"] = str(rep.verdict)
        row["found"] = [cause(e) for e in rep.effects]
        row["alternatives"] = [cause(e) for e in rep.ambiguous]
        row["rivals_told"] = [[cause(r) for r in e.rivals] for e in rep.effects]
        row["noise"] = plain(rep.noise)
        for e in rep.effects:
            key = "%s:%s" % tuple(cause(e))
            for name, true in (d["params"] or {}).get(key, {}).items():
                if name == "by":
                    continue
                if name not in e.parameters:
                    continue
                lo, hi = e.parameters[name].interval
                row["inside"].append([e.name, name, float(true), float(e.parameters[name].value), float(lo), float(hi),
                                      bool(lo - 1e-9 * abs(lo) <= true <= hi + 1e-9 * abs(hi))])
        T = {tuple(v) for v in row["truth"]}
        F = {tuple(v) for v in row["found"]}
        A = {tuple(v) for v in row["alternatives"]}
        row["exact"] = T == F
        row["in_found"] = T <= F
        row["in_alternatives"] = T <= (A | F)
    except Exception as x:  # told as an error of the case
        row["error"] = "%s: %s" % (type(x).__name__, x)
        row.setdefault("seconds", None)
    return row


def main():
    out, a, b = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    import generate
    b = min(b, generate.COUNT)
    with multiprocessing.get_context("spawn").Pool(2) as pool, open(out, "w") as f:
        for row in pool.imap(one, range(a, b), chunksize=1):
            f.write(json.dumps(row) + "\n")
            f.flush()


if __name__ == "__main__":
    main()

"""Run bathyal.diagnose over the cases first … last - 1 of round 2: run.py FIRST LAST OUT.jsonl [PROCESSES]"""
import os
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
import json, multiprocessing, re, sys, tempfile, time

import bathyal
import generate

def name_of(effect):
    """[effect, joint] of a named effect or cause, joint None where it belongs to the arm; of a coupling also what moves it along."""
    by = [int(re.findall(r"by joint (\d+)", effect.words)[-1]) - 1] if effect.name == "joint_coupling" else []
    return [effect.name, int(effect.joint) if effect.joint is not None and effect.joint >= 0 else None] + by

def arm_of(nominal):
    with tempfile.NamedTemporaryFile("w", suffix=".urdf") as file:
        file.write(generate.urdf(nominal))
        file.flush()
        arm = bathyal.Arm.from_urdf(file.name)
    arm.base, arm.tool = nominal["base"], nominal["tool"]
    return arm

def run(i):
    c = generate.case(i)
    out = {k: v for k, v in c.items() if k not in ("q", "p", "nominal", "covariates")}
    out.update(N=len(c["q"]), family=c["nominal"]["family"], verdict=None, found=[], alternatives=[], coverage=[], error=None)
    start = time.time()
    try:
        arm = arm_of(c["nominal"])
        report = bathyal.diagnose(arm, bathyal.Tracked(c["q"], c["p"], covariates=c["covariates"]), num_threads=1)
        out["verdict"] = report.verdict
        out["found"] = [name_of(e) for e in report.effects]
        out["alternatives"] = [name_of(a) for a in report.ambiguous]
        for e in (e for e in report.effects if name_of(e) in c["truth"]):
            for name, value in c["params"].get("%s %s" % tuple(name_of(e)[:2]), {}).items():
                if name in e.parameters and name != "by":
                    got, (low, high) = e.parameters[name].value, e.parameters[name].interval
                    if high > low:  # else a number without an interval
                        out["coverage"].append([e.name, name, value, got, low, high, bool(low <= value <= high)])
        out["leftover"] = float(report.leftover.size)
    except Exception as problem:
        out["error"] = f"{type(problem).__name__}: {problem}"[:300]
    out["seconds"] = round(time.time() - start, 2)
    true, found = {tuple(t[:2]) for t in c["truth"]}, {tuple(f[:2]) for f in out["found"]}
    out["exact"], out["some"], out["false"] = found == true, bool(found & true), bool(found - true)
    return json.dumps(out, default=float)

if __name__ == "__main__":
    first, last, path = int(sys.argv[1]), int(sys.argv[2]), sys.argv[3]
    cases = range(first, min(last, len(generate.table())))
    with multiprocessing.Pool(int(sys.argv[4]) if len(sys.argv) > 4 else 2) as pool, open(path, "w") as file:
        for line in pool.imap_unordered(run, cases, chunksize=1):
            file.write(line + "\n")
            file.flush()

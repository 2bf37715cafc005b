"""run.py [first [last [out.jsonl]]]: the engine over cases first..last-1 in two processes, JSON lines to out (stdout unless given)."""
import json
import os
import sys
import tempfile
import time
from multiprocessing import get_context

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ[name] = "1"
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import numpy as np  # noqa: E402

import generate  # noqa: E402

def pair(cause):
    joint = -1 if cause.joint is None else int(cause.joint)
    return [cause.name, joint if joint >= 0 else -1]

def coverage(case, effects):
    """[[effect, parameter, true, value, low, high, inside]] of causes named right. A wave is compared at its own sign."""
    out = []
    for (name, joint), true in zip(case["truth"], case["sizes"]):
        for e in effects:
            if pair(e) != [name, joint]: continue
            if name == "joint_coupling" and round(e.parameters["by"].value) != true["by"]: continue
            for key, x in true.items():
                if key in e.parameters and key not in ("by", "step"):
                    m = e.parameters[key]
                    out.append([name, key, float(x), float(m.value), *map(float, m.interval), bool(m.interval[0] <= x <= m.interval[1])])
    return out

def one(i):
    import bathyal
    line = {"i": i}
    try:
        c = generate.case(i)
        line |= {k: c[k] for k in ("group", "kind", "ratio", "truth", "acceptable", "sigma", "pattern", "family", "N", "greedy")}
        with tempfile.NamedTemporaryFile("w", suffix=".urdf") as f:
            f.write(c["urdf"])
            f.flush()
            arm = bathyal.Arm.from_urdf(f.name)
        arm.base = c["base"]
        start = time.time()
        report = bathyal.diagnose(arm, bathyal.Tracked(c["q"], c["p"], covariates=c["covariates"]), num_threads=1)
        found = [pair(e) for e in report.effects]
        line |= dict(seconds=round(time.time() - start, 3), verdict=report.verdict, found=found, in_truth=[f in c["truth"] for f in found],
                     alternatives=[pair(a) for a in report.ambiguous], coverage=coverage(c, report.effects),
                     noise=report.noise / c["sigma"], leftover=report.leftover.size, error=None)
    except Exception as e:
        line["error"] = f"{type(e).__name__}: {e}"
        group, kind, ratio = generate.PLAN[i]
        line = dict(group=group, kind=str(kind), ratio=ratio) | line
    return json.dumps(line, default=lambda x: x.item() if isinstance(x, np.generic) else x.tolist())

if __name__ == "__main__":
    first = int(sys.argv[1]) if len(sys.argv) > 1 else 0
    last = min(int(sys.argv[2]), len(generate.PLAN)) if len(sys.argv) > 2 else len(generate.PLAN)
    out = open(sys.argv[3], "w") if len(sys.argv) > 3 else sys.stdout
    os.nice(5)
    with get_context("spawn").Pool(2) as pool:
        for text in pool.imap(one, range(first, last)):
            print(text, file=out, flush=True)

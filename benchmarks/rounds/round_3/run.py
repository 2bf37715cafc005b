"""run.py FIRST LAST OUT.jsonl [PROCESSES]: the program under test over cases FIRST <= i < LAST; one JSON line a case."""
import os
os.environ['OPENBLAS_NUM_THREADS'] = '1'
os.environ['OMP_NUM_THREADS'] = '1'
import json
import multiprocessing as mp
import re
import sys
import tempfile
import time
import traceback
from multiprocessing.connection import wait

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import generate  # noqa: E402

LIMIT = 600  # s a case


def plain(x):
    if hasattr(x, 'tolist'):
        return x.tolist()
    return str(x)


def cause(e):
    """[name, joint (0-based, -1 none), by (0-based) or None]"""
    j = e.joint
    by = None
    if e.name == 'joint_coupling':
        got = re.search(r'by joint (\d+)', e.words)
        by = int(got.group(1)) - 1 if got else None
    return [e.name, -1 if j is None else int(j), by]


def parameters(e):
    out = {}
    try:
        for k, v in dict(e.parameters).items():
            iv = getattr(v, 'interval', None)
            out[k] = [float(v.value), None if iv is None else float(iv[0]), None if iv is None else float(iv[1])]
    except Exception as x:
        out['error'] = repr(x)
    return out


def one(i):
    import bathyal
    c = generate.case(i)
    ctx = c.pop('_ctx')
    line = dict(i=i, group=c['group'], planned=c['planned'], kind=c['kind'], ratio=c['ratio'], size=c['size'], many=c['many'], share3=c['share3'],
                explained_by=c['explained_by'], family=c['family'], style=c['style'], rows=len(c['q']), sigma=c['sigma'], info=c['info'],
                truth=[[t[0], t[1], t[2].get('by')] for t in c['truth']], parameters=[t[2] for t in c['truth']], rivals=c['rivals'],
                verdict=None, found=[], found_parameters=[], alternatives=[], words=[], leftover=None, gain=None, seconds=None, error=None)
    begin = time.time()
    try:
        with tempfile.TemporaryDirectory() as d:
            f = os.path.join(d, 'arm.urdf')
            with open(f, 'w') as o:
                o.write(generate.urdf(c['nominal']))
            arm = bathyal.Arm.from_urdf(f)
        arm.base = c['nominal'].base
        arm.tool = generate.frame(p=c['nominal'].tool)
        cov = {k: v for k, v in c['covariates'].items()}
        data = bathyal.Tracked(c['q'], c['p'], covariates=cov) if cov else bathyal.Tracked(c['q'], c['p'])
        begin = time.time()
        r = bathyal.diagnose(arm, data, num_threads=1)
        line['seconds'] = time.time() - begin
        line['verdict'] = r.verdict
        line['found'] = [cause(e) for e in r.effects]
        line['found_parameters'] = [parameters(e) for e in r.effects]
        line['alternatives'] = [cause(e) for e in r.ambiguous]
        line['words'] = [e.words for e in r.effects]
        line['leftover'] = float(r.leftover.size)
        line['gain'] = None if r.gain is None else float(r.gain)
    except Exception:
        line['seconds'] = time.time() - begin
        line['error'] = traceback.format_exc(limit=-3)
    return line


def worker(pipe):
    while True:
        i = pipe.recv()
        if i is None:
            return
        try:
            line = one(i)
        except Exception:
            line = lost(i, 'case: ' + traceback.format_exc(limit=-3))
        pipe.send(line)


class Hand:
    def __init__(self):
        self.pipe, other = mp.Pipe()
        self.process = mp.Process(target=worker, args=(other,), daemon=True)
        self.process.start()
        other.close()
        self.i = None

    def give(self, i):
        self.i, self.since = i, time.time()
        self.pipe.send(i)


def lost(i, why):
    e = generate.table()[i]
    return dict(i=i, group=e['group'], planned=e['group'], kind=e['kind'], ratio=e['ratio'], error=why)


def main():
    first, last, out = int(sys.argv[1]), int(sys.argv[2]), sys.argv[3]
    count = int(sys.argv[4]) if len(sys.argv) > 4 else 2
    todo = list(range(first, min(last, len(generate.table()))))[::-1]
    hands = []
    begin = time.time()
    with open(out, 'w') as f:
        def note(line):
            f.write(json.dumps(line, default=plain) + '\n')
            f.flush()

        while todo or hands:
            while todo and len(hands) < count:
                h = Hand()
                h.give(todo.pop())
                hands.append(h)
            ready = wait([h.pipe for h in hands] + [h.process.sentinel for h in hands], timeout=5)
            for h in list(hands):
                if h.pipe in ready or h.process.sentinel in ready:
                    try:
                        note(h.pipe.recv())
                        if todo:
                            h.give(todo.pop())
                        else:
                            h.pipe.send(None)
                            h.process.join()
                            hands.remove(h)
                    except (EOFError, OSError):
                        h.process.join()
                        note(lost(h.i, f'worker died, exit code {h.process.exitcode}'))
                        hands.remove(h)
                elif time.time() - h.since > LIMIT:
                    h.process.kill()
                    h.process.join()
                    note(lost(h.i, f'more than {LIMIT} s'))
                    hands.remove(h)
    print(f'{time.time() - begin:.0f} s')


if __name__ == '__main__':
    mp.set_start_method('spawn')
    main()

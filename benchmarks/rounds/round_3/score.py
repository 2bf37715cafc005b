"""score.py OUT.jsonl ...: Markdown tables with 95 % Wilson intervals."""
import collections
import json
import math
import sys

NO_JOINT = {'payload', 'base_shift', 'base_compliance', 'tool_slip', 'tool_change', 'thermal', 'drift', 'clock_shift', 'outliers', 'range_noise',
            'quantisation'}
VERDICTS = ['unknown', 'named', 'ambiguous', 'clean', 'other']


def share(k, n):
    if n == 0:
        return '–'
    z, p = 1.959964, k / n
    m = (p + z * z / (2 * n)) / (1 + z * z / n)
    h = z / (1 + z * z / n) * math.sqrt(p * (1 - p) / n + z * z / (4 * n * n))
    return f'{100 * p:.1f} % [{100 * max(0, m - h):.1f}, {100 * min(1, m + h):.1f}] ({k}/{n})'


def key(x):
    return (x[0], -1 if x[0] in NO_JOINT else x[1])


def full(x):
    return key(x) + (x[2] if len(x) > 2 and x[0] == 'joint_coupling' else None,)


def verdict(r):
    v = r.get('verdict')
    return v if v in VERDICTS else 'other'


def exact(r):
    t, f = [key(x) for x in r['truth']], [key(x) for x in r.get('found') or []]
    return sorted(t) == sorted(f)


def split(rows, f):
    out = collections.OrderedDict()
    for k in sorted({f(r) for r in rows}, key=str):
        out[k] = [r for r in rows if f(r) == k]
    return out


def table(head, lines):
    print('| ' + ' | '.join(head) + ' |')
    print('|' + '---|' * len(head))
    for l in lines:
        print('| ' + ' | '.join(str(x) for x in l) + ' |')
    print()


def parts(rows):
    yield 'all', rows
    for k, v in split(rows, lambda r: r['ratio']).items():
        yield f'ratio {k:g}', v
    for k, v in split(rows, lambda r: r['kind']).items():
        yield k, v


def verdicts(rows, order):
    c = collections.Counter(verdict(r) for r in rows)
    return [share(c[v], len(rows)) for v in order]


def library(rows, title):
    if not rows:
        return
    print(f'## {title}\n')

    def line(name, v):
        ok = [r for r in v if exact(r)]
        return [name, share(sum(verdict(r) == 'named' for r in ok), len(v)), share(len(ok), len(v)),
                share(sum({key(x) for x in r['truth']} <= {key(x) for x in r.get('found') or []} for r in v), len(v))] + verdicts(v, VERDICTS[:4])
    lines = [line(n, v) for n, v in parts(rows)]
    lines += [line(f'{k} causes', v) for k, v in split(rows, lambda r: len(r['truth'])).items()]
    for k, v in split(rows, lambda r: (len(r['truth']), r['ratio'])).items():
        lines.append(line(f'{k[0]} causes, ratio {k[1]:g}', v))
    table(['library', 'named and exact set', 'exact set, any verdict', 'all true ones among the found', 'unknown', 'named', 'ambiguous', 'clean'], lines)
    missed = collections.Counter()
    for r in rows:
        t, f = collections.Counter(map(key, r['truth'])), collections.Counter(key(x) for x in r.get('found') or [])
        for x in (t - f):
            missed['missed ' + x[0]] += 1
        for x in (f - t):
            missed['extra ' + x[0]] += 1
    print(', '.join(f'{k}: {v}' for k, v in missed.most_common()) + '\n')


def outside(rows):
    if not rows:
        return
    print('## Outside\n')
    table(['outside'] + VERDICTS[:4], [[n] + verdicts(v, VERDICTS[:4]) for n, v in parts(rows)])
    table(['outside, kind and ratio'] + VERDICTS[:4],
          [[f'{k[0]} {k[1]:g}'] + verdicts(v, VERDICTS[:4]) for k, v in split(rows, lambda r: (r['kind'], r['ratio'])).items()])
    bins = split([r for r in rows if r.get('share3') is not None], lambda r: min(3, int(r['share3'] / .2)))
    table(['outside, share that three library effects explain'] + VERDICTS[:4],
          [[f'{20 * k}–{20 * k + 20} %'] + verdicts(v, VERDICTS[:4]) for k, v in bins.items()])


def wrong_joint(r):
    """Named, with a joint that has no part in the true cause."""
    true = set((r.get('info') or {}).get('joints') or [])
    return verdict(r) == 'named' and any(key(x)[1] >= 0 and key(x)[1] not in true for x in r.get('found') or [])


def near(rows):
    if not rows:
        return
    print('## Near misses (those moved from outside among them)\n')
    table(['near', 'named alone with a wrong joint', 'of these with one effect only'] + VERDICTS[:4],
          [[n, share(sum(map(wrong_joint, v)), len(v)), share(sum(wrong_joint(r) and len(r['found']) == 1 for r in v), len(v))] + verdicts(v, VERDICTS[:4])
           for n, v in parts(rows)])


def options(r):
    out = []
    for x in (r.get('alternatives') or []) + (r.get('found') or [])[:1]:
        if full(x) not in out:
            out.append(full(x))
    return out


def among(r):
    o = options(r)
    return verdict(r) == 'ambiguous' and len(o) <= 4 and all(full(x) in o for x in r['truth'])


def confounded(rows):
    if not rows:
        return
    for title, rr in (('Confounded, all', rows), ('Confounded, without `many`', [r for r in rows if not r.get('many')])):
        print(f'## {title}\n')
        table(['confounded', 'ambiguous, true ones among <= 4', 'ambiguous', 'ambiguous, true ones among any number', 'true set leading, any verdict'] + VERDICTS[:4],
              [[n, share(sum(map(among, v)), len(v)), share(sum(verdict(r) == 'ambiguous' for r in v), len(v)),
                share(sum(verdict(r) == 'ambiguous' and all(full(x) in options(r) for x in r['truth']) for r in v), len(v)),
                share(sum(map(exact, v)), len(v))] + verdicts(v, VERDICTS[:4]) for n, v in parts(rr)])


def clean(rows):
    if not rows:
        return
    print('## Clean\n')
    table(['clean'] + ['clean', 'named', 'ambiguous', 'unknown'],
          [[n] + verdicts(v, ['clean', 'named', 'ambiguous', 'unknown']) for n, v in list(parts(rows)) + list(split(rows, lambda r: 'style ' + r.get('style', '?')).items())])


UNSIGNED = {'compliance', 'compliance_x', 'compliance_y', 'flexibility', 'rate'}


def pairs(effect, true, found):
    """(true, value, low, high) of the parameters that can be compared."""
    for name, (value, low, high) in found.items():
        base = name[:-2] if effect == 'tool_change' and name.endswith('_2') else name
        t = true.get(base)
        unsigned = base in UNSIGNED
        if effect == 'base_compliance' and base in ('compliance_x', 'compliance_y'):
            t = true.get('compliance')
        if effect == 'payload' and base.startswith('mass_compliance'):
            t, unsigned = true.get('payload'), True
        if t is None or base in ('by', 'row', 'rows', 'moment') or low is None or not all(map(math.isfinite, (low, high))):
            continue
        if unsigned and value < 0:
            value, low, high = -value, -high, -low
        yield base.rstrip('0123456789_') if effect == 'payload' else base, t, value, low, high


def coverage(rows):
    inside = collections.defaultdict(list)
    for r in rows:
        if not r.get('truth') or not exact(r) or verdict(r) != 'named':
            continue
        for t, true in zip(r['truth'], r['parameters']):
            for x, p in zip(r['found'], r['found_parameters']):
                if key(x) == key(t) and 'error' not in p:
                    for name, tv, v, lo, hi in pairs(t[0], true, p):
                        inside[t[0], name].append((lo <= tv <= hi, r['ratio']))
    if not inside:
        return
    print('## Intervals: true value inside the 95 % interval (named and exact set)\n')
    every = [x for v in inside.values() for x in v]
    lines = [['all', '', share(sum(a for a, _ in every), len(every))]]
    for q in sorted({b for _, b in every}):
        s = [a for a, b in every if b == q]
        lines.append([f'ratio {q:g}', '', share(sum(s), len(s))])
    effects = sorted({k[0] for k in inside})
    for e in effects:
        s = [a for k, v in inside.items() if k[0] == e for a, _ in v]
        lines.append([e, 'all', share(sum(s), len(s))])
        names = sorted(k[1] for k in inside if k[0] == e)
        if len(names) > 1:
            for n in names:
                s = [a for a, _ in inside[e, n]]
                lines.append(['', n, share(sum(s), len(s))])
    table(['effect', 'parameter', 'inside'], lines)


def main():
    rows = [json.loads(l) for f in sys.argv[1:] for l in open(f)]
    for r in rows:
        r.setdefault('truth', [])
        r.setdefault('found', [])
        r.setdefault('parameters', [])
    errors = [r for r in rows if r.get('error')]
    s = [r['seconds'] for r in rows if r.get('seconds') is not None]
    print(f'{len(rows)} cases, {len(errors)} errors; seconds a case: mean {sum(s) / max(1, len(s)):.2f}, largest {max(s, default=0):.1f}\n')
    for r in errors:
        last = (r['error'].strip().splitlines() or ['?'])[-1]
        print(f"- error in case {r['i']} ({r.get('group')}, {r.get('kind')}): {last}")
    g = lambda name: [r for r in rows if r.get('group') == name]
    lib = g('library')
    # cases that a dead worker lost have no truth: they count as wrong
    for r in lib + g('confounded'):
        if not r['truth']:
            r['truth'] = [['lost', -1, None]]
    library([r for r in lib if r['ratio'] >= 1], 'Library, ratio 1 and more')
    library([r for r in lib if r['ratio'] < 1], 'Library, ratio 0.5')
    outside(g('outside'))
    near(g('near'))
    confounded(g('confounded'))
    clean(g('clean'))
    coverage(lib)
    table(['verdicts'] + VERDICTS, [[n] + verdicts(g(n), VERDICTS) for n in ('library', 'outside', 'near', 'confounded', 'clean')])


if __name__ == '__main__':
    main()

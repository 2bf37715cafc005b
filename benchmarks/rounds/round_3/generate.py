"""Hidden cases, round 3. case(i) -> dict; table() -> the plan. Physics only: nothing of the program under test."""
import os
os.environ.setdefault('OPENBLAS_NUM_THREADS', '1')
import numpy as np

SEED = 330717
G = 9.80665


# ---------------------------------------------------------------- small geometry
def cross(a, b):
    return np.stack([a[..., 1] * b[..., 2] - a[..., 2] * b[..., 1],
                     a[..., 2] * b[..., 0] - a[..., 0] * b[..., 2],
                     a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]], -1)


def dot(a, b):
    return np.einsum('...i,...i->...', a, b)


def unit(a):
    return a / np.linalg.norm(a, axis=-1, keepdims=True)


def expm(w):
    """Rotation matrices of rotation vectors (..., 3)."""
    w = np.asarray(w, float)
    th = np.linalg.norm(w, axis=-1)[..., None, None]
    K = np.zeros(w.shape[:-1] + (3, 3))
    K[..., 0, 1], K[..., 0, 2], K[..., 1, 2] = -w[..., 2], w[..., 1], -w[..., 0]
    K[..., 1, 0], K[..., 2, 0], K[..., 2, 1] = w[..., 2], -w[..., 1], w[..., 0]
    t2 = th * th
    small = th < 1e-4
    safe = np.where(small, 1.0, th)
    a = np.where(small, 1 - t2 / 6, np.sin(safe) / safe)
    b = np.where(small, 0.5 - t2 / 24, (1 - np.cos(safe)) / (safe * safe))
    return np.eye(3) + a * K + b * (K @ K)


def rpy(r):
    cr, cp, cy = np.cos(r)
    sr, sp, sy = np.sin(r)
    return (np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]]) @ np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
            @ np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]]))


def frame(R=np.eye(3), p=(0, 0, 0)):
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = R, p
    return T


# ---------------------------------------------------------------- arms
class Arm:
    """types 'r'/'p'; R0, p0: placement of each joint in the link before it; axis; masses and centres in link frames."""

    def copy(self):
        a = Arm()
        a.__dict__.update({k: (v.copy() if isinstance(v, np.ndarray) else v) for k, v in self.__dict__.items()})
        return a

    @property
    def n(self):
        return len(self.types)


def make_arm(rng, family, L):
    y, z, x = (0, 1, 0), (0, 0, 1), (1, 0, 0)
    u = lambda a, b: rng.uniform(a, b) * L
    pi = np.pi
    if family == 'ur':
        J = [('r', (0, 0, u(.1, .2)), z, 2.9), ('r', (0, u(.06, .13), u(0, .04)), y, 1.6), ('r', (0, -u(.05, .1), u(.35, .45)), y, 2.2),
             ('r', (0, u(0, .02), u(.3, .42)), y, 2.2), ('r', (0, u(.06, .1), 0), z, 2.5), ('r', (0, 0, u(.06, .1)), y, 2.9)]
    elif family == 'puma':
        J = [('r', (0, 0, u(.2, .3)), z, 2.8), ('r', (u(.02, .12), 0, u(.05, .1)), y, 1.4), ('r', (0, u(-.05, .05), u(.35, .45)), y, 1.7),
             ('r', (u(.02, .06), 0, u(.15, .25)), z, 2.9), ('r', (0, 0, u(.15, .22)), y, 1.9), ('r', (0, 0, u(.05, .09)), z, 2.9)]
    elif family == 'seven':
        J = [('r', (0, 0, u(.1, .2)), z, 2.7), ('r', (0, 0, u(.12, .18)), y, 1.8), ('r', (0, u(-.02, .02), u(.18, .22)), z, 2.7),
             ('r', (u(0, .05), 0, u(.18, .24)), y, 2.0), ('r', (-u(0, .05), 0, u(.18, .22)), z, 2.7), ('r', (0, 0, u(.16, .2)), y, 1.8),
             ('r', (u(0, .06), 0, u(.06, .1)), z, 2.7)]
    elif family == 'scara':
        J = [('r', (0, 0, u(.2, .4)), z, 2.4), ('r', (u(.45, .55), 0, u(.02, .08)), z, 2.3), ('p', (u(.38, .45), 0, 0), (0, 0, -1), .16 * L),
             ('r', (0, 0, -u(.05, .1)), z, 2.9)]
    elif family == 'gantry':
        J = [('p', (0, 0, u(.5, .7)), x, .5 * L), ('p', (0, 0, u(.03, .08)), y, .4 * L), ('p', (u(.03, .08), 0, 0), (0, 0, -1), .2 * L),
             ('r', (0, 0, -u(.15, .2)), z, 2.8), ('r', (u(.02, .05), 0, -u(.08, .14)), y, 1.7)]
        if rng.random() < .6:
            J.append(('r', (0, u(.02, .05), -u(.08, .14)), x, 1.7))
    elif family == 'hyd5':
        J = [('r', (0, 0, u(.1, .2)), z, 2.0), ('r', (u(.03, .1), 0, u(.05, .1)), y, 1.2), ('r', (u(-.03, .03), 0, u(.3, .4)), y, 1.4),
             ('r', (0, u(-.02, .02), u(.35, .5)), y, 1.5), ('r', (0, 0, u(.06, .12)), z, 2.8)]
    elif family == 'rov4':
        J = [('r', (0, 0, u(.08, .15)), z, 2.2), ('r', (u(.04, .1), 0, u(.02, .06)), y, 1.3), ('r', (0, 0, u(.35, .45)), y, 1.7),
             ('r', (0, u(-.02, .02), u(.3, .4)), y, 1.7)]
    else:  # 'hyd6': yaw, three pitches, yaw, roll
        J = [('r', (0, 0, u(.08, .18)), z, 2.0), ('r', (u(.03, .1), 0, u(.03, .08)), y, 1.2), ('r', (0, 0, u(.3, .4)), y, 1.6),
             ('r', (0, 0, u(.3, .45)), y, 1.6), ('r', (u(.02, .05), 0, u(.05, .1)), x, 1.5), ('r', (0, 0, u(.08, .12)), z, 2.8)]
    a = Arm()
    n = len(J)
    a.family, a.L = family, L
    a.types = [j[0] for j in J]
    a.p0 = np.round(np.array([j[1] for j in J], float), 4)
    a.axis = np.array([j[2] for j in J], float)
    for i in range(1, n):
        if a.types[i] == 'r' and rng.random() < .3:
            a.axis[i] *= -1
    skew = family in ('gantry', 'scara') or rng.random() < .35
    a.r0 = np.zeros((n, 3))
    if skew:
        a.r0 = np.round(np.radians(rng.uniform(-3, 3, (n, 3))), 4)
    for i in range(n):                       # a joint's zero lies anywhere
        if a.types[i] == 'r' and rng.random() < .3:
            ax = int(np.argmax(np.abs(a.axis[i])))
            a.r0[i, ax] += np.round(rng.uniform(-.5, .5), 3)
    a.R0 = np.array([rpy(r) for r in a.r0])
    half = np.array([j[3] for j in J], float) * rng.uniform(.8, 1.05, n)
    mid = np.where(np.array([t == 'r' for t in a.types]), rng.uniform(-.15, .15, n), 0) * half
    if family in ('puma', 'seven', 'ur', 'hyd5', 'rov4', 'hyd6') and rng.random() < .6:  # elbow up
        k = 3 if family == 'seven' else 2
        mid[k] = rng.choice([-1, 1]) * half[k] * .5
        half[k] *= .75
    a.lower, a.upper = np.round(mid - half, 3), np.round(mid + half, 3)
    ml = 25 * L ** 2.2 * rng.uniform(.5, 1.6)
    a.mass = np.round(ml * np.linspace(1, .15, n) * rng.uniform(.6, 1.4, n), 3)
    a.com = np.zeros((n, 3))
    tool = np.array([rng.uniform(.03, .1) * L * rng.choice([-1, 1]), rng.uniform(.02, .08) * L * rng.choice([-1, 1]), rng.uniform(.06, .16) * L])
    if family in ('scara', 'gantry'):
        tool[2] *= -1
    a.tool = np.round(tool, 4)
    for i in range(n):
        nxt = a.p0[i + 1] if i + 1 < n else a.tool * .5
        a.com[i] = nxt * rng.uniform(.25, .65) + rng.normal(0, .012 * L, 3)
    a.com = np.round(a.com, 4)
    a.g = np.array([0, 0, -G])
    a.upright = True
    if family not in ('gantry', 'scara') and rng.random() < .15:
        a.upright = False
        w = rng.integers(3)
        a.g = [np.array([0, 0, G]), np.array([G, 0, 0]), G * unit(np.array([rng.normal(0, .2), .6, -.8]))][w]
    if family == 'gantry' and rng.random() < .4:  # a gantry set up askew: gravity leans in its frame, known
        a.upright = False
        a.g = G * unit(np.array([rng.uniform(-.2, .2), rng.uniform(-.2, .2), -1]))
    return a


def place(rng, a, far=(1.3, 2.6)):
    """world (instrument) from base."""
    up = -unit(a.g)
    v = np.cross(up, [0, 0, 1.])                   # base so turned that gravity is down in the room
    s = np.linalg.norm(v)
    R = np.eye(3) if s < 1e-9 else expm(v / s * np.arctan2(s, up[2]))
    if s < 1e-9 and up[2] < 0:
        R = np.diag([1., -1, -1])
    Rz = expm(np.array([0, 0, rng.uniform(-np.pi, np.pi)]))
    d = rng.uniform(*far) * a.L
    az = rng.uniform(-np.pi, np.pi)
    a.base = np.round(frame(Rz @ R, (d * np.cos(az), d * np.sin(az), rng.uniform(-.6, .2) * a.L)), 12)


def disturb(rng, nominal, long, ang):
    """The real arm: joints, base and tool placed a little elsewhere."""
    a = nominal.copy()
    n = a.n
    a.p0 = a.p0 + rng.normal(0, long, (n, 3))
    a.R0 = a.R0 @ expm(rng.normal(0, ang, (n, 3)))
    a.tool = a.tool + rng.normal(0, long, 3)
    a.base = a.base @ frame(expm(rng.normal(0, ang, 3)), rng.normal(0, long, 3))
    return a


def chain(a, q, m=None, s=1.0):
    """Forward kinematics of rows q with small modifications m (times s)."""
    m = m or {}
    N, n = q.shape
    dq = m.get('dq')
    qq = q if dq is None else q + s * dq
    R = np.broadcast_to(a.base[:3, :3], (N, 3, 3))
    p = np.broadcast_to(a.base[:3, 3], (N, 3))
    if 'base' in m:                            # (N, 6) shift and turn in the base's frame
        p = p + np.einsum('ij,nj->ni', a.base[:3, :3], s * m['base'][:, :3])
        R = R @ expm(s * m['base'][:, 3:])
    grow = 1 + s * m['grow'][:, None] if 'grow' in m else None
    Z, O, Rl, P = [], [], [], []
    for i in range(n):
        r0 = np.broadcast_to(a.p0[i], (N, 3))
        if grow is not None:
            r0 = r0 * grow
        Ri = a.R0[i]
        if 'link' in m and i - 1 in m['link']:  # bent link before joint i: twist at its end, link frame
            w = s * m['link'][i - 1]
            r0 = r0 + w[:, :3]
            Ri = expm(w[:, 3:]) @ Ri
        p = p + np.einsum('nij,nj->ni', R, r0)
        R = R @ Ri
        z = R @ a.axis[i]
        Z.append(z)
        O.append(p)
        if a.types[i] == 'r':
            R = R @ expm(qq[:, i, None] * a.axis[i])
        else:
            p = p + z * qq[:, i, None]
        Rl.append(R)
        P.append(p)
    t = np.broadcast_to(a.tool, (N, 3))
    if 'tool' in m:
        t = t + s * m['tool']
    tip = p + np.einsum('nij,nj->ni', R, t)
    if 'world' in m:
        tip = tip + s * m['world']
    c = type('C', (), {})()
    c.z, c.o, c.R, c.P, c.tip = np.stack(Z, 1), np.stack(O, 1), np.stack(Rl, 1), np.stack(P, 1), tip
    return c


def loads(a, ch, g=None):
    """Gravity torque at each joint (force along it when sliding); sums beyond."""
    gw = a.base[:3, :3] @ a.g if g is None else g           # (3,) or (N, 3), world
    com = ch.P + np.einsum('nkij,kj->nki', ch.R, a.com)
    W = np.cumsum(a.mass[::-1])[::-1]
    S = np.cumsum((a.mass[:, None] * com)[:, ::-1], 1)[:, ::-1]
    gw = np.broadcast_to(gw, ch.tip.shape)[:, None]
    tau = dot(ch.z, cross(S - W[:, None] * ch.o, np.broadcast_to(gw, S.shape)))
    for i, t in enumerate(a.types):
        if t == 'p':
            tau[:, i] = dot(ch.z[:, i], gw[:, 0]) * W[i]
    return tau, W, S, com


def jac(a, ch):
    """(N, n, 3) tip by joints."""
    J = cross(ch.z, ch.tip[:, None] - ch.o)
    for i, t in enumerate(a.types):
        if t == 'p':
            J[:, i] = ch.z[:, i]
    return J


def geometry(a, ch):
    """Orthonormal basis of all that geometry (base, joint placements, tool) can move, (3N, r)."""
    N, n = ch.o.shape[:2]
    cols = []
    Rb = a.base[:3, :3]
    Rprev = [np.broadcast_to(Rb, (N, 3, 3))] + [ch.R[:, i] for i in range(n)]
    for i in range(n):
        R = Rprev[i]
        for k in range(3):
            e = R[:, :, k]
            cols.append(e)
            cols.append(cross(e, ch.tip - ch.o[:, i]))
    for k in range(3):
        cols.append(ch.R[:, -1, :, k])
    A = np.stack(cols, -1).reshape(3 * N, -1)
    A = A / np.linalg.norm(A, axis=0)
    U, s, _ = np.linalg.svd(A, full_matrices=False)
    return U[:, s > 1e-8 * s[0]]


def beside(U, x):
    return x - U @ (U.T @ x)


# ---------------------------------------------------------------- poses
def rows(rng, a, style, N):
    """q (N, n), dq/dt or None, t."""
    lo, hi = a.lower, a.upper
    mid, half = (lo + hi) / 2, (hi - lo) / 2 * .97
    n = a.n
    v = None
    if style == 'uniform':
        q = mid + half * rng.uniform(-1, 1, (N, n))
    elif style == 'cluster':
        k = int(rng.integers(7, 14))
        c = rng.uniform(-.8, .8, (k, n))
        q = mid + half * np.clip(c[rng.integers(k, size=N)] + rng.normal(0, .22, (N, n)), -1, 1)
    elif style == 'grid':
        lv = rng.integers(4, 7, n)
        q = np.empty((N, n))
        for j in range(n):
            q[:, j] = np.linspace(-.9, .9, lv[j])[rng.integers(lv[j], size=N)]
        q = mid + half * (q + rng.normal(0, .01, (N, n)) * (rng.random() < .6))
        if len(np.unique(q, axis=0)) < N:
            q = q + half * rng.normal(0, .004, (N, n))
    elif style == 'walk':
        q = rng.uniform(-1, 1, (N, n))
        for r in range(N - 1):
            k = r + 1 + np.argmin(((q[r + 1:] - q[r]) ** 2).sum(1))
            q[[r + 1, k]] = q[[k, r + 1]]
        q = mid + half * q
    elif style == 'repeat':
        M = max(55, N // int(rng.integers(2, 5)))
        q = mid + half * rng.uniform(-1, 1, (M, n))
        rep = rng.permutation(np.concatenate([np.arange(M), rng.integers(M, size=max(0, N - M))]))
        q = q[rep]
    elif style == 'traj':
        dt = rng.uniform(.2, .45)
        t = np.arange(N) * dt
        q, v = np.zeros((N, n)), np.zeros((N, n))
        A = rng.uniform(.3, 1, (n, 3))
        A = A / A.sum(1, keepdims=True)
        for j in range(n):
            for h in range(3):
                w = 2 * np.pi / rng.uniform(7, 35)
                ph = rng.uniform(0, 2 * np.pi)
                q[:, j] += half[j] * A[j, h] * np.sin(w * t + ph)
                v[:, j] += half[j] * A[j, h] * w * np.cos(w * t + ph)
        q = q + mid
        return q, v, t
    t = np.cumsum(rng.uniform(8, 30, len(q)))
    return q, None, t - t[0]


def steps(rng, a, q):
    """Direction of approach of each joint."""
    if rng.random() < .6:
        return rng.choice([-1.0, 1.0], q.shape)
    d = np.sign(np.diff(q, axis=0, prepend=q[:1] - rng.normal(0, .1, (1, a.n))))
    d[d == 0] = rng.choice([-1.0, 1.0], (d == 0).sum())
    return d


# ---------------------------------------------------------------- library effects
TURN = lambda c: [j for j in range(c.a.n) if c.a.types[j] == 'r']


def bend(c, i, flat=None):
    """Unit twist (N, 6) in link frame at the end of link i, flexibility 1, under the weight beyond it."""
    a, ch = c.a, c.ch
    e_l = a.p0[i + 1]
    Ln = np.linalg.norm(e_l)
    e = np.einsum('nij,j->ni', ch.R[:, i], e_l / Ln)
    F = c.W[i + 1] * np.broadcast_to(c.gw, e.shape)
    M = cross(c.S[:, i + 1] - c.W[i + 1] * ch.o[:, i + 1], np.broadcast_to(c.gw, e.shape))
    F = F - e * dot(e, F)[:, None]
    M = M - e * dot(e, M)[:, None]
    if flat is not None:                        # bends along `flat` (link frame) only
        f = np.einsum('nij,j->ni', ch.R[:, i], flat)
        F = f * dot(f, F)[:, None]
        b = cross(e, f)
        M = b * dot(b, M)[:, None]
    d = F * Ln ** 3 / 3 + cross(M, e) * Ln ** 2 / 2
    th = cross(e, F) * Ln ** 2 / 2 + M * Ln
    Rt = np.swapaxes(ch.R[:, i], 1, 2)
    return np.concatenate([np.einsum('nij,nj->ni', Rt, d), np.einsum('nij,nj->ni', Rt, th)], 1)


def tau_tool(c):
    t = dot(c.ch.z, cross(c.ch.tip[:, None] - c.ch.o, np.broadcast_to(c.gw, c.ch.o.shape)))
    t[:, [j for j in range(c.a.n) if c.a.types[j] == 'p']] = 0
    return t


def base_moment(c):
    """(N, 6): turn about base x and y by the moment of all weight about the base."""
    a = c.a
    Rb = a.base[:3, :3]
    r = (c.S[:, 0] - c.W[0] * a.base[:3, 3]) @ Rb
    M = cross(r, np.broadcast_to(a.g, r.shape))
    return np.concatenate([np.zeros((len(r), 3)), M[:, :2], np.zeros((len(r), 1))], 1)


def one(c, j, x):
    d = np.zeros_like(c.q)
    d[:, j] = x
    return {'dq': d}


def span_w(c, j):
    return 1.0 if c.a.types[j] == 'r' else 2 * np.pi / (1.5 * (c.a.upper[j] - c.a.lower[j]))


def movable(c, j):
    """Whether joint j moves the tip and is moved."""
    return np.ptp(c.q[:, j]) > 1e-3 and np.linalg.norm(c.J[:, j], axis=1).mean() > (.02 * c.a.L if c.a.types[j] == 'r' else .1)


def library(c, name, rng):
    """Unit modifications of one library effect, and its truth [effect, joint, parameters at size 1]."""
    a, q = c.a, c.q
    ok = [j for j in range(a.n) if movable(c, j)]
    tn = [j for j in ok if a.types[j] == 'r']
    j = int(rng.choice(tn))
    if name == 'joint_harmonic':
        k = float(rng.choice([1, 2, 2, 3, 4, 5])) if rng.random() < .6 else float(np.round(rng.uniform(1.2, 6), 2))
        ph = rng.uniform(0, 2 * np.pi)
        return one(c, j, np.cos(k * q[:, j] - ph)), [name, j, {'order': k, 'cos': float(np.cos(ph)), 'sin': float(np.sin(ph))}]
    if name == 'joint_map':
        j = int(rng.choice(ok))
        K = int(rng.integers(2, 4))
        w = span_w(c, j)
        x = sum(rng.normal(0, 1 / i ** .5) * np.cos(i * w * q[:, j]) + rng.normal(0, 1 / i ** .5) * np.sin(i * w * q[:, j]) for i in range(1, K + 1))
        return one(c, j, x), [name, j, {}]
    if name == 'joint_scale':
        j = int(rng.choice(ok))
        sg = rng.choice([-1, 1])
        return one(c, j, sg * q[:, j]), [name, j, {'scale': float(sg)}]
    if name == 'joint_coupling':
        j = int(rng.choice(ok))
        by = [k for k in ok if k != j]
        b = int(rng.choice(by))
        sg = rng.choice([-1, 1])
        return one(c, j, sg * q[:, b]), [name, j, {'ratio': float(sg), 'by': b}]
    if name == 'backlash':
        return one(c, j, -.5 * c.direction[:, j]), [name, j, {'gap': 1.0}]
    if name == 'joint_compliance':
        tn = [k for k in tn if np.std(c.tau[:, k]) > .15 * np.max(np.std(c.tau[:, tn], axis=0))]
        j = int(rng.choice(tn))
        return one(c, j, c.tau[:, j]), [name, j, {'compliance': 1.0}]
    if name == 'link_compliance':
        ln = [i for i in range(a.n - 1) if np.linalg.norm(a.p0[i + 1]) > .14 * a.L]
        i = int(rng.choice(ln))
        return {'link': {i: bend(c, i)}}, [name, i, {'flexibility': 1.0}]
    if name == 'payload':
        return {'dq': tau_tool(c)}, [name, -1, {'payload': 1.0}]
    if name == 'base_shift':
        w = rng.normal(0, 1, 6) * np.array([1, 1, 1, 1 / a.L, 1 / a.L, 1 / a.L]) * 1e-3
        return {'base': w * (c.session == c.session.max())[:, None]}, [name, -1, {}]
    if name == 'base_compliance':
        return {'base': base_moment(c)}, [name, -1, {'compliance': 1.0}]
    if name == 'tool_slip':
        at = int(rng.uniform(.3, .7) * len(q))
        v = rng.normal(0, 1e-3, 3)
        return {'tool': v * (np.arange(len(q)) >= at)[:, None]}, [name, -1, {'row': at, 'shift_x': v[0], 'shift_y': v[1], 'shift_z': v[2]}]
    if name == 'tool_change':
        v = rng.normal(0, 1e-3, 3)
        return {'tool': v * (c.session == c.session.max())[:, None]}, [name, -1, {'shift_x': v[0], 'shift_y': v[1], 'shift_z': v[2]}]
    if name == 'thermal':
        return {'grow': c.temp}, [name, -1, {'expansion': 1.0}]
    if name == 'drift':
        w = rng.normal(0, 1, 6) * np.array([1, 1, 1, 1 / a.L, 1 / a.L, 1 / a.L]) * 1e-3
        return {'base': w * (c.t / c.t[-1])[:, None]}, [name, -1, {}]
    if name == 'clock_shift':
        sg = rng.choice([-1, 1])
        return {'dq': sg * c.v}, [name, -1, {'delay': float(sg)}]
    raise KeyError(name)


LINEAR = ['joint_harmonic', 'joint_map', 'joint_scale', 'joint_coupling', 'backlash', 'joint_compliance', 'link_compliance', 'payload',
          'base_shift', 'base_compliance', 'tool_slip', 'tool_change', 'thermal', 'drift', 'clock_shift']
NOISY = ['outliers', 'range_noise', 'quantisation']
FREE = {'joint_harmonic': 3, 'joint_map': 8, 'joint_scale': 1, 'joint_coupling': 1, 'backlash': 1, 'joint_compliance': 1, 'link_compliance': 1,
        'payload': 1, 'base_shift': 6, 'base_compliance': 1, 'tool_slip': 3, 'tool_change': 3, 'thermal': 1, 'drift': 6, 'clock_shift': 1}


def library_columns(c, K=4, fine=.25):
    """My own simple forms of all library effects this case's covariates allow: [(effect, joint, by, columns (3N, k))].
    Harmonics: one entry an order; the slip: one entry a moment."""
    a, q, ch = c.a, c.q, c.ch
    N, n = q.shape
    out = []
    flat = lambda x: x.reshape(3 * N, -1)
    for j in range(n):
        if np.ptp(q[:, j]) < 1e-6:
            continue
        Jj = c.J[:, j][:, :, None]                     # (N, 3, 1)
        w = span_w(c, j)
        ks = np.arange(fine, 8.01, fine) * (1 if a.types[j] == 'r' else w)
        kq = q[:, j, None] * ks
        C, S = np.cos(kq), np.sin(kq)
        for i in range(len(ks)):
            out.append(('joint_harmonic', j, ks[i], flat(Jj * np.stack([C[:, i], S[:, i]], -1)[:, None])))
        m = np.concatenate([f(i * w * q[:, j, None]) for i in range(1, K + 1) for f in (np.cos, np.sin)], 1)
        out.append(('joint_map', j, None, flat(Jj * m[:, None])))
        out.append(('joint_scale', j, None, flat(Jj * q[:, j, None, None])))
        for b in range(n):
            if b != j and np.ptp(q[:, b]) > 1e-6:
                out.append(('joint_coupling', j, b, flat(Jj * q[:, b, None, None])))
        if a.types[j] == 'r':
            out.append(('joint_compliance', j, None, flat(Jj * c.tau[:, j, None, None])))
        if 'direction' in c.given:
            out.append(('backlash', j, None, flat(Jj * c.direction[:, j, None, None])))
    for i in range(n - 1):
        if np.linalg.norm(a.p0[i + 1]) > .02 * a.L:
            t = bend(c, i)
            d = np.einsum('nij,nj->ni', ch.R[:, i], t[:, :3])
            th = np.einsum('nij,nj->ni', ch.R[:, i], t[:, 3:])
            out.append(('link_compliance', i, None, flat(d + cross(th, ch.tip - ch.o[:, i + 1]))))
    out.append(('payload', -1, None, flat(np.einsum('nk,nkx->nx', tau_tool(c), c.J))))
    Rb = a.base[:3, :3]
    rot = np.stack([cross(np.broadcast_to(Rb[:, k], ch.tip.shape), ch.tip - a.base[:3, 3]) for k in range(3)], -1)
    bm = base_moment(c)
    out.append(('base_compliance', -1, None, flat(rot[:, :, 0] * bm[:, 3:4] + rot[:, :, 1] * bm[:, 4:5])))
    B6 = np.concatenate([np.broadcast_to(Rb, (N, 3, 3)), rot], 2)
    Rt = ch.R[:, -1]
    if 'session' in c.given and np.ptp(c.session) > 0:
        for k in range(1, int(c.session.max()) + 1):
            on = (c.session == k)[:, None, None]
            out.append(('base_shift', -1, k, flat(B6 * on)))
            out.append(('tool_change', -1, k, flat(Rt * on)))
    if 'time' in c.given:
        out.append(('drift', -1, None, flat(B6 * (c.t / max(c.t[-1], 1e-9))[:, None, None])))
        if c.v is not None:
            out.append(('clock_shift', -1, None, flat(np.einsum('nk,nkx->nx', c.v, c.J))))
    if 'temperature' in c.given:
        x = np.zeros((N, 3))
        for i in range(n):
            Rp = np.broadcast_to(Rb, (N, 3, 3)) if i == 0 else ch.R[:, i - 1]
            x = x + np.einsum('nij,j->ni', Rp, a.p0[i])
        out.append(('thermal', -1, None, flat(x * c.temp[:, None])))
    moments = set(np.linspace(.06 * N, .94 * N, 24).astype(int)) | set(getattr(c, 'moments', []))
    for at in sorted(moments):
        out.append(('tool_slip', -1, at, flat(Rt * (np.arange(N) >= at)[:, None, None])))
    return out


def project_groups(c, U, groups):
    """Orthonormal columns of each group beside geometry U."""
    A = np.concatenate([g[3] for g in groups], 1)
    nrm = np.linalg.norm(A, axis=0)
    A = A / np.where(nrm > 0, nrm, 1)
    A = A - U @ (U.T @ A)
    A = A - U @ (U.T @ A)
    out, k = [], 0
    for g in groups:
        m = g[3].shape[1]
        B = A[:, k:k + m]
        k += m
        if m == 1:
            l = np.linalg.norm(B)
            out.append(B / l if l > 1e-6 else None)
        else:
            u, s, _ = np.linalg.svd(B, full_matrices=False)
            u = u[:, s > 1e-6]
            out.append(u if u.shape[1] else None)
    return out


def explained(c, U, s, count=3):
    """Share of |s|² (already beside geometry) that `count` library effects explain, greedily; outliers (the worst 3 % of rows taken out) count too."""
    groups = library_columns(c)
    N = len(c.q)
    total = s @ s
    best_all, names_all = 0, []
    for start in range(3):                                  # from the best; from the second-best effect; outliers last
        Uc, r, names, left = U, s.copy(), [], groups
        for step in range(count):
            Q = project_groups(c, Uc, left)
            red = np.array([0 if x is None else ((x.T @ r) ** 2).sum() for x in Q])
            order = np.argsort(-red)
            k = order[0]
            if start == 1 and step == 0:
                first = left[order[0]][:2]
                k = next((i for i in order if left[i][:2] != first), order[0])
            rr = (r.reshape(N, 3) ** 2).sum(1)
            far = np.argsort(-rr)[:max(1, int(.03 * N))]
            if rr[far].sum() > red[k] and not any(x[0] == 'outliers' for x in names) and (start != 2 or step == count - 1):
                names.append(('outliers', -1))
                z = np.zeros((3 * N, 3 * len(far)))
                for h, row in enumerate(far):
                    for d in range(3):
                        z[3 * row + d, 3 * h + d] = 1
                x = beside(Uc, z)
                x = np.linalg.qr(x)[0]
            else:
                if Q[k] is None:
                    break
                x = Q[k]
                names.append(left[k][:2])
            r = r - x @ (x.T @ r)
            Uc = np.concatenate([Uc, x], 1)
        share = 1 - (r @ r) / total
        if share > best_all:
            best_all, names_all = share, names
    return float(best_all), names_all


# ---------------------------------------------------------------- outside kinds: unit modifications
def pick_load(c, rng, count):
    tn = TURN(c)
    sd = np.std(c.tau[:, tn], axis=0)
    good = [j for j, s in zip(tn, sd) if s > .12 * sd.max() and movable(c, j)]
    return [int(j) for j in rng.permutation(good)[:count]]


def cardan_shaft(c, rng):
    tn = [j for j in TURN(c) if movable(c, j) and j > 0 and c.a.types[j - 1] == 'r' and np.ptp(c.q[:, j - 1]) > .8]
    j = int(rng.choice(tn))
    b = np.clip(.75 * (c.q[:, j - 1] - np.median(c.q[:, j - 1])), -1.2, 1.2)     # bend of the universal joint
    n = rng.choice([1., 1., 2., 3.])
    return one(c, j, np.tan(b / 2) ** 2 * np.sin(2 * (n * c.q[:, j] + rng.uniform(0, 3)))), {'joint': j}


def leak_down(c, rng):
    js = pick_load(c, rng, int(rng.integers(1, 3)))
    wait = np.exp(rng.normal(0, .9, len(c.q)))
    c.t[:] = np.cumsum(rng.uniform(4, 8, len(c.q)) + 10 * wait)    # a move, then the wait
    c.t -= c.t[0]
    d = np.zeros_like(c.q)
    for j in js:
        d[:, j] = rng.uniform(.6, 1.4) * np.sign(c.tau[:, j]) * np.sqrt(np.abs(c.tau[:, j]) / np.std(c.tau[:, j])) * wait
    return {'dq': d}, {'joint': js}


def recoil_yaw(c, rng):
    a, q = c.a, c.q
    if not a.upright:
        return None
    sub = 5
    f = (np.arange(sub) + .5) / sub
    path = (q[:-1, None] + f[None, :, None] * np.diff(q, axis=0)[:, None]).reshape(-1, a.n)
    ch = chain(a, path)
    com = ch.P + np.einsum('nkij,kj->nki', ch.R, a.com)
    b = a.base[:3, 3]
    zb = a.base[:3, 2]
    h = np.zeros((len(path), a.n))
    for i in range(a.n):
        lever = com[:, i:] - ch.o[:, i, None]
        vel = cross(np.broadcast_to(ch.z[:, i, None], lever.shape), lever) if a.types[i] == 'r' else np.broadcast_to(ch.z[:, i, None], lever.shape)
        h[:, i] = (cross(com[:, i:] - b, vel) @ zb) @ a.mass[i:]
    inc = -(h.reshape(-1, sub, a.n).mean(1) * np.diff(q, axis=0)).sum(1)
    tau = np.median(np.diff(c.t)) * rng.uniform(1.5, 8)                # the autopilot's patience
    y = np.zeros(len(q))
    for k in range(1, len(q)):
        y[k] = y[k - 1] * np.exp(-(c.t[k] - c.t[k - 1]) / tau) + inc[k - 1]
    off = np.array([-rng.uniform(.2, .8) * a.L, rng.normal(0, .1) * a.L, 0])   # the vehicle's centre in the base's frame
    sh = -cross(np.broadcast_to([0, 0, 1.], (len(q), 3)), np.broadcast_to(off, (len(q), 3))) * y[:, None]
    return {'base': np.concatenate([sh, np.zeros((len(q), 2)), y[:, None]], 1)}, {}


def pot_supply(c, rng):
    tn = TURN(c)
    cur = np.abs(c.tau[:, tn]) * rng.uniform(.5, 1.5, len(tn))
    S = cur.sum(1)
    S = S - S.mean()                                         # calibrated at the mean load
    d = np.zeros_like(c.q)
    for j in tn:
        d[:, j] = (c.q[:, j] - c.a.lower[j]) * S / np.std(S)
    return {'dq': d}, {}


def swell_tilt(c, rng):
    a = c.a
    c.t *= rng.uniform(1.5, 3) / np.median(np.diff(c.t))           # measured by a programme, every few seconds
    T = rng.uniform(9, 25)
    ax = np.zeros((len(c.q), 3))
    for k, amp in ((0, rng.uniform(.5, 1)), (1, rng.uniform(.2, .7))):
        w = 2 * np.pi / (T * rng.uniform(.8, 1.25))
        ax[:, k] = amp * (np.sin(w * c.t + rng.uniform(0, 6)) + .5 * np.sin(1.17 * w * c.t + rng.uniform(0, 6)))
    g = a.base[:3, :3] @ a.g
    dg = cross(ax, np.broadcast_to(g, ax.shape))
    tau = loads(a, c.ch, dg)[0]
    d = np.zeros_like(c.q)
    for j in TURN(c):
        d[:, j] = tau[:, j] * rng.uniform(.3, 1.7) / max(np.sqrt(c.W[j]), .1)
    return {'dq': d}, {}


def beam_breaks(c, rng):
    N = len(c.q)
    k = int(rng.integers(4, 10))
    cut = np.sort(rng.choice(np.arange(6, N - 5), k, replace=False))
    off = rng.normal(0, 1, k + 1)
    return {'world': unit(c.ch.tip) * off[np.searchsorted(cut, np.arange(N), side='right')][:, None]}, {'rows': cut.tolist()}


def floor_multipath(c, rng):
    p = c.ch.tip
    low = p[:, 2].min()
    floor = low - rng.uniform(.1, .5) * c.a.L
    if floor > -.3 * c.a.L:
        floor = -rng.uniform(.3, .8) * c.a.L
    D = np.hypot(p[:, 0], p[:, 1])
    z1, z2 = -floor, p[:, 2] - floor
    diff = np.sqrt(D ** 2 + (z1 + z2) ** 2) - np.linalg.norm(p, axis=1)
    lam = np.ptp(diff) / rng.uniform(2., 6.)
    weight = 1 / (1 + diff / np.median(diff))                 # the longer detour is fainter
    return {'world': unit(p) * (weight * np.sin(2 * np.pi * diff / lam + rng.uniform(0, 6)))[:, None]}, {}


def rolling_shutter(c, rng):
    p = c.ch.tip
    el = p[:, 2] / np.hypot(p[:, 0], p[:, 1])
    el = el - np.median(el) + rng.normal(0, .2) * np.std(el)
    return {'dq': c.v * (el / np.std(el))[:, None]}, {}


def dipole(m, r):
    d = np.linalg.norm(r, axis=-1, keepdims=True)
    u = r / d
    return (3 * u * dot(u, m)[:, None] - m) / d ** 3


def em_metal(c, rng):
    a = c.a
    p = c.ch.tip
    k = {'seven': 4, 'scara': 2, 'gantry': 4}.get(a.family, 3)
    E = .4 * c.ch.o[:, k - 1] + .6 * c.ch.o[:, k] if k < a.n else c.ch.o[:, -1]
    ang = rng.uniform(0, 2 * np.pi)
    mid = p.mean(0)
    src = mid + a.L * np.array([1.3 * np.cos(ang), 1.3 * np.sin(ang), rng.uniform(-.3, .3)])
    m = np.broadcast_to(unit(rng.normal(0, 1, 3) + np.array([0, 0, 1.])), p.shape)
    rE = E - src
    m2 = -dipole(m, rE)
    rt = p - E
    l = np.linalg.norm(rt, axis=1, keepdims=True)
    rt = rt / l * np.maximum(l, .18 * a.L)
    B = dipole(m2, rt)
    R = np.linalg.norm(p - src, axis=1, keepdims=True)
    return {'world': B * R ** 4}, {}


def occluded_marker(c, rng):
    p, a = c.ch.tip, c.a
    i = {'seven': 2, 'scara': 0, 'gantry': 2}.get(a.family, 1)
    A, B = c.ch.o[:, i], c.ch.o[:, i + 1] if i + 1 < a.n else p
    u = unit(p)
    f = np.linspace(0, 1, 21)[None, :, None]
    X = A[:, None] * (1 - f) + B[:, None] * f                 # points on the upper link
    near = np.linalg.norm(X, axis=2) < np.linalg.norm(p, axis=1)[:, None]
    ux = unit(X)
    side = ux - u[:, None] * dot(ux, u[:, None])[:, :, None]
    dist = np.linalg.norm(side, axis=2)
    dist = np.where(near & (dot(ux, u[:, None]) > 0), dist, 9)
    k = dist.argmin(1)
    d = dist[np.arange(len(p)), k]
    s = side[np.arange(len(p)), k]
    if (d < 5).mean() < .3:
        return None
    w = np.quantile(d, min(.55, .8 * (d < 5).mean()))
    x = np.where(d < w, 1 - d / w, 0)
    return {'world': -s / np.maximum(d, 1e-4)[:, None] * (x * np.linalg.norm(p, axis=1))[:, None]}, {'rows': float((x > 0).mean())}


def pump_limit(c, rng):
    tn = [j for j in TURN(c) if movable(c, j)]
    bore = rng.uniform(.5, 1.5, len(tn)) / np.std(c.v[:, tn], axis=0)
    Q = (np.abs(c.v[:, tn]) * bore).sum(1)
    Qm = np.quantile(Q, rng.uniform(.3, .6))
    lack = np.maximum(0, 1 - Qm / Q)
    sd = np.std(c.tau[:, tn], axis=0)
    cap = np.maximum(sd, .1 * sd.max()) * rng.uniform(.8, 1.3, len(tn))
    heavy = np.argmax(np.abs(c.tau[:, tn] - c.tau[:, tn].mean(0)) / cap, axis=1)
    d = np.zeros_like(c.q)
    for k, j in enumerate(tn):
        d[:, j] = -1.0 * (heavy == k) * lack * c.v[:, j]
    return {'dq': d}, {}


OUTSIDE = dict(cardan_shaft=cardan_shaft, leak_down=leak_down, recoil_yaw=recoil_yaw, pot_supply=pot_supply, swell_tilt=swell_tilt,
               beam_breaks=beam_breaks, floor_multipath=floor_multipath, rolling_shutter=rolling_shutter, em_metal=em_metal,
               occluded_marker=occluded_marker, pump_limit=pump_limit)


# ---------------------------------------------------------------- near misses
def worn_gap(c, rng):
    j = int(rng.choice([j for j in TURN(c) if movable(c, j)]))
    q = c.q[:, j]
    w = rng.uniform(.14, .22) * np.ptp(q)
    q0 = np.quantile(q, rng.uniform(.35, .65))
    return one(c, j, -.5 * c.direction[:, j] * np.exp(-.5 * ((q - q0) / w) ** 2)), {'joint': j}


def flat_link(c, rng):
    i = int(rng.choice([i for i in range(c.a.n - 1) if np.linalg.norm(c.a.p0[i + 1]) > .14 * c.a.L]))
    e = unit(c.a.p0[i + 1])
    b = unit(np.cross(e, [.3, 1, .2] if abs(e[1]) < .9 else [1, .2, 0]))
    th = rng.uniform(0, 2 * np.pi)
    f = np.cos(th) * b + np.sin(th) * np.cross(e, b)
    return {'link': {i: bend(c, i, f)}}, {'joint': i}


def dropped_load(c, rng):
    N = len(c.q)
    k = int(rng.integers(2, 6)) * 2
    cut = np.sort(rng.choice(np.arange(3, N - 2), k, replace=False))
    on = np.searchsorted(cut, np.arange(N), side='right') % 2 == 1
    if not .2 < on.mean() < .7:
        return None
    return {'dq': tau_tool(c) * on[:, None]}, {}


def clock_rate(c, rng):
    x = c.t / c.t[-1] - rng.choice([0, .5])
    return {'dq': c.v * x[:, None]}, {}


def air_index(c, rng):
    return {'world': c.ch.tip * c.temp[:, None]}, {}


NEAR = dict(worn_gap=worn_gap, flat_link=flat_link, dropped_load=dropped_load, clock_rate=clock_rate, stuck_bit=None, air_index=air_index)
WITH_TRAJ = {'rolling_shutter', 'pump_limit', 'clock_rate', 'clock_shift'}
LOADED = {'leak_down', 'pot_supply', 'swell_tilt', 'flat_link', 'dropped_load', 'pump_limit'}


# ---------------------------------------------------------------- the plan
def plan():
    rng = np.random.default_rng(SEED)
    P = []
    lib = LINEAR + NOISY
    for k in range(320):
        P.append(('library', lib[k % 18], [1., 2., 4.][(k // 18 + k) % 3]))
    for k in range(160):
        P.append(('library', lib[k % 18], .5))
    for kind in OUTSIDE:
        for k in range(36):
            P.append(('outside', kind, [1., 2., 4.][k % 3]))
    for kind in NEAR:
        for k in range(20):
            P.append(('near', kind, [1., 2., 4.][k % 3]))
    conf = ['slip_or_change', 'drift_or_shift', 'backlash_or_coupling', 'synchronous', 'loads']
    for k in range(70):
        P.append(('confounded', conf[k % 5], [1., 2., 4.][(k // 5) % 3]))
    for k in range(310):
        P.append(('clean', ['plain', 'covariates', 'repeated'][k % 3], 0.))
    P = [dict(group=g, kind=k, ratio=r, id=i) for i, (g, k, r) in enumerate(P)]
    return [P[i] for i in rng.permutation(len(P))]


_PLAN = None


def table():
    global _PLAN
    if _PLAN is None:
        _PLAN = plan()
    return _PLAN


class Bad(Exception):
    pass


class Ctx:
    pass


def setup(rng, style=None, families=None, N=None, sessions=0, far=(1.3, 2.6)):
    """An arm, its poses, covariates that happen to be recorded."""
    fam = str(rng.choice(families or ['ur', 'puma', 'seven', 'scara', 'gantry', 'hyd5', 'rov4', 'hyd6']))
    L = float(np.round(np.exp(rng.uniform(np.log(.4), np.log(3))), 2))
    c = Ctx()
    c.nominal = make_arm(rng, fam, L)
    place(rng, c.nominal, far)
    c.sigma = float(np.exp(rng.uniform(np.log(2e-5), np.log(np.clip(1e-4 * L, 4e-5, 2e-4)))))
    c.a = disturb(rng, c.nominal, np.exp(rng.uniform(np.log(1e-4), np.log(8e-4))), np.radians(np.exp(rng.uniform(np.log(.02), np.log(.12)))))
    style = style or rng.choice(['uniform', 'uniform', 'cluster', 'grid', 'walk', 'repeat', 'traj'])
    if N is None:
        N = int(rng.integers(60, 171)) if rng.random() < .72 else int(rng.integers(170, 291))
        if rng.random() < .02:
            N = 500
    if fam in ('seven',) and N < 90:
        N = 90
    c.style = style
    c.q, c.v, c.t = rows(rng, c.a, style, N)
    finish(c, rng, sessions)
    return c


def finish(c, rng, sessions=0):
    N = len(c.q)
    c.ch = chain(c.a, c.q)
    c.gw = c.a.base[:3, :3] @ c.a.g
    c.tau, c.W, c.S, c.com = loads(c.a, c.ch)
    c.J = jac(c.a, c.ch)
    c.given = {}
    c.direction = steps(rng, c.a, c.q)
    c.session = np.zeros(N, int)
    if sessions > 1:
        cut = np.sort(rng.uniform(.25, .75, sessions - 1)) if sessions == 2 else np.arange(1, sessions) / sessions
        c.session = np.searchsorted((cut * N).astype(int), np.arange(N), side='right')
    T = c.t[-1]
    s = c.t / T
    if rng.random() < .5:
        temp = rng.uniform(14, 24) + rng.uniform(4, 12) * (1 - np.exp(-s * rng.uniform(1, 4)))
    else:
        temp = rng.uniform(16, 24) + rng.uniform(3, 7) * np.sin(2 * np.pi * s * rng.uniform(.6, 2.5) + rng.uniform(0, 6))
    c.temp_read = np.round(temp, 2)
    c.temp = c.temp_read - c.temp_read.mean()
    c.U = geometry(c.a, c.ch)


def give(c, *names):
    for n in names:
        c.given[n] = {'time': c.t, 'direction': c.direction, 'session': c.session, 'temperature': c.temp_read}[n]


def signal(c, m, s=1.0):
    return (chain(c.a, c.q, m, s).tip - c.ch.tip).ravel()


def scale(c, m, want):
    """Size s with rms(beside geometry) = want, and the raw rms there."""
    # a first guess that moves the tip by 0.1 mm
    s = 1e-4 / max(np.abs(signal(c, m, 1e-9)).max() / 1e-9, 1e-30)
    for _ in range(4):
        x = signal(c, m, s)
        r = np.sqrt(np.mean(beside(c.U, x) ** 2))
        if not np.isfinite(r) or r <= 0:
            raise Bad('nothing beside geometry')
        if abs(r / want - 1) < .01:
            break
        s *= want / r
    raw = np.sqrt(np.mean(x ** 2))
    if abs(r / want - 1) > .03:
        raise Bad('no size')
    if raw > 40 * want and raw > 4e-3 * c.a.L:
        raise Bad('nearly geometry')
    if raw > .02 * c.a.L:
        raise Bad('too large')
    return s


def merge(ms, ss):
    """Sum of modifications at their sizes."""
    out = {}
    for m, s in zip(ms, ss):
        for k, v in m.items():
            if k == 'link':
                d = dict(out.get('link', {}))
                for i, w in v.items():
                    d[i] = d.get(i, 0) + s * w
                out['link'] = d
            else:
                out[k] = out.get(k, 0) + s * v
    return out


def stepwise(c, want, f, guess):
    """Bisection in the step of q's log: f(step) gives the logged q of the true q. Returns step, logged q."""
    lo, hi = guess * 1e-3, guess * 1e3
    for _ in range(40):
        mid = np.sqrt(lo * hi)
        x = (c.ch.tip - chain(c.a, f(mid)).tip).ravel()
        r = np.sqrt(np.mean(beside(c.U, x) ** 2))
        if abs(r / want - 1) < .02:
            return mid, f(mid)
        lo, hi = (mid, hi) if r < want else (lo, mid)
    if abs(r / want - 1) < .06:
        return mid, f(mid)
    raise Bad('no step')


NEEDS = {'backlash': ['direction'], 'base_shift': ['session'], 'tool_change': ['session'], 'thermal': ['temperature'], 'drift': ['time'],
         'clock_shift': ['time']}
CLASS = {'base_shift': 'moved', 'drift': 'moved', 'tool_slip': 'moved', 'tool_change': 'moved', 'thermal': 'moved', 'outliers': 'noisy', 'range_noise': 'noisy',
         'quantisation': 'noisy', 'payload': 'sag', 'base_compliance': 'sag', 'link_compliance': 'sag', 'joint_compliance': 'sag'}


def library_case(c, rng, names, ratio):
    a = c.a
    for n in names:
        give(c, *NEEDS.get(n, []))
    ms, truth = [], []
    used = set()
    for n in names:
        if n in NOISY:
            continue
        for _ in range(6):
            m, tr = library(c, n, rng)
            if (tr[1], n) not in used and not (tr[1] >= 0 and any(u[0] == tr[1] for u in used)):
                break
        else:
            raise Bad('same joint')
        used.add((tr[1], n))
        ms.append(m)
        truth.append(tr)
    c.moments = [tr[2]['row'] for tr in truth if tr[0] == 'tool_slip']
    want = ratio * c.sigma
    ss = [scale(c, m, want) for m in ms]
    for tr, s in zip(truth, ss):
        for k in tr[2]:
            if k not in ('order', 'by', 'row'):
                tr[2][k] = float(tr[2][k] * s)
    if ms:
        tell_apart(c, ms, ss, truth, 10 if ratio >= 1 else 6)
    c.m = merge(ms, ss)
    c.p = chain(a, c.q, c.m).tip
    c.noise = rng.normal(0, c.sigma, c.p.shape)
    for n in names:
        if n == 'outliers':
            k = max(2, int(round(rng.uniform(.02, .05) * len(c.q))))
            rows_ = rng.choice(len(c.q), k, replace=False)
            x = np.zeros_like(c.p)
            x[rows_] = unit(rng.normal(0, 1, (k, 3))) * rng.uniform(.7, 1.3, (k, 1))
            r = np.sqrt(np.mean(beside(c.U, x.ravel()) ** 2))
            c.p = c.p + x * want / r
            truth.append([n, -1, {'rows': k}])
        if n == 'range_noise':
            d = np.linalg.norm(c.p, axis=1)
            if d.max() < 2.0 * d.min():
                raise Bad('no spread of distance')
            b = want / np.sqrt(np.mean(d ** 2))
            c.noise = c.noise + rng.normal(0, 1, c.p.shape) * (b * d)[:, None]
            truth.append([n, -1, {'rate': float(b)}])
        if n == 'quantisation':
            tn = np.array([t == 'r' for t in a.types])
            j = None
            f = lambda step: np.where(tn, np.round(c.q / step) * step, c.q)
            st, logged = stepwise(c, want, f, c.sigma / a.L)
            c.logged = logged
            truth.append([n, -1, {'step': float(st)}])
    c.truth = truth


def tell_apart(c, ms, ss, truth, least):
    """A library case must be decidable: no other single cause of no more freedom may take the place of a true one."""
    groups = library_columns(c, K=3, fine=.5)
    N = len(c.q)
    cols = [signal(c, m, s)[:, None] for m, s in zip(ms, ss)]
    for i, tr in enumerate(truth):
        others = [beside(c.U, x) for k, x in enumerate(cols) if k != i]
        if others:
            # freedom of the other true causes: their own columns (amplitudes)
            Q = np.linalg.qr(np.concatenate([x / np.linalg.norm(x) for x in others], 1))[0]
            U = np.concatenate([c.U, Q], 1)
        else:
            U = c.U
        s = beside(U, beside(U, cols[i][:, 0]))
        if s @ s < least * c.sigma ** 2 * 1.5:
            raise Bad('hidden by the others')
        free = FREE[tr[0]]
        rest = [g for g in groups if FREE[g[0]] <= max(free, 3 if tr[0] in ('joint_map',) else free)
                and not same(g, tr)]
        for x in project_groups(c, U, rest):
            if x is not None and s @ s - ((x.T @ s) ** 2).sum() < least * c.sigma ** 2:
                raise Bad('confounded by chance')


def same(g, tr):
    if g[0] != tr[0] or g[1] != tr[1]:
        return False
    return g[0] != 'joint_coupling' or g[2] == tr[2]['by']


def rivals(c, m, s, tr, limit=4.0):
    """All single library causes of the truth's freedom or less that leave < limit σ² beside geometry: [[effect, joint, by], ...]."""
    x = beside(c.U, signal(c, m, s))
    out, seen, simpler = [], set(), False
    free = FREE[tr[0]]
    groups = [g for g in library_columns(c) if FREE[g[0]] <= free]
    for g, Q in zip(groups, project_groups(c, c.U, groups)):
        if Q is None:
            continue
        rss = x @ x - ((Q.T @ x) ** 2).sum()
        key = (g[0], g[1], g[2] if g[0] == 'joint_coupling' else None)
        if rss < limit * c.sigma ** 2 and key not in seen:
            seen.add(key)
            out.append(list(key))
            if not same(g, tr) and FREE[g[0]] < free:
                simpler = True
    return out, simpler


def confounded_case(rng, kind, ratio):
    fams = ['ur', 'puma', 'hyd5', 'rov4', 'hyd6', 'seven']
    N = int(rng.integers(60, 160))
    if kind == 'slip_or_change':           # the tool was knocked in the break between two sessions
        c = setup(rng, style=rng.choice(['uniform', 'cluster', 'grid']), N=N, sessions=2)
        give(c, 'session')
        name = str(rng.choice(['tool_slip', 'tool_change']))
        at = int(np.argmax(c.session > 0))
        m = {'tool': rng.normal(0, 1e-3, 3) * (c.session > 0)[:, None]}
        tr = [name, -1, {'row': at}]
        c.moments = [at]
    elif kind == 'drift_or_shift':         # two short sessions, weeks apart
        c = setup(rng, style=rng.choice(['uniform', 'cluster', 'walk']), N=N, sessions=2)
        gap = c.t[-1] * rng.uniform(300, 2000)
        c.t = c.t + gap * c.session
        give(c, 'session', 'time')
        name = str(rng.choice(['drift', 'base_shift']))
        m, tr = library(c, name, rng)
    elif kind == 'backlash_or_coupling':   # another joint stands in two places only, and this one comes to each from its own side
        c = setup(rng, families=fams, style=rng.choice(['uniform', 'cluster']), N=N)
        a = c.a
        js = [int(x) for x in rng.permutation([k_ for k_ in TURN(c) if movable(c, k_)])[:2]]
        j, b = js
        mid, half = (a.lower + a.upper) / 2, (a.upper - a.lower) / 2
        side = rng.choice([-1.0, 1.0], len(c.q))
        c.q[:, b] = mid[b] + half[b] * (rng.uniform(-.2, .2) + rng.uniform(.4, .7) * side)
        finish(c, rng)
        c.direction[:, j] = side * rng.choice([-1, 1])
        give(c, 'direction')
        if rng.random() < .5:
            m, tr = one(c, j, -.5 * c.direction[:, j]), ['backlash', j, {'gap': 1.}]
        else:
            m, tr = one(c, j, c.q[:, b]), ['joint_coupling', j, {'ratio': 1., 'by': b}]
    elif kind == 'synchronous':            # a programme that always turns some joints together
        c = setup(rng, families=fams, style='uniform', N=N)
        k = int(rng.integers(2, 4))
        js = [int(x) for x in rng.permutation([k_ for k_ in TURN(c) if movable(c, k_)])[:k]]
        a = c.a
        mid, half = (a.lower + a.upper) / 2, (a.upper - a.lower) / 2
        x = (c.q[:, js[0]] - mid[js[0]]) / half[js[0]]
        for b in js[1:]:
            c.q[:, b] = mid[b] + half[b] * (rng.choice([-1, 1]) * rng.uniform(.7, 1) * x + rng.normal(0, .003, len(x)))
        finish(c, rng)
        if rng.random() < .5:
            j = js[0]
            if rng.random() < .5:
                m, tr = one(c, j, c.q[:, j]), ['joint_scale', j, {'scale': 1.}]
            else:
                m, tr = one(c, j, c.q[:, js[1]]), ['joint_coupling', j, {'ratio': 1., 'by': js[1]}]
        else:
            j = int(rng.choice([k_ for k_ in TURN(c) if movable(c, k_) and k_ not in js] or [js[0]]))
            b = js[0] if j != js[0] else js[1]
            m, tr = one(c, j, c.q[:, b]), ['joint_coupling', j, {'ratio': 1., 'by': b}]
    else:                                  # loads: little moved but one or two joints, several springs can be meant
        c = setup(rng, families=fams, style='uniform', N=N)
        a = c.a
        mid, half = (a.lower + a.upper) / 2, (a.upper - a.lower) / 2
        few = rng.uniform(.01, .12)
        keep = rng.permutation([0, 1, 2, 3 if a.n > 3 else 2])[:int(rng.integers(1, 3))]
        sp = np.full(a.n, few)
        sp[keep] = rng.uniform(.3, .95)
        c.q = mid + rng.uniform(-.4, .4, a.n) * half + half * sp * rng.uniform(-1, 1, c.q.shape) * .9
        finish(c, rng)
        name = str(rng.choice(['joint_compliance', 'link_compliance', 'payload', 'base_compliance']))
        m, tr = library(c, name, rng)
    s = scale(c, m, ratio * c.sigma)
    riv, simpler = rivals(c, m, s, tr)
    me = [r for r in riv if same(r, tr)]
    if not me:
        riv.append([tr[0], tr[1], tr[2].get('by')])
    if len(riv) < 2 or simpler:
        raise Bad('not confounded' if len(riv) < 2 else 'a simpler one')
    if len(riv) > 4 and rng.random() < .8:
        raise Bad('many')
    for k in tr[2]:
        if k not in ('order', 'by', 'row'):
            tr[2][k] = float(tr[2][k] * s)
    c.truth, c.rivals, c.many = [tr], riv, len(riv) > 4
    c.m = merge([m], [s])
    c.p = chain(c.a, c.q, c.m).tip
    c.noise = rng.normal(0, c.sigma, c.p.shape)
    return c


def build(entry, attempt):
    rng = np.random.default_rng([SEED, entry['id'], attempt])
    g, kind, ratio = entry['group'], entry['kind'], entry['ratio']
    share, by, info = None, None, {}
    if g == 'confounded':
        c = confounded_case(rng, kind, ratio)
    elif g == 'library':
        fixed = np.random.default_rng([SEED, 7, entry['id']])         # the number of causes does not depend on redraws
        count = int(fixed.choice([1, 2, 3], p=[.5, .35, .15]))
        names = [kind]
        while len(names) < count:
            x = str(rng.choice(LINEAR + NOISY))
            taken = {CLASS.get(y, y) for y in names}
            if CLASS.get(x, x) not in taken:
                names.append(x)
        style = 'traj' if 'clock_shift' in names else (rng.choice(['uniform', 'cluster', 'grid', 'walk', 'repeat']))
        fam = None
        if any(CLASS.get(x) == 'sag' for x in names):
            fam = ['ur', 'puma', 'seven', 'hyd5', 'rov4', 'hyd6']
            if set(names) & {'link_compliance', 'base_compliance'} and rng.random() < .3:
                fam = fam + ['gantry']
        c = setup(rng, style=style, families=fam, sessions=2 if set(names) & {'base_shift', 'tool_change'} else 0,
                  far=(.9, 1.3) if 'range_noise' in names else (1.3, 2.6))
        for n, pr in (('time', .3), ('temperature', .1), ('direction', .1)):
            if rng.random() < pr:
                give(c, n)
        library_case(c, rng, names, ratio)
    elif g == 'clean':
        style = 'repeat' if kind == 'repeated' else rng.choice(['uniform', 'cluster', 'grid', 'walk', 'traj'])
        c = setup(rng, style=style, sessions=int(rng.integers(2, 4)) if kind != 'plain' and rng.random() < .5 else 0)
        if kind == 'covariates':
            for n in ('time', 'direction', 'temperature'):
                if rng.random() < .55:
                    give(c, n)
            if c.session.max() > 0:
                give(c, 'session')
        elif kind == 'repeated' and c.session.max() > 0:
            give(c, 'session')
        c.truth, c.m, c.p = [], {}, c.ch.tip
        c.noise = rng.normal(0, c.sigma, c.p.shape)
    else:
        fam = ['ur', 'puma', 'seven', 'hyd5', 'rov4', 'hyd6'] if kind in LOADED else None
        if kind in ('cardan_shaft', 'recoil_yaw'):
            fam = ['ur', 'puma', 'seven', 'hyd5', 'rov4', 'hyd6']
        style = 'traj' if kind in WITH_TRAJ else rng.choice(['uniform', 'uniform', 'cluster', 'grid', 'walk', 'repeat'])
        many = int(rng.integers(140, 271)) if kind in ('rolling_shutter', 'pump_limit') else None   # else a few curves describe so short a way
        c = setup(rng, style=style, families=fam, N=many, sessions=2 if rng.random() < .1 else 0)
        if c.session.max() > 0:
            give(c, 'session')
        if kind in WITH_TRAJ:
            give(c, 'time')
        if kind == 'worn_gap':
            give(c, 'direction')
        if kind == 'air_index':
            give(c, 'temperature')
        if rng.random() < .5:
            give(c, 'time')
        if kind not in ('worn_gap',) and rng.random() < .12:
            give(c, 'direction')
        if rng.random() < .12:
            give(c, 'temperature')
        if kind == 'stuck_bit':
            j = int(rng.choice([j for j in TURN(c) if movable(c, j)]))

            def f(step):
                x = c.q.copy()
                x[:, j] -= step * (np.floor(x[:, j] / step) % 2)
                return x
            st, logged = stepwise(c, ratio * c.sigma, f, c.sigma / c.a.L)
            sig = beside(c.U, (c.ch.tip - chain(c.a, logged).tip).ravel())
            info = {'joint': j, 'step': float(st)}
            c.m, c.p, c.logged = {}, c.ch.tip, logged
        else:
            got = (OUTSIDE.get(kind) or NEAR[kind])(c, rng)
            if got is None:
                raise Bad('not possible with this arm')
            m, info = got
            s = scale(c, m, ratio * c.sigma)
            c.m = merge([m], [s])
            c.p = chain(c.a, c.q, c.m).tip
            sig = beside(c.U, (c.p - c.ch.tip).ravel())
        c.moments = []
        share, by = explained(c, c.U, sig)
        if g == 'near' and share > .985:
            raise Bad('as good as the library')
        c.truth = []
        c.noise = rng.normal(0, c.sigma, c.p.shape)
    group = 'near' if g == 'outside' and share > .8 else g
    if g in ('outside', 'near'):
        js = info.get('joint', info.get('joints'))
        if js is None:
            js = [j for j in range(c.a.n) if np.any(np.atleast_2d(c.m.get('dq', np.zeros((1, c.a.n))))[:, j])]
        info['joints'] = [int(j) for j in np.atleast_1d(js)]
    q = getattr(c, 'logged', c.q)
    size = None
    if g in ('outside', 'near'):
        size = float(np.sqrt(np.mean(sig ** 2)) / c.sigma)
    cov = dict(c.given)
    if not c.a.upright:
        cov['gravity'] = np.broadcast_to(c.a.g, (len(q), 3)).copy()
    return dict(id=entry['id'], group=group, planned=g, kind=kind, ratio=ratio, size=size, truth=c.truth, info=info,
                rivals=getattr(c, 'rivals', None), many=bool(getattr(c, 'many', False)), share3=share, explained_by=by,
                family=c.a.family, style=str(c.style), sigma=c.sigma, attempt=attempt, nominal=c.nominal,
                q=q, p=c.p + c.noise, covariates=cov, _ctx=c)


def case(i):
    entry = table()[i]
    for attempt in range(600):
        try:
            return dict(build(entry, attempt), i=i)
        except (Bad, ValueError, IndexError) as e:   # an arm without a fitting joint: draw another
            why = e
    raise RuntimeError(f'case {i} ({entry}): no draw: {why}')


def urdf(a):
    """The nominal arm as a URDF (base and tool apart)."""
    s = ['<?xml version="1.0"?>', f'<robot name="{a.family}">', '<link name="link_0"/>']
    num = lambda v: ' '.join(f'{x:.10g}' for x in v)
    for i in range(a.n):
        k = max(1e-4, .02 * a.mass[i] * a.L ** 2)
        s.append(f'<link name="link_{i + 1}"><inertial><origin xyz="{num(a.com[i])}" rpy="0 0 0"/><mass value="{a.mass[i]:.10g}"/>'
                 f'<inertia ixx="{k:.6g}" ixy="0" ixz="0" iyy="{k:.6g}" iyz="0" izz="{k:.6g}"/></inertial></link>')
        s.append(f'<joint name="joint_{i + 1}" type="{"revolute" if a.types[i] == "r" else "prismatic"}"><parent link="link_{i}"/><child link="link_{i + 1}"/>'
                 f'<origin xyz="{num(a.p0[i])}" rpy="{num(a.r0[i])}"/><axis xyz="{num(a.axis[i])}"/>'
                 f'<limit lower="{a.lower[i]:.10g}" upper="{a.upper[i]:.10g}" effort="1000" velocity="2"/></joint>')
    s.append('</robot>')
    return '\n'.join(s)

"""Cases of round 1: case(i) -> dict(arm=nominal, q, p, covariates, truth, ...). Physics from frames as in URDF; NumPy only."""
import numpy as np

SEED, G = 20261, 9.80665
R, S = "revolute", "prismatic"
# ---------------------------------------------------------------- frames
def rot(rpy):
    (cr, cp, cy), (sr, sp, sy) = np.cos(rpy), np.sin(rpy)
    return np.array([[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
                     [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr], [-sp, cp * sr, cp * cr]])
def rigid(xyz, rpy=(0, 0, 0)):
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = rot(np.array(rpy, float)), xyz
    return T
def motion(w):
    """(..., 6) shift, rotation vector -> (..., 4, 4): T(shift) · R(rotation)."""
    w = np.asarray(w, float)
    v, r = w[..., :3], w[..., 3:]
    a = np.linalg.norm(r, axis=-1)[..., None, None]
    K = np.zeros(r.shape[:-1] + (3, 3))
    K[..., 0, 1], K[..., 0, 2], K[..., 1, 2] = -r[..., 2], r[..., 1], -r[..., 0]
    K -= np.swapaxes(K, -1, -2)
    T = np.zeros(r.shape[:-1] + (4, 4))
    T[..., :3, :3] = np.eye(3) + np.sinc(a / np.pi) * K + 0.5 * np.sinc(a / 2 / np.pi) ** 2 * (K @ K)
    T[..., :3, 3], T[..., 3, 3] = v, 1
    return T
def along(axis, slide, value):
    w = np.zeros(value.shape + (6,))
    w[..., slice(0, 3) if slide else slice(3, 6)] = value[..., None] * axis
    return motion(w)
def frames(arm, q, add=None):
    """(P, F, E): frames before and behind each joint's motion, and the tip's, world, (N, 4, 4) each."""
    add = add or {}
    N, n = q.shape
    grow = 1 + add.get("grow", np.zeros(N))
    q = q + add.get("dq", 0)
    T = np.broadcast_to(arm["base"], (N, 4, 4))
    if "base" in add: T = T @ motion(add["base"])
    P, F = [], []
    for k in range(n + 1):
        o = np.array(np.broadcast_to(arm["tool"] if k == n else arm["origin"][k], (N, 4, 4)))
        o[:, :3, 3] *= grow[:, None]
        T = T @ o
        if "before" in add: T = T @ motion(add["before"][:, k])
        if k == n: break
        P.append(T)
        T = T @ along(arm["axis"][k], arm["type"][k] == S, q[:, k])
        if "after" in add: T = T @ motion(add["after"][:, k])
        F.append(T)
    if "tip" in add:
        T = T.copy()
        T[:, :3, 3] += add["tip"]
    return P, F, T
def tip(arm, q, add=None):
    return frames(arm, q, add)[2][:, :3, 3]
# ---------------------------------------------------------------- arms
def make_arm(r, family):
    u = r.uniform
    reach = np.exp(u(np.log(0.45), np.log(2.9)))
    a, b = reach * u(.3, .55), reach * u(.3, .55)
    h, w, t = reach * u(.06, .15), reach * u(.05, .12), reach * u(.05, .12)
    z, y, x = (0, 0, 1), (0, 1, 0), (1, 0, 0)
    tool = np.array([t, t * u(.3, .8), t * u(-.6, .6)])
    J = {"six": [(R, z, (0, 0, h)), (R, y, (w, 0, w)), (R, y, (0, w * u(-.5, .5), a)), (R, x, (b * .5, 0, w)), (R, y, (b * .5, 0, 0)), (R, x, (w, 0, 0))],
         "seven": [(R, z, (0, 0, h)), (R, y, (0, 0, w)), (R, z, (0, 0, a * .6)), (R, y, (w * .5, 0, a * .4)), (R, z, (-w * .5, 0, b * .6)), (R, y, (0, 0, b * .4)), (R, z, (w, 0, w))],
         "scara": [(R, z, (0, 0, h)), (R, z, (a, 0, w)), (S, (0, 0, -1), (b, 0, 0)), (R, z, (0, 0, -w))],
         "gantry": [(S, x, (0, 0, a)), (S, y, (0, 0, w)), (S, (0, 0, -1), (w, 0, 0)), (R, z, (0, 0, -b * .3)), (R, y, (0, w, -w))],
         "crane": [(R, z, (0, 0, h)), (R, y, (w, 0, w)), (S, x, (a * .6, 0, w)), (R, y, (b * .6, 0, 0)), (R, x, (w, 0, 0))],
         "five": [(R, z, (0, 0, h)), (R, y, (w, 0, w * .5)), (R, y, (a * .7, 0, 0)), (R, y, (b * 1.3, 0, w * .3)), (R, x, (w, 0, 0))],
         "four": [(R, z, (0, 0, h)), (R, y, (w, 0, 0)), (R, y, (a, w, 0)), (R, y, (b, 0, 0))],
         "roll4": [(R, z, (0, 0, h)), (R, y, (0, w, w)), (R, x, (a * .5, 0, w)), (R, y, (a * .5 + b, 0, 0))]}[family]
    n = len(J)
    rpy = np.zeros((n, 3))
    if r.random() < .35: rpy[1:] = r.normal(0, .12, (n - 1, 3))
    tilt = r.random()
    if family in ("six", "five", "seven", "gantry") and tilt < .3: rpy[0] = (u(-.6, .6), u(-.6, .6), u(-3, 3)) if tilt < .2 else (0, np.pi / 2, 0)
    lo, hi = np.zeros(n), np.zeros(n)
    for k, (kind, axis, _) in enumerate(J):
        half = reach * u(.15, .3) if kind == S else (u(1.6, 2.9) if k in (0, n - 1) or axis == x else u(.8, 1.7))
        mid = (half + .1 * reach if axis != x or family == "crane" else 0) if kind == S else (0 if k == 0 else u(-.4, .4))
        lo[k], hi[k] = mid - half, mid + half
    xyz = np.array([j[2] for j in J], float)
    ends = np.vstack([xyz[1:], tool])
    mass = (1 + 20 * np.linalg.norm(ends, axis=1)) * reach * np.exp(r.normal(0, .3, n)) * np.linspace(1.5, .5, n)
    return dict(family=family, reach=reach, type=[j[0] for j in J], axis=np.array([j[1] for j in J], float), xyz=xyz, rpy=rpy,
                origin=[rigid(xyz[k], rpy[k]) for k in range(n)], tool=rigid(tool), lo=lo, hi=hi, mass=mass,
                cog=ends * u(.3, .7, (n, 1)) + r.normal(0, .03 * reach, (n, 3)),
                base=rigid(reach * np.array([u(.5, 1.2) * r.choice([-1, 1]), u(-.8, .8), u(-.4, .3)]), (0, 0, u(-3, 3))))
def perturbed(r, arm):
    """Geometry errors of every origin, of base and tool: 0.1-2 mm, 0.02-0.3 degrees."""
    mm, deg = np.exp(r.uniform(np.log(1e-4), np.log(2e-3))), np.radians(np.exp(r.uniform(np.log(.02), np.log(.3))))
    def off():
        return motion(np.r_[r.normal(0, mm, 3), r.normal(0, deg, 3)])
    return arm | dict(origin=[T @ off() for T in arm["origin"]], base=arm["base"] @ off(), tool=arm["tool"] @ off())
def urdf(arm):
    t = lambda v: " ".join(f"{x:.12g}" for x in v)
    n, out = len(arm["type"]), ['<robot name="arm"><link name="foot"/>']
    for k in range(n):
        out.append(f'<link name="l{k}"><inertial><origin xyz="{t(arm["cog"][k])}" rpy="0 0 0"/><mass value="{arm["mass"][k]:.12g}"/>'
                   '<inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>'
                   f'<joint name="j{k}" type="{arm["type"][k]}"><parent link="{"foot" if k == 0 else f"l{k-1}"}"/><child link="l{k}"/>'
                   f'<origin xyz="{t(arm["xyz"][k])}" rpy="{t(arm["rpy"][k])}"/><axis xyz="{t(arm["axis"][k])}"/>'
                   f'<limit lower="{arm["lo"][k]:.9g}" upper="{arm["hi"][k]:.9g}" effort="1000" velocity="3"/></joint>')
    out.append(f'<link name="tip"/><joint name="jt" type="fixed"><parent link="l{n-1}"/><child link="tip"/><origin xyz="{t(arm["tool"][:3, 3])}" rpy="0 0 0"/></joint></robot>')
    return "\n".join(out)
# ---------------------------------------------------------------- one set of measurements
class Context:
    def __init__(self, r, arm, want, q=None, t=None, N=None, **kw):
        self.nominal, self.arm = arm, perturbed(r, arm)
        self.r, self.n = r, len(arm["type"])
        self.N = N or int(r.choice([500, 300, 240, 180, 120, 80, 60], p=[.04, .14, .22, .25, .2, .1, .05]))
        self.sigma = np.exp(r.uniform(np.log(2e-5), np.log(2e-4)))
        self.cov, self.time, self.session, self.path, self.pattern = {}, t, kw.get("session"), None, "special"
        self.turn = [k for k in range(self.n) if arm["type"][k] == R]
        if "traj" in want and q is None:
            self.N = max(self.N, 180)
            self.trajectory()
        self.q = q if q is not None else (self.path(self.time) if self.path else self.poses())
        self.N = N = len(self.q)
        self.velocity = np.gradient(self.q, self.time, axis=0) if self.path else None
        if "session" in want and self.session is None: self.session = self.setups()
        if "time" in want and self.time is None: self.time = np.cumsum(r.uniform(8, 30, N))
        self.direction = kw.get("direction")
        if "direction" in want and self.direction is None: self.direction = np.sign(self.velocity) if self.path else r.choice([-1., 1.], (N, self.n))
        if "temperature" in want:
            T = 20 + r.uniform(3, 10) * (np.sin(np.linspace(0, r.uniform(2, 6), N) + r.uniform(0, 6)) if r.random() < .5 else r.random(N))
            self.cov["temperature"] = T
        for name in ("time", "session", "direction"):
            if getattr(self, name) is not None and name in set(want) | {"time"} | set(kw): self.cov[name] = getattr(self, name)
        self.P, self.F, self.E = frames(self.arm, self.q)
        self.p = self.E[:, :3, 3]
        self.geometry()
    def poses(self):
        r, n, N = self.r, self.n, self.N
        lo, hi = self.nominal["lo"], self.nominal["hi"]
        self.pattern = r.choice(["random", "cluster", "grid", "repeat"], p=[.6, .15, .15, .1])
        x = r.random((N, n))
        if self.pattern == "cluster": x = np.clip(r.random((8, n))[r.integers(0, 8, N)] + r.normal(0, .1, (N, n)), 0, 1)
        if self.pattern == "grid": x = r.integers(0, 6, (N, n)) / 5 + r.normal(0, 1e-3, (N, n))
        if self.pattern == "repeat": x[N // 2:] = x[r.integers(0, N // 2, N - N // 2)]
        return lo + x * (hi - lo)
    def setups(self):
        """Two set-ups by turns, in 3 to 5 blocks of rows."""
        return np.searchsorted(np.sort(self.r.dirichlet(8 * np.ones(self.r.integers(3, 6))).cumsum()[:-1]), np.arange(self.N) / self.N) % 2
    def trajectory(self):
        r, n = self.r, self.n
        A = r.uniform(.3, 1, (3, n))
        A *= .48 * (self.nominal["hi"] - self.nominal["lo"]) / A.sum(0)
        w, f = 2 * np.pi / r.uniform(4, 22, (3, n)), r.uniform(0, 6.3, (3, n))
        mid = (self.nominal["lo"] + self.nominal["hi"]) / 2
        self.path, self.pattern = (lambda t: mid + sum(A[m] * np.sin(np.outer(t, w[m]) + f[m]) for m in range(3))), "trajectory"
        self.time = np.arange(self.N) * r.uniform(.08, .2)
    def geometry(self):
        """J (N, 3, n): tip by each joint; Q: orthonormal basis of all that geometry errors (origins, base, tool) can do."""
        cols = []
        for T in [np.broadcast_to(self.arm["base"], (self.N, 4, 4))] + self.P + [self.E]:
            Rk = T[:, :3, :3]
            cols += [Rk, np.cross(Rk.transpose(0, 2, 1), (self.p - T[:, :3, 3])[:, None]).transpose(0, 2, 1)]
        X = np.concatenate(cols, 2).reshape(3 * self.N, -1)
        X = X / (np.linalg.norm(X, axis=0) + 1e-12)
        U, s, _ = np.linalg.svd(X, full_matrices=False)
        self.Q = U[:, s > 1e-9 * s[0]]
        self.world_axis = a = np.stack([self.P[k][:, :3, :3] @ self.arm["axis"][k] for k in range(self.n)], 1)
        self.J = np.stack([a[:, k] if self.arm["type"][k] == S else np.cross(a[:, k], self.p - self.P[k][:, :3, 3]) for k in range(self.n)], 2)
        self.at = np.stack([T[:, :3, 3] for T in self.F], 1)
        self.cogs = np.stack([T[:, :3, :3] @ self.arm["cog"][k] + T[:, :3, 3] for k, T in enumerate(self.F)], 1)
        self.ends = np.stack([T[:, :3, 3] for T in self.P[1:]] + [self.p], 1)
        self.weights = np.outer(self.arm["mass"], [0, 0, -G])
        self.tau = self.torque(self.cogs, np.broadcast_to(self.weights, self.cogs.shape))
    def torque(self, points, forces, first=None):
        """(N, n) of forces on links (N, n, 3); `first`: link that the first of them works on."""
        m = points.shape[1]
        out = np.zeros((self.N, self.n))
        for j in range(self.n):
            i = max(0, j - (first or 0))
            f, c = forces[:, i:m], points[:, i:m]
            load = f.sum(1) if self.arm["type"][j] == S else np.cross(c - self.at[:, j, None], f).sum(1)
            out[:, j] = (self.world_axis[:, j] * load).sum(1)
        return out
    def moment(self, point, k):
        """World moment (N, 3) of the weight of links k.. about point (N, 3), and that weight."""
        w = self.weights[k:]
        return np.cross(self.cogs[:, k:] - point[:, None], w).sum(1), w.sum(0) * np.ones((self.N, 1))
    def left(self, d):
        d = d.reshape(3 * self.N, -1)
        return d - self.Q @ (self.Q.T @ d)
    def signal(self, add, size):
        return tip(self.arm, self.q, {k: v * size for k, v in add.items()}) - self.p
    def joint(self, turning=True):
        return int(self.r.choice(self.turn if turning else list(range(self.n))))
    def dq(self, j, value):
        d = np.zeros((self.N, self.n))
        d[:, j] = value
        return {"dq": d}
    def springs(self, tau):
        soft = np.zeros(self.n)
        soft[self.turn] = np.exp(self.r.normal(0, .4, len(self.turn)))
        return {"dq": tau * soft}
    def before(self, k, shift=None, turn=None):
        b = np.zeros((self.N, self.n + 1, 6))
        if shift is not None: b[:, k, :3] = shift
        if turn is not None: b[:, k, 3:] = turn
        return {"before": b}
    def twist(self):
        return np.r_[self.r.normal(0, .5 * self.arm["reach"], 3), self.r.normal(0, 1, 3)]
# ---------------------------------------------------------------- the library, per unit of size: (add, joint, parameter names)
def bent(c, k):
    """Link k as a beam from its frame to the next joint, under the weight beyond it."""
    v = c.ends[:, k] - c.at[:, k]
    L = np.linalg.norm(v, axis=1, keepdims=True)
    e = v / L
    M, W = c.moment(c.ends[:, k], k + 1)
    if k == c.n - 1: raise ValueError("nothing beyond")
    Wp, Mp = W - e * (e * W).sum(1, keepdims=True), M - e * (e * M).sum(1, keepdims=True)
    shift = Wp * L**3 / 3 + np.cross(Mp, e) * L**2 / 2
    turn = np.cross(e, Wp) * L**2 / 2 + Mp * L
    to = c.P[k + 1][:, :3, :3].transpose(0, 2, 1)
    return c.before(k + 1, (to @ shift[..., None])[..., 0], (to @ turn[..., None])[..., 0])
def loaded(c):
    return [k for k in c.turn if np.std(c.tau[:, k]) > .15 * np.abs(c.tau).max()]
def one_of(c, options):
    if not options: raise ValueError("no such joint here")
    return int(c.r.choice(options))
def library_effect(c, name):
    r, N, q, rows = c.r, c.N, c.q, np.arange(c.N)
    if name == "joint_harmonic":
        j, k, f = c.joint(), float(r.choice([1, 2, 3, 4, r.uniform(1.2, 6)])), r.uniform(0, 6.3)
        return c.dq(j, np.cos(k * q[:, j] - f)), j, {"order": k, "cos": (np.cos(f),), "sin": (np.sin(f),)}
    if name == "joint_map":
        j, K = c.joint(turning=False), int(r.integers(2, 4))
        w = 1 if c.arm["type"][j] == R else 2 * np.pi / (1.5 * np.ptp(q[:, j]))
        a = r.normal(0, 1, (K, 2)) + .5
        return c.dq(j, sum(a[i] @ [np.cos((i + 1) * w * q[:, j]), np.sin((i + 1) * w * q[:, j])] for i in range(K))), j, {}
    if name == "joint_scale": return c.dq(j := c.joint(turning=False), q[:, j]), j, {"scale": (1.,)}
    if name == "joint_coupling":
        j = c.joint()
        by = int(r.choice([k for k in c.turn if k != j]))
        return c.dq(j, q[:, by]), j, {"by": by, "ratio": (1.,)}
    if name == "backlash": return c.dq(j := c.joint(turning=False), -.5 * c.direction[:, j]), j, {"gap": (1.,)}
    if name == "joint_compliance": return c.dq(j := one_of(c, loaded(c)), c.tau[:, j]), j, {"compliance": (1.,)}
    if name == "link_compliance":
        return bent(c, k := one_of(c, list(np.flatnonzero(np.linalg.norm(c.ends[0] - c.at[0], axis=1)[:-1] > .15 * c.arm["reach"])))), k, {}
    if name == "payload":
        if not loaded(c): raise ValueError
        return c.springs(c.torque(c.p[:, None], np.array([0, 0, -1.]) * np.ones((N, 1, 1)), c.n - 1)), -1, {}
    if name == "base_shift": return {"base": c.session[:, None] * c.twist()}, -1, {}
    if name == "base_compliance":
        M = c.moment(np.ones((N, 1)) * c.arm["base"][:3, 3], 0)[0] @ c.arm["base"][:3, :3]
        return {"base": np.c_[np.zeros((N, 3)), M[:, :2], np.zeros(N)]}, -1, {}
    if name == "tool_slip": return c.before(c.n, (rows[:, None] >= int(N * r.uniform(.25, .75))) * r.normal(0, 1, 3)), -1, {}
    if name == "tool_change": return c.before(c.n, c.session[:, None] * r.normal(0, 1, 3)), -1, {}
    if name == "thermal": return {"grow": c.cov["temperature"] - 20}, -1, {}
    if name == "drift": return {"base": (c.time / c.time[-1])[:, None] * c.twist()}, -1, {}
    if name == "clock_shift": return {"dq": c.velocity}, -1, {"delay": (1.,)}
    if name == "outliers":
        hit = r.permutation(N)[:max(2, int(N * r.uniform(.015, .04)))]
        d, e = np.zeros((N, 3)), r.normal(0, 1, (len(hit), 3))
        d[hit] = r.uniform(.7, 1.4, (len(hit), 1)) * e / np.linalg.norm(e, axis=1, keepdims=True)
        return {"tip": d}, -1, {}
    if name == "range_noise": return {"tip": np.linalg.norm(c.p, axis=1, keepdims=True) * r.normal(0, 1, (N, 3))}, -1, {}
    raise KeyError(name)
NEEDS = {"backlash": ["direction"], "base_shift": ["session"], "tool_change": ["session"], "thermal": ["temperature"], "drift": ["time"],
         "clock_shift": ["traj", "time"], "quadratic_damping": ["traj", "time"], "inertia_windup": ["traj", "time"], "settling": ["time"]}
LIBRARY = ["joint_harmonic", "joint_map", "joint_scale", "joint_coupling", "backlash", "joint_compliance", "link_compliance", "payload",
           "base_shift", "base_compliance", "tool_slip", "tool_change", "thermal", "drift", "clock_shift", "outliers", "range_noise", "quantisation"]
def library_columns(c):
    """[(effect, joint, (3N, k) columns beside geometry)], first order; what my own library could explain, any size and phase."""
    out, N = [], c.N
    def jcol(j, B):
        B = B.reshape(N, -1)
        return c.left((c.J[:, :, j, None] * B[:, None, :]).reshape(3 * N, -1))
    def cols(*adds):
        return c.left(np.stack([(tip(c.arm, c.q, {k: v * e for k, v in a.items()}) - c.p).ravel() / e
                                for a in adds for e in [1e-6 / max(1e-12, max(np.abs(v).max() for v in a.values()))]], 1))
    for j in range(c.n):
        x, turning = c.q[:, j], j in c.turn
        w = 1 if turning else 2 * np.pi / (1.5 * np.ptp(x) + 1e-9)
        wave = lambda k: np.c_[np.cos(k * x), np.sin(k * x)]
        if turning: out += [("joint_harmonic", j, jcol(j, wave(k))) for k in np.arange(.4, 8.01, .2)]
        out += [("joint_map", j, jcol(j, np.hstack([wave(w * (i + 1)) for i in range(4)]))), ("joint_scale", j, jcol(j, x))]
        out += [("joint_coupling", j, jcol(j, c.q[:, b])) for b in range(c.n) if b != j]
        if "direction" in c.cov: out.append(("backlash", j, jcol(j, c.direction[:, j])))
        if turning and np.std(c.tau[:, j]) > 1e-6: out.append(("joint_compliance", j, jcol(j, c.tau[:, j])))
        if j < c.n - 1: out.append(("link_compliance", j, cols(bent(c, j))))
    load = c.torque(c.p[:, None], np.array([0, 0, -1.]) * np.ones((N, 1, 1)), c.n - 1)
    out.append(("payload", -1, np.hstack([jcol(j, load[:, j]) for j in c.turn])))
    M = c.moment(np.ones((N, 1)) * c.arm["base"][:3, 3], 0)[0] @ c.arm["base"][:3, :3]
    Z = np.zeros(N)
    out.append(("base_compliance", -1, cols(*[{"base": np.c_[Z, Z, Z, m, Z]} for m in (np.c_[M[:, 0], Z], np.c_[Z, M[:, 1]])])))
    step = lambda m: cols(*[c.before(c.n, m[:, None] * e) for e in np.eye(3)])
    out += [("tool_slip", -1, step(np.arange(N) >= m)) for m in range(5, N - 4, max(1, N // 40))]
    if "session" in c.cov:
        out += [("tool_change", -1, step(c.session == 1)), ("base_shift", -1, cols(*[{"base": c.session[:, None] * e} for e in np.eye(6)]))]
    if "time" in c.cov:
        out.append(("drift", -1, cols(*[{"base": (c.time / c.time[-1])[:, None] * e} for e in np.eye(6)])))
        if c.velocity is not None: out.append(("clock_shift", -1, cols({"dq": c.velocity})))
    if "temperature" in c.cov: out.append(("thermal", -1, cols({"grow": c.cov["temperature"] - 20})))
    return out
def explained(c, d, steps, skip=()):
    """Greedy least squares of d over the library: [(effect, joint, share explained so far)]."""
    lib = [(n, j, X) for n, j, X in library_columns(c) if (n, j) not in skip]
    res = c.left(d.ravel())[:, 0]
    total, Q, found = res @ res, np.zeros((len(res), 0)), []
    for _ in range(steps):
        best = (0, None)
        for n, j, X in lib:
            X = X - Q @ (Q.T @ X)
            U, s, _ = np.linalg.svd(X, full_matrices=False)
            U = U[:, s > 1e-6 * max(s[0], 1e-12)]
            g = np.sum((U.T @ res) ** 2)
            if g > best[0]: best = (g, (n, j, U))
        if best[1] is None: break
        n, j, U = best[1]
        res, Q = res - U @ (U.T @ res), np.hstack([Q, U])
        found.append((n, j, float(1 - res @ res / total)))
    return found
# ---------------------------------------------------------------- outside and near kinds: (add, joint or joints)
def across(a):
    e = np.cross(a, [1, 0, 0] if abs(a[0]) < .8 else [0, 1, 0])
    e /= np.linalg.norm(e)
    return e, np.cross(a, e)
def pieces(c, m=8):
    """Points along the links, (N, n, m, 3)."""
    s = (np.arange(m) + .5) / m
    return c.at[:, :, None] + s[:, None] * (c.ends - c.at)[:, :, None]
def new_effect(c, kind):
    r, N, q, reach = c.r, c.N, c.q, c.arm["reach"]
    up = np.array([0, 0, 1.])
    if kind == "current_drag":
        v = rot([0, 0, r.uniform(-3, 3)]) @ [1, 0, r.uniform(-.3, .3)]
        e = c.ends - c.at
        L = np.linalg.norm(e, axis=2, keepdims=True)
        e = e / L
        vp = v - e * (e @ v)[..., None]
        F = vp * np.linalg.norm(vp, axis=2, keepdims=True) * L * r.uniform(.5, 1.2, c.n)[:, None]
        return c.springs(c.torque((c.at + c.ends) / 2, F)), c.turn
    if kind == "waterline":
        x = pieces(c)
        level = np.quantile(x[:, :, :, 2], r.uniform(.3, .7))
        wet = (x[..., 2] < level) * np.linalg.norm(c.ends - c.at, axis=2)[..., None] * r.uniform(.5, 1.2, c.n)[:, None]
        B = wet.sum(2)
        point = (wet[..., None] * x).sum(2) / (B[..., None] + 1e-12)
        return c.springs(c.torque(point, B[..., None] * up)), c.turn
    if kind == "bearing_wobble":
        j = one_of(c, [k for k in c.turn[:-1] if np.ptp(q[:, k]) > 1.5])
        k, f, g, e = int(r.integers(2, 4)), r.uniform(0, 6.3), r.uniform(0, 6.3), r.uniform(.6, 1)
        e1, e2 = across(c.arm["axis"][j])
        w = lambda f: np.cos(k * q[:, j, None] + f) * e1 + e * np.sin(k * q[:, j, None] + f) * e2
        return c.before(j, .1 * reach * w(g), w(f)), [j]
    if kind == "bearing_tilt":
        j = one_of(c, c.turn[:max(1, len(c.turn) - 1)])
        M = (c.P[j][:, :3, :3].transpose(0, 2, 1) @ c.moment(c.at[:, j], j)[0][..., None])[..., 0]
        M -= np.outer(M @ c.arm["axis"][j], c.arm["axis"][j])
        s = np.linalg.norm(M, axis=1, keepdims=True)
        if s.std() < .1 * s.mean() or s.mean() < .05 * np.abs(c.tau).max(): raise ValueError
        return c.before(j, None, M / s * np.maximum(0, s - np.quantile(s, r.uniform(.3, .6)))), [j]
    if kind == "mesh_stiffness":
        j = one_of(c, loaded(c))
        return c.dq(j, c.tau[:, j] * (.35 + np.cos(r.integers(2, 6) * q[:, j] + r.uniform(0, 6.3)))), [j]
    if kind == "tooth_skip":
        j = one_of(c, c.turn[:-1])
        i = np.arange(N) / N
        return c.dq(j, ((i >= r.uniform(.15, .45)) & (i < r.uniform(.6, .85))) * 1.), [j]
    if kind == "edm_cyclic":
        s = np.linalg.norm(c.p, axis=1, keepdims=True)
        return {"tip": c.p / s * np.cos(2 * np.pi * s / (reach * r.uniform(.06, .35)) + r.uniform(0, 6.3))}, [-1]
    if kind == "target_incidence":
        u = c.p / np.linalg.norm(c.p, axis=1, keepdims=True)
        z = c.E[:, :3, :3] @ (rot(r.uniform(-3, 3, 3)) @ up)
        return {"tip": u * (1 - (u * z).sum(1, keepdims=True) ** 2)}, [-1]
    if kind == "rail_straightness":
        j = one_of(c, [k for k in range(c.n) if c.arm["type"][k] == S])
        w = 2 * np.pi * r.uniform(.7, 2.2) / np.ptp(q[:, j])
        e1, e2 = across(c.arm["axis"][j])
        f, g, b = r.uniform(0, 6.3), r.uniform(0, 6.3), r.uniform(.3, 1)
        y, z = np.cos(w * q[:, j, None] + f), b * np.cos(w * q[:, j, None] + g)
        dy, dz = -w * np.sin(w * q[:, j, None] + f), -w * b * np.sin(w * q[:, j, None] + g)
        after = np.zeros((N, c.n, 6))
        after[:, j, :3], after[:, j, 3:] = y * e1 + z * e2, dy * np.cross(c.arm["axis"][j], e1) + dz * np.cross(c.arm["axis"][j], e2)
        return {"after": after}, [j]
    if kind == "differential_gear":
        j = one_of(c, [k for k in c.turn[1:] if k + 1 in c.turn])
        k, (f, g), b = int(r.integers(1, 4)), r.uniform(0, 6.3, 2), r.uniform(.4, 1)
        e1, e2 = np.cos(k * (q[:, j] + q[:, j + 1]) + f), b * np.cos(k * (q[:, j] - q[:, j + 1]) + g)
        d = c.dq(j, (e1 + e2) / 2)
        d["dq"][:, j + 1] = (e1 - e2) / 2
        return d, [j, j + 1]
    if kind == "inertia_windup":
        h, cogs = 1e-3, []
        for t in (c.time - h, c.time, c.time + h):
            F = frames(c.arm, c.path(t))[1]
            cogs.append(np.stack([T[:, :3, :3] @ c.arm["cog"][k] + T[:, :3, 3] for k, T in enumerate(F)], 1))
        acc = (cogs[0] - 2 * cogs[1] + cogs[2]) / h**2
        return c.springs(c.torque(c.cogs, -acc * c.arm["mass"][:, None])), c.turn
    # near misses
    if kind == "hardening_spring":
        j = one_of(c, loaded(c))
        x = c.tau[:, j] / np.abs(c.tau[:, j]).max()
        return c.dq(j, np.cbrt(x) if r.random() < .5 else x**3), [j]
    if kind == "quadratic_damping":
        j = c.joint()
        return c.dq(j, -c.velocity[:, j] * np.abs(c.velocity[:, j])), [j]
    if kind == "rocking_base":
        M = (c.moment(np.ones((N, 1)) * c.arm["base"][:3, 3], 0)[0] @ c.arm["base"][:3, :3])[:, :2]
        f = r.uniform(0, 6.3)
        d = np.array([np.cos(f), np.sin(f)])
        s = np.sign(M @ d - np.quantile(M @ d, r.uniform(.3, .7)))
        return {"base": np.c_[np.zeros((N, 3)), s[:, None] * d, np.zeros(N)]}, [-1]
    if kind == "cam_coupling":
        j = c.joint()
        by = int(r.choice([k for k in c.turn if k != j]))
        return c.dq(j, np.cos(r.integers(1, 4) * q[:, by] + r.uniform(0, 6.3))), [j]
    if kind == "settling": return {"base": (1 - np.exp(-c.time / (c.time[-1] * r.uniform(.03, .2))))[:, None] * c.twist()}, [-1]
    if kind == "soft_stop":
        j = c.joint(turning=False)
        s = q[:, j] * r.choice([-1, 1])
        return c.dq(j, np.maximum(0, s - np.quantile(s, r.uniform(.6, .85)))), [j]
    raise KeyError(kind)
FAMILIES = ["six", "seven", "scara", "gantry", "crane", "five", "four", "roll4"]
ONLY = {"rail_straightness": ["scara", "gantry", "crane"], "differential_gear": ["six", "seven", "five", "roll4", "gantry"],
        "target_incidence": ["six", "seven", "crane", "five", "gantry", "roll4"]}
HEAVY = ["six", "seven", "crane", "five", "four", "roll4"]
for name in ("waterline", "current_drag", "bearing_tilt", "mesh_stiffness", "hardening_spring", "rocking_base", "inertia_windup", "joint_compliance",
             "payload", "base_compliance"):
    ONLY[name] = HEAVY
OUTSIDE = ["current_drag", "waterline", "bearing_wobble", "bearing_tilt", "mesh_stiffness", "tooth_skip", "edm_cyclic", "target_incidence",
           "rail_straightness", "differential_gear", "inertia_windup"]
NEAR = ["hardening_spring", "quadratic_damping", "rocking_base", "cam_coupling", "settling", "soft_stop"]
CONFOUNDED = ["slip_or_change", "shift_or_drift", "scale_or_coupling", "base_or_shoulder", "compliance_or_wave", "payload_or_compliance"]
def sized(c, add, ratio):
    """Size at which the effect leaves ratio · sigma (rms over coordinates) beside geometry; ValueError where that is not plausible."""
    size = 1e-6 / max(np.abs(v).max() for v in add.values())
    for _ in range(3):
        rms = np.sqrt(np.mean(c.left(c.signal(add, size)) ** 2))
        if not rms > 0: raise ValueError("nothing seen")
        size *= ratio * c.sigma / rms
    whole = c.signal(add, size)
    if np.abs(whole).max() > .02 * c.arm["reach"] + .003 or any(np.abs(v).max() * size > .03 for k, v in add.items() if k != "grow"):
        raise ValueError("too large to be plausible")
    return size, whole
# ---------------------------------------------------------------- groups
def plan():
    out, r = [], np.random.default_rng(SEED)
    def names(first, m):
        while True:
            x = [first] + list(r.choice(LIBRARY, m - 1, replace=False))
            if len(set(x)) == m and not {"tool_slip", "tool_change"} <= set(x): return x
    for k in range(200):
        out.append(("library", names(LIBRARY[k % 18], int(r.choice([1, 2, 3], p=[.5, .3, .2]))), [1, 2, 4][k // 18 % 3]))
    out += [("library", names(LIBRARY[k % 18], int(r.choice([1, 2], p=[.8, .2]))), .5) for k in range(60)]
    out += [("outside", k, [1, 2, 4][i % 3]) for k in OUTSIDE for i in range(26)]
    out += [("near", k, [1, 2, 4][i % 3]) for k in NEAR for i in range(14)]
    out += [("confounded", CONFOUNDED[i % 6], [2, 4][i // 6 % 2]) for i in range(50)]
    return out + [("clean", "clean", 0)] * 200
PLAN = plan()

def build_library(r, names, ratio):
    allowed = [f for f in FAMILIES if all(f in ONLY.get(k, FAMILIES) for k in names)]
    want = {w for k in names for w in NEEDS.get(k, [])} | ({"time"} if r.random() < .2 else set()) | ({"session"} if r.random() < .1 else set())
    c = Context(r, make_arm(r, r.choice(allowed)), want)
    adds, truth, sizes, step = [], [], [], None
    for name in names:
        if name == "quantisation":
            u = r.uniform(-.5, .5, (c.N, c.n))
            u[:, [k for k in range(c.n) if k not in c.turn]] = 0
            step, whole = sized(c, {"dq": u}, ratio)      # true less logged, of multiples of the step
            truth, sizes = truth + [[name, -1]], sizes + [{"step": step}]
            continue
        add, j, par = library_effect(c, name)
        size, whole = sized(c, add, ratio)
        if [name, j] in truth: raise ValueError
        skip = {("joint_map", j), ("joint_harmonic", j)} if name in ("joint_harmonic", "joint_scale", "joint_map") else set()
        if name not in ("outliers", "range_noise") and c.N <= 300:
            rival = explained(c, whole, 1, {(name, j)} | skip)
            if rival and rival[0][2] > .95: raise ValueError("another cause would do as well")
        adds.append({k: v * size for k, v in add.items()})
        truth.append([name, j])
        sizes.append({k: (v[0] * size if isinstance(v, tuple) else v) for k, v in par.items()})
    total = {k: sum(a[k] for a in adds if k in a) for k in {k for a in adds for k in a}}
    p = tip(c.arm, c.q, total)
    if step:        # the arm stands at q (multiples of the step + rest), the log has the multiples alone
        c.q = np.where(np.isin(np.arange(c.n), c.turn), np.round(c.q / step) * step, c.q)
    return c, p, truth, sizes, []
def build_new(r, kind, ratio, group, last):
    c = Context(r, make_arm(r, r.choice(ONLY.get(kind, FAMILIES))), set(NEEDS.get(kind, [])) | ({"time"} if r.random() < .2 else set()))
    add, joints = new_effect(c, kind)
    size, whole = sized(c, add, ratio)
    c.greedy = explained(c, whole, 3)
    if group == "outside" and c.greedy[-1][2] > .8:
        if not last: raise ValueError("the library explains it")
        c.moved = True
    return c, c.p + whole, [[kind, j] for j in joints], [], []

def build_confounded(r, kind, ratio):
    N = int(r.integers(90, 220))
    half = (np.arange(N) >= N // 2).astype(int)
    kw, t = {}, None
    special = {"payload_or_compliance": "gantry", "base_or_shoulder": "four"}
    arm = make_arm(r, special[kind] if kind in special else r.choice(HEAVY if kind == "compliance_or_wave" else FAMILIES))
    lo, hi, n = arm["lo"], arm["hi"], len(arm["type"])
    q = lo + r.random((N, n)) * (hi - lo)
    turn = [k for k in range(n) if arm["type"][k] == R]
    if kind in ("slip_or_change", "shift_or_drift"): kw["session"] = half
    if kind == "shift_or_drift": t = np.sort(r.uniform(0, 40, N)) + half * 2e5
    if kind == "scale_or_coupling":
        j, by = r.choice(turn, 2, replace=False)
        q[:, by] = r.uniform(.4, .9) * q[:, j] + r.normal(0, 1e-3, N)
    if kind == "base_or_shoulder":        # the shoulder in the foot's own middle, all masses in the arm's plane
        arm["rpy"][:], j = 0, 1
        arm["xyz"][:2], arm["xyz"][2, 1], arm["cog"][:, 1] = 0, 0, 0
        arm["origin"] = [rigid(x) for x in arm["xyz"]]
    if kind == "compliance_or_wave":
        j = 1
        narrow = [k for k in range(2, n)]
        q[:, narrow] = ((lo + hi) / 2)[narrow] + r.uniform(-.3, .3, len(narrow)) + r.normal(0, 2e-3, (N, len(narrow)))
    if kind == "payload_or_compliance":
        arm["rpy"][:], j = 0, 4
        arm["origin"] = [rigid(x) for x in arm["xyz"]]
        arm["tool"] = rigid([0.3 * arm["reach"] * r.uniform(.5, 1), 0, 0])
        arm["cog"][4] = arm["tool"][:3, 3] * r.uniform(.4, .8)
    c = Context(r, arm, {"time"} if t is not None else set(), q, t, N, **kw)
    true = {"slip_or_change": ["tool_slip", "tool_change"], "shift_or_drift": ["base_shift", "drift"], "scale_or_coupling": ["joint_scale", "joint_coupling"],
            "base_or_shoulder": ["base_compliance", "joint_compliance"], "compliance_or_wave": ["joint_compliance", "joint_harmonic"],
            "payload_or_compliance": ["payload", "joint_compliance"]}[kind]
    which = int(r.integers(0, 2))
    one, other = true[which], true[1 - which]
    at = lambda name: -1 if name in ("tool_slip", "tool_change", "base_shift", "drift", "base_compliance", "payload") else int(j)
    if kind == "slip_or_change":
        add = c.before(c.n, half[:, None] * r.normal(0, 1, 3))
    elif kind == "shift_or_drift":
        add = {"base": (half if one == "base_shift" else t / t[-1])[:, None] * c.twist()}
    elif kind == "scale_or_coupling":
        add = c.dq(j, q[:, j] if which == 0 else q[:, by])
    else:
        add = c.dq(j, c.tau[:, j])
        if one in ("payload", "base_compliance"): add = library_effect(c, one)[0]
        if one == "joint_harmonic":        # the wave whose phase is that of the load
            wave = np.c_[np.cos(q[:, j]), np.sin(q[:, j])]
            add = c.dq(j, wave @ np.linalg.lstsq(np.c_[wave, np.ones(N)], c.tau[:, j])[0][:2])
    size, whole = sized(c, add, ratio)
    # the other one must explain what this one leaves: its best fit within noise
    lib = [X for name, k, X in library_columns(c) if (name, k) == (other, at(other))]
    res = c.left(whole.ravel())[:, 0]
    gaps = [np.sum((res - X @ np.linalg.lstsq(X, res, rcond=1e-9)[0]) ** 2) / c.sigma**2 for X in lib]
    if other == "tool_slip": gaps = [0.]        # the same columns: its moment is the border of the sessions
    if not gaps or min(gaps) > 2: raise ValueError("told apart")
    return c, c.p + whole, [[one, at(one)]], [], [[one, at(one)], [other, at(other)]]
def build_clean(r):
    want = {w for w, pr in (("time", .3), ("session", .2), ("direction", .2), ("temperature", .2), ("traj", .15)) if r.random() < pr}
    c = Context(r, make_arm(r, r.choice(FAMILIES)), want)
    return c, c.p, [], [], []
def case(i):
    """Deterministic by SEED and i: a draw that is not plausible, or that the library explains where it should not, is drawn again."""
    group, kind, ratio = PLAN[i]
    for attempt in range(400):
        r = np.random.default_rng([SEED, i, attempt])
        try:
            c, p, truth, sizes, alt = (build_library(r, kind, ratio) if group == "library" else build_confounded(r, kind, ratio)
                                       if group == "confounded" else build_clean(r) if group == "clean" else build_new(r, kind, ratio, group, attempt >= 25))
            break
        except ValueError:
            continue
    else:
        raise RuntimeError(f"case {i}: no draw would do")
    return dict(i=i, group="near" if getattr(c, "moved", False) else group, kind="+".join(kind) if group == "library" else kind, ratio=ratio,
                truth=truth, sizes=sizes, acceptable=alt, urdf=urdf(c.nominal), base=c.nominal["base"], q=c.q, p=p + r.normal(0, c.sigma, p.shape),
                covariates=c.cov, sigma=c.sigma, pattern=str(c.pattern), family=c.nominal["family"], N=c.N, attempt=attempt,
                greedy=getattr(c, "greedy", None))

"""Cases of round 2: arms, poses and causes of error from physics alone; case(i) is deterministic.

Frames as in a URDF (origin, axis); everything is reckoned in the instrument's frame, metres, radians, kg.
A world w holds the true arm, recorded q, times and the frames of every pose; a cause is a function
cause(S, size) that adds to the state S: joint values, small motions (shift, turn) of base, of the frames
before each joint, of the tool, and a vector added to the seen tip.
"""
import numpy as np

SEED = 20262
G = np.array([0.0, 0.0, -9.80665])
PAIRS = [("scale_or_coupling", 18), ("coupling_or_coupling", 16), ("slip_or_change", 12), ("compliance_or_harmonic", 14)]
OUTSIDE = ["port_refraction", "instrument_circle", "sun_bow", "stray_field", "jet_thrust",
           "traction_slip", "creep_spring", "shutter_blur", "sheath_wrap", "radial_play"]
OFTEN_NEAR = ["sun_bow", "stray_field", "jet_thrust", "traction_slip", "shutter_blur", "radial_play"]
NEAR = ["wet_weight", "telescope_bend", "chipped_tooth", "elbow_mass", "tool_rattle", "thermal_lag", "drift_daily"]
LIBRARY = ["joint_harmonic", "joint_map", "joint_scale", "joint_coupling", "backlash", "joint_compliance", "link_compliance", "payload", "base_shift",
           "base_compliance", "tool_slip", "tool_change", "thermal", "drift", "clock_shift", "outliers", "range_noise", "quantisation"]

def table():
    """All cases in order: (group, kind or first effect, ratio, count within the kind)."""
    rows = [("library", LIBRARY[k % 18], (1, 2, 4)[k // 18 % 3], k) for k in range(300)]
    rows += [("library_half", LIBRARY[k % 18], 0.5, k) for k in range(100)]
    rows += [("outside", name, (1, 2, 4)[k % 3], k) for name in OUTSIDE for k in range(32)]
    rows += [("near", name, (1, 2, 4)[k % 3], k) for name in NEAR for k in range(12)]
    rows += [("near", name, (1, 2, 4)[k % 3], k) for name in OFTEN_NEAR for k in range(4)]  # those that the 80 % rule moves
    rows += [("confounded", name, (1, 2, 4)[k % 3], k) for name, count in PAIRS for k in range(count)]
    rows += [("clean", "clean", 0, k) for k in range(250)]
    return [rows[k] for k in np.random.default_rng(SEED).permutation(len(rows))]

def rotation(v):
    """Rotation matrices (..., 3, 3) of rotation vectors."""
    v = np.asarray(v, float)
    angle = np.linalg.norm(v, axis=-1)[..., None, None]
    x, y, z = np.moveaxis(v, -1, 0)
    K = np.stack([0 * x, -z, y, z, 0 * x, -x, -y, x, 0 * x], -1).reshape(v.shape[:-1] + (3, 3))
    return np.eye(3) + np.sinc(angle / np.pi) * K + 0.5 * np.sinc(angle / (2 * np.pi)) ** 2 * (K @ K)

def motion(twist):
    """Rigid motions (..., 4, 4) of (shift, rotation vector)."""
    twist = np.asarray(twist, float)
    T = np.zeros(twist.shape[:-1] + (4, 4))
    T[..., :3, :3], T[..., :3, 3], T[..., 3, 3] = rotation(twist[..., 3:]), twist[..., :3], 1
    return T

# name: joints (R or P, axis, origin seen from the frame before, half range or (lower, upper))
FAMILIES = {
    "reef4": [("R", "z", (0, 0, .2), 1.6), ("R", "y", (.08, .03, .1), 1.0), ("R", "y", (.45, -.05, 0), 1.1), ("R", "x", (.3, 0, .04), 2.0)],
    "probe5": [("R", "z", (0, 0, .15), 1.4), ("R", "y", (.05, 0, .1), .9), ("R", "y", (.25, .06, 0), 1.1), ("R", "y", (.6, 0, .02), 1.2), ("R", "x", (.1, .02, 0), 2.4)],
    "boom5": [("R", "z", (0, 0, .3), 1.5), ("R", "y", (.1, 0, .1), .8), ("P", "x", (.3, 0, .05), (.05, .65)), ("R", "y", (.2, .03, 0), 1.3), ("R", "x", (.12, 0, .02), 2.2)],
    "snake6": [("R", "y", (0, 0, .1), 1.0), ("R", "z", (.15, 0, 0), 1.0), ("R", "y", (.17, .01, 0), 1.0), ("R", "z", (.17, 0, .01), 1.0), ("R", "y", (.16, 0, 0), 1.1), ("R", "x", (.1, .03, 0), 2.0)],
    "slim7": [("R", "z", (0, 0, .2), 1.7), ("R", "y", (0, .04, .1), 1.1), ("R", "x", (.2, -.03, 0), 1.7), ("R", "y", (.2, 0, .02), 1.3), ("R", "x", (.18, .02, 0), 1.7), ("R", "y", (.2, 0, 0), 1.4), ("R", "x", (.06, 0, .03), 2.0)],
    "scara4": [("R", "z", (0, 0, .3), 1.6), ("R", "z", (.45, 0, .05), 1.8), ("P", "z", (.4, 0, 0), (-.35, 0)), ("R", "z", (.02, .02, -.1), 2.5)],
    "rail5": [("P", "y", (0, 0, .1), (-.5, .5)), ("R", "z", (0, 0, .1), 1.5), ("R", "y", (.06, 0, .15), .9), ("R", "y", (.4, .04, 0), 1.1), ("R", "x", (.35, 0, .03), 2.2)],
    "hull5": [("R", "y", (0, 0, .1), 1.2), ("R", "z", (.2, 0, .05), 1.2), ("R", "y", (.35, .02, 0), 1.3), ("R", "x", (.3, 0, .02), 2.0), ("R", "y", (.12, .03, 0), 1.4)],
}
REACH = {"reef4": (.4, .9), "probe5": (1, 2.2), "boom5": (1.5, 3), "snake6": (.7, 1.5), "slim7": (.8, 1.3),
         "scara4": (.6, 1.2), "rail5": (.8, 1.6), "hull5": (.7, 1.8)}
TILTED = {"scara4": (.5, .9), "rail5": (.1, .4)}  # of the whole arm about a level axis [rad]

def make_arm(rng, family, near_instrument):
    """A nominal arm of the family: lengths, skews, masses at random; placed before the instrument."""
    joints, reach = FAMILIES[family], rng.uniform(*REACH[family])
    scale, origins = reach / (sum(np.linalg.norm(j[2]) for j in joints) + .15), []
    for k, (kind, axis, xyz, _) in enumerate(joints):
        xyz = scale * np.array(xyz) * rng.uniform(.85, 1.15) + (k > 0) * rng.normal(0, .01 * reach, 3)
        turn = np.zeros(3)
        if k and joints[k - 1][1] != axis and rng.random() < .3:
            turn = rng.uniform(-.25, .25, 3)  # a skew joint; neighbours that are to be parallel stay so
        if k == 0 and family in TILTED:
            turn[:2] = rng.uniform(*TILTED[family]) * unit(rng.normal(size=2))
        origins.append(motion(np.r_[xyz, turn]))
    span = np.array([scale * np.array(j[3]) if j[0] == "P" else (-j[3], j[3]) for j in joints])
    middle = span.mean(1) + [(j[0] == "R") * rng.uniform(-.35, .35) for j in joints]
    half = np.ptp(span, axis=1) / 2 * rng.uniform(.75, 1, len(span))
    n = len(joints)
    ends = [o[:3, 3] for o in origins[1:]] + [np.array([.1 * reach, 0, 0])]
    far, around = reach * rng.uniform(.6, .9) + (not near_instrument) * rng.uniform(1, 3), rng.uniform(-.4, .4)
    return dict(
        family=family, reach=reach, kinds=[j[0] for j in joints], origins=origins, lower=middle - half, upper=middle + half,
        axes=np.array([np.eye(3)["xyz".index(j[1])] for j in joints]), mass=12 * reach ** 2 * rng.uniform(.4, 1.4, n) / (1 + np.arange(n)) ** .7,
        center=np.array([rng.uniform(.3, .7) * e + rng.normal(0, .02 * reach, 3) for e in ends]),
        base=motion([far * np.cos(around), far * np.sin(around), rng.uniform(-.8, .1) * min(1, reach), 0, 0, rng.uniform(-np.pi, np.pi)]),
        tool=motion(np.r_[reach * rng.uniform(.06, .15), rng.uniform(-.05, .05, 2) * reach, rng.normal(0, .2, 3)]))

def with_errors(rng, arm):
    """The arm as built: small errors of all origins and axes, of base and tool placement."""
    def error():
        shift, turn = 10 ** rng.uniform(-4, -2.7), np.radians(10 ** rng.uniform(-1.7, -.53))
        return motion(np.r_[shift * unit(rng.normal(size=3)), turn * unit(rng.normal(size=3))])
    return dict(arm, origins=[o @ error() for o in arm["origins"]], base=arm["base"] @ error(), tool=arm["tool"] @ error())

def urdf(arm):
    """Text of the nominal arm's URDF (axes and origins, masses, limits); base and tool are not in it."""
    text = lambda v: " ".join(repr(float(x)) for x in v)
    rpy = lambda R: (np.arctan2(R[2, 1], R[2, 2]), np.arcsin(-R[2, 0]), np.arctan2(R[1, 0], R[0, 0]))
    out = ['<robot name="%s"><link name="link_0"/>' % arm["family"]]
    for k, o in enumerate(arm["origins"]):
        out.append(f'''<link name="link_{k + 1}"><inertial><origin xyz="{text(arm["center"][k])}" rpy="0 0 0"/><mass value="{arm["mass"][k]:.17g}"/>
            <inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial></link>
            <joint name="joint_{k + 1}" type="{"prismatic" if arm["kinds"][k] == "P" else "revolute"}">
            <origin xyz="{text(o[:3, 3])}" rpy="{text(rpy(o[:3, :3]))}"/><parent link="link_{k}"/><child link="link_{k + 1}"/>
            <axis xyz="{text(arm["axes"][k])}"/><limit lower="{arm["lower"][k]:.17g}" upper="{arm["upper"][k]:.17g}" velocity="3" effort="1000"/></joint>''')
    return "\n".join(out + ["</robot>"])

def chain(arm, q, base=None, before=None, tool=None):
    """Frames before (N, n, 4, 4) and behind each joint's motion, and tips (N, 3)."""
    N, n = q.shape
    T = np.broadcast_to(arm["base"], (N, 4, 4)) @ (np.eye(4) if base is None else motion(base))
    first, then = [], []
    for k in range(n):
        T = T @ arm["origins"][k] @ (np.eye(4) if before is None else motion(before[:, k]))
        first.append(T)
        step = q[:, k, None] * arm["axes"][k]
        T = T @ motion(np.concatenate([step, 0 * step] if arm["kinds"][k] == "P" else [0 * step, step], 1))
        then.append(T)
    T = T @ arm["tool"] @ (np.eye(4) if tool is None else motion(tool))
    return np.stack(first, 1), np.stack(then, 1), T[:, :3, 3], T

def poses(rng, arm, style, N):
    """Recorded joint values (N, n), their rates, and times [s]."""
    low, high = arm["lower"], arm["upper"]
    n, span = len(low), high - low
    t, rate = np.cumsum(rng.uniform(8, 25, N)), None
    if style == "path":  # measured on the move, sums of sines
        t = np.arange(N) * .25
        w = 2 * np.pi * rng.uniform(.02, .12, (n, 3))
        phase, part = rng.uniform(0, 2 * np.pi, (n, 3)), rng.dirichlet(np.ones(3) * 3, n)
        arg = w[None] * t[:, None, None] + phase
        q = (low + high) / 2 + span / 2 * (part * np.sin(arg)).sum(2)
        rate = span / 2 * (part * w * np.cos(arg)).sum(2)
    elif style == "clusters":
        centers = low + span * rng.random((rng.integers(10, 18), n))
        q = centers[np.sort(rng.integers(0, len(centers), N))] + rng.normal(0, .07, (N, n)) * span
    elif style == "grid":
        levels = rng.integers(3, 6, n)
        q = low + span * (rng.integers(0, levels + 1, (N, n)) / levels + rng.normal(0, .02, (N, n)))
    elif style == "repeats":
        few = low + span * rng.random((-(-N // 3), n))
        q = np.concatenate([few[rng.permutation(len(few))] for _ in range(3)])[:N]
    else:
        q = low + span * rng.random((N, n))
    return np.clip(q, low, high), rate, t

def refresh(w):
    """Frames, tips, gravity, and the projection beside fitted geometry at the recorded joint values."""
    arm = w["arm"]
    w["turning"] = [k for k, kind in enumerate(arm["kinds"]) if kind == "R"]
    w["first"], w["then"], w["tips"], w["flange"] = chain(arm, w["q"])
    R, w["at"] = w["first"][..., :3, :3], w["first"][..., :3, 3]
    w["axis"] = np.einsum("nkij,kj->nki", R, arm["axes"])
    w["cg"] = np.einsum("nkij,kj->nki", w["then"][..., :3, :3], arm["center"]) + w["then"][..., :3, 3]
    w["g"] = arm["base"][:3, :3] @ G
    w["weight"] = arm["mass"][None, :, None] * w["g"] * np.ones((len(w["q"]), 1, 1))
    frames = [(0 * R[:, 0] + arm["base"][:3, :3], arm["base"][:3, 3]), (w["flange"][:, :3, :3], w["tips"])]
    frames += [(R[:, k], w["at"][:, k]) for k in range(R.shape[1])]
    J = np.concatenate([f for F, o in frames for f in (F, np.cross(F, (w["tips"] - o)[..., None], axis=1))], 2).reshape(3 * len(w["q"]), -1)
    w["geometry"] = basis(J / np.maximum(np.linalg.norm(J, axis=0), 1e-6))

def beside(w, e):
    """What of tip displacements e (N, 3[, m]) is left beside fitted geometry, as (3N[, m])."""
    e = e.reshape((3 * len(w["q"]),) + e.shape[2:])
    return e - w["geometry"] @ (w["geometry"].T @ e)

def rms(x):
    return float(np.sqrt(np.mean(np.square(x))))
def unit(v):
    return v / np.maximum(np.linalg.norm(v, axis=-1, keepdims=True), 1e-12)
def basis(columns, floor=0.0):
    """Orthonormal columns that span the same."""
    U, s, _ = np.linalg.svd(columns, full_matrices=False)
    return U[:, s > max(1e-6 * s[0], floor)]

def torque(w, points=None, forces=None):
    """Torque (N, n) on each joint of forces at points (N, n, 3), one a link; gravity's unless given."""
    points, forces = (w["cg"], w["weight"]) if forces is None else (points, forces)
    out = np.zeros(w["q"].shape)
    for j in range(out.shape[1]):
        for k in range(j, out.shape[1]):
            moment = forces[:, k] if w["arm"]["kinds"][j] == "P" else np.cross(points[:, k] - w["at"][:, j], forces[:, k])
            out[:, j] += (w["axis"][:, j] * moment).sum(1)
    return out

def seen(w, causes):
    """Tips as seen (N, 3), without noise, with causes [(cause, size)]."""
    N, n = w["q"].shape
    S = dict(q=w["q"].copy(), base=np.zeros((N, 6)), before=np.zeros((N, n, 6)), tool=np.zeros((N, 6)), add=np.zeros((N, 3)))
    for cause, size in causes:
        cause(S, size)
    return chain(w["arm"], S["q"], S["base"], S["before"], S["tool"])[2] + S["add"]

def sized(w, cause, ratio):
    """The size at which a cause leaves ratio · sigma beside geometry; and its share that is left."""
    size, share = 1e-5, 0
    for _ in range(5):
        e = seen(w, [(cause, size)]) - w["tips"]
        left = rms(beside(w, e))
        share, size = left / (rms(e) + 1e-30), size * ratio * w["sigma"] / (left + 1e-30)
    return size, share

def on(part, values):
    def cause(S, size):
        S[part] += size * values
    return cause
def on_joint(w, j, values):
    return on("q", np.eye(w["q"].shape[1])[j] * values[:, None])
def at_frame(w, k, twists):
    """Motions of the frame before joint k only, (N, n, 6) of (N, 6)."""
    return np.eye(w["q"].shape[1])[k][None, :, None] * twists[:, None, :]
def any_twist(rng, arm):
    return np.r_[rng.normal(size=3), rng.normal(size=3) / arm["reach"]]

def sag(w, forces, link=-1, points=None):
    """Torques (N, n) on the turning joints of forces (N, 3) on one link, at the tip unless at points (N, 3)."""
    F, n = np.zeros(w["cg"].shape), w["q"].shape[1]
    F[:, link] = forces
    points = w["tips"] if points is None else points
    return torque(w, np.repeat(points[:, None], n, 1), F) * np.isin(np.arange(n), w["turning"])

def bend(w, k, telescope=False):
    """Motion (N, 6) of the frame before joint k + 1: link k bends as a cantilever under what it carries."""
    R, end, root = w["first"][:, k + 1, :3, :3], w["first"][:, k + 1, :3, 3], w["first" if telescope else "then"][:, k, :3, 3]
    force = w["weight"][:, k + 1:].sum(1)
    moment = np.cross(w["cg"][:, k + 1:] - end[:, None], w["weight"][:, k + 1:]).sum(1)
    L, along = np.linalg.norm(end - root, axis=1, keepdims=True), unit(end - root)
    across, moment = (v - (v * along).sum(1, keepdims=True) * along for v in (force, moment))
    shift = across * L ** 3 / 3 + np.cross(moment, along) * L ** 2 / 2
    turn = np.cross(along, across) * L ** 2 / 2 + moment * L
    return np.concatenate([np.einsum("nji,nj->ni", R, v) for v in (shift, turn)], 1)

def warmth(w, temperature):
    """Shifts (N, n, 6) of the frames before the joints: all lengths grow with the temperature."""
    growth = np.array([np.r_[o[:3, :3].T @ o[:3, 3], 0, 0, 0] for o in w["arm"]["origins"]])
    return (temperature - temperature.mean())[:, None, None] * growth
def moment(w):
    """Of all the weight about the base, in its frame (N, 3)."""
    return np.cross(w["cg"] - w["arm"]["base"][:3, 3], w["weight"]).sum(1) @ w["arm"]["base"][:3, :3]
def wave(arm, j):
    """The lowest order of a joint's map."""
    return 1.0 if arm["kinds"][j] == "R" else 2 * np.pi / (1.5 * (arm["upper"][j] - arm["lower"][j]))
def loaded(rng, w):
    """A turning joint whose gravity torque changes much."""
    change = torque(w)[:, w["turning"]].std(0)
    return w["turning"][int(rng.choice(np.flatnonzero(change > .15 * change.max())))]

def a_bending_link(rng, w):
    """A long link of which the next axis lies across: else nobody can tell where along the link its bearing sits."""
    def fits(o, axis):
        long = np.linalg.norm(o[:3, 3])
        return long > .12 * w["arm"]["reach"] and abs(o[:3, :3] @ axis @ o[:3, 3]) < .5 * long
    return int(rng.choice([k for k in w["turning"][:-1] if fits(w["arm"]["origins"][k + 1], w["arm"]["axes"][k + 1])] or [0]))

def far_rows(rng, N):
    far, rows = np.zeros((N, 3)), rng.choice(N, max(3, N // 40), replace=False)
    far[rows] = unit(rng.normal(size=(len(rows), 3))) * rng.uniform(1, 2, (len(rows), 1))
    return far

def library_effect(rng, w, name):
    """cause, joint or None, true parameters (per size; but order and by)."""
    arm, q, N = w["arm"], w["q"], len(w["q"])
    n, turning = q.shape[1], w["turning"]
    j, any_joint, sign = int(rng.choice(turning)), int(rng.integers(n)), float(rng.choice([-1, 1]))
    order = float(rng.choice([1, 2, 3, 4, rng.uniform(.8, 7), rng.uniform(8, 25)]))
    by, yields, twist = int(rng.choice([k for k in turning if k != j])), rng.uniform(.7, 1.4, 2), any_twist(rng, arm)
    tool = np.r_[rng.normal(size=3), 0, 0, 0]
    if name == "joint_map":
        j = int(rng.choice([k for k in range(n) if k not in turning or np.ptp(q[:, k]) > 1.8] or turning))
        u, order = q[:, j, None] * wave(arm, j), np.arange(1, rng.integers(4, 8))
        c = rng.normal(size=(2, len(order)))
        return on_joint(w, j, np.cos(order * u) @ c[0] + np.sin(order * u) @ c[1]), j, {}
    if name == "link_compliance":
        k = a_bending_link(rng, w)
        return on("before", at_frame(w, k + 1, bend(w, k))), k, {}
    j = loaded(rng, w) if name == "joint_compliance" else j
    return {
        "joint_harmonic": lambda: (on_joint(w, j, np.cos(order * q[:, j] + rng.uniform(0, 2 * np.pi))), j, {"order": order}),
        "joint_scale": lambda: (on_joint(w, any_joint, sign * q[:, any_joint]), any_joint, {"scale": sign}),
        "joint_coupling": lambda: (on_joint(w, j, q[:, by]), j, {"by": by, "ratio": 1}),
        "backlash": lambda: (on_joint(w, j, -.5 * w["direction"][:, j]), j, {"gap": 1}),
        "joint_compliance": lambda: (on_joint(w, j, torque(w)[:, j]), j, {"compliance": 1}),
        "payload": lambda: (on("q", rng.uniform(.4, 1.6, n) * sag(w, w["g"])), None, {}),
        "base_shift": lambda: (on("base", w["session"][:, None] * twist), None, {}),
        "base_compliance": lambda: (on("base", np.c_[np.zeros((N, 3)), moment(w) * np.r_[yields, 0]]), None,
                                    {"compliance_x": yields[0], "compliance_y": yields[1]}),
        "tool_slip": lambda: (on("tool", (np.arange(N) > rng.uniform(.3, .7) * N)[:, None] * tool), None, {}),
        "tool_change": lambda: (on("tool", w["session"][:, None] * tool), None, {}),
        "thermal": lambda: (on("before", warmth(w, w["temperature"])), None, {}),
        "drift": lambda: (on("base", w["part"][:, None] * twist), None, {}),
        "clock_shift": lambda: (on("q", w["rate"]), None, {"delay": 1}),
        "outliers": lambda: (on("add", far_rows(rng, N)), None, {}),
        "quantisation": lambda: (on("q", rng.uniform(-.5, .5, q.shape)), None, {"step": 1}),
    }[name]()

def sight_to(P, d, m, index):
    """Where the ray from 0 to P (in water) passes the pane (normal m, distance d): the sight and optical length."""
    z, side = P @ m, P - (P @ m)[:, None] * m
    h = np.linalg.norm(side, axis=1)
    low, high = 0 * h, h
    for _ in range(70):  # Snell by bisection
        x = (low + high) / 2
        less = x / np.hypot(x, d) < index * (h - x) / np.hypot(h - x, z - d)
        low, high = np.where(less, x, low), np.where(less, high, x)
    length = np.hypot(x, d)
    return (side * (x / h)[:, None] + d * m) / length[:, None], length + index * np.hypot(h - x, z - d)

def behind_pane(u, optical, d, m, index):
    """The point in water of a sight and optical length, as software reckons it with its pane."""
    c = (u @ m)[:, None]
    hit = u * d / c
    inside = (u - c * m) / index + np.sqrt(1 - (1 - c ** 2) / index ** 2) * m
    return hit + ((optical - np.linalg.norm(hit, axis=1)) / index)[:, None] * inside

def late(t, x, lag):
    """What follows x with a time constant."""
    y = x.copy()
    for k in range(1, len(t)):
        y[k] = x[k] + (y[k - 1] - x[k]) * np.exp(-(t[k] - t[k - 1]) / lag)
    return y

def other_effect(rng, w, name):
    """cause, the library effect that it is near to (or None), the joint."""
    arm, q, N = w["arm"], w["q"], len(w["q"])
    n, turning = q.shape[1], w["turning"]
    j, yields = int(rng.choice([k for k in turning if k >= 2])), rng.uniform(.4, 1.6, n)
    plumb = unit(w["g"])
    if name == "port_refraction":
        m = unit(w["tips"].mean(0))
        d = rng.uniform(.3, .7) * (w["tips"] @ m).min()
        wrong, tilt = rng.normal(0, .3) * d, rng.normal(0, .3, 3)
        def cause(S, size):
            u, optical = sight_to(w["tips"], d + size * wrong, unit(m + size * tilt), 1.333)
            S["add"] += behind_pane(u, optical, d, m, 1.333) - w["tips"]
        return cause, None, None
    if name == "instrument_circle":
        x, y, z = w["tips"].T
        flat, azimuth = np.hypot(x, y), np.arctan2(y, x)
        a, b = rng.uniform(0, 2 * np.pi, 2)
        turn = np.cos(azimuth - a) + .6 * np.cos(2 * azimuth - b) + rng.choice([-1, 1]) * rng.uniform(.8, 2) * z / flat
        return on("add", turn[:, None] * np.stack([-y, x, 0 * x], 1)), None, None
    if name == "sun_bow":
        k = int(rng.integers(arm["family"] != "hull5", n - 1))
        up, around = rng.uniform(.1, .8), rng.uniform(0, 2 * np.pi)
        sun = arm["base"][:3, :3] @ [np.cos(up) * np.cos(around), np.cos(up) * np.sin(around), np.sin(up)]
        R, end = w["first"][:, k + 1, :3, :3], w["first"][:, k + 1, :3, 3]
        along = end - w["first"][:, k, :3, 3]
        L, along = np.linalg.norm(along, axis=1, keepdims=True), unit(along)
        away = -(sun - (along @ sun)[:, None] * along)
        twists = np.concatenate([np.einsum("nji,nj->ni", R, v) for v in (away * L ** 2 / 2, np.cross(along, away) * L)], 1)
        return on("before", at_frame(w, k + 1, twists)), None, k
    if name == "stray_field":
        rotor = w["then"][:, j, :3, :3] @ unit(np.cross(arm["axes"][j], rng.normal(size=3)))
        return on_joint(w, j, rotor @ unit(rng.normal(size=3))), None, j
    if name == "jet_thrust":
        return on("q", yields * sag(w, w["flange"][:, :3, :3] @ unit(np.r_[1, rng.normal(0, .4, 2)]))), None, None
    if name == "traction_slip":
        j = loaded(rng, w)
        return on_joint(w, j, np.cumsum(torque(w)[:, j] * np.abs(np.diff(q[:, j], prepend=q[0, j])))), None, j
    if name == "creep_spring":
        j = loaded(rng, w)
        return on_joint(w, j, late(w["time"], torque(w)[:, j], rng.uniform(1.5, 5) * np.median(np.diff(w["time"])))), None, j
    if name == "shutter_blur":
        h, bow = .05, np.gradient(w["rate"], w["time"], axis=0)
        at = lambda s: chain(arm, q + s * w["rate"] + s * s / 2 * bow)[2]
        return on("add", (at(h) - 2 * at(0) + at(-h)) / h ** 2 / 24), None, None  # size is the exposure squared
    if name == "sheath_wrap":
        wrap = np.abs(q[:, [k for k in turning if k < j]]).sum(1)
        return on_joint(w, j, np.exp(rng.uniform(.3, .7) * wrap) - 1), None, j
    if name == "radial_play":
        across = plumb - (w["axis"][:, j] @ plumb)[:, None] * w["axis"][:, j]
        fall = across / np.sqrt((across ** 2).sum(1, keepdims=True) + .03 ** 2)
        twists = np.c_[np.einsum("nji,nj->ni", w["first"][:, j, :3, :3], fall), np.zeros((N, 3))]
        return on("before", at_frame(w, j, twists)), None, j
    if name == "wet_weight":
        j = loaded(rng, w)
        net = rng.uniform(.1, .9, n)  # of the weight in air
        net[int(rng.integers(j, n))] = rng.uniform(-1.2, -.4)  # foam
        return on_joint(w, j, torque(w, w["cg"], net[None, :, None] * w["weight"])[:, j]), "joint_compliance", j
    if name == "telescope_bend":
        return on("before", at_frame(w, 3, bend(w, 2, telescope=True))), "link_compliance", 2
    if name == "chipped_tooth":
        j = int(rng.choice(turning))
        middle, width = np.quantile(q[:, j], rng.uniform(.25, .75)), rng.uniform(.06, .12)
        return on_joint(w, j, np.exp(-.5 * ((q[:, j] - middle) / width) ** 2)), "joint_map", j
    if name == "elbow_mass":
        k = int(rng.integers(2, n - 1))
        place = w["cg"][:, k] + w["then"][:, k, :3, :3] @ rng.normal(0, .08 * arm["reach"], 3)
        return on("q", yields * sag(w, w["g"], k, place)), "payload", None
    if name == "tool_rattle":
        side = np.sign(w["flange"][:, :3, :3] @ rng.normal(size=3) @ plumb)
        return on("tool", side[:, None] * np.r_[rng.normal(size=3), 0, 0, 0]), "tool_slip", None
    if name == "thermal_lag":
        return on("before", warmth(w, late(w["time"], w["temperature"], rng.uniform(.1, .25) * np.ptp(w["time"])))), "thermal", None
    assert name == "drift_daily"
    return on("base", np.sin(2 * np.pi * rng.uniform(1, 2) * w["part"] + rng.uniform(0, 6.3))[:, None] * any_twist(rng, arm)), "drift", None

def simple_library(w, given):
    """[(name, joint, freedom, basis (3N, m) beside geometry)]; effects of covariates only where given."""
    arm, q, N = w["arm"], w["q"], len(w["q"])
    n, turning, R, lever = q.shape[1], w["turning"], arm["base"][:3, :3], w["tips"] - arm["base"][:3, 3]
    dp = [np.cross(w["axis"][:, j], w["tips"] - w["at"][:, j]) if j in turning else w["axis"][:, j] for j in range(n)]
    load, tip_load, out = torque(w), sag(w, w["g"]), []
    tool = lambda f: [f[:, None] * w["flange"][:, :3, c] for c in range(3)]
    base = lambda f: [f[:, None] * v for c in range(3) for v in (R[:, c] + 0 * lever, np.cross(R[:, c], lever))]
    moved = lambda twists: [1e6 * (seen(w, [(on("before", twists / np.abs(twists).max()), 1e-6)]) - w["tips"])]
    def add(name, joint, freedom, fields):
        out.append((name, joint, freedom, basis(unit(beside(w, np.stack(fields, -1)).T).T)))
    for j in range(n):
        waves = lambda k: [f(k * wave(arm, j) * q[:, j])[:, None] * dp[j] for f in (np.cos, np.sin)]
        for k in (.6, 1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 11, 15, 20):
            add("joint_harmonic", j, 3, waves(k))
        add("joint_map", j, 10, sum((waves(k) for k in (1, 2, 3, 4, 5)), []))
        add("joint_compliance", j, 1, [load[:, j, None] * dp[j]])
        for k in range(n):
            add("joint_scale" if k == j else "joint_coupling", j, 1, [q[:, k, None] * dp[j]])
        if "direction" in given:
            add("backlash", j, 1, [w["direction"][:, j, None] * dp[j]])
    for k in range(n - 1):
        add("link_compliance", k, 1, moved(at_frame(w, k + 1, bend(w, k))))
    add("payload", None, n, [tip_load[:, j, None] * dp[j] for j in turning])
    add("base_compliance", None, 2, [moment(w)[:, c, None] * np.cross(R[:, c], lever) for c in range(2)])
    for k in np.linspace(.08, .92, 15):
        add("tool_slip", None, 4, tool(np.arange(N) > k * N))
    if "session" in given:
        add("tool_change", None, 3, tool(w["session"])), add("base_shift", None, 6, base(w["session"]))
    if "time" in given:
        add("drift", None, 6, base(w["part"]))
        if w["rate"] is not None:
            add("clock_shift", None, 1, [sum(w["rate"][:, j, None] * dp[j] for j in range(n))])
    if "temperature" in given:
        add("thermal", None, 1, moved(warmth(w, w["temperature"])))
    return out

def explained(groups, left, most=3):
    """Share of `left` (3N,) that up to three library effects explain, chosen greedily, and which."""
    have, chosen, rest = np.zeros((len(left), 0)), [], left
    for _ in range(most):
        new = [basis(g[3] - have @ (have.T @ g[3]), 1e-4) for g in groups]
        best = int(np.argmax([np.sum((B.T @ rest) ** 2) for B in new]))
        have = np.c_[have, new[best]]
        rest = left - have @ (have.T @ left)
        chosen.append([groups[best][0], groups[best][1]])
    return 1 - np.sum(rest ** 2) / np.sum(left ** 2), chosen

def nearest_rival(w, groups, causes, names):
    """Least chi² by which another effect of no more freedom could stand for a true one beside the others."""
    freedom, least = {g[0]: g[2] for g in groups}, np.inf
    lefts = [beside(w, seen(w, [c]) - w["tips"]) / w["sigma"] for c in causes]
    for k, name in enumerate(names):
        for g in groups:
            if tuple(g[:2]) != name and g[2] <= freedom[name[0]]:
                B = basis(np.c_[tuple(map(unit, lefts[:k] + lefts[k + 1:])) + (g[3],)])
                least = min(least, np.sum((lefts[k] - B @ (B.T @ lefts[k])) ** 2))
    return float(least)

def world(rng, families, styles, N, near_instrument=False):
    """A case's arm, poses and all that may be recorded with them."""
    nominal = make_arm(rng, str(rng.choice(families)), near_instrument)
    w = dict(nominal=nominal, arm=with_errors(rng, nominal), sigma=10 ** rng.uniform(-4.7, -3.7))
    n = len(nominal["lower"])
    N = max(N, 16 * n)
    w["q"], w["rate"], w["time"] = poses(rng, nominal, str(rng.choice(styles)), N)
    step = w["rate"] if w["rate"] is not None else np.diff(w["q"], axis=0, prepend=w["q"][:1] - rng.choice([-1, 1], n))
    w["direction"] = np.where(step == 0, rng.choice([-1, 1], step.shape), np.sign(step))
    w["session"] = np.searchsorted([.2, .45, .7, .85] + rng.uniform(-.08, .08, 4), np.linspace(0, 1, N)) % 2
    w["part"] = u = (w["time"] - w["time"][0]) / np.ptp(w["time"])
    w["temperature"] = 18 + rng.uniform(3, 10) * (np.sin(rng.uniform(2, 7) * u + rng.uniform(0, 6)) + .3 * np.cumsum(rng.normal(0, N ** -.5, N)))
    refresh(w)
    return w

def case(i):
    group, kind, ratio, count = table()[i]
    for attempt in range(300):
        made = attempt_case(np.random.default_rng([SEED, i, attempt]), group, kind, ratio, count)
        if made is not None:
            return dict(made, i=i, attempt=attempt)
    raise RuntimeError(f"case {i}: {group} {kind}")

NEEDS = {"backlash": "direction", "base_shift": "session", "tool_change": "session", "thermal": "temperature", "drift": "time",
         "clock_shift": "time", "creep_spring": "time", "shutter_blur": "time", "thermal_lag": "temperature time", "drift_daily": "time"}
ONLY = {"telescope_bend": ["boom5"], "port_refraction": ["reef4", "snake6", "slim7", "scara4", "rail5"],
        "radial_play": ["slim7", "snake6", "hull5", "scara4"], "thermal_lag": ["reef4", "probe5", "snake6", "slim7", "hull5"]}
ONLY["wet_weight"] = ONLY["sun_bow"] = ["probe5", "snake6", "slim7", "boom5", "rail5", "hull5"]
ONLY["elbow_mass"] = ONLY["wet_weight"] + ["reef4"]
ALONE = [{"base_shift", "tool_slip", "tool_change"}, {"outliers", "range_noise", "quantisation"}]  # one of them in a case
STILL = ["random", "random", "clusters", "grid", "repeats"]
ALL = list(FAMILIES)

def attempt_case(rng, group, kind, ratio, count):
    N = int(rng.choice([rng.integers(80, 160), rng.integers(140, 250), rng.integers(140, 250), 400 if rng.random() < .2 else 200]))
    given, truth, accept, near, share, chosen, rival, causes, params, extra_noise = set(), [], [], None, None, [], None, [], {}, 0.0
    if group == "clean":
        w = world(rng, ALL, STILL + ["path"], N)
        given |= {c for c in ("time", "temperature", "session", "direction") if rng.random() < .3}
    elif group.startswith("library"):
        names = [kind]
        for _ in range([0, 0, 0, 1, 0, 1, 2][count % 7]):
            taken = set(names).union(*(a for a in ALONE if a & set(names)))
            names.append(str(rng.choice([e for e in LIBRARY if e not in taken])))
        families = [f for f in ALL if f not in ("boom5", "scara4", "rail5") or not {"thermal", "quantisation"} & set(names)]
        w = world(rng, families, ["path"] if "clock_shift" in names else STILL + ["path"], N, "range_noise" in names)
        given |= {c for c in ("time", "temperature", "session", "direction") if rng.random() < .15}
        given |= set(" ".join(NEEDS.get(e, "") for e in names).split())
        extra_noise = ratio if "range_noise" in names else 0.0
        for name in sorted(set(names) - {"range_noise"}, key=lambda e: (e != "quantisation", e)):  # which changes what is recorded
            cause, joint, known = library_effect(rng, w, name)
            size, left = sized(w, cause, ratio)
            if left < .08:
                return None
            if name == "quantisation":
                w["q"] = np.round(w["q"] / size) * size
                refresh(w)
            causes.append((cause, size)), truth.append([name, joint])
            params["%s %s" % (name, joint)] = {k: v * (1 if k in ("order", "by") else size) for k, v in known.items()}
            truth[-1] += [known["by"]] if "by" in known else []
        judged = [(c, tuple(t[:2])) for c, t in zip(causes, truth) if t[0] not in ("outliers", "quantisation")]
        if judged:
            rival = nearest_rival(w, simple_library(w, given), *zip(*judged))
        truth += [["range_noise", None]] if extra_noise else []
    elif group == "confounded":
        w, causes, truth, accept, given, left = confounded(rng, kind, ratio, N, count)
        if left < .08:
            return None
    else:
        still = ["random", "clusters"] if kind in ("traction_slip", "creep_spring", "chipped_tooth") else STILL + ["path"]
        w = world(rng, ONLY.get(kind, ALL), ["path"] if kind == "shutter_blur" else still, N)
        given |= {c for c in ("time", "temperature", "session") if rng.random() < .15} | set(NEEDS.get(kind, "").split())
        cause, near, joint = other_effect(rng, w, kind)
        size, left = sized(w, cause, ratio)
        if left < .04:
            return None
        causes, near = [(cause, size)], [near, joint] if near else None
        share, chosen = explained(simple_library(w, given), beside(w, seen(w, causes) - w["tips"]))
        if kind in OUTSIDE:  # outside where three library effects explain at most 80 %, else a near miss: drawn until it fits
            if (share > .8) == (group == "outside"):
                return None
            near = chosen[0] if group == "near" else None
    p = seen(w, causes)
    measured = [rms(beside(w, seen(w, [c]) - w["tips"])) / w["sigma"] for c in causes]
    away = np.linalg.norm(p, axis=1)
    sd = w["sigma"] * np.sqrt(1 + (extra_noise * away / rms(away)) ** 2)
    p = p + sd[:, None] * rng.normal(size=p.shape)
    return dict(group=group, kind=kind, ratio=ratio, truth=truth, accept=accept, near=near, given=sorted(given),
                nominal=w["nominal"], q=w["q"], p=p, sigma=w["sigma"], covariates={c: w[c] for c in sorted(given)},
                share=share, chosen=chosen, rival=rival, measured=measured, sizes=[c[1] for c in causes], params=params)

def confounded(rng, kind, ratio, N, count):
    """Two causes that these poses cannot tell apart: world, causes, truth, acceptable ones, covariates, share left."""
    other, given, still = count % 2 == 1, set(), ["random", "clusters", "grid"]  # every second time the other one is true
    if kind == "slip_or_change":  # the moment of the slip is that of the change of sessions
        w = world(rng, ALL, still, N)
        w["session"] = (np.linspace(0, 1, len(w["q"])) > rng.uniform(.3, .7)).astype(int)
        given.add("session")
        accept = [["tool_slip", None], ["tool_change", None]]
        cause = on("tool", w["session"][:, None] * np.r_[rng.normal(size=3), 0, 0, 0])
    elif kind == "compliance_or_harmonic":  # all joints beyond the loaded one are locked: its torque is a wave of order 1
        w, j = world(rng, ["reef4", "probe5"], still, min(N, 200)), 1
        w["q"][:, j + 1:] = w["q"][0, j + 1:]
        refresh(w)
        accept = [["joint_compliance", j], ["joint_harmonic", j]]
        cause = on_joint(w, j, torque(w)[:, j])
    else:  # joint l goes with joint k, in proportion; the scaled joint itself, or two joints of which one moves a third along
        scale = kind == "scale_or_coupling"
        w = world(rng, ["reef4", "probe5"] if scale else ["probe5", "snake6", "slim7", "hull5", "rail5"], still, N)
        j, k, l = (1, 1, 2) if scale else [int(x) for x in rng.permutation(w["turning"])[:3]]
        low, high = w["nominal"]["lower"], w["nominal"]["upper"]
        slope = rng.choice([-1, 1]) * rng.uniform(.5, .9) * min(1, (high - low)[l] / (high - low)[k])
        w["q"][:, l] = (low + high)[l] / 2 + slope * (w["q"][:, k] - (low + high)[k] / 2)
        refresh(w)
        accept = [["joint_scale", j] if scale else ["joint_coupling", j, k], ["joint_coupling", j, l]]
        cause = on_joint(w, j, w["q"][:, l if other else k])
    size, left = sized(w, cause, ratio)
    return w, [(cause, size)], [accept[int(other)]], accept, given, left

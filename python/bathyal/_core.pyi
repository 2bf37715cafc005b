"""
The engine. Its public names are those of the package bathyal.
"""
from __future__ import annotations
import bathyal.sonar.record
import bathyal.sonar.survey
import bathyal.view.motion_page
import collections.abc
import matplotlib.figure
import numpy
import numpy.typing
import os
import plotly.graph_objects
import typing
__all__: list[str] = ['Allocation', 'AllocationResult', 'Arm', 'ArmFit', 'ArmMotion', 'ArmOnVehicle', 'BEYOND_NOISE', 'Battery', 'BatteryLoad', 'BehaviorTree', 'Capsule', 'Cause', 'CleanReport', 'CleanResult', 'Clearances', 'Condition', 'CorrectedArm', 'CruiseControl', 'CruiseState', 'Current', 'DhTable', 'Diagnosis', 'DropWeight', 'Effect', 'EffectRange', 'EffectRows', 'Eigenray', 'Error', 'Estimate', 'Fin', 'FitParameter', 'FollowedPath', 'FoundEffect', 'HeldOut', 'HeldOutNested', 'HeldOutPart', 'Hits', 'Hull', 'HullReport', 'InverseResult', 'KeepOut', 'LineOfSight', 'LineOfSightState', 'Link', 'Material', 'MeshReport', 'MissionPlan', 'MissionRun', 'MotionCheck', 'MotionPlan', 'NamedEffect', 'NavigationErrors', 'NavigationFilter', 'NavigationReport', 'NavigationTrack', 'NavigationUpdate', 'Nearest', 'NearestSegments', 'NmeaReader', 'Outlier', 'Ping', 'PingTruth', 'Pipeline', 'Plane', 'PlaneFit', 'PointCloud', 'Polyline', 'PoseHold', 'PoseHoldState', 'Profile', 'ReachMap', 'RigidBody', 'SamplingPhase', 'SamplingPlan', 'Scene', 'SeabedModel', 'Sediment', 'Sensor', 'SensorReadings', 'SerialLine', 'Shape', 'SheetPatch', 'SheetReport', 'SidescanPings', 'Sonar', 'SoundPath', 'Standpoint', 'StaticTrim', 'Structure', 'Support', 'TargetChecks', 'Targets', 'Tether', 'TextTable', 'Thruster', 'ThrusterFit', 'ThrusterTable', 'Tide', 'TipMove', 'ToolPath', 'TouchForecast', 'TouchPlan', 'Touches', 'TracedSound', 'Tracked', 'Trade', 'Trajectory', 'TriangleMesh', 'TrimHold', 'Vehicle', 'VehicleMotion', 'VehicleSystem', 'VehicleSystemState', 'Verification', 'Voxels', 'Water', 'Waves', 'Workspace', 'World', 'WorldObject', 'WorldSnapshot', 'XtfFile', 'absorption', 'allan_deviation', 'ambient_noise', 'ardupilot_json', 'arm_from_chain', 'arm_from_parts', 'arm_parts', 'best_standpoint', 'chain_from_arm', 'check_bytes', 'clean_cloud', 'cover_polygon', 'dead_reckon', 'depth_from_pressure', 'diagnose', 'eigenrays', 'ellipsoid_added_mass', 'find_effect_with', 'find_sheets', 'find_targets', 'fish_paths', 'fit_plane', 'fit_thruster', 'follow_bottom', 'forecast_touches', 'generate_survey', 'identify_arm', 'intersect_moller_trumbore', 'library_effects', 'make_boulder', 'make_cable', 'make_fish', 'make_mine', 'make_pipeline', 'make_seabed', 'make_wreck', 'make_xtf', 'mcap_messages', 'mesh_report', 'nmea_dpt', 'nmea_hdt', 'nmea_position', 'nmea_sentence', 'nmea_vbw', 'parse_xtf', 'pd6_text', 'plan_sampling', 'plan_toolpath', 'plan_touches', 'practical_salinity', 'pressure_from_depth', 'read_mcap', 'read_mesh_with', 'read_pcd', 'read_servo_packet', 'read_text_table', 'seawater_density', 'servo_packet', 'set_simd_level', 'sidescan_bottom', 'sidescan_ground', 'sidescan_mosaic', 'simd_level', 'smooth', 'sound_speed', 'sound_speed_teos10_with', 'survey_height', 'trace_sound', 'triangle_material', 'triangulate', 'triangulate_delaunay', 'typical_sensors', 'verify_positions', 'warn_of_range_with', 'warn_of_support_with', 'with_link_radii', 'write_mcap', 'write_xyz']
class Error(RuntimeError):
    """
    A broken file, a solver that failed or a part that is not installed.
    """
class Plane:
    """
    normal · x = offset.
    
    Filaretov, Konoplin, Konoplin (2018), eq 1: the unit normal m and the distance d.
    
    Parameters
    ----------
    normal : (3,) array
        Any length but zero; scaled to unit length, `offset` with it.
    offset : float
        [m]
    
    Examples
    --------
    >>> import bathyal
    >>> bathyal.Plane((0, 0, 2), -10.0).offset
    -5.0
    """
    def __init__(self, normal: numpy.typing.ArrayLike, offset: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def distance(self, points: numpy.typing.ArrayLike) -> numpy.ndarray:
        """
        Signed distances (N,) [m] of points (N, 3), positive above.
        """
    @property
    def normal(self) -> numpy.ndarray:
        """
        (3,) unit normal, up for a bottom.
        """
    @property
    def offset(self) -> float:
        """
        normal · x of every point of the plane [m].
        """
class PointCloud:
    """
    Positions in metres, z up, and what rides along with them.
    
    Survey coordinates (10⁵ to 10⁷ m) are kept as they are. Read-only once made.
    
    Parameters
    ----------
    points : (N, 3) array
        [m]. Shared, not copied, where it is float64 in C order: do not write to it afterwards. A
        function that is given the cloud works on a copy of what the array holds when it is called.
    attributes : dict of (N,) arrays, optional
        For instance ``uncertainty`` [m], ``intensity``, ``red``, ``green``, ``blue``.
    crs, vertical_datum : str, optional
        Coordinate reference system ("EPSG:…" or WKT) and vertical datum; empty when unknown.
    
    Examples
    --------
    >>> import bathyal
    >>> cloud = bathyal.PointCloud([[0, 0, -5], [1, 0, -5.1]], crs="EPSG:32602")
    >>> len(cloud), cloud.crs
    (2, 'EPSG:32602')
    """
    def __init__(self, points: numpy.typing.ArrayLike, *, attributes: collections.abc.Mapping[str, numpy.typing.ArrayLike] = {}, crs: str = '', vertical_datum: str = '') -> None:
        ...
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    def show(self) -> plotly.graph_objects.Figure:
        """
        An interactive figure: the soundings, coloured by height.
        
        See bathyal.view.scene3d.show_cloud.
        """
    def write(self, path: str | os.PathLike[str]) -> None:
        """
        Write a file of the format its suffix names.
        
        Parameters
        ----------
        path : path
            ``.ply``, ``.vtp``, ``.xyz``, ``.txt`` or ``.csv``: see bathyal.write_cloud.
        """
    @property
    def attributes(self) -> dict:
        """
        What rides along: name → (N,) array.
        """
    @property
    def crs(self) -> str:
        """
        Reference system of x and y, as its file gives it; empty if unknown.
        """
    @property
    def points(self) -> numpy.ndarray:
        """
        (N, 3) positions [m], z up.
        """
    @property
    def vertical_datum(self) -> str:
        """
        What z is measured from; empty if unknown.
        """
class TriangleMesh:
    """
    Vertices and the triangles over them.
    
    Triangles run counter-clockwise seen from outside (from above, for a bottom). Vertices that no
    triangle uses are allowed: a mesh made from a cloud keeps its points row for row.
    
    Parameters
    ----------
    vertices : (N, 3) array
        [m], finite. Shared, not copied, where it is float64 in C order: do not write to it
        afterwards. A Scene keeps a copy.
    triangles : (T, 3) array of int
        Rows of `vertices`. Copied.
    attributes, crs, vertical_datum
        As in PointCloud, one value a vertex.
    
    Examples
    --------
    >>> import bathyal
    >>> bathyal.TriangleMesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    TriangleMesh(3 vertices, 1 triangle)
    """
    def __getstate__(self) -> tuple[numpy.ndarray, numpy.ndarray, dict, str, str]:
        ...
    def __init__(self, vertices: numpy.typing.ArrayLike, triangles: numpy.typing.ArrayLike, *, attributes: collections.abc.Mapping[str, numpy.typing.ArrayLike] = {}, crs: str = '', vertical_datum: str = '') -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    def show(self) -> plotly.graph_objects.Figure:
        """
        An interactive figure: the mesh, coloured by height.
        
        See bathyal.view.scene3d.show_mesh.
        """
    def write(self, path: str | os.PathLike[str]) -> None:
        """
        Write a file of the format its suffix names.
        
        Parameters
        ----------
        path : path
            ``.vtp``, ``.ply``, ``.obj`` or ``.stl``: see bathyal.write_mesh.
        """
    @property
    def attributes(self) -> dict:
        """
        What rides along: name → (N,) array.
        """
    @property
    def crs(self) -> str:
        """
        Reference system of x and y, as its file gives it; empty if unknown.
        """
    @property
    def triangles(self) -> numpy.ndarray:
        """
        (T, 3) int32 rows of `vertices`.
        """
    @property
    def vertical_datum(self) -> str:
        """
        What z is measured from; empty if unknown.
        """
    @property
    def vertices(self) -> numpy.ndarray:
        """
        (N, 3) positions [m], z up.
        """
class MeshReport:
    """
    What a person asks of a mesh before trusting it.
    
    Made by `mesh_report`. Lengths in metres, angles in radians; ``print`` it to read it.
    """
    def __repr__(self) -> str:
        ...
    def __str__(self) -> str:
        ...
    def as_dict(self) -> dict:
        """
        All of it, by name.
        """
    @property
    def area(self) -> float:
        """
        Area of the surface [m²].
        """
    @property
    def area_share_inverted(self) -> float:
        """
        Part of the area that faces down.
        """
    @property
    def boundary_edges(self) -> int:
        """
        Edges of one triangle only.
        """
    @property
    def boundary_loops(self) -> numpy.ndarray:
        """
        Lengths of the rims, longest first [m].
        """
    @property
    def closed(self) -> bool:
        """
        Whether every edge has two triangles, turned consistently.
        """
    @property
    def components(self) -> int:
        """
        Pieces joined by edges.
        """
    @property
    def duplicate_triangles(self) -> int:
        """
        Triangles on the same three vertices as an earlier one.
        """
    @property
    def high(self) -> numpy.ndarray:
        """
        (3,) greatest corner of the bounding box [m].
        """
    @property
    def inconsistent_edges(self) -> int:
        """
        Edges along which their two triangles run the same way.
        """
    @property
    def inverted_triangles(self) -> int:
        """
        Triangles facing down.
        """
    @property
    def low(self) -> numpy.ndarray:
        """
        (3,) least corner of the bounding box of the vertices in use [m].
        """
    @property
    def nonmanifold_edges(self) -> int:
        """
        Edges of three triangles or more.
        """
    @property
    def nonmanifold_vertices(self) -> int:
        """
        Vertices where fans of triangles touch by the vertex alone.
        """
    @property
    def planar_area(self) -> float:
        """
        Area of the shadow on the horizontal plane, every place once [m²].
        """
    @property
    def rugosity(self) -> float:
        """
        area / planar_area; NaN without a shadow.
        """
    @property
    def slope_max(self) -> float:
        """
        [rad]
        """
    @property
    def slope_mean(self) -> float:
        """
        Area-weighted mean angle between normal and up, 0 to π [rad].
        """
    @property
    def slope_median(self) -> float:
        """
        Area-weighted median [rad].
        """
    @property
    def slope_p95(self) -> float:
        """
        95 % of the area is less steep [rad].
        """
    @property
    def triangle_count(self) -> int:
        """
        Triangles of the mesh.
        """
    @property
    def unused_vertices(self) -> int:
        """
        Vertices of no triangle.
        """
    @property
    def vertex_count(self) -> int:
        """
        Vertices, used or not.
        """
    @property
    def volume(self) -> float:
        """
        Volume inside [m³], negative when turned inside out; NaN unless closed.
        """
    @property
    def zero_area_triangles(self) -> int:
        """
        Triangles whose area is 0.
        """
class RigidBody:
    """
    What a body weighs, how it resists turning, and the water it displaces.
    
    All of it in one frame, which the owner names: of a link its own, of a vehicle the vehicle's.
    
    Parameters
    ----------
    mass : float
        [kg]; 0 is unknown.
    center_of_mass : (3,) array
        [m]
    inertia : (3, 3) array, optional
        About the centre of mass [kg m²]; zero, unknown, unless given.
    volume : float
        Displaced water [m³]; 0 is unknown.
    center_of_buoyancy : (3,) array
        [m]
    
    Raises
    ------
    ValueError
        For a mass or volume that is negative or not finite, and an inertia that no body has: not
        symmetric, or with a principal moment that is negative or above the sum of the two others (by
        more than a thousandth of their sum: files round).
    
    Examples
    --------
    >>> import bathyal
    >>> hull = bathyal.RigidBody(20, volume=0.02)
    >>> lead = bathyal.RigidBody(5, center_of_mass=(0, 0, -0.5))
    >>> hull.combined(lead).center_of_mass
    array([ 0. ,  0. , -0.1])
    """
    def __getstate__(self) -> tuple[float, numpy.ndarray, numpy.ndarray, float, numpy.ndarray]:
        ...
    def __init__(self, mass: typing.SupportsFloat | typing.SupportsIndex = 0.0, *, center_of_mass: numpy.typing.ArrayLike = (0, 0, 0), inertia: numpy.typing.ArrayLike | None = None, volume: typing.SupportsFloat | typing.SupportsIndex = 0.0, center_of_buoyancy: numpy.typing.ArrayLike = (0, 0, 0)) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    def combined(self, other: RigidBody) -> RigidBody:
        """
        This body and another of the same frame, fixed to each other (Steiner).
        """
    def in_frame(self, pose: numpy.typing.ArrayLike | None) -> RigidBody:
        """
        The body in the frame of `pose` (4, 4), new_from_body.
        """
    @property
    def center_of_buoyancy(self) -> numpy.ndarray:
        """
        (3,) [m].
        """
    @property
    def center_of_mass(self) -> numpy.ndarray:
        """
        (3,) [m].
        """
    @property
    def inertia(self) -> numpy.ndarray:
        """
        (3, 3) about the centre of mass [kg m²].
        """
    @property
    def mass(self) -> float:
        """
        [kg]; 0 is unknown.
        """
    @property
    def volume(self) -> float:
        """
        Displaced [m³]; 0 is unknown.
        """
class Shape:
    """
    The outline of a body, or a part of it, as a robot's file gives it.
    
    Parameters
    ----------
    kind : str
        "box" (with `size`), "cylinder" (`radius`, `length`), "sphere" (`radius`) or "mesh" (`file`).
    size : (3,) array
        Full lengths of a box along its x, y and z [m].
    radius, length : float
        Of a cylinder, which lies along z with its middle in the origin, and of a sphere [m].
    file : str
        Of a mesh: the name that its owner's file gives. It is never opened here; `bathyal.mesh_path`
        finds it.
    folder : str
        The folder from which a relative `file` starts; empty where it is unknown.
    scale : (3,) array
        Of a mesh along its x, y and z; 1 unless given, negative mirrors.
    pose : (4, 4) array, optional
        body_from_shape: of a link's shape, link_from_shape.
    part : str
        The body that it outlines, where several were made one: a finger of a gripper.
    
    Raises
    ------
    ValueError
        For what the kind has not or lacks, lengths that are negative or not finite, a scale of 0, a
        pose that is not rigid.
    
    Examples
    --------
    >>> import bathyal
    >>> bathyal.Shape("cylinder", radius=0.05, length=0.4)
    Shape("cylinder", radius=0.05, length=0.4)
    """
    def __init__(self, kind: str, *, size: numpy.typing.ArrayLike | None = None, radius: float | None = None, length: float | None = None, file: str | None = None, folder: str = '', scale: numpy.typing.ArrayLike | None = None, pose: numpy.typing.ArrayLike | None = None, part: str = '') -> None:
        ...
    def __reduce__(self) -> tuple[collections.abc.Callable, tuple]:
        ...
    def __repr__(self) -> str:
        ...
    def as_dict(self) -> dict:
        """
        What the constructor takes, without what the kind has not: for files and tables.
        """
    @property
    def file(self) -> str | None:
        """
        Of a mesh, as its owner's file names it; None of the others.
        """
    @property
    def folder(self) -> str:
        """
        Where a relative `file` starts; empty where it is unknown.
        """
    @property
    def kind(self) -> str:
        """
        "box", "cylinder", "sphere" or "mesh".
        """
    @property
    def length(self) -> float | None:
        """
        Of a cylinder [m]; None of the others.
        """
    @property
    def part(self) -> str:
        """
        The body that it outlines; empty where unknown.
        """
    @property
    def pose(self) -> numpy.ndarray:
        """
        (4, 4) body_from_shape.
        """
    @property
    def radius(self) -> float | None:
        """
        Of a cylinder or sphere [m]; None of the others.
        """
    @property
    def scale(self) -> numpy.ndarray | None:
        """
        (3,) of a mesh; None of the others.
        """
    @property
    def size(self) -> numpy.ndarray | None:
        """
        (3,) full lengths of a box [m]; None of the others.
        """
class Trajectory:
    """
    A pose over time.
    
    Between two times the origin moves on a straight line and the frame turns at a constant rate about
    one axis; before the first and after the last time it rests.
    
    Parameters
    ----------
    time : (K,) array
        Rising [s].
    pose : (K, 4, 4) array
        target_from_source at each time: of a vehicle, world_from_vehicle.
    
    Raises
    ------
    ValueError
        For no pose, times that do not rise, another count of poses, or one that is not rigid.
    
    Examples
    --------
    >>> import bathyal, numpy
    >>> pose = numpy.stack([numpy.eye(4), numpy.eye(4)])
    >>> pose[1, 0, 3] = 2.0
    >>> bathyal.Trajectory([0, 4], pose).at(1.0)[:3, 3]
    array([0.5, 0. , 0. ])
    """
    @staticmethod
    def sampled(function: collections.abc.Callable[[float], numpy.typing.ArrayLike], end: typing.SupportsFloat | typing.SupportsIndex, *, start: typing.SupportsFloat | typing.SupportsIndex = 0.0, step: typing.SupportsFloat | typing.SupportsIndex = 0.05) -> Trajectory:
        """
        A trajectory from a function of time.
        
        Parameters
        ----------
        function : callable
            From the time [s] to the pose, (4, 4).
        end, start, step : float
            First and last time, and the time between two calls [s]: between them the pose is interpolated.
        
        Returns
        -------
        Trajectory
        """
    def __getstate__(self) -> tuple[numpy.ndarray, numpy.ndarray]:
        ...
    def __init__(self, time: numpy.typing.ArrayLike, pose: numpy.typing.ArrayLike) -> None:
        ...
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    def at(self, time: numpy.typing.ArrayLike) -> numpy.ndarray:
        """
        The pose at a time [s], (4, 4); of (N,) times (N, 4, 4). Before the first and after the last it rests.
        """
    @property
    def pose(self) -> numpy.ndarray:
        """
        (K, 4, 4) target_from_source.
        """
    @property
    def time(self) -> numpy.ndarray:
        """
        (K,) rising [s].
        """
class TextTable:
    """
    Numbers of a text file, and how it was understood.
    """
    def __len__(self) -> int:
        ...
    @property
    def decimal(self) -> str:
        """
        Decimal point or comma.
        """
    @property
    def extra(self) -> list:
        """
        (N,) float64 each: the chosen columns beyond `leading`.
        """
    @property
    def grid(self) -> bool:
        """
        Whether it was an ESRI ASCII grid (x, y, z).
        """
    @property
    def names(self) -> list[str]:
        """
        One a chosen column; empty when the file has none.
        """
    @property
    def separator(self) -> str:
        """
        Character between two columns.
        """
    @property
    def table(self) -> numpy.ndarray:
        """
        (N, C) float64, the first `leading` of the chosen columns, or all of them.
        """
class CleanReport:
    """
    How many soundings each step of clean_cloud dropped; str() is for people.
    """
    def __repr__(self) -> str:
        ...
    def __str__(self) -> str:
        ...
    def as_dict(self) -> dict:
        """
        Name → count, in the order of the steps.
        """
    @property
    def after(self) -> int:
        """
        Soundings that remain.
        """
    @property
    def before(self) -> int:
        """
        Soundings given.
        """
    @property
    def duplicates(self) -> int:
        """
        Equal x, y and z, all but one.
        """
    @property
    def not_finite(self) -> int:
        """
        x, y or z is NaN or infinite.
        """
    @property
    def outliers(self) -> int:
        """
        Dropped as outliers.
        """
    @property
    def same_place(self) -> int:
        """
        Share x, y with a sounding of another z; counted, dropped or not.
        """
    @property
    def same_place_dropped(self) -> int:
        """
        Dropped as another depth at the same x, y.
        """
    @property
    def spikes(self) -> int:
        """
        Dropped as spikes.
        """
    @property
    def thinned(self) -> int:
        """
        By voxels.
        """
class CleanResult:
    """
    What clean_cloud returns.
    """
    @property
    def cloud(self) -> PointCloud:
        """
        PointCloud of what stayed.
        """
    @property
    def report(self) -> CleanReport:
        """
        CleanReport: how many went, and why.
        """
    @property
    def rows(self) -> numpy.ndarray:
        """
        (N,) int32: which row of the given cloud each sounding was.
        """
class SidescanPings:
    """
    Side-scan pings of an XTF file, NaN where it says nothing.
    """
    @property
    def amplitude(self) -> numpy.ndarray:
        """
        (pings, beams, samples) near to far; shorter rows end in NaN.
        """
    @property
    def amplitude_step(self) -> float:
        """
        What a step of the file's samples means.
        """
    @property
    def beam_names(self) -> list[str]:
        """
        "port", "starboard".
        """
    @property
    def column(self) -> dict[str, numpy.ndarray]:
        """
        (pings,) arrays by name: time since 1970 [s], x, y, depth, altitude [m], heading, pitch, roll [rad], speed, sound_speed [m/s].
        """
    @property
    def frequency(self) -> float:
        """
        [Hz]
        """
    @property
    def geographic(self) -> bool:
        """
        Whether x is longitude and y latitude [rad].
        """
    @property
    def slant_range(self) -> numpy.ndarray:
        """
        (pings, beams) [m].
        """
    @property
    def sonar_name(self) -> str:
        """
        As the file has it.
        """
class XtfFile:
    """
    An XTF file as it is: packets, channels, what was broken.
    
    `bathyal.read_sonar` gives its side-scan pings as a record.
    """
    def sidescan(self) -> SidescanPings:
        """
        Its side-scan pings.
        """
    def to_bytes(self) -> bytes:
        """
        The file again.
        """
    @property
    def channels(self) -> list[tuple]:
        """
        (number, type, name, frequency [Hz], bytes a sample) of each; type 1 is port, 2 starboard.
        """
    @property
    def damaged(self) -> int:
        """
        Packets whose sizes contradict each other.
        """
    @property
    def lost_bytes(self) -> int:
        """
        Outside of any packet, or in a damaged one.
        """
    @property
    def other_packets(self) -> dict[int, int]:
        """
        How many of each type that is no sonar ping.
        """
    @property
    def ping_count(self) -> int:
        """
        Sonar pings.
        """
class PlaneFit:
    """
    The plane of a bottom and how far to trust it.
    
    Made by `fit_plane`. Unpacks as ``plane, rms = fit``.
    """
    def __iter__(self) -> collections.abc.Iterator:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def flat(self) -> bool:
        """
        Whether the plane may represent the bottom.
        """
    @property
    def flat_share(self) -> float:
        """
        Share of the patches that lie within the tolerance.
        """
    @property
    def inlier_count(self) -> int:
        """
        Number of `inliers`.
        """
    @property
    def inliers(self) -> numpy.ndarray:
        """
        (N,) bool: the points that the plane rests on.
        """
    @property
    def normal(self) -> numpy.ndarray:
        """
        (3,) unit normal m of eq 1, up.
        """
    @property
    def offset(self) -> float:
        """
        d of eq 1 [m].
        """
    @property
    def plane(self) -> Plane:
        """
        Plane, its unit normal up.
        """
    @property
    def relief(self) -> float:
        """
        Largest distance of a patch from the plane [m].
        """
    @property
    def rms(self) -> float:
        """
        Of the inliers, along the normal [m].
        """
    @property
    def tilt_std(self) -> float:
        """
        Standard deviation of the normal's direction, its worst way [rad].
        """
class SheetPatch:
    """
    One place where a cloud has several sheets.
    """
    def __repr__(self) -> str:
        ...
    @property
    def area(self) -> float:
        """
        In plan, to the size of a cell [m²].
        """
    @property
    def high(self) -> numpy.ndarray:
        """
        (3,) greatest corner [m].
        """
    @property
    def low(self) -> numpy.ndarray:
        """
        (3,) least corner of its bounding box [m].
        """
    @property
    def point_count(self) -> int:
        """
        Soundings on its sheets.
        """
    @property
    def separation(self) -> float:
        """
        Median vertical distance of its sheets [m].
        """
class SheetReport:
    """
    Where a cloud has several sheets over one (x, y).
    
    Made by `find_sheets`. True where there are any; ``str`` says where and how much.
    """
    def __bool__(self) -> bool:
        ...
    def __repr__(self) -> str:
        ...
    def __str__(self) -> str:
        ...
    @property
    def cell_size(self) -> float:
        """
        Side of a cell [m].
        """
    @property
    def cells(self) -> numpy.ndarray:
        """
        (K, 3) cells of the patches: centre x, y and the height between the sheets [m].
        """
    @property
    def covered_area(self) -> float:
        """
        Of all cells that hold a sounding [m²].
        """
    @property
    def min_separation(self) -> float:
        """
        Vertical distance from which two sheets count [m], as given or chosen.
        """
    @property
    def noise(self) -> float:
        """
        Median rms of soundings about the planes they lie on [m].
        """
    @property
    def patches(self) -> list[SheetPatch]:
        """
        SheetPatch, the largest area first.
        """
    @property
    def separation(self) -> numpy.ndarray:
        """
        (K,) vertical distance of the two sheets there [m].
        """
    @property
    def share(self) -> float:
        """
        sheet_area / covered_area.
        """
    @property
    def sheet_area(self) -> float:
        """
        Of `cells` [m²].
        """
    @property
    def single_valued(self) -> bool:
        """
        Whether the cloud is a height field.
        """
    @property
    def spacing(self) -> float:
        """
        √(covered area / soundings) [m].
        """
class Profile:
    """
    A cast: properties of the water by depth.
    
    As read from a file its rows are in the file's order, the way down and the way up, with NaN where
    the instrument gave nothing; `cleaned` makes of it what a `Water` takes. A column that was not
    measured is None.
    
    Parameters
    ----------
    depth : (K,) array
        Below the surface [m].
    temperature, salinity, sound_speed, pressure : (K,) array, optional
        [°C], practical, [m/s], above the atmosphere's [dbar].
    position : (latitude, longitude), optional
        North and east [deg].
    time : float, optional
        Since 1970-01-01 UTC [s].
    instrument, source : str
        What measured, and from which file it came.
    
    Raises
    ------
    ValueError
        For no row, columns of another length, infinite numbers.
    
    Examples
    --------
    >>> import bathyal
    >>> cast = bathyal.Profile([0, 20, 60], temperature=[18, 14, 9], salinity=[34, 34.5, 35])
    >>> cast.with_sound_speed().sound_speed.round(1).tolist()
    [1514.6, 1503.2, 1487.1]
    """
    def __getstate__(self) -> tuple[list[float], list[float], list[float], list[float], list[float], float | None, float | None, float | None, str, str]:
        ...
    def __init__(self, depth: numpy.typing.ArrayLike, *, temperature: numpy.typing.ArrayLike | None = None, salinity: numpy.typing.ArrayLike | None = None, sound_speed: numpy.typing.ArrayLike | None = None, pressure: numpy.typing.ArrayLike | None = None, position: tuple[typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex] | None = None, time: typing.SupportsFloat | typing.SupportsIndex | None = None, instrument: str = '', source: str = '') -> None:
        ...
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    def cleaned(self, *, step: typing.SupportsFloat | typing.SupportsIndex = 0.0) -> Profile:
        """
        The way down, fit for a `Water`.
        
        Rows with a number missing and those above the surface are left out, and those not deeper than one
        before; rows of equal depth become their mean. A column without any number is left out.
        
        Parameters
        ----------
        step : float
            Mean of the rows in each layer of this thickness [m]; 0 keeps each row.
        
        Returns
        -------
        Profile
        
        Raises
        ------
        ValueError
            Where fewer than two rows remain.
        """
    def plot(self, path: str | os.PathLike[str] | None = None) -> matplotlib.figure.Figure:
        """
        A figure: sound speed by depth, with temperature and salinity where they are known.
        
        Parameters
        ----------
        path : path, optional
            A picture of it, replaced as a whole: ``.png``, ``.pdf``, ``.svg``.
        
        Returns
        -------
        matplotlib.figure.Figure
        """
    def with_sound_speed(self, *, formula: str = 'mackenzie', latitude: typing.SupportsFloat | typing.SupportsIndex | None = None, temperature_scale: str | None = None) -> Profile:
        """
        The same cast with the sound speed computed.
        
        Parameters
        ----------
        formula, temperature_scale : str
            As of `bathyal.sound_speed`. Rows with a number missing get NaN.
        latitude : float, optional
            [deg]; by default the cast's own, without one 45.
        
        Returns
        -------
        Profile
        """
    @property
    def depth(self) -> numpy.ndarray:
        """
        (K,) below the surface [m].
        """
    @property
    def instrument(self) -> str:
        """
        As the file names it.
        """
    @property
    def position(self) -> tuple[float, float] | None:
        """
        (latitude, longitude) [deg], or None.
        """
    @property
    def pressure(self) -> numpy.ndarray | None:
        """
        (K,) above the atmosphere's [dbar], or None.
        """
    @property
    def salinity(self) -> numpy.ndarray | None:
        """
        (K,) practical, or None.
        """
    @property
    def sound_speed(self) -> numpy.ndarray | None:
        """
        (K,) [m/s], or None.
        """
    @property
    def source(self) -> str:
        """
        The file, and what was derived of it.
        """
    @property
    def temperature(self) -> numpy.ndarray | None:
        """
        (K,) [°C], or None.
        """
    @property
    def time(self) -> float | None:
        """
        Since 1970-01-01 UTC [s], or None.
        """
class Current:
    """
    Horizontal current by depth and time.
    
    Linear between depths and times, at the ends as there.
    
    Parameters
    ----------
    depth : (K,) array
        Rising [m].
    velocity : (K, 2) array
        x and y of the world [m/s]; (T, K, 2) with `time`.
    time : (T,) array, optional
        Rising [s].
    
    Examples
    --------
    >>> import bathyal
    >>> current = bathyal.Current([0, 30], [[0.6, 0.0], [0.1, 0.0]])
    >>> current.at(15.0).round(3).tolist()
    [0.35, 0.0]
    """
    @staticmethod
    def uniform(x: typing.SupportsFloat | typing.SupportsIndex, y: typing.SupportsFloat | typing.SupportsIndex) -> Current:
        """
        The same everywhere and always: x and y of the world [m/s].
        """
    def __getstate__(self) -> tuple[list[float], list, list[float]]:
        ...
    def __init__(self, depth: numpy.typing.ArrayLike, velocity: numpy.typing.ArrayLike, *, time: numpy.typing.ArrayLike | None = None) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    def at(self, depth: numpy.typing.ArrayLike, time: numpy.typing.ArrayLike = 0.0) -> numpy.ndarray:
        """
        (…, 2) velocity [m/s] at depths [m] and times [s], which broadcast.
        """
class Waves:
    """
    A sea state of linear (Airy) waves.
    
    Components of the JONSWAP spectrum (Hasselmann and others 1973), one drawn in each of equal bands
    between half and four times the peak's frequency. Orbits follow Wheeler's stretching (1970).
    
    Parameters
    ----------
    height : float
        Significant [m].
    period : float
        Of the peak [s], 0.5 to 60.
    peak_enhancement : float
        γ, 1 to 20; 1 is the spectrum of Pierson and Moskowitz (1964).
    direction : float
        The waves travel towards, about z from x [rad].
    spreading : float
        s of cos²ˢ(½Δ) about it, 0 to 1 000; infinite for long crests.
    components : int
    depth : float
        Of the water [m].
    seed : int
    
    Examples
    --------
    >>> import bathyal
    >>> sea = bathyal.Waves(height=1.5, period=7, seed=1)
    >>> sea
    Waves(200 components, significant height 1.5 m)
    """
    @staticmethod
    def of_components(amplitude: numpy.typing.ArrayLike, period: numpy.typing.ArrayLike, direction: numpy.typing.ArrayLike = 0.0, phase: numpy.typing.ArrayLike = 0.0, *, depth: typing.SupportsFloat | typing.SupportsIndex = ...) -> Waves:
        """
        A sum of waves as given: (K,) amplitudes [m], periods [s], directions and phases [rad], which broadcast.
        """
    @staticmethod
    def regular(height: typing.SupportsFloat | typing.SupportsIndex, period: typing.SupportsFloat | typing.SupportsIndex, *, direction: typing.SupportsFloat | typing.SupportsIndex = 0.0, depth: typing.SupportsFloat | typing.SupportsIndex = ..., phase: typing.SupportsFloat | typing.SupportsIndex = 0.0) -> Waves:
        """
        One wave, long-crested: height from trough to crest [m], period [s], direction it travels to about z from x [rad], depth of the water [m], phase at the origin at time 0 [rad].
        """
    def __getstate__(self) -> tuple[list, float]:
        ...
    def __init__(self, height: typing.SupportsFloat | typing.SupportsIndex = 1.0, period: typing.SupportsFloat | typing.SupportsIndex = 8.0, *, peak_enhancement: typing.SupportsFloat | typing.SupportsIndex = 3.3, direction: typing.SupportsFloat | typing.SupportsIndex = 0.0, spreading: typing.SupportsFloat | typing.SupportsIndex = 10.0, components: typing.SupportsInt | typing.SupportsIndex = 200, depth: typing.SupportsFloat | typing.SupportsIndex = ..., seed: typing.SupportsInt | typing.SupportsIndex = 0) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    def acceleration(self, point: numpy.typing.ArrayLike, time: numpy.typing.ArrayLike) -> numpy.ndarray:
        """
        The same of its local acceleration [m/s²].
        """
    def elevation(self, x: numpy.typing.ArrayLike, y: numpy.typing.ArrayLike, time: numpy.typing.ArrayLike) -> float | numpy.ndarray:
        """
        Of the surface above its mean [m], at places [m] and times [s] that broadcast.
        """
    def velocity(self, point: numpy.typing.ArrayLike, time: numpy.typing.ArrayLike) -> numpy.ndarray:
        """
        (N, 3) or (3,) of the water in its orbits [m/s] at points whose z counts from the mean surface; 0 in the air. Wheeler's stretching.
        """
    @property
    def amplitude(self) -> numpy.ndarray:
        """
        (K,) of each component [m].
        """
    @property
    def depth(self) -> float:
        """
        Of the water [m].
        """
    @property
    def frequency(self) -> numpy.ndarray:
        """
        (K,) of each component [rad/s].
        """
    @property
    def wave_number(self) -> numpy.ndarray:
        """
        (K, 2) of each component, the way it travels [rad/m].
        """
class Tide:
    """
    Height of the sea surface above its mean by time.
    
    Parameters
    ----------
    constituents : list of (name, (amplitude, phase))
        M2, S2, N2, K2, K1, O1, P1, Q1 or M4, its amplitude [m] and its phase at time 0 [rad]:
        amplitude · cos(rate · time − phase). No nodal factors.
    
    Examples
    --------
    >>> import bathyal
    >>> tide = bathyal.Tide([("M2", (1.2, 0.0)), ("S2", (0.4, 0.5))])
    >>> round(tide.height(0.0), 3)
    1.551
    """
    @staticmethod
    def from_table(time: numpy.typing.ArrayLike, height: numpy.typing.ArrayLike) -> Tide:
        """
        Of (K,) rising times [s] and heights above the mean [m]: linear between, at the ends as there.
        """
    def __getstate__(self) -> tuple[list, list[float], list[float]]:
        ...
    def __init__(self, constituents: collections.abc.Sequence[tuple[str, tuple[typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex]]]) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    def height(self, time: numpy.typing.ArrayLike) -> float | numpy.ndarray:
        """
        Above the mean surface [m] at times [s].
        """
class Water:
    """
    The water of a world: one place that sonars and vehicles read.
    
    Depth counts from the mean surface; a profile moves with neither tide nor waves. Without a surface
    the water is the same everywhere, as it is at `reference_depth`.
    
    Parameters
    ----------
    profile : Profile or list of Profile, optional
        By depth, linear between rows, above the first and below the last as there (`covers`). A sound
        speed that a profile does not have is computed; a temperature or salinity that it does not have
        is the number below.
    surface : float, optional
        z of the mean sea surface [m]; None: out of reach.
    time : (T,) array, optional
        Of several profiles, rising [s]; linear between, at the ends as there.
    reference_depth : float
        [m]
    temperature, salinity : float
        Of water without a profile [°C], practical.
    sound_speed : float, optional
        Of water without a profile [m/s]; None: computed.
    formula : str
        As of `bathyal.sound_speed`.
    ph : float
    latitude : float, optional
        [deg], for depth and pressure; by default the profile's, without one 45.
    current : Current or (2,) array, optional
        [m/s]
    waves : Waves, optional
    tide : Tide, optional
        Both need a surface.
    
    Raises
    ------
    ValueError
        For a profile of one row, unsorted or doubled depths, NaN, numbers that no water has, waves or a
        tide without a surface.
    
    Examples
    --------
    >>> import bathyal
    >>> cast = bathyal.Profile([0, 20, 60], temperature=[18, 14, 9], salinity=[34, 34.5, 35])
    >>> water = bathyal.Water(cast, surface=0.0)
    >>> round(water.sound_speed(-20.0), 1), water.covers(80)
    (1503.2, False)
    >>> round(water.absorption(100e3, depth=50), 1)
    33.5
    """
    def __getstate__(self) -> tuple:
        ...
    def __init__(self, profile: Profile | list[Profile] | None = None, *, surface: typing.SupportsFloat | typing.SupportsIndex | None = None, time: numpy.typing.ArrayLike | None = None, reference_depth: typing.SupportsFloat | typing.SupportsIndex = 50.0, temperature: typing.SupportsFloat | typing.SupportsIndex = 10.0, salinity: typing.SupportsFloat | typing.SupportsIndex = 35.0, sound_speed: typing.SupportsFloat | typing.SupportsIndex | None = None, formula: str = 'mackenzie', ph: typing.SupportsFloat | typing.SupportsIndex = 8.0, latitude: typing.SupportsFloat | typing.SupportsIndex | None = None, current: Current | numpy.typing.ArrayLike | None = None, waves: Waves | None = None, tide: Tide | None = None) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    def absorption(self, frequency: numpy.typing.ArrayLike, z: numpy.typing.ArrayLike | None = None, time: numpy.typing.ArrayLike = 0.0, *, depth: numpy.typing.ArrayLike | None = None, formula: str = 'francois_garrison') -> float | numpy.ndarray:
        """
        One way [dB/km] of frequencies [Hz] at heights or depths: `bathyal.absorption` of the water there.
        """
    def acceleration(self, point: numpy.typing.ArrayLike, time: numpy.typing.ArrayLike = 0.0) -> numpy.ndarray:
        """
        (N, 3) or (3,) local acceleration in the waves' orbits [m/s²].
        """
    def covers(self, depth: typing.SupportsFloat | typing.SupportsIndex) -> bool:
        """
        Whether the profiles reach down to a depth [m].
        """
    def current(self, point: numpy.typing.ArrayLike, time: numpy.typing.ArrayLike = 0.0) -> numpy.ndarray:
        """
        (N, 3) or (3,) horizontal current [m/s] at points of the world, waves apart.
        """
    def density(self, z: numpy.typing.ArrayLike | None = None, time: numpy.typing.ArrayLike = 0.0, *, depth: numpy.typing.ArrayLike | None = None) -> float | numpy.ndarray:
        """
        [kg/m³] at heights or depths and times, by EOS-80.
        """
    def depth(self, z: numpy.typing.ArrayLike) -> float | numpy.ndarray:
        """
        Below the mean surface [m]; `reference_depth` without a surface. ValueError above it.
        """
    def pressure(self, z: numpy.typing.ArrayLike | None = None, time: numpy.typing.ArrayLike = 0.0, *, depth: numpy.typing.ArrayLike | None = None) -> float | numpy.ndarray:
        """
        Above the atmosphere's [dbar] at heights or depths.
        """
    def salinity(self, z: numpy.typing.ArrayLike | None = None, time: numpy.typing.ArrayLike = 0.0, *, depth: numpy.typing.ArrayLike | None = None) -> float | numpy.ndarray:
        """
        Practical salinity at heights or depths and times.
        """
    def sound_speed(self, z: numpy.typing.ArrayLike | None = None, time: numpy.typing.ArrayLike = 0.0, *, depth: numpy.typing.ArrayLike | None = None) -> float | numpy.ndarray:
        """
        [m/s] at heights z of the world, or depths below the mean surface, and times [s].
        """
    def surface_height(self, x: numpy.typing.ArrayLike, y: numpy.typing.ArrayLike, time: numpy.typing.ArrayLike = 0.0) -> float | numpy.ndarray:
        """
        z of the sea surface [m]: mean, tide and waves.
        """
    def temperature(self, z: numpy.typing.ArrayLike | None = None, time: numpy.typing.ArrayLike = 0.0, *, depth: numpy.typing.ArrayLike | None = None) -> float | numpy.ndarray:
        """
        [°C] at heights or depths and times.
        """
    def velocity(self, point: numpy.typing.ArrayLike, time: numpy.typing.ArrayLike = 0.0) -> numpy.ndarray:
        """
        (N, 3) or (3,) current and the waves' orbits together [m/s]; 0 above the surface.
        """
    @property
    def deepest(self) -> float:
        """
        Depth to which the profiles reach [m]; infinite for uniform water.
        """
    @property
    def ph(self) -> float:
        """
        pH.
        """
    @property
    def profiles(self) -> list[Profile]:
        """
        Profile of each time, every column filled; empty for uniform water.
        """
    @property
    def reference_depth(self) -> float:
        """
        Depth of the whole water where there is no surface [m].
        """
    @property
    def surface(self) -> float | None:
        """
        z of the mean sea surface [m]; None: out of reach.
        """
    @property
    def tide(self) -> Tide:
        """
        Tide; without any, 0.
        """
    @property
    def time(self) -> numpy.ndarray:
        """
        (T,) of the profiles [s].
        """
    @property
    def waves(self) -> Waves:
        """
        Waves; without any, flat.
        """
class SoundPath:
    """
    The path of sound in a profile: arcs of circles.
    
    Sound speed is linear between the rows of a profile; there a ray of sound is an arc of a circle, and
    place, direction and time along it are closed forms. A path lies in a vertical plane.
    
    Parameters
    ----------
    water : Water or Profile
    start_depth : float
        [m]
    launch_angle : float
        Below the horizontal, −½π to ½π [rad].
    max_time, max_distance : float
        End of the path [s], horizontal [m].
    surface : bool
        Whether depth 0 is the sea surface, at which a path ends.
    surface_reflects : bool
        At which it is reflected instead.
    time : float
        Of the water [s].
    
    Examples
    --------
    >>> import bathyal
    >>> cast = bathyal.Profile([0, 1000], sound_speed=[1500.0, 1517.0])
    >>> path = bathyal.SoundPath(cast, 100.0, 0.0, max_time=0.5)
    >>> path.at([0.5]).round(3).tolist()  # bent upwards, to less speed
    [[0.5, 750.832, 96.809, -0.008]]
    """
    def __init__(self, water: Water | Profile, start_depth: typing.SupportsFloat | typing.SupportsIndex, launch_angle: typing.SupportsFloat | typing.SupportsIndex, *, max_time: typing.SupportsFloat | typing.SupportsIndex = 1.0, max_distance: typing.SupportsFloat | typing.SupportsIndex = ..., surface: bool = True, surface_reflects: bool = False, time: typing.SupportsFloat | typing.SupportsIndex = 0.0) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def at(self, time: numpy.typing.ArrayLike) -> numpy.ndarray:
        """
        (N, 4) time [s], horizontal distance [m], depth [m] and angle [rad] at (N,) times, on the exact arcs; beyond the path its ends.
        """
    def chords(self, tolerance: typing.SupportsFloat | typing.SupportsIndex) -> numpy.ndarray:
        """
        (M, 4) points as of `at` whose straight chords are nowhere farther from the arcs than the tolerance [m].
        """
    @property
    def angle(self) -> numpy.ndarray:
        """
        (K,) below the horizontal, where each arc begins [rad].
        """
    @property
    def depth(self) -> numpy.ndarray:
        """
        (K,) at the ends of the arcs [m].
        """
    @property
    def distance(self) -> numpy.ndarray:
        """
        (K,) horizontal, at the ends of the arcs [m].
        """
    @property
    def duration(self) -> float:
        """
        Of the whole path [s].
        """
    @property
    def end(self) -> str:
        """
        What ended it: "time", "distance" or "surface".
        """
    @property
    def time(self) -> numpy.ndarray:
        """
        (K,) at the ends of the arcs [s].
        """
class TracedSound:
    """
    Where beams are. Made by `trace_sound`.
    """
    def __iter__(self) -> collections.abc.Iterator:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def across(self) -> float | numpy.ndarray:
        """
        Horizontal distance from the start [m].
        """
    @property
    def angle(self) -> float | numpy.ndarray:
        """
        Below the horizontal [rad].
        """
    @property
    def depth(self) -> float | numpy.ndarray:
        """
        Below the surface [m].
        """
class Eigenray:
    """
    A way of sound between two points.
    """
    def __repr__(self) -> str:
        ...
    @property
    def arrival(self) -> float:
        """
        Angle below the horizontal at the end [rad].
        """
    @property
    def launch(self) -> float:
        """
        Angle below the horizontal at the start [rad].
        """
    @property
    def time(self) -> float:
        """
        [s]
        """
class Hits:
    """
    What each of N rays met first.
    
    All arrays are read-only. ``range``, ``mesh`` and ``triangle`` are there when the cast returns (as
    columns of one array, so with a stride); ``point``, ``normal`` and ``barycentric`` are computed at
    the first access, and kept.
    """
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def barycentric(self) -> numpy.ndarray:
        """
        (N, 3) weights (u, v, w) of corners 1, 2 and 0, as eq 4; NaN where there is none.
        """
    @property
    def mesh(self) -> numpy.ndarray:
        """
        (N,) number of the mesh in the scene, −1 where the ray met nothing.
        """
    @property
    def normal(self) -> numpy.ndarray:
        """
        (N, 3) unit normal of the triangle as it is wound, NaN where the ray met nothing.
        """
    @property
    def point(self) -> numpy.ndarray:
        """
        (N, 3) where it met it [m], NaN where it met nothing.
        """
    @property
    def range(self) -> numpy.ndarray:
        """
        (N,) distance along the ray [m], inf where it met nothing.
        """
    @property
    def triangle(self) -> numpy.ndarray:
        """
        (N,) triangle of that mesh, −1 where the ray met nothing.
        """
class Nearest:
    """
    The closest point of a scene to each of N points.
    """
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def barycentric(self) -> numpy.ndarray:
        """
        (N, 3) weights (u, v, w) of corners 1, 2 and 0, as eq 4; NaN where there is none.
        """
    @property
    def distance(self) -> numpy.ndarray:
        """
        (N,) [m], inf where the scene holds no triangle.
        """
    @property
    def mesh(self) -> numpy.ndarray:
        """
        (N,) number of the mesh in the scene, −1 where there is none.
        """
    @property
    def point(self) -> numpy.ndarray:
        """
        (N, 3) of the scene [m], NaN where there is none.
        """
    @property
    def triangle(self) -> numpy.ndarray:
        """
        (N,) triangle of that mesh, −1 where there is none.
        """
class NearestSegments:
    """
    Where a scene comes closest to each of N segments.
    """
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def barycentric(self) -> numpy.ndarray:
        """
        (N, 3) weights (u, v, w) of corners 1, 2 and 0, as eq 4; NaN where there is none.
        """
    @property
    def distance(self) -> numpy.ndarray:
        """
        (N,) [m], 0 where the segment meets a triangle, inf where there is none within reach.
        """
    @property
    def fraction(self) -> numpy.ndarray:
        """
        (N,) where along the segment, 0 at its start, 1 at its end; NaN where there is none.
        """
    @property
    def mesh(self) -> numpy.ndarray:
        """
        (N,) number of the mesh in the scene, −1 where there is none.
        """
    @property
    def point(self) -> numpy.ndarray:
        """
        (N, 3) of the scene [m], NaN where there is none.
        """
    @property
    def segment_point(self) -> numpy.ndarray:
        """
        (N, 3) of the segment [m], the same as `point` where they meet; NaN where there is none.
        """
    @property
    def triangle(self) -> numpy.ndarray:
        """
        (N,) triangle of that mesh, −1 where there is none.
        """
class Polyline:
    """
    A line of a section: segment i runs from point i to point i + 1.
    """
    def __repr__(self) -> str:
        ...
    @property
    def closed(self) -> bool:
        """
        Whether the line comes back to where it began.
        """
    @property
    def mesh(self) -> numpy.ndarray:
        """
        (P − 1,) the mesh each segment lies on: one and the same along a line.
        """
    @property
    def points(self) -> numpy.ndarray:
        """
        (P, 3) [m]; a closed line repeats its first point.
        """
    @property
    def triangle(self) -> numpy.ndarray:
        """
        (P − 1,) the triangle of that mesh each segment lies on.
        """
class Scene:
    """
    One or more meshes, made ready for rays, nearest points and sections.
    
    Answers are decided in double, the same bytes on every instruction set and for any number of
    threads; equal ranges or distances give the lowest (mesh, triangle). The meshes are shared, not
    copied. Any number of threads may query it at once.
    
    A row of the list is an instance: ``.mesh`` in answers is that row, and a mesh that occurs several
    times (the same object, or the same arrays) is held, and made ready, once. With poses each row is
    where its pose puts it; everything that goes in or comes out is in the world, and ``meshes`` stay as
    given. A ray is moved into the mesh's frame and decided there on its own vertices: at the identity
    to the same bytes as without poses. Each instance is watertight in itself; across two that share an
    edge that is not promised.
    
    Parameters
    ----------
    mesh : TriangleMesh, or a sequence of them
        One at least; meshes without triangles are allowed and never hit.
    poses : (K, 4, 4) array, optional
        world_from_mesh of each, rigid; of a rotation that is off by less than 1e-6 the nearest one is
        taken. Without: all meshes are in the world as they are.
    scales : (K,) array, optional
        Metres of the world for one of the mesh, from 1e-9 to 1e9: x in the world is
        scale · rotation · x + translation. Without: 1.
    num_threads : int
        For the build; 0 means all.
    
    Raises
    ------
    ValueError
        For no mesh, or poses or scales of another number, not rigid or out of range: names the first.
    
    Examples
    --------
    >>> import bathyal, numpy as np
    >>> floor = bathyal.TriangleMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
    >>> bathyal.Scene(floor)
    Scene(1 mesh, 1 triangle)
    >>> poses = np.array([np.eye(4), np.eye(4)])
    >>> poses[1, 2, 3] = -10.0
    >>> scene = bathyal.Scene([floor, floor], poses=poses, scales=[1, 4])
    >>> hits = scene.cast((0, 0, 5), [[1, 1, -5], [12, 3, -15]])
    >>> hits.mesh.tolist(), hits.point.tolist()
    ([0, 1], [[1.0, 1.0, 0.0], [12.0, 3.0, -10.0]])
    """
    @typing.overload
    def __init__(self, mesh: TriangleMesh, *, poses: numpy.typing.ArrayLike | None = None, scales: numpy.typing.ArrayLike | None = None, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> None:
        ...
    @typing.overload
    def __init__(self, mesh: collections.abc.Sequence[TriangleMesh], *, poses: numpy.typing.ArrayLike | None = None, scales: numpy.typing.ArrayLike | None = None, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def cast(self, origins: numpy.typing.ArrayLike, directions: numpy.typing.ArrayLike, *, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> Hits:
        """
        The first triangle that each ray meets, from either side.
        
        Decided in double on the mesh's own vertices, with exact signs, so that a ray through an edge or a
        vertex of a closed mesh never slips through (Woop, Benthin, Wald 2013, Watertight ray/triangle
        intersection). Equal ranges give the lowest (mesh, triangle). A ray that runs in the plane of a
        triangle does not meet that one, but meets its neighbours' borders.
        
        Parameters
        ----------
        origins : (N, 3), (1, 3) or (3,) array
            [m], finite. One origin serves all directions.
        directions : (N, 3) or (3,) array
            Any length but zero.
        num_threads : int
            0 means all. The result is the same bytes for any number.
        
        Returns
        -------
        Hits
            ``.range`` (N,) [m], ``.mesh`` and ``.triangle`` (N,), ``.point``, ``.normal`` and
            ``.barycentric`` (N, 3). A ray that meets nothing gives inf, −1 and NaN.
        
        Raises
        ------
        ValueError
            For a direction of zero or a value that is not finite: names the first row at fault.
        
        Examples
        --------
        >>> import bathyal
        >>> floor = bathyal.TriangleMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        >>> hits = bathyal.Scene(floor).cast((1, 1, 3), [[0, 0, -2], [0, 0, 1]])
        >>> hits.range, hits.triangle.tolist()
        (array([ 3., inf]), [0, -1])
        """
    def contains(self, points: numpy.typing.ArrayLike, *, accuracy: typing.SupportsFloat | typing.SupportsIndex = 0.1, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> numpy.typing.NDArray[numpy.bool]:
        """
        Whether each point lies inside.
        
        Inside is where the winding number is beyond ±1/2, so it holds for meshes that are inside out, open
        or cut themselves: a hole counts as filmed over. A point on a triangle is contained. Bodies that
        overlap add up; two that are wound against each other cancel where both are.
        
        Parameters
        ----------
        points : (N, 3) array
            [m], finite.
        accuracy : float
            As in winding_number.
        num_threads : int
            0 means all.
        
        Returns
        -------
        (N,) array of bool
        
        Examples
        --------
        >>> import bathyal
        >>> tetrahedron = bathyal.TriangleMesh([[0, 0, 0], [3, 0, 0], [0, 3, 0], [0, 0, 3]],
        ...                                    [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
        >>> bathyal.Scene(tetrahedron).contains([[0.5, 0.5, 0.5], [5, 5, 5]]).tolist()
        [True, False]
        """
    def mesh_in_world(self, mesh: typing.SupportsInt | typing.SupportsIndex) -> TriangleMesh:
        """
        A row's mesh where its pose and scale put it.
        
        Parameters
        ----------
        mesh : int
            Row of the scene.
        
        Returns
        -------
        TriangleMesh
            The mesh itself where it is at the identity, else a moved copy of its vertices with the same
            triangles and attributes, without its datum.
        
        Examples
        --------
        >>> import bathyal
        >>> floor = bathyal.TriangleMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        >>> bathyal.Scene(floor, scales=[2]).mesh_in_world(0).vertices.max().item()
        8.0
        """
    def nearest(self, points: numpy.typing.ArrayLike, *, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> Nearest:
        """
        The closest point of all triangles to each point.
        
        Decided in double; equal distances give the lowest (mesh, triangle). A triangle without area counts
        as the segment or point that it is.
        
        Parameters
        ----------
        points : (N, 3) array
            [m], finite.
        num_threads : int
            0 means all.
        
        Returns
        -------
        Nearest
            ``.distance`` (N,) [m], ``.point`` (N, 3), ``.mesh`` (N,), ``.triangle`` (N,) and
            ``.barycentric`` (N, 3). A scene without triangles gives inf, NaN and −1.
        
        Examples
        --------
        >>> import bathyal
        >>> floor = bathyal.TriangleMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        >>> near = bathyal.Scene(floor).nearest([[1, 1, 3], [-3, 0, -4]])
        >>> near.distance.tolist(), near.point.tolist()
        ([3.0, 5.0], [[1.0, 1.0, 0.0], [0.0, 0.0, 0.0]])
        """
    def nearest_segments(self, start: numpy.typing.ArrayLike, end: numpy.typing.ArrayLike, *, within: typing.SupportsFloat | typing.SupportsIndex = ..., num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> NearestSegments:
        """
        Where all triangles come closest to each straight segment.
        
        Decided in double; equal distances give the lowest (mesh, triangle). Where a segment meets a
        triangle, borders and ends included, its distance is exactly 0 and both points are one: decided with
        exact signs, in the plane of a triangle too. A triangle without area counts as the segment or point
        that it is; a segment without length is as by nearest. The distance of a capsule is that of its axis
        less its radius.
        
        Parameters
        ----------
        start : (N, 3), (1, 3) or (3,) array
            [m], finite and no further out than 10²⁵ m. One start serves all ends.
        end : (N, 3) or (3,) array
            [m], likewise.
        within : float
            What is further away is not found [m]; a small distance saves time.
        num_threads : int
            0 means all. The result is the same bytes for any number.
        
        Returns
        -------
        NearestSegments
            ``.distance`` (N,) [m], ``.point`` (N, 3) of the scene, ``.mesh`` (N,), ``.triangle`` (N,),
            ``.barycentric`` (N, 3), ``.fraction`` (N,) along the segment and ``.segment_point`` (N, 3).
            Where nothing lies within reach: inf, NaN and −1.
        
        Raises
        ------
        ValueError
            For an end that is not finite or out of range: names the first row at fault.
        
        Examples
        --------
        >>> import bathyal
        >>> floor = bathyal.TriangleMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        >>> near = bathyal.Scene(floor).nearest_segments((1, 1, 3), [[1, 2, 2], [1, 1, -1]])
        >>> near.distance.tolist(), near.fraction.tolist()
        ([2.0, 0.0], [1.0, 0.75])
        """
    def occluded(self, from_: numpy.typing.ArrayLike, to: numpy.typing.ArrayLike, *, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> numpy.ndarray:
        """
        Whether anything lies on each straight segment, its ends included.
        
        Decided as by cast. A segment of no length meets nothing.
        
        Parameters
        ----------
        from_ : (N, 3), (1, 3) or (3,) array
            [m], finite. One start serves all ends.
        to : (N, 3) or (3,) array
            [m], finite.
        num_threads : int
            0 means all.
        
        Returns
        -------
        (N,) array of bool
        
        Examples
        --------
        >>> import bathyal
        >>> floor = bathyal.TriangleMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        >>> bathyal.Scene(floor).occluded((1, 1, 3), [[1, 1, -1], [1, 1, 1]]).tolist()
        [True, False]
        """
    @typing.overload
    def section(self, plane: Plane) -> list[Polyline]:
        """
        The lines in which a whole plane cuts the scene; see below.
        """
    @typing.overload
    def section(self, a: numpy.typing.ArrayLike, b: numpy.typing.ArrayLike | None = None, up: numpy.typing.ArrayLike | None = None) -> list[Polyline]:
        """
        The lines in which a plane cuts the scene.
        
        ``section(plane)`` cuts by a whole plane. ``section(a, b)`` cuts by the plane through two points and
        the direction ``up`` and keeps what lies between them, measured along the horizontal, ends included
        (Filaretov, Konoplin, Konoplin 2018: r = (b − a) × up).
        
        Edges in the plane appear once, triangles in the plane give the outline of their region, a surface
        that touches the plane at single points gives nothing there. Lines never join two meshes; they are
        sorted by mesh and by where they start. Open lines run from a towards b (by a plane: from their end
        with the lower x, then y, z), closed ones counter-clockwise seen from where the normal, or r, points
        to. A line that starts or ends at a or b to rounding starts or ends at exactly that point.
        
        Parameters
        ----------
        plane : Plane
            Alone; or
        a, b : (3,) array
            Two points [m], not above each other along `up`.
        up : (3,) array, optional
            With two points: any length but zero; (0, 0, 1) unless given.
        
        Returns
        -------
        list of Polyline
            ``.points`` (P, 3) [m], ``.mesh`` and ``.triangle`` (P − 1,), ``.closed``.
        
        Raises
        ------
        ValueError
            Where b lies above, below or at a along ``up``: there is no such plane.
        
        Examples
        --------
        >>> import bathyal
        >>> floor = bathyal.TriangleMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        >>> line, = bathyal.Scene(floor).section((0, 1, 9), (2, 1, 9))
        >>> line.points.tolist()
        [[0.0, 1.0, 0.0], [2.0, 1.0, 0.0]]
        """
    def winding_number(self, points: numpy.typing.ArrayLike, *, accuracy: typing.SupportsFloat | typing.SupportsIndex = 0.1, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> numpy.ndarray:
        """
        How often the triangles wind around each point.
        
        The solid angle of all triangles over 4π: 1 inside a closed mesh with outward normals, −1 inside one
        turned inside out, 2 inside two of them, a fraction near the holes of an open one, the mean of the
        two sides on a triangle. Jacobson, Kavan, Sorkine-Hornung (2013), Robust inside-outside segmentation
        using generalized winding numbers; far triangles are taken together as in Barill, Dickson, Schmidt,
        Levin, Jacobson (2018), Fast winding numbers for soups and clouds.
        
        Parameters
        ----------
        points : (N, 3) array
            [m], finite.
        accuracy : float
            What a far cluster of triangles may be off by, as a part of its area / (4π distance²); above 0.
        num_threads : int
            0 means all.
        
        Returns
        -------
        (N,) array
        
        Examples
        --------
        >>> import bathyal
        >>> tetrahedron = bathyal.TriangleMesh([[0, 0, 0], [3, 0, 0], [0, 3, 0], [0, 0, 3]],
        ...                                    [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
        >>> bathyal.Scene(tetrahedron).winding_number([[0.5, 0.5, 0.5], [5, 5, 5]]).round(3) + 0.0
        array([1., 0.])
        """
    def with_poses(self, poses: numpy.typing.ArrayLike, *, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> Scene:
        """
        The same meshes at other poses, as another scene.
        
        It shares the meshes, their scales and what was made ready of them; only the tree over the instances
        is made anew, so that a moving fish does not rebuild the bottom. This scene stays as it is. From a
        scene of several meshes that was made without poses, each call makes them ready one by one first.
        
        Parameters
        ----------
        poses : (K, 4, 4) array
            world_from_mesh of each row, as of the constructor.
        num_threads : int
            0 means all.
        
        Returns
        -------
        Scene
        
        Examples
        --------
        >>> import bathyal, numpy as np
        >>> floor = bathyal.TriangleMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        >>> scene = bathyal.Scene(floor, poses=[np.eye(4)])
        >>> lower = np.eye(4)
        >>> lower[2, 3] = -2
        >>> [s.cast((1, 1, 3), (0, 0, -1)).range[0].item() for s in (scene, scene.with_poses([lower]))]
        [3.0, 5.0]
        """
    @property
    def memory(self) -> int:
        """
        Bytes held besides the meshes' own arrays.
        """
    @property
    def meshes(self) -> list[TriangleMesh]:
        """
        The meshes as given, as a list: each in its own frame.
        """
    @property
    def poses(self) -> numpy.ndarray:
        """
        (K, 4, 4) world_from_mesh of each row, the identity where none were given.
        """
    @property
    def scales(self) -> numpy.ndarray:
        """
        (K,) metres of the world for one of the mesh, 1 where none were given.
        """
class Targets:
    """
    Where camera axes meet the bottom, one target a row of the aims.
    """
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def barycentric(self) -> numpy.ndarray:
        """
        (K, 3) (u, v, w) of eq 4: A = w V0 + u V1 + v V2; NaN where there is none.
        """
    @property
    def incidence(self) -> numpy.ndarray:
        """
        (K,) between the axis and the normal [rad], above π/2 from beneath.
        """
    @property
    def mesh(self) -> numpy.ndarray:
        """
        (K,) mesh of the scene, −1 where there is none.
        """
    @property
    def normal(self) -> numpy.ndarray:
        """
        (K, 3) unit, out of the bottom, NaN where there is none.
        """
    @property
    def point(self) -> numpy.ndarray:
        """
        (K, 3) A_i [m], NaN where there is none.
        """
    @property
    def range(self) -> numpy.ndarray:
        """
        (K,) along the unit direction [m], inf where there is none.
        """
    @property
    def status(self) -> numpy.ndarray:
        """
        (K,) "hit", "miss", "parallel", "behind", "hole" or "grazing".
        """
    @property
    def triangle(self) -> numpy.ndarray:
        """
        (K,) triangle of the mesh, −1 where there is none.
        """
class ToolPath:
    """
    An oriented tool path along the bottom, one sample a row, in the world frame.
    
    Positions [m], times [s], angles [rad]. All arrays are read-only.
    """
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    def show(self) -> plotly.graph_objects.Figure:
        """
        An interactive figure: the path, its targets and its approach arrows.
        
        See bathyal.view.scene3d.show_path.
        """
    def write(self, path: str | os.PathLike[str]) -> None:
        """
        Write the path; every number keeps its full double precision.
        
        Parameters
        ----------
        path : path
            ``.csv``, ``.json`` or ``.vtp``: see bathyal.toolpath.paths.write_path.
        """
    @property
    def approach(self) -> numpy.ndarray:
        """
        (M, 3) a_j, unit, out of the bottom; the tool's z is −a_j.
        """
    @property
    def arc_length(self) -> numpy.ndarray:
        """
        (M,) along the positions, from 0.
        """
    @property
    def contact(self) -> numpy.ndarray:
        """
        (M,) whether the tool's body meets ground here.
        """
    @property
    def crossing(self) -> numpy.ndarray:
        """
        (M,) whether the path at standoff turns back or crosses itself here.
        """
    @property
    def frame(self) -> numpy.ndarray:
        """
        (M, 4, 4) world_from_tool: rotation columns [n, −b, −a], translation the position.
        """
    @property
    def gap(self) -> numpy.ndarray:
        """
        (M,) whether the stretch to the next sample crosses a gap of the bottom.
        """
    @property
    def mesh(self) -> numpy.ndarray:
        """
        (M,) mesh of the scene, −1 on a plane.
        """
    @property
    def normal_std(self) -> numpy.ndarray:
        """
        (M,) root mean square of the angle the true normal may lie off; NaN where unknown.
        """
    @property
    def position(self) -> numpy.ndarray:
        """
        (M, 3) the tool's point: T_j, T_j + standoff · a_j, or the rolling ball's centre.
        """
    @property
    def quaternion(self) -> numpy.ndarray:
        """
        (M, 4) x y z w of the frame, continuous in sign.
        """
    @property
    def segment(self) -> numpy.ndarray:
        """
        (M,) i of the pair A_i A_{i+1}: a row of the aims.
        """
    @property
    def side(self) -> numpy.ndarray:
        """
        (M, 3) b_j = a_j × n_j.
        """
    @property
    def surface(self) -> numpy.ndarray:
        """
        (M, 3) T_j, on the bottom; what the rolling ball touches.
        """
    @property
    def targets(self) -> Targets:
        """
        The Targets the path goes through, one a row of the aims.
        """
    @property
    def time(self) -> numpy.ndarray:
        """
        (M,) from 0, never falling.
        """
    @property
    def travel(self) -> numpy.ndarray:
        """
        (M, 3) n_j, unit, along the travel, perpendicular to a_j.
        """
    @property
    def triangle(self) -> numpy.ndarray:
        """
        (M,) triangle of the stretch that begins here, −1 on a plane.
        """
    @property
    def warnings(self) -> list[str]:
        """
        What a person should know before the path is followed: list of str.
        """
class Link:
    """
    What hangs on an arm behind one of its joints.
    
    Link 0 is the foot, before any joint; link k moves with joint k. All numbers but `frame` are given
    in the link's own frame.
    
    Parameters
    ----------
    name : str
    mass : float
        [kg]; 0 is unknown.
    center_of_mass : (3,) array
        [m]
    inertia : (3, 3) array, optional
        About the centre of mass [kg m²].
    volume : float
        Displaced water [m³]; 0 is unknown.
    center_of_buoyancy : (3,) array
        [m]
    frame : (4, 4) array, optional
        row_from_link; the frame behind the joint's row itself unless given.
    collision, visual : list of Shape
        Outlines in the link's frame.
    
    Raises
    ------
    ValueError
        For what `RigidBody` refuses, and a frame that is not rigid.
    
    Examples
    --------
    >>> import bathyal
    >>> bathyal.Link("forearm", mass=2.5, center_of_mass=(-0.1, 0, 0), volume=1.2e-3)
    Link("forearm", mass=2.5)
    """
    def __init__(self, name: str = '', *, mass: typing.SupportsFloat | typing.SupportsIndex = 0.0, center_of_mass: numpy.typing.ArrayLike = (0, 0, 0), inertia: numpy.typing.ArrayLike | None = None, volume: typing.SupportsFloat | typing.SupportsIndex = 0.0, center_of_buoyancy: numpy.typing.ArrayLike = (0, 0, 0), frame: numpy.typing.ArrayLike | None = None, collision: collections.abc.Sequence[Shape] = [], visual: collections.abc.Sequence[Shape] = []) -> None:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def body(self) -> RigidBody:
        """
        The RigidBody in the link's frame.
        """
    @property
    def center_of_buoyancy(self) -> numpy.ndarray:
        """
        (3,) in the link's frame [m].
        """
    @property
    def center_of_mass(self) -> numpy.ndarray:
        """
        (3,) in the link's frame [m].
        """
    @property
    def collision(self) -> tuple[Shape, ...]:
        """
        Tuple of Shapes in the link's frame that must not touch anything.
        """
    @property
    def frame(self) -> numpy.ndarray:
        """
        (4, 4) row_from_link: the link's frame, seen from the frame behind its row.
        """
    @property
    def inertia(self) -> numpy.ndarray:
        """
        (3, 3) about the centre of mass, along the link's axes [kg m²].
        """
    @property
    def mass(self) -> float:
        """
        [kg]; 0 is unknown.
        """
    @property
    def name(self) -> str:
        """
        As the file of the arm calls it; may be empty.
        """
    @property
    def visual(self) -> tuple[Shape, ...]:
        """
        Tuple of Shapes in the link's frame: what it looks like.
        """
    @property
    def volume(self) -> float:
        """
        Displaced [m³]; 0 is unknown.
        """
class DhTable:
    """
    The Denavit-Hartenberg table of an arm.
    
    base_from_flange = root · row 1 · … · row m · flange, where a row is
    Rz(theta) Tz(d) Tx(a) Rx(alpha) Ry(beta) in the standard convention and
    Tx(a) Rx(alpha) Ry(beta) Rz(theta) Tz(d) in the modified one.
    """
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def a(self) -> numpy.ndarray:
        """
        (m,) [m]
        """
    @property
    def alpha(self) -> numpy.ndarray:
        """
        (m,) [rad]
        """
    @property
    def beta(self) -> numpy.ndarray:
        """
        (m,) [rad]; Hayati and Mirmirani's angle.
        """
    @property
    def convention(self) -> str:
        """
        "standard" or "modified".
        """
    @property
    def d(self) -> numpy.ndarray:
        """
        (m,) [m]; a sliding joint adds its value.
        """
    @property
    def flange(self) -> numpy.ndarray:
        """
        (4, 4) behind the last row.
        """
    @property
    def joint_types(self) -> list[str]:
        """
        One word a row: "revolute", "prismatic" or "fixed".
        """
    @property
    def root(self) -> numpy.ndarray:
        """
        (4, 4) before the first row.
        """
    @property
    def theta(self) -> numpy.ndarray:
        """
        (m,) [rad]; a turning joint adds its value.
        """
class InverseResult:
    """
    Joint angles found for poses, and how well; of a single pose each array lacks its first dimension.
    """
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def angle_error(self) -> float | numpy.ndarray:
        """
        (N,) angle left [rad]; 0 where the task has none.
        """
    @property
    def error(self) -> float | numpy.ndarray:
        """
        (N,) left of position and angle together, a radian weighing a fifth of the arm's length [m].
        """
    @property
    def iterations(self) -> int | numpy.ndarray:
        """
        (N,) over all starts.
        """
    @property
    def position_error(self) -> float | numpy.ndarray:
        """
        (N,) distance left [m].
        """
    @property
    def q(self) -> numpy.ndarray:
        """
        (N, n) [rad] or [m], by "damped" always within the limits; where nothing was reached, the nearest found.
        """
    @property
    def starts(self) -> int | numpy.ndarray:
        """
        (N,) that were tried.
        """
    @property
    def status(self) -> str | numpy.ndarray:
        """
        (N,) "reached", "limit", "singular" or "out_of_reach".
        """
class Arm:
    """
    A serial arm: its geometry, limits, masses and volumes.
    
    Made by ``Arm.from_dh`` and the functions of ``bathyal.arms``. world_from_tool = base · arm · tool:
    `base` (world_from_base) and `tool` (flange_from_tool) are yours to set and the identity until then;
    all else stays as it was made. Metres and radians.
    
    Examples
    --------
    >>> import bathyal
    >>> arm = bathyal.Arm.from_dh(a=[0.5, 0.4], alpha=[0, 0], d=[0, 0], theta=[0, 0])
    >>> arm
    Arm(2 joints)
    >>> arm.forward([0.0, 0.0])[:3, 3].round(6)
    array([0.9, 0. , 0. ])
    """
    @staticmethod
    def from_dh(a: numpy.typing.ArrayLike, alpha: numpy.typing.ArrayLike, d: numpy.typing.ArrayLike, theta: numpy.typing.ArrayLike, *, beta: numpy.typing.ArrayLike | None = None, joint_types: collections.abc.Sequence[str] | None = None, convention: str = 'standard', lower: numpy.typing.ArrayLike | None = None, upper: numpy.typing.ArrayLike | None = None, velocity: numpy.typing.ArrayLike | None = None, effort: numpy.typing.ArrayLike | None = None, names: collections.abc.Sequence[str] = [], links: collections.abc.Sequence[Link] = [], root: numpy.typing.ArrayLike | None = None, flange: numpy.typing.ArrayLike | None = None, base: numpy.typing.ArrayLike | None = None, tool: numpy.typing.ArrayLike | None = None, name: str = '', source: str = '') -> Arm:
        """
        An arm from its Denavit-Hartenberg table.
        
        Parameters
        ----------
        a, alpha, d, theta : (m,) arrays
            One value a row [m], [rad]. A turning joint adds its value to theta, a sliding one to d.
        beta : (m,) array, optional
            Hayati and Mirmirani's fifth angle (1985), for neighbouring axes that are nearly parallel [rad].
        joint_types : list of str, optional
            "revolute" (all, unless given), "prismatic" or "fixed".
        convention : str
            "standard", a row is Rz(theta) Tz(d) Tx(a) Rx(alpha) Ry(beta); or "modified" (Craig), a row is
            Tx(a) Rx(alpha) Ry(beta) Rz(theta) Tz(d).
        lower, upper, velocity, effort : (m,) arrays, optional
            Limits of each row's joint; infinite unless given. A turning joint without limits wraps.
        names : list of str, optional
            Of the rows; "joint_1" and so on unless given.
        links : list of Link, optional
            m + 1 of them, the foot first.
        root, flange, base, tool : (4, 4) arrays, optional
            What lies before the first row and behind the last, as part of the arm; and the user's
            world_from_base and flange_from_tool.
        name, source : str
            Of the arm, and where its numbers come from.
        
        Raises
        ------
        ValueError
            For columns of unequal length, a value that is not finite, crossed limits, no moving joint.
        
        Examples
        --------
        >>> import bathyal, math
        >>> arm = bathyal.Arm.from_dh(a=[0, 0.3], alpha=[math.pi / 2, 0], d=[0.2, 0], theta=[0, 0],
        ...                           lower=[-1, -2], upper=[1, 2], name="small")
        >>> arm.size, arm.joint_names
        (2, ['joint_1', 'joint_2'])
        >>> arm.within_limits([[0, 0], [0, 3]])
        array([ True, False])
        """
    @staticmethod
    def from_urdf(path: str | os.PathLike[str], *, tip: str | None = None, root: str | None = None, name: str | None = None) -> Arm:
        """
        An arm from one path of a URDF's tree.
        
        Parameters
        ----------
        path : path
            A URDF; xacro must be expanded first. Meshes are never opened.
        tip : str, optional
            The link, or the joint whose child link, becomes the flange. Needed where the tree has
            several ends.
        root : str, optional
            The link that becomes the base; the root of the tree unless given.
        name : str, optional
            The robot's own unless given.
        
        All of it: bathyal.arm.urdf_reader.arm_from_urdf.
        """
    def __copy__(self) -> Arm:
        ...
    def __deepcopy__(self, memo: dict) -> Arm:
        ...
    def __getstate__(self) -> dict:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    def copy(self) -> Arm:
        """
        An arm of its own, base and tool too.
        """
    def forward(self, q: numpy.typing.ArrayLike, *, links: bool = False, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> numpy.ndarray:
        """
        Poses of the tool in the world.
        
        Parameters
        ----------
        q : (N, n) or (n,) array
            Joint angles [rad] or [m]. Values beyond the limits are taken: a measured pose may lie there.
        links : bool
            Poses of every link instead, in the order of `link_names`.
        num_threads : int
            0 is all.
        
        Returns
        -------
        (N, 4, 4) or (4, 4) array; with `links` (N, L, 4, 4) or (L, 4, 4)
            world_from_tool, world_from_link.
        
        Examples
        --------
        >>> import bathyal
        >>> arm = bathyal.arms.ur10e()
        >>> arm.forward([[0, 0, 0, 0, 0, 0]])[0, :3, 3].round(4)
        array([-1.1842, -0.2906,  0.0609])
        """
    def inverse(self, poses: numpy.typing.ArrayLike, start: numpy.typing.ArrayLike | None = None, *, task: str = 'pose', method: str = 'damped', axis: numpy.typing.ArrayLike = (0.0, 0.0, 1.0), position_tolerance: typing.SupportsFloat | typing.SupportsIndex | None = None, angle_tolerance: typing.SupportsFloat | typing.SupportsIndex | None = None, max_iterations: typing.SupportsInt | typing.SupportsIndex = 60, max_starts: typing.SupportsInt | typing.SupportsIndex = 64, candidates: typing.SupportsInt | typing.SupportsIndex = 1, centering_steps: typing.SupportsInt | typing.SupportsIndex | None = None, steps: typing.SupportsInt | typing.SupportsIndex = 100, seed: typing.SupportsInt | typing.SupportsIndex = 0, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> InverseResult:
        """
        Joint angles that bring the tool to poses.
        
        Damped least squares (Sugihara 2011) within the limits, from `start` and then from poses drawn
        within the limits, those first whose tool lies nearest. The result of a pose does not depend on the
        others, nor on the number of threads.
        
        Parameters
        ----------
        poses : (N, 4, 4) or (4, 4) array
            world_from_tool. With task "position" also (N, 3) or (3,) places.
        start : (n,) or (N, n) array, optional
            Where the search begins, within the limits; the answer stays near it where it can, also by whole
            turns. Unless given, near the middle of the limits.
        task : str
            "pose"; "position", the tool centre point alone; "position_axis", and one axis of the tool.
        method : str
            "damped"; or "pseudo_inverse" (also "jacobian_inverse", what it is where J is square), the
            stepping of Maevskiy and Zanin (2020): the way cut into equal `steps`, each by J⁺, without
            limits, damping or a second start; whole turns are taken off at its end.
        axis : (3,) array
            Of "position_axis", in the tool's frame: it is to point as that of the target does.
        position_tolerance, angle_tolerance : float, optional
            [m], [rad]. 1e-6 unless given; with "pseudo_inverse" 1e-2, as in the paper.
        max_iterations : int
            Of one start.
        max_starts : int
            Tried at most, the given one among them.
        candidates : int
            The search goes on until so many starts have reached; the one nearest to `start` is taken.
        centering_steps : int, optional
            Steps that a redundant arm, having reached, takes towards the middle of its limits. Unless
            given, 0 from a start, which it would leave, else 10.
        steps : int
            Of "pseudo_inverse". As all counts here 10⁶ at most.
        seed : int
            Of the drawn starts.
        num_threads : int
            0 is all.
        
        Returns
        -------
        InverseResult
            .q (N, n), .status, .error, .position_error, .angle_error, .iterations, .starts. Statuses:
            "reached"; "limit", reached only beyond the limits; "singular", the search was stuck though the
            pose lies within reach; "out_of_reach".
        
        Examples
        --------
        >>> import bathyal
        >>> arm = bathyal.arms.ur10e()
        >>> q = [0.3, -1.2, 1.4, -0.5, 1.0, 0.2]
        >>> found = arm.inverse(arm.forward(q), start=[0.2, -1, 1, 0, 1, 0])
        >>> found.status, found.q.round(5)
        ('reached', array([ 0.3, -1.2,  1.4, -0.5,  1. ,  0.2]))
        >>> arm.inverse([3.0, 0, 0], task="position").status
        'out_of_reach'
        """
    def jacobian(self, q: numpy.typing.ArrayLike, *, frame: str = 'world', num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> numpy.ndarray:
        """
        Geometric Jacobians at the tool centre point.
        
        Parameters
        ----------
        q : (N, n) or (n,) array
            [rad] or [m]
        frame : str
            Axes along which the velocities are given: "world" or "tool".
        num_threads : int
            0 is all.
        
        Returns
        -------
        (N, 6, n) or (6, n) array
            Rows of the linear velocity [m/s] above those of the angular velocity [rad/s].
        
        Examples
        --------
        >>> import bathyal
        >>> bathyal.arms.panda().jacobian([0, 0, 0, -1.5, 0, 1.5, 0]).shape
        (6, 7)
        """
    def manipulability(self, q: numpy.typing.ArrayLike, *, kind: str = 'yoshikawa', part: str = 'all', num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> float | numpy.ndarray:
        """
        How far poses are from a singularity.
        
        Parameters
        ----------
        q : (N, n) or (n,) array
            [rad] or [m]
        kind : str
            "yoshikawa", √det(J Jᵀ) (Yoshikawa 1985); "smallest" singular value; "inverse_condition",
            smallest over largest: 0 singular, 1 isotropic.
        part : str
            Which rows count: "all" (which mixes metres and radians), "linear" or "angular".
        num_threads : int
            0 is all.
        
        Returns
        -------
        (N,) array or float
            With fewer joints than rows, of the singular values that there are.
        
        Examples
        --------
        >>> import bathyal
        >>> arm = bathyal.Arm.from_dh(a=[0.5, 0.4], alpha=[0, 0], d=[0, 0], theta=[0, 0])
        >>> round(arm.manipulability([0.3, 1.5707963], part="linear"), 6)
        0.2
        """
    def plot(self, q: numpy.typing.ArrayLike | None = None, path: str | os.PathLike[str] | None = None) -> matplotlib.figure.Figure:
        """
        A picture of the arm.
        
        Parameters
        ----------
        q : (n,) or (N, n) array, optional
            [rad] or [m]; at rest unless given.
        path : path, optional
            ``.png``, ``.pdf`` or ``.svg`` to write it to, too: see bathyal.view.arm_views.plot_arm.
        """
    def save(self, path: str | os.PathLike[str]) -> None:
        """
        Write all of it to a file for bathyal.read_arm.
        
        Parameters
        ----------
        path : path
            ``.json``: see bathyal.arm.files.save_arm.
        """
    def show(self, q: numpy.typing.ArrayLike | None = None) -> plotly.graph_objects.Figure:
        """
        An interactive figure of the arm.
        
        Parameters
        ----------
        q : (n,) or (N, n) array, optional
            [rad] or [m]; at rest unless given: see bathyal.view.arm_views.show_arm.
        """
    def statics(self, q: numpy.typing.ArrayLike, wrench: numpy.typing.ArrayLike | None = None, *, frame: str = 'world', gravity: numpy.typing.ArrayLike = (0.0, 0.0, -9.80665), water_density: typing.SupportsFloat | typing.SupportsIndex = 1025.0, payload: typing.SupportsFloat | typing.SupportsIndex = 0.0, payload_center: numpy.typing.ArrayLike = (0, 0, 0), payload_volume: typing.SupportsFloat | typing.SupportsIndex = 0.0, payload_center_of_buoyancy: numpy.typing.ArrayLike | None = None, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> numpy.ndarray:
        """
        Joint torques that hold the arm still.
        
        The drives carry Jᵀ · wrench, the weight of every link and of the payload, less the buoyancy of the
        volumes given. Masses and volumes are those of `links`; unknown ones are 0.
        
        Parameters
        ----------
        q : (N, n) or (n,) array
            [rad] or [m]
        wrench : (6,) or (N, 6) array, optional
            Force and moment that the tool exerts on its surroundings at the tool centre point [N, N m].
        frame : str
            Axes along which the wrench is given: "world" or "tool".
        gravity : (3,) array
            In the arm's base frame [m/s²]: turn it with the vehicle.
        water_density : float
            [kg/m³]; 0 in air.
        payload, payload_volume : float
            Mass [kg] and displaced volume [m³] carried by the tool.
        payload_center, payload_center_of_buoyancy : (3,) array
            In the tool's frame [m]; the second is as the first unless given.
        num_threads : int
            0 is all.
        
        Returns
        -------
        (N, n) or (n,) array
            [N m], of sliding joints [N], positive along the coordinate.
        
        Examples
        --------
        >>> import bathyal
        >>> arm = bathyal.Arm.from_dh(a=[0.5], alpha=[1.5707963267948966], d=[0], theta=[0],
        ...                           root=[[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]])
        >>> arm.statics([0.0], payload=2.0).round(3)
        array([9.807])
        """
    def to_dh(self, *, convention: str = 'standard') -> DhTable:
        """
        The Denavit-Hartenberg table, without base and tool.
        
        Parameters
        ----------
        convention : str
            "standard" or "modified". In the modified convention a root that is no more than
            Tx(a) Rx(alpha) Ry(beta) becomes part of the first row; any other stays `root`.
        
        Returns
        -------
        DhTable
            .a .alpha .d .theta .beta (m,), .joint_types, .root .flange (4, 4)
        
        Examples
        --------
        >>> import bathyal
        >>> bathyal.arms.ur10e().to_dh().a.round(4)
        array([ 0.    , -0.6127, -0.5715,  0.    ,  0.    ,  0.    ])
        """
    def to_urdf(self, path: str | os.PathLike[str] | None = None) -> str:
        """
        The arm as the text of a URDF.
        
        Parameters
        ----------
        path : path, optional
            Where to write it, too: see bathyal.arm.urdf_writer.urdf_of_arm.
        """
    def within_limits(self, q: numpy.typing.ArrayLike) -> bool | numpy.ndarray:
        """
        Whether each pose q (N, n) keeps the limits: (N,) bool; one pose (n,) gives one.
        """
    def write(self, path: str | os.PathLike[str], *, nominal: Arm | None = None) -> None:
        """
        Write a file of the format its suffix names.
        
        Parameters
        ----------
        path : path
            ``.json``, ``.urdf``, ``.yaml``, ``.yml`` or ``.conf``: see bathyal.arm.files.write_arm.
        nominal : Arm, optional
            For ``.conf``: the maker's arm, from which the file gives the differences.
        """
    @property
    def base(self) -> numpy.ndarray:
        """
        (4, 4) world_from_base; may be set, None is the identity.
        """
    @base.setter
    def base(self, arg1: numpy.typing.ArrayLike | None) -> None:
        ...
    @property
    def effort(self) -> numpy.ndarray:
        """
        (n,) greatest torque [N m] or force [N] of that joint.
        """
    @property
    def joint_names(self) -> list[str]:
        """
        One name a coordinate: of the joint that leads it, in the arm or outside it.
        """
    @property
    def joint_types(self) -> list[str]:
        """
        One word a coordinate, "revolute" or "prismatic".
        """
    @property
    def link_names(self) -> list[str]:
        """
        One name a link, the foot first: the order of forward(q, links=True).
        """
    @property
    def links(self) -> list[Link]:
        """
        The Links, the foot first: a list.
        """
    @property
    def lower(self) -> numpy.ndarray:
        """
        (n,) lower limits [rad] or [m], −inf where there is none.
        """
    @property
    def name(self) -> str:
        """
        For people; may be empty.
        """
    @property
    def size(self) -> int:
        """
        Number of coordinates n, the width of every q.
        """
    @property
    def source(self) -> str:
        """
        Where the numbers come from.
        """
    @property
    def tool(self) -> numpy.ndarray:
        """
        (4, 4) flange_from_tool; may be set, None is the identity.
        """
    @tool.setter
    def tool(self, arg1: numpy.typing.ArrayLike | None) -> None:
        ...
    @property
    def upper(self) -> numpy.ndarray:
        """
        (n,) upper limits [rad] or [m], inf where there is none.
        """
    @property
    def velocity(self) -> numpy.ndarray:
        """
        (n,) greatest speed of the joint that leads each coordinate [rad/s] or [m/s].
        """
class Sediment:
    """
    What the model of a rough, penetrable bottom takes (APL-UW TR 9407, 1994).
    
    Ratios are to the water above it; see docs/sonar_model.md. Sand unless given.
    
    Parameters
    ----------
    density_ratio, speed_ratio : float
        Of density and sound speed.
    loss : float
        Imaginary over real wave number.
    volume : float
        Scattering in the volume over its absorption, σ₂.
    spectral_exponent : float
        γ of the relief's spectrum, 2.4 to 3.9.
    spectral_strength : float
        w₂ of the relief's spectrum [cm⁴], at 1 cm⁻¹.
    
    Raises
    ------
    ValueError
        For a number out of its range.
    """
    def __eq__(self, arg0: Sediment) -> bool:
        ...
    def __getstate__(self) -> tuple:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, *, density_ratio: typing.SupportsFloat | typing.SupportsIndex = 1.845, speed_ratio: typing.SupportsFloat | typing.SupportsIndex = 1.1782, loss: typing.SupportsFloat | typing.SupportsIndex = 0.01624, volume: typing.SupportsFloat | typing.SupportsIndex = 0.002, spectral_exponent: typing.SupportsFloat | typing.SupportsIndex = 3.25, spectral_strength: typing.SupportsFloat | typing.SupportsIndex = 0.004446) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    @property
    def density_ratio(self) -> float:
        """
        Of the bottom over the water.
        """
    @property
    def loss(self) -> float:
        """
        Imaginary over real wave number.
        """
    @property
    def spectral_exponent(self) -> float:
        """
        Of the relief's spectrum, γ.
        """
    @property
    def spectral_strength(self) -> float:
        """
        Of the relief's spectrum, w₂ [cm⁴].
        """
    @property
    def speed_ratio(self) -> float:
        """
        Sound speed of the bottom over that of the water.
        """
    @property
    def volume(self) -> float:
        """
        Scattering in the volume over its absorption, σ₂.
        """
class Material:
    """
    How a surface scatters sound back.
    
    By its table where it has one, else by its sediment, else by Lambert's law σ₀ = μ cos²θ; which of
    them a sonar takes is its switch ``backscatter``.
    
    Parameters
    ----------
    name : str
    strength : float
        μ, linear.
    angle, backscatter : (K,) arrays, optional
        A measured law: σ₀ [dB] by the angle of incidence [rad], rising.
    sediment : Sediment, optional
    
    Raises
    ------
    ValueError
        For an empty name, numbers out of their range.
    
    Examples
    --------
    >>> import bathyal
    >>> bathyal.World().material("sand")
    Material("sand", -22 dB, sediment)
    """
    def __eq__(self, arg0: Material) -> bool:
        ...
    def __getstate__(self) -> tuple:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, name: str, strength: typing.SupportsFloat | typing.SupportsIndex = 1.0, *, angle: numpy.typing.ArrayLike | None = None, backscatter: numpy.typing.ArrayLike | None = None, sediment: Sediment | None = None) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    @property
    def angle(self) -> numpy.ndarray | None:
        """
        (K,) angles of incidence of its table [rad], or None.
        """
    @property
    def backscatter(self) -> numpy.ndarray | None:
        """
        (K,) σ₀ of its table [dB], or None.
        """
    @property
    def name(self) -> str:
        """
        Of the material.
        """
    @property
    def sediment(self) -> Sediment | None:
        """
        Sediment, or None.
        """
    @property
    def strength(self) -> float:
        """
        μ of Lambert's law σ₀ = μ cos²θ, linear.
        """
class WorldSnapshot:
    """
    A world at one moment: what rays meet, and of what it is made.
    """
    def __repr__(self) -> str:
        ...
    def material(self, hits: Hits) -> numpy.ndarray:
        """
        Of what each of N rays is made that it met.
        
        Parameters
        ----------
        hits : Hits
            Of ``scene.cast``.
        
        Returns
        -------
        (N,) array of int
            Rows of `materials`, −1 where the ray met nothing.
        
        Raises
        ------
        ValueError
            For hits of another scene, where they name rows or triangles that there are not.
        
        Examples
        --------
        >>> import bathyal
        >>> world = bathyal.World()
        >>> floor = bathyal.TriangleMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        >>> world.add(floor, material="mud")
        0
        >>> now = world.at(0)
        >>> row = now.material(now.scene.cast((1, 1, 3), [[0, 0, -1], [0, 0, 1]]))
        >>> row.tolist(), now.materials[row[0]].name
        ([6, -1], 'mud')
        """
    @property
    def materials(self) -> list[Material]:
        """
        Material of each row.
        """
    @property
    def scene(self) -> Scene:
        """
        Scene: a row for each object.
        """
    @property
    def time(self) -> float:
        """
        [s]
        """
class WorldObject:
    """
    One of a world's objects, as it was when it was asked for.
    """
    def __repr__(self) -> str:
        ...
    def pose(self, time: typing.SupportsFloat | typing.SupportsIndex = 0.0) -> numpy.ndarray:
        """
        (4, 4) world_from_object at a time [s].
        """
    @property
    def material(self) -> str:
        """
        Name of its material; painted regions have others.
        """
    @property
    def mesh(self) -> TriangleMesh:
        """
        TriangleMesh: in its own frame.
        """
    @property
    def moves(self) -> bool:
        """
        Whether its pose changes with time.
        """
    @property
    def name(self) -> str:
        """
        Of the object.
        """
    @property
    def painted(self) -> bool:
        """
        Whether regions of it have other materials.
        """
    @property
    def scale(self) -> float:
        """
        Of the mesh.
        """
class World:
    """
    Seabed, things on it and in the water, what they are made of, and the water.
    
    Frames: z up, [m]. Objects are rows of what rays see, in the order in which they were added.
    
    Examples
    --------
    >>> import bathyal
    >>> world = bathyal.World()
    >>> corners = [[-9, -9, 0], [9, -9, 0], [9, 9, 0], [-9, 9, 0]]
    >>> bottom = bathyal.TriangleMesh(corners, [[0, 1, 2], [0, 2, 3]])
    >>> world.add(bottom, material="sand", name="bottom")
    0
    >>> world.scene.cast([[0, 0, 5]], [[0, 0, -1]]).range
    array([5.])
    """
    def __getstate__(self) -> tuple:
        ...
    def __init__(self) -> None:
        ...
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    def add(self, mesh: TriangleMesh, pose: Trajectory | numpy.typing.ArrayLike | collections.abc.Callable[[float], numpy.typing.ArrayLike] | None = None, material: str = 'sand', name: str = '', *, scale: typing.SupportsFloat | typing.SupportsIndex = 1.0) -> int:
        """
        Adds an object.
        
        Parameters
        ----------
        mesh : TriangleMesh
            In its own frame; meshes given several times are held once.
        pose : (4, 4) array, Trajectory or function, optional
            world_from_object; a function of the time in seconds is called whenever the world is looked at.
        material : str
            One of `materials`.
        name : str
            Not yet taken; "object_3" or the like unless given.
        scale : float
            Of the mesh, above 0.
        
        Returns
        -------
        int
            Its row in `scene`.
        
        Raises
        ------
        ValueError
            For a name that is taken, an unknown material, a pose that is not rigid.
        """
    def add_clones(self, mesh: TriangleMesh, count: typing.SupportsInt | typing.SupportsIndex, material: str = 'rock', name: str = 'clone', *, seed: typing.SupportsInt | typing.SupportsIndex = 0, region: typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(4)"] | None = None, scale: typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(2)"] = [0.7, 1.4], turned: bool = True, tilt: typing.SupportsFloat | typing.SupportsIndex = 0.2, sunk: typing.SupportsFloat | typing.SupportsIndex = 0.15, apart: typing.SupportsFloat | typing.SupportsIndex = 0.0) -> int:
        """
        Scatters copies of a mesh over what is there at time 0.
        
        Rows that share the mesh, named name_0, name_1 and so on.
        
        Parameters
        ----------
        mesh : TriangleMesh
        count : int
        material : str
        name : str
        seed : int
            Of places, sizes and turns; clone i is drawn from a stream of its own.
        region : (4,) floats, optional
            Low x, low y, high x, high y [m]; all that is there unless given.
        scale : (2,) floats
            Least and largest.
        turned : bool
            By any angle about the vertical.
        tilt : float
            At most, about a horizontal axis [rad].
        sunk : float
            Part of its height that lies below the ground.
        apart : float
            Least distance of two of them, seen from above [m].
        
        Returns
        -------
        int
            The first of their rows.
        
        Raises
        ------
        ValueError
            Where there is no ground or no room left for one.
        """
    def at(self, time: typing.SupportsFloat | typing.SupportsIndex = 0.0, *, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> WorldSnapshot:
        """
        What there is at a time.
        
        Only the tree over moving objects is made anew from moment to moment; meshes and their hierarchies
        are shared.
        
        Parameters
        ----------
        time : float
            [s]
        num_threads : int
            0 means all.
        
        Returns
        -------
        WorldSnapshot
        """
    def material(self, name: str | int) -> Material:
        """
        A material by its name, or its row in `materials`.
        
        Returns
        -------
        Material
        
        Raises
        ------
        ValueError
            For a name or a row of none.
        """
    def paint(self, name: str, polygon: numpy.typing.ArrayLike, material: str) -> int:
        """
        Gives those triangles of an object another material whose middle lies within a polygon.
        
        Parameters
        ----------
        name : str
            Of the object.
        polygon : (K, 2) array
            Its corners seen from above [m], at time 0.
        material : str
        
        Returns
        -------
        int
            How many triangles.
        """
    def set_material(self, name: str | Material, strength: typing.SupportsFloat | typing.SupportsIndex = 1.0, *, angle: numpy.typing.ArrayLike | None = None, backscatter: numpy.typing.ArrayLike | None = None, sediment: Sediment | None = None) -> None:
        """
        Adds a material, or replaces the one of that name.
        
        Parameters
        ----------
        name : str or Material
            A Material alone says it all.
        strength : float
            μ of Lambert's law σ₀ = μ cos²θ, linear; the paper's K_d.
        angle, backscatter : (K,) arrays, optional
            A measured law: σ₀ [dB] by the angle of incidence [rad], rising.
        sediment : Sediment, optional
            For the models that compute σ₀ from it.
        
        Raises
        ------
        ValueError
            For an empty name, numbers out of their range, a Material and more.
        
        Examples
        --------
        >>> import bathyal
        >>> world = bathyal.World()
        >>> world.set_material("shell", 0.02, sediment=world.material("gravel").sediment)
        >>> world.material("shell")
        Material("shell", -17 dB, sediment)
        """
    def show(self, time: float = 0.0) -> matplotlib.figure.Figure:
        """
        The world from above, shaded: in a notebook a picture, else `.savefig(path)`.
        
        Parameters
        ----------
        time : float
            At which it is drawn [s].
        
        Returns
        -------
        matplotlib.figure.Figure
        """
    @property
    def materials(self) -> list[str]:
        """
        Names of the materials, in the order of the numbers in a ping's truth.
        """
    @property
    def names(self) -> list[str]:
        """
        Names of the objects, in the order of the scene's rows.
        """
    @property
    def objects(self) -> list[WorldObject]:
        """
        WorldObject of each row of `scene`, as they are now.
        """
    @property
    def scene(self) -> Scene:
        """
        Scene: what rays see at time 0; row i is the object that was added as the ith.
        """
    @property
    def water(self) -> Water:
        """
        Water: of the sonars' and the vehicle's.
        """
    @water.setter
    def water(self, arg1: Water) -> None:
        ...
class SeabedModel:
    """
    A generated bottom as a function of the place, on an endless plane.
    
    Fractal relief, sand ripples with crests that meander and fork, boulders, a trench, a cliff, scour
    around given points. No height depends on how a mesh of it is cut or where it begins. Angles are
    counted from x towards y.
    
    Parameters
    ----------
    seed : int
    depth : float
        The mean height is −depth [m].
    slope, slope_direction : float
        Of the whole bottom, and in which direction it rises [rad].
    relief_rms : float
        Of a relief whose power spectral density goes with k^−exponent [m], 0 for none.
    relief_exponent : float
        Of the spectrum over the plane, 1 to 6; along a line it is one less.
    relief_longest, relief_shortest : float
        Wavelengths between which the spectrum goes [m].
    ripple_height, ripple_wavelength : float
        Trough to crest, 0 for none, and crest to crest [m].
    ripple_direction : float
        Of the current, across the crests [rad].
    ripple_asymmetry : float
        How much longer the stoss side is than the lee side, in wavelengths, 0 to 0.45.
    ripple_meander : float
        Rms by which crests wander, in wavelengths, 0 to 2.
    ripple_defects : float
        Crests that fork: pairs per 36 square wavelengths, 0 to 1.
    ripple_cover, ripple_patch : float
        Share of the bottom that has ripples, and the size of patches of them [m].
    boulder_density, boulder_radius : float
        Domes per m², 0 for none, and the radius of the largest [m]; the smallest have a fifth of it.
    boulder_scour : float
        Depth of the hollow around each, over its height, 0 to 1.
    trench_depth, trench_width, trench_floor : float
        Depth, 0 for none, width between the tops of the walls, and width of the floor [m].
    trench_direction, trench_point : float, (2,) array
        Along it [rad], and a place on its middle line [m].
    cliff_height, cliff_run : float
        Height, 0 for none, and the horizontal distance over which it falls [m].
    cliff_direction, cliff_point : float, (2,) array
        In which it falls [rad], and a place at half its height [m].
    edge_meander : float
        Rms by which trench and cliff wander off their lines [m].
    scour_points : (K, 2) array
        Middles of hollows [m].
    scour_depth, scour_radius : float
        Of each [m].
    num_threads : int
        0: all.
    
    Raises
    ------
    ValueError
        For an option out of its range.
    
    Examples
    --------
    >>> import bathyal
    >>> model = bathyal.SeabedModel(seed=1, relief_rms=0, trench_depth=2.0)
    >>> model.height([0.0, 0.0], [0.0, 10.0])
    array([-2.,  0.])
    >>> model.mesh(10, 0.5)
    TriangleMesh(441 vertices, 800 triangles)
    """
    materials: typing.ClassVar[list] = ['silt', 'sand', 'rock']
    def __init__(self, *, seed: typing.SupportsInt | typing.SupportsIndex = 0, depth: typing.SupportsFloat | typing.SupportsIndex = 0.0, slope: typing.SupportsFloat | typing.SupportsIndex = 0.0, slope_direction: typing.SupportsFloat | typing.SupportsIndex = 0.0, relief_rms: typing.SupportsFloat | typing.SupportsIndex = 0.15, relief_exponent: typing.SupportsFloat | typing.SupportsIndex = 3.25, relief_longest: typing.SupportsFloat | typing.SupportsIndex = 50.0, relief_shortest: typing.SupportsFloat | typing.SupportsIndex = 0.5, ripple_height: typing.SupportsFloat | typing.SupportsIndex = 0.0, ripple_wavelength: typing.SupportsFloat | typing.SupportsIndex = 1.0, ripple_direction: typing.SupportsFloat | typing.SupportsIndex = 0.0, ripple_asymmetry: typing.SupportsFloat | typing.SupportsIndex = 0.2, ripple_meander: typing.SupportsFloat | typing.SupportsIndex = 0.15, ripple_defects: typing.SupportsFloat | typing.SupportsIndex = 0.2, ripple_cover: typing.SupportsFloat | typing.SupportsIndex = 1.0, ripple_patch: typing.SupportsFloat | typing.SupportsIndex = 30.0, boulder_density: typing.SupportsFloat | typing.SupportsIndex = 0.0, boulder_radius: typing.SupportsFloat | typing.SupportsIndex = 0.6, boulder_scour: typing.SupportsFloat | typing.SupportsIndex = 0.18, trench_depth: typing.SupportsFloat | typing.SupportsIndex = 0.0, trench_width: typing.SupportsFloat | typing.SupportsIndex = 4.0, trench_floor: typing.SupportsFloat | typing.SupportsIndex = 1.5, trench_direction: typing.SupportsFloat | typing.SupportsIndex = 0.0, trench_point: numpy.typing.ArrayLike = (0.0, 0.0), cliff_height: typing.SupportsFloat | typing.SupportsIndex = 0.0, cliff_run: typing.SupportsFloat | typing.SupportsIndex = 2.0, cliff_direction: typing.SupportsFloat | typing.SupportsIndex = 0.0, cliff_point: numpy.typing.ArrayLike = (0.0, 0.0), edge_meander: typing.SupportsFloat | typing.SupportsIndex = 0.0, scour_points: numpy.typing.ArrayLike | None = None, scour_depth: typing.SupportsFloat | typing.SupportsIndex = 0.4, scour_radius: typing.SupportsFloat | typing.SupportsIndex = 2.0, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def height(self, x: numpy.typing.ArrayLike, y: numpy.typing.ArrayLike) -> numpy.ndarray:
        """
        Heights z [m] at (N,) places x, y [m]: the same bytes as a mesh's vertices there.
        """
    def material(self, x: numpy.typing.ArrayLike, y: numpy.typing.ArrayLike) -> numpy.ndarray:
        """
        Rows of `materials` at (N,) places x, y [m]: boulders and the face of the cliff are rock, ripples of at least half their height are sand, all else is silt.
        """
    def mesh(self, size: numpy.typing.ArrayLike, spacing: typing.SupportsFloat | typing.SupportsIndex, *, origin: numpy.typing.ArrayLike = (0.0, 0.0)) -> TriangleMesh:
        """
        A mesh of the bottom: squares, each of two triangles, counter-clockwise from above.
        
        Parameters
        ----------
        size : float or (2,) array
            Its sides along x and y [m].
        spacing : float
            Side of a square [m]: the largest that divides the mesh's side and is no larger.
        origin : (2,) array
            Its middle [m]. Tiles whose corners are whole numbers of half squares from zero have the same
            bytes along their borders, and as the whole.
        
        Returns
        -------
        TriangleMesh
            With an attribute ``material`` of the vertices, as `material` gives it.
        
        Raises
        ------
        ValueError
            For a size or spacing that is not above 0, more than 5·10⁷ squares, or ripples shorter than two
            spacings.
        """
class Pipeline:
    """
    A pipeline or cable as it lies; its N stations are rings of the mesh.
    """
    def __repr__(self) -> str:
        ...
    @property
    def bottom(self) -> numpy.ndarray:
        """
        (N,) height of the terrain below [m], NaN without one.
        """
    @property
    def burial(self) -> numpy.ndarray:
        """
        (N,) underside below the bottom [m], 0 or more; NaN without terrain.
        """
    @property
    def center(self) -> numpy.ndarray:
        """
        (N, 3) middle line [m].
        """
    @property
    def gap(self) -> numpy.ndarray:
        """
        (N,) underside above the bottom [m], 0 or more; NaN without terrain.
        """
    @property
    def kp(self) -> numpy.ndarray:
        """
        (N,) along the route [m], horizontal where laid on a terrain.
        """
    @property
    def mesh(self) -> TriangleMesh:
        """
        Closed TriangleMesh; a vertex attribute ``kp`` is the way along the route [m].
        """
    @property
    def span(self) -> numpy.typing.NDArray[numpy.bool]:
        """
        (N,) in a given span, or above the bottom by more than a tenth of the diameter.
        """
class Sensor:
    """
    A sensor of a vehicle, and what is wrong with it.
    
    Its channels by kind, in SI units; "its frame" is the frame of the mount:
    
    - "depth": below the mean surface.
    - "imu": rates of turn x, y, z and specific forces x, y, z, in its frame.
    - "dvl": velocity over ground x, y, z, in its frame.
    - "compass": roll, pitch, yaw of the vehicle [rad]; world_from_vehicle = Rz Ry Rx, yaw
      counterclockwise from the world's x, pitch positive bow down.
    - "gps": position of the antenna in the world x, y, z; only above the surface.
    - "usbl": position of the transponder in the world x, y, z; late by the two-way travel time to the
      ship.
    - "lbl": range to each beacon.
    - "altimeter": altitude.
    - "current": velocity of the water past the sensor x, y, z, in its frame.
    - "rpm": turns of the propeller [1/s].
    - "leak": water in the hull [kg].
    - "modem": one-way travel time from the beacon [s].
    
    Errors are given once for all channels or one a channel, in the channel's unit; 0 unless given.
    
    Parameters
    ----------
    kind : str
    name : str, optional
        Keys the noise, so that no other sensor changes it; the kind unless given.
    rate : float
        Of samples [Hz]; sample k is due at k / rate.
    latency : float
        From validity to arrival [s].
    dropout : float
        Part of the samples that never come.
    range : float
        Beyond it nothing is heard [m]; of a dvl and an altimeter the altitude.
    sound_speed : float
        [m/s]; of usbl, lbl and modem.
    vehicle_from_sensor : (4, 4) array, optional
        The mount.
    beacons : (B, 3) array, optional
        In the world [m]: the ship of "usbl" and "modem", one row; 1 to 12 of "lbl".
    noise : float or array
        Standard deviation of each sample.
    bias : float or array
        Standard deviation of a constant, drawn once a seed.
    scale : float or array
        Standard deviation of a scale error, drawn once a seed, as a part.
    walk : float or array
        Random walk, per √s.
    markov, markov_time : float or array
        Standard deviation and correlation time [s] of a Gauss–Markov drift.
    outlier_rate, outlier_size : float or array
        Part of the samples, and standard deviation of what is added to them.
    quantum : float or array
        Values are multiples of it.
    
    Raises
    ------
    ValueError
        For an unknown kind, a value out of its range (the field is named), or missing beacons.
    
    Examples
    --------
    >>> import bathyal, numpy as np
    >>> gauge = bathyal.Sensor("depth", rate=2.0, noise=0.05)
    >>> time = np.arange(5) / 2
    >>> pose = np.tile(np.eye(4), (5, 1, 1))
    >>> pose[:, 2, 3] = -10.0
    >>> gauge.simulate(time, pose, seed=1).values[:, 0].round(2).tolist()
    [9.97, 10.01, 10.01, 10.01, 9.95]
    """
    def __init__(self, kind: str, *, name: str | None = None, rate: typing.SupportsFloat | typing.SupportsIndex = 1.0, latency: typing.SupportsFloat | typing.SupportsIndex = 0.0, dropout: typing.SupportsFloat | typing.SupportsIndex = 0.0, range: typing.SupportsFloat | typing.SupportsIndex = ..., sound_speed: typing.SupportsFloat | typing.SupportsIndex = 1500.0, vehicle_from_sensor: numpy.typing.ArrayLike | None = None, beacons: numpy.typing.ArrayLike | None = None, noise: float | numpy.typing.ArrayLike = 0.0, bias: float | numpy.typing.ArrayLike = 0.0, scale: float | numpy.typing.ArrayLike = 0.0, walk: float | numpy.typing.ArrayLike = 0.0, markov: float | numpy.typing.ArrayLike = 0.0, markov_time: float | numpy.typing.ArrayLike = 0.0, outlier_rate: float | numpy.typing.ArrayLike = 0.0, outlier_size: float | numpy.typing.ArrayLike = 0.0, quantum: float | numpy.typing.ArrayLike = 0.0) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def simulate(self, time: numpy.typing.ArrayLike, pose: numpy.typing.ArrayLike, *, velocity: numpy.typing.ArrayLike | None = None, acceleration: numpy.typing.ArrayLike | None = None, water_velocity: numpy.typing.ArrayLike | None = None, altitude: numpy.typing.ArrayLike | None = None, propeller_rate: numpy.typing.ArrayLike | None = None, leak: numpy.typing.ArrayLike | None = None, surface: typing.SupportsFloat | typing.SupportsIndex = 0.0, gravity: typing.SupportsFloat | typing.SupportsIndex = 9.81, seed: typing.SupportsInt | typing.SupportsIndex = 0) -> SensorReadings:
        """
        What the sensor reports of a motion.
        
        Samples are taken at the first given time at or after each is due: times should be at least as dense
        as the samples.
        
        Parameters
        ----------
        time : (N,) array
            Rising, from 0 on [s].
        pose : (N, 4, 4) array
            world_from_vehicle.
        velocity : (N, 6) array, optional
            Over ground and of turn, in the vehicle [m/s, rad/s]; at rest unless given.
        acceleration : (N, 6) array, optional
            Change of the numbers of `velocity` [m/s², rad/s²]; 0 unless given.
        water_velocity : (N, 3) array, optional
            In the world [m/s]; 0 unless given.
        altitude : (N,) array, optional
            [m]; NaN where there is no bottom, as everywhere unless given.
        propeller_rate, leak : (N,) array, optional
            [1/s], [kg]; 0 unless given.
        surface : float
            z of the mean sea surface [m]; gps is heard above it.
        gravity : float
            [m/s²]
        seed : int
            Of all noise.
        
        Returns
        -------
        SensorReadings
            Without samples that dropped out.
        
        Raises
        ------
        ValueError
            For times that do not rise or are below 0, other counts of rows, poses that are not rigid, or
            numbers that are not finite.
        """
    @property
    def channels(self) -> int:
        """
        How many values a sample has.
        """
    @property
    def kind(self) -> str:
        """
        What it measures.
        """
    @property
    def latency(self) -> float:
        """
        From validity to arrival [s].
        """
    @property
    def name(self) -> str:
        """
        Keys the noise.
        """
    @property
    def rate(self) -> float:
        """
        Of samples [Hz].
        """
class SensorReadings:
    """
    What a sensor reports, one row a sample.
    
    Parameters
    ----------
    sensor : Sensor
    time : (K,) array
        At which the values were so, rising [s].
    values : (K, C) array
        One column a channel.
    arrival : (K,) array, optional
        At which they are known on board [s]; at once, or as late as the sensor's latency says, unless
        given.
    valid : (K,) array of bool, optional
        False: the sensor says itself that it measured nothing. True unless given.
    
    Raises
    ------
    ValueError
        For times that do not rise, or another count of rows or columns.
    """
    def __init__(self, sensor: Sensor, time: numpy.typing.ArrayLike, values: numpy.typing.ArrayLike, *, arrival: numpy.typing.ArrayLike | None = None, valid: numpy.typing.ArrayLike | None = None) -> None:
        ...
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def arrival(self) -> numpy.ndarray:
        """
        (K,) at which they are known on board [s].
        """
    @property
    def sensor(self) -> Sensor:
        """
        Which they are of.
        """
    @property
    def time(self) -> numpy.ndarray:
        """
        (K,) at which the values were so [s].
        """
    @property
    def valid(self) -> numpy.ndarray:
        """
        (K,) of bool: False where it measured nothing.
        """
    @property
    def values(self) -> numpy.ndarray:
        """
        (K, C), one column a channel.
        """
class NavigationUpdate:
    """
    What became of a reading.
    """
    @property
    def accepted(self) -> bool:
        """
        Whether it also passed the gate.
        """
    @property
    def covariance(self) -> numpy.ndarray:
        """
        (C, C) of the innovation.
        """
    @property
    def innovation(self) -> numpy.ndarray:
        """
        (C,) reading minus predicted.
        """
    @property
    def nis(self) -> float:
        """
        Square of the innovation by its covariance; its mean is C where the filter is right.
        """
    @property
    def used(self) -> bool:
        """
        Whether it says something of the motion, and came in time.
        """
class NavigationTrack:
    """
    Estimates over time, one row each; standard deviations are the filter's own.
    """
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    def accepted(self, device: str) -> numpy.ndarray:
        """
        (K,) of bool: which readings of a device were used and passed the gate.
        """
    def nis(self, device: str) -> numpy.ndarray:
        """
        (K,) normalised innovations squared of a device; NaN where not used.
        """
    @property
    def accel_bias(self) -> numpy.ndarray:
        """
        (N, 3) in the vehicle [m/s²].
        """
    @property
    def current(self) -> numpy.ndarray:
        """
        (N, 2) of the water in the world [m/s].
        """
    @property
    def fix_lever(self) -> numpy.ndarray:
        """
        (N, 3) from where fixes should belong to, in the vehicle [m].
        """
    @property
    def fix_point(self) -> numpy.ndarray:
        """
        (N, 3) where fixes belong to, in the world [m]: the position and the fix lever off it.
        """
    @property
    def gyro_bias(self) -> numpy.ndarray:
        """
        (N, 3) in the vehicle [rad/s].
        """
    @property
    def log_mount(self) -> numpy.ndarray:
        """
        (N, 3) by which the log is turned more than its mount says [rad].
        """
    @property
    def log_scale(self) -> numpy.ndarray:
        """
        (N,) the log reads 1 + this times the speed.
        """
    @property
    def pose(self) -> numpy.ndarray:
        """
        (N, 4, 4) world_from_vehicle.
        """
    @property
    def position(self) -> numpy.ndarray:
        """
        (N, 3) in the world [m].
        """
    @property
    def std(self) -> numpy.ndarray:
        """
        (N, 24) standard deviations of the errors, in the order `NavigationFilter` names.
        """
    @property
    def time(self) -> numpy.ndarray:
        """
        (N,) [s].
        """
    @property
    def velocity(self) -> numpy.ndarray:
        """
        (N, 3) over ground, in the world [m/s].
        """
class NavigationFilter:
    """
    Error-state Kalman filter of position, velocity, attitude and biases.
    
    24 errors: position, velocity, attitude (small turns in the world), gyro bias, accelerometer bias,
    log scale, log mount, current, fix lever; those whose deviations are all 0 stay what they are. The
    world is flat and does not turn, z up. Readings that come late are applied at their own time.
    
    Parameters
    ----------
    devices : sequence of Sensor
        Those whose readings come; their mounts and errors are what the filter takes for granted.
    time : float
        At which it begins [s].
    pose : (4, 4) array, optional
        world_from_vehicle then; the identity unless given.
    velocity : (3,) array
        Over ground then, in the world [m/s].
    record : bool
        Whether all it does is kept for `smooth`, some 12 kB a step.
    initial_position, initial_velocity, initial_attitude : float or (3,) array
        Standard deviations of the start, along and about the world's axes [m, m/s, rad].
    **options : float
        initial_gyro_bias [rad/s], initial_accel_bias [m/s²], gyro_noise [rad/√s], gyro_walk [rad/s/√s],
        accel_noise [m/s/√s], accel_walk [m/s²/√s]; log_noise [m/s] and log_walk [m/√s] of a motion
        reckoned by `predict_motion`; log_scale (a part), log_mount [rad], current [m/s] with
        current_time [s], fix_lever [m]; gravity [m/s²], mean_surface [m], gate (readings less probable
        than 1 − gate are refused; 1: none), lag (how late readings may come [s]).
    
    Raises
    ------
    ValueError
        For a name that is none of them, a value out of its range, two devices of one name, or a pose
        that is not rigid.
    
    Examples
    --------
    >>> import bathyal
    >>> gps = bathyal.Sensor("gps", noise=0.5)
    >>> navigation = bathyal.NavigationFilter([gps], initial_position=10.0, log_walk=0.1)
    >>> for second in range(5):
    ...     navigation.predict_motion(float(second), [0.0, 0.0, 0.0], [1.5, 0.0, 0.0])
    >>> navigation.update("gps", 4.0, [6.5, 0.0, 0.0]).accepted
    True
    >>> navigation.position.round(2).tolist()
    [6.5, 0.0, 0.0]
    """
    def __init__(self, devices: collections.abc.Sequence[Sensor] = [], *, time: typing.SupportsFloat | typing.SupportsIndex = 0.0, pose: numpy.typing.ArrayLike | None = None, velocity: numpy.typing.ArrayLike = (0.0, 0.0, 0.0), record: bool = False, initial_position: float | numpy.typing.ArrayLike = 0.0, initial_velocity: float | numpy.typing.ArrayLike = 0.0, initial_attitude: float | numpy.typing.ArrayLike = 0.0, **kwargs: float) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def predict(self, time: typing.SupportsFloat | typing.SupportsIndex, rate: numpy.typing.ArrayLike, force: numpy.typing.ArrayLike) -> None:
        """
        By an inertial sample.
        
        Between samples rates and forces change linearly; the first one only begins.
        
        Parameters
        ----------
        time : float
            After the one before [s].
        rate : (3,) array
            Of turn, in the vehicle [rad/s].
        force : (3,) array
            Specific force at the vehicle's origin, in the vehicle [m/s²]; at rest 9.81 up.
        
        Raises
        ------
        ValueError
            For a time that does not rise, or numbers that are not finite.
        """
    def predict_motion(self, time: typing.SupportsFloat | typing.SupportsIndex, attitude: numpy.typing.ArrayLike, velocity: numpy.typing.ArrayLike) -> None:
        """
        By a reported attitude and a velocity log.
        
        The turn since the last report counts, not the attitude itself: a constant error of it is one of the
        start's attitude.
        
        Parameters
        ----------
        time : float
            After the one before [s].
        attitude : (3,) array
            Roll, pitch, yaw as reported [rad].
        velocity : (3,) array
            In the vehicle [m/s]: over ground, or through the water where the option `current` is above 0.
        
        Raises
        ------
        ValueError
            For a time that does not rise, or numbers that are not finite.
        """
    def restore(self, state: bytes) -> None:
        """
        Goes back to a state as `to_bytes` gave it; a record begins anew.
        """
    def run(self, readings: collections.abc.Sequence[SensorReadings], *, every: typing.SupportsInt | typing.SupportsIndex = 1) -> NavigationTrack:
        """
        All readings of several sensors, as they arrive.
        
        Parameters
        ----------
        readings : sequence of SensorReadings
            One of them of an imu.
        every : int
            Which estimates are kept: one in so many samples of the imu.
        
        Returns
        -------
        NavigationTrack
        
        Raises
        ------
        ValueError
            For a sensor that is none of the filter's devices; as `update`.
        """
    def smooth(self) -> NavigationTrack:
        """
        The best estimate at each prediction given all readings, those after it too; needs record=True.
        """
    def to_bytes(self) -> bytes:
        """
        Its whole state but the record: equal states have equal bytes.
        """
    def update(self, device: str, time: typing.SupportsFloat | typing.SupportsIndex, values: numpy.typing.ArrayLike) -> NavigationUpdate:
        """
        By a reading of a device, at the reading's own time.
        
        One of an imu predicts. Kinds that say nothing of the motion, and readings older than the lag, are
        not used.
        
        Parameters
        ----------
        device : str
            Its name.
        time : float
            Of the reading [s]; at most a second after the filter's.
        values : array
            One a channel.
        
        Returns
        -------
        NavigationUpdate
        
        Raises
        ------
        ValueError
            For an unknown device, another count of values, a time too far ahead, or values that are not
            finite.
        """
    @property
    def accel_bias(self) -> numpy.ndarray:
        """
        (3,) in the vehicle [m/s²].
        """
    @property
    def covariance(self) -> numpy.ndarray:
        """
        (24, 24) of its errors, in the order the class names.
        """
    @property
    def current(self) -> numpy.ndarray:
        """
        (2,) of the water in the world [m/s].
        """
    @property
    def gyro_bias(self) -> numpy.ndarray:
        """
        (3,) in the vehicle [rad/s].
        """
    @property
    def log_scale(self) -> float:
        """
        The log reads 1 + this times the speed.
        """
    @property
    def pose(self) -> numpy.ndarray:
        """
        (4, 4) world_from_vehicle.
        """
    @property
    def position(self) -> numpy.ndarray:
        """
        (3,) in the world [m].
        """
    @property
    def time(self) -> float:
        """
        [s]
        """
    @property
    def velocity(self) -> numpy.ndarray:
        """
        (3,) over ground, in the world [m/s].
        """
class HullReport:
    """
    What is wrong with the mesh of a hull, as numbers.
    
    Vertices of equal position count as one. ``print`` it to read it; `warnings` has a sentence for each
    thing that is wrong.
    """
    def __repr__(self) -> str:
        ...
    def __str__(self) -> str:
        ...
    @property
    def area(self) -> float:
        """
        Area of the surface [m²].
        """
    @property
    def boundary_edges(self) -> int:
        """
        Edges of one triangle only.
        """
    @property
    def closed(self) -> bool:
        """
        Whether along every edge as many triangles run one way as the other.
        """
    @property
    def degenerate_triangles(self) -> int:
        """
        Triangles lower than 1e-12 of their longest edge.
        """
    @property
    def high(self) -> numpy.ndarray:
        """
        (3,) greatest corner of the bounding box [m].
        """
    @property
    def inconsistent_edges(self) -> int:
        """
        Edges whose two triangles run the same way along it.
        """
    @property
    def inside_out(self) -> bool:
        """
        Whether the normals point inwards, all in all; inside is the same.
        """
    @property
    def intersecting_pairs(self) -> int:
        """
        Pairs of triangles that meet other than by a corner or an edge that they share, decided exactly.
        """
    @property
    def low(self) -> numpy.ndarray:
        """
        (3,) least corner of the bounding box [m].
        """
    @property
    def nonmanifold_edges(self) -> int:
        """
        Edges of three triangles or more.
        """
    @property
    def open_edges(self) -> int:
        """
        Edges along which the triangles do not cancel.
        """
    @property
    def opposed_parts(self) -> int:
        """
        Pieces of a closed surface wound against the whole: cavities, or mistakes.
        """
    @property
    def overlapping_parts(self) -> int:
        """
        Pairs of pieces whose surfaces cross.
        """
    @property
    def parts(self) -> int:
        """
        Pieces joined by edges.
        """
    @property
    def triangle_count(self) -> int:
        """
        Triangles of the mesh.
        """
    @property
    def volume(self) -> float:
        """
        Inside a closed surface, overlaps counted twice [m³]; NaN of an open one.
        """
    @property
    def warnings(self) -> list[str]:
        """
        A short sentence for each thing that is wrong; empty for a sound hull.
        """
class Voxels:
    """
    A box of cubes and which of their middles lie inside a hull.
    
    Voxel (i, j, k) begins at ``origin + size * (i, j, k)``.
    """
    def __repr__(self) -> str:
        ...
    def plot(self, path: str | os.PathLike[str]) -> None:
        """
        Draw slices of the voxels, one across each axis, where most is inside.
        
        Parameters
        ----------
        path : path
            Of a PNG: see bathyal.view.voxels.voxels_figure.
        """
    @property
    def inside(self) -> numpy.ndarray:
        """
        (nx, ny, nz) bool: whether the voxel's middle lies inside.
        """
    @property
    def origin(self) -> numpy.ndarray:
        """
        (3,) corner of the first voxel, in the hull's frame [m].
        """
    @property
    def size(self) -> float:
        """
        Edge of a voxel [m].
        """
class Hull:
    """
    The body of a vehicle, which an arm must stay out of.
    
    Any mesh that encloses a volume will do: inside out, self-intersecting, in several parts or with
    holes; `report` says what is wrong with it. Inside is what ``bathyal.Scene(mesh).contains`` says
    (generalised winding number), found sooner. Any number of threads may query it at once.
    
    Parameters
    ----------
    mesh : TriangleMesh
        In the vehicle's frame [m]: x forward, y port, z up.
    num_threads : int
        For the build; 0 means all.
    
    Raises
    ------
    ValueError
        For a mesh that encloses nothing: without triangles, or flat.
    
    Examples
    --------
    >>> import bathyal
    >>> tetrahedron = bathyal.TriangleMesh([[0, 0, 0], [3, 0, 0], [0, 3, 0], [0, 0, 3]],
    ...                                    [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    >>> hull = bathyal.Hull(tetrahedron)
    >>> hull, hull.contains([[0.5, 0.5, 0.5], [5, 5, 5]]).tolist()
    (Hull(4 triangles, closed), [True, False])
    >>> hull.report.volume, hull.report.warnings
    (4.5, [])
    """
    def __getstate__(self) -> tuple[numpy.ndarray, numpy.ndarray]:
        ...
    def __init__(self, mesh: TriangleMesh, *, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    def contains(self, points: numpy.typing.ArrayLike, *, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> numpy.ndarray:
        """
        Whether each point lies inside.
        
        The answer of ``bathyal.Scene(mesh).contains``; a point on the surface is inside. Of 1000 points and
        more each is first looked up in a grid of voxels, made at the first such call: where no triangle
        passes through its voxel, the voxel's answer holds, elsewhere the triangles between the point and a
        point of known winding number are counted.
        
        Parameters
        ----------
        points : (N, 3) array
            In the vehicle's frame [m], finite.
        num_threads : int
            0 means all.
        
        Returns
        -------
        (N,) array of bool
        """
    def signed_distance(self, points: numpy.typing.ArrayLike, *, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> numpy.ndarray:
        """
        Distance to the surface, below 0 inside.
        
        Parameters
        ----------
        points : (N, 3) array
            In the vehicle's frame [m], finite.
        num_threads : int
            0 means all.
        
        Returns
        -------
        (N,) array
            [m]
        """
    def voxels(self, size: typing.SupportsFloat | typing.SupportsIndex, *, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> Voxels:
        """
        The hull's bounding box filled with voxels.
        
        The array of inside voxels of Maevskiy, Zanin (2020), Modular control systems for manipulators and
        intervention-class AUVs; a voxel is inside where its middle is.
        
        Parameters
        ----------
        size : float
            Edge of a voxel [m]; no more than 2²⁸ voxels.
        num_threads : int
            0 means all.
        
        Returns
        -------
        Voxels
            ``.origin`` (3,), ``.size``, ``.inside`` (nx, ny, nz) bool. The box is centred on the hull's.
        
        Examples
        --------
        >>> import bathyal
        >>> tetrahedron = bathyal.TriangleMesh([[0, 0, 0], [3, 0, 0], [0, 3, 0], [0, 0, 3]],
        ...                                    [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
        >>> voxels = bathyal.Hull(tetrahedron).voxels(0.5)
        >>> voxels.inside.shape, int(voxels.inside.sum()), bool(voxels.inside[0, 0, 0])
        ((6, 6, 6), 35, True)
        """
    @property
    def mesh(self) -> TriangleMesh:
        """
        The mesh, in the vehicle's frame.
        """
    @property
    def report(self) -> HullReport:
        """
        HullReport: what is wrong with the mesh. Made when first asked for.
        """
class KeepOut:
    """
    A volume that an arm must stay out of.
    
    Made by `sphere`, `box`, `cylinder`, `cone`, `half_space` or `mesh`. Lengths in metres, angles in
    radians; points and distances are in the frame that it names, distances below 0 inside. All but
    `mesh` are convex, with exact distances, inside too.
    
    Examples
    --------
    >>> import bathyal
    >>> modem = bathyal.KeepOut.sphere(0.5, (0, 0, 1), frame="hull", name="modem")
    >>> modem
    KeepOut.sphere(frame="hull", name="modem")
    >>> modem.distance([[0, 0, 1], [0, 0, 3]]).tolist()
    [-0.5, 1.5]
    """
    @staticmethod
    def box(size: numpy.typing.ArrayLike, pose: numpy.typing.ArrayLike | None = None, *, frame: str = 'hull', name: str | None = None) -> KeepOut:
        """
        A box.
        
        Parameters
        ----------
        size : (3,) array
            Full lengths along x, y and z of its own frame, whose origin is its middle [m], above 0.
        pose : (4, 4) array, optional
            frame_from_box; identity unless given.
        frame, name
            As `sphere`.
        
        Examples
        --------
        >>> import bathyal
        >>> bathyal.KeepOut.box((2, 1, 1)).distance([[0, 0, 0], [2, 0, 0]]).tolist()
        [-0.5, 1.0]
        """
    @staticmethod
    def cone(length: typing.SupportsFloat | typing.SupportsIndex, pose: numpy.typing.ArrayLike | None = None, *, radius: typing.SupportsFloat | typing.SupportsIndex | None = None, angle: typing.SupportsFloat | typing.SupportsIndex | None = None, frame: str = 'hull', name: str | None = None) -> KeepOut:
        """
        A cone with a flat end: the beam of an optical modem.
        
        Parameters
        ----------
        length : float
            From the apex, the origin of its own frame, along +z to the flat end [m], above 0.
        pose : (4, 4) array, optional
            frame_from_cone; identity unless given.
        radius : float
            Of the flat end [m], above 0; or
        angle : float
            Full opening angle at the apex [rad], above 0 and below π.
        frame, name
            As `sphere`.
        
        Examples
        --------
        >>> import bathyal
        >>> beam = bathyal.KeepOut.cone(5.0, radius=5.0, frame="hull", name="modem beam")
        >>> beam.contains([[1, 0, 2], [2, 0, 1]]).tolist()
        [True, False]
        """
    @staticmethod
    def cylinder(radius: typing.SupportsFloat | typing.SupportsIndex, length: typing.SupportsFloat | typing.SupportsIndex, pose: numpy.typing.ArrayLike | None = None, *, frame: str = 'hull', name: str | None = None) -> KeepOut:
        """
        A cylinder along z of its own frame.
        
        Parameters
        ----------
        radius, length : float
            [m], above 0; the middle is the origin of its own frame.
        pose : (4, 4) array, optional
            frame_from_cylinder; identity unless given.
        frame, name
            As `sphere`.
        
        Examples
        --------
        >>> import bathyal
        >>> bathyal.KeepOut.cylinder(0.5, 2).distance([[0, 0, 0], [0, 0, 3]]).tolist()
        [-0.5, 2.0]
        """
    @staticmethod
    def half_space(normal: numpy.typing.ArrayLike, offset: typing.SupportsFloat | typing.SupportsIndex | None = None, *, point: numpy.typing.ArrayLike | None = None, frame: str = 'hull', name: str | None = None) -> KeepOut:
        """
        Everything behind a plane.
        
        Parameters
        ----------
        normal : (3,) array
            Towards the free side, any length but 0.
        offset : float
            The plane is ``normal · x = offset``; or
        point : (3,) array
            A point of the plane [m].
        frame, name
            As `sphere`.
        
        Examples
        --------
        >>> import bathyal
        >>> below = bathyal.KeepOut.half_space((0, 0, 2), point=(0, 0, -1), frame="world")
        >>> below.distance([[3, 4, 1], [0, 0, -2]]).tolist()
        [2.0, -1.0]
        """
    @staticmethod
    def mesh(mesh: TriangleMesh | Hull, *, frame: str = 'hull', name: str | None = None) -> KeepOut:
        """
        What a mesh encloses.
        
        Parameters
        ----------
        mesh : TriangleMesh or Hull
            In the frame it is fixed to [m]; inside as `Hull` has it.
        frame, name
            As `sphere`.
        
        Raises
        ------
        ValueError
            For a mesh that encloses nothing.
        
        Examples
        --------
        >>> import bathyal
        >>> tetrahedron = bathyal.TriangleMesh([[0, 0, 0], [3, 0, 0], [0, 3, 0], [0, 0, 3]],
        ...                                    [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
        >>> bathyal.KeepOut.mesh(tetrahedron, name="crate").contains([[1, 1, 0.5]]).tolist()
        [True]
        """
    @staticmethod
    def sphere(radius: typing.SupportsFloat | typing.SupportsIndex, center: numpy.typing.ArrayLike = (0, 0, 0), *, frame: str = 'hull', name: str | None = None) -> KeepOut:
        """
        A sphere.
        
        Parameters
        ----------
        radius : float
            [m], above 0.
        center : (3,) array
            In the frame it is fixed to [m].
        frame : str
            What it is fixed to: "hull" (the vehicle's frame), "world", or the name of a link.
        name : str, optional
            What reports call it; the kind unless given.
        
        Examples
        --------
        >>> import bathyal
        >>> bathyal.KeepOut.sphere(0.5, (0, 0, 1)).contains([[0, 0, 1.4], [0, 0, 1.6]]).tolist()
        [True, False]
        """
    def __getstate__(self) -> tuple[int, str, str, float, float, numpy.ndarray, numpy.ndarray, numpy.ndarray, float, Hull | None, Trajectory]:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: tuple) -> None:
        ...
    def capsule_distance(self, a: numpy.typing.ArrayLike, b: numpy.typing.ArrayLike, radius: numpy.typing.ArrayLike, *, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> numpy.ndarray:
        """
        Signed distance of capsules.
        
        The least signed distance along the axis, less the radius: a capsule that reaches into the volume
        has a negative one; of a mesh, minus the radius and the depth of the deeper end. Within 1e-12 of the
        sizes.
        
        Parameters
        ----------
        a, b : (N, 3) arrays
            Ends of the axes, in the frame it is fixed to [m].
        radius : float or (N,) array
            [m], 0 or more.
        num_threads : int
            0 means all.
        
        Returns
        -------
        (N,) array
            [m]
        
        Raises
        ------
        ValueError
            For a value that is not finite, a radius below 0, rows that do not match.
        
        Examples
        --------
        >>> import bathyal
        >>> ball = bathyal.KeepOut.sphere(1.0)
        >>> ball.capsule_distance([[-5, 0, 3]], [[5, 0, 3]], 0.5).tolist()
        [1.5]
        """
    def contains(self, points: numpy.typing.ArrayLike, *, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> numpy.ndarray:
        """
        Whether each point lies inside or on the border.
        
        Parameters
        ----------
        points : (N, 3) array
            In the frame it is fixed to [m], finite.
        num_threads : int
            0 means all.
        
        Returns
        -------
        (N,) array of bool
        """
    def distance(self, points: numpy.typing.ArrayLike, *, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> numpy.ndarray:
        """
        Signed distance of each point, below 0 inside.
        
        Parameters
        ----------
        points : (N, 3) array
            In the frame it is fixed to [m], finite.
        num_threads : int
            0 means all.
        
        Returns
        -------
        (N,) array
            [m]
        """
    def moved(self, pose: Trajectory | numpy.typing.ArrayLike | collections.abc.Callable[[float], numpy.typing.ArrayLike] | None) -> KeepOut:
        """
        The same volume carried along: an obstacle that moves.
        
        Parameters
        ----------
        pose : (4, 4) array, Trajectory or callable
            frame_from_given: what was given in the frame is moved by it. A function of the time [s] is
            called every 0.05 s from 0 to 600 s. It takes the place of an earlier one.
        
        Returns
        -------
        KeepOut
            Its own `contains` and `distance` are of the volume as it was given.
        """
    @property
    def border(self) -> Plane | None:
        """
        Plane of a half-space, its normal towards the free side; None of the others.
        """
    @property
    def frame(self) -> str:
        """
        What it is fixed to: "hull" (the vehicle's frame), "world", or the name of a link.
        """
    @property
    def hull(self) -> Hull | None:
        """
        Hull of a mesh; None of the others.
        """
    @property
    def kind(self) -> str:
        """
        "sphere", "box", "cylinder", "cone", "half_space" or "mesh".
        """
    @property
    def length(self) -> float | None:
        """
        Of a cylinder or cone, along its z [m]; None of the others.
        """
    @property
    def motion(self) -> Trajectory:
        """
        Trajectory: how what was given in the frame is moved; at rest unless `moved`.
        """
    @property
    def name(self) -> str:
        """
        What reports call it.
        """
    @property
    def pose(self) -> numpy.ndarray | None:
        """
        (4, 4) frame_from_shape; None of a half-space or mesh, given in the frame itself.
        """
    @property
    def radius(self) -> float | None:
        """
        Of a sphere, cylinder or a cone's end [m]; None of the others.
        """
    @property
    def size(self) -> numpy.ndarray | None:
        """
        (3,) full lengths of a box [m]; None of the others.
        """
class Capsule:
    """
    All points within a radius of a segment, its axis.
    
    Parameters
    ----------
    start, end : (3,) arrays
        Ends of the axis [m]; a ball where they are one point.
    radius : float
        [m], 0 or more.
    
    Raises
    ------
    ValueError
        For an end that is not finite, a radius that is negative or not finite.
    """
    def __init__(self, start: numpy.typing.ArrayLike, end: numpy.typing.ArrayLike, radius: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def end(self) -> numpy.ndarray:
        """
        (3,) [m].
        """
    @property
    def radius(self) -> float:
        """
        [m].
        """
    @property
    def start(self) -> numpy.ndarray:
        """
        (3,) [m].
        """
class Clearances:
    """
    How near each posture comes to what must not be touched.
    
    Links that are compared with nothing are listed in ``Workspace.excluded``. Of a single posture the
    arrays have no first dimension.
    """
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def against(self) -> str | numpy.ndarray:
        """
        (N,) to what: "hull", "scene" or a keep-out's name.
        """
    @property
    def distance(self) -> float | numpy.ndarray:
        """
        (N,) smallest distance of any link to hull, keep-outs and scene [m]: below 0 where they overlap, inf where there is nothing.
        """
    @property
    def link(self) -> str | numpy.ndarray:
        """
        (N,) name of the link that is nearest; empty where there is nothing.
        """
    @property
    def link_point(self) -> numpy.ndarray:
        """
        (N, 3) the nearest point on the axis of the link's capsule, in the vehicle's frame [m].
        """
    @property
    def point(self) -> numpy.ndarray:
        """
        (N, 3) the nearest point of that, in the vehicle's frame [m]; nan where there is nothing.
        """
    @property
    def self_distance(self) -> float | numpy.ndarray:
        """
        (N,) smallest distance between the arm's own links [m].
        """
class MotionCheck:
    """
    The first contact of a motion; falsy where there is one.
    """
    def __bool__(self) -> bool:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def against(self) -> str:
        """
        What it touches: "hull", "scene", a keep-out's name or another link's.
        """
    @property
    def contact(self) -> float:
        """
        Row of the first contact, with the fraction of the way to the next; nan of a free motion.
        """
    @property
    def free(self) -> bool:
        """
        Whether there is no contact.
        """
    @property
    def link(self) -> str:
        """
        Name of the link that touches; empty of a free motion.
        """
    @property
    def time(self) -> float:
        """
        Of the first contact [s]; nan of a free motion, and where no times were given.
        """
class TargetChecks:
    """
    Whether the arm may be sent to each point, and why not.
    """
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def distance(self) -> numpy.ndarray:
        """
        (N,) from the point to the nearest of hull, keep-outs and ground [m], below 0 inside; inf where there is nothing.
        """
    @property
    def keepout(self) -> numpy.ndarray:
        """
        (N,) index of the keep-out that the point lies in, −1 where none.
        """
    @property
    def q(self) -> numpy.ndarray:
        """
        (N, n) a posture that reaches the point, the best that was found; nan where there is none.
        """
    @property
    def status(self) -> numpy.ndarray:
        """
        (N,) the first that holds: "hull" (inside it), "keepout", "ground" (under the bottom), "unreachable" (within the limits, in any orientation), "collision" (only by postures that touch something), "limit" (only with a joint within 0.01 rad, 1 mm of a limit), "free".
        """
class MotionPlan:
    """
    A motion from rest to rest that touches nothing, or why none was found; falsy without one.
    """
    def __bool__(self) -> bool:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def checks(self) -> int:
        """
        Postures and straight motions looked at.
        """
    @property
    def path(self) -> numpy.ndarray | None:
        """
        (K, n) [rad] or [m], straight in joint space between rows; None where there is none.
        """
    @property
    def reason(self) -> str:
        """
        Why there is no path, a sentence; empty if there is.
        """
    @property
    def status(self) -> str:
        """
        "solved", or why there is no path: "start_in_collision", "start_outside_limits", "goal_in_collision" (of a pose or point: in every posture found), "goal_outside_limits", "unreachable" (by no posture), "no_path" (found within the checks), "time_limit" (the safety stop).
        """
    @property
    def time(self) -> numpy.ndarray:
        """
        (K,) of the rows, from 0 at the start, in equal steps [s].
        """
    @property
    def way_out(self) -> numpy.ndarray | None:
        """
        (2, n) from a start that touches or is outside the limits on a short straight line to a posture that is free; None where none is needed, or found.
        """
class StaticTrim:
    """
    How a vehicle hangs in the water.
    
    ``world_from_vehicle = Rz(heading) Ry(pitch) Rx(roll)``, at any heading; the vehicle's x is forward,
    y port, z up. Arrays (N,) of N postures, numbers of a single one.
    """
    def __repr__(self) -> str:
        ...
    @property
    def buoyancy(self) -> float | numpy.ndarray:
        """
        Buoyancy less weight of all [N]; below 0 it sinks.
        """
    @property
    def pitch(self) -> float | numpy.ndarray:
        """
        About y [rad], −π/2 to π/2; positive is nose down. nan where neutral.
        """
    @property
    def righting(self) -> float | numpy.ndarray:
        """
        Moment that turns the vehicle back from a right angle off this attitude [N m]; from a small angle this times the angle.
        """
    @property
    def roll(self) -> float | numpy.ndarray:
        """
        About x [rad], −π to π; positive is starboard down. nan where neutral.
        """
    @property
    def status(self) -> str | numpy.ndarray:
        """
        "upright"; "turned_over", where what is at rest has the vehicle's z axis downwards; "neutral", where every attitude is at rest.
        """
class ReachMap:
    """
    Where the tip of an arm can be, in the vehicle's frame.
    
    A box of cubes around all of the reach: what `Workspace.reach_map` returns and
    `bathyal.read_reach_map` reads. Voxel (i, j, k) begins at ``origin + voxel * (i, j, k)``; answers
    are those of its middle.
    
    Parameters
    ----------
    origin : (3,) array
        Corner of the first voxel, in the vehicle's frame [m].
    voxel : float
        Edge of a voxel [m].
    approach : (K, 3) array
        Unit vectors along which the tool's z axis points.
    reached_along : (nx, ny, nz, K) array of bool
    reached, free : (nx, ny, nz) array of bool
    manipulability, clearance : (nx, ny, nz) array
    
    Raises
    ------
    ValueError
        For arrays whose shapes do not match, vectors that are not of unit length, a voxel that is not
        positive, or a voxel that is free or reached along a direction and not reached.
    """
    def __init__(self, *, origin: numpy.typing.ArrayLike, voxel: typing.SupportsFloat | typing.SupportsIndex, approach: numpy.typing.ArrayLike, reached_along: numpy.typing.ArrayLike, reached: numpy.typing.ArrayLike, free: numpy.typing.ArrayLike, manipulability: numpy.typing.ArrayLike, clearance: numpy.typing.ArrayLike) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def plot(self, path: str | os.PathLike[str]) -> None:
        """
        Draw slices of the map, one across each axis, where most is reached.
        
        Parameters
        ----------
        path : path
            Of a PNG: see bathyal.view.reach.reach_figure.
        """
    def save(self, path: str | os.PathLike[str]) -> None:
        """
        Write the map; `bathyal.read_reach_map` reads it.
        
        Parameters
        ----------
        path : path
            ``.npz``: see bathyal.workspace.reach_files.write_reach_map.
        """
    def show(self) -> plotly.graph_objects.Figure:
        """
        An interactive figure: the voxels as a cloud, coloured by directions.
        
        See bathyal.view.reach_cloud.show_reach.
        """
    @property
    def approach(self) -> numpy.ndarray:
        """
        (K, 3) unit vectors along which the tool's z axis points, in the vehicle's frame.
        """
    @property
    def clearance(self) -> numpy.ndarray:
        """
        (nx, ny, nz) float32: greatest clearance of the postures looked at, at most eleven and no more once one is free [m]; nan where it is not reached or was not asked for.
        """
    @property
    def directions(self) -> numpy.ndarray:
        """
        (nx, ny, nz) uint8: how many of them.
        """
    @property
    def free(self) -> numpy.ndarray:
        """
        (nx, ny, nz) bool: whether one of the postures found keeps clear of obstacles and of the arm itself, the end of the tool allowed to touch the scene.
        """
    @property
    def manipulability(self) -> numpy.ndarray:
        """
        (nx, ny, nz) float32: greatest √det(J Jᵀ) (Yoshikawa 1985) of the postures found with the tip in the voxel; nan where it is not reached.
        """
    @property
    def origin(self) -> numpy.ndarray:
        """
        (3,) corner of the first voxel, in the vehicle's frame [m].
        """
    @property
    def reached(self) -> numpy.ndarray:
        """
        (nx, ny, nz) bool: whether a posture within the limits brings the tip to the voxel's middle, in any orientation, whatever the arm touches.
        """
    @property
    def reached_along(self) -> numpy.ndarray:
        """
        (nx, ny, nz, K) bool: whether the tip reaches the middle with the tool's z axis along each direction of `approach`; of an arm of fewer than five coordinates, with the axis nearest to it. Collisions are not looked at.
        """
    @property
    def voxel(self) -> float:
        """
        Edge of a voxel [m].
        """
class Standpoint:
    """
    Where a vehicle should be, and what its arm reaches from there.
    
    What `bathyal.best_standpoint` returns.
    """
    def __bool__(self) -> bool:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def alternatives(self) -> list[Standpoint]:
        """
        List of the next best, at least 0.2 m or 20 degrees away from better ones; theirs are empty.
        """
    @property
    def pose(self) -> numpy.ndarray | None:
        """
        (4, 4) world_from_vehicle, level; None where there is none.
        """
    @property
    def reached(self) -> numpy.ndarray:
        """
        (N,) bool: whether check_target says "free" of each target.
        """
    @property
    def reason(self) -> str:
        """
        The same as a sentence.
        """
    @property
    def score(self) -> float:
        """
        Number of targets reached and their mean margin, in (0, 1); 0 where none is reached.
        """
    @property
    def status(self) -> str:
        """
        Of the best one: "all" targets are reached, or "some"; else why there is none: "no_reach" (the arm always touches its hull, keep-outs or itself), "no_room" (wherever a target would be reached the hull is too near to bottom or keep-outs), "blocked" (no target is free from the places checked).
        """
class TipMove:
    """
    The tip moved towards a target, as far as it came.
    """
    def __repr__(self) -> str:
        ...
    @property
    def against(self) -> str:
        """
        Of what: "hull", "scene", a keep-out's name or another link's.
        """
    @property
    def angle_error(self) -> float:
        """
        That remains at the end [rad].
        """
    @property
    def joint(self) -> str:
        """
        Name of the joint that is at its limit; empty where there is none.
        """
    @property
    def link(self) -> str:
        """
        Name of the link that is in the way; empty where there is none.
        """
    @property
    def path(self) -> numpy.ndarray:
        """
        (K, n) from the start on [rad] or [m]; all of it free of contact, but for a start that is not.
        """
    @property
    def position_error(self) -> float:
        """
        That remains at the end [m].
        """
    @property
    def reason(self) -> str:
        """
        A short sentence; empty when it was reached.
        """
    @property
    def status(self) -> str:
        """
        "reached"; "stuck": no step brings the tip nearer, by what is near or by a singular posture; "blocked": the next step or the start touches something; "at_limit": held by a joint's limit or sent beyond it; "unreachable": in no posture.
        """
    @property
    def time(self) -> numpy.ndarray:
        """
        (K,) rising [s].
        """
class FollowedPath:
    """
    A tool path as joint motion.
    
    Rows are joined by straight lines in joint space and free of contact between them, too.
    """
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def angle_error(self) -> float:
        """
        Greatest of the rows that are not in transit [rad]; 0 of the task "position".
        """
    @property
    def cut(self) -> list[tuple[int, int, str]]:
        """
        List of (first, last, reason): the tool path from sample `first` to sample `last` is not followed (these two may be, as an end and a beginning), because it is "unreachable", only within reach beyond a "limit", only in "collision", because the arm would have to jump ("singular"), or no way there was found ("no_transit").
        """
    @property
    def cut_by(self) -> list[str]:
        """
        List of the constraint at the beginning of each cut: a link and what it meets, or a joint; empty where neither is known.
        """
    @property
    def fraction(self) -> numpy.ndarray:
        """
        (K,) of the way from that sample to the next one; 0 in transit.
        """
    @property
    def position_error(self) -> float:
        """
        Greatest of the rows that are not in transit [m].
        """
    @property
    def q(self) -> numpy.ndarray:
        """
        (K, n) [rad] or [m].
        """
    @property
    def sample(self) -> numpy.ndarray:
        """
        (K,) sample of the tool path at or before the row, −1 in transit. Samples that coincide share a row, which has the last of them.
        """
    @property
    def time(self) -> numpy.ndarray:
        """
        (K,) rising [s].
        """
class Workspace:
    """
    An arm on a vehicle among what it must not touch.
    
    Maevskiy, Zanin (2020). The arm hangs at `mount`; its own ``arm.base`` plays no part, its tip is
    ``arm.tool``. Targets and goals are in the world, keep-outs in the frame that they name, results in
    the vehicle's frame. Its foot, link 0, is bolted to the vehicle and is compared with nothing.
    Immutable: `attach`, `detach` and `with_vehicle_pose` give another one. Any number of threads may
    query it.
    
    Parameters
    ----------
    arm : Arm
    mount : (4, 4) array, optional
        vehicle_from_base; the identity unless given.
    hull : Hull, optional
        In the vehicle's frame.
    scene : Scene, optional
        In the world: the bottom and what lies on it. Below a surface that faces up is inside.
    keepouts : list of KeepOut
        Each in the frame that it names; obstacles that move are keep-outs that were `moved`.
    vehicle_pose : (4, 4) array, Trajectory or callable, optional
        world_from_vehicle; the identity unless given. A function of the time [s] is called every 0.05 s
        from 0 to 600 s and interpolated; for other times give a Trajectory.
    vehicle_pose_std : (6,) array, optional
        Standard deviations of the vehicle's pose: of the origin along the vehicle's axes [m], then of
        the rotation about them [rad]. Distances to what is fixed to the world are less by three
        standard deviations of where that takes a point, whatever the direction (first order). Of
        `check_target`, whose points are in the world, those to what is fixed to the vehicle.
    vehicle_body : RigidBody, optional
        Of the vehicle without the arm, in the vehicle's frame: for `static_trim`.
    radii : float or (L,) array, optional
        Thickness of the arm, one or one each of L links: capsules along the segments from joint to
        joint [m]. Unless it or `capsules` is given, capsules are fitted to the links' shapes: those for
        collisions, else those for the eye.
    capsules : dict, optional
        By the name of a link a list of Capsules in the link's frame; links not named have none.
    allowed : list of (str, str)
        Pairs of links that may touch, by name.
    
    Raises
    ------
    ValueError
        For poses that are not rigid, a keep-out whose frame is neither "hull", "world" nor a link's
        name, links that are not there.
    
    Warns
    -----
    UserWarning
        Where the arm has no shapes, and is bare segments, or a mesh of it cannot be read; and for what
        `warnings` lists.
    
    Examples
    --------
    >>> import bathyal
    >>> arm = bathyal.Arm.from_dh(a=[0.5, 0.4], alpha=[0, 0], d=[0, 0], theta=[0, 0])
    >>> ball = bathyal.KeepOut.sphere(0.2, (0.9, 0.6, 0), name="ball")
    >>> ws = bathyal.Workspace(arm, keepouts=[ball], radii=0.05)
    >>> near = ws.clearance([0.0, 0.0])
    >>> round(near.distance, 6), near.link, near.against
    (0.35, 'link_2', 'ball')
    >>> ws.check_target([[0.6, 0.3, 0.0], [2.0, 0.0, 0.0]]).status.tolist()
    ['free', 'unreachable']
    """
    def __init__(self, arm: Arm, mount: numpy.typing.ArrayLike | None = None, *, hull: Hull | None = None, scene: Scene | None = None, keepouts: collections.abc.Sequence[KeepOut] = [], vehicle_pose: Trajectory | numpy.typing.ArrayLike | collections.abc.Callable[[float], numpy.typing.ArrayLike] | None = None, vehicle_pose_std: numpy.typing.ArrayLike | None = None, vehicle_body: RigidBody | None = None, radii: numpy.typing.ArrayLike | None = None, capsules: collections.abc.Mapping[str, collections.abc.Sequence[Capsule]] | None = None, allowed: collections.abc.Sequence[tuple[str, str]] = []) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def attach(self, capsules: collections.abc.Sequence[Capsule], body: RigidBody | None = None) -> Workspace:
        """
        The same workspace with a tool or a sample in the arm's hand.
        
        Parameters
        ----------
        capsules : list of Capsule
            Its outline, in the tool's frame (origin in the tool centre point). Not compared with the last
            link.
        body : RigidBody, optional
            What it weighs and displaces, in the tool's frame.
        
        Returns
        -------
        Workspace
            Another one; this one stays as it is.
        """
    def check_motion(self, q_path: numpy.typing.ArrayLike, *, time: numpy.typing.ArrayLike | None = None, stopping: bool = False, acceleration: numpy.typing.ArrayLike | None = None, tip_contact: bool = False) -> MotionCheck:
        """
        Whether a motion is free of contact everywhere.
        
        Rows are joined by straight lines in joint space, and the check is continuous between them: an
        interval is free when in its middle every distance is larger than what the motion to its ends can
        take any point by; else it is halved. No thin plate is stepped over. A body that stays nearer than
        0.01 mm may count as contact.
        
        Parameters
        ----------
        q_path : (M, n) array
            [rad] or [m]; one row is a posture that is held.
        time : (M,) array, optional
            Of each row, rising [s]; needed where the vehicle or a keep-out moves, and for `stopping`.
        stopping : bool
            Whether the arm must be able to stop, too: at every moment it may run on along the line between
            two rows by its stopping distance, speed² / (2 acceleration) of the coordinate that stops last.
            The contact is then the last moment at which an order to stop comes in time.
        acceleration : float or (n,) array, optional
            With which each coordinate brakes [rad/s²] or [m/s²]; unless given its rate limit is reached from
            rest in half a second (1 rad/s², 0.5 m/s² of a joint without one).
        tip_contact : bool
            As of `clearance`.
        
        Returns
        -------
        MotionCheck
        
        Raises
        ------
        ValueError
            For no row, values that are not finite, times that do not rise, or none where they are needed.
        
        Examples
        --------
        >>> import bathyal
        >>> arm = bathyal.Arm.from_dh(a=[0.5, 0.4], alpha=[0, 0], d=[0, 0], theta=[0, 0])
        >>> pole = bathyal.KeepOut.sphere(0.01, (0.0, 0.9, 0.0), name="pole")
        >>> ws = bathyal.Workspace(arm, keepouts=[pole], radii=0.02)
        >>> swing = ws.check_motion([[0.0, 0.0], [3.0, 0.0]])
        >>> swing.free, round(swing.contact, 2), swing.link, swing.against
        (False, 0.51, 'link_2', 'pole')
        """
    def check_target(self, points: numpy.typing.ArrayLike, *, time: typing.SupportsFloat | typing.SupportsIndex = 0.0, seed: typing.SupportsInt | typing.SupportsIndex = 0, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> TargetChecks:
        """
        Whether the arm may be sent to points.
        
        The indicator of Maevskiy, Zanin (2020). Postures are looked for by inverse kinematics of the tip's
        position, in any orientation, from 25 starts; the end of their tool may touch the scene. A redundant
        arm may have a free posture that was not among them.
        
        Parameters
        ----------
        points : (N, 3) array
            In the world [m].
        time : float
            [s]; matters where the vehicle or a keep-out moves.
        seed : int
            Of the starts.
        num_threads : int
            0 means all.
        
        Returns
        -------
        TargetChecks
        
        Raises
        ------
        ValueError
            For a point that is not finite.
        """
    def clearance(self, q: numpy.typing.ArrayLike, *, time: numpy.typing.ArrayLike = 0.0, tip_contact: bool = False, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> Clearances:
        """
        How near postures come to what must not be touched.
        
        Parameters
        ----------
        q : (N, n) or (n,) array
            [rad] or [m]; may lie beyond the limits.
        time : float or (N,) array
            [s]; matters where the vehicle or a keep-out moves.
        tip_contact : bool
            Whether the end of the tool may touch the scene: what lies within two radii (at least 1 mm) and
            `tip_depth` of the tip is then not compared with it.
        num_threads : int
            0 means all.
        
        Returns
        -------
        Clearances
            Of a single posture without the first dimension.
        """
    def detach(self) -> Workspace:
        """
        Another workspace without what was attached; ValueError where nothing was.
        """
    def follow(self, path: ToolPath, *, q_start: numpy.typing.ArrayLike | None = None, task: str = 'position_axis', position_tolerance: typing.SupportsFloat | typing.SupportsIndex = 0.0001, angle_tolerance: typing.SupportsFloat | typing.SupportsIndex = 0.001, step: typing.SupportsFloat | typing.SupportsIndex = 0.01, lift: typing.SupportsFloat | typing.SupportsIndex = 0.1, shortest: typing.SupportsFloat | typing.SupportsIndex = 0.05, transit_speed: typing.SupportsFloat | typing.SupportsIndex = 0.1, transit_rate: typing.SupportsFloat | typing.SupportsIndex = 0.5, clearance: typing.SupportsFloat | typing.SupportsIndex = 0.002, influence: typing.SupportsFloat | typing.SupportsIndex = 0.1, candidates: typing.SupportsInt | typing.SupportsIndex = 8, velocity: numpy.typing.ArrayLike | None = None, acceleration: numpy.typing.ArrayLike | None = None, tip_contact: bool | None = None, time: typing.SupportsFloat | typing.SupportsIndex = 0.0, seed: typing.SupportsInt | typing.SupportsIndex = 0) -> FollowedPath:
        """
        Turns a tool path of `plan_toolpath` into joint motion.
        
        Sample by sample, with rows between where samples are far apart, by the priorities of `move`. It
        begins in that of several postures with which the longest stretch is followed. The path's times are
        kept where the arm can, and stretched near singular postures and wherever rates or accelerations
        would be passed. At a gap, and where a stretch ends, the tool is lifted along a_j, taken across and
        brought down again; what no posture follows is cut out and listed. It begins and ends at rest on the
        path: the way there and away is for `plan`.
        
        Parameters
        ----------
        path : ToolPath
            In the world.
        q_start : (n,) array, optional
            Posture near which to begin [rad] or [m].
        task : {"position_axis", "pose", "position"}
            The turn about the tool's z is free; its x runs along the path, too; or the position alone.
        position_tolerance : float
            At every row [m].
        angle_tolerance : float
            At every row [rad].
        step : float
            Of the tool path between rows at most [m].
        lift : float
            Height at which gaps are crossed, along a_j [m].
        shortest : float
            A stretch between two cuts that is shorter is cut, too [m].
        transit_speed : float
            Of the tip on the way across at most [m/s].
        transit_rate : float
            Of the tool on the way across at most [rad/s].
        clearance : float
            That is kept to what must not be touched [m].
        influence : float
            What is nearer is kept away by redundancy, where there is any [m].
        candidates : int
            Postures tried at the beginning of a stretch.
        velocity : float or (n,) array, optional
            Rate limits [rad/s] or [m/s]; unless given the arm's, 1 rad/s or 0.25 m/s of a joint that has
            none.
        acceleration : float or (n,) array, optional
            [rad/s²] or [m/s²]; unless given each rate limit is reached from rest in half a second.
        tip_contact : bool, optional
            Whether the end of the tool may touch the scene; unless given, where the path has no standoff.
        time : float
            At which it begins [s].
        seed : int
            Of the postures.
        
        Returns
        -------
        FollowedPath
        
        Raises
        ------
        ValueError
            For a workspace in which something moves, a path without samples, options out of range.
        """
    def momentum(self, q: numpy.typing.ArrayLike, velocity: numpy.typing.ArrayLike, *, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> numpy.ndarray:
        """
        Momentum of the arm's links and of what is attached, seen from the vehicle.
        
        Parameters
        ----------
        q, velocity : (N, n) or (n,) array
            Coordinates [rad] or [m], and their rates.
        num_threads : int
            0 means all.
        
        Returns
        -------
        (N, 6) or (6,) array
            Linear [kg m/s], then angular about the vehicle's origin [kg m²/s], in the vehicle's frame.
        
        Raises
        ------
        ValueError
            For arrays of another shape or not finite.
        """
    def move(self, q_start: numpy.typing.ArrayLike, *, point: numpy.typing.ArrayLike | None = None, pose: numpy.typing.ArrayLike | None = None, method: str = 'damped', task: str | None = None, axis: numpy.typing.ArrayLike = (0.0, 0.0, 1.0), position_tolerance: typing.SupportsFloat | typing.SupportsIndex | None = None, angle_tolerance: typing.SupportsFloat | typing.SupportsIndex | None = None, steps: typing.SupportsInt | typing.SupportsIndex = 100, speed: typing.SupportsFloat | typing.SupportsIndex = 0.25, angular_rate: typing.SupportsFloat | typing.SupportsIndex = 0.5, period: typing.SupportsFloat | typing.SupportsIndex = 0.02, clearance: typing.SupportsFloat | typing.SupportsIndex = 0.005, influence: typing.SupportsFloat | typing.SupportsIndex = 0.1, approach: typing.SupportsFloat | typing.SupportsIndex = 0.5, max_steps: typing.SupportsInt | typing.SupportsIndex = 5000, velocity: numpy.typing.ArrayLike | None = None, acceleration: numpy.typing.ArrayLike | None = None, tip_contact: bool = False, time: typing.SupportsFloat | typing.SupportsIndex = 0.0) -> TipMove:
        """
        Moves the tip straight towards a target in the world.
        
        By default damped least squares within joint limits and rates, by strict priorities: joint limits
        and rates; clearance (velocity dampers: Faverjon, Tournassoud 1987); position of the tip; its axis
        or orientation; away from limits and from what is near in what the others leave free. It slides
        along what is in its way and halts where no step brings the tip nearer; a way round is for `plan`.
        "pseudo_inverse" is the stepping of Maevskiy, Zanin (2020): Δq = J⁺ ΔX, ΔX the way to the target
        over `steps`; a forbidden intermediate posture, or one beyond a limit, ends it.
        
        Parameters
        ----------
        q_start : (n,) array
            Where it begins [rad] or [m].
        point : (3,) array, optional
            Where the tip is to be, in the world [m]; this or `pose`.
        pose : (4, 4) array, optional
            world_from_tool; this or `point`.
        method : {"damped", "pseudo_inverse"}
        task : {"pose", "position_axis", "position"}, optional
            What of the pose must be met; "position_axis" leaves the turn about `axis` free. Unless given
            "pose"; of a point "position".
        axis : (3,) array
            In the tool's frame; of "position_axis".
        position_tolerance : float, optional
            [m]; unless given 1e-4, and 1e-2 of "pseudo_inverse" as in the paper.
        angle_tolerance : float, optional
            [rad]; unless given 1e-3, and 1e-2 of "pseudo_inverse".
        steps : int
            k of "pseudo_inverse".
        speed : float
            Of the tip at most [m/s].
        angular_rate : float
            Of the tool at most [rad/s].
        period : float
            Between the steps of "damped" [s]; slowed where limits ask for it.
        clearance : float
            Kept by "damped" [m].
        influence : float
            Below this distance approaching is slowed [m].
        approach : float
            Greatest speed of approach at `influence`, falling to 0 at `clearance` [m/s].
        max_steps : int
            Of "damped".
        velocity : float or (n,) array, optional
            Rate limits [rad/s] or [m/s]; unless given the arm's, 1 rad/s or 0.25 m/s of a joint that has
            none.
        acceleration : float or (n,) array, optional
            [rad/s²] or [m/s²]; unless given each rate limit is reached from rest in half a second.
        tip_contact : bool
            As of `clearance`: whether the end of the tool may touch the scene.
        time : float
            At which it begins [s]; the target is taken as it lies then.
        
        Returns
        -------
        TipMove
        
        Raises
        ------
        ValueError
            For a target that is not finite or not rigid, both or none of `point` and `pose`, values of
            another count, options out of range.
        
        Examples
        --------
        >>> import bathyal
        >>> arm = bathyal.Arm.from_dh(a=[0.5, 0.4], alpha=[0, 0], d=[0, 0], theta=[0, 0])
        >>> ws = bathyal.Workspace(arm, radii=0.05)
        >>> move = ws.move([0.5, 0.5], point=[0.3, 0.6, 0.0])
        >>> move.status, bool(move.position_error <= 1e-4)
        ('reached', True)
        """
    def place_capsules(self, q: numpy.typing.ArrayLike) -> numpy.ndarray:
        """
        The arm's capsules in postures.
        
        Parameters
        ----------
        q : (N, n) or (n,) array
            [rad] or [m].
        
        Returns
        -------
        (N, C, 7) array
            Of each capsule start and end of the axis in the vehicle's frame and the radius [m]; `C` as in
            `capsule_links`. Of a single posture (C, 7).
        """
    def plan(self, q_start: numpy.typing.ArrayLike, goal: numpy.typing.ArrayLike | None = None, *, pose: numpy.typing.ArrayLike | None = None, point: numpy.typing.ArrayLike | None = None, seed: typing.SupportsInt | typing.SupportsIndex = 0, max_checks: typing.SupportsInt | typing.SupportsIndex = 20000, max_seconds: typing.SupportsFloat | typing.SupportsIndex = 60.0, velocity: numpy.typing.ArrayLike | None = None, acceleration: numpy.typing.ArrayLike | None = None, jerk: numpy.typing.ArrayLike | None = None, step: typing.SupportsFloat | typing.SupportsIndex = 0.02, tolerance: typing.SupportsFloat | typing.SupportsIndex = 0.05, tip_contact: bool = False, time: typing.SupportsFloat | typing.SupportsIndex = 0.0) -> MotionPlan:
        """
        A motion to a goal that touches nothing.
        
        The straight motion in joint space where it is free; else two trees of straight motions that grow
        from the start and from the goal towards each other (RRT-Connect, Kuffner, LaValle 2000), each
        checked without gaps as `check_motion`; then shortcuts; then the corners are rounded and the motion
        is timed within speed, acceleration and jerk limits. Limits and `check_motion` are verified again on
        the rows handed out. Where the vehicle or a keep-out moves, the motion is free at its own times.
        
        Give one of `goal`, `pose` and `point`. A pose and a point are reached by one of several postures,
        in the vehicle's place at `time`.
        
        Parameters
        ----------
        q_start : (n,) array
            [rad] or [m].
        goal : (n,) array, optional
            Joint values, taken as they are: no whole turns are left out.
        pose : (4, 4) array, optional
            world_from_tool.
        point : (3,) array, optional
            Of the tip in the world [m], in any orientation.
        seed : int
            Of the search: the same seed gives the same bytes.
        max_checks : int
            Postures and straight motions that are looked at, at most.
        max_seconds : float
            A safety stop [s].
        velocity, acceleration, jerk : float or (n,) array, optional
            Limits of each joint, [rad] or [m] with s, s² and s³. Unless given: the arm's speeds (1 rad/s,
            0.25 m/s where a joint has none), reached from rest in half a second (1 rad/s², 0.5 m/s²), and
            the acceleration within 0.1 s.
        step : float
            Between two rows, at most [s].
        tolerance : float
            How far any joint may leave the straight motions at their corners [rad], [m]; 0: a stop at each.
        tip_contact : bool
            Whether the end of the tool may touch the scene.
        time : float
            Of the start [s]; matters where something moves.
        
        Returns
        -------
        MotionPlan
        
        Raises
        ------
        ValueError
            For a goal that is missing or given twice, of another length or not finite, a pose that is not
            rigid, limits that are not positive.
        
        Examples
        --------
        >>> import bathyal
        >>> arm = bathyal.Arm.from_dh(a=[0.5, 0.4], alpha=[0, 0], d=[0, 0], theta=[0, 0])
        >>> post = bathyal.KeepOut.sphere(0.1, (0.7, 0, 0), name="post")
        >>> ws = bathyal.Workspace(arm, keepouts=[post], radii=0.03)
        >>> plan = ws.plan([-0.6, 0], [0.6, 0])
        >>> plan.status, plan.path.shape[1], bool(ws.check_motion(plan.path))
        ('solved', 2, True)
        >>> ws.plan([-0.6, 0], [0, 0])
        MotionPlan(goal_in_collision: At the goal link_2 touches post.)
        """
    def reach_map(self, *, voxel: typing.SupportsFloat | typing.SupportsIndex = 0.05, directions: typing.SupportsInt | typing.SupportsIndex = 26, samples: typing.SupportsInt | typing.SupportsIndex = 0, seed: typing.SupportsInt | typing.SupportsIndex = 0, check_clearance: bool = True, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> ReachMap:
        """
        Map the reach of the arm on its vehicle.
        
        By forward sampling (Zacharias, Borst, Hirzinger 2007): postures of low discrepancy are swept
        through the range of the first joint; one whose tip lies in a voxel proves that the voxel's middle
        is reached where the first-order step to it stays within the limits and is short. The border is
        settled by inverse kinematics from neighbours' postures. Whether anything collides is looked at
        afterwards, at time 0 where something moves.
        
        Parameters
        ----------
        voxel : float
            Edge of a voxel [m].
        directions : int
            Of approach: 6 (the faces of a cube), 26 (with its edges and corners) or 98.
        samples : int
            Postures drawn, at most 2²¹; 0: one for four voxels, 2¹⁶ at least.
        seed : int
            Of the postures.
        check_clearance : bool
            Whether to make `ReachMap.free` and `ReachMap.clearance`.
        num_threads : int
            0 means all; the same bytes for any number.
        
        Returns
        -------
        ReachMap
        
        Raises
        ------
        ValueError
            For options out of range, or more than 2²⁸ pairs of a voxel and a direction.
        
        Examples
        --------
        >>> import bathyal
        >>> arm = bathyal.Arm.from_dh(a=[0.5, 0.4], alpha=[0, 0], d=[0, 0], theta=[0, 0])
        >>> reach = bathyal.Workspace(arm, radii=0.05).reach_map(voxel=0.08, directions=6)
        >>> reach.reached.shape, int(reach.reached.sum())
        ((27, 27, 3), 396)
        """
    def show(self, q: numpy.typing.ArrayLike, time: numpy.typing.ArrayLike | None = None, *, target: numpy.typing.ArrayLike | None = None) -> bathyal.view.motion_page.MotionPage:
        """
        A page that plays a motion: hull, arm, bottom, keep-outs, clearance.
        
        Parameters
        ----------
        q : (K, n) array
            Joint values [rad] or [m]; one posture (n,) is drawn at rest.
        time : (K,) array, optional
            Of each row [s], rising; 0.1 s from row to row unless given.
        target : (3,) array, optional
            In the world [m].
        
        Returns
        -------
        bathyal.view.motion_page.MotionPage
            Shown by Jupyter; ``.write("motion.html")`` writes it to a file that needs no network.
        
        Raises
        ------
        ValueError
            For rows that are not as many as times, or none.
        """
    def static_trim(self, q: numpy.typing.ArrayLike, *, gravity: typing.SupportsFloat | typing.SupportsIndex = 9.80665, water_density: typing.SupportsFloat | typing.SupportsIndex = 1025.0, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> StaticTrim:
        """
        The attitude in which the vehicle hangs at rest.
        
        Of `vehicle_body`, the arm in a posture and what is attached to it: no moment about the vehicle's
        origin remains, (Σ m r_cg − ρ Σ V r_cb) × g = 0, exact for any angle, and of the two such attitudes
        the stable one. Where weight and buoyancy differ, the remaining vertical force is held at the
        vehicle's origin without a moment (see `StaticTrim.buoyancy`). A mass or volume of 0 of a link,
        unknown, adds nothing.
        
        Parameters
        ----------
        q : (N, n) or (n,) array
            [rad] or [m]; may lie beyond the limits.
        gravity : float
            [m/s²]; scales `StaticTrim.righting` and `.buoyancy`, no angle.
        water_density : float
            [kg/m³]
        num_threads : int
            0 means all.
        
        Returns
        -------
        StaticTrim
            Of a single posture numbers in place of arrays.
        
        Raises
        ------
        ValueError
            For a workspace without `vehicle_body`, or with one without mass or volume; for arguments of
            another shape, not finite or out of range.
        
        Examples
        --------
        >>> import bathyal
        >>> arm = bathyal.Arm.from_dh(a=[0.9], alpha=[0], d=[0], theta=[0])
        >>> body = bathyal.RigidBody(20, center_of_mass=(0, 0, -0.02), volume=20 / 1025)
        >>> ws = bathyal.Workspace(arm, radii=0.05, vehicle_body=body)
        >>> ws = ws.attach([], bathyal.RigidBody(0.1))
        >>> trim = ws.static_trim([0.0])  # 0.1 kg at 0.9 m forward: nose down
        >>> round(trim.pitch, 4), trim.status
        (0.2213, 'upright')
        """
    def with_tip_depth(self, tip_depth: typing.SupportsFloat | typing.SupportsIndex) -> Workspace:
        """
        The same workspace, the tool allowed deeper into the scene.
        
        Parameters
        ----------
        tip_depth : float
            How deep the end of the tool may be in the scene with ``tip_contact=True`` [m], 0 or more: of a
            plan of `plan_sampling` its `depth`.
        
        Returns
        -------
        Workspace
            Another one; this one stays as it is.
        
        Raises
        ------
        ValueError
            For a depth that is negative or not finite.
        """
    def with_vehicle_pose(self, vehicle_pose: Trajectory | numpy.typing.ArrayLike | collections.abc.Callable[[float], numpy.typing.ArrayLike] | None) -> Workspace:
        """
        Another workspace, the vehicle elsewhere: `vehicle_pose` as of the class.
        """
    def wrench(self, q: numpy.typing.ArrayLike, *, contact: numpy.typing.ArrayLike | None = None, time: numpy.typing.ArrayLike = 0.0, velocity: numpy.typing.ArrayLike | None = None, acceleration: numpy.typing.ArrayLike | None = None, gravity: numpy.typing.ArrayLike = (0.0, 0.0, -9.80665), water_density: typing.SupportsFloat | typing.SupportsIndex = 1025.0, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> numpy.ndarray:
        """
        Force and moment on the vehicle by arm, attached body and bottom.
        
        The weight of each link and of what is attached, at its centre of mass, less its buoyancy, at its
        centre of buoyancy, with gravity turned into the vehicle's frame by `vehicle_pose`; the force of the
        bottom on the tool; and, where rates are given, the inertia of what moves: minus the derivative of
        its momentum, the vehicle taken to be at rest. The arm's foot counts with the arm. A mass or volume
        of 0, unknown, adds nothing; water adds neither mass nor drag.
        
        Parameters
        ----------
        q : (N, n) or (n,) array
            [rad] or [m]; may lie beyond the limits.
        contact : (6,) or (N, 6) array, optional
            Force and moment that the bottom exerts on the tool, at the tool centre point along the vehicle's
            axes [N, N m]. (Of the other sign than `Arm.statics`' ``wrench``, which the tool exerts.)
        time : float or (N,) array
            When [s], for a vehicle that moves.
        velocity, acceleration : array of q's shape, optional
            Of the coordinates [rad/s, rad/s²] or [m/s, m/s²]; at rest unless given.
        gravity : (3,) array
            In the world [m/s²].
        water_density : float
            [kg/m³]; 0 in air.
        num_threads : int
            0 means all.
        
        Returns
        -------
        (N, 6) or (6,) array
            Force, then moment about the vehicle's origin, in the vehicle's frame [N, N m].
        
        Raises
        ------
        ValueError
            For arguments of another shape, not finite or out of range.
        
        Examples
        --------
        >>> import bathyal, numpy as np
        >>> arm = bathyal.Arm.from_dh(a=[0.9], alpha=[0], d=[0], theta=[0])  # reaches forward
        >>> ws = bathyal.Workspace(arm, radii=0.05).attach([], bathyal.RigidBody(2.0))
        >>> np.round(ws.wrench([0.0]), 2) + 0  # its weight, and a moment that pitches the nose down
        array([  0.  ,   0.  , -19.61,   0.  ,  17.65,   0.  ])
        """
    @property
    def arm(self) -> Arm:
        """
        A copy. Its base is the mount, in the vehicle's frame.
        """
    @property
    def attached(self) -> RigidBody:
        """
        RigidBody of what is attached, in the tool's frame; without mass where nothing is.
        """
    @property
    def capsule_links(self) -> list[str]:
        """
        List of the links' names, one a capsule, in the order of `place_capsules`.
        """
    @property
    def excluded(self) -> list[tuple[str, str, str]]:
        """
        Pairs that are not compared, as tuples of a link, the other link or obstacle, and the reason: "foot", "neighbours", "allowed", "fixed to it", or "touch in every posture" of 64 drawn.
        """
    @property
    def hull(self) -> Hull | None:
        """
        Hull or None.
        """
    @property
    def keepouts(self) -> list[KeepOut]:
        """
        List of KeepOut.
        """
    @property
    def mount(self) -> numpy.ndarray:
        """
        (4, 4) vehicle_from_base.
        """
    @property
    def moves(self) -> bool:
        """
        Whether distances depend on the time: the vehicle or a keep-out moves.
        """
    @property
    def obstacles(self) -> list[str]:
        """
        List of what links are compared with: "hull", the keep-outs' names, "scene".
        """
    @property
    def scene(self) -> Scene | None:
        """
        Scene or None.
        """
    @property
    def tip_depth(self) -> float:
        """
        How deep the end of the tool may be in the scene with ``tip_contact=True`` [m].
        """
    @property
    def vehicle_body(self) -> RigidBody | None:
        """
        RigidBody or None.
        """
    @property
    def vehicle_pose(self) -> Trajectory:
        """
        Trajectory: world_from_vehicle; of a single pose at rest.
        """
    @property
    def warnings(self) -> list[str]:
        """
        List of what looks like a mistake: a hull whose size or place does not go with the arm's, a keep-out that holds its base.
        """
class SamplingPhase:
    """
    One part of taking a sample, from rest to rest.
    
    Its first row is the last of the phase before. Rows are joined by straight lines in joint space.
    """
    def __repr__(self) -> str:
        ...
    @property
    def first(self) -> int:
        """
        Which row of the whole plan's `time` and `wrench` is this phase's first.
        """
    @property
    def name(self) -> str:
        """
        "approach", "press", "grab", "lift" or "transport".
        """
    @property
    def q(self) -> numpy.ndarray:
        """
        (K, n) [rad] or [m].
        """
    @property
    def retreat(self) -> numpy.ndarray:
        """
        (R, n) from the last row to where the arm is safe: of "approach" its start, of "press", "grab" and "transport" the place before contact, of "lift" the transport posture. Free of contact, as the phase is.
        """
    @property
    def retreat_time(self) -> numpy.ndarray:
        """
        (R,) of the rows of `retreat`, from 0 [s].
        """
    @property
    def time(self) -> numpy.ndarray:
        """
        (K,) of the rows, rising over all phases [s].
        """
    @property
    def tip(self) -> numpy.ndarray:
        """
        (K, 4, 4) vehicle_from_tool of each row.
        """
class SamplingPlan:
    """
    How to take a sample, or why there is no way.
    
    True where there is a plan.
    """
    def __bool__(self) -> bool:
        ...
    def __repr__(self) -> str:
        ...
    def show(self, ws: Workspace) -> bathyal.view.motion_page.MotionPage:
        """
        A page that plays the plan: hull, arm, bottom, keep-outs, clearance, wrench.
        
        Parameters
        ----------
        ws : Workspace
            That it was planned in.
        
        Returns
        -------
        bathyal.view.motion_page.MotionPage
            Shown by Jupyter; ``.write("motion.html")`` writes it to a file that needs no network.
        
        Raises
        ------
        ValueError
            For a plan without phases.
        """
    def write(self, path: str | os.PathLike[str], ws: Workspace) -> None:
        """
        Write the plan; the file appears whole or not at all.
        
        Parameters
        ----------
        path : path
            ``.html``: the page of `show`. ``.png``: a sheet with six moments and the curves.
            ``.csv``: joints, tip, wrench and clearance over time. ``.yaml`` or ``.json``: ROS'
            trajectory_msgs/JointTrajectory.
        ws : Workspace
            That it was planned in.
        
        Raises
        ------
        ValueError
            For another suffix, or a plan without phases.
        OSError
            Where the file cannot be written.
        """
    @property
    def contact(self) -> numpy.ndarray:
        """
        (3,) where the tip meets the bottom, in the world [m].
        """
    @property
    def contact_force(self) -> numpy.ndarray:
        """
        (T,) of the bottom on the tip, against `direction` [N].
        """
    @property
    def depth(self) -> float:
        """
        That the tip is pressed into the bottom [m].
        """
    @property
    def direction(self) -> numpy.ndarray:
        """
        (3,) unit vector into the bottom, in the world.
        """
    @property
    def phases(self) -> list[SamplingPhase]:
        """
        List of five SamplingPhases; empty without a plan.
        """
    @property
    def q(self) -> numpy.ndarray:
        """
        (T, n) rows of all phases, those that two of them share once.
        """
    @property
    def reason(self) -> str:
        """
        Why there is no plan, a sentence; empty if there is.
        """
    @property
    def status(self) -> str:
        """
        "planned", or why there is none: "start" (it, or the transport posture, touches or is outside the limits), "forbidden" (the target is inside hull or keep-out, or deeper under the bottom than `depth`), "no_bottom" (within a standoff of the target), "unreachable", "collision" (only by touching what must not be), "no_approach", "no_transport" (no motion found), "no_retreat" (something moves in its way).
        """
    @property
    def time(self) -> numpy.ndarray:
        """
        (T,) of the rows of `q` [s].
        """
    @property
    def wrench(self) -> numpy.ndarray:
        """
        (T, 6) force and moment on the vehicle by arm, what it holds and bottom, in the vehicle's frame about its origin [N, N m]; in the last row of the grab without the sample.
        """
class VehicleMotion:
    """
    How a vehicle moved, step by step.
    """
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def pose(self) -> numpy.ndarray:
        """
        (K, 4, 4) world_from_vehicle.
        """
    @property
    def time(self) -> numpy.ndarray:
        """
        (K,) [s].
        """
    @property
    def velocity(self) -> numpy.ndarray:
        """
        (K, 6) over ground, linear then angular, in the vehicle's frame [m/s, rad/s].
        """
class Vehicle:
    """
    A vehicle in water.
    
    Its frame is x forward, y port, z up, its origin the centre of buoyancy. Velocities and forces are
    (6,): linear, then angular; force, then moment. `bathyal.vehicles` has published ones.
    
    Parameters
    ----------
    mass : float
        [kg]
    inertia : (3, 3) array
        About the centre of mass [kg m²].
    center_of_mass : (3,) array
        [m]
    volume : float
        Of the water displaced [m³].
    added_mass : (6, 6) array, optional
        Symmetric, of no negative energy; none unless given.
    linear_drag : (6, 6) array, optional
        D of the force −D ν.
    quadratic_drag : (6,) array, optional
        c of the force −c abs(ν) ν along and about each axis; kept as terms.
    terms : list of (row, a, b, absolute, coefficient)
        Parts of the force in the direction `row`: coefficient · ν_a · ν_b, of abs(ν_b) where `absolute`;
        0 to 5 are surge, sway, heave, roll, pitch, yaw.
    parts : (P, 5) array, optional
        Balls that represent it where it leaves the water or meets the bottom: centre [m], radius [m],
        share of the volume. They balance about the origin. Without any it does neither.
    gravity : float
        [m/s²]
    water_density : float
        [kg/m³]
    name : str
    z_down : bool
        The numbers are of axes x forward, y starboard, z down, as most tables are printed; they are
        turned once.
    
    Raises
    ------
    ValueError
        For a value out of its range, or masses that make no positive definite matrix.
    
    Notes
    -----
    M_RB ν̇ + C_RB(ν) ν + M_A ν̇_r + C_A(ν_r) ν_r + D(ν_r) + g(R) = τ + ρ V a, with ν_r the velocity
    through the water and a the water's acceleration (Fossen, Handbook of Marine Craft Hydrodynamics and
    Motion Control, ch. 6 to 8).
    
    Examples
    --------
    >>> import bathyal, numpy as np
    >>> remus = bathyal.vehicles.remus100()
    >>> surge = [True, False, False, False, False, False]
    >>> motion = remus.simulate(np.eye(4), [3.86, 0, 0, 0, 0, 0], 60.0, free=surge)
    >>> motion.velocity[-1, 0].round(3)
    np.float64(1.543)
    """
    @staticmethod
    def bluerov2_heavy() -> Vehicle:
        """
        `bathyal.vehicles.bluerov2_heavy`.
        """
    @staticmethod
    def from_mesh(mesh: TriangleMesh, *, mass: typing.SupportsFloat | typing.SupportsIndex | None = None, center_of_mass: numpy.typing.ArrayLike | None = None, inertia: numpy.typing.ArrayLike | None = None, drag_coefficient: numpy.typing.ArrayLike | None = None, gravity: typing.SupportsFloat | typing.SupportsIndex = 9.80665, water_density: typing.SupportsFloat | typing.SupportsIndex = 1025.0) -> tuple:
        """
        A first model from a closed hull.
        
        Added mass and drag are those of the ellipsoid of equal volume, its half axes as the roots of the
        hull's principal second moments.
        
        Parameters
        ----------
        mesh : TriangleMesh
            Closed; axes x forward, y port, z up.
        mass : float, optional
            [kg]; neutral unless given.
        center_of_mass : (3,) array, optional
            In the mesh's frame [m]; at the centre of volume unless given: then nothing rights it.
        inertia : (3, 3) array, optional
            About the centre of mass [kg m²]; of an even solid unless given.
        drag_coefficient : (3,) array, optional
            C of ½ ρ C A v² along x, y, z, of the ellipsoid's shadow; 1 unless given.
        gravity : float
            [m/s²]
        water_density : float
            [kg/m³]
        
        Returns
        -------
        Vehicle
            Its origin is the hull's centre of volume.
        vehicle_from_mesh : (4, 4) array
        
        Raises
        ------
        ValueError
            For a mesh that is not closed, or values out of range.
        """
    @staticmethod
    def remus100(equal_cross_flow: bool = False) -> Vehicle:
        """
        `bathyal.vehicles.remus100`.
        """
    def __getstate__(self) -> dict:
        ...
    def __init__(self, *, mass: typing.SupportsFloat | typing.SupportsIndex, inertia: numpy.typing.ArrayLike, center_of_mass: numpy.typing.ArrayLike, volume: typing.SupportsFloat | typing.SupportsIndex, added_mass: numpy.typing.ArrayLike | None = None, linear_drag: numpy.typing.ArrayLike | None = None, quadratic_drag: numpy.typing.ArrayLike | None = None, terms: collections.abc.Sequence[tuple[typing.SupportsInt | typing.SupportsIndex, typing.SupportsInt | typing.SupportsIndex, typing.SupportsInt | typing.SupportsIndex, bool, typing.SupportsFloat | typing.SupportsIndex]] = [], parts: numpy.typing.ArrayLike | None = None, gravity: typing.SupportsFloat | typing.SupportsIndex = 9.80665, water_density: typing.SupportsFloat | typing.SupportsIndex = 1025.0, name: str = 'vehicle', z_down: bool = False) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    def acceleration(self, state: numpy.typing.ArrayLike | tuple[numpy.typing.ArrayLike, numpy.typing.ArrayLike], thrust: numpy.typing.ArrayLike, current: numpy.typing.ArrayLike | None = None) -> numpy.ndarray:
        """
        dν/dt under a force.
        
        Parameters
        ----------
        state : (4, 4) array, or (pose, velocity)
            As of `simulate`.
        thrust : (6,) array
            Force and moment about the origin, in the vehicle's frame [N, N m].
        current : (3,) array, optional
            Of the water in the world [m/s].
        
        Returns
        -------
        (6,) array
            [m/s², rad/s²]
        """
    def replace(self, **kwargs: float | str | numpy.typing.ArrayLike | list[tuple[typing.SupportsInt | typing.SupportsIndex, typing.SupportsInt | typing.SupportsIndex, typing.SupportsInt | typing.SupportsIndex, bool, typing.SupportsFloat | typing.SupportsIndex]] | None) -> Vehicle:
        """
        The vehicle with other values.
        
        Parameters
        ----------
        **changes
            Keywords of `Vehicle`; `quadratic_drag` takes the place of the terms along and about an axis by
            its own velocity, squared with its sign.
        
        Returns
        -------
        Vehicle
        
        Raises
        ------
        ValueError
            For a name that is not known, or as `Vehicle`.
        """
    def simulate(self, state: numpy.typing.ArrayLike | tuple[numpy.typing.ArrayLike, numpy.typing.ArrayLike], thrust: numpy.typing.ArrayLike | collections.abc.Callable[[float, numpy.ndarray, numpy.ndarray], numpy.typing.ArrayLike], duration: typing.SupportsFloat | typing.SupportsIndex, step: typing.SupportsFloat | typing.SupportsIndex = 0.01, current: numpy.typing.ArrayLike | collections.abc.Callable[[numpy.ndarray, float], numpy.typing.ArrayLike] | None = None, free: collections.abc.Iterable[bool] | None = None, *, world: World | None = None) -> VehicleMotion:
        """
        Its motion under a force.
        
        By the classical Runge–Kutta method of fourth order with a fixed step, of position, unit quaternion
        and velocity.
        
        Parameters
        ----------
        state : (4, 4) array, or (pose, velocity)
            world_from_vehicle at rest, or with a velocity (6,) over ground in the vehicle's frame.
        thrust : (6,) array or function
            Force and moment about the vehicle's origin, in its frame [N, N m]; or a function of time,
            world_from_vehicle and velocity that gives them, called four times a step.
        duration, step : float
            [s]
        current : (3,) array or function, optional
            Of the water in the world [m/s]; or a function of point and time that gives it, called twelve
            times a step: its change over a step is the water's acceleration, which pushes the vehicle.
        free : six bools, optional
            Surge, sway, heave, roll, pitch, yaw: velocities that are not free stay as they are at the start.
        world : World, optional
            Its water moves the vehicle, where no `current` is given; its surface and bottom act on the
            vehicle's `parts`: lost buoyancy and drag, a damped spring and friction. Objects are where they
            are at time 0.
        
        Returns
        -------
        VehicleMotion
        
        Raises
        ------
        ValueError
            For wrong shapes, or a step beyond the stability limit of the fastest mode, which is named.
        bathyal.Error
            Where the motion runs away.
        """
    @property
    def added_mass(self) -> numpy.ndarray:
        """
        (6, 6)
        """
    @property
    def center_of_mass(self) -> numpy.ndarray:
        """
        (3,) [m]
        """
    @property
    def gravity(self) -> float:
        """
        [m/s²]
        """
    @property
    def inertia(self) -> numpy.ndarray:
        """
        (3, 3) about the centre of mass [kg m²].
        """
    @property
    def linear_drag(self) -> numpy.ndarray:
        """
        (6, 6) D of the force −D ν.
        """
    @property
    def mass(self) -> float:
        """
        [kg]
        """
    @property
    def mass_matrix(self) -> numpy.ndarray:
        """
        (6, 6) of body and added mass about the origin.
        """
    @property
    def name(self) -> str:
        """
        As given.
        """
    @property
    def parts(self) -> numpy.ndarray:
        """
        (P, 5) centre [m], radius [m] and share of the volume.
        """
    @property
    def terms(self) -> list[tuple[int, int, int, bool, float]]:
        """
        Of (row, a, b, absolute, coefficient).
        """
    @property
    def volume(self) -> float:
        """
        [m³]
        """
    @property
    def water_density(self) -> float:
        """
        [kg/m³]
        """
class ThrusterTable:
    """
    Thrust, power and speed measured at commands and voltages.
    
    Parameters
    ----------
    command : (K,) array
        Rising, within −1 to 1.
    voltage : (L,) array
        Rising [V].
    thrust, power, speed : (L, K) array
        [N], [W], [1/s]; thrust and speed astern are negative.
    
    Raises
    ------
    ValueError
        For another shape, numbers that do not rise or are not finite, or power below 0.
    
    See Also
    --------
    bathyal.read_thruster_table
    """
    def __init__(self, command: numpy.typing.ArrayLike, voltage: numpy.typing.ArrayLike, *, thrust: numpy.typing.ArrayLike, power: numpy.typing.ArrayLike, speed: numpy.typing.ArrayLike) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def at(self, command: typing.SupportsFloat | typing.SupportsIndex, voltage: typing.SupportsFloat | typing.SupportsIndex) -> tuple[float, float, float]:
        """
        (thrust [N], power [W], speed [1/s]), bilinear; beyond the ends as at the ends.
        """
    @property
    def command(self) -> numpy.ndarray:
        """
        (K,)
        """
    @property
    def power(self) -> numpy.ndarray:
        """
        (L, K) [W].
        """
    @property
    def speed(self) -> numpy.ndarray:
        """
        (L, K) [1/s].
        """
    @property
    def thrust(self) -> numpy.ndarray:
        """
        (L, K) [N].
        """
    @property
    def voltage(self) -> numpy.ndarray:
        """
        (L,) [V].
        """
class Thruster:
    """
    A thruster in the vehicle's frame.
    
    Its force is ``T = k n|n| − inflow |n| u_a``, with n the propeller's speed, k by the side and u_a
    the speed of the water that it meets (Fossen 2011, eq. 12.224). A table, where there is one, gives what
    is reached in still water. Pairs are (ahead, astern).
    
    Parameters
    ----------
    thrust : (float, float)
        k of n² [N s²].
    speed : (float, float)
        At full command and the nominal voltage [1/s].
    position, direction : (3,) array
        Of the force ahead, in the vehicle's frame [m]; the direction of any length above 0.
    torque : (float, float)
        Of n² [N m s²].
    shape, voltage_exponent : (float, float)
        The speed goes with the command past the dead zone to the one, the voltage over the nominal one
        to the other.
    power_cubic, power_quartic : (float, float)
        Electrical power is ``cubic |n|³ + quartic n⁴`` [W s³], [W s⁴].
    inflow, torque_inflow : float
        Lost by inflow [N s²/m], [N s²].
    spin : int
        1: right-handed; its moment on the vehicle is against `direction`. −1: left-handed.
    dead_zone : float
        Commands up to this size stop it, at the nominal voltage.
    nominal_voltage : float
        [V]
    lag : float
        Time constant of the speed [s].
    table : ThrusterTable, optional
    name : str
    
    Raises
    ------
    ValueError
        For a value out of its range.
    
    Examples
    --------
    >>> import bathyal
    >>> t200 = bathyal.Thruster.t200()
    >>> thrust, power, speed = t200.steady(1.0, 16.0)
    >>> print(f"{thrust:.1f} N, {power:.0f} W, {speed:.1f} turns a second")
    50.9 N, 406 W, 58.8 turns a second
    >>> round(bathyal.Thruster.t200_benchmark().steady(0.97, 16.0)[0], 1)
    30.6
    """
    @staticmethod
    def propeller(*, diameter: typing.SupportsFloat | typing.SupportsIndex, thrust: tuple[typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex], torque: tuple[typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex] = (0.0, 0.0), speed: typing.SupportsFloat | typing.SupportsIndex, water_density: typing.SupportsFloat | typing.SupportsIndex = 1025.0) -> Thruster:
        """
        By the advance ratio J: K_T = thrust[0] + thrust[1] J, K_Q likewise; diameter [m], speed at full command [1/s].
        """
    @staticmethod
    def t200(table: ThrusterTable | None = None) -> Thruster:
        """
        Blue Robotics' T200: the law fitted to their bollard tests, or those tests.
        """
    @staticmethod
    def t200_benchmark() -> Thruster:
        """
        The T200 of von Benzon and others (2022), at most 30.6 N at any voltage.
        """
    def __init__(self, *, thrust: tuple[typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex], speed: tuple[typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex], position: numpy.typing.ArrayLike = (0.0, 0.0, 0.0), direction: numpy.typing.ArrayLike = (1.0, 0.0, 0.0), torque: tuple[typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex] = (0.0, 0.0), shape: tuple[typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex] = (1.0, 1.0), voltage_exponent: tuple[typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex] = (0.0, 0.0), power_cubic: tuple[typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex] = (0.0, 0.0), power_quartic: tuple[typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex] = (0.0, 0.0), inflow: typing.SupportsFloat | typing.SupportsIndex = 0.0, torque_inflow: typing.SupportsFloat | typing.SupportsIndex = 0.0, spin: typing.SupportsInt | typing.SupportsIndex = 1, dead_zone: typing.SupportsFloat | typing.SupportsIndex = 0.0, nominal_voltage: typing.SupportsFloat | typing.SupportsIndex = 16.0, lag: typing.SupportsFloat | typing.SupportsIndex = 0.0, table: ThrusterTable | None = None, name: str = 'thruster') -> None:
        ...
    def __repr__(self) -> str:
        ...
    def advanced(self, speed: typing.SupportsFloat | typing.SupportsIndex, command: typing.SupportsFloat | typing.SupportsIndex, voltage: typing.SupportsFloat | typing.SupportsIndex, time: typing.SupportsFloat | typing.SupportsIndex) -> float:
        """
        The propeller's speed [1/s] a time [s] after `speed`, under a command.
        """
    def command_for(self, thrust: typing.SupportsFloat | typing.SupportsIndex, voltage: typing.SupportsFloat | typing.SupportsIndex) -> float:
        """
        The command whose steady thrust is `thrust` [N]; beyond what it can give, the nearest.
        """
    def placed(self, position: numpy.typing.ArrayLike, direction: numpy.typing.ArrayLike, name: str | None = None) -> Thruster:
        """
        The same thruster elsewhere on the vehicle.
        """
    def steady(self, command: typing.SupportsFloat | typing.SupportsIndex, voltage: typing.SupportsFloat | typing.SupportsIndex) -> tuple[float, float, float]:
        """
        (thrust [N], power [W], speed [1/s]) that it settles at in still water.
        """
    def wrench(self, speed: typing.SupportsFloat | typing.SupportsIndex, relative: numpy.typing.ArrayLike | None = None) -> numpy.ndarray:
        """
        (6,) force and moment about the vehicle's origin by the law, at a propeller's speed [1/s] and a velocity (6,) through the water.
        """
    @property
    def direction(self) -> numpy.ndarray:
        """
        (3,) of length 1.
        """
    @property
    def lag(self) -> float:
        """
        Time constant [s].
        """
    @property
    def name(self) -> str:
        """
        As given.
        """
    @property
    def position(self) -> numpy.ndarray:
        """
        (3,) [m].
        """
    @property
    def speed(self) -> tuple[float, float]:
        """
        At full command [1/s].
        """
    @property
    def thrust(self) -> tuple[float, float]:
        """
        Of n², (ahead, astern).
        """
class ThrusterFit:
    """
    A law fitted to a table.
    """
    @property
    def rms_ahead(self) -> float:
        """
        Of the thrust by speed [N].
        """
    @property
    def rms_astern(self) -> float:
        """
        The same astern [N].
        """
    @property
    def rms_command(self) -> float:
        """
        Of the thrust by command and voltage, both ways [N].
        """
    @property
    def rms_power(self) -> float:
        """
        Of the power by speed [W].
        """
    @property
    def thruster(self) -> Thruster:
        """
        The law, without the table.
        """
class BatteryLoad:
    """
    A battery's voltage and current at one moment.
    """
    @property
    def collapsed(self) -> bool:
        """
        More power is asked for than it can give; then the most that it can.
        """
    @property
    def current(self) -> float:
        """
        [A]
        """
    @property
    def voltage(self) -> float:
        """
        At the terminals [V].
        """
class Battery:
    """
    A source with an inner resistance: V = E(charge) − R I.
    
    Parameters
    ----------
    capacity : float
        [A h]
    resistance : float
        Inner [Ω].
    charge, voltage : (K,) array
        Open-circuit voltage [V] at shares of the capacity, which rise from 0 to 1.
    name : str
    
    Raises
    ------
    ValueError
        For a value out of its range.
    
    Examples
    --------
    >>> import bathyal
    >>> battery = bathyal.Battery.lithium_ion_4s()
    >>> load = battery.solve(800.0)
    >>> print(f"{load.voltage:.2f} V, {load.current:.1f} A")
    13.93 V, 57.4 A
    """
    @staticmethod
    def lithium_ion_4s() -> Battery:
        """
        Four cells in series, 14.8 V, 18 A h; its curve and resistance are typical ones.
        """
    def __init__(self, *, capacity: typing.SupportsFloat | typing.SupportsIndex, resistance: typing.SupportsFloat | typing.SupportsIndex, charge: numpy.typing.ArrayLike, voltage: numpy.typing.ArrayLike, name: str = 'battery') -> None:
        ...
    def __repr__(self) -> str:
        ...
    def open_circuit(self, charge: typing.SupportsFloat | typing.SupportsIndex) -> float:
        """
        Voltage without a load [V] at a share of the capacity; 0 for an empty one.
        """
    def solve(self, power: typing.SupportsFloat | typing.SupportsIndex | collections.abc.Callable[[float], typing.SupportsFloat | typing.SupportsIndex], charge: typing.SupportsFloat | typing.SupportsIndex = 1.0) -> BatteryLoad:
        """
        Voltage and current that agree with each other and the load.
        
        Parameters
        ----------
        power : float or callable
            Drawn [W], or a function of the voltage that gives it.
        charge : float
            Share of the capacity that is left, 0 to 1.
        """
    @property
    def capacity(self) -> float:
        """
        [A h]
        """
    @property
    def resistance(self) -> float:
        """
        [Ω]
        """
class Fin:
    """
    A rudder, stern plane or fixed fin, in the vehicle's frame.
    
    Without an area its force is a published one, ``published u |u| δ``; with one, that of a wing in the
    water that it meets, linear in the angle of attack up to the stall and a flat plate beyond (Beard
    and McLain 2012, Small Unmanned Aircraft, eq. 4.9, 4.10).
    
    Parameters
    ----------
    position : (3,) array
        Of its centre of pressure [m].
    forward, shaft : (3,) array
        The chord at angle 0, towards its leading edge, and the axis it turns about, square to it.
    area : float
        [m²]
    lift_slope : float
        [1/rad]
    drag, induced_drag : float
        Coefficient without lift, and of the lift coefficient's square.
    stall : float
        Angle of attack [rad].
    published : (6,) array, optional
        Force and moment a (m/s)² and rad.
    limit, rate, lag : float
        Largest angle [rad], turning rate [rad/s] (0: any) and time constant [s].
    water_density : float
        [kg/m³]
    name : str
    
    Raises
    ------
    ValueError
        For a value out of its range.
    """
    def __init__(self, *, position: numpy.typing.ArrayLike = (0.0, 0.0, 0.0), forward: numpy.typing.ArrayLike = (1.0, 0.0, 0.0), shaft: numpy.typing.ArrayLike = (0.0, 0.0, 1.0), area: typing.SupportsFloat | typing.SupportsIndex = 0.0, lift_slope: typing.SupportsFloat | typing.SupportsIndex = 0.0, drag: typing.SupportsFloat | typing.SupportsIndex = 0.0, induced_drag: typing.SupportsFloat | typing.SupportsIndex = 0.0, stall: typing.SupportsFloat | typing.SupportsIndex = 0.35, published: numpy.typing.ArrayLike | None = None, limit: typing.SupportsFloat | typing.SupportsIndex = 0.35, rate: typing.SupportsFloat | typing.SupportsIndex = 0.0, lag: typing.SupportsFloat | typing.SupportsIndex = 0.0, water_density: typing.SupportsFloat | typing.SupportsIndex = 1025.0, name: str = 'fin') -> None:
        ...
    def __repr__(self) -> str:
        ...
    def advanced(self, angle: typing.SupportsFloat | typing.SupportsIndex, command: typing.SupportsFloat | typing.SupportsIndex, time: typing.SupportsFloat | typing.SupportsIndex) -> float:
        """
        The angle [rad] a time [s] after `angle`, under a command [rad].
        """
    def coefficients(self, attack: typing.SupportsFloat | typing.SupportsIndex) -> tuple[float, float]:
        """
        (lift, drag) coefficients of a wing at an angle of attack [rad].
        """
    def wrench(self, angle: typing.SupportsFloat | typing.SupportsIndex, relative: numpy.typing.ArrayLike) -> numpy.ndarray:
        """
        (6,) force and moment about the vehicle's origin, at an angle [rad] and a velocity (6,) through the water.
        """
    @property
    def name(self) -> str:
        """
        As given.
        """
class DropWeight:
    """
    Ballast that is held until it is let go. Of mass [kg] and volume [m³] at a (3,) position [m] only the weight in water counts, not the inertia.
    """
    def __init__(self, *, mass: typing.SupportsFloat | typing.SupportsIndex, volume: typing.SupportsFloat | typing.SupportsIndex = 0.0, position: numpy.typing.ArrayLike = (0.0, 0.0, 0.0), name: str = 'drop_weight') -> None:
        ...
    @property
    def mass(self) -> float:
        """
        [kg]
        """
    @property
    def name(self) -> str:
        """
        As given.
        """
class Tether:
    """
    A cable from a point fixed in the world to the vehicle.
    
    It has no motion of its own: an elastic catenary (Irvine 1981, Cable Structures, ch. 2) under its
    weight in water and the drag of the current across it, that of a straight cable from end to end
    spread evenly. The bottom does not carry it.
    
    Parameters
    ----------
    anchor : (3,) array
        In the world [m].
    attachment : (3,) array
        On the vehicle, in its frame [m].
    length : float
        Without load [m].
    weight : float
        In water, a metre [N/m]; below 0: it floats.
    diameter, drag : float
        [m] and coefficient of the flow across it.
    stiffness : float
        Force a unit strain [N].
    water_density : float
        [kg/m³]
    
    Raises
    ------
    ValueError
        For a value out of its range.
    """
    def __init__(self, *, anchor: numpy.typing.ArrayLike, attachment: numpy.typing.ArrayLike = (0.0, 0.0, 0.0), length: typing.SupportsFloat | typing.SupportsIndex, weight: typing.SupportsFloat | typing.SupportsIndex = 0.0, diameter: typing.SupportsFloat | typing.SupportsIndex = 0.0, drag: typing.SupportsFloat | typing.SupportsIndex = 1.2, stiffness: typing.SupportsFloat | typing.SupportsIndex = 100000.0, water_density: typing.SupportsFloat | typing.SupportsIndex = 1025.0) -> None:
        ...
    def wrench(self, pose: numpy.typing.ArrayLike, current: numpy.typing.ArrayLike | None = None) -> numpy.ndarray:
        """
        (6,) force and moment about the origin of a vehicle at a (4, 4) pose, in its frame, in a current (3,) of the world [m/s].
        """
    @property
    def length(self) -> float:
        """
        [m]
        """
class VehicleSystemState:
    """
    All that changes in time of a vehicle and its devices.
    """
    def __copy__(self) -> VehicleSystemState:
        ...
    def __deepcopy__(self, memo: dict) -> VehicleSystemState:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def charge(self) -> float:
        """
        Share of the battery's capacity that is left.
        """
    @charge.setter
    def charge(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def fin_angle(self) -> numpy.ndarray:
        """
        (n,) [rad].
        """
    @property
    def pose(self) -> numpy.ndarray:
        """
        (4, 4) world_from_vehicle.
        """
    @pose.setter
    def pose(self, arg1: numpy.typing.ArrayLike) -> None:
        ...
    @property
    def released(self) -> list[bool]:
        """
        Which drop weights are gone.
        """
    @property
    def thruster_speed(self) -> numpy.ndarray:
        """
        (m,) of the propellers [1/s].
        """
    @thruster_speed.setter
    def thruster_speed(self, arg1: numpy.typing.ArrayLike) -> None:
        ...
    @property
    def velocity(self) -> numpy.ndarray:
        """
        (6,) over ground, in the vehicle's frame [m/s, rad/s].
        """
    @velocity.setter
    def velocity(self, arg1: numpy.typing.ArrayLike) -> None:
        ...
class VehicleSystem:
    """
    A vehicle with thrusters, fins, battery, ballast and tether.
    
    In a step the battery and its loads are solved for one voltage at its start, the devices follow
    their own laws exactly, and the motion is integrated by Runge–Kutta's method of fourth order, thrust
    and lift of each stage from its own velocity.
    
    Parameters
    ----------
    vehicle : Vehicle
    thrusters : list of Thruster
        At most 32.
    fins : list of Fin
    battery : Battery, optional
        Without one the voltage is `supply_voltage`, whatever is drawn.
    supply_voltage : float
        [V]
    hotel_power : float
        Drawn by all that is no thruster [W].
    drop_weights : list of DropWeight
    tether : Tether, optional
    
    Raises
    ------
    ValueError
        For a value out of its range.
    
    Examples
    --------
    >>> import bathyal
    >>> rov = bathyal.VehicleSystem.bluerov2_heavy()
    >>> state = rov.rest()
    >>> rov.step(state, thrusters=[0, 0, 0, 0, 0.4, 0.4, 0.4, 0.4], step=0.01, steps=500)
    >>> bool(state.velocity[2] > 0.3), state.charge < 1.0
    (True, True)
    """
    @staticmethod
    def bluerov2_heavy(*, benchmark_thrusters: bool = False) -> VehicleSystem:
        """
        BlueROV2 Heavy with eight T200 (or `Thruster.t200_benchmark`) and a battery of 18 A h.
        """
    @staticmethod
    def remus100(*, equal_cross_flow: bool = False) -> VehicleSystem:
        """
        REMUS 100 with propeller, rudder (positive: to port) and stern plane (positive: bow down) of Prestero (2001).
        """
    def __init__(self, vehicle: Vehicle, *, thrusters: collections.abc.Sequence[Thruster] = [], fins: collections.abc.Sequence[Fin] = [], battery: Battery | None = None, supply_voltage: typing.SupportsFloat | typing.SupportsIndex = 16.0, hotel_power: typing.SupportsFloat | typing.SupportsIndex = 0.0, drop_weights: collections.abc.Sequence[DropWeight] = [], tether: Tether | None = None) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def rest(self) -> VehicleSystemState:
        """
        At rest at the world's origin, the battery full.
        """
    def step(self, state: VehicleSystemState, *, thrusters: numpy.typing.ArrayLike | None = None, fins: numpy.typing.ArrayLike | None = None, drop: collections.abc.Sequence[bool] = [], current: numpy.typing.ArrayLike | None = None, wrench: numpy.typing.ArrayLike | None = None, step: typing.SupportsFloat | typing.SupportsIndex = 0.01, steps: typing.SupportsInt | typing.SupportsIndex = 1) -> None:
        """
        Changes a state by steps of equal length under the same commands.
        
        Parameters
        ----------
        state : VehicleSystemState
        thrusters : (m,) array
            Commands, −1 to 1; none: all 0.
        fins : (n,) array
            Angles asked for [rad]; none: all 0.
        drop : list of bool
            True lets a weight go.
        current : (3,) array, optional
            Velocity of the water in the world [m/s].
        wrench : (6,) array, optional
            On the vehicle besides its devices', in its frame [N, N m].
        step : float
            [s]
        steps : int
            How many.
        
        Raises
        ------
        ValueError
            For commands of another number than the devices, or not finite.
        bathyal.Error
            Where the motion is no longer finite.
        """
    def supply(self, state: VehicleSystemState, *, thrusters: numpy.typing.ArrayLike | None = None) -> BatteryLoad:
        """
        Voltage and current under (m,) commands, at a state.
        """
    def wrench(self, state: VehicleSystemState, *, thrusters: numpy.typing.ArrayLike | None = None, current: numpy.typing.ArrayLike | None = None) -> numpy.ndarray:
        """
        (6,) force and moment of all devices at a state, about the vehicle's origin.
        """
    @property
    def fins(self) -> list[Fin]:
        """
        In the order of commands.
        """
    @property
    def thrusters(self) -> list[Thruster]:
        """
        In the order of commands.
        """
    @property
    def vehicle(self) -> Vehicle:
        """
        Its equations of motion.
        """
class BehaviorTree:
    """
    A behaviour tree whose leaves are named.
    
    Statuses are those of py_trees (2.x), tick by tick.
    
    Parameters
    ----------
    tree : dict
        ``kind`` is sequence, fallback, parallel, retry, timeout, invert or leaf; ``children`` a list of
        such; ``name`` of a leaf; ``memory`` (True) of a sequence or fallback, ``any`` (False) of a
        parallel, ``count`` of a retry, ``time`` [s] of a timeout.
    
    Raises
    ------
    ValueError
        For a decorator without its one child, a leaf with children, numbers out of range.
    
    Examples
    --------
    >>> import bathyal
    >>> tree = bathyal.BehaviorTree({"kind": "fallback", "children": [
    ...     {"kind": "leaf", "name": "dive"}, {"kind": "leaf", "name": "surface"}]})
    >>> tree.tick(0.0, lambda leaf: "failure" if leaf == "dive" else "running")
    'running'
    >>> tree.statuses
    ['running', 'failure', 'running']
    """
    def __init__(self, tree: dict[str, str | float | bool | list]) -> None:
        ...
    def tick(self, time: typing.SupportsFloat | typing.SupportsIndex, update: collections.abc.Callable[[str], str]) -> str:
        """
        One tick.
        
        Parameters
        ----------
        time : float
            [s], never falling.
        update : function
            Of a leaf's name: "running", "success" or "failure".
        
        Returns
        -------
        str
            Of the root.
        """
    @property
    def statuses(self) -> list[str]:
        """
        Of each node, a node before its children: idle, running, success or failure.
        """
class Condition:
    """
    A condition on named signals, in words.
    
    Comparisons joined by and, or, not and brackets: ``depth > 40 m or battery < 20 %``. Units are m, cm,
    km, s, min, h, %, V, A, deg, rad, m/s and kg. Nothing is evaluated as code.
    
    Parameters
    ----------
    text : str
    signals : list of str
        Names that it may use.
    
    Raises
    ------
    ValueError
        With the column of what is not understood.
    """
    def __init__(self, text: str, signals: collections.abc.Sequence[str]) -> None:
        ...
    def holds(self, values: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex]) -> bool:
        """
        Whether it holds for these values, one a signal; NaN is not known.
        """
    @property
    def text(self) -> str:
        """
        As given.
        """
class MissionPlan:
    """
    A mission, ready to run: `bathyal.read_mission` makes it.
    
    All that a run's outcome depends on but its seed.
    """
    def __init__(self, *, name: str, system: VehicleSystem, vehicle: Vehicle | None, weights: collections.abc.Sequence[DropWeight], hotel_power: typing.SupportsFloat | typing.SupportsIndex, world: World, sensors: list[Sensor], navigation: dict[str, str | float | numpy.typing.ArrayLike | list | dict], start: numpy.typing.ArrayLike, commands: list[dict[str, str | float | numpy.typing.ArrayLike | list | dict]], tree: dict[str, str | float | numpy.typing.ArrayLike | list | dict], guards: list[dict[str, str | float | numpy.typing.ArrayLike | list | dict]], faults: list[dict[str, str | float | numpy.typing.ArrayLike | list | dict]], step: typing.SupportsFloat | typing.SupportsIndex = 0.02, steps_per_tick: typing.SupportsInt | typing.SupportsIndex = 5, longest: typing.SupportsFloat | typing.SupportsIndex = 14400.0) -> None:
        ...
    @property
    def fins(self) -> list[str]:
        """
        Their names, in the order of angles.
        """
    @property
    def name(self) -> str:
        """
        As given.
        """
    @property
    def sensors(self) -> list[Sensor]:
        """
        In their order.
        """
    @property
    def signals(self) -> list[str]:
        """
        Names that conditions may use.
        """
    @property
    def thrusters(self) -> list[str]:
        """
        Their names, in the order of commands.
        """
    @property
    def tick(self) -> float:
        """
        [s]
        """
class MissionRun:
    """
    One run of a mission, tick by tick.
    
    A pure function of plan, seed and inputs: the same bytes on every machine of one kind.
    
    Parameters
    ----------
    plan : MissionPlan
    seed : int
        Of all noise; keyed by device, channel and sample, so that a new device changes nobody's.
    log : str, optional
        An MCAP file to write.
    state : bytes, optional
        Of `save`, from which it goes on.
    
    Raises
    ------
    bathyal.Error
        For a log that cannot be written, or a state of another plan or seed.
    """
    def __init__(self, plan: MissionPlan, seed: typing.SupportsInt | typing.SupportsIndex, *, log: str | None = None, state: bytes | None = None) -> None:
        ...
    def close(self) -> None:
        """
        Ends the log.
        """
    def save(self) -> bytes:
        """
        The state, from which another goes on with the same bytes, log included.
        """
    def step(self, count: typing.SupportsInt | typing.SupportsIndex = 1, *, stop: bool = False, wrench: numpy.typing.ArrayLike | None = None, thrusters: numpy.typing.ArrayLike | None = None, fins: numpy.typing.ArrayLike | None = None) -> bool:
        """
        Some ticks.
        
        Parameters
        ----------
        count : int
        stop : bool
            Ends the run.
        wrench : (6,) array, optional
            On the vehicle about its origin, in its frame, besides all others [N, N m].
        thrusters : (n,) array, optional
            Commands of −1 to 1 in place of the pilot's.
        fins : (m,) array, optional
            Angles in place of the pilot's [rad].
        
        Returns
        -------
        bool
            Whether it goes on.
        
        Raises
        ------
        ValueError
            For arrays of another size, or values that are not finite.
        bathyal.Error
            Where the motion is no longer finite.
        """
    @property
    def arrived(self) -> list[tuple[str, str, float, float, int, bool, list[float]]]:
        """
        What the next tick takes in, in its order.
        
        Returns
        -------
        list of tuples
            Device, kind, time at which it was so and at which it arrived [s], index, whether it is valid,
            values: see `Sensor`.
        """
    @property
    def events(self) -> list[tuple[float, str, str]]:
        """
        Of (time, kind, text), of a run with a log.
        """
    @property
    def metrics(self) -> dict[str, float]:
        """
        By name.
        """
    @property
    def number(self) -> int:
        """
        Of the next tick.
        """
    @property
    def pose(self) -> numpy.ndarray:
        """
        (4, 4) world_from_vehicle, the true one.
        """
    @property
    def signals(self) -> dict[str, float]:
        """
        What conditions see, by name; NaN is not known.
        """
    @property
    def status(self) -> str:
        """
        running, done, failed, aborted, timeout or stopped.
        """
    @property
    def time(self) -> float:
        """
        [s]
        """
    @property
    def velocity(self) -> numpy.ndarray:
        """
        (6,) of the vehicle over ground and of turn, in its frame, the true one [m/s, rad/s].
        """
class NmeaReader:
    """
    Cuts a stream of bytes into sentences of NMEA 0183.
    
    What is no sentence is skipped and counted.
    
    Examples
    --------
    >>> from bathyal._core import NmeaReader, nmea_sentence
    >>> reader = NmeaReader()
    >>> reader.feed(nmea_sentence("HEHDT,12.00,T")[:8])
    []
    >>> reader.feed(nmea_sentence("HEHDT,12.00,T")[8:])
    ['HEHDT,12.00,T']
    >>> reader.counts["wrong_checksum"]
    0
    """
    def __init__(self) -> None:
        ...
    def feed(self, given: bytes) -> list[str]:
        """
        Bodies of the sentences that these bytes complete.
        """
    @property
    def counts(self) -> dict[str, int]:
        """
        bytes, sentences, wrong_checksum, broken.
        """
class SerialLine:
    """
    A serial line: so many bytes a second, a buffer that overruns, bits that turn.
    
    Parameters
    ----------
    name : str
        Keys the bit errors.
    baud : float
        Bits a second; a byte takes ten.
    buffer : int
        Bytes that wait at most; what finds it full is lost.
    bit_error_rate : float
        Part of the bits that arrive turned.
    seed : int
    
    Raises
    ------
    ValueError
        For numbers that no line has.
    """
    def __init__(self, name: str = 'line', *, baud: typing.SupportsFloat | typing.SupportsIndex = 4800.0, buffer: typing.SupportsInt | typing.SupportsIndex = 4096, bit_error_rate: typing.SupportsFloat | typing.SupportsIndex = 0.0, seed: typing.SupportsInt | typing.SupportsIndex = 1) -> None:
        ...
    def carry(self, given: bytes, duration: typing.SupportsFloat | typing.SupportsIndex) -> bytes:
        """
        What arrives, in whole lines.
        
        Parameters
        ----------
        given : bytes
            Sent now.
        duration : float
            Since the last call [s].
        
        Returns
        -------
        bytes
        """
    @property
    def counts(self) -> dict[str, int]:
        """
        Bytes carried, lost to overrun and waiting; turned_bits.
        """
class PingTruth:
    """
    What each sample came from: of all rays in it, the one that contributed most. NaN and −1 where nothing was hit.
    """
    @property
    def incidence(self) -> numpy.ndarray:
        """
        (beams, samples) from the surface's normal [rad].
        """
    @property
    def material(self) -> numpy.ndarray:
        """
        (beams, samples) row of `World.materials`, −1 where nothing was hit, −2 of the sea surface.
        """
    @property
    def point(self) -> numpy.ndarray:
        """
        (beams, samples, 3) in the world [m].
        """
    @property
    def range(self) -> numpy.ndarray:
        """
        (beams, samples) one-way from the sonar [m].
        """
class Ping:
    """
    What a sonar heard of one ping.
    """
    def __repr__(self) -> str:
        ...
    @property
    def altitude(self) -> float:
        """
        Of the sonar over what lies straight below [m]; NaN where nothing does.
        """
    @property
    def beam_names(self) -> list[str]:
        """
        Of the rows.
        """
    @property
    def clipped(self) -> int:
        """
        Samples at full scale.
        """
    @property
    def dropped(self) -> bool:
        """
        Whether the ping brought nothing.
        """
    @property
    def intensity(self) -> numpy.ndarray:
        """
        (beams, samples) received power over transmitted at 1 m.
        """
    @property
    def notes(self) -> list[str]:
        """
        What it rests on, as "extrapolated: …".
        """
    @property
    def range(self) -> numpy.ndarray:
        """
        (samples,) slant range of their middles [m].
        """
    @property
    def sound_speed(self) -> float:
        """
        At the sonar [m/s].
        """
    @property
    def time(self) -> float:
        """
        [s]
        """
    @property
    def truth(self) -> PingTruth:
        """
        PingTruth: of each sample, what contributed most; a `ValueError` without it.
        """
    @property
    def warnings(self) -> list[str]:
        """
        As text.
        """
class Sonar:
    """
    The description of a sonar, and what it hears.
    
    Made by `bathyal.sonars`, changed by `replace`. A beam is made narrow by a line array: φ is the angle
    from the plane across the array, ψ turns about it. Of a side-scan the array lies along x (φ along
    track, ψ from the bottom to the horizon); of a multibeam, imaging or scanning sonar along y. A ray
    that meets a surface at range R under the angle θ from its normal brings
    
        w = σ₀(θ) · b² · exp(−4 α R) · ΔΩ / (R² cos θ),
    
    α in Np/m, b² the two-way beam pattern, ΔΩ its solid angle; without `spreading` R⁻⁴ is left out.
    Every physical effect is a switch, and off.
    
    Examples
    --------
    >>> import bathyal, numpy as np
    >>> world = bathyal.World()
    >>> corners = [[-99, -99, 0], [99, -99, 0], [99, 99, 0], [-99, 99, 0]]
    >>> _ = world.add(bathyal.TriangleMesh(corners, [[0, 1, 2], [0, 2, 3]]), material="sand")
    >>> sonar = bathyal.sonars.side_scan().replace(range=50.0, spreading=True)
    >>> pose = np.eye(4)
    >>> pose[2, 3] = 10.0
    >>> ping = sonar.ping(world, pose)
    >>> ping.intensity.shape, round(float(ping.range[ping.intensity[0] > 0][0]), 3)
    ((2, 1500), 10.017)
    """
    @staticmethod
    def from_dict(fields: dict[str, bool | int | float | str | numpy.typing.ArrayLike | None]) -> Sonar:
        """
        The sonar that `to_dict` describes.
        """
    @staticmethod
    def preset(name: str, physics: str = 'off') -> Sonar:
        """
        A sonar by the name of its class; see `bathyal.sonars`.
        
        Parameters
        ----------
        name : str
            "side_scan", "side_scan_100khz", "paper_side_scan", "multibeam", "echo_sounder",
            "paper_forward_sounders", "imaging" or "scanning".
        physics : str
            "off", or "real": every switch on.
        
        Returns
        -------
        Sonar
        """
    def __eq__(self, arg0: Sonar) -> bool:
        ...
    def __getstate__(self) -> dict[str, bool | int | float | str | numpy.typing.ArrayLike | None]:
        ...
    def __hash__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    def hear(self, world: World, trajectory: Trajectory, keep: collections.abc.Callable[[Ping, int, numpy.ndarray], bool], *, seed: typing.SupportsInt | typing.SupportsIndex = 0, first: typing.SupportsInt | typing.SupportsIndex = 0, count: typing.SupportsInt | typing.SupportsIndex = -1, truth: bool = True, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> None:
        """
        A survey, ping after ping; `survey` keeps it as a record.
        
        Parameters
        ----------
        world : World
        trajectory : Trajectory
            world_from_vehicle.
        keep : function
            Called with the ping, its number and world_from_vehicle; the survey ends where it returns False.
        seed : int
            Of all random numbers.
        first, count : int
            Which of the pings at `ping_times`; −1 is to the end. Parts join to the bytes of the whole.
        truth : bool
            Whether pings have their truth.
        num_threads : int
            0 means all.
        
        Raises
        ------
        ValueError
            As `ping`, with the ping's number.
        """
    def ping(self, world: World, world_from_vehicle: numpy.typing.ArrayLike, time: typing.SupportsFloat | typing.SupportsIndex = 0.0, *, velocity: numpy.typing.ArrayLike | None = None, angular_velocity: numpy.typing.ArrayLike | None = None, seed: typing.SupportsInt | typing.SupportsIndex = 0, ping: typing.SupportsInt | typing.SupportsIndex = 0, truth: bool = True, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> Ping:
        """
        One ping.
        
        Parameters
        ----------
        world : World
        world_from_vehicle : (4, 4) array
            x forward, y port, z up.
        time : float
            At which the world is looked at [s].
        velocity, angular_velocity : (3,) array, optional
            Of the vehicle in the world [m/s, rad/s], at rest unless given; they count where `motion` is on.
        seed : int
            Of speckle, noise and dropouts. Speckle belongs to the place, noise and dropouts to the time.
        ping : int
            Counts the pings of a scanning head.
        truth : bool
            Whether the ping has its truth: 48 bytes a sample.
        num_threads : int
            0 means all; any number gives the same bytes.
        
        Returns
        -------
        Ping
        
        Raises
        ------
        ValueError
            For a pose that is not rigid, a sonar above the surface, below the bottom or inside a body.
        """
    def ping_times(self, trajectory: Trajectory) -> numpy.ndarray:
        """
        Times of a survey's pings along a trajectory [s].
        """
    def replace(self, **kwargs: bool | int | float | str | numpy.typing.ArrayLike | None) -> Sonar:
        """
        Another sonar with the given fields changed.
        
        Parameters
        ----------
        **fields
            Any of the properties.
        
        Returns
        -------
        Sonar
        
        Raises
        ------
        ValueError
            For a name that is no field, or a value out of its range.
        """
    def scattering_strength(self, world: World, material: str, incidence: numpy.typing.ArrayLike) -> numpy.ndarray:
        """
        Backscatter of a material, by this sonar's law and frequency.
        
        Parameters
        ----------
        world : World
        material : str
            One of its materials.
        incidence : (N,) array
            From the surface's normal, 0 to π/2 [rad].
        
        Returns
        -------
        (N,) array
            σ₀: power per unit area and solid angle at 1 m.
        
        Examples
        --------
        >>> import bathyal, numpy as np
        >>> sonar = bathyal.sonars.side_scan_100khz().replace(backscatter="material")
        >>> sigma = sonar.scattering_strength(bathyal.World(), "sand", np.radians([0.0, 30.0, 60.0]))
        >>> np.round(10 * np.log10(sigma), 1).tolist()
        [-9.3, -18.5, -21.6]
        """
    def survey(self, world: World, trajectory: Trajectory, *, seed: int = 0, truth: bool = False, navigation: NavigationErrors | None = None, out: str | os.PathLike[str] | None = None, first: int = 0, count: int = -1, progress: bathyal.sonar.survey.Progress | None = None, num_threads: int = 0) -> bathyal.sonar.record.SonarRecord:
        """
        Hears a world along a trajectory.
        
        Parameters
        ----------
        world : World
        trajectory : Trajectory
            world_from_vehicle; a ping every 1 / `ping_rate`, from its first time to its last.
        seed : int
            Of all random numbers; the same seed gives the same bytes.
        truth : bool
            Whether what each sample came from is kept, and where the vehicle really was: twelve
            times the memory.
        navigation : NavigationErrors, optional
            Of what the vehicle reports; unless given it reports the truth.
        out : path, optional
            A folder (``survey.zarr``) in which the record is kept as it grows, so that memory does
            not grow with it. A folder that an interrupted survey left is continued; several
            processes may fill one, each its part.
        first, count : int
            Which of the pings; −1 is to the end. Parts join to the bytes of the whole.
        progress : function, optional
            Called with the pings done and all of them; the survey ends where it returns False.
        num_threads : int
            0 means all; any number gives the same bytes.
        
        Returns
        -------
        SonarRecord
        
        Raises
        ------
        ValueError
            As `Sonar.ping`, with the ping's number; for a folder of another survey, or of anything
            else.
        OSError
            Where the folder cannot be written. What is there stays readable.
        """
    def to_dict(self) -> dict[str, bool | int | float | str | numpy.typing.ArrayLike | None]:
        """
        Every field's value by its name.
        """
    @property
    def absorption(self) -> str | None:
        """
        None, "francois_garrison" or "ainslie_mccolm".
        """
    @property
    def axis_tilt(self) -> float:
        """
        Of the beam's axis below the horizontal, where its pattern counts [rad].
        """
    @property
    def backscatter(self) -> str | None:
        """
        "lambert", or "material": its table or sediment where it has one.
        """
    @property
    def bandwidth(self) -> float:
        """
        [Hz]
        """
    @property
    def beam_dropout_rate(self) -> float:
        """
        Part of the rows of the other pings that are 0.
        """
    @property
    def beam_names(self) -> list[str]:
        """
        Of the rows.
        """
    @property
    def beam_pattern(self) -> str | None:
        """
        None; of a line array by its shading, "uniform" (sinc², first side lobe −13.3 dB), "hann" (−31.5 dB) or "taylor" (−30 dB); or "gaussian".
        """
    @property
    def beam_width(self) -> float:
        """
        In φ, where one-way power is half [rad].
        """
    @property
    def beams(self) -> int:
        """
        Rows of a ping; of a side-scan port, or port and starboard.
        """
    @property
    def bits(self) -> int:
        """
        Of the samples' amplitude; 0 is not quantised.
        """
    @property
    def dropout_rate(self) -> float:
        """
        Part of the pings that bring nothing: all their samples are 0.
        """
    @property
    def fan_span(self) -> float:
        """
        Of ψ that rays cover [rad]; an echo sounder's beam is a cone, to which it does not apply.
        """
    @property
    def fan_width(self) -> float:
        """
        In ψ, where one-way power is half [rad].
        """
    @property
    def frequency(self) -> float:
        """
        [Hz]
        """
    @property
    def full_scale(self) -> float:
        """
        Intensity at which samples clip [dB].
        """
    @property
    def head_start(self) -> float:
        """
        Angle of a scanning head at ping 0, to port [rad].
        """
    @property
    def head_step(self) -> float:
        """
        And from ping to ping [rad].
        """
    @property
    def kind(self) -> str | None:
        """
        "echo_sounder", "side_scan", "multibeam", "imaging" or "scanning".
        """
    @property
    def layover(self) -> bool:
        """
        Whether what is nearer than a lower part of its fan is heard as well.
        """
    @property
    def motion(self) -> bool:
        """
        Whether the vehicle moves between transmission and reception.
        """
    @property
    def multiples(self) -> int:
        """
        Reflections after which a ray is still followed, 0 to 8; under a surface, that one reflects and scatters as well.
        """
    @property
    def name(self) -> str:
        """
        What it is called.
        """
    @property
    def noise(self) -> bool:
        """
        Whether the sea's noise is heard.
        """
    @property
    def noise_level(self) -> float | None:
        """
        Its spectral level [dB re 1 µPa²/Hz]; None: `bathyal.ambient_noise` at the frequency and wind speed.
        """
    @property
    def ping_rate(self) -> float:
        """
        [Hz]
        """
    @property
    def pixel_solid_angle(self) -> bool:
        """
        Whether pixels count by their solid angle, cos³ of the angle off axis.
        """
    @property
    def pulse(self) -> str | None:
        """
        None, "rectangle" (its length) or "chirp" (compressed to c / 2B).
        """
    @property
    def pulse_length(self) -> float:
        """
        [s]
        """
    @property
    def range(self) -> float:
        """
        Slant range of the end of the last sample [m].
        """
    @property
    def ray_count(self) -> int:
        """
        Rays of a ping.
        """
    @property
    def rays(self) -> str | None:
        """
        "angles": equal angles with their solid angles; "camera": pixels that count equally.
        """
    @property
    def rays_across_beam(self) -> int:
        """
        Over φ, of each beam.
        """
    @property
    def rays_along_fan(self) -> int:
        """
        Over ψ, of each beam.
        """
    @property
    def refraction(self) -> bool:
        """
        Whether sound runs along arcs, by the profile of the water.
        """
    @property
    def samples(self) -> int:
        """
        Of a row.
        """
    @property
    def sector(self) -> float:
        """
        Between the axes of the outer beams [rad].
        """
    @property
    def side_lobes(self) -> bool:
        """
        Whether each beam of a multibeam or an imaging sonar hears its far side lobes, too.
        """
    @property
    def source_level(self) -> float:
        """
        [dB re 1 µPa at 1 m]
        """
    @property
    def speckle(self) -> str | None:
        """
        None, "rayleigh" or "k".
        """
    @property
    def speckle_shape(self) -> float:
        """
        ν of the K distribution.
        """
    @property
    def spreading(self) -> bool:
        """
        Whether power falls with R⁻⁴.
        """
    @property
    def tilt(self) -> float:
        """
        Of the fan's middle below the horizontal [rad].
        """
    @property
    def tvg(self) -> bool:
        """
        Whether a gain over range is applied.
        """
    @property
    def tvg_absorption(self) -> float:
        """
        Its part with the way there and back [dB/m].
        """
    @property
    def tvg_offset(self) -> float:
        """
        Its part at all ranges [dB].
        """
    @property
    def tvg_spreading(self) -> float:
        """
        Its part with range [dB a decade], 0 at 1 m.
        """
    @property
    def vehicle_from_sonar(self) -> numpy.ndarray:
        """
        (4, 4), its mount.
        """
    @property
    def wind_speed(self) -> float:
        """
        At 10 m, by which the sea surface scatters [m/s].
        """
class NavigationReport:
    """
    What a vehicle reports, one row a time.
    """
    @property
    def depth(self) -> numpy.ndarray:
        """
        (P,) below the mean surface [m]; NaN without one.
        """
    @property
    def heading(self) -> numpy.ndarray:
        """
        (P,) clockwise from y [rad].
        """
    @property
    def pitch(self) -> numpy.ndarray:
        """
        (P,) bow up [rad].
        """
    @property
    def position(self) -> numpy.ndarray:
        """
        (P, 3) in the world [m].
        """
    @property
    def roll(self) -> numpy.ndarray:
        """
        (P,) starboard down [rad].
        """
    @property
    def speed(self) -> numpy.ndarray:
        """
        (P,) over ground [m/s].
        """
class NavigationErrors:
    """
    Errors of what a vehicle reports of its motion.
    
    Without any it reports the truth. Position is reckoned from the log and the heading since the last
    fix (GNSS, USBL), without fixes since the start. Noise is normal and given by its standard
    deviation.
    
    Parameters
    ----------
    **fields : float
        Any of the properties; those not given are 0.
    
    Raises
    ------
    ValueError
        For a name that is none of them, or a value out of its range.
    
    Examples
    --------
    >>> import bathyal, numpy as np
    >>> errors = bathyal.NavigationErrors(speed_scale=0.01, heading_bias=np.radians(1.0))
    >>> east = np.stack([np.eye(4), np.eye(4)])
    >>> east[1, 0, 3] = 1000.0
    >>> reported = errors.report(bathyal.Trajectory([0.0, 500.0], east), [0.0, 500.0])
    >>> reported.position[1].round(1).tolist()
    [1009.8, -17.6, 0.0]
    """
    @staticmethod
    def preset(name: str) -> NavigationErrors:
        """
        Errors of a vehicle by class.
        
        Parameters
        ----------
        name : str
            "inertial" (with a Doppler log, some 0.1 % of the way), "compass" (magnetic, with a Doppler log,
            some 2 % of the way) or "usbl" (that, with a fix of 1 m from a ship every 2 s).
        
        Returns
        -------
        NavigationErrors
        """
    def __eq__(self, arg0: NavigationErrors) -> bool:
        ...
    def __getstate__(self) -> dict[str, float]:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, **kwargs: float) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    def replace(self, **kwargs: float) -> NavigationErrors:
        """
        Others with the given fields changed.
        """
    def report(self, trajectory: Trajectory, time: numpy.typing.ArrayLike, *, surface: typing.SupportsFloat | typing.SupportsIndex | None = None, seed: typing.SupportsInt | typing.SupportsIndex = 0) -> NavigationReport:
        """
        What a vehicle on a trajectory reports.
        
        Parameters
        ----------
        trajectory : Trajectory
            world_from_vehicle.
        time : (P,) array
            Rising [s].
        surface : float, optional
            z of the mean sea surface [m], for the depth.
        seed : int
            Of noise and walks.
        
        Returns
        -------
        NavigationReport
        
        Raises
        ------
        ValueError
            For times that do not rise, or more than 10⁸ readings.
        """
    def report_altitude(self, altitude: numpy.typing.ArrayLike, *, first: typing.SupportsInt | typing.SupportsIndex = 0, seed: typing.SupportsInt | typing.SupportsIndex = 0) -> numpy.ndarray:
        """
        (P,) what is reported of true altitudes [m], from ping `first` on; NaN stays NaN.
        """
    def to_dict(self) -> dict[str, float]:
        """
        Every field's value by its name.
        """
    @property
    def altitude_bias(self) -> float:
        """
        [m]
        """
    @property
    def altitude_noise(self) -> float:
        """
        [m]
        """
    @property
    def attitude_lag(self) -> float:
        """
        By which heading, pitch and roll are late [s].
        """
    @property
    def attitude_noise(self) -> float:
        """
        Of pitch and of roll [rad].
        """
    @property
    def depth_bias(self) -> float:
        """
        [m]
        """
    @property
    def depth_noise(self) -> float:
        """
        [m]
        """
    @property
    def fix_interval(self) -> float:
        """
        Between fixes [s]; 0: there are none.
        """
    @property
    def fix_noise(self) -> float:
        """
        Of a fix, along x and along y [m].
        """
    @property
    def heading_bias(self) -> float:
        """
        Clockwise [rad].
        """
    @property
    def heading_noise(self) -> float:
        """
        [rad]
        """
    @property
    def heading_walk(self) -> float:
        """
        Drift of a gyro [rad/√s].
        """
    @property
    def latency(self) -> float:
        """
        What is reported at t was so at t − latency [s].
        """
    @property
    def pitch_bias(self) -> float:
        """
        [rad]
        """
    @property
    def position_walk(self) -> float:
        """
        Of a reckoned position, in x and in y [m/√s].
        """
    @property
    def rate(self) -> float:
        """
        Of readings [Hz]; between them the last one is reported. 0: one at each ping.
        """
    @property
    def roll_bias(self) -> float:
        """
        [rad]
        """
    @property
    def speed_scale(self) -> float:
        """
        Of the log, as a part of the speed, −0.5 to 0.5.
        """
class AllocationResult:
    """
    What thrusters are asked for.
    """
    @property
    def achieved(self) -> numpy.ndarray:
        """
        (6,) what the thrusts give in still water [N, N m].
        """
    @property
    def command(self) -> numpy.ndarray:
        """
        (m,), −1 to 1; the dead zone is passed over.
        """
    @property
    def saturated(self) -> bool:
        """
        One is at its limit.
        """
    @property
    def thrust(self) -> numpy.ndarray:
        """
        (m,) [N].
        """
class Allocation:
    """
    From a wrench to the commands of thrusters.
    
    The weighted least squares of the wrench's error with each thrust within what the thruster can give
    at the voltage, solved exactly by an active set (Stark and Parker 1995). When the thrusters cannot
    give it, what weighs most is kept first: heave, roll and pitch, then yaw, then surge and sway.
    
    Parameters
    ----------
    thrusters : list of Thruster
    weights : (6,) array, optional
        Of an error in surge to yaw, above 0; 1, 1, 100, 100, 100, 10 unless given.
    effort : float
        Weight of the thrusts themselves, which shares the work out.
    
    Raises
    ------
    ValueError
        For none or more than 32 thrusters, or weights that are not above 0.
    
    Examples
    --------
    >>> import bathyal
    >>> rov = bathyal.VehicleSystem.bluerov2_heavy()
    >>> allocation = bathyal.Allocation(rov.thrusters)
    >>> allocation.rank(failed=[0]), allocation.rank(failed=[4, 5])
    ((6, []), (5, ['pitch']))
    >>> given = allocation.allocate([20, 0, 10, 0, 0, 1], voltage=15.0)
    >>> bool(abs(given.achieved - [20, 0, 10, 0, 0, 1]).max() < 1e-4), given.saturated
    (True, False)
    """
    def __init__(self, thrusters: collections.abc.Sequence[Thruster], *, weights: numpy.typing.ArrayLike | None = None, effort: typing.SupportsFloat | typing.SupportsIndex = 0.0001) -> None:
        ...
    def allocate(self, wrench: numpy.typing.ArrayLike, voltage: typing.SupportsFloat | typing.SupportsIndex, failed: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex] = []) -> AllocationResult:
        """
        Thrusts and commands for a wrench.
        
        Directions that are lost do not count, so that the others are held.
        
        Parameters
        ----------
        wrench : (6,) array
            About the vehicle's origin, in its frame [N, N m].
        voltage : float
            Of the supply, which limits the thrusts [V].
        failed : list of int
            Rows of thrusters that do not work.
        """
    def rank(self, failed: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex] = []) -> tuple[int, list[str]]:
        """
        Rank of the thrusters' matrix, and which directions are lost.
        
        In the order heave, yaw, surge, sway, roll, pitch a direction is kept if it is independent of those
        kept before it; roll and pitch come last as a vehicle rights itself in them.
        
        Parameters
        ----------
        failed : list of int
            Rows of thrusters that do not work.
        
        Returns
        -------
        rank : int
        lost : list of str
        """
    @property
    def matrix(self) -> numpy.ndarray:
        """
        (6, m) force and moment about the vehicle's origin of 1 N of each.
        """
class PoseHoldState:
    """
    What `PoseHold` keeps from step to step.
    """
    def __init__(self) -> None:
        """
        At its start.
        """
    @property
    def integral(self) -> numpy.ndarray:
        """
        (6,) accelerations, the linear ones in the world [m/s², rad/s²].
        """
    @integral.setter
    def integral(self, arg1: numpy.typing.ArrayLike) -> None:
        ...
    @property
    def shortfall(self) -> numpy.ndarray:
        """
        (6,) to be set to what was given less what was asked for, so that nothing winds up [N, N m].
        """
    @shortfall.setter
    def shortfall(self, arg1: numpy.typing.ArrayLike) -> None:
        ...
class PoseHold:
    """
    Holds depth, heading, pitch, roll and position.
    
    A PID whose gains are the model's: in each direction the error obeys
    (s + i ω)(s² + 2 ζ ω s + ω²) = 0 times the vehicle's mass matrix with its added mass; weight,
    buoyancy and the drag of a known current are fed forward (Fossen 2011, sect. 12.2). The integral of
    position stays as it is in the world when the vehicle turns, and does not wind up.
    
    Parameters
    ----------
    vehicle : Vehicle
    frequency : (6,) array, optional
        ω, surge to yaw [rad/s].
    damping : float
        ζ
    integral : float
        i; 0: no integral part.
    axes : list of 6 bool
        What is controlled.
    
    Raises
    ------
    ValueError
        For a frequency or damping that is not above 0.
    """
    def __init__(self, vehicle: Vehicle, *, frequency: numpy.typing.ArrayLike | None = None, damping: typing.SupportsFloat | typing.SupportsIndex = 1.0, integral: typing.SupportsFloat | typing.SupportsIndex = 1.0, axes: typing.Annotated[collections.abc.Sequence[bool], "FixedSize(6)"] = [True, True, True, True, True, True]) -> None:
        ...
    def step(self, state: PoseHoldState, pose: numpy.typing.ArrayLike, velocity: numpy.typing.ArrayLike, *, target: numpy.typing.ArrayLike | None = None, target_velocity: numpy.typing.ArrayLike | None = None, current: numpy.typing.ArrayLike | None = None, time: typing.SupportsFloat | typing.SupportsIndex) -> numpy.ndarray:
        """
        The wrench to ask for; the state is changed for the next step.
        
        Parameters
        ----------
        state : PoseHoldState
        pose : (4, 4) array
            world_from_vehicle, as measured.
        velocity : (6,) array
            Over ground, in the vehicle's frame.
        target : (4, 4) array, optional
            The pose to hold; the world's origin unless given.
        target_velocity : (6,) array, optional
            Over ground, in the vehicle's frame.
        current : (3,) array, optional
            What is known of it, in the world [m/s].
        time : float
            Since the last step [s].
        
        Returns
        -------
        (6,) array
            About the vehicle's origin, in its frame [N, N m].
        """
class CruiseState:
    """
    What `CruiseControl` keeps from step to step.
    """
    def __init__(self) -> None:
        """
        At its start.
        """
    @property
    def depth(self) -> float:
        """
        The same of the depth [m s].
        """
    @depth.setter
    def depth(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def heading(self) -> float:
        """
        Integral of the error [rad s].
        """
    @heading.setter
    def heading(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
    @property
    def speed(self) -> float:
        """
        The same of the speed [m].
        """
    @speed.setter
    def speed(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None:
        ...
class CruiseControl:
    """
    Speed, heading and depth by a propeller and fins.
    
    State feedback by pole placement (Ackermann's formula) on the model, linear about straight and level
    motion: sway, yaw rate, heading and its integral by the rudder; heave, pitch rate, pitch, depth and
    its integral by the stern plane.
    
    Parameters
    ----------
    system : VehicleSystem
    speed : float
        At which the gains are found [m/s].
    heading_frequency, depth_frequency, speed_frequency : float
        Natural, of the slower modes [rad/s].
    damping : float
        Ratio.
    integral : float
        The integrals' poles, times the frequency.
    most_pitch : float
        That a depth error asks for [rad].
    rudder, stern_plane, propeller : int
        Rows of the system's fins and thrusters.
    
    Raises
    ------
    ValueError
        For a value out of its range, or a fin that does not turn the vehicle.
    """
    def __init__(self, system: VehicleSystem, *, speed: typing.SupportsFloat | typing.SupportsIndex = 1.5, heading_frequency: typing.SupportsFloat | typing.SupportsIndex = 0.5, depth_frequency: typing.SupportsFloat | typing.SupportsIndex = 0.4, speed_frequency: typing.SupportsFloat | typing.SupportsIndex = 0.3, damping: typing.SupportsFloat | typing.SupportsIndex = 0.9, integral: typing.SupportsFloat | typing.SupportsIndex = 0.3, most_pitch: typing.SupportsFloat | typing.SupportsIndex = 0.45, rudder: typing.SupportsInt | typing.SupportsIndex = 0, stern_plane: typing.SupportsInt | typing.SupportsIndex = 1, propeller: typing.SupportsInt | typing.SupportsIndex = 0) -> None:
        ...
    def step(self, state: CruiseState, pose: numpy.typing.ArrayLike, velocity: numpy.typing.ArrayLike, *, speed: typing.SupportsFloat | typing.SupportsIndex, heading: typing.SupportsFloat | typing.SupportsIndex, z: typing.SupportsFloat | typing.SupportsIndex, climb: typing.SupportsFloat | typing.SupportsIndex = 0.0, time: typing.SupportsFloat | typing.SupportsIndex) -> tuple[float, float, float]:
        """
        Fin angles and thrust; the state is changed for the next step.
        
        Parameters
        ----------
        state : CruiseState
        pose : (4, 4) array
            world_from_vehicle, as measured.
        velocity : (6,) array
            Through the water, in the vehicle's frame.
        speed, heading, z : float
            To hold: through the water [m/s], about z from x [rad], of the origin in the world [m].
        climb : float
            dz over the way run, of the path to hold.
        time : float
            Since the last step [s].
        
        Returns
        -------
        rudder, stern_plane : float
            [rad]
        thrust : float
            [N]
        """
class LineOfSightState:
    """
    What `LineOfSight` keeps from step to step.
    """
    def __init__(self) -> None:
        """
        At its start.
        """
    @property
    def arrived(self) -> bool:
        """
        Past the last point.
        """
    @property
    def integral(self) -> float:
        """
        [m]
        """
    @property
    def leg(self) -> int:
        """
        From point `leg` to the next.
        """
class LineOfSight:
    """
    Follows straight legs between points, in the level plane.
    
    Integral line of sight (Børhaug, Pavlov, Pettersen 2008): steers α − atan((y + σ i) / Δ) with y the
    offset to port of the leg of course α.
    
    Parameters
    ----------
    points : (K, 2) array
        In the world [m].
    lookahead : float
        Δ [m]
    integral : float
        σ, gain on the offset that a current makes.
    acceptance : float
        A point this near is reached [m].
    
    Raises
    ------
    ValueError
        For fewer than two points, or two in a row that are the same.
    
    Examples
    --------
    >>> import bathyal
    >>> line = bathyal.LineOfSight([[0, 0], [100, 0], [100, 50]])
    >>> state = bathyal.LineOfSightState()
    >>> heading, cross_track = line.step(state, [10, 2, -5], 0.1)
    >>> round(heading, 3), cross_track
    (-0.245, 2.0)
    """
    def __init__(self, points: numpy.typing.ArrayLike, *, lookahead: typing.SupportsFloat | typing.SupportsIndex = 8.0, integral: typing.SupportsFloat | typing.SupportsIndex = 0.3, acceptance: typing.SupportsFloat | typing.SupportsIndex = 4.0) -> None:
        ...
    def step(self, state: LineOfSightState, position: numpy.typing.ArrayLike, time: typing.SupportsFloat | typing.SupportsIndex) -> tuple[float, float]:
        """
        (heading to steer [rad], offset to port of the leg [m]) at a (3,) position of the world, a time [s] since the last step.
        """
class ArmMotion:
    """
    How vehicle and arm moved, step by step.
    """
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def pose(self) -> numpy.ndarray:
        """
        (K, 4, 4) world_from_vehicle.
        """
    @property
    def q(self) -> numpy.ndarray:
        """
        (K, n) coordinates of the arm [rad, m].
        """
    @property
    def time(self) -> numpy.ndarray:
        """
        (K,) [s].
        """
    @property
    def torque(self) -> numpy.ndarray:
        """
        (K, n) that the drives give to carry the motion out [N m, N].
        """
    @property
    def velocity(self) -> numpy.ndarray:
        """
        (K, 6) over ground, linear then angular, in the vehicle's frame [m/s, rad/s].
        """
class TrimHold:
    """
    How a vehicle held its pose while its arm worked, step by step.
    """
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def pose(self) -> numpy.ndarray:
        """
        (K, 4, 4) world_from_vehicle.
        """
    @property
    def q(self) -> numpy.ndarray:
        """
        (K, n) coordinates of the arm [rad, m].
        """
    @property
    def saturated(self) -> bool:
        """
        Whether a thruster was at its limit.
        """
    @property
    def thrust(self) -> numpy.ndarray:
        """
        (K, 6) of the thrusters on the vehicle about its origin [N, N m].
        """
    @property
    def time(self) -> numpy.ndarray:
        """
        (K,) [s].
        """
    @property
    def torque(self) -> numpy.ndarray:
        """
        (K, n) that the drives give to carry the motion out [N m, N].
        """
    @property
    def velocity(self) -> numpy.ndarray:
        """
        (K, 6) over ground, linear then angular, in the vehicle's frame [m/s, rad/s].
        """
class ArmOnVehicle:
    """
    A vehicle and the arm that it carries, as one tree of bodies in water.
    
    The arm moves the vehicle by its weight, its inertia and the water that it moves. Arm, mount, the
    capsules that the links are in the water, and what is attached to the tool are those of the
    workspace; hull, scene and keep-outs play no part. A link has the mass, inertia and volume that
    `Arm.links` give; 0 is none.
    
    Parameters
    ----------
    vehicle : Vehicle
        Without the arm. Gravity and water density are its own.
    workspace : Workspace
    added_mass : float
        Of a link across its axis, over the mass of the water that its cylinder displaces.
    drag : float
        C_D of a link across its axis, over its projected area. Along the axis there is none.
    strips : int
        Of each capsule, for its drag.
    
    Raises
    ------
    ValueError
        For values out of range.
    
    Notes
    -----
    Equations of motion by articulated bodies (Featherstone, Rigid Body Dynamics Algorithms, 2008, table
    9.4), hull and links each with Fossen's terms; links in the water by strip theory (McLain and Rock,
    1998).
    
    Examples
    --------
    >>> import bathyal, numpy as np
    >>> bodies = [bathyal.Link(f"link_{k}", mass=0.8, volume=4e-4) for k in range(7)]
    >>> arm = bathyal.Arm.from_dh(a=[0, -0.3, -0.3, 0, 0, 0], alpha=[np.pi/2, 0, 0, np.pi/2, -np.pi/2, 0],
    ...     d=[0.1, 0, 0, 0.1, 0.1, 0.1], theta=[0] * 6, links=bodies)
    >>> mount = np.eye(4)
    >>> mount[:3, 3] = 0.25, 0, -0.1
    >>> workspace = bathyal.Workspace(arm, mount, radii=0.03)
    >>> both = bathyal.ArmOnVehicle(bathyal.vehicles.bluerov2_heavy(), workspace)
    >>> reach = np.array([[0, 0, 0, 0, 0, 0], [0, -1.0, 0.5, 0, 0, 0]])
    >>> motion = both.simulate(np.eye(4), reach, np.zeros(6), 4.0, time=[0.0, 2.0])
    >>> motion.pose.shape, motion.torque.shape
    ((401, 4, 4), (401, 6))
    """
    def __init__(self, vehicle: Vehicle, workspace: Workspace, *, added_mass: typing.SupportsFloat | typing.SupportsIndex = 1.0, drag: typing.SupportsFloat | typing.SupportsIndex = 1.1, strips: typing.SupportsInt | typing.SupportsIndex = 4) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def acceleration(self, state: numpy.typing.ArrayLike | tuple[numpy.typing.ArrayLike, numpy.typing.ArrayLike], q: numpy.typing.ArrayLike, rate: numpy.typing.ArrayLike, *, torque: numpy.typing.ArrayLike | None = None, acceleration: numpy.typing.ArrayLike | None = None, thrust: numpy.typing.ArrayLike | None = None, tip_wrench: numpy.typing.ArrayLike | None = None, current: numpy.typing.ArrayLike | None = None) -> tuple[numpy.ndarray, numpy.ndarray, numpy.ndarray]:
        """
        Accelerations of vehicle and arm, and the torques that go with them.
        
        Parameters
        ----------
        state : (4, 4) array, or (pose, velocity)
        q, rate : (n,) array
            Coordinates of the arm and their rates [rad or m, and per s].
        torque : (n,) array, optional
            Of the drives, positive along the coordinates [N m, N]: the accelerations of the joints are
            found. For arms without joints that mimic others.
        acceleration : (n,) array, optional
            Of the coordinates: the torques are found. Zeros where neither is given.
        thrust, tip_wrench : (6,) array, optional
            As of `simulate`.
        current : (3,) array, optional
        
        Returns
        -------
        tuple
            (6,) dν/dt of the vehicle in its frame, (n,) accelerations, (n,) torques.
        
        Raises
        ------
        ValueError
            For shapes that do not fit, or both of torque and acceleration.
        """
    def hold(self, state: numpy.typing.ArrayLike | tuple[numpy.typing.ArrayLike, numpy.typing.ArrayLike], q: numpy.typing.ArrayLike, allocation: Allocation, controller: PoseHold, duration: typing.SupportsFloat | typing.SupportsIndex, *, time: numpy.typing.ArrayLike | None = None, tip_wrench: numpy.typing.ArrayLike | None = None, expected_wrench: numpy.typing.ArrayLike | None = None, step: typing.SupportsFloat | typing.SupportsIndex = 0.01, period: typing.SupportsFloat | typing.SupportsIndex = 0.05, voltage: typing.SupportsFloat | typing.SupportsIndex = 16.0, current: numpy.typing.ArrayLike | None = None) -> TrimHold:
        """
        How the vehicle holds its pose by its thrusters while the arm works.
        
        The controller has the model that it was made with; the truth is this object. Each period it asks
        for a wrench, less what is expected of arm and bottom (fed forward); the allocation gives it to the
        thrusters, which lag as theirs do. Pose and velocity are measured without error.
        
        Parameters
        ----------
        state, q, duration, step, current, time, tip_wrench
            As of `simulate`.
        allocation : Allocation
            With the thrusters.
        controller : PoseHold
            Of the vehicle without its arm, as it is believed to be.
        expected_wrench : (6,) or (K, 6) array, optional
            What arm and bottom are expected to exert on the vehicle, about its origin [N, N m]: the
            `wrench` of `plan_sampling` or of `Workspace.wrench`. None: feedback alone.
        period : float
            Of the controller, a whole number of steps [s].
        voltage : float
            Of the thrusters [V].
        
        Returns
        -------
        TrimHold
        
        Raises
        ------
        ValueError
            For an expected wrench that the thrusters cannot balance; the axis and time are named. And as
            `simulate`.
        """
    def simulate(self, state: numpy.typing.ArrayLike | tuple[numpy.typing.ArrayLike, numpy.typing.ArrayLike], q: numpy.typing.ArrayLike, thrust: numpy.typing.ArrayLike | collections.abc.Callable[[float, numpy.ndarray, numpy.ndarray], numpy.typing.ArrayLike], duration: typing.SupportsFloat | typing.SupportsIndex, step: typing.SupportsFloat | typing.SupportsIndex = 0.01, current: numpy.typing.ArrayLike | None = None, *, time: numpy.typing.ArrayLike | None = None, tip_wrench: numpy.typing.ArrayLike | None = None) -> ArmMotion:
        """
        How vehicle and arm move while the arm carries a motion out, in deep water.
        
        Parameters
        ----------
        state : (4, 4) array, or (pose, velocity)
            world_from_vehicle at rest, or with the velocity (6,) over ground in the vehicle's frame.
        q : (n,) or (K, n) array
            A posture that is held, or rows of a motion: a cubic spline goes through them, at rest before
            the first and after the last.
        thrust : (6,) array, or function
            Force and moment on the vehicle about its origin, along its axes [N, N m], or
            f(time, pose, velocity).
        duration : float
            [s], 0 or more.
        step : float
            Of the integration (Runge–Kutta, fourth order) [s].
        current : (3,) array, optional
            Velocity of the water in the world [m/s].
        time : (K,) array
            Of the rows of `q` and `tip_wrench`, rising [s]; needed where there are several.
        tip_wrench : (6,) or (K, 6) array, optional
            Force and moment on the tool at its centre point, along the vehicle's axes: what the bottom
            pushes back with; straight between rows.
        
        Returns
        -------
        ArmMotion
        
        Raises
        ------
        ValueError
            For shapes that do not fit, times that do not rise, a step beyond the limit of the fastest mode.
        Error
            Where the motion runs away.
        """
    @property
    def vehicle(self) -> Vehicle:
        """
        As given.
        """
    @property
    def workspace(self) -> Workspace:
        """
        As given.
        """
class Touches:
    """
    Joint values while the tool's tip touched fixed points.
    
    What Yukhimets and Gubankov (2023) record: the tip is brought to a fixed point in many poses, a few
    points in all, and only joint values are read. Where the points lie need not be known.
    
    Parameters
    ----------
    q : (N, n) array
        Joint values, one row a touch [rad]; [m] of sliding joints.
    point : (N,) int array
        Label of the point that the row touched, any whole number; of rows that touched a plane, any.
    q_deg : (N, n) array
        In place of `q`, in degrees (every column: for arms that only turn).
    known_distances : dict
        {(label, label): distance} between touched points [m]. Touches alone do not determine the scale
        of the arm; one such distance does.
    distance_std : float
        Standard deviation of those distances [m].
    known_points : dict
        {label: (x, y, z)} of touched points, in the world, the frame of ``arm.base`` [m].
    point_std : float
        Standard deviation of those coordinates, per axis [m].
    planes : dict
        {name: rows} of planes that were touched in many places, not known otherwise.
    weights : (N,) array
        1 / variance of a row, up to a factor. Equal when not given.
    tool, station : (N,) int array
        Tool of the touch and position of the base, each counted from 0.
    covariates : dict
        {name: (N,) or (N, k) array} recorded in addition: temperature, time, payload, direction, gravity …
        nan in rows where it was not recorded.
    session : (N,) int array
        Short for the covariate ``session``.
    names : dict
        {label: name} of touched points, for reports; a label may have none.
    
    Raises
    ------
    ValueError
        For lengths that differ, numbers that are not finite, values that can only be degrees (give them
        as ``q_deg``), poses that are all equal, one pose for each point, labels without a touch.
    
    Examples
    --------
    >>> import bathyal
    >>> bathyal.Touches([[0, 1, 0.5], [0.2, 0.9, 0.6]], [0, 0])
    Touches(2 poses, 3 joints)
    """
    def __init__(self, q: numpy.typing.ArrayLike | None = None, point: numpy.typing.ArrayLike | None = None, *, q_deg: numpy.typing.ArrayLike | None = None, known_distances: dict[tuple[int, int], float] | None = None, distance_std: typing.SupportsFloat | typing.SupportsIndex = 0.0001, known_points: dict[int, numpy.typing.ArrayLike] | None = None, point_std: typing.SupportsFloat | typing.SupportsIndex = 0.0001, planes: dict[str, numpy.typing.ArrayLike] | None = None, weights: numpy.typing.ArrayLike | None = None, tool: numpy.typing.ArrayLike | None = None, station: numpy.typing.ArrayLike | None = None, covariates: dict[str, numpy.typing.ArrayLike] | None = None, session: numpy.typing.ArrayLike | None = None, names: dict[int, str] | None = None) -> None:
        ...
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def covariates(self) -> dict:
        """
        Name to (N,) or (N, k) array; `session` among them.
        """
    @property
    def distance_std(self) -> float:
        """
        [m]
        """
    @property
    def known_distances(self) -> dict:
        """
        {(label, label): distance [m]} between touched points.
        """
    @property
    def known_points(self) -> dict:
        """
        {label: (3,) position [m]} in the world.
        """
    @property
    def names(self) -> dict[int, str]:
        """
        {label: name}, of the labels that have one.
        """
    @property
    def planes(self) -> dict:
        """
        {name: (K,) rows} of planes touched in many places.
        """
    @property
    def point(self) -> numpy.ndarray:
        """
        (N,) label of the point that each row touched.
        """
    @property
    def point_std(self) -> float:
        """
        [m]
        """
    @property
    def q(self) -> numpy.ndarray:
        """
        (N, n) [rad] or [m].
        """
    @property
    def station(self) -> numpy.ndarray:
        """
        (N,), or (0,) when there is one.
        """
    @property
    def tool(self) -> numpy.ndarray:
        """
        (N,), or (0,) when there is one.
        """
    @property
    def weights(self) -> numpy.ndarray:
        """
        (N,), or (0,) when all are equal.
        """
class Tracked:
    """
    Joint values and measured positions of the tool's tip.
    
    Parameters
    ----------
    q : (N, n) array
        Joint values [rad]; [m] of sliding joints.
    position : (N, 3) array
        Of the tip (a reflector, a prism), in the frame of the instrument [m].
    pose : (N, 4, 4) array
        In place of `position`: the whole pose of what the instrument sees, world_from_tool.
    q_deg : (N, n) array
        In place of `q`, in degrees (every column).
    weights : (N,) array
        1 / variance of a row, up to a factor. Equal when not given.
    tool, station : (N,) int array
        Target on the tool, and position of base and instrument, each counted from 0.
    covariates : dict
        {name: (N,) or (N, k) array} recorded in addition: temperature, time, payload, direction, gravity …
        nan in rows where it was not recorded.
    session : (N,) int array
        Short for the covariate ``session``.
    
    Raises
    ------
    ValueError
        As Touches.
    
    Examples
    --------
    >>> import bathyal
    >>> bathyal.Tracked(q_deg=[[0, 30], [10, 40]], position=[[1, 0, 0], [1.1, 0.1, 0]])
    Tracked(2 poses, 2 joints)
    """
    def __init__(self, q: numpy.typing.ArrayLike | None = None, position: numpy.typing.ArrayLike | None = None, *, pose: numpy.typing.ArrayLike | None = None, q_deg: numpy.typing.ArrayLike | None = None, weights: numpy.typing.ArrayLike | None = None, tool: numpy.typing.ArrayLike | None = None, station: numpy.typing.ArrayLike | None = None, covariates: dict[str, numpy.typing.ArrayLike] | None = None, session: numpy.typing.ArrayLike | None = None) -> None:
        ...
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def covariates(self) -> dict:
        """
        Name to (N,) or (N, k) array; `session` among them.
        """
    @property
    def pose(self) -> numpy.ndarray | None:
        """
        (N, 4, 4) world_from_tool, or None when only positions were measured.
        """
    @property
    def position(self) -> numpy.ndarray:
        """
        (N, 3) of the tip, world [m].
        """
    @property
    def q(self) -> numpy.ndarray:
        """
        (N, n) [rad] or [m].
        """
    @property
    def station(self) -> numpy.ndarray:
        """
        (N,), or (0,) when there is one.
        """
    @property
    def tool(self) -> numpy.ndarray:
        """
        (N,), or (0,) when there is one.
        """
    @property
    def weights(self) -> numpy.ndarray:
        """
        (N,), or (0,) when all are equal.
        """
class EffectRows:
    """
    The rows at which the function of an effect is evaluated.
    
    Its numbers must follow from each row alone (or, with ``by_difference=True``, from how rows differ
    from their neighbours), so that an effect found in one recording means the same in the next.
    """
    def __len__(self) -> int:
        ...
    @property
    def arm(self) -> Arm:
        """
        Arm: rows as far as they are known, and masses.
        """
    @property
    def covariates(self) -> dict:
        """
        Name to (N,) or (N, k) array.
        """
    @property
    def gravity(self) -> numpy.ndarray:
        """
        (N, 3) [m/s²], in the arm's base frame.
        """
    @property
    def has_rotation(self) -> bool:
        """
        Whether orientations were measured too.
        """
    @property
    def order(self) -> numpy.ndarray:
        """
        (N,) rows in the order in which they were taken.
        """
    @property
    def q(self) -> numpy.ndarray:
        """
        (N, n) as recorded [rad] or [m].
        """
    @property
    def recording(self) -> bool:
        """
        Whether the rows follow each other in time; else each is a pose by itself.
        """
class EffectRange:
    """
    Plausible sizes of a parameter.
    """
    def __repr__(self) -> str:
        ...
    @property
    def high(self) -> float:
        """
        Largest plausible size, in `unit`.
        """
    @property
    def low(self) -> float:
        """
        Smallest plausible size, in `unit`.
        """
    @property
    def parameter(self) -> str:
        """
        Name of the parameter.
        """
    @property
    def unit(self) -> str:
        """
        Of `low` and `high`.
        """
class Effect:
    """
    An error of an arm that its geometric parameters cannot represent.
    
    Those of the library come from `bathyal.effects.list`; this makes one of your own. It is linear in
    its parameters: each moves its site by itself times the numbers that the function gives for it.
    Python functions are slow compared with the library's; write one in C++ to make it fast.
    
    Parameters
    ----------
    name : str
        As diagnosis will name it.
    function : callable
        ``function(data, joint)`` of the sites "joint" and "link", else ``function(data)``; `data` is an
        EffectRows. Gives what a unit of each parameter does in each row: (N, k) of the sites "joint"
        [rad or m] and "lengths" [share], (N, k, 6) of "link", "base" and "tool" (shift x, y, z [m],
        then turn x, y, z [rad], in that frame; all that lies beyond moves along). Of one parameter (N,)
        and (N, 6) do as well.
    parameters : dict of str to str
        Name to unit of each.
    joints : "each" or list of int, optional
        Of the sites "joint" and "link": which it may sit in, counted from 0.
    site : str
        What it moves: "joint", "link" (the frame of the link that the joint moves, which is also that
        of ``forward(q, links=True)``; small turns), "base", "tool" or "lengths" (all a and d of the
        arm).
    needs : list of str
        Covariates without which it is not observable.
    words, formula, source : str
        For people.
    scales : dict of str to float, optional
        A typical size of each parameter, in its unit; 1e-3 unless given.
    by_difference : bool
        Whether it depends on how rows differ from their neighbours and not on the rows themselves: the
        ranges of the training data do not bound it.
    period : float
        The shortest length scale of its dependence on joint values [rad] or [m]: in a wider gap of the
        data a corrected arm holds it at its value at the edge. Infinite unless given.
    extrapolates : bool
        Whether it follows from physics with known arguments, so that a corrected arm evaluates it
        beyond the training data as within; else it is held there.
    
    Raises
    ------
    ValueError
        For a name that is empty, no parameters, joints that do not go with the site. Where the
        effect is used: for numbers of another shape, or not finite.
    Error
        Where it is used: when the function raises.
    
    Examples
    --------
    >>> import numpy as np
    >>> from bathyal.effects import Effect
    >>> def cable(data, joint):
    ...     return np.sin(data.q[:, 1] + data.q[:, 2])
    >>> Effect("cable", cable, parameters={"pull": "rad"}, joints="each")
    Effect("cable")
    """
    def __init__(self, name: str, function: collections.abc.Callable, *, parameters: dict, joints: str | collections.abc.Iterable[int] | None = None, site: str = 'joint', needs: collections.abc.Sequence[str] = [], words: str = '', formula: str = '', source: str = '', scales: collections.abc.Mapping[str, typing.SupportsFloat | typing.SupportsIndex] = {}, by_difference: bool = False, period: typing.SupportsFloat | typing.SupportsIndex = ..., extrapolates: bool = False) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __str__(self) -> str:
        ...
    @property
    def by_difference(self) -> bool:
        """
        Whether it depends on how rows differ from their neighbours.
        """
    @property
    def extrapolates(self) -> bool:
        """
        Whether it is extrapolated beyond the training data. True of what follows from physics with
        known arguments: compliances under weight, a payload, a scale, a coupling, heat. What follows a
        curve that the data alone determine (waves, maps, drifts, play) is held there instead.
        `joint_compliance` of an arm without masses follows a curve too: `FoundEffect.extrapolates`.
        """
    @property
    def formula(self) -> str:
        """
        What it adds, as text for people.
        """
    @property
    def name(self) -> str:
        """
        As diagnosis names it.
        """
    @property
    def needs(self) -> list[str]:
        """
        Covariates without which it is not observable.
        """
    @property
    def ranges(self) -> list[EffectRange]:
        """
        EffectRange of each parameter.
        """
    @property
    def source(self) -> str:
        """
        Paper or textbook.
        """
    @property
    def words(self) -> str:
        """
        Description.
        """
class FoundEffect:
    """
    An effect with its values, as part of a corrected arm.
    
    Parameters
    ----------
    effect : Effect or str
        Or the name of one of `bathyal.effects`.
    parameters : dict of str to float
        Values, in the order of the effect's parameters.
    joint : int, optional
        Counted from 0.
    settings : dict of str to float, optional
        What distinguishes this variant of the effect from others, such as ``{"order": 2}``.
    units : dict of str to str, optional
        Of the parameters; the effect's own unless given.
    scales : dict of str to float, optional
        Typical sizes of the parameters, above 0; 1e-3 unless given.
    cause : str
        Effects of one cause are descriptions of the same thing.
    
    Raises
    ------
    ValueError
        For no such effect.
    
    Examples
    --------
    >>> from bathyal.effects import FoundEffect
    >>> FoundEffect("joint_harmonic", {"cos": 1e-3, "sin": 0.0}, joint=2, settings={"order": 2})
    FoundEffect("joint_harmonic", joint=2, cos=0.001, sin=0)
    """
    def __init__(self, effect: Effect | str, parameters: dict, *, joint: typing.SupportsInt | typing.SupportsIndex | None = None, settings: collections.abc.Mapping[str, typing.SupportsFloat | typing.SupportsIndex] = {}, units: collections.abc.Mapping[str, str] = {}, scales: collections.abc.Mapping[str, typing.SupportsFloat | typing.SupportsIndex] = {}, cause: str = '') -> None:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def cause(self) -> str:
        """
        Effects of one cause are descriptions of the same thing.
        """
    @property
    def effect(self) -> Effect:
        """
        The Effect itself.
        """
    @property
    def extrapolates(self) -> bool:
        """
        Whether it is extrapolated beyond the training data: as its effect, unless it was found with unknown masses (`joint_compliance` by moments).
        """
    @property
    def joint(self) -> int | None:
        """
        Counted from 0, or None.
        """
    @property
    def name(self) -> str:
        """
        Of its effect.
        """
    @property
    def parameters(self) -> dict:
        """
        Name to value.
        """
    @property
    def scales(self) -> dict:
        """
        Name to a typical size.
        """
    @property
    def settings(self) -> dict[str, float]:
        """
        What distinguishes this variant of the effect from others.
        """
    @property
    def units(self) -> dict:
        """
        Name to unit.
        """
class Support:
    """
    The region that the training data of a corrected arm cover.
    
    Parameters
    ----------
    joints : (2, n) array
        Minimum and maximum of each coordinate [rad] or [m].
    gaps : list of (g, 2) arrays, optional
        Of each coordinate, from and to: intervals within its range without data, ascending.
    gravity : (2, 3) array, optional
        [m/s²] in the arm's base frame; straight down unless given.
    covariates : dict of str to (2, k) array, optional
        Of all others but `session`.
    sessions : (s,) array, optional
        Of the training data, ascending.
    """
    def __init__(self, joints: numpy.typing.ArrayLike, *, gaps: collections.abc.Sequence = (), gravity: numpy.typing.ArrayLike | None = None, covariates: dict = {}, sessions: numpy.typing.ArrayLike | None = None) -> None:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def covariates(self) -> dict:
        """
        Name to (2, k): all but `session` and `gravity`.
        """
    @property
    def gaps(self) -> list:
        """
        Of each coordinate (g, 2) from and to: stretches within its range without data, wider than a 200th of it; an empty list where unknown.
        """
    @property
    def gravity(self) -> numpy.ndarray:
        """
        (2, 3) [m/s²]
        """
    @property
    def joints(self) -> numpy.ndarray:
        """
        (2, n) least and greatest of each coordinate [rad] or [m].
        """
    @property
    def sessions(self) -> numpy.ndarray:
        """
        (s,) of the training data.
        """
class CorrectedArm:
    """
    An arm with the result of a diagnosis.
    
    Rigid geometry, effects with their values, and the support of the training data: the type of
    ``report.model``. `q` is what the controller records; the effects perturb joints, frames and lengths
    from there.
    
    An effect is within the support in a row where its own arguments are: within the ranges of the
    training data, and in no gap between joint values wider than its period (of harmonics and curves
    along one joint, which were fitted together, the shortest). Where an argument lies beyond (a joint,
    a temperature, a load) and would change the effect, an effect that follows from physics with known
    arguments (`FoundEffect.extrapolates`) is extrapolated. Any other is held constant: a harmonic or
    curve along its joint at its average over the training data, because its extrapolation is
    undetermined; a smooth effect at its value in the nearest row within. A scale that was found with
    waves of the same joint is one curve with them, and held. An effect whose argument is unknown (a NaN
    covariate, a session without training data) is omitted, and where all are the result is that of the
    rigid arm. Each such call warns once with a `SupportWarning`; `in_support` and `support_reasons`
    give the rows.
    
    Every method that computes takes ``covariates``, a dict of name to a number, (N,) or (N, k) array.
    An effect that needs a missing one is omitted with the warning where no covariates are given at all,
    and refused where some are. `payload` defaults to 0 kg and `gravity` to (0, 0, −9.80665) m/s² in the
    base frame of the arm. A base that moved and a tool that was changed follow `session`; a tool that
    slipped follows `time`, without it `row` (the place in the record of the training data, counted from
    0), and without either has slipped; a clock shift follows the speeds between rows by `time`, and
    without it joints are at rest.
    
    Parameters
    ----------
    arm : Arm
        The rigid part, with base and tool.
    effects : list of FoundEffect
    data : Touches, Tracked or Support
        The training data.
    
    Raises
    ------
    ValueError
        For an effect whose values or settings do not fit the arm, or that needs a covariate that `data`
        does not have; for one that acts by weight on an arm without masses that carried nothing.
    
    Examples
    --------
    >>> import bathyal, numpy as np
    >>> arm = bathyal.arms.ur10e()
    >>> q = np.random.default_rng(1).uniform(-1, 1, (50, 6))
    >>> def cable(data, joint):
    ...     return np.sin(data.q[:, 1] + data.q[:, 2])
    >>> cable = bathyal.effects.Effect("cable", cable, parameters={"pull": "rad"}, joints="each")
    >>> pull = bathyal.effects.FoundEffect(cable, {"pull": 1e-3}, joint=3)
    >>> model = bathyal.CorrectedArm(arm, [pull], bathyal.Tracked(q, arm.forward(q)[:, :3, 3]))
    >>> model
    CorrectedArm("UR10e", 6 joints, cable of joint 4)
    >>> float(np.linalg.norm((model.forward(q) - arm.forward(q))[:, :3, 3], axis=1).max().round(4))
    0.0001
    >>> model.in_support([[0.5] * 6, [0.5, 2.0, 0.5, 0.5, 0.5, 0.5]])
    array([ True, False])
    >>> model.support_reasons([0.5, 2.0, 0.5, 0.5, 0.5, 0.5])
    'joint 2 at 2 rad, data -0.985816 to 0.976438: cable of joint 4 held'
    """
    def __copy__(self) -> CorrectedArm:
        ...
    def __deepcopy__(self, memo: dict) -> CorrectedArm:
        ...
    def __init__(self, arm: Arm, effects: collections.abc.Sequence[FoundEffect], data: Touches | Tracked | Support) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def copy(self) -> CorrectedArm:
        """
        An independent copy, with its own base and tool.
        """
    def effects_in_support(self, q: numpy.typing.ArrayLike, *, covariates: dict[str, numpy.typing.ArrayLike] | None = None) -> numpy.ndarray:
        """
        Which effects have all that they depend on within the training data, in which row.
        
        Parameters
        ----------
        q : (N, n) or (n,) array
        covariates : dict, optional
            As of `forward`.
        
        Returns
        -------
        (N, E) or (E,) array of bool
            In the order of `effects`.
        """
    def forward(self, q: numpy.typing.ArrayLike, *, covariates: dict[str, numpy.typing.ArrayLike] | None = None, links: bool = False, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> numpy.ndarray:
        """
        Poses of the tool in the world.
        
        Parameters
        ----------
        q : (N, n) or (n,) array
            As the controller records them [rad] or [m].
        covariates : dict, optional
            Name to a number for all, (N,) or (N, k) array.
        links : bool
            Poses of every link instead, in the order of `link_names`.
        num_threads : int
            0 is all.
        
        Returns
        -------
        (N, 4, 4) or (4, 4) array; with `links` (N, L, 4, 4) or (L, 4, 4)
            world_from_tool, world_from_link.
        
        Raises
        ------
        ValueError
            For other shapes, and for an incomplete set of covariates.
        
        Warns
        -----
        SupportWarning
            Where effects were extrapolated, held or omitted.
        """
    def in_support(self, q: numpy.typing.ArrayLike, *, covariates: dict[str, numpy.typing.ArrayLike] | None = None) -> bool | numpy.ndarray:
        """
        Which rows lie within the training data, as far as any effect depends on them.
        
        Parameters
        ----------
        q : (N, n) or (n,) array
        covariates : dict, optional
            As of `forward`.
        
        Returns
        -------
        (N,) array of bool, or bool
            Where it is False some effect is extrapolated, held or omitted: `effects_in_support` says which,
            `support_reasons` why.
        """
    def inverse(self, poses: numpy.typing.ArrayLike, start: numpy.typing.ArrayLike | None = None, *, covariates: dict[str, numpy.typing.ArrayLike] | None = None, task: str = 'pose', axis: numpy.typing.ArrayLike = (0.0, 0.0, 1.0), position_tolerance: typing.SupportsFloat | typing.SupportsIndex | None = None, angle_tolerance: typing.SupportsFloat | typing.SupportsIndex | None = None, max_iterations: typing.SupportsInt | typing.SupportsIndex = 60, max_starts: typing.SupportsInt | typing.SupportsIndex = 64, candidates: typing.SupportsInt | typing.SupportsIndex = 1, centering_steps: typing.SupportsInt | typing.SupportsIndex | None = None, seed: typing.SupportsInt | typing.SupportsIndex = 0, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> InverseResult:
        """
        The joint values to command so that the tool reaches poses.
        
        The rigid arm (`Arm.inverse`, method "damped") is sent to the target minus the effects, until the
        corrected tip agrees to the tolerances, 1e-9 m and rad unless given. Arguments and statuses are
        those of `Arm.inverse`, with `covariates` as `forward` takes them; errors are those of the corrected
        arm.
        
        A pose in the middle of a gap, where an effect held at one edge brings it nearer to the other, is
        "singular", with the remaining error. At the edge of the workspace of the rigid arm a pose may be
        reported out of reach within the size of the effects.
        
        Returns
        -------
        InverseResult
            .q (N, n), .status, .error, .position_error, .angle_error, .iterations, .starts.
        
        Raises
        ------
        ValueError
            As `Arm.inverse` and `forward`.
        
        Warns
        -----
        SupportWarning
            Where effects were extrapolated, held or omitted at the solution q.
        """
    def jacobian(self, q: numpy.typing.ArrayLike, *, covariates: dict[str, numpy.typing.ArrayLike] | None = None, frame: str = 'world', num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> numpy.ndarray:
        """
        Geometric Jacobians at the tool centre point.
        
        The derivative of `forward`: analytic for the perturbed chain, with central differences of the
        perturbations (step 1e-6 rad or m). Arguments, errors and warnings are those of `forward`, and the
        axes of `Arm.jacobian`.
        
        Returns
        -------
        (N, 6, n) or (6, n) array
            Rows of the linear velocity [m/s] above those of the angular velocity [rad/s].
        """
    def plot(self, q: numpy.typing.ArrayLike | None = None, path: str | os.PathLike[str] | None = None) -> matplotlib.figure.Figure:
        """
        As of `Arm`: the rigid part alone.
        """
    def save(self, path: str | os.PathLike[str]) -> None:
        """
        Write all of it to a file for bathyal.read_arm.
        
        Parameters
        ----------
        path : path
            ``.json``: see bathyal.arm.corrected_files.save_corrected_arm.
        """
    def show(self, q: numpy.typing.ArrayLike | None = None) -> plotly.graph_objects.Figure:
        """
        As of `Arm`: the rigid part alone.
        """
    def support_reasons(self, q: numpy.typing.ArrayLike, *, covariates: dict[str, numpy.typing.ArrayLike] | None = None) -> list[str] | str:
        """
        Why rows do not lie within the training data, and what is done there.
        
        Parameters
        ----------
        q : (N, n) or (n,) array
        covariates : dict, optional
            As of `forward`.
        
        Returns
        -------
        list of N str, or str
            Of each row the joints and covariates that lie beyond, each with the effects that depend on it,
            as "joint 2 at 1.7 rad, data -1 to 1: joint_harmonic of joint 2 held"; "" within. Joints count
            from 1.
        """
    def to_urdf(self, path: str | os.PathLike[str] | None = None) -> str:
        """
        As of `Arm`: the rigid part alone.
        """
    def within_limits(self, q: numpy.typing.ArrayLike) -> bool | numpy.ndarray:
        """
        As of `Arm`.
        """
    def write(self, path: str | os.PathLike[str]) -> None:
        """
        As `save`.
        """
    @property
    def arm(self) -> Arm:
        """
        Arm: a copy of the rigid part, for uses without effects (its .to_urdf()).
        """
    @property
    def base(self) -> numpy.ndarray:
        """
        (4, 4) world_from_base; may be set, None is the identity.
        """
    @base.setter
    def base(self, arg1: numpy.typing.ArrayLike | None) -> None:
        ...
    @property
    def effects(self) -> list[FoundEffect]:
        """
        List of FoundEffect.
        """
    @property
    def effort(self) -> numpy.ndarray:
        """
        As of `Arm`.
        """
    @property
    def gaps(self) -> list:
        """
        Of each coordinate (g, 2) from and to: gaps of the support in which a wave or curve along it is held.
        """
    @property
    def joint_names(self) -> list[str]:
        """
        As of `Arm`.
        """
    @property
    def joint_types(self) -> list[str]:
        """
        As of `Arm`.
        """
    @property
    def link_names(self) -> list[str]:
        """
        As of `Arm`.
        """
    @property
    def links(self) -> list[Link]:
        """
        As of `Arm`.
        """
    @property
    def lower(self) -> numpy.ndarray:
        """
        As of `Arm`.
        """
    @property
    def name(self) -> str:
        """
        Of the rigid arm.
        """
    @property
    def size(self) -> int:
        """
        Number of coordinates n, the width of every q.
        """
    @property
    def source(self) -> str:
        """
        Where the numbers come from.
        """
    @property
    def support(self) -> Support:
        """
        The region that the data cover.
        """
    @property
    def tool(self) -> numpy.ndarray:
        """
        (4, 4) flange_from_tool; may be set, None is the identity.
        """
    @tool.setter
    def tool(self, arg1: numpy.typing.ArrayLike | None) -> None:
        ...
    @property
    def upper(self) -> numpy.ndarray:
        """
        As of `Arm`.
        """
    @property
    def velocity(self) -> numpy.ndarray:
        """
        As of `Arm`.
        """
class Trade:
    """
    A parameter that takes part in an unobservable change of another one.
    """
    def __repr__(self) -> str:
        ...
    @property
    def factor(self) -> float:
        """
        Its change per unit of the other one, each in its own unit.
        """
    @property
    def name(self) -> str:
        """
        Of the parameter, as "theta_3".
        """
    @property
    def words(self) -> str:
        """
        Description, as "theta of row 3".
        """
class FitParameter:
    """
    One parameter as estimated by `identify_arm`.
    
    ``status`` is "identified"; "gauge" (fixed: base or tool can represent it); "prior" (determined by a
    prior, not by the data); "not_identifiable"; "fixed" (on request); "pruned" (reset to nominal on
    request). ``trades`` lists the parameters that take part in an unobservable change of it.
    """
    def __repr__(self) -> str:
        ...
    @property
    def group(self) -> str:
        """
        Part of the arm, as "row 3", "tool" or "base".
        """
    @property
    def name(self) -> str:
        """
        As "theta_3".
        """
    @property
    def nominal(self) -> float:
        """
        In `unit`; of a tool or a base, where the search started.
        """
    @property
    def status(self) -> str:
        """
        How it is determined; see the class.
        """
    @property
    def std(self) -> float:
        """
        Standard deviation, in `unit`: 0 when fixed, inf when undetermined.
        """
    @property
    def trades(self) -> list[Trade]:
        """
        Parameters that take part in an unobservable change of it.
        """
    @property
    def unit(self) -> str:
        """
        "m" or "rad".
        """
    @property
    def value(self) -> float:
        """
        Estimate, in `unit`.
        """
    @property
    def words(self) -> str:
        """
        Description, as "theta of row 3".
        """
class Outlier:
    """
    A row that contradicts the others.
    """
    def __repr__(self) -> str:
        ...
    @property
    def distance(self) -> float:
        """
        From its expected position [m].
        """
    @property
    def fits(self) -> int | None:
        """
        Label of the point that it agrees with, or None: labels were probably swapped.
        """
    @property
    def point(self) -> int:
        """
        Label of its point; -1 where there is none.
        """
    @property
    def row(self) -> int:
        """
        Row of the data, counted from 0.
        """
class ArmFit:
    """
    Result of `identify_arm`: the arm with its uncertainty.
    
    ``str(fit)`` describes it in a few lines, ``fit.summary()`` in one paragraph.
    """
    def __repr__(self) -> str:
        ...
    def __str__(self) -> str:
        """
        Verdict, numbers with units and the next step, in a few lines.
        """
    def summary(self, *, warnings: bool = True) -> str:
        """
        One paragraph; ``warnings=False`` leaves the warnings to the caller.
        """
    def tip_covariance(self, q: numpy.typing.ArrayLike, *, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> numpy.ndarray:
        """
        Covariance of the tip predicted by ``fit.arm``, in the frame of its base.
        
        Gauge freedom does not count, the scale of the arm counts. Infinite on the diagonal where a
        direction that neither data nor priors determine moves the tip.
        
        Parameters
        ----------
        q : (N, n) or (n,) array
            [rad] or [m]
        
        Returns
        -------
        (N, 3, 3) or (3, 3) array
            [m²]
        """
    def tip_std(self, q: numpy.typing.ArrayLike, *, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> float | numpy.ndarray:
        """
        Standard deviation of the predicted tip: √trace of `tip_covariance`, all three axes together.
        
        Parameters
        ----------
        q : (N, n) or (n,) array
            [rad] or [m]
        
        Returns
        -------
        (N,) array or float
            [m]
        """
    @property
    def arm(self) -> Arm:
        """
        Arm: identified, its base and tool set.
        """
    @property
    def bases(self) -> list:
        """
        (4, 4) world_from_base of each station.
        """
    @property
    def converged(self) -> bool:
        """
        Whether the search ended before its limit of iterations.
        """
    @property
    def covariance(self) -> numpy.ndarray:
        """
        (P, P) in the units of the parameters; 0 for undetermined ones.
        """
    @property
    def degrees_of_freedom(self) -> float:
        """
        Position rows less those of points and parameters.
        """
    @property
    def distances(self) -> dict:
        """
        Estimates of the known distances: {(label, label): m}.
        """
    @property
    def history(self) -> numpy.ndarray:
        """
        Sum of squares of the criterion at the start and after each step [m²].
        """
    @property
    def iterations(self) -> int:
        """
        Accepted steps.
        """
    @property
    def noise(self) -> float:
        """
        Standard deviation per axis, estimated or given [m].
        """
    @property
    def outliers(self) -> list[Outlier]:
        """
        Outlier of each row that contradicts the others.
        """
    @property
    def pairs_after(self) -> float:
        """
        [m²]
        """
    @property
    def pairs_before(self) -> float:
        """
        J of Yukhimets, Gubankov (2023), eq 7 [m²].
        """
    @property
    def parameters(self) -> list[FitParameter]:
        """
        FitParameter of each unknown.
        """
    @property
    def point_labels(self) -> list[int]:
        """
        (K,) label of each touched point, in the order of `points`.
        """
    @property
    def point_rms_after(self) -> numpy.ndarray:
        """
        (n,) [m]
        """
    @property
    def point_rms_before(self) -> numpy.ndarray:
        """
        (n,) of each point, or station when tracked [m].
        """
    @property
    def points(self) -> numpy.ndarray:
        """
        (n, 3) estimated positions of the touched points, world [m].
        """
    @property
    def rank(self) -> int:
        """
        Of the data by all parameters, without priors.
        """
    @property
    def residuals(self) -> numpy.ndarray:
        """
        (N, 3) tip minus centroid, or minus the measured position, world [m].
        """
    @property
    def residuals_before(self) -> numpy.ndarray:
        """
        (N, 3) the same for `rms_before` [m].
        """
    @property
    def rms_after(self) -> float:
        """
        √mean‖e‖² [m].
        """
    @property
    def rms_after_scaled(self) -> float:
        """
        rms_after times given by estimated lengths: its value at the true scale [m].
        """
    @property
    def rms_before(self) -> float:
        """
        Nominal rows with the best start of tool and base: √mean‖e‖² [m].
        """
    @property
    def rotation_noise(self) -> float:
        """
        [rad]
        """
    @property
    def rotation_rms_after(self) -> float:
        """
        [rad]
        """
    @property
    def rotation_rms_before(self) -> float:
        """
        [rad]
        """
    @property
    def scale(self) -> float:
        """
        Estimated by nominal lengths.
        """
    @property
    def scale_source(self) -> str:
        """
        What determines the scale of the arm.
        """
    @property
    def scale_std(self) -> float:
        """
        Relative standard deviation of `scale`.
        """
    @property
    def singular_values(self) -> numpy.ndarray:
        """
        (P,) descending: millimetres at the tip per mm and mrad of a direction.
        """
    @property
    def std(self) -> numpy.ndarray:
        """
        (P,) of each parameter: 0 when fixed, inf when undetermined.
        """
    @property
    def structure_p(self) -> float:
        """
        Probability of residuals that depend on the joints this much by chance.
        """
    @property
    def tools(self) -> list:
        """
        (4, 4) flange_from_tool of each tool.
        """
    @property
    def unseen(self) -> list[str]:
        """
        Descriptions of the unobservable directions.
        """
    @property
    def warnings(self) -> list[str]:
        """
        Sentences; empty when all is well.
        """
class TouchForecast:
    """
    Predicted accuracy of an arm identified from touches: see `forecast_touches`.
    """
    def __repr__(self) -> str:
        ...
    @property
    def free(self) -> int:
        """
        Of them, those that base and tool cannot represent.
        """
    @property
    def log_det(self) -> float:
        """
        ln det of the free parameters' information per mm and mrad, with priors.
        """
    @property
    def median_tip_std(self) -> float:
        """
        [m]
        """
    @property
    def o1(self) -> float:
        """
        Observability index of Borm and Menq (1989).
        """
    @property
    def parameters(self) -> int:
        """
        As many as ArmFit.parameters.
        """
    @property
    def rank(self) -> int:
        """
        Of the data by the free ones, without priors.
        """
    @property
    def singular_values(self) -> numpy.ndarray:
        """
        (free,) descending: millimetres at the tip per mm and mrad of a direction.
        """
    @property
    def tip_std(self) -> numpy.ndarray:
        """
        (S,) root of the trace of the tip's covariance there [m].
        """
    @property
    def unseen(self) -> list[str]:
        """
        Descriptions of the undetermined directions of the free parameters.
        """
    @property
    def workspace(self) -> numpy.ndarray:
        """
        (S, n) poses for which the deviation is predicted.
        """
    @property
    def worst_tip_std(self) -> float:
        """
        [m]
        """
class TouchPlan:
    """
    Poses in which to touch, and the predicted accuracy of the arm: see `plan_touches`.
    """
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    def __str__(self) -> str:
        ...
    def plot(self, path: str | os.PathLike[str] | None = None) -> matplotlib.figure.Figure:
        """
        A picture: the arm in its poses, the points, the tool's directions at each.
        
        Parameters
        ----------
        path : path, optional
            ``.png``, ``.pdf`` or ``.svg`` to write it to, too: see
            bathyal.identify.touch_plans.plot_plan.
        """
    def summary(self, *, warnings: bool = True) -> str:
        """
        One paragraph.
        """
    def write(self, path: str | os.PathLike[str]) -> None:
        """
        Write a table to touch by.
        
        Parameters
        ----------
        path : path
            ``.csv``, for bathyal.read_touches: see bathyal.identify.touch_plans.write_plan.
        """
    @property
    def arm(self) -> Arm:
        """
        Arm for which the plan is.
        """
    @property
    def candidates(self) -> int:
        """
        Number of candidate poses.
        """
    @property
    def criterion(self) -> str:
        """
        "worst_tip", "d_optimal" or "o1": what was optimised.
        """
    @property
    def forecast(self) -> TouchForecast:
        """
        TouchForecast of these touches.
        """
    @property
    def known_distances(self) -> list[tuple[int, int]]:
        """
        Pairs of points whose distance is to be measured.
        """
    @property
    def median_tip_std(self) -> float:
        """
        Of the forecast [m].
        """
    @property
    def point(self) -> numpy.ndarray:
        """
        (N,) number of the point that each pose touches.
        """
    @property
    def points(self) -> numpy.ndarray:
        """
        (k, 3) positions of the points, world [m].
        """
    @property
    def q(self) -> numpy.ndarray:
        """
        (N, n) poses, point by point, each near the one before [rad] or [m].
        """
    @property
    def value(self) -> float:
        """
        Of the criterion: worst_tip [m], ln det, or O1.
        """
    @property
    def warnings(self) -> list[str]:
        """
        Sentences.
        """
    @property
    def worst_tip_std(self) -> float:
        """
        Of the forecast [m].
        """
class Verification:
    """
    How far positions that an arm predicts lie from measured ones: see `verify_arm`.
    """
    def __repr__(self) -> str:
        ...
    @property
    def deviation(self) -> numpy.ndarray:
        """
        (N,) distance of each prediction from its measured position, aligned [m].
        """
    @property
    def measured_from_predicted(self) -> numpy.ndarray:
        """
        (4, 4) the alignment.
        """
    @property
    def pairs(self) -> numpy.ndarray:
        """
        (N,) row of the measured positions that belongs to each prediction.
        """
    @property
    def residual(self) -> numpy.ndarray:
        """
        (N, 3) measured less predicted, aligned, in the measured frame [m].
        """
    @property
    def rms_after(self) -> float:
        """
        √mean‖e‖² aligned [m].
        """
    @property
    def rms_before(self) -> float:
        """
        √mean‖e‖² with the centroids removed only [m].
        """
class Estimate:
    """
    A number with its 95 % confidence interval; float() gives the number.
    """
    def __float__(self) -> float:
        ...
    def __int__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def interval(self) -> tuple[float, float]:
        """
        Ends of the 95 % confidence interval, in `unit`.
        """
    @property
    def name(self) -> str:
        """
        Of the parameter.
        """
    @property
    def std(self) -> float:
        """
        0 of what was counted or chosen, not measured.
        """
    @property
    def unit(self) -> str:
        """
        SI; "" of a setting, "1" of a number.
        """
    @property
    def value(self) -> float:
        """
        In `unit`.
        """
class Cause:
    """
    A cause by name, as lists of alternatives hold it.
    """
    def __repr__(self) -> str:
        ...
    @property
    def joint(self) -> int | None:
        """
        Counted from 0; None of an effect of the whole arm.
        """
    @property
    def name(self) -> str:
        """
        Of the effect.
        """
    @property
    def odds(self) -> float:
        """
        Against the best explanation, 0 to 1.
        """
    @property
    def words(self) -> str:
        """
        Description, as "a harmonic of order 2 along joint 3".
        """
class NamedEffect:
    """
    A cause that was found, with its evidence.
    """
    def __repr__(self) -> str:
        ...
    @property
    def gain(self) -> float:
        """
        Share of the held-out variance above noise that it explains; of effects on the noise itself: held-out log likelihood.
        """
    @property
    def held_out_after(self) -> float:
        """
        With it, 3-D rms [m].
        """
    @property
    def held_out_before(self) -> float:
        """
        Without it, 3-D rms [m].
        """
    @property
    def joint(self) -> int | None:
        """
        Coordinate in error, from 0, or None.
        """
    @property
    def name(self) -> str:
        """
        Of the effect.
        """
    @property
    def nested_folds(self) -> int:
        """
        In how many folds of `held_out.nested` the same was found in this joint.
        """
    @property
    def p_value(self) -> float:
        """
        Of its F test given the others, corrected for multiplicity.
        """
    @property
    def parameters(self) -> dict:
        """
        Estimate of each parameter, by name.
        """
    @property
    def rivals(self) -> list[Cause]:
        """
        Cause: the best alternatives to it.
        """
    @property
    def rows(self) -> list[int]:
        """
        Of outliers: the rows.
        """
    @property
    def size(self) -> float:
        """
        rms contribution given all else that was fitted, per axis [m].
        """
    @property
    def words(self) -> str:
        """
        Description, as "a harmonic of order 2 along joint 3".
        """
class Structure:
    """
    A lack-of-fit test: a dependence of the residuals, significant or not.
    """
    def __repr__(self) -> str:
        ...
    @property
    def against(self) -> str:
        """
        The dependence as text, joints counted from 1: "joints 2 and 3"; "" of kind "none".
        """
    @property
    def component(self) -> int | None:
        """
        Column of a covariate that has several, from 0; else None.
        """
    @property
    def coordinates(self) -> list[int]:
        """
        Of kind "joints" (one, two or all) and "approach" (one): the joints' coordinates, from 0.
        """
    @property
    def covariate(self) -> str | None:
        """
        Of kind "covariate": its name; else None.
        """
    @property
    def is_beyond_noise(self) -> bool:
        """
        Whether `p_value` is at most 0.002.
        """
    @property
    def joint(self) -> int | None:
        """
        Coordinate that is in error, from 0; None where the tip is.
        """
    @property
    def kind(self) -> str:
        """
        What the residuals depend on: "position" of the tip, its "range" from the instrument,
        "joints" (one, two or all), "time", "order" of the rows (where no times are recorded),
        "approach" (the direction of a joint's last move), "session" or "covariate"; "none" where nothing was found.
        """
    @property
    def p_value(self) -> float:
        """
        Corrected for all tests that were made.
        """
    @property
    def period(self) -> float | None:
        """
        Of kind "time": period of a vibration [s]; None of a drift.
        """
    @property
    def share(self) -> float:
        """
        Of the residuals' variance, less noise.
        """
    @property
    def size(self) -> float:
        """
        rms per axis, less noise [m].
        """
    @property
    def words(self) -> str:
        """
        Description of the dependence.
        """
class HeldOutPart:
    """
    One group, session or touched point.
    """
    @property
    def name(self) -> str:
        """
        "group east", "session 2", "point 0", "all".
        """
    @property
    def rms_after(self) -> float:
        """
        3-D [m].
        """
    @property
    def rms_before(self) -> float:
        """
        3-D [m].
        """
    @property
    def rows(self) -> int:
        """
        How many rows it has.
        """
class HeldOutNested:
    """
    Prediction errors of rows that had no part in the choice of causes either (nested cross-validation).
    """
    @property
    def after(self) -> numpy.ndarray:
        """
        (N,) [m]; nan: an outlier, or a tool or station that only its fold has.
        """
    @property
    def folds(self) -> int:
        """
        Number of folds, each held out of a whole diagnosis.
        """
    @property
    def rms_after(self) -> float:
        """
        3-D, of the rows that `after` has [m].
        """
    @property
    def verdicts(self) -> list[str]:
        """
        list of str: the verdict of each of these diagnoses.
        """
class HeldOut:
    """
    Prediction errors of held-out rows.
    """
    @property
    def after(self) -> numpy.ndarray:
        """
        (N,) [m].
        """
    @property
    def before(self) -> numpy.ndarray:
        """
        (N,) geometry alone [m]; NaN of outliers.
        """
    @property
    def blocks(self) -> int:
        """
        Number of folds.
        """
    @property
    def how(self) -> str:
        """
        What one fold is.
        """
    @property
    def nested(self) -> HeldOutNested | None:
        """
        HeldOutNested: the causes chosen anew without each fold; None unless asked for.
        """
    @property
    def noise(self) -> float:
        """
        Floor, 3-D [m].
        """
    @property
    def p_value(self) -> float:
        """
        Of the gain, by sign flips of the folds.
        """
    @property
    def parts(self) -> list[HeldOutPart]:
        """
        HeldOutPart: errors by group, session or touched point.
        """
    @property
    def rms_after(self) -> float:
        """
        With the effects, 3-D [m].
        """
    @property
    def rms_before(self) -> float:
        """
        Geometry alone, 3-D [m].
        """
class Diagnosis:
    """
    Errors of an arm's model, by its measurements; see `diagnose`.
    """
    def __repr__(self) -> str:
        ...
    def __str__(self) -> str:
        """
        Verdict, numbers with units and the next step, in a few lines.
        """
    def summary(self) -> str:
        """
        One paragraph that a person can act on.
        """
    def write(self, path: str | os.PathLike[str]) -> None:
        """
        Write the report.
        
        Parameters
        ----------
        path : path
            A page (``.html``), a picture (``.png``) or everything for machines (``.json``): see
            bathyal.diagnosis.files.write_diagnosis.
        
        Raises
        ------
        ValueError
            For another ending.
        """
    @property
    def ambiguous(self) -> list[Cause]:
        """
        Cause: what these data cannot distinguish; the four most likely in the place of an effect, itself included. Its `rivals` may be more.
        """
    @property
    def data(self) -> Touches | Tracked:
        """
        Touches or Tracked: the data.
        """
    @property
    def detectable(self) -> float:
        """
        Smallest size of an effect that is found, per axis [m].
        """
    @property
    def effects(self) -> list[NamedEffect]:
        """
        NamedEffect, largest first; partial when the verdict is unknown.
        """
    @property
    def fit(self) -> ArmFit:
        """
        ArmFit: geometry alone.
        """
    @property
    def gain(self) -> float:
        """
        (r0² - r1²) / (r0² - noise²) of held-out rms.
        """
    @property
    def held_out(self) -> HeldOut:
        """
        HeldOut: the cross-validation.
        """
    @property
    def leftover(self) -> Structure:
        """
        Structure that the effects do not explain; its size is 0 when there is none.
        """
    @property
    def model(self) -> CorrectedArm:
        """
        CorrectedArm: geometry and effects, with the support of the data.
        """
    @property
    def next_poses(self) -> numpy.ndarray:
        """
        (m, n) poses that would distinguish them [rad or m].
        """
    @property
    def noise(self) -> float:
        """
        Standard deviation per axis [m].
        """
    @property
    def noise_is_measured(self) -> bool:
        """
        Whether repeats of poses give the noise; otherwise it is what the model itself leaves.
        """
    @property
    def noise_source(self) -> str:
        """
        What the noise was estimated from.
        """
    @property
    def residuals_after(self) -> numpy.ndarray:
        """
        (N, 3) the same with the effects [m].
        """
    @property
    def residuals_before(self) -> numpy.ndarray:
        """
        (N, 3) tip less measured (of touches: less their mean), geometry alone [m].
        """
    @property
    def shown(self) -> list[Structure]:
        """
        Structure in the residuals of geometry alone, most significant first: all that is beyond noise; where nothing is, the most significant.
        """
    @property
    def verdict(self) -> str:
        """
        "clean", "named", "ambiguous", "unknown", or "none" where nothing can be held out.
        """
    @property
    def warnings(self) -> list[str]:
        """
        Sentences.
        """
def absorption(frequency: numpy.typing.ArrayLike, temperature: numpy.typing.ArrayLike, salinity: numpy.typing.ArrayLike, depth: numpy.typing.ArrayLike, ph: numpy.typing.ArrayLike = 8.0, formula: str = 'francois_garrison') -> float | numpy.ndarray:
    """
    Absorption of sound in seawater.
    
    Parameters
    ----------
    frequency : float or array
        [Hz]
    temperature : float or array
        [°C]
    salinity : float or array
        Practical.
    depth : float or array
        [m]
    ph : float or array
        Of the water.
    formula : str
        ``"francois_garrison"`` (1982), ±5 %: −2 to 22 °C, salinity 30 to 35 and to 3 500 m below
        500 kHz; 0 to 30 °C, 0 to 40 and to 10 000 m above.
        ``"ainslie_mccolm"`` (1998), within 10 % of it: 100 Hz to 1 MHz, −6 to 35 °C, 5 to 50, to
        7 000 m, pH 7.7 to 8.3.
    
    Returns
    -------
    float or array
        One way, of the power in dB/km; outside a formula's range it extrapolates, with a
        `RangeWarning`.
    
    Raises
    ------
    ValueError
        For a frequency not above 0, numbers that no water has, shapes that do not broadcast.
    
    Examples
    --------
    >>> import bathyal
    >>> bathyal.absorption([100e3, 600e3, 900e3], 10, 35, 50).round(1).tolist()
    [33.4, 158.6, 298.6]
    """
def allan_deviation(rate_data: numpy.typing.ArrayLike, sample_rate: typing.SupportsFloat | typing.SupportsIndex, factors: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex] = []) -> tuple[numpy.ndarray, numpy.ndarray]:
    """
    Overlapping Allan deviation of equally spaced samples.
    
    White noise of density n falls as n/√τ, a random walk of k per √s rises as k √(τ/3) (IEEE Std 952,
    annex C).
    
    Parameters
    ----------
    rate_data : (N,) array
        Such as rates of turn [rad/s]; 4 or more, finite.
    sample_rate : float
        [Hz]
    factors : (K,) array of int, optional
        Averaging times as numbers of samples, 1 to N / 2; 1, 2, 4, … N / 4 unless given.
    
    Returns
    -------
    interval : (K,) array
        Averaging times [s].
    deviation : (K,) array
        In the unit of the data.
    
    Raises
    ------
    ValueError
        For fewer samples, ones that are not finite, a sample rate not above 0, factors out of range.
    
    Examples
    --------
    >>> import bathyal
    >>> bathyal.allan_deviation([1.0, -1.0] * 8, 10.0, [1, 2])[1].tolist()
    [1.4142135623730951, 0.0]
    """
def ambient_noise(frequency: numpy.typing.ArrayLike, wind_speed: numpy.typing.ArrayLike = 5.0, shipping: numpy.typing.ArrayLike = 0.5) -> float | numpy.ndarray:
    """
    Noise of the sea, by the curves of Wenz (1962).
    
    The sum of turbulence, ships, wind and, above some 100 kHz, the motion of molecules, by the formulas
    of Coates (1990).
    
    Parameters
    ----------
    frequency : float or array
        1 Hz to 10 MHz [Hz].
    wind_speed : float or array
        At 10 m, 0 to 50 [m/s].
    shipping : float or array
        From 0 (none near) to 1 (heavy).
    
    Returns
    -------
    float or array
        Spectral level [dB re 1 µPa²/Hz].
    
    Examples
    --------
    >>> import bathyal
    >>> bathyal.ambient_noise([1e3, 100e3, 600e3]).round(1).tolist()
    [61.0, 28.9, 40.6]
    """
def ardupilot_json(*, time: typing.SupportsFloat | typing.SupportsIndex, gyro: numpy.typing.ArrayLike, force: numpy.typing.ArrayLike, position: numpy.typing.ArrayLike, attitude: numpy.typing.ArrayLike, velocity: numpy.typing.ArrayLike, altitude: typing.SupportsFloat | typing.SupportsIndex | None = None) -> bytes:
    """
    The line of JSON that ArduPilot takes from a simulator.
    
    Parameters
    ----------
    time : float
        [s]
    gyro, force, position, attitude, velocity : (3,) array
        Rates and specific force along ahead, starboard, down; position and velocity along north, east,
        down; roll, pitch, yaw [rad, m, s].
    altitude : float, optional
        [m]
    
    Returns
    -------
    bytes
    
    Raises
    ------
    ValueError
        For numbers that are not finite.
    """
def arm_from_chain(chain: dict, *, nearly_parallel: typing.SupportsFloat | typing.SupportsIndex = 0.1) -> Arm:
    """
    The Arm of joint origins, axes and links: what a URDF describes.
    """
def arm_from_parts(parts: dict) -> Arm:
    """
    The Arm of such a dict.
    """
def arm_parts(arm: Arm) -> dict:
    """
    Everything an Arm is made of.
    """
def best_standpoint(arm: Arm, mount: numpy.typing.ArrayLike | None, hull: Hull | None, scene: Scene | None, targets: numpy.typing.ArrayLike, *, keepouts: collections.abc.Sequence[KeepOut] = [], radii: numpy.typing.ArrayLike | None = None, capsules: dict[str, list[Capsule]] | None = None, allowed: list[tuple[str, str]] = [], voxel: typing.SupportsFloat | typing.SupportsIndex = 0.05, headings: typing.SupportsInt | typing.SupportsIndex = 24, step: typing.SupportsFloat | typing.SupportsIndex = 0.1, hull_clearance: typing.SupportsFloat | typing.SupportsIndex = 0.05, refined: typing.SupportsInt | typing.SupportsIndex = 12, alternatives: typing.SupportsInt | typing.SupportsIndex = 3, seed: typing.SupportsInt | typing.SupportsIndex = 0, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> Standpoint:
    """
    Find where a vehicle should be, level, for its arm to reach most of `targets`.
    
    Places on a lattice and headings are scored by the reach map of arm, hull and what is fixed to them;
    the best that leave the hull room are moved uphill, and those are scored by
    `Workspace.check_target`, which decides. The score is the number of targets reached and their mean
    margin, in (0, 1): depth / (depth + 0.1 m), where the depth is the distance from the target to the
    border of the free part of the reach map: how far the vehicle may be off.
    
    The hull has room where it keeps `hull_clearance` from the bottom's triangles and lies above them,
    seen from above (where the scene has no bottom: above its highest point), and keeps out of volumes
    fixed to the world. Without a hull that goes for the vehicle's origin.
    
    Parameters
    ----------
    arm : Arm
    mount : (4, 4) array or None
        vehicle_from_base.
    hull : Hull or None
        In the vehicle's frame.
    scene : Scene or None
        In the world: the bottom and what lies on it.
    targets : (N, 3) array
        In the world [m].
    keepouts : list of KeepOut
        Each in the frame that it names; those that move, at time 0.
    radii, capsules, allowed
        As of `Workspace`.
    voxel : float
        Of the reach map [m].
    headings : int
        Looked at first, evenly over a turn, 1 to 360.
    step : float
        Between the places looked at first [m].
    hull_clearance : float
        [m], 0 or more.
    refined : int
        Places that are refined and checked.
    alternatives : int
        At most, 0 or more.
    seed : int
        Of the reach map and the checks of targets.
    num_threads : int
        0 means all; the same bytes for any number.
    
    Returns
    -------
    Standpoint
    
    Raises
    ------
    ValueError
        For no target, one that is not finite, options out of range, and as `Workspace`.
    
    Warns
    -----
    UserWarning
        As `Workspace`.
    
    Examples
    --------
    >>> import bathyal, numpy as np
    >>> arm = bathyal.arms.maevskiy_zanin()
    >>> mount = np.eye(4)
    >>> mount[:3, 3] = 0.5, 0.0, -0.2
    >>> square = np.array([[-3, -3, 0], [3, -3, 0], [3, 3, 0], [-3, 3, 0]], dtype=float)
    >>> bottom = bathyal.TriangleMesh(square, [[0, 1, 2], [0, 2, 3]])
    >>> targets = [[0.0, 0.0, 0.02], [0.3, 0.1, 0.02]]
    >>> found = bathyal.best_standpoint(
    ...     arm, mount, None, bathyal.Scene(bottom), targets, radii=0.03, voxel=0.1, headings=8, step=0.2
    ... )
    >>> found.status, found.reached.tolist()
    ('all', [True, True])
    """
def chain_from_arm(arm: Arm) -> dict:
    """
    Joint origins, axes and links of an Arm; the last joint is the flange's.
    """
def check_bytes(what: str, bytes: typing.SupportsFloat | typing.SupportsIndex) -> None:
    """
    Raise `Error` where `bytes` are more than one file may take in memory.
    
    The limit is BATHYAL_MOST_BYTES of the environment, 4 GiB where that is not set.
    """
def clean_cloud(cloud: PointCloud | numpy.typing.ArrayLike, *, same_place: str = 'keep', spike_sigma: typing.SupportsFloat | typing.SupportsIndex = 0.0, spike_height: typing.SupportsFloat | typing.SupportsIndex = 0.1, spike_neighbours: typing.SupportsInt | typing.SupportsIndex = 16, outlier_sigma: typing.SupportsFloat | typing.SupportsIndex = 0.0, outlier_neighbours: typing.SupportsInt | typing.SupportsIndex = 12, voxel: typing.SupportsFloat | typing.SupportsIndex = 0.0, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> CleanResult:
    """
    Drop points that are no soundings and, on request, redundant ones and outliers; report how many.
    
    Points that are not finite go first, then exact duplicates. The other steps run only on request, in
    the order of the parameters. Attributes and datum follow; rows keep their order, and which positions
    stay does not depend on it.
    
    Parameters
    ----------
    cloud : PointCloud or (N, 3) array
    same_place : "keep", "shallowest" or "deepest"
        Which of several soundings with equal x, y and different z stays. They are counted in any case.
    spike_sigma, spike_height, spike_neighbours : float, float, int
        Drop soundings further from the median height of their neighbours in plan than `spike_sigma`
        robust standard deviations (of the neighbours or of the whole cloud, whichever is larger) and
        than `spike_height` [m]. 0 does not look for spikes.
    outlier_sigma, outlier_neighbours : float, int
        Drop soundings whose mean distance to their neighbours in space is above that of all by more than
        `outlier_sigma` standard deviations (Rusu et al. 2008). 0 does not look for outliers.
    voxel : float
        Of all soundings in a cube of this edge [m] keep the one nearest to their centroid: what stays
        was measured. 0 does not thin.
    num_threads : int
        0: all.
    
    Returns
    -------
    CleanResult
        ``.cloud``, ``.report`` and ``.rows``.
    
    Raises
    ------
    ValueError
        An option out of its range.
    
    Examples
    --------
    >>> import bathyal
    >>> cloud = bathyal.PointCloud([[0, 0, -5], [0, 0, -5], [1, 0, float("nan")], [2, 0, -5.1]])
    >>> result = bathyal.clean_cloud(cloud)
    >>> result.cloud
    PointCloud(2 points)
    >>> print(result.report)
    2 of 4 soundings kept
      1 dropped: a coordinate is not finite
      1 dropped: exact duplicates (equal x, y, z)
    """
def cover_polygon(surface: Scene | Plane, polygon: numpy.typing.ArrayLike, spacing: typing.SupportsFloat | typing.SupportsIndex, *, direction: typing.SupportsFloat | typing.SupportsIndex = 0.0, margin: typing.SupportsFloat | typing.SupportsIndex = 0.0) -> numpy.ndarray:
    """
    Aims that mow a polygon in parallel lines.
    
    Two axes straight down for every straight stretch, at its beginning and its end; plan_toolpath joins
    them along the bottom. A concave polygon is mown cell by cell; the way to the next cell may leave it.
    
    Parameters
    ----------
    surface : Scene or Plane
    polygon : (N, 2) array
        Corners (x, y) in the world [m], in either sense.
    spacing : float
        Widest distance between neighbouring lines [m]; the outermost lie half of it inside.
    direction : float
        Of the lines, from the world's x towards y [rad].
    margin : float
        Kept from every edge [m].
    
    Returns
    -------
    (K, 6) array
        Aims in the world frame: hand them on with ``frame="world"`` where `world_from_vehicle` is given.
    
    Raises
    ------
    ValueError
        For fewer than three corners, no area, or edges that meet each other.
    
    Examples
    --------
    >>> import bathyal
    >>> square = [[0, 0], [4, 0], [4, 2], [0, 2]]
    >>> aims = bathyal.cover_polygon(bathyal.Plane((0, 0, 1), -5.0), square, spacing=1.0)
    >>> aims[:, :3].tolist()
    [[0.0, 0.5, -4.0], [4.0, 0.5, -4.0], [4.0, 1.5, -4.0], [0.0, 1.5, -4.0]]
    """
def dead_reckon(time: numpy.typing.ArrayLike, attitude: numpy.typing.ArrayLike, velocity: numpy.typing.ArrayLike) -> numpy.ndarray:
    """
    Positions from attitudes and velocities alone.
    
    Velocities turned into the world are integrated by the trapezoidal rule.
    
    Parameters
    ----------
    time : (N,) array
        Rising [s].
    attitude : (N,) or (N, 3) array
        Yaw, or roll, pitch, yaw [rad]: yaw counterclockwise from the world's x, pitch positive bow
        down.
    velocity : (N, 3) array
        In the vehicle: forward, to port, up [m/s].
    
    Returns
    -------
    (N, 3) array
        In the world, from 0 at the first time on [m].
    
    Raises
    ------
    ValueError
        For times that do not rise, other counts of rows, or numbers that are not finite.
    
    Examples
    --------
    A heading 1° off costs 17.45 m a kilometre:
    
    >>> import bathyal, numpy as np
    >>> ahead = [[1.0, 0.0, 0.0]] * 2
    >>> bathyal.dead_reckon([0.0, 1000.0], np.radians([1.0, 1.0]), ahead)[1].round(2).tolist()
    [999.85, 17.45, 0.0]
    """
def depth_from_pressure(pressure: numpy.typing.ArrayLike, latitude: numpy.typing.ArrayLike = 45.0) -> float | numpy.ndarray:
    """
    Depth [m] at a pressure.
    
    TEOS-10's formula (Roquet and others 2015), what ``gsw.z_from_p`` gives: of the standard ocean,
    salinity 35 at 0 °C.
    
    Parameters
    ----------
    pressure : float or array
        Above the atmosphere's [dbar].
    latitude : float or array
        [deg]
    
    Returns
    -------
    float or array
        [m]
    
    Examples
    --------
    >>> import bathyal
    >>> round(bathyal.depth_from_pressure(1000.0, latitude=45), 2)
    989.5
    """
def diagnose(arm: Arm, data: Touches | Tracked, *, effects: collections.abc.Iterable[Effect] | None = None, parametrization: str = 'hayati', fixed: collections.abc.Sequence[str] = [], length_prior: typing.SupportsFloat | typing.SupportsIndex | None = None, blocks: typing.SupportsInt | typing.SupportsIndex = 10, groups: numpy.typing.ArrayLike | None = None, nested: typing.SupportsInt | typing.SupportsIndex = 0, rival_odds: typing.SupportsFloat | typing.SupportsIndex = 0.1, leftover: typing.SupportsFloat | typing.SupportsIndex = 0.03, num_next_poses: typing.SupportsInt | typing.SupportsIndex = 8, progress: collections.abc.Callable[[float, str], None] | None = None, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> Diagnosis:
    """
    Find what the best rigid model of an arm gets wrong, name the cause, measure the gain.
    
    The arm's geometry is identified first. Effects of the library are selected to explain its
    residuals, alone and in growing sets, fitted jointly with the geometry; sets are compared by their
    likelihood less a complexity penalty, and each effect must improve the prediction of held-out data.
    Structure that nothing in the library explains is reported as such, without a name.
    
    Parameters
    ----------
    arm : Arm
        Nominal; its masses, where they are given, make loads of gravity known.
    data : Touches or Tracked
        With any of the covariates `temperature` (N,) [°C], `time` (N,) [s], `payload` (N,) [kg at the
        tool centre point], `direction` (N, n) -1, 0 or 1, `gravity` (N, 3) [m/s², base frame] and
        `session` (N,); others are tested for structure. One that is missing (nan) in some rows is
        not used, and a warning says so. Rows that duplicate another to the last digit count once.
    effects : list of Effect, optional
        What may be selected; `bathyal.effects.list()` unless given.
    parametrization : {"hayati", "dh"}
        Of the geometry, as in `identify_arm`.
    fixed : list of str
        Names of geometric parameters to hold at nominal.
    length_prior : float, optional
        The maker's tolerance: standard deviation of every a and d about nominal [m], as of
        `identify_arm`. None: no prior.
    blocks : int
        Number of folds of the cross-validation, 3 to 50.
    groups : (N,) array of int or str, optional
        The group of each row, 2 groups or more: a placement of the arm, a day, a region. Whole groups
        are then held out in turn instead of `blocks`, in which effects must prove themselves and the
        held-out errors are measured. More than 50 groups are joined to 50 folds. A base or tool that
        only one group has cannot be predicted from others: it stays as fitted to all rows.
    nested : int
        Folds of a nested cross-validation, 2 to 50 (of `groups`, where given, as many as there are), or
        0. The whole diagnosis is made anew without each: names, orders and sizes. `held_out.nested` has
        the errors. It takes as long as so many diagnoses. Of tracked poses only.
    rival_odds : float
        Odds of an alternative against the best explanation from which the verdict is "ambiguous".
    leftover : float
        Unexplained structure, as a share of the variance that the effects explain, from which the
        verdict is "unknown" and the effects are partial.
    num_next_poses : int
        How many poses to propose where the verdict is "ambiguous".
    progress : callable, optional
        Called with (share done, what comes next), often within a stage; what it raises ends the run.
    num_threads : int
        0 = all; the same bytes for any number.
    
    Returns
    -------
    Diagnosis
    
    Raises
    ------
    ValueError
        For bad data, covariates or options, another number of joints, an effect given twice, one of
        the user's own that gives another shape, numbers that are not finite, or others when asked again.
    bathyal.Error
        For an effect of the user's own that raises.
    
    Examples
    --------
    >>> import numpy as np
    >>> import bathyal
    >>> arm = bathyal.arms.ur10()
    >>> random = np.random.default_rng(1)
    >>> q = random.uniform(-1.5, 1.5, (150, 6))
    >>> wrong = q.copy()
    >>> wrong[:, 1] += 1e-3 * np.cos(2.0 * q[:, 1])  # an eccentric encoder
    >>> seen = arm.forward(wrong)[:, :3, 3] + random.normal(0.0, 1e-4, (150, 3))
    >>> report = bathyal.diagnose(arm, bathyal.Tracked(q, seen))
    >>> report
    Diagnosis(named, joint_harmonic[1])
    >>> round(float(report.effects[0].parameters["order"]))
    2
    """
def eigenrays(water: Water | Profile, from_depth: typing.SupportsFloat | typing.SupportsIndex, to_depth: typing.SupportsFloat | typing.SupportsIndex, distance: typing.SupportsFloat | typing.SupportsIndex, *, angles: typing.SupportsInt | typing.SupportsIndex = 2000, steepest: typing.SupportsFloat | typing.SupportsIndex = 1.5, surface_reflects: bool = False, time: typing.SupportsFloat | typing.SupportsIndex = 0.0) -> list[Eigenray]:
    """
    All ways of sound from a depth to another at a distance.
    
    By a fan of launch angles, and bisection between those that pass the point on different sides.
    
    Parameters
    ----------
    water : Water or Profile
    from_depth, to_depth : float
        [m]
    distance : float
        Horizontal [m].
    angles : int
        Of the fan: two ways closer than its spacing may be missed.
    steepest : float
        Of the fan [rad]; the straight line to the point is always within it.
    surface_reflects : bool
    time : float
        Of the water [s].
    
    Returns
    -------
    list of Eigenray
        The quickest first; empty in a shadow.
    """
def ellipsoid_added_mass(half_axes: numpy.typing.ArrayLike, water_density: typing.SupportsFloat | typing.SupportsIndex = 1025.0) -> numpy.ndarray:
    """
    Added mass of an ellipsoid about its centre.
    
    Parameters
    ----------
    half_axes : (3,) array
        Along x, y, z [m].
    water_density : float
        [kg/m³]
    
    Returns
    -------
    (6, 6) array
        [kg, kg m²] (Lamb, Hydrodynamics, art. 114, 115)
    
    Raises
    ------
    ValueError
        For a half axis that is not above 0.
    """
def find_effect_with(find: collections.abc.Callable) -> None:
    """
    Hand in what finds an effect by its name.
    """
def find_sheets(cloud: PointCloud | numpy.typing.ArrayLike, *, min_separation: typing.SupportsFloat | typing.SupportsIndex = 0.0, min_points: typing.SupportsInt | typing.SupportsIndex = 12, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> SheetReport:
    """
    Find where a cloud is not a height field: overhangs, arches, undersides.
    
    Survey passes that disagree in height by clearly more than their noise are found as well. Steep
    and stepped ground, noise and spikes are not: a place counts when its soundings lie on two planes,
    well apart for their scatter, and the two groups are interleaved in plan.
    
    Parameters
    ----------
    cloud : PointCloud or (N, 3) array
        [m], z up.
    min_separation : float
        Vertical distance from which two sheets count [m]; 0 takes the larger of 6 × noise and
        1 × spacing, both measured from the cloud.
    min_points : int
        Soundings that a place needs on each of its sheets.
    num_threads : int
        0 = all. The same report for any.
    
    Returns
    -------
    SheetReport
    
    Examples
    --------
    >>> import bathyal, numpy as np
    >>> x, y = np.mgrid[0:20, 0:20] * 0.1
    >>> ground = np.c_[x.ravel(), y.ravel(), np.zeros(400)]
    >>> bool(bathyal.find_sheets(ground))
    False
    >>> roof = ground[ground[:, 0] < 1] + [0.05, 0.05, 0.8]
    >>> report = bathyal.find_sheets(np.r_[ground, roof])
    >>> len(report.patches), round(report.patches[0].separation, 3)
    (1, 0.8)
    """
def find_targets(surface: Scene | Plane, aims: numpy.typing.ArrayLike, *, world_from_vehicle: numpy.typing.ArrayLike | None = None, frame: str = 'vehicle', vertical: str = 'gravity', grazing_angle: typing.SupportsFloat | typing.SupportsIndex = 1.3962634015954636, max_range: typing.SupportsFloat | typing.SupportsIndex = ..., num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> Targets:
    """
    Where camera axes meet the bottom.
    
    On a plane by eq 2–3 with t ≥ 0, on meshes the nearest hit at t ≥ 0 (eq 4–9). Normals point out of
    the bottom: on a mesh to the side its triangles are wound for, on a plane to the side of up.
    
    Parameters
    ----------
    surface : Scene or Plane
    aims : (K, 6) array
        px py pz, a point of each axis [m], and dx dy dz, its direction of any length but zero.
    world_from_vehicle : (4, 4) array, optional
        Pose of the vehicle, identity unless given.
    frame : {"vehicle", "world"}
        Frame of the aims: the vehicle's (`world_from_vehicle` moves them) or the world's.
    vertical : {"gravity", "vehicle"}
        The world's z or the vehicle's; for a plane it decides which side is out of the bottom.
    grazing_angle : float
        Incidence above which a hit is "grazing" [rad].
    max_range : float
        Hits beyond it are misses [m].
    num_threads : int
        0 = all.
    
    Returns
    -------
    Targets
    
    Raises
    ------
    ValueError
        For aims that are not finite or have no direction.
    
    Notes
    -----
    Status: "hit"; "grazing", a hit with its point beyond `grazing_angle`; "parallel", the axis runs
    along the plane; "behind", the bottom is met at t < 0 only; "hole", the axis passes between the open
    ends of the bottom on its two sides; "miss", anything else.
    
    References
    ----------
    Filaretov, Konoplin, Konoplin (2018), eq 1–9.
    
    Examples
    --------
    >>> import bathyal
    >>> targets = bathyal.find_targets(bathyal.Plane((0, 0, 1), -5.0), [[0, 0, 0, 3, 0, -4]])
    >>> targets.point[0].tolist(), float(targets.range[0]), str(targets.status[0])
    ([3.75, 0.0, -5.0], 6.25, 'hit')
    """
def fish_paths(scene: Scene, count: typing.SupportsInt | typing.SupportsIndex, duration: typing.SupportsFloat | typing.SupportsIndex, *, seed: typing.SupportsInt | typing.SupportsIndex = 0, region: numpy.typing.ArrayLike | None = None, clearance: typing.SupportsFloat | typing.SupportsIndex = 0.5, altitude: typing.SupportsFloat | typing.SupportsIndex = 4.0, ceiling: typing.SupportsFloat | typing.SupportsIndex = ..., speed: typing.SupportsFloat | typing.SupportsIndex = 0.6, turn_rate: typing.SupportsFloat | typing.SupportsIndex = 0.4, step: typing.SupportsFloat | typing.SupportsIndex = 0.25, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> list[Trajectory]:
    """
    Random smooth paths over a terrain, for fish or what drifts.
    
    Each path, straight between its poses as a Trajectory is, is checked against the scene. The same
    bytes for any number of threads; more fish leave the first ones' paths alone.
    
    Parameters
    ----------
    scene : Scene
    count : int
    duration : float
        [s]
    seed : int
    region : (2, 2) array, optional
        Low and high corner of the place in which they swim, seen from above [m]; else the scene's box.
    clearance : float
        No path comes nearer to the scene [m].
    altitude : float
        Up to so much higher than that they swim [m].
    ceiling : float
        z below which they stay [m].
    speed : float
        Horizontal [m/s].
    turn_rate : float
        Typical rate at which they change course [rad/s].
    step : float
        Between two poses [s].
    num_threads : int
        0: all.
    
    Returns
    -------
    list of Trajectory
        world_from_fish: x ahead, back up.
    
    Raises
    ------
    ValueError
        For an option out of its range, and where no path was found: a region too small to turn in, a
        ceiling too low.
    
    Examples
    --------
    >>> import bathyal
    >>> bottom = bathyal.Scene(bathyal.make_seabed(40, 0.5))
    >>> bathyal.fish_paths(bottom, 2, 60.0, seed=1)[0]
    Trajectory(241 poses, 0 to 60 s)
    """
def fit_plane(cloud: PointCloud | numpy.typing.ArrayLike, *, tolerance: typing.SupportsFloat | typing.SupportsIndex = 0.05, patch_points: typing.SupportsInt | typing.SupportsIndex = 50, flat_share: typing.SupportsFloat | typing.SupportsIndex = 0.99, trials: typing.SupportsInt | typing.SupportsIndex = 500, seed: typing.SupportsInt | typing.SupportsIndex = 1, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> PlaneFit:
    """
    Fit a plane to a bottom, undisturbed by gross errors in up to 45 % of the points.
    
    Least median of squares over random triples, then total least squares over the points within three
    sigma (Filaretov, Konoplin, Konoplin 2018, eq 1; Rousseeuw 1984). A vertical plane has no up: the
    first component of its normal that is not zero is positive.
    
    Parameters
    ----------
    cloud : PointCloud or (N, 3) array
        [m]
    tolerance : float
        How far the ground may lie off the plane and still count as flat [m].
    patch_points : int
        Soundings in a patch; the median of a patch is the ground's height there, so that neither noise
        nor single spikes count as relief.
    flat_share : float
        Share of the patches that must lie within `tolerance`.
    trials, seed : int
        Random triples tried (10⁶ at most), and the seed of their choice.
    num_threads : int
        0 = all. The same result for any.
    
    Returns
    -------
    PlaneFit
        ``.plane .normal .offset .rms .inliers .flat .relief …``; unpacks as ``plane, rms``.
    
    Raises
    ------
    ValueError
        For fewer than three distinct points, points on one line, or coordinates that are not finite.
    
    Examples
    --------
    >>> import bathyal
    >>> fit = bathyal.fit_plane([[0, 0, -5], [1, 0, -5], [0, 1, -5], [1, 1, -5]])
    >>> fit.plane
    Plane(normal=(0, 0, 1), offset=-5)
    >>> fit.flat
    True
    """
def fit_thruster(table: ThrusterTable, nominal_voltage: typing.SupportsFloat | typing.SupportsIndex = 16.0) -> ThrusterFit:
    """
    Fits a thruster's law to a table by least squares.
    
    Thrust against n², power against its third and fourth power, and in logarithms the speed against
    the voltage and the command past the dead zone; rows without thrust do not count.
    
    Parameters
    ----------
    table : ThrusterTable
    nominal_voltage : float
        Of the law [V].
    
    Raises
    ------
    ValueError
        For a table without thrust ahead or astern.
    """
def follow_bottom(position: numpy.typing.ArrayLike, heading: typing.SupportsFloat | typing.SupportsIndex, bottom: collections.abc.Callable[[float, float], typing.SupportsFloat | typing.SupportsIndex], *, altitude: typing.SupportsFloat | typing.SupportsIndex = 3.0, lookahead: typing.SupportsFloat | typing.SupportsIndex = 25.0, lead: typing.SupportsFloat | typing.SupportsIndex = 3.0, steepest: typing.SupportsFloat | typing.SupportsIndex = 0.25, spacing: typing.SupportsFloat | typing.SupportsIndex = 0.5) -> tuple[float, float]:
    """
    The path to steer to keep a distance to an uneven bottom.
    
    The lowest path that is nowhere nearer to the bottom, measured upwards, than `altitude` and nowhere
    climbs or falls more than `steepest`, over the bottom ahead and as far behind.
    
    Parameters
    ----------
    position : (3,) array
        In the world [m].
    heading : float
        The way over ground, about z from x [rad].
    bottom : callable
        Height of the bottom at (x, y) [m], as a chart or a sonar that looks ahead gives it.
    altitude : float
        [m]
    lookahead : float
        How far ahead the bottom is known [m].
    lead : float
        Steers for the path so far ahead, for the vehicle's own lag [m].
    steepest : float
        Height over way.
    spacing : float
        Of the samples [m].
    
    Returns
    -------
    z : float
        [m]
    climb : float
        Of the path there.
    
    Examples
    --------
    >>> import bathyal
    >>> bathyal.follow_bottom([0, 0, -20], 0.0, lambda x, y: -25.0)
    (-22.0, 0.0)
    """
def forecast_touches(arm: Arm, touches: Touches, *, parametrization: str = 'hayati', nearly_parallel: typing.SupportsFloat | typing.SupportsIndex = 0.1, noise: typing.SupportsFloat | typing.SupportsIndex = 0.0001, length_prior: typing.SupportsFloat | typing.SupportsIndex = 0.001, angle_prior: typing.SupportsFloat | typing.SupportsIndex = 0.002, tool_prior: typing.SupportsFloat | typing.SupportsIndex = 0.01, workspace: numpy.typing.ArrayLike | None = None, workspace_poses: typing.SupportsInt | typing.SupportsIndex = 400, seed: typing.SupportsInt | typing.SupportsIndex = 0, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> TouchForecast:
    """
    Predict the accuracy of an arm that is identified from these touches.
    
    To first order at the nominal arm, with the covariance that `identify_arm` will report with these
    priors. Gauge freedom (what base and tool can represent) does not count; the scale of the arm
    counts.
    
    Parameters
    ----------
    arm : Arm
        Nominal, with its tool given to a centimetre or so.
    touches : Touches
        Made, or to be made, with the distances and points that are known. Poses that scatter about
        their point are first moved onto it.
    parametrization : {"hayati", "dh"}
        As of `identify_arm`.
    nearly_parallel : float
        Sine between neighbouring axes below which beta takes the place of d.
    noise : float
        Standard deviation of one touch, per axis [m].
    length_prior, angle_prior : float
        The maker's tolerances: standard deviation of every a and d [m], and of every theta, alpha and
        beta [rad]. They determine what touches do not.
    tool_prior : float
        Accuracy of the given tool: standard deviation of each coordinate of its tip [m].
    workspace : (S, n) array, optional
        Poses in which the arm must be accurate [rad] or [m]. Drawn at random within the limits unless
        given.
    workspace_poses : int
        How many are drawn.
    seed : int
        Of what is drawn.
    num_threads : int
        0 for all. The same bytes for any number.
    
    Returns
    -------
    TouchForecast
        ``.worst_tip_std``, ``.median_tip_std`` [m], ``.tip_std`` (S,), ``.rank`` of ``.free``
        parameters, ``.singular_values``, ``.unseen`` directions, ``.o1``, ``.log_det``.
    
    Raises
    ------
    ValueError
        For another number of joints, several tools or stations, touched planes, options out of range.
    
    Examples
    --------
    >>> import bathyal, numpy as np
    >>> arm = bathyal.arms.ur10e()
    >>> touches = bathyal.Touches(np.random.default_rng(1).uniform(-1, 1, (8, 6)), [0] * 8)
    >>> forecast = bathyal.forecast_touches(arm, touches)
    >>> forecast.rank <= forecast.free < forecast.parameters
    True
    """
def generate_survey(*, seed: typing.SupportsInt | typing.SupportsIndex = 0, origin: numpy.typing.ArrayLike = (431200.0, 6172650.0, -38.0), length: typing.SupportsFloat | typing.SupportsIndex = 60.0, width: typing.SupportsFloat | typing.SupportsIndex = 40.0, wave_height: typing.SupportsFloat | typing.SupportsIndex = 0.5, wave_length: typing.SupportsFloat | typing.SupportsIndex = 9.0, ripple_height: typing.SupportsFloat | typing.SupportsIndex = 0.04, roughness: typing.SupportsFloat | typing.SupportsIndex = 0.15, boulders: typing.SupportsInt | typing.SupportsIndex = 30, boulder_radius: typing.SupportsFloat | typing.SupportsIndex = 1.3, trench_depth: typing.SupportsFloat | typing.SupportsIndex = 1.1, trench_width: typing.SupportsFloat | typing.SupportsIndex = 3.5, lines: typing.SupportsInt | typing.SupportsIndex = 2, altitude: typing.SupportsFloat | typing.SupportsIndex = 8.0, opening: typing.SupportsFloat | typing.SupportsIndex = 2.0943951, beams: typing.SupportsInt | typing.SupportsIndex = 256, ping_spacing: typing.SupportsFloat | typing.SupportsIndex = 0.12, lost_width: typing.SupportsFloat | typing.SupportsIndex = 2.0, range_noise: typing.SupportsFloat | typing.SupportsIndex = 0.006, range_noise_rate: typing.SupportsFloat | typing.SupportsIndex = 0.0008, angle_noise: typing.SupportsFloat | typing.SupportsIndex = 0.0006, spike_fraction: typing.SupportsFloat | typing.SupportsIndex = 0.0, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> PointCloud:
    """
    A simulated multibeam survey over a bottom that is known exactly.
    
    Sand waves with ripples, boulders with scour and shadow, a trench, a stripe of lost pings, noise that
    grows with range, and the uneven spacing of beams at equal angles. The same seed and options give the
    same numbers, for any number of threads. `survey_height` gives the true height.
    
    Parameters
    ----------
    seed : int
    origin : (3,) array
        South-west corner and the bottom's mean height [m].
    length, width : float
        Along (x) and across (y) the survey lines [m].
    wave_height, wave_length : float
        Sand waves, trough to crest and crest to crest [m].
    ripple_height, roughness : float
        Ripples, trough to crest, and the rms of a slow undulation [m].
    boulders : int
    boulder_radius : float
        Of the largest [m].
    trench_depth, trench_width : float
        [m]; a depth of 0 for none.
    lines, beams : int
        Survey lines over the width, and beams a ping.
    altitude : float
        Of the sounder above the mean height [m]. Heights and depths of 20 km at most.
    opening : float
        Of the fan of beams [rad].
    ping_spacing : float
        Along the line [m].
    lost_width : float
        Length of the stripe of pings that the first line lost [m].
    range_noise, range_noise_rate, angle_noise : float
        Standard deviation of a range, constant part [m] and growth [m/m], and of a beam's angle [rad].
    spike_fraction : float
        Of soundings that are echoes from fish above the bottom, 0 to 1.
    num_threads : int
        0: all.
    
    Returns
    -------
    PointCloud
        With the attributes ``uncertainty``, the standard deviation of z [m], and ``intensity`` [dB].
    
    Raises
    ------
    ValueError
        An option out of its range, or a sounder that would touch the bottom.
    
    Examples
    --------
    >>> import bathyal
    >>> cloud = bathyal.generate_survey(seed=1, length=6.0, beams=64)
    >>> cloud
    PointCloud(5504 points)
    >>> sorted(cloud.attributes)
    ['intensity', 'uncertainty']
    """
def identify_arm(arm: Arm | CorrectedArm, data: Touches | Tracked, *, parametrization: str = 'hayati', nearly_parallel: typing.SupportsFloat | typing.SupportsIndex = 0.1, criterion: str = 'centroid', pair_weights: bool = False, solver: str = 'levenberg_marquardt', max_iterations: typing.SupportsInt | typing.SupportsIndex = 100, tool_start: str = 'auto', base: str = 'auto', fixed: collections.abc.Sequence[str] = [], length_prior: typing.SupportsFloat | typing.SupportsIndex | None = None, angle_prior: typing.SupportsFloat | typing.SupportsIndex | None = None, priors: collections.abc.Mapping[str, typing.SupportsFloat | typing.SupportsIndex] = {}, size_prior: typing.SupportsFloat | typing.SupportsIndex = 0.001, noise: typing.SupportsFloat | typing.SupportsIndex | None = None, rotation_noise: typing.SupportsFloat | typing.SupportsIndex | None = None, loss: str = 'square', loss_width: typing.SupportsFloat | typing.SupportsIndex | None = None, prune_sigma: typing.SupportsFloat | typing.SupportsIndex | None = None, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> ArmFit:
    """
    Estimate the geometry of an arm from measured poses.
    
    After Yukhimets, Gubankov (2023). Unknown are each moving joint's row, the tool and, for tracked
    poses, the base; what the data do not determine stays at nominal, and is reported.
    
    Parameters
    ----------
    arm : Arm or CorrectedArm
        Nominal. Its tool, where it has one, is where the search for the tool starts. The effects of a
        corrected arm keep their values, each in the rows within its support, and are reported as
        "fixed" parameters; the arm of the fit is the rigid part.
    data : Touches or Tracked
    parametrization : {"hayati", "dh"}
        "hayati": beta (Hayati, Mirmirani 1985) in place of d where the next axis is nearly parallel.
        "dh": theta, d, a, alpha in every row, as the paper.
    nearly_parallel : float
        Axes whose directions have a smaller sine are nearly parallel.
    criterion : {"centroid", "pairs"}
        Each touch against the mean of its point, or every pair of a point's touches (the paper's eq
        7-9). They have the same minimum when every point has as many touches, or with `pair_weights`.
    pair_weights : bool
        Weigh a point by the number of its touches, as "pairs" always does.
    solver : {"levenberg_marquardt", "paper"}
        Ceres' TinySolver, or the paper's eq 17 with its sign mended. They reach the same cost.
    max_iterations : int
    tool_start : {"auto", "arm", "estimate"}
        Start from the arm's tool, or estimate it (eq 12-16). "auto": the arm's where it has one.
    base : {"auto", "free", "fixed"}
        "auto": free for tracked poses, fixed for touches.
    fixed : list of str
        Names of parameters to hold at nominal.
    length_prior, angle_prior : float
        The maker's tolerance: standard deviation of every a and d [m], of every theta, alpha and beta
        [rad], about nominal. None: no prior.
    priors : dict
        {name: std} for single parameters, in their unit.
    size_prior : float
        The length prior where the data do not determine the scale (touches without a known distance or
        point) and none is given [m].
    noise, rotation_noise : float
        Standard deviation of a touch or a position per axis [m], and of a rotation [rad]. None: from
        the residuals.
    loss : {"square", "huber", "cauchy"}
        The last two bound the influence of outliers.
    loss_width : float
        Distance from which they do [m]. None: 3 times the robust standard deviation.
    prune_sigma : float
        Reset parameters within so many standard deviations of nominal, the least significant first.
    num_threads : int
        0 = all. The same result for any.
    
    Returns
    -------
    ArmFit
        ``.arm .parameters .rms_before .rms_after .rank .std .covariance .scale_source .warnings …``
    
    Raises
    ------
    ValueError
        For another number of joints than the arm's, bad options, names that no parameter has.
    
    Notes
    -----
    Rank and covariance come from QR and singular values of the Jacobian with its columns in mm and
    mrad; singular values below 1e-7 of the largest count as zero. Noise is estimated with 3 Σ(m_i − 1)
    − rank degrees of freedom.
    
    Least squares underestimates the scale of the arm, because touches scatter less on a smaller one: by
    (degrees of freedom) · (relative std of the scale)². Where known distances or points, or a prismatic
    joint, determine the scale, this bias is removed (by the derivatives of consistent touches instead
    of scattered ones). Where only a prior determines it, the criterion of the paper is used unchanged:
    read ``scale_source``, and do not rely on a small rms.
    
    Examples
    --------
    >>> import bathyal, numpy as np
    >>> arm = bathyal.Arm.from_dh(a=[0.5, 0.4], alpha=[0, 0], d=[0, 0], theta=[0, 0])
    >>> q = np.random.default_rng(1).uniform(-2, 2, (40, 2))
    >>> true = bathyal.Arm.from_dh(a=[0.502, 0.4], alpha=[0, 0], d=[0, 0], theta=[0, 0.003])
    >>> fit = bathyal.identify_arm(arm, bathyal.Tracked(q, true.forward(q)[:, :3, 3]))
    >>> a_1 = next(p for p in fit.parameters if p.name == "a_1")
    >>> round(a_1.value, 6), a_1.status
    (0.502, 'identified')
    """
def intersect_moller_trumbore(mesh: TriangleMesh, origins: numpy.typing.ArrayLike, directions: numpy.typing.ArrayLike, *, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> Hits:
    """
    Every ray against every triangle, as the paper does it.
    
    Filaretov, Konoplin, Konoplin (2018), eq 5–9, after Möller and Trumbore (1997), with what the
    printed form leaves out: t ≥ 0 and the nearest hit. For study and comparison: it costs rays ×
    triangles, and unlike Scene.cast it may let a ray slip between triangles that share an edge.
    
    Parameters
    ----------
    mesh : TriangleMesh
    origins, directions
        As in Scene.cast.
    num_threads : int
        0 means all.
    
    Returns
    -------
    Hits
    
    Examples
    --------
    >>> import bathyal
    >>> floor = bathyal.TriangleMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
    >>> bathyal.intersect_moller_trumbore(floor, (1, 1, 3), [[0, 0, -1], [0, 0, 1]]).range
    array([ 3., inf])
    """
def library_effects() -> list[Effect]:
    """
    The effects of the library, in a fixed order (bathyal.effects.list).
    """
def make_boulder(radius: typing.SupportsFloat | typing.SupportsIndex, *, seed: typing.SupportsInt | typing.SupportsIndex = 0, roughness: typing.SupportsFloat | typing.SupportsIndex = 0.04, subdivisions: typing.SupportsInt | typing.SupportsIndex = 3) -> TriangleMesh:
    """
    An angular boulder, at rest on z = 0.
    
    Parameters
    ----------
    radius : float
        Of the sphere of the same volume [m].
    seed : int
    roughness : float
        Of its faces, over the radius, 0 to 0.2.
    subdivisions : int
        20 · 4ⁿ triangles, 1 to 6.
    
    Returns
    -------
    TriangleMesh
        Closed, its middle over the origin.
    
    Examples
    --------
    >>> import bathyal
    >>> bathyal.mesh_report(bathyal.make_boulder(0.5, seed=2)).closed
    True
    """
def make_cable(route: numpy.typing.ArrayLike, diameter: typing.SupportsFloat | typing.SupportsIndex, terrain: Scene | None = None, *, burial: numpy.typing.ArrayLike = 0.0, sag: typing.SupportsFloat | typing.SupportsIndex = 10.0, slack: typing.SupportsFloat | typing.SupportsIndex = 0.0, slack_wavelength: typing.SupportsFloat | typing.SupportsIndex = 20.0, seed: typing.SupportsInt | typing.SupportsIndex = 0, step: typing.SupportsFloat | typing.SupportsIndex = 0.25, sides: typing.SupportsInt | typing.SupportsIndex = 8, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> Pipeline:
    """
    A cable along a smooth curve through a route.
    
    It lies as a pipeline does, but thin and heavy for its tension: over hollows it hangs in catenaries,
    for small slopes z'' = 1/sag.
    
    Parameters
    ----------
    route : (K, 2) or (K, 3) array
        On a terrain places seen from above, else the middle line itself [m].
    diameter : float
        [m]
    terrain : Scene, optional
        What it lies on: its uppermost surface.
    burial : float or (K,) array
        How far the underside lies below the bottom [m].
    sag : float
        Parameter of its catenaries: horizontal tension over its weight in water a metre [m].
    slack : float
        How much longer it is than the route, as a share, 0 to 0.3, in bends to both sides.
    slack_wavelength : float
        Of these bends [m].
    seed : int
        Of where they begin.
    step : float
        Between two rings of the mesh [m].
    sides : int
        Of the cross-section.
    num_threads : int
        0: all.
    
    Returns
    -------
    Pipeline
        Stations along the line with its slack.
    
    Examples
    --------
    >>> import bathyal
    >>> bathyal.make_cable([(0, 0, -5), (30, 0, -5)], 0.05)
    Pipeline(121 stations, 30 m)
    """
def make_fish(length: typing.SupportsFloat | typing.SupportsIndex, *, sides: typing.SupportsInt | typing.SupportsIndex = 12) -> TriangleMesh:
    """
    A fish, nose to +x, back up, its middle at the origin.
    
    Parameters
    ----------
    length : float
        [m]
    sides : int
        Of its cross-section.
    
    Returns
    -------
    TriangleMesh
        Body and fins, each closed.
    
    Examples
    --------
    >>> import bathyal
    >>> bathyal.make_fish(0.4)
    TriangleMesh(144 vertices, 276 triangles)
    """
def make_mine(kind: str = 'cylinder', *, diameter: typing.SupportsFloat | typing.SupportsIndex | None = None, length: typing.SupportsFloat | typing.SupportsIndex | None = None, horns: typing.SupportsInt | typing.SupportsIndex = 9, sides: typing.SupportsInt | typing.SupportsIndex = 32) -> TriangleMesh:
    """
    A mine, at rest on z = 0, its middle over the origin.
    
    Parameters
    ----------
    kind : str
        "cylinder", lying along x, "sphere", with horns on its upper half, or "manta", a truncated cone
        whose top has half the diameter of its foot.
    diameter : float, optional
        [m]; 0.53, 1.0 or 0.98 by kind.
    length : float, optional
        Of the cylinder, 2.2, or height of the manta, 0.47 [m].
    horns : int
        Of the sphere.
    sides : int
        Of a circle, even.
    
    Returns
    -------
    TriangleMesh
        Closed; horns are closed bodies that begin inside the sphere.
    
    Examples
    --------
    >>> import bathyal
    >>> bathyal.make_mine("manta").vertices[:, 2].max()
    np.float64(0.47)
    """
def make_pipeline(route: numpy.typing.ArrayLike, diameter: typing.SupportsFloat | typing.SupportsIndex, terrain: Scene | None = None, *, burial: numpy.typing.ArrayLike = 0.0, spans: numpy.typing.ArrayLike | None = None, span_gap: typing.SupportsFloat | typing.SupportsIndex = 0.0, sag: typing.SupportsFloat | typing.SupportsIndex = 150.0, anode_spacing: typing.SupportsFloat | typing.SupportsIndex = 0.0, anode_length: typing.SupportsFloat | typing.SupportsIndex = 0.6, anode_thickness: typing.SupportsFloat | typing.SupportsIndex = 0.05, joint_spacing: typing.SupportsFloat | typing.SupportsIndex = 0.0, joint_length: typing.SupportsFloat | typing.SupportsIndex = 0.5, joint_recess: typing.SupportsFloat | typing.SupportsIndex = 0.04, step: typing.SupportsFloat | typing.SupportsIndex = 0.5, sides: typing.SupportsInt | typing.SupportsIndex = 24, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> Pipeline:
    """
    A pipeline along a smooth curve through a route.
    
    On a terrain it rests where it touches, five rays across it at each station, and sags between: least
    line over the bottom with z'' of at most 1/sag.
    
    Parameters
    ----------
    route : (K, 2) or (K, 3) array
        On a terrain places seen from above, else the middle line itself [m].
    diameter : float
        [m]
    terrain : Scene, optional
        What it lies on: its uppermost surface.
    burial : float or (K,) array
        How far the underside lies below the bottom [m]: 0 on it, the diameter flush. Of a value each
        point of the route, linear between; not within spans.
    spans : (S, 2) array
        Free spans, from and to along the route [m], rising: straight over what rises between the ends.
    span_gap : float
        How much higher than that the middle of a span is [m].
    sag : float
        Horizontal tension over its weight in water a metre [m]; inf bridges every hollow.
    anode_spacing, anode_length, anode_thickness : float
        Rings beyond the pipe's radius [m], a spacing of 0 for none.
    joint_spacing, joint_length, joint_recess : float
        Field joints below the pipe's radius [m], a spacing of 0 for none.
    step : float
        Between two rings of the mesh [m].
    sides : int
        Of the cross-section, its corners on the circle.
    num_threads : int
        0: all.
    
    Returns
    -------
    Pipeline
    
    Raises
    ------
    ValueError
        For a route of one point, two neighbours at one place, no terrain below, bends tighter than the
        radius (a route that crosses itself further on is not found), spans that overlap or leave the
        route.
    
    Examples
    --------
    >>> import bathyal
    >>> bottom = bathyal.Scene(bathyal.make_seabed(60, 0.5, relief_rms=0.0))
    >>> pipe = bathyal.make_pipeline([(-20, 0), (20, 0)], 0.4, bottom, burial=0.1, spans=[(10, 20)])
    >>> pipe
    Pipeline(81 stations, 40 m)
    >>> pipe.burial[[0, -1]].round(6)
    array([0.1, 0.1])
    """
def make_seabed(size: numpy.typing.ArrayLike, spacing: typing.SupportsFloat | typing.SupportsIndex, origin: numpy.typing.ArrayLike = (0.0, 0.0), *, seed: typing.SupportsInt | typing.SupportsIndex = 0, depth: typing.SupportsFloat | typing.SupportsIndex = 0.0, slope: typing.SupportsFloat | typing.SupportsIndex = 0.0, slope_direction: typing.SupportsFloat | typing.SupportsIndex = 0.0, relief_rms: typing.SupportsFloat | typing.SupportsIndex = 0.15, relief_exponent: typing.SupportsFloat | typing.SupportsIndex = 3.25, relief_longest: typing.SupportsFloat | typing.SupportsIndex = 50.0, relief_shortest: typing.SupportsFloat | typing.SupportsIndex = 0.5, ripple_height: typing.SupportsFloat | typing.SupportsIndex = 0.0, ripple_wavelength: typing.SupportsFloat | typing.SupportsIndex = 1.0, ripple_direction: typing.SupportsFloat | typing.SupportsIndex = 0.0, ripple_asymmetry: typing.SupportsFloat | typing.SupportsIndex = 0.2, ripple_meander: typing.SupportsFloat | typing.SupportsIndex = 0.15, ripple_defects: typing.SupportsFloat | typing.SupportsIndex = 0.2, ripple_cover: typing.SupportsFloat | typing.SupportsIndex = 1.0, ripple_patch: typing.SupportsFloat | typing.SupportsIndex = 30.0, boulder_density: typing.SupportsFloat | typing.SupportsIndex = 0.0, boulder_radius: typing.SupportsFloat | typing.SupportsIndex = 0.6, boulder_scour: typing.SupportsFloat | typing.SupportsIndex = 0.18, trench_depth: typing.SupportsFloat | typing.SupportsIndex = 0.0, trench_width: typing.SupportsFloat | typing.SupportsIndex = 4.0, trench_floor: typing.SupportsFloat | typing.SupportsIndex = 1.5, trench_direction: typing.SupportsFloat | typing.SupportsIndex = 0.0, trench_point: numpy.typing.ArrayLike = (0.0, 0.0), cliff_height: typing.SupportsFloat | typing.SupportsIndex = 0.0, cliff_run: typing.SupportsFloat | typing.SupportsIndex = 2.0, cliff_direction: typing.SupportsFloat | typing.SupportsIndex = 0.0, cliff_point: numpy.typing.ArrayLike = (0.0, 0.0), edge_meander: typing.SupportsFloat | typing.SupportsIndex = 0.0, scour_points: numpy.typing.ArrayLike | None = None, scour_depth: typing.SupportsFloat | typing.SupportsIndex = 0.4, scour_radius: typing.SupportsFloat | typing.SupportsIndex = 2.0, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> TriangleMesh:
    """
    A mesh of a generated bottom.
    
    As ``SeabedModel(seed=seed, …).mesh(size, spacing, origin=origin)``: see there for the options.
    
    Parameters
    ----------
    size : float or (2,) array
        Its sides along x and y [m].
    spacing : float
        Side of a square [m]: the largest that divides the mesh's side and is no larger.
    origin : (2,) array
        Its middle [m]: a large bottom is made tile by tile.
    seed : int
    relief_rms, ripple_height, boulder_density, trench_depth, cliff_height, … : float
        As given to SeabedModel.
    
    Returns
    -------
    TriangleMesh
        With an attribute ``material`` of the vertices: 0 silt, 1 sand, where ripples are, 2 rock.
    
    Examples
    --------
    >>> import bathyal
    >>> bathyal.make_seabed((40, 20), 0.25, seed=3, ripple_height=0.05)
    TriangleMesh(13041 vertices, 25600 triangles)
    """
def make_wreck(length: typing.SupportsFloat | typing.SupportsIndex, *, seed: typing.SupportsInt | typing.SupportsIndex = 0, beam: typing.SupportsFloat | typing.SupportsIndex = 9.0, depth: typing.SupportsFloat | typing.SupportsIndex = 5.0, thickness: typing.SupportsFloat | typing.SupportsIndex = 0.15, list: typing.SupportsFloat | typing.SupportsIndex = 0.3, broken: bool = True, holes: typing.SupportsInt | typing.SupportsIndex = 6, spacing: typing.SupportsFloat | typing.SupportsIndex = 0.5) -> TriangleMesh:
    """
    A sunken ship, bow to +x, at rest on z = 0.
    
    Plates with holes and torn edges, deck with hatches, bulkheads, superstructure, funnel and mast: each
    part is a closed body, and parts overlap.
    
    Parameters
    ----------
    length : float
        [m]
    seed : int
        Of holes, of where it broke and how the halves lie.
    beam, depth : float
        Breadth, and height from keel to deck [m].
    thickness : float
        Of plates [m].
    list : float
        By which it leans to starboard [rad].
    broken : bool
        In two, the bow turned away.
    holes : int
        In its sides.
    spacing : float
        Of its plates' triangles [m].
    
    Returns
    -------
    TriangleMesh
    
    Examples
    --------
    >>> import bathyal
    >>> bathyal.mesh_report(bathyal.make_wreck(40, seed=1)).closed
    True
    """
def make_xtf(amplitude: numpy.typing.ArrayLike, beam_names: collections.abc.Sequence[str], columns: dict[str, numpy.typing.ArrayLike], *, slant_range: typing.SupportsFloat | typing.SupportsIndex, frequency: typing.SupportsFloat | typing.SupportsIndex, geographic: bool = False, amplitude_step: typing.SupportsFloat | typing.SupportsIndex = 0.0, sonar_name: str = 'bathyal') -> XtfFile:
    """
    An XTF file of side-scan pings, 16 bits a sample; `columns` as `SidescanPings.column`, `amplitude_step` 0 finds one so that the largest amplitude has the highest step.
    """
def mcap_messages(content: bytes) -> list[tuple[str, bytes]]:
    """
    All messages of an MCAP file, in their order.
    
    Parameters
    ----------
    content : bytes
        Of the file; of one that breaks off, the whole messages.
    
    Returns
    -------
    list of tuples
        Topic and data.
    
    Raises
    ------
    Error
        For bytes that are no MCAP, or compressed ones.
    """
def mesh_report(mesh: TriangleMesh, *, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> MeshReport:
    """
    Measure a mesh: area, rims, pieces, defects, slopes, rugosity.
    
    The planar area is that of the mesh's shadow on the horizontal plane, every place counted once:
    exact where no two triangles lie over one another, else to a few parts in 10⁴. Published
    rugosities divide by other planar areas: compare with care.
    
    Parameters
    ----------
    mesh : TriangleMesh
    num_threads : int
        0 = all. The same numbers for any.
    
    Returns
    -------
    MeshReport
        Zeros for an empty mesh, NaN where there is nothing to divide.
    
    Examples
    --------
    >>> import bathyal
    >>> ramp = bathyal.TriangleMesh([[0, 0, 0], [1, 0, 1], [0, 1, 0]], [[0, 1, 2]])
    >>> report = bathyal.mesh_report(ramp)
    >>> round(report.rugosity, 6), report.inverted_triangles, len(report.boundary_loops)
    (1.414214, 0, 1)
    """
def nmea_dpt(depth: typing.SupportsFloat | typing.SupportsIndex) -> bytes:
    """
    A sentence DPT of a depth below the transducer [m].
    """
def nmea_hdt(heading: typing.SupportsFloat | typing.SupportsIndex) -> bytes:
    """
    A sentence HDT of a true heading [deg].
    """
def nmea_position(*, date: tuple[typing.SupportsInt | typing.SupportsIndex, typing.SupportsInt | typing.SupportsIndex, typing.SupportsInt | typing.SupportsIndex], time: typing.SupportsFloat | typing.SupportsIndex, latitude: typing.SupportsFloat | typing.SupportsIndex, longitude: typing.SupportsFloat | typing.SupportsIndex, altitude: typing.SupportsFloat | typing.SupportsIndex, speed: typing.SupportsFloat | typing.SupportsIndex, course: typing.SupportsFloat | typing.SupportsIndex, valid: bool) -> bytes:
    """
    Sentences GGA and RMC, five decimals of a minute (1.9 cm).
    
    Parameters
    ----------
    date : tuple of int
        Year, month, day.
    time : float
        UTC, of the day [s].
    latitude, longitude : float
        [deg]
    altitude : float
        [m]
    speed : float
        Over ground [m/s].
    course : float
        From north to east [deg].
    valid : bool
        False: all but the time is left out.
    
    Returns
    -------
    bytes
    
    Raises
    ------
    ValueError
        For numbers that are no position.
    """
def nmea_sentence(body: str) -> bytes:
    """
    A sentence of NMEA 0183, checksum and line end included.
    
    Parameters
    ----------
    body : str
        What lies between $ and \\*.
    
    Returns
    -------
    bytes
    
    Raises
    ------
    ValueError
        For an empty body, or one with other characters than printable ASCII without $ ! \\* \\\\ ^ ~.
    """
def nmea_vbw(ahead: typing.SupportsFloat | typing.SupportsIndex, port: typing.SupportsFloat | typing.SupportsIndex, valid: bool = True) -> bytes:
    """
    A sentence VBW: speeds over ground.
    
    Parameters
    ----------
    ahead, port : float
        [m/s]
    valid : bool
    
    Returns
    -------
    bytes
    
    Raises
    ------
    ValueError
        For numbers that are not finite.
    """
def parse_xtf(data: bytes) -> XtfFile:
    """
    Reads the bytes of an XTF file.
    
    Parameters
    ----------
    data : bytes
    
    Returns
    -------
    XtfFile
        All whole packets; what is broken is left out and counted.
    
    Raises
    ------
    bathyal.Error
        For what does not begin as an XTF file.
    """
def pd6_text(*, date: tuple[typing.SupportsInt | typing.SupportsIndex, typing.SupportsInt | typing.SupportsIndex, typing.SupportsInt | typing.SupportsIndex], time: typing.SupportsFloat | typing.SupportsIndex, heading: typing.SupportsFloat | typing.SupportsIndex, pitch: typing.SupportsFloat | typing.SupportsIndex, roll: typing.SupportsFloat | typing.SupportsIndex, depth: typing.SupportsFloat | typing.SupportsIndex, velocity: numpy.typing.ArrayLike, altitude: typing.SupportsFloat | typing.SupportsIndex | None = None, age: typing.SupportsFloat | typing.SupportsIndex = 0.0, valid: bool = True) -> bytes:
    """
    An ensemble of a Doppler log as PD6 text.
    
    Parameters
    ----------
    date : tuple of int
        Year, month, day.
    time : float
        UTC, of the day [s].
    heading : float
        From north to east [deg].
    pitch, roll : float
        Bow up, port up [deg].
    depth : float
        [m]
    velocity : (3,) array
        Of the vehicle over ground: ahead, to port, up [m/s].
    altitude : float, optional
        [m]
    age : float
        Since the last good velocity [s].
    valid : bool
        Of the velocity.
    
    Returns
    -------
    bytes
    
    Raises
    ------
    ValueError
        For numbers that do not fit.
    """
def plan_sampling(ws: Workspace, target: numpy.typing.ArrayLike, *, q_start: numpy.typing.ArrayLike | None = None, q_transport: numpy.typing.ArrayLike | None = None, tool: RigidBody | None = None, tool_capsules: collections.abc.Sequence[Capsule] = [], tool_pose: numpy.typing.ArrayLike | None = None, sample: RigidBody | None = None, sample_capsules: collections.abc.Sequence[Capsule] = [], direction: numpy.typing.ArrayLike | None = None, align: bool | None = None, tool_axis: numpy.typing.ArrayLike = (0.0, 0.0, 1.0), standoff: typing.SupportsFloat | typing.SupportsIndex = 0.1, depth: typing.SupportsFloat | typing.SupportsIndex = 0.02, stiffness: typing.SupportsFloat | typing.SupportsIndex = 5000.0, force_limit: typing.SupportsFloat | typing.SupportsIndex = 100.0, grab_time: typing.SupportsFloat | typing.SupportsIndex = 3.0, press_speed: typing.SupportsFloat | typing.SupportsIndex = 0.02, line_tolerance: typing.SupportsFloat | typing.SupportsIndex = 0.001, velocity: numpy.typing.ArrayLike | None = None, acceleration: numpy.typing.ArrayLike | None = None, jerk: numpy.typing.ArrayLike | None = None, step: typing.SupportsFloat | typing.SupportsIndex = 0.02, time: typing.SupportsFloat | typing.SupportsIndex = 0.0, max_checks: typing.SupportsInt | typing.SupportsIndex = 20000, seed: typing.SupportsInt | typing.SupportsIndex = 0, inertia: bool = False, gravity: numpy.typing.ArrayLike = (0.0, 0.0, -9.80665), water_density: typing.SupportsFloat | typing.SupportsIndex = 1025.0, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> SamplingPlan:
    """
    How to take a soil sample at a point: approach, press, grab, lift, transport.
    
    The sequence of Maevskiy, Zanin (2020), Modular control systems for manipulators and intervention-
    class AUVs. The contact is where the line through the target along `direction` first meets the scene
    within a standoff before and behind the target; without a scene the target itself. The tip
    approaches to the standoff before it as `Workspace.plan` does, presses straight on by
    ``min(depth, force_limit / stiffness)``, grabs, lifts straight back with the sample, and is carried
    to `q_transport` as `Workspace.plan` does. Press, grab and lift may touch the scene with the end of
    the tool (what of the last link lies within the depth and two radii of its tip), all else nowhere;
    straight ways are checked between the rows, too. The bottom pushes the
    tip back by stiffness times penetration while it presses, grabs and lifts. Every phase has a way
    back, checked with what is held then. The same seed gives the same bytes.
    
    Parameters
    ----------
    ws : Workspace
        Its vehicle at rest.
    target : (3,) array
        On the bottom, in the world [m].
    q_start : (n,) array, optional
        Where the arm starts. Unless given all coordinates at zero, or as near to it as limits allow;
        where that touches, the middle of the limits; else of 64 drawn postures that with the largest
        clearance.
    q_transport : (n,) array, optional
        In which the sample is carried; `q_start` unless given.
    tool : RigidBody, optional
        What the tool weighs, in the tool's frame; attached all the time.
    tool_capsules : list of Capsule
        Its shape, in the tool's frame.
    tool_pose : (4, 4) array, optional
        flange_from_tool in place of the arm's ``.tool``.
    sample : RigidBody, optional
        In the tool's frame; attached from the end of the grab on.
    sample_capsules : list of Capsule
        Its shape, in the tool's frame.
    direction : (3,) array, optional
        Into the bottom, in the world, of any length. Unless given against the bottom's normal (the mean
        of those within 5 cm of the target, turned upwards), and without a scene straight down.
    align : bool, optional
        Whether `tool_axis` points along the direction; unless given for arms of five coordinates or
        more.
    tool_axis : (3,) array
        In the tool's frame.
    standoff : float
        Of the tip before contact [m].
    depth : float
        That the tip is pressed into the bottom [m].
    stiffness, force_limit : float
        Of the bottom [N/m]; with which the tip is pressed at most [N].
    grab_time : float
        [s]
    press_speed : float
        Of the tip while it presses and lifts, at most [m/s].
    line_tolerance : float
        How far the tip may leave its straight line [m].
    velocity, acceleration, jerk : float or (n,) array, optional
        Limits of each coordinate, as of `Workspace.plan`.
    step : float
        Between rows, at most; longer where `press_speed` holds the tip back [s].
    time : float
        When the arm starts [s]; matters where something moves.
    max_checks : int
        Postures and straight motions looked at by all planned motions together, each of which may use a
        quarter.
    seed : int
        Of the searches.
    inertia : bool
        Whether `SamplingPlan.wrench` has the inertia of what moves, by differences of the rows, or is
        quasi-static.
    gravity : (3,) array
        In the world [m/s²].
    water_density : float
        [kg/m³]
    num_threads : int
        0 means all.
    
    Returns
    -------
    SamplingPlan
    
    Raises
    ------
    ValueError
        For a target that is not finite, a vehicle that moves, postures of another length, options out
        of range.
    
    Examples
    --------
    >>> import bathyal
    >>> arm = bathyal.arms.maevskiy_zanin()
    >>> bottom = bathyal.TriangleMesh([[-2, -2, -0.8], [2, -2, -0.8], [0, 3, -0.8]], [[0, 1, 2]])
    >>> ws = bathyal.Workspace(arm, scene=bathyal.Scene(bottom))
    >>> plan = bathyal.plan_sampling(ws, [0.75, 0.2, -0.8], q_start=[0.0, -0.785, 0.873])
    >>> plan.status, [phase.name for phase in plan.phases]
    ('planned', ['approach', 'press', 'grab', 'lift', 'transport'])
    >>> round(float(plan.contact_force.max()))  # [N]
    100
    """
def plan_toolpath(surface: Scene | Plane, aims: numpy.typing.ArrayLike, *, world_from_vehicle: numpy.typing.ArrayLike | None = None, frame: str = 'vehicle', vertical: str = 'gravity', grazing_angle: typing.SupportsFloat | typing.SupportsIndex = 1.3962634015954636, max_range: typing.SupportsFloat | typing.SupportsIndex = ..., missed: str = 'leave_out', orientation: str = 'blended', blend_length: typing.SupportsFloat | typing.SupportsIndex = 0.1, angular_rate: typing.SupportsFloat | typing.SupportsIndex = 0.5, speed: typing.SupportsFloat | typing.SupportsIndex = 0.1, acceleration: typing.SupportsFloat | typing.SupportsIndex = 0.1, standoff: typing.SupportsFloat | typing.SupportsIndex = 0.0, offset: str = 'rolling', step: typing.SupportsFloat | typing.SupportsIndex = 0.0, normal_radius: typing.SupportsFloat | typing.SupportsIndex = 0.0, tool_radius: typing.SupportsFloat | typing.SupportsIndex = 0.0, tool_length: typing.SupportsFloat | typing.SupportsIndex = 0.0, contact_tolerance: typing.SupportsFloat | typing.SupportsIndex = 0.01, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> ToolPath:
    """
    Plan the path of a tool along the bottom.
    
    Through the targets the camera axes point at, in their order: the upright section between each pair
    and the next, oriented and timed.
    
    Parameters
    ----------
    surface, aims, world_from_vehicle, frame, vertical, grazing_angle, max_range, num_threads
        As in find_targets; `vertical` also decides how the bottom is cut.
    missed : {"leave_out", "refuse"}
        Aims without a target: left out with a warning, the stretch over them a gap; or an error.
    orientation : {"blended", "piecewise_constant"}
        Turns spread over `blend_length`, or the paper's form: constant on a facet, T_j twice on an
        edge, once per facet, the tool turning in place.
    blend_length : float
        Path over which one turn is spread [m].
    angular_rate : float
        Limit of the tool's whole frame [rad/s]; the feed slows where it must.
    speed, acceleration : float
        Limits of the tool's point along its path [m/s], [m/s²]; it starts and ends at rest.
    standoff : float
        Of the tool's point from the bottom [m].
    offset : {"rolling", "plain"}
        How the standoff is kept. Rolling: the point is the centre of a ball of that radius that rolls
        over the bottom. Plain: each T_j moved along its own a_j. Without standoff, and on a plane, both
        are the same.
    step : float
        Longest stretch between samples on the bottom [m]; 0 keeps the T_j as cut. T_j always stay.
    normal_radius : float
        Radius of the footprint normals are taken over [m]; 0 takes facet normals.
    tool_radius, tool_length : float
        The tool's body, a capsule from its point back along a_j [m]; length 0 checks no body.
    contact_tolerance : float
        How far ground may reach into the body without a contact flag [m].
    
    Returns
    -------
    ToolPath
    
    Raises
    ------
    ValueError
        For no aims, aims that are not finite, or no target at all.
    
    Notes
    -----
    A gap is crossed straight between two samples, the first flagged, the tool at rest at both. Targets
    that coincide give no length. A target above the next one is joined down the wall between them. One
    target gives one sample. Read `warnings`.
    
    Rolling, no sample is nearer to any mesh of the scene than `standoff`, and of the straight stretch
    between two samples d apart nothing is nearer than √(standoff² − d²/4). The ball's centre keeps to
    the upright plane of each section, moved sideways by the standoff times the section's mean sine of
    the slope across it; `surface` is what the ball touches, up to the standoff off the section, and a_j
    points from there to the centre. A hollow too narrow for the ball it touches on both sides and
    passes over: there a_j jumps, which is blended (over two standoffs at most) or turned in place, as
    between facets. A target it cannot touch is passed straight above. With `normal_radius` > 0 a_j is
    the normal of the footprint round what is touched. A section the ball cannot roll over keeps the
    plain offset, raised off the bottom, with a warning. `tool_radius` plays no part: a body wider than
    the standoff may meet ground, which `contact` flags. Plain, the path over ground more concave than
    the standoff turns back, crosses itself and comes nearer; `crossing` flags it.
    
    References
    ----------
    Filaretov, Konoplin, Konoplin (2018), section 2.
    
    Examples
    --------
    >>> import bathyal
    >>> bottom = bathyal.Plane((0, 0, 1), -5.0)
    >>> aims = [[0, 0, 0, 0, 0, -1], [2, 0, 0, 0, 0, -1]]
    >>> path = bathyal.plan_toolpath(bottom, aims, speed=0.1, acceleration=0.1)
    >>> path.position.tolist()
    [[0.0, 0.0, -5.0], [2.0, 0.0, -5.0]]
    >>> path.approach[0].tolist(), path.travel[0].tolist()
    ([0.0, 0.0, 1.0], [1.0, 0.0, 0.0])
    >>> round(float(path.time[-1]), 3)
    21.0
    """
def plan_touches(arm: Arm, count: typing.SupportsInt | typing.SupportsIndex, *, points: numpy.typing.ArrayLike | None = None, num_points: typing.SupportsInt | typing.SupportsIndex = 3, known_distances: collections.abc.Iterable[tuple[int, int]] | None = None, distance_std: typing.SupportsFloat | typing.SupportsIndex = 0.0001, known_points: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex] = [], point_std: typing.SupportsFloat | typing.SupportsIndex = 0.0001, feasible: collections.abc.Callable[[numpy.ndarray], numpy.ndarray] | None = None, floor: typing.SupportsFloat | typing.SupportsIndex | None = None, criterion: str = 'worst_tip', candidates: typing.SupportsInt | typing.SupportsIndex = 600, passes: typing.SupportsInt | typing.SupportsIndex = 10, parametrization: str = 'hayati', nearly_parallel: typing.SupportsFloat | typing.SupportsIndex = 0.1, noise: typing.SupportsFloat | typing.SupportsIndex = 0.0001, length_prior: typing.SupportsFloat | typing.SupportsIndex = 0.001, angle_prior: typing.SupportsFloat | typing.SupportsIndex = 0.002, tool_prior: typing.SupportsFloat | typing.SupportsIndex = 0.01, workspace: numpy.typing.ArrayLike | None = None, workspace_poses: typing.SupportsInt | typing.SupportsIndex = 400, seed: typing.SupportsInt | typing.SupportsIndex = 0, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> TouchPlan:
    """
    Choose poses to touch fixed points in, so that the arm identified from them is accurate.
    
    Poses drawn over all of the joints' range are moved onto each point by the least joint motion: every
    branch of elbow and wrist, the tool in every direction. The criterion selects among the feasible
    ones, greedily and then by exchange (Fedorov 1972, Theory of optimal experiments; Cook, Nachtsheim
    1980, A comparison of algorithms for constructing exact D-optimal designs).
    
    Parameters
    ----------
    arm : Arm
        Nominal, with its tool given to a centimetre or so.
    count : int
        Touches, 2 or more, of all points together.
    points : (k, 3) array, optional
        Approximate positions of the points, in the world [m]. Chosen unless given: where the arm can
        reach from many sides, apart from each other.
    num_points : int
        How many are chosen.
    known_distances : sequence of (int, int)
        Points 0 … k - 1 whose distance from each other will be measured. Touches alone do not determine
        the scale of the arm.
    distance_std : float
        Standard deviation of such a distance [m].
    known_points : sequence of int
        Points whose position in the world will be measured.
    point_std : float
        Standard deviation of such a position, per axis [m].
    feasible : callable, optional
        Which poses may be held: (N, n) array of joint values to (N,) array of bool. It is called a few
        times with many rows.
    floor : float, optional
        Minimum height in the world of all joints and the tip [m].
    criterion : {"worst_tip", "d_optimal", "o1"}
        "worst_tip": the worst predicted deviation of the tip over the workspace, gauge freedom removed,
        scale included. "d_optimal": the determinant of the parameters' information. "o1": the
        observability index of Borm and Menq (1989, Experimental study of observability of parameter
        errors in robot calibration; 1991, Determination of optimal measurement configurations for robot
        calibration based on observability measure).
    candidates : int
        Poses to choose from, for each point; 10⁵ at most.
    passes : int
        Maximum number of exchange rounds.
    parametrization, nearly_parallel, noise, length_prior, angle_prior, tool_prior
        As of `forecast_touches`.
    workspace, workspace_poses
        As of `forecast_touches`; poses of the workspace that are drawn must be feasible, too.
    seed : int
        Of what is drawn.
    num_threads : int
        0 for all. The same bytes for any number.
    
    Returns
    -------
    TouchPlan
        ``.q`` (N, n), ``.point`` (N,), ``.points`` (k, 3), ``.forecast``, ``.value`` of the criterion,
        ``.warnings``; ``.write("plan.csv")`` for the operator, ``.plot("plan.png")``; its text is one
        paragraph.
    
    Raises
    ------
    ValueError
        For `count` below 2, a point out of reach (it is named), points that nothing feasible touches, a
        `feasible` that returns something else, options out of range.
    
    Examples
    --------
    >>> import bathyal
    >>> arm = bathyal.arms.ur10e()
    >>> plan = bathyal.plan_touches(arm, 24, num_points=2, known_distances=[(0, 1)], candidates=200)
    >>> plan.q.shape, plan.points.shape
    ((24, 6), (2, 3))
    >>> bool(plan.worst_tip_std < 0.001)
    True
    """
def practical_salinity(conductivity: numpy.typing.ArrayLike, temperature: numpy.typing.ArrayLike, pressure: numpy.typing.ArrayLike) -> float | numpy.ndarray:
    """
    Practical salinity from conductivity, PSS-78.
    
    Parameters
    ----------
    conductivity : float or array
        [S/m]; 0 or less, as of air, gives 0, and NaN stays NaN.
    temperature : float or array
        On ITS-90 [°C].
    pressure : float or array
        Above the atmosphere's [dbar].
    
    Returns
    -------
    float or array
        Practical salinity. It was fitted to salinities of 2 to 42.
    
    Examples
    --------
    >>> import bathyal
    >>> round(bathyal.practical_salinity(4.2914, 14.9964, 0.0), 4)
    35.0
    """
def pressure_from_depth(depth: numpy.typing.ArrayLike, latitude: numpy.typing.ArrayLike = 45.0) -> float | numpy.ndarray:
    """
    Pressure [dbar] at a depth.
    
    The inverse of `depth_from_pressure`, to rounding.
    
    Parameters
    ----------
    depth : float or array
        [m]
    latitude : float or array
        [deg]
    
    Returns
    -------
    float or array
        Above the atmosphere's [dbar].
    """
def read_mcap(bytes: bytes) -> dict:
    """
    The messages of a log.
    
    Parameters
    ----------
    bytes : bytes
        Of an MCAP file without compression, whole or cut.
    
    Returns
    -------
    dict
        ``topics``: by topic, a JSON list of all its messages; ``reason``: why it breaks off, "" for a
        whole file.
    
    Raises
    ------
    bathyal.Error
        For bytes that are no MCAP, or chunks that are compressed.
    """
def read_mesh_with(read: collections.abc.Callable) -> None:
    """
    Hand in what reads the corners of a shape's mesh.
    """
def read_pcd(path: os.PathLike | str | bytes, *, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> PointCloud:
    """
    The point cloud of a .pcd file: ascii, binary or binary_compressed.
    
    Fields other than x, y, z become attributes; `rgb` and `rgba` are taken apart into red, green, blue.
    """
def read_servo_packet(packet: bytes) -> tuple[int, int, list[float]]:
    """
    A packet of ArduPilot's servo outputs.
    
    Parameters
    ----------
    packet : bytes
    
    Returns
    -------
    tuple
        Rate [Hz], number of the frame, commands of −1 to 1 of 16 or 32 channels (1 100 to 1 900 µs).
    
    Raises
    ------
    Error
        For other bytes.
    """
def read_text_table(path: os.PathLike | str | bytes, *, separator: str | None = None, decimal: str | None = None, comments: collections.abc.Sequence[str] = ['#', '//', '%', '!', ';'], header_lines: typing.SupportsInt | typing.SupportsIndex = -1, skip_lines: typing.SupportsInt | typing.SupportsIndex = 0, columns: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex | str] = (), leading: typing.SupportsInt | typing.SupportsIndex = 0, empty_is_nan: bool = False, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> TextTable:
    """
    Numbers in columns of a text file, or an ESRI ASCII grid as x, y, z.
    
    Parameters
    ----------
    path : path
    separator : " ", ",", ";" or tab, optional
        " " is any run of blanks and tabs. None looks at the file.
    decimal : "." or ",", optional
        None takes a comma only where ";" or a tab separates columns and no number could mean thousands.
    comments : sequence of str
        A line that begins with one of these is skipped, and so is the rest of a line after a blank
        and one of these.
    header_lines : int
        Lines of column names; -1 takes lines without numbers as such.
    skip_lines : int
        Lines at the top that are not looked at.
    columns : sequence of int or str
        Which columns, by index or name, in this order; empty takes all. The others may hold text.
    leading : int
        How many of them lie side by side in ``.table``; each further one is an array of its own in
        ``.extra``. 0: all side by side.
    empty_is_nan : bool
        An empty field, NA or null is NaN instead of an error.
    num_threads : int
        0: all.
    
    Raises
    ------
    ValueError
        Options that make no sense, or columns that the file lacks.
    Error
        With file and line: not readable, no text, no rows, no number, rows of different lengths.
    """
def seawater_density(temperature: numpy.typing.ArrayLike, salinity: numpy.typing.ArrayLike, pressure: numpy.typing.ArrayLike) -> float | numpy.ndarray:
    """
    Density of seawater by EOS-80.
    
    UNESCO (1981), fitted to −2 to 40 °C, salinity 0 to 42 and 10 000 dbar; the standard error is
    0.009 kg/m³.
    
    Parameters
    ----------
    temperature : float or array
        On ITS-90 [°C].
    salinity : float or array
        Practical.
    pressure : float or array
        Above the atmosphere's [dbar].
    
    Returns
    -------
    float or array
        [kg/m³]
    """
def servo_packet(*, rate: typing.SupportsInt | typing.SupportsIndex, frame: typing.SupportsInt | typing.SupportsIndex, pulses: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex]) -> bytes:
    """
    A packet of ArduPilot's servo outputs, as the autopilot sends it.
    
    Parameters
    ----------
    rate : int
        [Hz]
    frame : int
    pulses : list of int
        16 or 32 [µs].
    
    Returns
    -------
    bytes
    
    Raises
    ------
    ValueError
        For another number of pulses.
    """
def set_simd_level(level: str) -> None:
    """
    Choose a lower instruction set, for tests and benchmarks: results are the same bytes.
    """
def sidescan_bottom(power: numpy.typing.ArrayLike, *, method: str = 'likelihood', first_sample: typing.SupportsInt | typing.SupportsIndex = 0, threshold_db: typing.SupportsFloat | typing.SupportsIndex = 6.0) -> numpy.ndarray:
    """
    Sample of the bottom's first return in each row; −1 where there is none.
    
    `bathyal.SonarRecord.track_bottom` is the way to it.
    
    Parameters
    ----------
    power : (P, beams, samples) array
        Near to far; rows may end in NaN.
    method : str
        "likelihood" or "threshold".
    first_sample : int
        Nothing nearer is taken for the bottom.
    threshold_db : float
        Of "threshold", above the water before it.
    
    Returns
    -------
    (P, beams) array of int64
    
    Raises
    ------
    ValueError
        For wrong shapes, or a method that is neither.
    """
def sidescan_ground(power: numpy.typing.ArrayLike, *, sample_length: typing.SupportsFloat | typing.SupportsIndex, first: numpy.typing.ArrayLike, spacing: typing.SupportsFloat | typing.SupportsIndex) -> numpy.ndarray:
    """
    Rows laid on a level bottom.
    
    Parameters
    ----------
    power : (P, beams, samples) array
    sample_length : float
        [m]
    first : (P, beams) array
        Slant range of the first return [m]; NaN gives a row of NaN.
    spacing : float
        Of the bins on the ground [m].
    
    Returns
    -------
    (P, beams, bins) array of float32
        Mean power of what came from each bin; bin k is from k to k + 1 times the spacing.
    
    Raises
    ------
    ValueError
        For wrong shapes, or a spacing that is not above 0 or gives more than 4·10⁸ bins.
    """
def sidescan_mosaic(power: numpy.typing.ArrayLike, *, bin_length: typing.SupportsFloat | typing.SupportsIndex, sides: collections.abc.Sequence[str], place: numpy.typing.ArrayLike, spacing: typing.SupportsFloat | typing.SupportsIndex, gap: typing.SupportsFloat | typing.SupportsIndex = 1.0) -> tuple:
    """
    An image of the bottom from above, of rows on the ground.
    
    Parameters
    ----------
    power : (P, beams, bins) array
    bin_length : float
        [m]
    sides : list of str
        "port" or "starboard", of each beam.
    place : (P, 3) array
        x, y [m] of each row's middle, and the heading clockwise from y [rad]; NaN leaves a ping out.
    spacing : float
        Of the cells [m].
    gap : float
        The widest between neighbouring pings that is filled [m].
    
    Returns
    -------
    (rows, columns) array of float32, west, north, left_out
        North up; outer corner of the first cell [m]; pings without a place.
    
    Raises
    ------
    ValueError
        For wrong shapes, or a spacing that is not above 0 or gives more than 4·10⁸ cells.
    bathyal.Error
        Where no ping has a place.
    """
def simd_level() -> str:
    """
    The instruction set in use: "baseline" (x86-64-v2), "avx2" or "avx512".
    """
def smooth(time: numpy.typing.ArrayLike, attitude: numpy.typing.ArrayLike, velocity: numpy.typing.ArrayLike, fix_time: numpy.typing.ArrayLike, fix_position: numpy.typing.ArrayLike, *, fix_noise: float | numpy.typing.ArrayLike = 0.1, initial_attitude: float | numpy.typing.ArrayLike = [0.0, 0.0, 0.035], **kwargs: float) -> NavigationTrack:
    """
    A track reckoned from attitude and log, through its fixes.
    
    Forward by `NavigationFilter.predict_motion`, then back: each estimate is the best given all fixes.
    Estimated along the way are heading, scale and mount of the log, current, and where in the vehicle
    the fixes belong to. A velocity that repeats the row before to the last bit is an old value that
    is held: it is replaced by what lies linearly between the fresh ones.
    
    Parameters
    ----------
    time : (N,) array
        Rising [s]; two or more.
    attitude : (N,) or (N, 3) array
        Yaw, or roll, pitch, yaw, as `dead_reckon` takes them [rad].
    velocity : (N, 3) array
        In the vehicle: forward, to port, up [m/s].
    fix_time : (F,) array
        Rising, within `time` [s].
    fix_position : (F, 3) array
        In the world [m].
    fix_noise : float or (3,) array
        Standard deviation [m].
    initial_attitude : float or (3,) array
        Standard deviation of the attitude about the world's axes [rad].
    **options : float
        As of `NavigationFilter`; gyro_noise, log_noise, log_walk, log_scale, current, current_time and
        fix_lever have defaults for a vehicle with an attitude reference and a velocity log.
    
    Returns
    -------
    NavigationTrack
        One row a time. Its `fix_point` is what goes through the fixes; `position` is that of the log.
    
    Raises
    ------
    ValueError
        For times that do not rise, fixes outside them, other counts of rows, numbers that are not
        finite, or a noise that is not above 0.
    
    Examples
    --------
    >>> import bathyal, numpy as np
    >>> time = np.arange(0.0, 101.0)
    >>> log = np.tile([1.02, 0.0, 0.0], (101, 1))
    >>> track = bathyal.smooth(time, 0.0 * time, log, [0.0, 100.0], [[0, 0, 0], [100, 0, 0]])
    >>> track.position[50].round(1).tolist()
    [50.0, 0.0, 0.0]
    """
def sound_speed(temperature: numpy.typing.ArrayLike, salinity: numpy.typing.ArrayLike, depth: numpy.typing.ArrayLike | None = None, *, pressure: numpy.typing.ArrayLike | None = None, latitude: numpy.typing.ArrayLike = 45.0, longitude: numpy.typing.ArrayLike | None = None, formula: str = 'mackenzie', temperature_scale: str | None = None) -> float | numpy.ndarray:
    """
    Speed of sound in seawater.
    
    The formulas are as printed, each on the temperature scale of its authors, and numbers broadcast.
    
    Parameters
    ----------
    temperature : float or array
        [°C]
    salinity : float or array
        Practical.
    depth : float or array
        Below the surface [m]; or `pressure`, one of the two.
    pressure : float or array
        Above the atmosphere's [dbar]. Where a formula takes the other one, it is converted by TEOS-10
        at `latitude`, as gsw does.
    latitude, longitude : float or array
        North and east [deg]. The longitude only counts for ``"teos10"``: without it absolute salinity
        is the reference salinity, which is within 0.02 g/kg of it but in the Baltic.
    formula : str
        ``"mackenzie"``: Mackenzie (1981), 2 to 30 °C, salinity 25 to 40, to 8 000 m.
        ``"chen_millero"``: Chen, Millero (1977) in UNESCO 44, 0 to 40 °C, 0 to 40, to 10 000 dbar.
        ``"del_grosso"``: Del Grosso (1974), 0 to 30 °C, 30 to 40, to 9 807 dbar.
        ``"teos10"``: of gsw, which has to be installed (``pip install 'bathyal[water]'``).
    temperature_scale : str, optional
        ``"ITS-90"`` or ``"IPTS-68"``: what `temperature` is on, to be converted to the formula's scale
        (T68 = 1.00024 T90). None: it is on the formula's own, IPTS-68 but for TEOS-10. The difference
        is below 0.02 m/s.
    
    Returns
    -------
    float or array
        [m/s]; outside a formula's range it extrapolates, with a `RangeWarning`.
    
    Raises
    ------
    ValueError
        For neither or both of depth and pressure, shapes that do not broadcast, and numbers that no
        water has: NaN, a temperature not from −10 to 60 °C, a salinity not from 0 to 100.
    Error
        For ``"teos10"`` without gsw.
    
    Examples
    --------
    >>> import bathyal
    >>> round(bathyal.sound_speed(25, 35, 1000), 3)
    1550.744
    >>> round(bathyal.sound_speed(40, 40, pressure=10000, formula="chen_millero"), 3)
    1731.995
    """
def sound_speed_teos10_with(speed: collections.abc.Callable) -> None:
    """
    Hand in the sound speed of TEOS-10.
    """
def survey_height(x: numpy.typing.ArrayLike, y: numpy.typing.ArrayLike, *, seed: typing.SupportsInt | typing.SupportsIndex = 0, origin: numpy.typing.ArrayLike = (431200.0, 6172650.0, -38.0), length: typing.SupportsFloat | typing.SupportsIndex = 60.0, width: typing.SupportsFloat | typing.SupportsIndex = 40.0, wave_height: typing.SupportsFloat | typing.SupportsIndex = 0.5, wave_length: typing.SupportsFloat | typing.SupportsIndex = 9.0, ripple_height: typing.SupportsFloat | typing.SupportsIndex = 0.04, roughness: typing.SupportsFloat | typing.SupportsIndex = 0.15, boulders: typing.SupportsInt | typing.SupportsIndex = 30, boulder_radius: typing.SupportsFloat | typing.SupportsIndex = 1.3, trench_depth: typing.SupportsFloat | typing.SupportsIndex = 1.1, trench_width: typing.SupportsFloat | typing.SupportsIndex = 3.5, lines: typing.SupportsInt | typing.SupportsIndex = 2, altitude: typing.SupportsFloat | typing.SupportsIndex = 8.0, opening: typing.SupportsFloat | typing.SupportsIndex = 2.0943951, beams: typing.SupportsInt | typing.SupportsIndex = 256, ping_spacing: typing.SupportsFloat | typing.SupportsIndex = 0.12, lost_width: typing.SupportsFloat | typing.SupportsIndex = 2.0, range_noise: typing.SupportsFloat | typing.SupportsIndex = 0.006, range_noise_rate: typing.SupportsFloat | typing.SupportsIndex = 0.0008, angle_noise: typing.SupportsFloat | typing.SupportsIndex = 0.0006, spike_fraction: typing.SupportsFloat | typing.SupportsIndex = 0.0, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> numpy.ndarray:
    """
    True height of the bottom under a generated survey.
    
    Parameters
    ----------
    x, y : (N,) arrays
        Survey coordinates [m].
    seed, origin, length, …
        As given to generate_survey.
    
    Returns
    -------
    (N,) array
        [m]
    
    Examples
    --------
    >>> import bathyal
    >>> flat = dict(wave_height=0, ripple_height=0, roughness=0, boulders=0, trench_depth=0)
    >>> bathyal.survey_height([431210.0], [6172660.0], **flat)
    array([-38.])
    """
def trace_sound(water: Water | Profile, launch_angle: numpy.typing.ArrayLike, travel_time: numpy.typing.ArrayLike, start_depth: numpy.typing.ArrayLike, *, time: typing.SupportsFloat | typing.SupportsIndex = 0.0) -> TracedSound:
    """
    Where beams are after their travel times.
    
    What reduces a sounding of a multibeam sonar: along the path of sound in a profile. Arguments
    broadcast.
    
    Parameters
    ----------
    water : Water or Profile
    launch_angle : float or array
        Below the horizontal, −½π to ½π [rad]: ½π minus the angle from the vertical.
    travel_time : float or array
        One way [s]: half of what the sonar measures.
    start_depth : float or array
        Of the sonar [m].
    time : float
        Of the water [s].
    
    Returns
    -------
    TracedSound
        ``.across`` and ``.depth`` [m], ``.angle`` [rad]; NaN where the path has met the surface.
    
    Examples
    --------
    >>> import bathyal
    >>> cast = bathyal.Profile([0, 10, 100], sound_speed=[1520.0, 1500.0, 1490.0])
    >>> found = bathyal.trace_sound(cast, [0.5, 1.0], 0.04, 2.0)
    >>> found.across.round(2).tolist(), found.depth.round(2).tolist()
    ([52.19, 32.04], [31.7, 52.69])
    """
def triangle_material(mesh: TriangleMesh) -> numpy.ndarray:
    """
    Material of each triangle of a generated bottom.
    
    Parameters
    ----------
    mesh : TriangleMesh
        With an attribute ``material`` of the vertices, as make_seabed gives.
    
    Returns
    -------
    (T,) array of int
        Rows of ``SeabedModel.materials``: the middle of the values of the three corners.
    
    Examples
    --------
    >>> import bathyal
    >>> mesh = bathyal.make_seabed(1, 0.5)
    >>> bathyal.triangle_material(mesh)
    array([0, 0, 0, 0, 0, 0, 0, 0], dtype=int16)
    """
def triangulate(cloud: PointCloud | numpy.typing.ArrayLike, *, max_edge: typing.SupportsFloat | typing.SupportsIndex | None = None, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> tuple[TriangleMesh, SheetReport]:
    """
    The TriangleMesh of a cloud as a height field, and its SheetReport.
    """
def triangulate_delaunay(points: numpy.typing.ArrayLike, *, max_edge: typing.SupportsFloat | typing.SupportsIndex | None = None, num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> tuple[numpy.ndarray, dict]:
    """
    (T, 3) int32 rows of `points`, and a dict: max_edge [m], cut_triangles, merged_points.
    """
def typical_sensors() -> list[Sensor]:
    """
    What a small vehicle carries, with errors of the middle class.
    """
def verify_positions(predicted: numpy.typing.ArrayLike, positions: numpy.typing.ArrayLike, *, pairs: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex] = []) -> Verification:
    """
    The comparison behind `verify_arm`, of positions (N, 3) [m].
    """
def warn_of_range_with(warn: collections.abc.Callable) -> None:
    """
    Hand in what warns of a formula of the water outside its range.
    """
def warn_of_support_with(warn: collections.abc.Callable) -> None:
    """
    Hand in what warns of a call beyond the support of a corrected arm.
    """
def with_link_radii(arm: Arm, radii: numpy.typing.ArrayLike, *, density: typing.SupportsFloat | typing.SupportsIndex | None = None) -> Arm:
    """
    The same arm with thickness: a cylinder along each of its segments.
    
    The segments lead from joint to joint, along d and a of each row of the table, and to the tool
    centre point; those that a sliding joint draws out are left bare.
    
    Parameters
    ----------
    arm : Arm
    radii : float or (L,) array
        One for all links, or one each, the foot first [m].
    density : float, optional
        Mean density of the cylinders [kg/m³]: where given, links without mass and volume take those of
        their cylinders, and their inertia.
    
    Returns
    -------
    Arm
        The cylinders are among the collision shapes of its links.
    
    Raises
    ------
    ValueError
        For another count, a radius that is negative or not finite, a density that is not positive.
    """
def write_mcap(path: str, messages: list[tuple[str, int, bytes]]) -> None:
    """
    Messages as an MCAP file, without compression.
    
    Parameters
    ----------
    path : str
    messages : list of tuples
        Topic, time [ns] and data, JSON.
    
    Raises
    ------
    TypeError, ValueError, OverflowError
        For messages that are no such tuples.
    Error
        Where the file cannot be written.
    """
def write_xyz(path: os.PathLike | str | bytes, cloud: PointCloud, *, decimals: typing.SupportsInt | typing.SupportsIndex = -1, separator: str = ' ', preamble: str = '', header: bool = False, attributes: collections.abc.Sequence[str] = [], num_threads: typing.SupportsInt | typing.SupportsIndex = 0) -> None:
    """
    Write x y z and the named attributes as text, one point a line.
    
    `decimals` of -1 writes the shortest text that reads back as the same number; `preamble` goes above
    everything else, unchanged. Writes in place: write aside and rename.
    """
BEYOND_NOISE: float = 0.002

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace bathyal::python::devices_docs {

inline constexpr const char* kTable = R"(Thrust, power and speed measured at commands and voltages.

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
)";

inline constexpr const char* kThruster = R"(A thruster in the vehicle's frame.

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
)";

inline constexpr const char* kFit = R"(Fits a thruster's law to a table by least squares.

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
)";

inline constexpr const char* kBattery = R"(A source with an inner resistance: V = E(charge) − R I.

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
)";

inline constexpr const char* kSolve =
    R"(Voltage and current that agree with each other and the load.

Parameters
----------
power : float or callable
    Drawn [W], or a function of the voltage that gives it.
charge : float
    Share of the capacity that is left, 0 to 1.
)";

inline constexpr const char* kFin = R"(A rudder, stern plane or fixed fin, in the vehicle's frame.

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
)";

inline constexpr const char* kTether = R"(A cable from a point fixed in the world to the vehicle.

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
)";

inline constexpr const char* kSystem =
    R"(A vehicle with thrusters, fins, battery, ballast and tether.

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
)";

inline constexpr const char* kStep =
    R"(Changes a state by steps of equal length under the same commands.

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
)";

}  // namespace bathyal::python::devices_docs

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace bathyal::python::mission_docs {

inline constexpr const char* kPlan = R"(A mission, ready to run: `bathyal.read_mission` makes it.

All that a run's outcome depends on but its seed.
)";

inline constexpr const char* kRun = R"(One run of a mission, tick by tick.

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
)";

inline constexpr const char* kMcapMessages = R"(All messages of an MCAP file, in their order.

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
    For bytes that are no MCAP, or compressed ones.)";

inline constexpr const char* kWriteMcap = R"(Messages as an MCAP file, without compression.

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
    Where the file cannot be written.)";

inline constexpr const char* kArrived = R"(What the next tick takes in, in its order.

Returns
-------
list of tuples
    Device, kind, time at which it was so and at which it arrived [s], index, whether it is valid,
    values: see `Sensor`.)";

inline constexpr const char* kStep = R"(Some ticks.

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
)";

inline constexpr const char* kReadMcap = R"(The messages of a log.

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
)";

}  // namespace bathyal::python::mission_docs

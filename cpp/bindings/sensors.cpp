// SPDX-License-Identifier: BSD-3-Clause
#include "sensors.hpp"

#include <pybind11/stl.h>

#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "bathyal/base/check.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/base/text.hpp"
#include "bathyal/navigation/allan_deviation.hpp"
#include "bathyal/navigation/dead_reckoning.hpp"
#include "bindings.hpp"
#include "sensors_docs.hpp"

namespace bathyal::python {
namespace {

using ChannelValues = py::typing::Union<py::float_, ArrayLike>;

struct ErrorField {
  const char* name;
  double SensorChannel::*member;
};
constexpr std::array<ErrorField, 9> kErrors{{{"noise", &SensorChannel::noise},
                                             {"bias", &SensorChannel::bias},
                                             {"scale", &SensorChannel::scale},
                                             {"walk", &SensorChannel::walk},
                                             {"markov", &SensorChannel::markov},
                                             {"markov_time", &SensorChannel::markov_time},
                                             {"outlier_rate", &SensorChannel::outlier_rate},
                                             {"outlier_size", &SensorChannel::outlier_size},
                                             {"quantum", &SensorChannel::quantum}}};

void put_errors(SensorOptions& options, const ErrorField& field, const py::object& given) {
  const auto count = static_cast<std::size_t>(options.channel_count());
  const py::array array = array_argument(field.name, given, "a number, or one a channel");
  const Values values = values_argument(field.name, array.attr("ravel")());
  const auto size = static_cast<std::size_t>(values.rows());
  if (array.ndim() > 1 || (array.ndim() == 1 && size != count)) {
    throw_argument(field.name, "a number, or " + std::to_string(count) + ", one a channel",
                   "shape " + std::string(py::str(array.attr("shape"))));
  }
  for (std::size_t i = 0; i < count; ++i) {
    options.channels[i].*field.member = values.data()[array.ndim() == 0 ? 0 : i];
  }
}

SensorOptions make_sensor(const std::string& kind, const std::optional<std::string>& name,
                          double rate, double latency, double dropout, double range,
                          double sound_speed, const OptionalArray& mount,
                          const OptionalArray& beacons,
                          const std::array<ChannelValues, kErrors.size()>& errors) {
  SensorOptions options;
  options.kind = sensor_kind(kind);
  options.name = name.value_or(kind);
  options.rate = rate;
  options.latency = latency;
  options.dropout = dropout;
  options.range = range;
  options.sound_speed = sound_speed;
  options.vehicle_from_sensor = pose_argument("vehicle_from_sensor", mount);
  if (!beacons.is_none()) {
    const Rows rows = rows_argument("beacons", beacons, 3);
    for (Index i = 0; i < rows.table.rows(); ++i) options.beacons.emplace_back(rows.table.row(i));
  }
  if (options.beacons.size() <= kSensorChannels) {
    for (std::size_t i = 0; i < kErrors.size(); ++i) put_errors(options, kErrors[i], errors[i]);
  }
  options.check();
  return options;
}

/// Rows of a table that may be left out, of 0 then.
class OptionalRows {
 public:
  OptionalRows(std::string_view name, const OptionalArray& given, Index columns, std::size_t count)
      : given_(!given.is_none()) {
    if (!given_) return;
    table_ = columns == 1 ? Table(values_argument(name, given).view())
                          : Table(table_argument(name, given, columns));
    if (static_cast<std::size_t>(table_.rows()) != count) {
      throw_argument(name, std::to_string(count) + " rows, one a time",
                     std::to_string(table_.rows()));
    }
    if (columns > 1 && !table_.allFinite()) throw_argument(name, "finite numbers", "others");
  }
  bool given() const { return given_; }
  auto row(std::size_t i) const { return table_.row(static_cast<Index>(i)).transpose(); }
  double at(std::size_t i) const { return table_(static_cast<Index>(i), 0); }

 private:
  using Table = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  bool given_;
  Table table_;
};

SensorReadings simulate(const SensorOptions& sensor, const ArrayLike& time, const ArrayLike& pose,
                        const OptionalArray& velocity, const OptionalArray& acceleration,
                        const OptionalArray& water_velocity, const OptionalArray& altitude,
                        const OptionalArray& propeller_rate, const OptionalArray& leak,
                        double surface, double gravity, std::uint64_t seed) {
  check_finite("surface", surface);
  check_finite("gravity", gravity);
  const std::vector<double> times = numbers_argument("time", time);
  const std::vector<Pose> poses = poses_argument("pose", pose);
  const std::size_t count = times.size();
  if (poses.size() != count) {
    throw_argument("pose", std::to_string(count) + " poses, one a time",
                   std::to_string(poses.size()));
  }
  const OptionalRows speeds("velocity", velocity, 6, count);
  const OptionalRows changes("acceleration", acceleration, 6, count);
  const OptionalRows water("water_velocity", water_velocity, 3, count);
  const OptionalRows heights("altitude", altitude, 1, count);
  const OptionalRows turns("propeller_rate", propeller_rate, 1, count);
  const OptionalRows leaks("leak", leak, 1, count);
  SensorReadings readings{sensor, {}};
  SensorState state;
  for (std::size_t i = 0; i < count; ++i) {
    if (!(times[i] >= 0.0) || !std::isfinite(times[i]) || (i > 0 && !(times[i] > times[i - 1]))) {
      throw_argument("time", "finite times of 0 or more that rise",
                     to_text(times[i]) + " in row " + std::to_string(i));
    }
    check_rigid("pose[" + std::to_string(i) + "]", poses[i]);
    SensorTruth truth;
    truth.time = times[i];
    truth.world_from_vehicle = poses[i];
    if (speeds.given()) truth.velocity = speeds.row(i);
    if (changes.given()) truth.acceleration = changes.row(i);
    if (water.given()) truth.water_velocity = water.row(i);
    if (heights.given()) truth.altitude = heights.at(i);
    if (turns.given()) truth.propeller_rate = turns.at(i);
    if (leaks.given()) truth.leak = leaks.at(i);
    truth.surface = truth.mean_surface = surface;
    truth.gravity = gravity;
    const auto reading = sample(sensor, state, truth, seed);
    if (reading) readings.rows.push_back(*reading);
  }
  return readings;
}

/// (N,) of bool, as numbers.
OptionalArray flags_argument(std::string_view name, const OptionalArray& given) {
  if (given.is_none()) return given;
  const py::array array = array_argument(name, given, "(N,) of bool");
  if (array.dtype().kind() != 'b') {
    throw_argument(name, "(N,) of bool", "dtype " + std::string(py::str(array.dtype())));
  }
  return array.attr("astype")("float64");
}

SensorReadings make_readings(const SensorOptions& sensor, const ArrayLike& time,
                             const ArrayLike& values, const OptionalArray& arrival,
                             const OptionalArray& valid) {
  const std::vector<double> times = numbers_argument("time", time);
  const int channels = sensor.channel_count();
  const auto table = table_argument("values", values, channels);
  if (static_cast<std::size_t>(table.rows()) != times.size()) {
    throw_argument("values", std::to_string(times.size()) + " rows, one a time",
                   std::to_string(table.rows()));
  }
  const OptionalRows arrivals("arrival", arrival, 1, times.size());
  const OptionalRows valids("valid", flags_argument("valid", valid), 1, times.size());
  SensorReadings readings{sensor, {}};
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i]) || (i > 0 && !(times[i] > times[i - 1]))) {
      throw_argument("time", "finite times that rise",
                     to_text(times[i]) + " in row " + std::to_string(i));
    }
    SensorReading row;
    row.kind = sensor.kind;
    row.time = times[i];
    row.arrival = arrivals.given() ? arrivals.at(i) : times[i] + sensor.latency;
    if (!(row.arrival >= row.time)) {
      throw_argument("arrival", "times not before the readings'", to_text(row.arrival));
    }
    row.index = static_cast<std::int64_t>(i);
    row.count = channels;
    row.valid = !valids.given() || valids.at(i) != 0.0;
    for (int c = 0; c < channels; ++c) {
      row.values[static_cast<std::size_t>(c)] = table(static_cast<Index>(i), c);
    }
    readings.rows.push_back(row);
  }
  return readings;
}

template <class Get>
auto column(const SensorReadings& readings, const Get& get) {
  using Value = std::decay_t<decltype(get(readings.rows.front()))>;
  std::vector<Value> values;
  for (const SensorReading& row : readings.rows) values.push_back(get(row));
  return values;
}

py::array reading_values(const SensorReadings& readings) {
  const int channels = readings.sensor.channel_count();
  std::vector<double> values;
  for (const SensorReading& row : readings.rows) {
    values.insert(values.end(), row.values.begin(), row.values.begin() + channels);
  }
  return to_numpy(std::move(values), {channels});
}

py::typing::Tuple<py::array, py::array> allan(const ArrayLike& rate_data, double sample_rate,
                                              const std::vector<std::int64_t>& factors) {
  AllanDeviation got =
      allan_deviation(numbers_argument("rate_data", rate_data), sample_rate, factors);
  return py::make_tuple(to_numpy(std::move(got.interval)), to_numpy(std::move(got.deviation)));
}

void bind_sensor_class(py::class_<SensorOptions>& cls) {
  const SensorOptions d;
  const ChannelValues none = py::float_(0.0);
  cls.def(py::init([](const std::string& kind, const std::optional<std::string>& name, double rate,
                      double latency, double dropout, double range, double sound_speed,
                      const OptionalArray& mount, const OptionalArray& beacons,
                      const ChannelValues& noise, const ChannelValues& bias,
                      const ChannelValues& scale, const ChannelValues& walk,
                      const ChannelValues& markov, const ChannelValues& markov_time,
                      const ChannelValues& outlier_rate, const ChannelValues& outlier_size,
                      const ChannelValues& quantum) {
            return make_sensor(kind, name, rate, latency, dropout, range, sound_speed, mount,
                               beacons,
                               {noise, bias, scale, walk, markov, markov_time, outlier_rate,
                                outlier_size, quantum});
          }),
          py::arg("kind"), py::kw_only(), py::arg("name") = py::none(), py::arg("rate") = d.rate,
          py::arg("latency") = d.latency, py::arg("dropout") = d.dropout,
          py::arg("range") = d.range, py::arg("sound_speed") = d.sound_speed,
          py::arg("vehicle_from_sensor") = py::none(), py::arg("beacons") = py::none(),
          py::arg("noise") = none, py::arg("bias") = none, py::arg("scale") = none,
          py::arg("walk") = none, py::arg("markov") = none, py::arg("markov_time") = none,
          py::arg("outlier_rate") = none, py::arg("outlier_size") = none, py::arg("quantum") = none)
      .def_property_readonly(
          "kind", [](const SensorOptions& s) { return sensor_kind_name(s.kind); },
          "What it measures.")
      .def_readonly("name", &SensorOptions::name, "Keys the noise.")
      .def_readonly("rate", &SensorOptions::rate, "Of samples [Hz].")
      .def_readonly("latency", &SensorOptions::latency, "From validity to arrival [s].")
      .def_property_readonly("channels", &SensorOptions::channel_count,
                             "How many values a sample has.")
      .def("simulate", &simulate, py::arg("time"), py::arg("pose"), py::kw_only(),
           py::arg("velocity") = py::none(), py::arg("acceleration") = py::none(),
           py::arg("water_velocity") = py::none(), py::arg("altitude") = py::none(),
           py::arg("propeller_rate") = py::none(), py::arg("leak") = py::none(),
           py::arg("surface") = SensorTruth().surface, py::arg("gravity") = SensorTruth().gravity,
           py::arg("seed") = 0, sensors_docs::kSimulate)
      .def("__repr__", [](const SensorOptions& s) {
        return "Sensor(\"" + sensor_kind_name(s.kind) + "\", name=\"" + s.name +
               "\", rate=" + to_text(s.rate) + ")";
      });
}

void bind_readings(py::class_<SensorReadings>& cls) {
  cls.def(py::init(&make_readings), py::arg("sensor"), py::arg("time"), py::arg("values"),
          py::kw_only(), py::arg("arrival") = py::none(), py::arg("valid") = py::none())
      .def_readonly("sensor", &SensorReadings::sensor, "Which they are of.")
      .def_property_readonly(
          "time",
          [](const SensorReadings& r) {
            return to_numpy(column(r, [](const SensorReading& row) { return row.time; }));
          },
          "(K,) at which the values were so [s].")
      .def_property_readonly(
          "arrival",
          [](const SensorReadings& r) {
            return to_numpy(column(r, [](const SensorReading& row) { return row.arrival; }));
          },
          "(K,) at which they are known on board [s].")
      .def_property_readonly("values", &reading_values, "(K, C), one column a channel.")
      .def_property_readonly(
          "valid",
          [](const SensorReadings& r) {
            return to_numpy(column(r,
                                   [](const SensorReading& row) {
                                     return static_cast<std::uint8_t>(row.valid);
                                   }))
                .attr("astype")("bool")
                .cast<py::array>();
          },
          "(K,) of bool: False where it measured nothing.")
      .def("__len__", [](const SensorReadings& r) { return r.rows.size(); })
      .def("__repr__", [](const SensorReadings& r) {
        return "SensorReadings(\"" + r.sensor.name + "\", " +
               counted(static_cast<long>(r.rows.size()), "sample") + ")";
      });
}

}  // namespace

PointMatrix attitude_argument(const ArrayLike& object) {
  const std::string shapes = "real numbers of shape (N,) or (N, 3)";
  const py::array array = array_argument("attitude", object, shapes);
  if (array.ndim() != 1) return rows_of_three("attitude", object);
  const Values yaw = values_argument("attitude", object);
  PointMatrix angles = PointMatrix::Zero(yaw.rows(), 3);
  angles.col(2) = yaw.view();
  return angles;
}

std::vector<double> numbers_argument(std::string_view name, const ArrayLike& object) {
  const Values values = values_argument(name, object);
  return {values.data(), values.data() + values.rows()};
}

PointMatrix rows_of_three(std::string_view name, const ArrayLike& object) {
  return points_argument(name, object).view();
}

void bind_sensors(py::module_& module) {
  // Both before what names them.
  py::class_<SensorOptions> sensor(module, "Sensor", sensors_docs::kSensor);
  py::class_<SensorReadings> readings(module, "SensorReadings", sensors_docs::kReadings);
  bind_sensor_class(sensor);
  bind_readings(readings);
  module.def("allan_deviation", &allan, py::arg("rate_data"), py::arg("sample_rate"),
             py::arg("factors") = std::vector<std::int64_t>(), sensors_docs::kAllan);
  module.def(
      "dead_reckon",
      [](const ArrayLike& time, const ArrayLike& attitude, const ArrayLike& velocity) {
        return to_numpy(
            Points(dead_reckon(numbers_argument("time", time), attitude_argument(attitude),
                               rows_of_three("velocity", velocity))));
      },
      py::arg("time"), py::arg("attitude"), py::arg("velocity"), sensors_docs::kReckon);
}

}  // namespace bathyal::python

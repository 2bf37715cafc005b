// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "arrays.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/protocol/ardusub.hpp"
#include "bathyal/protocol/nmea.hpp"
#include "bathyal/protocol/pd6.hpp"
#include "bathyal/protocol/serial_line.hpp"
#include "bindings.hpp"
#include "protocol_docs.hpp"

namespace bathyal::python {
namespace {

using Date = std::tuple<int, int, int>;

Vec3 three(std::string_view name, const ArrayLike& given) {
  const Values values = values_argument(name, given);
  if (values.rows() != 3) throw_argument(name, "3 numbers", std::to_string(values.rows()));
  return {values.data()[0], values.data()[1], values.data()[2]};
}

py::bytes position(const Date& date, double time, double latitude, double longitude,
                   double altitude, double speed, double course, bool valid) {
  NmeaFix fix;
  std::tie(fix.year, fix.month, fix.day) = date;
  fix.time = time;
  fix.latitude = latitude;
  fix.longitude = longitude;
  fix.altitude = altitude;
  fix.speed = speed;
  fix.course = course;
  fix.valid = valid;
  return py::bytes(nmea_gga(fix).append(nmea_rmc(fix)));
}

py::bytes ensemble_text(const Date& date, double time, double heading, double pitch, double roll,
                        double depth, const ArrayLike& velocity, std::optional<double> altitude,
                        double age, bool valid) {
  Pd6Ensemble ensemble;
  std::tie(ensemble.year, ensemble.month, ensemble.day) = date;
  ensemble.time = time;
  ensemble.heading = heading;
  ensemble.pitch = pitch;
  ensemble.roll = roll;
  ensemble.depth = depth;
  ensemble.velocity = three("velocity", velocity);
  ensemble.altitude = altitude;
  ensemble.age = age;
  ensemble.valid = valid;
  return py::bytes(pd6_text(ensemble));
}

/// A line and what it remembers.
struct LineInUse {
  SerialLineOptions options;
  std::uint64_t seed = 0;
  SerialLineState state;
};

void bind_streams(py::module_& module) {
  py::class_<NmeaReader>(module, "NmeaReader", protocol_docs::kReader)
      .def(py::init<>())
      .def(
          "feed",
          [](NmeaReader& reader, const py::bytes& given) {
            std::vector<std::string> bodies;
            reader.feed(std::string_view(given),
                        [&bodies](std::string_view body) { bodies.emplace_back(body); });
            return bodies;
          },
          py::arg("given"), "Bodies of the sentences that these bytes complete.")
      .def_property_readonly(
          "counts",
          [](const NmeaReader& reader) {
            const NmeaCounts& c = reader.counts();
            return std::map<std::string, std::uint64_t>{{"bytes", c.bytes},
                                                        {"sentences", c.sentences},
                                                        {"wrong_checksum", c.wrong_checksum},
                                                        {"broken", c.broken}};
          },
          "bytes, sentences, wrong_checksum, broken.");

  const SerialLineOptions d;
  py::class_<LineInUse>(module, "SerialLine", protocol_docs::kLine)
      .def(py::init([](const std::string& name, double baud, std::size_t buffer,
                       double bit_error_rate, std::uint64_t seed) {
             const SerialLineOptions options{name, baud, buffer, bit_error_rate};
             options.check();
             return LineInUse{options, seed, {}};
           }),
           py::arg("name") = d.name, py::kw_only(), py::arg("baud") = d.baud,
           py::arg("buffer") = d.buffer, py::arg("bit_error_rate") = d.bit_error_rate,
           py::arg("seed") = 1)
      .def(
          "carry",
          [](LineInUse& line, const py::bytes& given, double duration) {
            return py::bytes(
                carry(line.options, line.state, std::string_view(given), duration, line.seed));
          },
          py::arg("given"), py::arg("duration"), protocol_docs::kCarry)
      .def_property_readonly(
          "counts",
          [](const LineInUse& line) {
            return std::map<std::string, std::uint64_t>{{"carried", line.state.carried},
                                                        {"lost", line.state.lost},
                                                        {"turned_bits", line.state.turned},
                                                        {"waiting", line.state.waiting.size()}};
          },
          "Bytes carried, lost to overrun and waiting; turned_bits.");
}

void bind_ardusub(py::module_& module) {
  module.def(
      "read_servo_packet",
      [](const py::bytes& packet) {
        const ServoPacket found = read_servo_packet(std::string_view(packet));
        std::vector<double> commands;
        for (const std::uint16_t pulse : found.pulses) commands.push_back(command_of_pulse(pulse));
        return std::tuple(found.rate, found.frame, commands);
      },
      py::arg("packet"), protocol_docs::kReadServo);
  module.def(
      "servo_packet",
      [](std::uint16_t rate, std::uint32_t frame, const std::vector<std::uint16_t>& pulses) {
        return py::bytes(servo_packet({rate, frame, pulses}));
      },
      py::kw_only(), py::arg("rate"), py::arg("frame"), py::arg("pulses"), protocol_docs::kServo);
  module.def(
      "ardupilot_json",
      [](double time, const ArrayLike& gyro, const ArrayLike& force, const ArrayLike& place,
         const ArrayLike& attitude, const ArrayLike& velocity, std::optional<double> altitude) {
        return py::bytes(ardupilot_json({time, three("gyro", gyro), three("force", force),
                                         three("position", place), three("attitude", attitude),
                                         three("velocity", velocity), altitude}));
      },
      py::kw_only(), py::arg("time"), py::arg("gyro"), py::arg("force"), py::arg("position"),
      py::arg("attitude"), py::arg("velocity"), py::arg("altitude") = py::none(),
      protocol_docs::kJson);
}

}  // namespace

void bind_protocol(py::module_& module) {
  module.def(
      "nmea_sentence", [](const std::string& body) { return py::bytes(nmea_sentence(body)); },
      py::arg("body"), protocol_docs::kSentence);
  module.def("nmea_position", &position, py::kw_only(), py::arg("date"), py::arg("time"),
             py::arg("latitude"), py::arg("longitude"), py::arg("altitude"), py::arg("speed"),
             py::arg("course"), py::arg("valid"), protocol_docs::kPosition);
  module.def(
      "nmea_hdt", [](double heading) { return py::bytes(nmea_hdt(heading)); }, py::arg("heading"),
      "A sentence HDT of a true heading [deg].");
  module.def(
      "nmea_dpt", [](double depth) { return py::bytes(nmea_dpt(depth)); }, py::arg("depth"),
      "A sentence DPT of a depth below the transducer [m].");
  module.def(
      "nmea_vbw",
      [](double ahead, double port, bool valid) { return py::bytes(nmea_vbw(ahead, port, valid)); },
      py::arg("ahead"), py::arg("port"), py::arg("valid") = true, protocol_docs::kVbw);
  module.def("pd6_text", &ensemble_text, py::kw_only(), py::arg("date"), py::arg("time"),
             py::arg("heading"), py::arg("pitch"), py::arg("roll"), py::arg("depth"),
             py::arg("velocity"), py::arg("altitude") = py::none(), py::arg("age") = 0.0,
             py::arg("valid") = true, protocol_docs::kPd6);
  bind_streams(module);
  bind_ardusub(module);
}

}  // namespace bathyal::python

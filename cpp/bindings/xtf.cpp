// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/formats/xtf.hpp"

#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "arrays.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/soundings/formats/sidescan.hpp"
#include "bindings.hpp"

namespace bathyal::python {
namespace {

constexpr const char* kXtfDoc = R"(An XTF file as it is: packets, channels, what was broken.

`bathyal.read_sonar` gives its side-scan pings as a record.
)";

constexpr const char* kParseDoc = R"(Reads the bytes of an XTF file.

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
)";

XtfFile parse(const py::bytes& data) {
  const auto text = static_cast<std::string_view>(data);
  const py::gil_scoped_release unlocked;
  return parse_xtf({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

py::bytes formatted(const XtfFile& file) {
  const std::vector<std::uint8_t> bytes = format_xtf(file);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

py::array amplitude_of(const SidescanPings& pings) {
  auto owned = std::make_shared<const std::vector<float>>(pings.amplitude);
  return read_only_array(
      owned->data(), {static_cast<py::ssize_t>(pings.count()), pings.rows(), pings.samples}, owned);
}

using Column = std::vector<double> SidescanPings::*;

const std::vector<std::pair<const char*, Column>>& columns() {
  static const std::vector<std::pair<const char*, Column>> all = {
      {"time", &SidescanPings::time},
      {"x", &SidescanPings::x},
      {"y", &SidescanPings::y},
      {"depth", &SidescanPings::depth},
      {"altitude", &SidescanPings::altitude},
      {"heading", &SidescanPings::heading},
      {"pitch", &SidescanPings::pitch},
      {"roll", &SidescanPings::roll},
      {"speed", &SidescanPings::speed},
      {"sound_speed", &SidescanPings::sound_speed}};
  return all;
}

/// (P, beams, samples) float32 in C order.
std::vector<float> amplitudes(const ArrayLike& object, SidescanPings& pings) {
  const py::array given =
      array_argument("amplitude", object, "real numbers of shape (pings, beams, samples)");
  if (given.ndim() != 3 || given.shape(1) != pings.rows()) {
    throw_argument("amplitude", "real numbers of shape (pings, beams, samples)",
                   py::repr(given.attr("shape")).cast<std::string>());
  }
  pings.samples = given.shape(2);
  const auto numbers = py::array_t<float, py::array::c_style | py::array::forcecast>(given);
  return {numbers.data(), numbers.data() + numbers.size()};
}

std::vector<double> numbers_of(std::string_view name, const py::object& object) {
  const Values values = values_argument(name, object);
  return {values.data(), values.data() + values.rows()};
}

XtfFile xtf_from(const ArrayLike& amplitude, const std::vector<std::string>& beam_names,
                 const py::typing::Dict<py::str, ArrayLike>& given, double slant_range,
                 double frequency, bool geographic, double amplitude_step,
                 const std::string& sonar_name) {
  SidescanPings pings;
  pings.beam_names = beam_names;
  pings.amplitude = amplitudes(amplitude, pings);
  for (const auto& [name, column] : columns()) {
    pings.*column = numbers_of(name, given[name]);
  }
  const std::size_t count = pings.count();
  for (std::size_t k = 0; k < count; ++k) pings.number.push_back(static_cast<std::int64_t>(k));
  pings.slant_range.assign(count * static_cast<std::size_t>(pings.rows()), slant_range);
  pings.frequency = frequency;
  pings.geographic = geographic;
  pings.amplitude_step = amplitude_step;
  pings.sonar_name = sonar_name;
  return xtf_of(pings);
}

}  // namespace

void bind_xtf(py::module_& module) {
  py::class_<SidescanPings>(module, "SidescanPings",
                            "Side-scan pings of an XTF file, NaN where it says nothing.")
      .def_property_readonly("amplitude", &amplitude_of,
                             "(pings, beams, samples) near to far; shorter rows end in NaN.")
      .def_readonly("beam_names", &SidescanPings::beam_names, "\"port\", \"starboard\".")
      .def_property_readonly(
          "slant_range",
          [](const SidescanPings& p) {
            return to_numpy(std::vector<double>(p.slant_range), {p.rows()});
          },
          "(pings, beams) [m].")
      .def_property_readonly(
          "column",
          [](const SidescanPings& p) {
            py::typing::Dict<py::str, py::array> all;
            for (const auto& [name, column] : columns()) {
              all[name] = to_numpy(std::vector<double>(p.*column));
            }
            return all;
          },
          "(pings,) arrays by name: time since 1970 [s], x, y, depth, altitude [m], heading, "
          "pitch, "
          "roll [rad], speed, sound_speed [m/s].")
      .def_readonly("geographic", &SidescanPings::geographic,
                    "Whether x is longitude and y latitude [rad].")
      .def_readonly("frequency", &SidescanPings::frequency, "[Hz]")
      .def_readonly("amplitude_step", &SidescanPings::amplitude_step,
                    "What a step of the file's samples means.")
      .def_readonly("sonar_name", &SidescanPings::sonar_name, "As the file has it.");
  py::class_<XtfFile>(module, "XtfFile", kXtfDoc)
      .def_property_readonly(
          "ping_count", [](const XtfFile& f) { return f.ping_count(); }, "Sonar pings.")
      .def_property_readonly(
          "channels",
          [](const XtfFile& f) {
            py::typing::List<py::tuple> all;
            for (int c = 0; c < static_cast<int>(kXtfChannels); ++c) {
              if (f.bytes_per_sample(c) == 0) continue;
              all.append(py::make_tuple(c, f.channel_type(c), f.channel_name(c), f.frequency(c),
                                        f.bytes_per_sample(c)));
            }
            return all;
          },
          "(number, type, name, frequency [Hz], bytes a sample) of each; type 1 is port, 2 "
          "starboard.")
      .def_readonly("other_packets", &XtfFile::other_packets,
                    "How many of each type that is no sonar ping.")
      .def_readonly("damaged", &XtfFile::damaged, "Packets whose sizes contradict each other.")
      .def_readonly("lost_bytes", &XtfFile::lost_bytes,
                    "Outside of any packet, or in a damaged one.")
      .def("sidescan", &sidescan_of, "Its side-scan pings.")
      .def("to_bytes", &formatted, "The file again.");
  module.def("parse_xtf", &parse, py::arg("data"), kParseDoc);
  module.def(
      "make_xtf", &xtf_from, py::arg("amplitude"), py::arg("beam_names"), py::arg("columns"),
      py::kw_only(), py::arg("slant_range"), py::arg("frequency"), py::arg("geographic") = false,
      py::arg("amplitude_step") = 0.0, py::arg("sonar_name") = "bathyal",
      "An XTF file of side-scan pings, 16 bits a sample; `columns` as `SidescanPings.column`, "
      "`amplitude_step` 0 finds one so that the largest amplitude has the highest step.");
}

}  // namespace bathyal::python

// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "arrays.hpp"
#include "bathyal/base/check.hpp"
#include "bathyal/sonar/backscatter.hpp"
#include "bathyal/sonar/echo.hpp"
#include "bathyal/sonar/presets.hpp"
#include "bathyal/sonar/survey.hpp"
#include "bathyal/world/world.hpp"
#include "bindings.hpp"
#include "enum_names.hpp"
#include "sonar_docs.hpp"
#include "sonar_fields.hpp"
#include "warnings.hpp"

namespace bathyal::python {
namespace {

struct PingTruth {
  py::array range, incidence, material, point;
};

/// One ping, after the receiver.
struct Ping {
  py::array intensity, range;
  std::optional<PingTruth> truth;
  std::vector<std::string> beam_names, warnings, notes;
  double time = 0.0, altitude = 0.0, sound_speed = 0.0;
  std::int64_t clipped = 0;
  bool dropped = false;
};

py::array in_rows(std::vector<double> values, const Echo& echo,
                  std::vector<py::ssize_t> tail = {}) {
  tail.insert(tail.begin(), echo.samples);
  return to_numpy(std::move(values), std::move(tail));
}

std::vector<double> sample_middles(const SonarOptions& options) {
  std::vector<double> middles;
  for (int i = 0; i < options.samples; ++i) middles.push_back((i + 0.5) * options.sample_length());
  return middles;
}

std::vector<std::string> beam_names(const SonarOptions& options) {
  std::vector<std::string> names;
  for (const Beam& beam : beams_of(options)) names.push_back(beam.name);
  return names;
}

using PresetMaker = SonarOptions (*)();

EnumNames<PresetMaker> presets() {
  return {{"side_scan", side_scan_sonar},
          {"side_scan_100khz", side_scan_100khz_sonar},
          {"paper_side_scan", paper_side_scan_sonar},
          {"multibeam", multibeam_sonar},
          {"echo_sounder", echo_sounder_sonar},
          {"paper_forward_sounders", paper_forward_sounders},
          {"imaging", imaging_sonar},
          {"scanning", scanning_sonar}};
}

Ping made_ping(const Sonar& sonar, double time, Echo echo, Received received) {
  Ping made;
  made.intensity = in_rows(std::move(received.intensity), echo);
  made.range = to_numpy(sample_middles(sonar.options()));
  if (!echo.truth.range.empty()) {
    made.truth.emplace();
    made.truth->range = in_rows(std::move(echo.truth.range), echo);
    made.truth->incidence = in_rows(std::move(echo.truth.incidence), echo);
    made.truth->material = to_numpy(std::move(echo.truth.material), {echo.samples});
    made.truth->point = in_rows(std::move(echo.truth.point), echo, {3});
  }
  made.beam_names = beam_names(sonar.options());
  made.warnings = std::move(echo.warnings);
  made.notes = std::move(echo.notes);
  made.clipped = received.clipped;
  made.dropped = received.dropped;
  made.time = time;
  made.altitude = echo.altitude;
  made.sound_speed = echo.sound_speed;
  return made;
}

Vec3 rate_argument(std::string_view name, const py::object& object) {
  return object.is_none() ? Vec3(Vec3::Zero()) : vector_argument(name, object);
}

/// σ₀ of a material at angles, by the law that a sonar takes.
py::array backscatter_of(const Sonar& sonar, const World& world, const std::string& material,
                         const ArrayLike& incidence) {
  Material law = world.materials()[static_cast<std::size_t>(world.material_row(material))];
  if (sonar.options().backscatter == BackscatterModel::kLambert) {
    law.angle.clear();
    law.backscatter.clear();
    law.sediment.reset();
  }
  const Values angles = values_argument("incidence", incidence);
  std::vector<double> values;
  for (Index i = 0; i < angles.rows(); ++i) {
    const double angle = angles.data()[i];
    check_range("incidence", angle, 0.0, 0.5 * std::numbers::pi);
    values.push_back(backscatter(law, std::max(std::cos(angle), 0.0), sonar.options().frequency));
  }
  return to_numpy(std::move(values));
}

Ping ping_of(const Sonar& sonar, const std::shared_ptr<World>& world, const ArrayLike& pose,
             double time, const OptionalArray& velocity, const OptionalArray& angular_velocity,
             std::uint64_t seed, std::int64_t ping, bool truth, int num_threads) {
  const Pose world_from_vehicle = given_pose_argument("world_from_vehicle", pose);
  const VehicleMotion motion{rate_argument("velocity", velocity),
                             rate_argument("angular_velocity", angular_velocity)};
  Echo echo;
  Received received;
  {
    const py::gil_scoped_release unlocked;
    echo = sonar.echo(world->at(time, num_threads), world->water(), world_from_vehicle, ping,
                      num_threads, motion, truth);
    const SonarOptions& options = sonar.options();
    const Pose world_from_sonar =
        world_from_vehicle * options.vehicle_from_sonar * head_pose(options, ping);
    received = receive(options, echo, {seed, world_from_sonar, time}, num_threads);
  }
  for (const std::string& warning : echo.warnings) warn_user(warning);
  return made_ping(sonar, time, std::move(echo), std::move(received));
}

using KeepPing = py::typing::Callable<py::bool_(Ping, py::int_, py::array)>;

void hear(const Sonar& sonar, const std::shared_ptr<World>& world, const Trajectory& trajectory,
          const KeepPing& keep, std::uint64_t seed, std::int64_t first, std::int64_t count,
          bool truth, int num_threads) {
  const py::gil_scoped_release unlocked;
  survey(
      sonar, *world, trajectory, seed, {first, count},
      [&](SurveyPing&& one) {
        const py::gil_scoped_acquire locked;
        const Pose pose = one.world_from_vehicle;
        return py::cast<bool>(
            keep(made_ping(sonar, one.time, std::move(one.echo), std::move(one.received)),
                 one.number, to_numpy(pose)));
      },
      num_threads, truth);
}

void bind_ping(py::module_& module) {
  py::class_<PingTruth>(module, "PingTruth", sonar_docs::kPingTruth)
      .def_readonly("range", &PingTruth::range, "(beams, samples) one-way from the sonar [m].")
      .def_readonly("incidence", &PingTruth::incidence,
                    "(beams, samples) from the surface's normal [rad].")
      .def_readonly(
          "material", &PingTruth::material,
          "(beams, samples) row of `World.materials`, −1 where nothing was hit, −2 of the sea "
          "surface.")
      .def_readonly("point", &PingTruth::point, "(beams, samples, 3) in the world [m].");
  py::class_<Ping>(module, "Ping", sonar_docs::kPing)
      .def_readonly("intensity", &Ping::intensity,
                    "(beams, samples) received power over transmitted at 1 m.")
      .def_readonly("range", &Ping::range, "(samples,) slant range of their middles [m].")
      .def_property_readonly(
          "truth",
          [](const Ping& p) {
            if (!p.truth) throw_argument("truth", "a ping heard with truth=True", "one without");
            return *p.truth;
          },
          "PingTruth: of each sample, what contributed most; a `ValueError` without it.")
      .def_readonly("beam_names", &Ping::beam_names, "Of the rows.")
      .def_readonly("time", &Ping::time, "[s]")
      .def_readonly("altitude", &Ping::altitude,
                    "Of the sonar over what lies straight below [m]; NaN where nothing does.")
      .def_readonly("sound_speed", &Ping::sound_speed, "At the sonar [m/s].")
      .def_readonly("clipped", &Ping::clipped, "Samples at full scale.")
      .def_readonly("dropped", &Ping::dropped, "Whether the ping brought nothing.")
      .def_readonly("warnings", &Ping::warnings, "As text.")
      .def_readonly("notes", &Ping::notes, "What it rests on, as \"extrapolated: …\".")
      .def("__repr__", [](const Ping& p) {
        return "Ping(" + std::to_string(p.intensity.shape(0)) + " beams, " +
               std::to_string(p.intensity.shape(1)) + " samples)";
      });
}

void add_fields(py::class_<Sonar>& cls) {
  for (const auto& [name, doc] : sonar_docs::fields()) {
    sonar_field(name).add(cls, doc.c_str());
  }
}

}  // namespace

void bind_sonar(py::module_& module) {
  bind_ping(module);
  py::class_<Sonar> cls(module, "Sonar", sonar_docs::kSonar);
  cls.def_static(
         "preset",
         [](const std::string& name, const std::string& physics) {
           const SonarOptions options = enum_argument("name", name, presets())();
           const EnumNames<bool> kinds{{"off", false}, {"real", true}};
           return Sonar(enum_argument("physics", physics, kinds) ? with_real_physics(options)
                                                                 : options);
         },
         py::arg("name"), py::arg("physics") = "off", sonar_docs::kPreset)
      .def(
          "replace",
          [](const Sonar& sonar, const py::KWArgs<SonarValue>& fields) {
            return Sonar(replaced(sonar.options(), fields));
          },
          sonar_docs::kReplace)
      .def(
          "to_dict", [](const Sonar& sonar) { return sonar_to_dict(sonar.options()); },
          "Every field's value by its name.")
      .def_static(
          "from_dict",
          [](const SonarValues& fields) { return Sonar(replaced(SonarOptions(), fields)); },
          py::arg("fields"), "The sonar that `to_dict` describes.")
      .def("ping", &ping_of, py::arg("world").none(false), py::arg("world_from_vehicle"),
           py::arg("time") = 0.0, py::kw_only(), py::arg("velocity") = py::none(),
           py::arg("angular_velocity") = py::none(), py::arg("seed") = 0, py::arg("ping") = 0,
           py::arg("truth") = true, py::arg("num_threads") = 0, sonar_docs::kPingCall)
      .def("scattering_strength", &backscatter_of, py::arg("world"), py::arg("material"),
           py::arg("incidence"), sonar_docs::kBackscatter)
      .def("hear", &hear, py::arg("world").none(false), py::arg("trajectory"), py::arg("keep"),
           py::kw_only(), py::arg("seed") = 0, py::arg("first") = 0, py::arg("count") = -1,
           py::arg("truth") = true, py::arg("num_threads") = 0, sonar_docs::kHear)
      .def(
          "ping_times",
          [](const Sonar& sonar, const Trajectory& trajectory) {
            return to_numpy(ping_times(sonar.options(), trajectory));
          },
          py::arg("trajectory"), "Times of a survey's pings along a trajectory [s].")
      .def_property_readonly(
          "ray_count", [](const Sonar& s) { return s.ray_count(); }, "Rays of a ping.")
      .def_property_readonly(
          "beam_names", [](const Sonar& s) { return beam_names(s.options()); }, "Of the rows.")
      .def(
          "__eq__",
          [](const Sonar& a, const Sonar& b) {
            return py::repr(sonar_to_dict(a.options())).equal(py::repr(sonar_to_dict(b.options())));
          },
          py::is_operator())
      .def("__hash__",
           [](const Sonar& s) { return py::hash(py::repr(sonar_to_dict(s.options()))); })
      .def("__repr__",
           [](const Sonar& s) {
             const SonarOptions& o = s.options();
             return "Sonar(" + o.name + ": " + to_text(o.frequency / 1e3) + " kHz, " +
                    std::to_string(o.beams) + (o.beams == 1 ? " beam, " : " beams, ") +
                    to_text(o.range) + " m)";
           })
      .def(py::pickle(
          [](const Sonar& s) { return sonar_to_dict(s.options()); },
          [](const py::dict& fields) { return Sonar(replaced(SonarOptions(), fields)); }));
  add_fields(cls);
}

}  // namespace bathyal::python

// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "bathyal/base/check.hpp"
#include "bathyal/workspace/reach/reach_map.hpp"
#include "bathyal/workspace/reach/standpoint.hpp"
#include "workspace_class.hpp"
#include "workspace_reach_docs.hpp"

namespace bathyal::python {
namespace {

using SharedMap = std::shared_ptr<const ReachMap>;

std::vector<py::ssize_t> map_shape(const ReachMap& map) {
  return {map.count[0], map.count[1], map.count[2]};
}

py::array map_flags(const SharedMap& map, const std::vector<std::uint8_t>& flags,
                    std::vector<py::ssize_t> shape) {
  return read_only_array(reinterpret_cast<const bool*>(flags.data()), std::move(shape), map);
}

/// (nx, ny, nz[, K]) of any real type as numbers of `Value`, whose shape is that of `like` if it
/// has one.
template <class Value>
std::vector<Value> map_values(const char* name, const py::object& object,
                              const std::vector<py::ssize_t>& shape) {
  const py::array given = array_argument(name, object, "an array of real numbers");
  const std::vector<py::ssize_t> got(given.shape(), given.shape() + given.ndim());
  if (got != shape) {
    throw_argument(name, "shape " + std::string(py::str(py::cast(shape))),
                   std::string(py::str(py::cast(got))));
  }
  const auto values = py::array_t<Value, py::array::c_style | py::array::forcecast>::ensure(given);
  if (!values) throw py::error_already_set();
  return {values.data(), values.data() + values.size()};
}

std::vector<std::uint8_t> flag_values(const char* name, const py::object& object,
                                      const std::vector<py::ssize_t>& shape) {
  const py::array given = array_argument(name, object, "an array of bool");
  if (given.dtype().kind() != 'b') {
    throw_argument(name, "an array of bool", std::string(py::str(given.dtype())));
  }
  return map_values<std::uint8_t>(name, given, shape);
}

std::shared_ptr<ReachMap> made_map(const ArrayLike& origin, double voxel, const ArrayLike& approach,
                                   const ArrayLike& reached_along, const ArrayLike& reached,
                                   const ArrayLike& free, const ArrayLike& manipulability,
                                   const ArrayLike& clearance) {
  auto map = std::make_shared<ReachMap>();
  map->origin = vector_argument("origin", origin);
  check_positive("voxel", voxel);
  map->voxel = voxel;
  const Points vectors = points_argument("approach", approach);
  for (Index k = 0; k < vectors.rows(); ++k) {
    map->approach.emplace_back(vectors.view().row(k).transpose());
    if (!(std::abs(map->approach.back().norm() - 1.0) < 1e-9)) {
      throw_argument("approach", "unit vectors", "another length in row " + std::to_string(k));
    }
  }
  if (map->approach.size() > 255) {
    throw_argument("approach", "at most 255 rows", std::to_string(map->approach.size()));
  }
  const py::array cells = array_argument("reached", reached, "an (nx, ny, nz) array of bool");
  if (cells.ndim() != 3) {
    throw_argument("reached", "three dimensions", std::to_string(cells.ndim()));
  }
  for (int k = 0; k < 3; ++k) {
    if (cells.shape(k) > 1 << 20) {
      throw_argument("reached", "at most 2^20 voxels along an axis",
                     std::to_string(cells.shape(k)));
    }
    map->count[k] = static_cast<int>(cells.shape(k));
  }
  const std::vector<py::ssize_t> shape = map_shape(*map);
  std::vector<py::ssize_t> long_shape = shape;
  long_shape.push_back(static_cast<py::ssize_t>(map->approach.size()));
  map->reached = flag_values("reached", reached, shape);
  map->free = flag_values("free", free, shape);
  map->reached_along = flag_values("reached_along", reached_along, long_shape);
  map->manipulability = map_values<float>("manipulability", manipulability, shape);
  map->clearance = map_values<float>("clearance", clearance, shape);
  for (std::size_t v = 0; v < map->total(); ++v) {
    const auto first = map->reached_along.begin() + static_cast<Index>(v * map->approach.size());
    const auto count =
        std::count(first, first + static_cast<Index>(map->approach.size()), std::uint8_t{1});
    map->directions.push_back(static_cast<std::uint8_t>(count));
    if (map->reached[v] == 0 && (map->free[v] != 0 || count > 0)) {
      throw_argument("reached", "true where it is free, or reached along a direction",
                     "false in voxel " + std::to_string(v));
    }
  }
  return map;
}

void bind_map(py::module_& module) {
  py::class_<ReachMap, std::shared_ptr<ReachMap>>(module, "ReachMap", workspace_docs::kReachMap)
      .def(py::init(&made_map), py::kw_only(), py::arg("origin"), py::arg("voxel"),
           py::arg("approach"), py::arg("reached_along"), py::arg("reached"), py::arg("free"),
           py::arg("manipulability"), py::arg("clearance"))
      .def_property_readonly(
          "origin", [](const ReachMap& map) { return to_numpy(map.origin); },
          "(3,) corner of the first voxel, in the vehicle's frame [m].")
      .def_readonly("voxel", &ReachMap::voxel, "Edge of a voxel [m].")
      .def_property_readonly(
          "approach",
          [](const ReachMap& map) {
            std::vector<double> rows;
            for (const Vec3& d : map.approach) rows.insert(rows.end(), d.begin(), d.end());
            return to_numpy(std::move(rows), {3});
          },
          "(K, 3) unit vectors along which the tool's z axis points, in the vehicle's frame.")
      .def_property_readonly(
          "reached",
          [](const SharedMap& map) { return map_flags(map, map->reached, map_shape(*map)); },
          "(nx, ny, nz) bool: whether a posture within the limits brings the tip to the voxel's "
          "middle, in any orientation, whatever the arm touches.")
      .def_property_readonly(
          "free", [](const SharedMap& map) { return map_flags(map, map->free, map_shape(*map)); },
          "(nx, ny, nz) bool: whether one of the postures found keeps clear of obstacles and of "
          "the "
          "arm itself, the end of the tool allowed to touch the scene.")
      .def_property_readonly(
          "reached_along",
          [](const SharedMap& map) {
            std::vector<py::ssize_t> shape = map_shape(*map);
            shape.push_back(static_cast<py::ssize_t>(map->approach.size()));
            return map_flags(map, map->reached_along, std::move(shape));
          },
          "(nx, ny, nz, K) bool: whether the tip reaches the middle with the tool's z axis along "
          "each direction of `approach`; of an arm of fewer than five coordinates, with the axis "
          "nearest to it. Collisions are not looked at.")
      .def_property_readonly(
          "directions",
          [](const SharedMap& map) {
            return read_only_array(map->directions.data(), map_shape(*map), map);
          },
          "(nx, ny, nz) uint8: how many of them.")
      .def_property_readonly(
          "manipulability",
          [](const SharedMap& map) {
            return read_only_array(map->manipulability.data(), map_shape(*map), map);
          },
          "(nx, ny, nz) float32: greatest √det(J Jᵀ) (Yoshikawa 1985) of the postures found with "
          "the tip in the voxel; nan where it is not reached.")
      .def_property_readonly(
          "clearance",
          [](const SharedMap& map) {
            return read_only_array(map->clearance.data(), map_shape(*map), map);
          },
          "(nx, ny, nz) float32: greatest clearance of the postures looked at, at most eleven and "
          "no more once one is free [m]; nan where it is not reached or was not asked for.")
      .def("__repr__", [](const ReachMap& map) {
        return "ReachMap(" + std::to_string(map.count[0]) + " x " + std::to_string(map.count[1]) +
               " x " + std::to_string(map.count[2]) + ", voxel=" + to_text(map.voxel) + " m, " +
               std::to_string(std::ranges::count(map.reached, 1)) + " reached, " +
               std::to_string(std::ranges::count(map.free, 1)) + " free)";
      });
}

/// One place of an answer; the first has the others as alternatives.
struct StandpointView {
  std::shared_ptr<const Standpoint> all;
  std::size_t place = 0;
  std::size_t targets = 0;

  const StandpointPlace* here() const {
    return place < all->places.size() ? &all->places[place] : nullptr;
  }
};

void bind_standpoint(py::module_& module) {
  using View = StandpointView;
  py::class_<View>(module, "Standpoint", workspace_docs::kStandpoint)
      .def_property_readonly(
          "status", [](const View& v) { return std::string(to_text(v.all->status)); },
          "Of the best one: \"all\" targets are reached, or \"some\"; else why there is none: "
          "\"no_reach\" (the arm always touches its hull, keep-outs or itself), \"no_room\" "
          "(wherever a target would be reached the hull is too near to bottom or keep-outs), "
          "\"blocked\" (no target is free from the places checked).")
      .def_property_readonly(
          "reason", [](const View& v) { return v.all->reason; }, "The same as a sentence.")
      .def_property_readonly(
          "pose",
          [](const View& v) -> py::typing::Optional<py::array> {
            if (v.here() == nullptr) return py::none();
            return to_numpy(v.here()->world_from_vehicle);
          },
          "(4, 4) world_from_vehicle, level; None where there is none.")
      .def_property_readonly(
          "score", [](const View& v) { return v.here() == nullptr ? 0.0 : v.here()->score; },
          "Number of targets reached and their mean margin, in (0, 1); 0 where none is reached.")
      .def_property_readonly(
          "reached",
          [](const View& v) {
            auto flags = std::make_shared<std::vector<std::uint8_t>>(v.targets, std::uint8_t{0});
            if (v.here() != nullptr) *flags = v.here()->reached;
            return read_only_array(reinterpret_cast<const bool*>(flags->data()),
                                   {static_cast<py::ssize_t>(flags->size())}, flags);
          },
          "(N,) bool: whether check_target says \"free\" of each target.")
      .def_property_readonly(
          "alternatives",
          [](const View& v) {
            std::vector<View> others;
            for (std::size_t k = 1; v.place == 0 && k < v.all->places.size(); ++k) {
              others.push_back({v.all, k, v.targets});
            }
            return others;
          },
          "List of the next best, at least 0.2 m or 20 degrees away from better ones; theirs are "
          "empty.")
      .def("__bool__", [](const View& v) { return v.here() != nullptr; })
      .def("__repr__", [](const View& v) {
        if (v.here() == nullptr) {
          return "Standpoint(" + std::string(to_text(v.all->status)) + ": " + v.all->reason + ")";
        }
        return "Standpoint(" + std::to_string(std::ranges::count(v.here()->reached, 1)) + " of " +
               std::to_string(v.targets) + " reached, score " + to_text(v.here()->score) + ")";
      });
}

using CapsuleNames = py::typing::Optional<py::typing::Dict<py::str, py::typing::List<Capsule>>>;
using LinkNames = py::typing::List<py::typing::Tuple<py::str, py::str>>;

StandpointView find_standpoint(const Arm& arm, const OptionalArray& mount,
                               const std::optional<Hull>& hull, const std::optional<Scene>& scene,
                               const ArrayLike& targets, const std::vector<KeepOut>& keepouts,
                               const OptionalArray& radii, const CapsuleNames& capsules,
                               const LinkNames& allowed, const StandpointOptions& options) {
  const Points points = points_argument("targets", targets);
  // The class reads what makes the arm's body.
  const py::object made = py::type::of<Workspace>()(
      arm, mount, py::arg("hull") = hull, py::arg("scene") = scene, py::arg("keepouts") = keepouts,
      py::arg("radii") = radii, py::arg("capsules") = capsules, py::arg("allowed") = allowed);
  const Surroundings around = made.cast<const Workspace&>().surroundings();
  const py::gil_scoped_release release;
  return {std::make_shared<Standpoint>(best_standpoint(arm, around, points.view(), options)), 0,
          static_cast<std::size_t>(points.rows())};
}

}  // namespace

void bind_reach(py::module_& module) {
  bind_map(module);
  bind_standpoint(module);
}

void add_reach(py::class_<Workspace>& cls) {
  const ReachMapOptions defaults;
  cls.def(
      "reach_map",
      [](const Workspace& ws, double voxel, int directions, Index samples, std::uint64_t seed,
         bool check_clearance, int num_threads) {
        const py::gil_scoped_release release;
        return std::make_shared<ReachMap>(
            reach_map(ws, {voxel, directions, samples, seed, check_clearance, num_threads}));
      },
      py::kw_only(), py::arg("voxel") = defaults.voxel, py::arg("directions") = defaults.directions,
      py::arg("samples") = defaults.samples, py::arg("seed") = defaults.seed,
      py::arg("check_clearance") = defaults.check_clearance,
      py::arg("num_threads") = defaults.num_threads, workspace_docs::kWorkspaceReachMap);
}

void bind_best_standpoint(py::module_& module) {
  const StandpointOptions defaults;
  module.def(
      "best_standpoint",
      [](const Arm& arm, const OptionalArray& mount, const std::optional<Hull>& hull,
         const std::optional<Scene>& scene, const ArrayLike& targets,
         const std::vector<KeepOut>& keepouts, const OptionalArray& radii,
         const CapsuleNames& capsules, const LinkNames& allowed, double voxel, int headings,
         double step, double hull_clearance, int refined, int alternatives, std::uint64_t seed,
         int num_threads) {
        return find_standpoint(
            arm, mount, hull, scene, targets, keepouts, radii, capsules, allowed,
            {voxel, headings, step, hull_clearance, refined, alternatives, seed, num_threads});
      },
      py::arg("arm"), py::arg("mount"), py::arg("hull"), py::arg("scene"), py::arg("targets"),
      py::kw_only(), py::arg("keepouts") = py::list(), py::arg("radii") = py::none(),
      py::arg("capsules") = py::none(), py::arg("allowed") = py::list(),
      py::arg("voxel") = defaults.voxel, py::arg("headings") = defaults.headings,
      py::arg("step") = defaults.step, py::arg("hull_clearance") = defaults.hull_clearance,
      py::arg("refined") = defaults.refined, py::arg("alternatives") = defaults.alternatives,
      py::arg("seed") = defaults.seed, py::arg("num_threads") = defaults.num_threads,
      workspace_docs::kBestStandpoint);
}

}  // namespace bathyal::python

// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <string>

#include "bathyal/world/generate/solids.hpp"
#include "bindings.hpp"
#include "enum_names.hpp"
#include "generate.hpp"

namespace bathyal::python {
namespace {

constexpr const char* kMakeBoulderDoc = R"(An angular boulder, at rest on z = 0.

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
)";

constexpr const char* kMakeMineDoc = R"(A mine, at rest on z = 0, its middle over the origin.

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
)";

constexpr const char* kMakeFishDoc = R"(A fish, nose to +x, back up, its middle at the origin.

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
)";

constexpr const char* kMakeWreckDoc = R"(A sunken ship, bow to +x, at rest on z = 0.

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
)";

const EnumNames<MineKind>& mine_kinds() {
  static const EnumNames<MineKind> names{{"cylinder", MineKind::kCylinder},
                                         {"sphere", MineKind::kSphere},
                                         {"manta", MineKind::kManta}};
  return names;
}

}  // namespace

void bind_solids(py::module_& module) {
  const BoulderOptions b;
  module.def(
      "make_boulder",
      [](double radius, std::uint64_t seed, double roughness, int subdivisions) {
        return make_boulder(radius, {seed, roughness, subdivisions});
      },
      py::arg("radius"), py::kw_only(), py::arg("seed") = b.seed,
      py::arg("roughness") = b.roughness, py::arg("subdivisions") = b.subdivisions,
      kMakeBoulderDoc);
  const MineOptions m;
  module.def(
      "make_mine",
      [](const std::string& kind, std::optional<double> diameter, std::optional<double> length,
         int horns, int sides) {
        return make_mine(enum_argument("kind", kind, mine_kinds()),
                         {diameter, length, horns, sides});
      },
      py::arg("kind") = mine_kinds().front().first, py::kw_only(), py::arg("diameter") = m.diameter,
      py::arg("length") = m.length, py::arg("horns") = m.horns, py::arg("sides") = m.sides,
      kMakeMineDoc);
  module.def(
      "make_fish", [](double length, int sides) { return make_fish(length, {sides}); },
      py::arg("length"), py::kw_only(), py::arg("sides") = FishOptions().sides, kMakeFishDoc);
  const WreckOptions w;
  module.def(
      "make_wreck",
      [](double length, std::uint64_t seed, double beam, double depth, double thickness,
         double list, bool broken, int holes, double spacing) {
        const py::gil_scoped_release release;
        return make_wreck(length, {seed, beam, depth, thickness, list, broken, holes, spacing});
      },
      py::arg("length"), py::kw_only(), py::arg("seed") = w.seed, py::arg("beam") = w.beam,
      py::arg("depth") = w.depth, py::arg("thickness") = w.thickness, py::arg("list") = w.list,
      py::arg("broken") = w.broken, py::arg("holes") = w.holes, py::arg("spacing") = w.spacing,
      kMakeWreckDoc);
}

}  // namespace bathyal::python

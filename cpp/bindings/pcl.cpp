// SPDX-License-Identifier: BSD-3-Clause
// The optional extension bathyal._pcl: what needs PCL, apart from the engine so that only its users
// load PCL and VTK.
#include "arrays.hpp"
#include "bathyal/identify/registration.hpp"
#include "bathyal/terrain/greedy.hpp"
#include "call_errors.hpp"

PYBIND11_MODULE(_pcl, module) {
  using namespace bathyal;
  using namespace bathyal::python;
  using Options = GreedyOptions;
  module.doc() =
      "What needs PCL: `bathyal.triangulate(cloud, method=\"greedy\")` and "
      "`bathyal.verify_arm(…, pairing=\"icp\")`.";
  module.def(
      "triangulate_greedy",
      [](const ArrayLike& points, double search_radius, double mu, int max_neighbours,
         double max_surface_angle, double min_angle, double max_angle, bool normal_consistency,
         int normal_neighbours) {
        const Points array = points_argument("points", points);
        Greedy result;
        {
          const py::gil_scoped_release release;
          result = greedy(array.view(), {.search_radius = search_radius,
                                         .mu = mu,
                                         .max_neighbours = max_neighbours,
                                         .max_surface_angle = max_surface_angle,
                                         .min_angle = min_angle,
                                         .max_angle = max_angle,
                                         .normal_consistency = normal_consistency,
                                         .normal_neighbours = normal_neighbours});
        }
        return to_numpy(result.triangles);
      },
      py::arg("points"), py::kw_only(), py::arg("search_radius") = Options{}.search_radius,
      py::arg("mu") = Options{}.mu, py::arg("max_neighbours") = Options{}.max_neighbours,
      py::arg("max_surface_angle") = Options{}.max_surface_angle,
      py::arg("min_angle") = Options{}.min_angle, py::arg("max_angle") = Options{}.max_angle,
      py::arg("normal_consistency") = Options{}.normal_consistency,
      py::arg("normal_neighbours") = Options{}.normal_neighbours,
      R"(PCL's greedy projection triangulation, made safe (Marton, Rusu, Beetz 2009).

Parameters
----------
points : (N, 3) array
    [m], finite; three or more that are not on one line.
search_radius : float
    Radius in which a point looks for neighbours, so also the longest edge [m]; 0 takes 6 times the
    median distance of a point to its nearest neighbour.
mu : float
    The radius of each point is at most so many times the distance to its nearest neighbour.
max_neighbours : int
    Candidates considered around a point.
max_surface_angle : float
    Points whose normals differ by more are not joined [rad].
min_angle, max_angle : float
    Wished for in a triangle [rad].
normal_consistency : bool
    Whether the normals are all taken as turned to the same side.
normal_neighbours : int
    Points that a normal is fitted to.

Returns
-------
(T, 3) int32 array
    Rows of `points`, turned consistently and up (outward, where a piece is closed).
)");

  module.def(
      "pair_by_icp",
      [](const ArrayLike& predicted, const ArrayLike& measured, int max_iterations) {
        const Points from = points_argument("predicted", predicted);
        const Points onto = points_argument("positions", measured);
        std::vector<Index> pairs;
        {
          const py::gil_scoped_release release;
          pairs = pair_by_icp(from.view(), onto.view(), {.max_iterations = max_iterations});
        }
        return to_numpy(std::move(pairs));
      },
      py::arg("predicted"), py::arg("positions"), py::kw_only(),
      py::arg("max_iterations") = IcpOptions{}.max_iterations,
      R"(Which measured position lies nearest to each predicted one (Besl, McKay 1992).

Parameters
----------
predicted, positions : (N, 3) and (M, 3) arrays
    [m]; three rows or more of each. Their centroids are laid upon each other first.
max_iterations : int

Returns
-------
(N,) int array
    Rows of `positions`, each once.
)");
  guard_calls(module);
}

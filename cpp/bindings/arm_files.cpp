// SPDX-License-Identifier: BSD-3-Clause
#include "arm_class.hpp"

#include <utility>

namespace bathyal::python {
namespace {

namespace py = pybind11;

template <class... Arguments>
py::object call(const char* module, const char* function, Arguments&&... arguments) {
  return py::module_::import(module).attr(function)(std::forward<Arguments>(arguments)...);
}

}  // namespace

void add_arm_files(py::class_<Arm>& cls) {
  cls.def_static(
         "from_urdf",
         [](const py::object& path, const py::object& tip, const py::object& root,
            const py::object& name) {
           return call("bathyal.arm.urdf_reader", "arm_from_urdf", path, py::arg("tip") = tip,
                       py::arg("root") = root, py::arg("name") = name)
               .cast<Arm>();
         },
         py::arg("path"), py::kw_only(), py::arg("tip") = py::none(), py::arg("root") = py::none(),
         py::arg("name") = py::none(),
         "An arm from one path of a URDF's tree (bathyal.arm.urdf_reader.arm_from_urdf).")
      .def(
          "to_urdf",
          [](const py::object& arm, const py::object& path) {
            return call("bathyal.arm.urdf_writer", "urdf_of_arm", arm, path).cast<py::str>();
          },
          py::arg("path") = py::none(),
          "The arm as the text of a URDF, written to `path` too "
          "(bathyal.arm.urdf_writer.urdf_of_arm).")
      .def(
          "save",
          [](const py::object& arm, const py::object& path) {
            call("bathyal.arm.files", "save_arm", arm, path);
          },
          py::arg("path"),
          "Write all of it to a .json file, for bathyal.read_arm (bathyal.arm.files.save_arm).")
      .def(
          "write",
          [](const py::object& arm, const py::object& path, const py::object& nominal) {
            call("bathyal.arm.files", "write_arm", arm, path, py::arg("nominal") = nominal);
          },
          py::arg("path"), py::kw_only(), py::arg("nominal") = py::none(),
          "Write a .json, .urdf, .yaml or .conf file (bathyal.arm.files.write_arm).")
      .def(
          "show",
          [](const py::object& arm, const py::object& q) {
            return call("bathyal.view.arm_views", "show_arm", arm, q);
          },
          py::arg("q") = py::none(), "An interactive figure (bathyal.view.arm_views.show_arm).")
      .def(
          "plot",
          [](const py::object& arm, const py::object& q, const py::object& path) {
            return call("bathyal.view.arm_views", "plot_arm", arm, q, path);
          },
          py::arg("q") = py::none(), py::arg("path") = py::none(),
          "A picture, written to `path` too (bathyal.view.arm_views.plot_arm).");
}

}  // namespace bathyal::python

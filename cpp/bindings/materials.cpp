// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/world/material.hpp"

#include <pybind11/stl.h>

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/base/text.hpp"
#include "world_docs.hpp"
#include "world_parts.hpp"

namespace bathyal::python {
namespace {

py::tuple sediment_values(const Sediment& s) {
  return py::make_tuple(s.density_ratio, s.speed_ratio, s.loss, s.volume, s.spectral_exponent,
                        s.spectral_strength);
}

py::tuple material_values(const Material& m) {
  const py::object sediment =
      m.sediment ? py::object(sediment_values(*m.sediment)) : py::object(py::none());
  return py::make_tuple(m.name, m.strength, m.angle, m.backscatter, sediment);
}

Sediment sediment_of(const py::tuple& state) {
  return {state[0].cast<double>(), state[1].cast<double>(), state[2].cast<double>(),
          state[3].cast<double>(), state[4].cast<double>(), state[5].cast<double>()};
}

Material material_of(const py::tuple& state) {
  using Numbers = std::vector<double>;
  Material material{state[0].cast<std::string>(), state[1].cast<double>(), state[2].cast<Numbers>(),
                    state[3].cast<Numbers>(), std::nullopt};
  if (!state[4].is_none()) material.sediment = sediment_of(state[4]);
  material.check();
  return material;
}

std::vector<double> list_of(std::string_view name, const py::object& object) {
  if (object.is_none()) return {};
  const Values values = values_argument(name, object);
  return {values.data(), values.data() + values.rows()};
}

py::typing::Optional<py::array> column(const std::vector<double>& values) {
  if (values.empty()) return py::none();
  return to_numpy(std::vector<double>(values));
}

std::string material_text(const Material& m) {
  std::string text = "Material(\"" + m.name + "\"";
  if (!m.angle.empty()) return text + ", table of " + std::to_string(m.angle.size()) + " angles)";
  text += m.strength > 0.0 ? ", " + three_digits(10.0 * std::log10(m.strength)) + " dB" : ", 0";
  return text + (m.sediment ? ", sediment)" : ")");
}

void bind_sediment(py::module_& module) {
  const Sediment d;
  py::class_<Sediment>(module, "Sediment", world_docs::kSediment)
      .def(py::init([](double density_ratio, double speed_ratio, double loss, double volume,
                       double spectral_exponent, double spectral_strength) {
             Material checked;
             checked.name = "sediment";
             checked.sediment = Sediment{density_ratio, speed_ratio,       loss,
                                         volume,        spectral_exponent, spectral_strength};
             checked.check();
             return *checked.sediment;
           }),
           py::kw_only(), py::arg("density_ratio") = d.density_ratio,
           py::arg("speed_ratio") = d.speed_ratio, py::arg("loss") = d.loss,
           py::arg("volume") = d.volume, py::arg("spectral_exponent") = d.spectral_exponent,
           py::arg("spectral_strength") = d.spectral_strength)
      .def_readonly("density_ratio", &Sediment::density_ratio, "Of the bottom over the water.")
      .def_readonly("speed_ratio", &Sediment::speed_ratio,
                    "Sound speed of the bottom over that of the water.")
      .def_readonly("loss", &Sediment::loss, "Imaginary over real wave number.")
      .def_readonly("volume", &Sediment::volume,
                    "Scattering in the volume over its absorption, σ₂.")
      .def_readonly("spectral_exponent", &Sediment::spectral_exponent,
                    "Of the relief's spectrum, γ.")
      .def_readonly("spectral_strength", &Sediment::spectral_strength,
                    "Of the relief's spectrum, w₂ [cm⁴].")
      .def(
          "__eq__",
          [](const Sediment& a, const Sediment& b) {
            return sediment_values(a).equal(sediment_values(b));
          },
          py::is_operator())
      .def("__hash__", [](const Sediment& s) { return py::hash(sediment_values(s)); })
      .def("__repr__",
           [](const Sediment& s) {
             return "Sediment(density_ratio=" + to_text(s.density_ratio) +
                    ", speed_ratio=" + to_text(s.speed_ratio) + ")";
           })
      .def(py::pickle(&sediment_values, &sediment_of));
}

}  // namespace

Material material_argument(const std::string& name, double strength, const OptionalArray& angle,
                           const OptionalArray& backscatter, const OptionalSediment& sediment) {
  Material material{name, strength, list_of("angle", angle), list_of("backscatter", backscatter),
                    std::nullopt};
  if (!sediment.is_none()) {
    if (!py::isinstance<Sediment>(sediment)) {
      throw_argument("sediment", "a Sediment",
                     std::string(py::str(py::type::handle_of(sediment).attr("__name__"))));
    }
    material.sediment = sediment.cast<Sediment>();
  }
  material.check();
  return material;
}

void bind_materials(py::module_& module) {
  bind_sediment(module);
  py::class_<Material>(module, "Material", world_docs::kMaterial)
      .def(py::init(&material_argument), py::arg("name"), py::arg("strength") = 1.0, py::kw_only(),
           py::arg("angle") = py::none(), py::arg("backscatter") = py::none(),
           py::arg("sediment") = py::none())
      .def_readonly("name", &Material::name, "Of the material.")
      .def_readonly("strength", &Material::strength, "μ of Lambert's law σ₀ = μ cos²θ, linear.")
      .def_property_readonly(
          "angle", [](const Material& m) { return column(m.angle); },
          "(K,) angles of incidence of its table [rad], or None.")
      .def_property_readonly(
          "backscatter", [](const Material& m) { return column(m.backscatter); },
          "(K,) σ₀ of its table [dB], or None.")
      .def_readonly("sediment", &Material::sediment, "Sediment, or None.")
      .def(
          "__eq__",
          [](const Material& a, const Material& b) {
            return material_values(a).equal(material_values(b));
          },
          py::is_operator())
      .def("__hash__", [](const Material& m) { return py::hash(py::repr(material_values(m))); })
      .def("__repr__", &material_text)
      .def(py::pickle(&material_values, &material_of));
}

}  // namespace bathyal::python

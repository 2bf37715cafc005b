// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include "arrays.hpp"
#include "bathyal/base/page_array.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/scene/scene.hpp"

namespace bathyal::python {

using HitArray = PageArray<RayHit>;

/// Answers of Scene.cast. Range, mesh and triangle are columns of one array and cost nothing to
/// look at; what is computed from the meshes is computed at the first access, and kept.
class Hits {
 public:
  using Surface = std::variant<Scene, TriangleMesh>;

  Hits(std::shared_ptr<const HitArray> hits, Surface surface)
      : hits_(std::move(hits)), surface_(std::move(surface)) {}

  std::size_t size() const { return hits_->size(); }
  const RayHit* begin() const { return hits_->begin(); }
  const RayHit* end() const { return hits_->end(); }

  template <class Scalar>
  py::array column(Scalar RayHit::*member) const {
    const RayHit* data = hits_->data();
    static const RayHit no_hit;  // numpy wants an address for no rows as well
    const Scalar* first = &((data == nullptr ? &no_hit : data)->*member);
    auto* holder = new std::shared_ptr<const HitArray>(hits_);
    const py::capsule base(
        holder, [](void* p) { delete static_cast<std::shared_ptr<const HitArray>*>(p); });
    py::array_t<Scalar> array({static_cast<py::ssize_t>(size())},
                              {static_cast<py::ssize_t>(sizeof(RayHit))}, first, base);
    array.attr("setflags")(py::arg("write") = false);
    return array;
  }

  py::array point() const {
    return kept(point_,
                [](const auto& surface, const RayHit& hit) { return hit_point(surface, hit); });
  }

  py::array normal() const {
    return kept(normal_,
                [](const auto& surface, const RayHit& hit) { return hit_normal(surface, hit); });
  }

  py::array barycentric() const {
    return kept(barycentric_, [](const auto&, const RayHit& hit) {
      if (hit.triangle < 0) return Vec3(Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
      return Vec3(hit.u, hit.v, 1.0 - hit.u - hit.v);
    });
  }

 private:
  template <class Compute>
  py::array kept(py::object& array, const Compute& compute) const {
    if (array) return array;
    std::vector<double> rows(3 * size());
    {
      const py::gil_scoped_release release;
      std::visit(
          [&](const auto& surface) {
            parallel_for(size(), 16384, 0, [&](std::size_t first, std::size_t last) {
              for (std::size_t i = first; i < last; ++i) {
                Eigen::Map<Vec3>(rows.data() + 3 * i) = compute(surface, (*hits_)[i]);
              }
            });
          },
          surface_);
    }
    array = to_numpy(std::move(rows), {3});
    return array;
  }

  std::shared_ptr<const HitArray> hits_;
  Surface surface_;
  mutable py::object point_, normal_, barycentric_;
};

/// Hits, intersect_moller_trumbore: what rays give back and what needs no scene.
void bind_hits(py::module_& module);

/// Scene.cast and Scene.occluded.
void bind_rays(py::class_<Scene>& scene);

}  // namespace bathyal::python

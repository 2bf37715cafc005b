// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/world/generate/seabed.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "bathyal/base/check.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/world/generate/internal/seabed_parts.hpp"

namespace bathyal {
namespace {

constexpr double kMostSquares = 5e7;
constexpr double kFurthestPlace = 1e7;       // [m]
constexpr std::size_t kColumnsAtOnce = 256;  // their sines stay in the cache

/// Vertices along one side.
struct Axis {
  Index count = 0;  ///< of vertices, one more than squares
  double spacing = 0.0;
  double first = 0.0;  ///< in squares from zero, or where `exact` is false [m]
  bool exact = false;

  double at(Index i) const {
    return exact ? (first + static_cast<double>(i)) * spacing
                 : first + static_cast<double>(i) * spacing;
  }
};

Axis divide_side(double size, double spacing, double middle) {
  Axis axis;
  const double squares = std::max(1.0, std::ceil(size / spacing * (1.0 - 1e-12)));
  axis.count = static_cast<Index>(squares) + 1;
  axis.spacing = size / squares;
  const double half = std::round(2.0 * middle / axis.spacing - squares);
  axis.exact = std::abs(2.0 * middle / axis.spacing - squares - half) < 1e-6;
  axis.first = axis.exact ? 0.5 * half : middle - 0.5 * size;
  return axis;
}

void check_seabed_grid(const Vec2& size, double spacing, const Vec2& origin,
                       const SeabedOptions& options) {
  for (const double side : size) {
    if (!(side > 0.0 && side <= kFurthestPlace)) {
      throw_argument("size", "sides above 0, 10⁷ m at most", to_text(side) + " m");
    }
  }
  check_positive("spacing", spacing);
  for (const double value : origin) check_range("origin", value, -kFurthestPlace, kFurthestPlace);
  const double squares = std::ceil(size.x() / spacing) * std::ceil(size.y() / spacing);
  if (!(squares <= kMostSquares)) {
    throw_argument("spacing", "no more than 5·10⁷ squares in all (make a larger bottom in tiles)",
                   to_text(spacing) + " m, " + to_text(squares) + " squares");
  }
  if (options.ripple_height > 0.0 && options.ripple_wavelength < 2.0 * spacing) {
    throw_argument(
        "spacing",
        "half of ripple_wavelength (" + to_text(options.ripple_wavelength) + " m) at most",
        to_text(spacing) + " m");
  }
}

void check_seabed_places(const Values& x, const Values& y) {
  if (x.rows() != y.rows()) {
    throw_argument("y", std::to_string(x.rows()) + " values, as x has", std::to_string(y.rows()));
  }
  for (const auto& [name, values] : {std::pair{"x", &x}, {"y", &y}}) {
    for (Index i = 0; i < values->rows(); ++i) {
      if (std::abs(values->data()[i]) <= kFurthestPlace) continue;
      throw_argument(name, "finite numbers, 10⁷ m at most",
                     to_text(values->data()[i]) + " in row " + std::to_string(i));
    }
  }
}

TriangleMatrix grid_triangles(Index columns, Index rows, int num_threads) {
  TriangleMatrix triangles(2 * (columns - 1) * (rows - 1), 3);
  parallel_for(static_cast<std::size_t>(rows - 1), 64, num_threads,
               [&](std::size_t begin, std::size_t end) {
                 for (auto j = static_cast<Index>(begin); j < static_cast<Index>(end); ++j) {
                   for (Index i = 0; i + 1 < columns; ++i) {
                     const auto a = static_cast<std::int32_t>(j * columns + i);
                     const auto b = a + static_cast<std::int32_t>(columns);
                     const Index row = 2 * (j * (columns - 1) + i);
                     triangles.row(row) << a, a + 1, b + 1;
                     triangles.row(row + 1) << a, b + 1, b;
                   }
                 }
               });
  return triangles;
}

}  // namespace

SeabedModel::SeabedModel(const SeabedOptions& options) {
  options.check();
  parts_ = std::make_shared<const Parts>(options);
}

const SeabedOptions& SeabedModel::options() const { return parts_->options; }

Values SeabedModel::height(const Values& x, const Values& y) const {
  check_seabed_places(x, y);
  Values::Matrix height(x.rows());
  parallel_for(static_cast<std::size_t>(x.rows()), 1024, options().num_threads,
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t i = begin; i < end; ++i) {
                   const double px = x.data()[i];
                   const double py = y.data()[i];
                   height(static_cast<Index>(i)) =
                       parts_->place(px, py, parts_->fields(px, py)).height;
                 }
               });
  return height;
}

std::vector<std::int16_t> SeabedModel::material(const Values& x, const Values& y) const {
  check_seabed_places(x, y);
  std::vector<std::int16_t> material(static_cast<std::size_t>(x.rows()));
  parallel_for(
      material.size(), 1024, options().num_threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const double px = x.data()[i];
          const double py = y.data()[i];
          material[i] =
              static_cast<std::int16_t>(parts_->place(px, py, parts_->fields(px, py)).material);
        }
      });
  return material;
}

TriangleMesh SeabedModel::mesh(const Vec2& size, double spacing, const Vec2& origin) const {
  check_seabed_grid(size, spacing, origin, options());
  const Axis across = divide_side(size.x(), spacing, origin.x());
  const Axis along = divide_side(size.y(), spacing, origin.y());
  PointMatrix vertices(across.count * along.count, 3);
  Values::Matrix material(vertices.rows());
  for (Index start = 0; start < across.count; start += Index{kColumnsAtOnce}) {
    std::vector<double> x;
    for (Index i = start; i < std::min(across.count, start + Index{kColumnsAtOnce}); ++i) {
      x.push_back(across.at(i));
    }
    const Parts::Columns columns = parts_->columns(x);
    const auto fill = [&](std::size_t begin, std::size_t end) {
      std::vector<Parts::Fields> fields(x.size());
      for (auto j = static_cast<Index>(begin); j < static_cast<Index>(end); ++j) {
        const double y = along.at(j);
        parts_->row(columns, y, fields);
        for (std::size_t i = 0; i < x.size(); ++i) {
          const Parts::Place place = parts_->place(x[i], y, fields[i]);
          const Index row = j * across.count + start + static_cast<Index>(i);
          vertices.row(row) << x[i], y, place.height;
          material(row) = static_cast<double>(place.material);
        }
      }
    };
    parallel_for(static_cast<std::size_t>(along.count), 16, options().num_threads, fill);
  }
  return TriangleMesh(std::move(vertices),
                      grid_triangles(across.count, along.count, options().num_threads),
                      {{"material", Values(std::move(material))}});
}

TriangleMesh make_seabed(const Vec2& size, double spacing, const SeabedOptions& options,
                         const Vec2& origin) {
  return SeabedModel(options).mesh(size, spacing, origin);
}

std::vector<std::int16_t> triangle_material(const TriangleMesh& mesh) {
  const auto found = mesh.attributes().find("material");
  if (found == mesh.attributes().end()) {
    throw_argument("mesh", "one with an attribute \"material\", as make_seabed gives",
                   "one without");
  }
  const double* material = found->second.data();
  std::vector<std::int16_t> kinds(static_cast<std::size_t>(mesh.triangle_count()));
  for (std::size_t t = 0; t < kinds.size(); ++t) {
    const auto corners = mesh.triangles().row(static_cast<Index>(t));
    const double a = material[corners(0)], b = material[corners(1)], c = material[corners(2)];
    const double middle = std::max(std::min(a, b), std::min(std::max(a, b), c));
    if (!(middle >= 0.0 && middle < static_cast<double>(kSeabedMaterials.size()))) {
      throw_argument("mesh", "values of \"material\" from 0 to 2",
                     to_text(middle) + " at triangle " + std::to_string(t));
    }
    kinds[t] = static_cast<std::int16_t>(middle);
  }
  return kinds;
}

}  // namespace bathyal

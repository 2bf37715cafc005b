// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Eigenvalues>
#include <cmath>

#include "bathyal/base/check.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/vehicle/tree/body_tree.hpp"

namespace bathyal {
namespace {

constexpr double kRounding = 1e-9;  // of the largest entry, of a unit vector

void check_link_water(const std::string& of, const TreeLink& link) {
  if (!link.added_mass.allFinite()) throw_argument(of + "added_mass", "finite numbers", "others");
  const double scale = link.added_mass.cwiseAbs().maxCoeff();
  if ((link.added_mass - link.added_mass.transpose()).cwiseAbs().maxCoeff() > kRounding * scale) {
    throw_argument(of + "added_mass", "a symmetric (6, 6) matrix", "one that is not");
  }
  const double least = Eigen::SelfAdjointEigenSolver<Mat6>(link.added_mass).eigenvalues()[0];
  if (least < -kRounding * scale) {
    throw_argument(of + "added_mass", "a matrix without negative eigenvalues", to_text(least));
  }
  for (const DragStrip& strip : link.strips) {
    if (!strip.center.allFinite()) throw_argument(of + "strips", "finite centres", "others");
    if (!(std::abs(strip.axis.norm() - 1.0) < kRounding)) {
      throw_argument(of + "strips", "unit axes", "one of length " + to_text(strip.axis.norm()));
    }
    check_not_negative(of + "strips", strip.coefficient);
  }
}

}  // namespace

void TreeLink::check(std::string_view owner) const {
  const std::string of = std::string(owner) + " ";
  check_rigid(of + "parent_from_link", parent_from_link);
  if (!axis.allFinite() || !(axis.norm() > 0.0)) {
    throw_argument(of + "axis", "a finite direction, not zero", "another");
  }
  body.check(owner);
  check_link_water(of, *this);
}

void BodyTreeOptions::check() const {
  vehicle.check();
  if (links.size() > BodyTree::kMostLinks) {
    throw_argument("links", "at most " + std::to_string(BodyTree::kMostLinks),
                   std::to_string(links.size()));
  }
  for (std::size_t k = 0; k < links.size(); ++k) {
    const std::string owner = "link " + std::to_string(k);
    links[k].check(owner);
    if (links[k].parent < -1 || links[k].parent >= static_cast<int>(k)) {
      throw_argument(owner + " parent", "-1 (the hull) or an earlier link",
                     std::to_string(links[k].parent));
    }
  }
  if (!tip.allFinite()) throw_argument("tip", "finite numbers", "others");
}

}  // namespace bathyal

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <vector>

#include "bathyal/arm/row_frames.hpp"
#include "bathyal/effects/gravity_load.hpp"
#include "bathyal/effects/internal/library.hpp"

// Links, and the support of the arm, that bend under its weight.

namespace bathyal::effects {
namespace {

constexpr double kNothing = 1e-12;  ///< [N m] or [m], above rounding errors

/// They bend alike, and data hardly distinguish them.
const char* const kBending = "bending";

bool differs(const RowMatrix& values) {
  const Eigen::RowVectorXd range = values.colwise().maxCoeff() - values.colwise().minCoeff();
  return range.maxCoeff() > kNothing;
}

GravityLoads loads_of(const EffectData& data) {
  return {data, GravityLoads::Bodies::kArm, payload_of(data)};
}

/// Links, each from its joint's origin to the next one's, which the rows do not determine: their
/// frames slide along the axes as neighbouring axes tilt. Where links have frames of their own, as
/// those of a URDF, a joint's origin is the point of its axis next to the origin of the frame of
/// the link that it moves; else that of the frame before its row. That of a sliding joint moves
/// with its link, which is as long wherever it is slid to; a column that extends is clamped where
/// its slide is 0. The last link ends in the flange.
class BeamAxes {
 public:
  explicit BeamAxes(const Arm& arm) {
    const std::vector<Link>& links = arm.links();
    const bool own_frames = std::any_of(links.begin() + 1, links.end(), [](const Link& link) {
      return link.row_from_link.matrix() != Pose::Identity().matrix();
    });
    std::vector<Vec3> before, behind;  // origins, at value 0 of the joint
    for (std::size_t k = 0; k < arm.joints().size(); ++k) {
      const Joint& joint = arm.joints()[k];
      const Pose pose = row_pose(joint.row, joint.type, 0.0);
      const double along_axis =
          own_frames ? (pose * links[k + 1].row_from_link.translation()).z() : 0.0;
      before.push_back(along_axis * Vec3::UnitZ());
      behind.push_back(pose.inverse() * before.back());
    }
    for (std::size_t k = 0; k < before.size(); ++k) {
      end.push_back(k + 1 < before.size() ? before[k + 1] : arm.flange().translation());
      beam.push_back(end.back() - behind[k]);
    }
  }

  // Of each row, in the frame behind it.
  std::vector<Vec3> end;
  std::vector<Vec3> beam;  ///< from its beginning to its end
};

class LinkCompliance final : public Effect {
 public:
  bool needs_weight(const EffectVariant&) const override { return true; }

  EffectInfo info() const override {
    return {
        .name = "link_compliance",
        .description = "a link, or a column, that bends under what it carries",
        .formula =
            "end of the link: turn flexibility · |l| (M⊥ + l×F / 2), shift flexibility · |l| "
            "(M⊥×l / 2 + (l×F)×l / 3); l from the joint's origin to the next one's (the flange), "
            "of "
            "a column that extends longer by the value of its sliding joint, F "
            "and M force and moment there of all that lies beyond, flexibility 1 / (E I)",
        .source =
            "cantilever of Euler and Bernoulli, as in Timoshenko: Strength of materials, 1930; "
            "Khalil, Besnard: Geometric calibration of robots with flexible joints and links, 2002",
        .ranges = {{.parameter = "flexibility", .unit = "1/(N m²)", .low = 1e-8, .high = 1e-2}},
        .extrapolates = true};
  }
  std::string describe(const EffectVariant& variant, const Arm& arm) const override {
    const bool extends = variant.settings.contains("extends");
    return (extends ? "the column that " : "the link that ") + describe_joint(variant.joint, arm) +
           (extends ? " extends" : " moves") + " bending under its load";
  }

  std::vector<EffectVariant> variants(const EffectData& data) const override {
    std::vector<EffectVariant> out;
    if (!masses_known(*data.arm) && !data.has("payload")) return out;
    const GravityLoads loads = loads_of(data);
    for (int row = 0; row < static_cast<int>(data.arm->joints().size()); ++row) {
      const bool slides = data.arm->joints()[row].type == JointType::kPrismatic;
      for (const bool extends : {false, true}) {
        if ((extends && !slides) || !differs(bend(data, loads, row, extends))) continue;
        constexpr double kOrdinaryFlexibility = 1e-5;
        out.push_back({"link_compliance",
                       data.arm->joints()[row].coordinate,
                       {{"row", row}},
                       {{"flexibility", "1/(N m²)", kOrdinaryFlexibility}},
                       kBending});
        if (extends) out.back().settings["extends"] = 1.0;
      }
    }
    return out;
  }

  Perturbations perturbations(const EffectVariant& variant, const EffectData& data) const override {
    const auto rows = static_cast<Index>(data.arm->joints().size());
    const int row = index_of(variant, "row", rows);
    const bool extends = variant.settings.contains("extends");
    return {{{PerturbationSite::kFrame, row + 1, bend(data, loads_of(data), row, extends)}}};
  }

 private:
  /// (N, 6) shift and turn of the frame behind `row`, per flexibility.
  static RowMatrix bend(const EffectData& data, const GravityLoads& loads, int row, bool extends) {
    RowMatrix out(data.rows(), 6);
    const BeamAxes axes(*data.arm);
    const Vec3 at = axes.end[row];
    const Joint& joint = data.arm->joints()[row];
    for (Index i = 0; i < data.rows(); ++i) {
      const Pose& to = loads.frames(i).world_from_row[row + 1];
      const Vec3 end = to * at;
      Vec3 link = axes.beam[row];
      if (extends) {
        const Pose& from = loads.frames(i).world_from_row[row];
        link += (joint.multiplier * data.q(i, joint.coordinate) + joint.offset) *
                (to.linear().transpose() * from.linear().col(2));
      }
      const double length = link.norm();
      // The link itself is link row + 1: the load at its end starts with the next one.
      const GravityLoad load = loads.beyond(i, static_cast<std::size_t>(row) + 2, end);
      const Vec3 force = to.linear().transpose() * load.force;
      Vec3 moment = to.linear().transpose() * load.moment;
      if (length > 0.0) moment -= moment.dot(link) / (length * length) * link;
      const Vec3 bent = link.cross(force);
      const Vec3 shift = length * (0.5 * moment.cross(link) + bent.cross(link) / 3.0);
      const Vec3 turn = length * (moment + 0.5 * bent);
      out.row(i) << (shift - turn.cross(at)).transpose(), turn.transpose();
    }
    return out;
  }
};

class BaseCompliance final : public Effect {
 public:
  bool needs_weight(const EffectVariant&) const override { return true; }

  EffectInfo info() const override {
    return {
        .name = "base_compliance",
        .description = "a support that tilts under the arm's weight as the arm reaches out",
        .formula =
            "base turned by (compliance_x · M_x, compliance_y · M_y, 0), M the moment of the "
            "weight "
            "of links and payload about the base",
        .source =
            "Khalil, Besnard: Geometric calibration of robots with flexible joints and links, 2002 "
            "(an elastic joint before the first row)",
        .ranges = {{.parameter = "compliance_x", .unit = "rad/(N m)", .low = 1e-9, .high = 1e-4},
                   {.parameter = "compliance_y", .unit = "rad/(N m)", .low = 1e-9, .high = 1e-4}},
        .extrapolates = true};
  }
  std::string describe(const EffectVariant&, const Arm&) const override {
    return "the base tilting under the arm's weight";
  }

  std::vector<EffectVariant> variants(const EffectData& data) const override {
    if (!masses_known(*data.arm) && !data.has("payload")) return {};
    const RowMatrix moments = moments_of(data);
    EffectVariant variant{"base_compliance", -1, {}, {}, kBending};
    for (int axis = 0; axis < 2; ++axis) {
      constexpr double kOrdinaryCompliance = 1e-6;
      if (!differs(moments.col(axis))) continue;
      variant.parameters.push_back(
          {axis == 0 ? "compliance_x" : "compliance_y", "rad/(N m)", kOrdinaryCompliance});
    }
    if (variant.parameters.empty()) return {};
    return {variant};
  }

  Perturbations perturbations(const EffectVariant& variant, const EffectData& data) const override {
    const RowMatrix moments = moments_of(data);
    Perturbations out;
    for (const EffectParameter& parameter : variant.parameters) {
      const int axis = parameter.name == "compliance_x" ? 0 : 1;
      out.push_back({move_frame(0, 3 + axis, moments.col(axis))});
    }
    return out;
  }

 private:
  /// (N, 3) about the origin of the base, of all links but the first, which rests on it.
  static RowMatrix moments_of(const EffectData& data) {
    const GravityLoads loads = loads_of(data);
    RowMatrix out(data.rows(), 3);
    for (Index i = 0; i < data.rows(); ++i) {
      out.row(i) = loads.beyond(i, 1, Vec3::Zero()).moment.transpose();
    }
    return out;
  }
};

}  // namespace

std::shared_ptr<const Effect> link_compliance() { return std::make_shared<LinkCompliance>(); }
std::shared_ptr<const Effect> base_compliance() { return std::make_shared<BaseCompliance>(); }

}  // namespace bathyal::effects

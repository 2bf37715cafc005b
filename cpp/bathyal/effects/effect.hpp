// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bathyal/arm/arm.hpp"
#include "bathyal/arm/row_frames.hpp"
#include "bathyal/effects/measurements.hpp"

// Errors of an arm that its geometric parameters cannot represent: an eccentric encoder, an elastic
// gear, a base that moved. Each effect of the library is linear in its parameters: a parameter
// perturbs something (a joint, a frame of the chain, the lengths) by its value times a number that
// depends on the pose, and this is all that identification and diagnosis use of it.

namespace bathyal {

/// What a perturbation acts on.
enum class PerturbationSite {
  kJoint,  ///< a coordinate q [rad] or [m]: added to what was recorded
  kFrame,  ///< a frame of the chain: a shift and a turn, expressed in that frame and appended to it
  kLength,  ///< a and d of every row, as a share of them
};

inline constexpr double kMaxPerturbation =
    1e100;  ///< per unit of a parameter: squares of more overflow

/// Effect of one parameter: what `site` names changes by the parameter times `values`.
struct Perturbation {
  PerturbationSite site = PerturbationSite::kJoint;
  /// Of kJoint: the coordinate. Of kFrame: 0 the arm's base (before `root`), k the frame behind row
  /// k - 1, rows + 1 the flange (behind `flange`, before the tool). Of kLength: not used.
  int index = 0;
  /// (N, 1); of kFrame (N, 6): shift x y z, turn x y z (a rotation vector, applied after the
  /// shift).
  RowMatrix values;
};

/// A number of an effect.
struct EffectParameter {
  std::string name;    ///< "cos"
  std::string unit;    ///< "rad"
  double scale = 1.0;  ///< a typical size of it, in its unit; above 0
};

/// One variant of an effect that the data allow: an order on a joint, a step at a moment.
struct EffectVariant {
  std::string effect;  ///< name of the effect: "joint_harmonic"
  int joint = -1;      ///< coordinate in error, or -1
  std::map<std::string, double>
      settings;  ///< what distinguishes this variant from others: {"order", 2}
  std::vector<EffectParameter> parameters;
  /// Variants of one alias group describe the same cause: a map and a harmonic of one joint.
  std::string alias_group;
};

/// Of an upright base, unless gravity is given [m/s²].
inline const Vec3 kGravity{0.0, 0.0, -9.80665};

/// Poses, and everything that an effect may depend on.
struct EffectData {
  const Arm* arm = nullptr;   ///< with its base, rows as far as known, and masses
  RowMatrix q;                ///< (N, n)
  Covariates covariates;      ///< those that were recorded, each (N, k)
  RowMatrix gravity;          ///< (N, 3) [m/s²], in the arm's base frame
  std::vector<int> order;     ///< (N,) rows in the order in which they were taken
  bool has_rotation = false;  ///< whether orientations were measured too
  /// Whether the rows are a recording, in the order in which they were taken; otherwise each is an
  /// independent pose to be predicted: a tool slip has happened, and without time joints are at
  /// rest.
  bool recording = true;

  Index rows() const { return q.rows(); }
  /// Whether it was recorded in every row (NaN is a row without it).
  bool has(std::string_view covariate) const;
  /// \pre has(covariate)
  const RowMatrix& covariate(std::string_view name) const;
};

/// Sets gravity, and the order of the rows by time, where time was recorded; `arm` must outlive the
/// result.
/// \throw std::invalid_argument for covariates of the library (temperature, time, payload,
///         direction, gravity, session, row) of another shape, or with values out of their range
EffectData make_effect_data(const Arm& arm, const RowMatrix& q, const Covariates& covariates,
                            bool has_rotation);

/// What is known of an effect, whatever its variant; one designated initializer each.
struct EffectInfo {
  std::string name;                     ///< as diagnosis names it
  std::string description;              ///< "a curve along one joint: …"
  std::string formula;                  ///< "q + c cos(k q) + s sin(k q)"
  std::string source;                   ///< paper or textbook
  std::vector<std::string> needs = {};  ///< covariates without which it is not observable
  struct Range {
    std::string parameter;
    std::string unit;
    double low = 0.0;   ///< least plausible size
    double high = 0.0;  ///< greatest plausible size: the standard deviation of the prior that
                        ///< diagnosis assumes; may be infinite
  };
  std::vector<Range> ranges = {};  ///< one for each unit at least
  /// Whether it depends on changes from row to row and not on the rows themselves: the ranges of
  /// the training data do not bound it.
  bool by_difference = false;
  /// Whether several of its variants may represent one cause together, as harmonics form a curve.
  bool combinable = false;
  /// Whether it follows from physics with known arguments (a torque, a temperature, a gear ratio):
  /// beyond the ranges of the training data it is extrapolated. Any other follows a curve that the
  /// data alone determine, and is held there. Effect::extrapolates tells variants apart.
  bool extrapolates = false;
};

/// An effect of the library, or a user's own.
class Effect {
 public:
  virtual ~Effect() = default;
  virtual EffectInfo info() const = 0;

  /// A variant for people: "a wave of order 2 along joint 3 (elbow)", joints counted from 1.
  virtual std::string describe(const EffectVariant& variant, const Arm& arm) const;

  /// All variants that these data could show; none where a covariate is missing or constant.
  /// Scanned variants (orders, moments) are given on the grid of the scan.
  virtual std::vector<EffectVariant> variants(const EffectData& data) const = 0;

  /// One perturbation or more for each parameter of `variant`, at the rows of `data`: [p] are those
  /// of parameter p. The values of a row depend on that row and the variant alone, so that a
  /// variant found in some data has the same meaning in others. (Speeds require neighbours in time;
  /// moments without times require the order.)
  virtual std::vector<std::vector<Perturbation>> perturbations(const EffectVariant& variant,
                                                               const EffectData& data) const = 0;

  /// The shortest length scale of its dependence on joint values, such as the period of a harmonic
  /// [rad] or [m]: in a wider gap between joint values the data do not constrain it. Infinite for
  /// what is smooth over the whole range of a joint.
  virtual double period(const EffectVariant& /*variant*/) const {
    return std::numeric_limits<double>::infinity();
  }

  /// Whether `variant` is extrapolated beyond the ranges of the training data: as its info says,
  /// unless it has variants of both kinds.
  virtual bool extrapolates(const EffectVariant& /*variant*/) const { return info().extrapolates; }

  /// Whether `variant` acts by the weight of the links and the recorded payload alone: an arm
  /// without masses that carries nothing does not feel it.
  virtual bool needs_weight(const EffectVariant& /*variant*/) const { return false; }

  /// Variants between two neighbours of a scan, in its order, for refinement; empty where there are
  /// none.
  virtual std::vector<EffectVariant> between(const EffectVariant& /*lower*/,
                                             const EffectVariant& /*upper*/,
                                             const EffectData& /*data*/) const {
    return {};
  }
};

/// The largest plausible size of a parameter: that of the first range in its unit; infinite where
/// none is given.
double plausible_size(const EffectInfo& info, const EffectParameter& parameter);

/// Effect::perturbations with their shapes checked, which covers users' effects too.
/// \throw std::invalid_argument for perturbations that violate the contract
std::vector<std::vector<Perturbation>> perturbations_of(const Effect& effect,
                                                        const EffectVariant& variant,
                                                        const EffectData& data);

/// The effects of the library, in a fixed order; users' effects are appended to it.
std::vector<std::shared_ptr<const Effect>> library_effects();

/// An effect with estimated values, as part of a corrected arm.
struct FoundEffect {
  std::shared_ptr<const Effect> effect;
  EffectVariant variant;
  Eigen::VectorXd values;  ///< of its parameters
};

}  // namespace bathyal

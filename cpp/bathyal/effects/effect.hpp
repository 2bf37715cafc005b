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

// What may be wrong with an arm beside its geometry: an encoder that is eccentric, a gear that
// gives way, a base that moved. Each effect of the library is linear in its parameters: a parameter
// moves something (a joint, a frame of the chain, the lengths) by itself times a number of the
// pose, which is all that identification and diagnosis need to know of it.

namespace bathyal {

/// What an action moves.
enum class Site {
  kJoint,   ///< a coordinate q [rad] or [m]: added to what was recorded
  kFrame,   ///< a frame of the chain: a shift and a turn, told in that frame, put in behind it
  kLength,  ///< a and d of every row, as a share of them
};

inline constexpr double kMostAction = 1e100;  ///< per unit of a parameter: squares of more overflow

/// What one parameter of an effect does: its site moves by the parameter times `values`.
struct Action {
  Site site = Site::kJoint;
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
  double scale = 1.0;  ///< an ordinary size of it, in its unit; above 0
};

/// One form of an effect that data allow: an order on a joint, a step at a moment.
struct EffectVariant {
  std::string effect;                      ///< name of the effect: "joint_harmonic"
  int joint = -1;                          ///< coordinate in error, or -1
  std::map<std::string, double> settings;  ///< what tells this form from others: {"order", 2}
  std::vector<EffectParameter> parameters;
  /// Variants of one cause are different words for one thing: a map and a harmonic of one joint.
  std::string cause;
};

/// Of a base that stands upright, where no other gravity was told [m/s²].
inline const Vec3 kGravity{0.0, 0.0, -9.80665};

/// Poses, and all that an effect may look at.
struct EffectData {
  const Arm* arm = nullptr;   ///< with its base, rows as far as they are known, and masses
  RowMatrix q;                ///< (N, n)
  Covariates covariates;      ///< those that were recorded, each (N, k)
  RowMatrix gravity;          ///< (N, 3) [m/s²], in the arm's base frame
  std::vector<int> order;     ///< (N,) rows in the order in which they were taken
  bool has_rotation = false;  ///< whether orientations were measured too
  /// Whether the rows are a recording, in the order in which they were taken; else each is a pose
  /// by itself, to be foretold: a tool that slipped has slipped, and without time nothing moves.
  bool recording = true;

  Index rows() const { return q.rows(); }
  /// Whether it was recorded in every row (NaN is a row without it).
  bool has(std::string_view covariate) const;
  /// \pre has(covariate)
  const RowMatrix& covariate(std::string_view name) const;
};

/// Fills in gravity, and the order of the rows by time, where time was recorded; `arm` must outlive
/// it.
/// \throw std::invalid_argument for covariates of the library (temperature, time, payload,
///        direction, gravity, session) of another shape, or with values that they cannot have
EffectData make_effect_data(const Arm& arm, const RowMatrix& q, const Covariates& covariates,
                            bool has_rotation);

/// What the docs say of an effect.
struct EffectInfo {
  std::string name;                ///< as diagnosis names it
  std::string words;               ///< "a curve along one joint: …", for people
  std::string formula;             ///< "q + c cos(k q) + s sin(k q)"
  std::string source;              ///< paper or textbook
  std::vector<std::string> needs;  ///< covariates without which it cannot be seen
  struct Range {
    std::string parameter;
    std::string unit;
    double low = 0.0;   ///< plausible sizes of it
    double high = 0.0;  ///< a value as large as this is one standard deviation of what diagnosis
                        ///< thinks of it before the data; may be infinite
  };
  std::vector<Range> ranges;  ///< one for each unit at least
  /// Whether it looks at what changes from row to row, not at where a row lies: the ranges of the
  /// data that taught it are no bounds to it.
  bool by_difference = false;
  /// Whether several of its forms may stand for one cause together, as waves make up a curve.
  bool adds_up = false;
};

/// An effect of the library, or a user's own.
class Effect {
 public:
  virtual ~Effect() = default;
  virtual EffectInfo info() const = 0;

  /// All forms that these data could show; empty where a covariate is missing or never changes.
  /// Forms that are scanned (orders, moments) come as the grid to scan.
  virtual std::vector<EffectVariant> variants(const EffectData& data) const = 0;

  /// One action or more for each parameter of `variant`, at the rows of `data`: [p] are those of
  /// parameter p. What a row gives follows from that row and the variant alone, so that a variant
  /// found in some data means the same in others. (Speeds need neighbours in time; moments without
  /// times, the order.)
  virtual std::vector<std::vector<Action>> actions(const EffectVariant& variant,
                                                   const EffectData& data) const = 0;

  /// The shortest stretch of joint values over which what it does comes and goes, the period of a
  /// wave [rad] or [m]: the data say nothing of what lies in a wider gap between them. Infinite for
  /// what is smooth over all of a joint's range.
  virtual double period(const EffectVariant& /*variant*/) const {
    return std::numeric_limits<double>::infinity();
  }

  /// Forms between two neighbours of a scan, in its order, for a closer look; empty where there is
  /// nothing between.
  virtual std::vector<EffectVariant> between(const EffectVariant& /*lower*/,
                                             const EffectVariant& /*upper*/,
                                             const EffectData& /*data*/) const {
    return {};
  }
};

/// The largest plausible size of a parameter: that of the first range in its unit; infinite where
/// none is told.
double plausible_size(const EffectInfo& info, const EffectParameter& parameter);

/// Effect::actions, and their shapes checked: users' effects too come through here.
/// \throw std::invalid_argument for actions that the contract does not allow
std::vector<std::vector<Action>> actions_of(const Effect& effect, const EffectVariant& variant,
                                            const EffectData& data);

/// The library, in a fixed order; users' effects stand behind it.
std::vector<std::shared_ptr<const Effect>> library_effects();

/// An effect that was found, with its values: what a corrected arm carries.
struct FoundEffect {
  std::shared_ptr<const Effect> effect;
  EffectVariant variant;
  Eigen::VectorXd values;  ///< of its parameters
};

}  // namespace bathyal

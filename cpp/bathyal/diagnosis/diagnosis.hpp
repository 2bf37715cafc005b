// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bathyal/selection/decisions.hpp"
#include "bathyal/selection/lack_of_fit.hpp"

namespace bathyal {

/// The conclusion of a diagnosis.
enum class Verdict {
  kNone,       ///< too few data for cross-validation: the lack of fit only
  kClean,      ///< nothing beyond noise
  kNamed,      ///< causes, each with its evidence
  kAmbiguous,  ///< causes that these data cannot distinguish
  kUnknown,    ///< structure that nothing in the library explains
};

/// A number with its 95 % interval.
struct Estimate {
  std::string name;
  std::string unit;
  double value = 0.0;
  double std = 0.0;
  double low = 0.0;
  double high = 0.0;
};

/// A cause by name, as in lists of alternatives.
struct Cause {
  std::string name;
  int joint = -1;           ///< coordinate, or -1
  std::string description;  ///< "a harmonic of order 2 along joint 3"
  double odds = 1.0;        ///< against the best explanation, in (0, 1]
};

/// A cause that was found, and its evidence.
struct NamedEffect {
  std::string name;
  int joint = -1;
  std::string description;
  std::vector<Estimate> parameters;
  std::vector<int> rows;         ///< of `outliers`: the rows
  double size = 0.0;             ///< rms contribution given all else that was fitted, per axis [m]
  double gain = 0.0;             ///< share of the held-out variance above noise that it explains
  double held_out_before = 0.0;  ///< rms (3-D) of held-out errors without it [m]
  double held_out_after = 0.0;   ///< with it [m]
  double p_value = 1.0;          ///< of its F test within the set, corrected for multiplicity
  int nested_folds = 0;          ///< of HeldOut::Nested: how many found the same in this joint
  std::vector<Cause> alternatives;  ///< the best other explanations of the same
};

/// What residuals depend on.
struct Dependence {
  enum class Kind {
    kNone,
    kPosition,  ///< of the tip
    kRange,     ///< of the tip from the instrument, the origin of measured positions
    kJoints,    ///< values of one joint, of two together, or of all
    kTime,      ///< a drift, or a vibration where `period` is given
    kOrder,     ///< of the rows, where no times are recorded
    kApproach,  ///< the direction of a joint's last move
    kSession,
    kCovariate,
  };
  Kind kind = Kind::kNone;
  std::vector<int> coordinates = {};  ///< of the joints, from 0, ascending
  std::optional<double> period = {};  ///< [s]
  std::string covariate = {};         ///< its name
  std::optional<int> component = {};  ///< column of a covariate that has several, from 0
};

/// "joint 3", "joints 2 and 3", "position", "time, period 12.1 s": joints counted from 1.
std::string to_text(const Dependence& dependence);

/// A lack-of-fit test: a dependence of the residuals, significant or not.
struct Structure {
  Dependence dependence;
  int joint = -1;           ///< coordinate that is in error; -1: the tip is
  std::string description;  ///< "what moves joint 4 with joints 2 and 3 together"
  double size = 0.0;        ///< rms per axis, less noise [m]
  double share = 0.0;       ///< of the residuals' variance, less noise
  double p_value = 1.0;     ///< corrected for multiplicity
  bool is_beyond_noise() const { return p_value <= selection::Decisions::kBeyondNoise; }
};

/// Cross-validation: what was held out, and the prediction errors.
struct HeldOut {
  std::string how;  ///< sentence: what one fold is
  int blocks = 0;
  double rms_before = 0.0;  ///< geometry alone, 3-D [m]
  double rms_after = 0.0;   ///< with the named effects, 3-D [m]
  double noise = 0.0;       ///< floor, 3-D [m]
  double p_value = 1.0;     ///< of the gain, by sign flips of folds
  struct Part {
    std::string name;  ///< "group east", "session 2", "point 0", "all"
    int rows = 0;
    double rms_before = 0.0;
    double rms_after = 0.0;
  };
  std::vector<Part> parts;
  Eigen::VectorXd before;  ///< (N,) prediction error by row, geometry alone [m]; NaN: not held out
  Eigen::VectorXd after;   ///< (N,) with the effects [m]

  /// Names, orders and sizes chosen anew without the rows that are predicted; in `rms_after` the
  /// values alone are.
  struct Nested {
    int folds = 0;                  ///< 0: was not asked for
    double rms = 0.0;               ///< 3-D, of the rows that `after` has [m]
    Eigen::VectorXd after;          ///< (N,) [m]; NaN: an outlier, or undetermined without its fold
    std::vector<Verdict> verdicts;  ///< (folds,)
  } nested;
};

}  // namespace bathyal

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <memory>
#include <span>
#include <string>
#include <vector>

// What diagnosis knows of a model and its measurement: rows, columns, names and groups. An arm is
// one such subject; sonars and vehicles may be others. For use inside the room.

namespace bathyal {

using Eigen::Index;

/// A way in which the model may be wrong: columns that change its residuals together.
struct Form {
  std::string effect;  ///< "joint_harmonic"; of a probe: what the structure is against
  int joint = -1;
  std::string cause;    ///< forms of one cause are words for one thing
  std::string words;    ///< for people
  double trials = 1.0;  ///< how many forms of its effect are tried beside it, itself counted
  bool plain = false;   ///< among its neighbours of a scan, the one to take when they fit alike
  bool shares = false;  ///< may stand beside others of its cause that it is not made of
  bool moves = false;   ///< along its scan, with every fit
  bool probe = false;   ///< shows that structure is there, and is no cause
};

/// What makes the noise of some rows larger than that of others, and one with another.
struct NoiseForm {
  std::string effect;
  std::string words;
  std::string parameter;  ///< standard deviation of its sources
  std::string unit;
  double trials = 1.0;
  Eigen::MatrixXd loads;  ///< (noise rows, k) what sources of their own, k in each unit, do [m]
  double known = 0.0;     ///< the parameter, where the record itself tells it; else 0
};

/// One measured thing (a pose) and what is known of it beside the model.
struct Units {
  std::vector<int> order;    ///< place of each in time
  bool timed = true;         ///< when each was measured is known; else `order` is that of a list
  std::vector<int> twin;     ///< units of one number are near-twins and are held out together
  std::vector<int> session;  ///< 0 …; all 0 when there is but one
  std::vector<int> point;    ///< the touched point, 0 …, or -1
  Index count() const { return static_cast<Index>(order.size()); }
};

/// Where a model stands: what it leaves, and what its own unknowns can do about it.
struct Linearization {
  Eigen::VectorXd misfit;  ///< (M,) measured less modelled by the base model, in units of noise
  Eigen::MatrixXd base;    ///< (M, b) d modelled / d unknowns of the base model
  std::vector<int> unit;   ///< (M,) the unit of each row; -1: a row that is always known
  Index noise_rows = 0;    ///< rows, from the first, that noise forms speak of
  double lost = 0.0;       ///< degrees of freedom that the rows lose beside the columns
};

/// Trust in a unit that is left out: its rows stay, and weigh nothing.
inline constexpr double kLeftOut = 1e-12;

/// A model that may be wrong, beside what was measured.
class Subject {
 public:
  virtual ~Subject() = default;
  virtual const Units& units() const = 0;

  /// In a fixed order; those of a scan are in `scans` too.
  virtual const std::vector<Form>& forms() const = 0;
  /// Positions in `forms` of families along one number (orders, moments, periods), in its order.
  virtual const std::vector<std::vector<int>>& scans() const = 0;
  virtual const std::vector<NoiseForm>& noise_forms() const = 0;

  /// Forms between `form` of a scan and its neighbours there, made on demand, or near it; empty
  /// where there are none.
  virtual std::vector<int> finer(int form) = 0;

  /// (M, k) of each of `forms`: d modelled / d parameters where the model stands, each parameter in
  /// units of the largest size that is plausible of it: that is the standard deviation of what is
  /// thought of it before the data. Safe to call from several threads.
  virtual std::vector<Eigen::MatrixXd> columns(std::span<const int> forms) const = 0;
  virtual const Linearization& linearization() const = 0;

  /// Fits the base model together with `forms` and stands there. A scanned form may move along its
  /// scan.
  virtual void settle(const std::vector<int>& forms) = 0;

  /// Where it stands, to come back to without a fit.
  struct Place {
    virtual ~Place() = default;
  };
  virtual std::shared_ptr<const Place> place() const = 0;
  virtual void return_to(const Place& place) = 0;

  /// Factors on the weight (1 / variance) of each unit; 0 leaves it out. Counts from the next
  /// `settle` on.
  virtual void set_trust(const Eigen::VectorXd& trust) = 0;
  /// (noise forms,) squares of their parameters over that of the noise which is the same for all
  /// [per m²]: rows weigh by what all of it makes of their errors. The same.
  virtual void set_noise_forms(const Eigen::VectorXd& ratios) = 0;
  /// Standard deviation of a position row where the model stands [m].
  virtual double noise() const = 0;
};

}  // namespace bathyal

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "bathyal/estimation/least_squares.hpp"
#include "bathyal/identify/model/chain_derivatives.hpp"

// Touches and tracked poses as residuals of an arm's columns. For use inside the room.

namespace bathyal {

enum class Criterion {
  kCentroid,  ///< each touch against the mean of its point
  kPairs,     ///< every pair of touches of a point (Yukhimets, Gubankov 2023, eq 7-9)
};

/// A linear statement about the columns: coefficients · (x - nominal) = 0 ± std. Columns behind the
/// last coefficient do not take part.
struct LinearRow {
  Eigen::VectorXd coefficients;
  double std = 1.0;
};

/// Standard deviation of one axis of a measurement of weight 1.
struct Noise {
  double position = 1e-4;  ///< [m]
  double rotation = 1e-4;  ///< [rad]
};

/// [m] or [rad]; exact data have no scale of their own, and none is taken to be better.
inline constexpr double kLeastNoise = 1e-9;

/// Residuals in units of their noise, in this order: positions (touches about their centroids, or
/// in pairs; distances from planes; tracked positions), rotations, known distances and points,
/// priors of the free columns, linear rows.
///
/// What is known of points is compared with their centroids, which the touches tell with a noise of
/// their own: it is counted in, so that the sum of squares is the likelihood that explicit unknown
/// points would give.
class ArmSystem final : public ResidualModel {
 public:
  ArmSystem(const ArmColumns& columns, const Measurement& measurement, Criterion criterion,
            bool pair_weights, int num_threads);

  const std::vector<int>& free() const { return free_; }
  void set_free(std::vector<int> free) { free_ = std::move(free); }
  void set_linear_rows(std::vector<LinearRow> rows) { linear_ = std::move(rows); }
  const std::vector<LinearRow>& linear_rows() const { return linear_; }
  void set_use_priors(bool use) { use_priors_ = use; }
  void set_criterion(Criterion criterion, bool pair_weights);

  /// Factors on the weights of the measurement, (N,): 0 leaves a row out.
  void set_trust(std::vector<double> trust) { trust_ = std::move(trust); }
  const std::vector<double>& trust() const { return trust_; }
  double weight(Index row) const { return m_.weights[row] * trust_[row]; }

  /// (N,) symmetric factors on position rows beside their weights, so that errors which are larger
  /// along one direction than another weigh alike; null: none. Of the centroids' criterion.
  using Whitening = std::shared_ptr<const std::vector<Eigen::Matrix3d>>;
  void set_row_whitening(Whitening whitening) { row_whitening_ = std::move(whitening); }
  const Whitening& row_whitening() const { return row_whitening_; }
  /// What an error of a position row is multiplied by [1/m].
  Eigen::Matrix3d row_factor(Index row) const;

  /// Also brings up to date what the noise of the centroids at `x` adds to known distances and
  /// points.
  void set_noise(const Noise& noise, const Eigen::VectorXd& x);
  const Noise& noise() const { return noise_; }
  /// Every measured row in units of `unit` [m] and [rad], known distances and points too.
  void set_equal_noise(double unit);

  /// The joint values to compute with, when they are not those of the measurement.
  void set_joints(const RowMatrix& q);

  Index rows() const override;
  Index columns() const override { return static_cast<Index>(free_.size()); }
  /// Rows of measurements only: they come first.
  Index data_rows() const { return position_rows() + rotation_rows() + known_rows(); }
  Index position_rows() const;
  Index rotation_rows() const { return m_.has_rotation() ? 3 * m_.rows() : 0; }
  Index known_rows() const;

  void evaluate(const double* y, double* residuals, double* jacobian) const override;
  Eigen::MatrixXd square(const double* y) const override;
  double cost(const double* y) const override;

  /// (rows, columns) at the values `x` of all columns.
  Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const;
  /// The rows of priors and linear rows alone: they are the same everywhere.
  Eigen::MatrixXd linear_jacobian() const;

  /// All columns' values for the free ones' `y`.
  Eigen::VectorXd values(const Eigen::VectorXd& y) const;
  Eigen::VectorXd scaled(const Eigen::VectorXd& x) const;

  /// Unweighted position residuals (3, N) [m]: tip minus centroid, or minus the measured place; of
  /// a plane's row along its normal.
  Eigen::Matrix3Xd deviations(const Eigen::VectorXd& x) const;
  /// Unweighted rotation residuals (3, N) [rad], of tracked poses.
  Eigen::Matrix3Xd turns(const Eigen::VectorXd& x) const;
  /// The touched points (3, n): weighted means of their touches, in the world.
  Eigen::Matrix3Xd centroids(const Eigen::VectorXd& x) const;

  const Measurement& measurement() const { return m_; }
  int num_threads() const { return num_threads_; }
  const ArmColumns& arm_columns() const { return columns_; }

 private:
  static constexpr std::size_t kPosesPerChunk = 256;

  Eigen::Matrix3Xd tips(const Eigen::VectorXd& x) const;
  /// A position row and its derivatives (null: none), `stride` from column to column.
  void whiten(Index row, double* error, double* jacobian, Index stride) const;
  /// Of an error of a position row [1 / noise²].
  Eigen::Matrix3d precision(Index row) const;
  /// (points,) of their centroids.
  std::vector<Eigen::Matrix3d> centroid_precisions() const;
  Eigen::Matrix3Xd centroids_of(const Eigen::Ref<const Eigen::Matrix3Xd>& tips) const;
  /// Where the numbers of a range of poses go; what is null is not wanted.
  struct TipRows {
    double* tips = nullptr;      ///< (3, n)
    double* jacobian = nullptr;  ///< (3 n, columns), `stride` from column to column
    double* rotations = nullptr;
    double* rotation_jacobian = nullptr;
    Index stride = 0;
  };
  void fill_tips(const TipWalk& walk, const TipRows& out) const;
  void fill_tips(const TipWalk& walk, Index begin, Index end, const TipRows& out) const;
  void compare_tracked(Index begin, Index end, const TipRows& out) const;
  template <class Body>
  void for_each_tracked(const double* y, bool derive, const Body& body) const;

  struct Sheet;
  void find_centers(Sheet& sheet) const;
  void compare_with_centers(Sheet& sheet) const;
  void compare_pairs(Sheet& sheet) const;
  void compare_planes(const TipWalk& walk, Sheet& sheet) const;
  void known_residuals(const Eigen::Matrix3Xd& centers, Eigen::VectorXd& residuals,
                       Eigen::MatrixXd& by_center) const;
  void compare_known(Sheet& sheet) const;
  Eigen::VectorXd scales() const;
  Eigen::MatrixXd linear_rows_at(const double* y) const;

  const ArmColumns& columns_;
  const Measurement& m_;
  Criterion criterion_;
  bool pair_weights_;
  int num_threads_;
  std::vector<std::pair<int, int>> pairs_;  ///< touches of one point, first < second
  std::vector<int> plane_rows_;
  struct Joints {
    RowMatrix q;
    std::vector<JointMotion> motions;  ///< of each pose, joint after joint
  };
  std::shared_ptr<const Joints> joints_;  ///< the copies of a system share them
  std::vector<int> free_;
  std::vector<LinearRow> linear_;
  bool use_priors_ = true;
  std::vector<double> trust_;
  Whitening row_whitening_;
  Noise noise_;
  Eigen::MatrixXd whitening_;  ///< of the known rows
};

inline constexpr double kMedianOfNorm = 1.5381722544550522;  ///< of a normal 3-vector of unit std

/// Standard deviation of a measured row per axis [m] by the median of the rows' `distances` from
/// where they should be, each times the root of its weight: outliers do not move it.
double median_noise(const ArmSystem& system, const Eigen::VectorXd& distances);

}  // namespace bathyal

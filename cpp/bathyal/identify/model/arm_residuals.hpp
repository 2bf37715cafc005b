// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "bathyal/estimation/least_squares.hpp"
#include "bathyal/identify/model/chain_derivatives.hpp"

// Residuals of touches and tracked poses as a function of the parameters of an arm.

namespace bathyal {

enum class Criterion {
  kCentroid,  ///< each touch against the mean of its point
  kPairs,     ///< every pair of touches of a point (Yukhimets, Gubankov 2023, eq 7-9)
};

/// A linear constraint: coefficients · (x - nominal) = 0 ± std. Parameters beyond the last
/// coefficient do not take part.
struct LinearConstraint {
  Eigen::VectorXd coefficients;
  double std = 1.0;
};

/// Standard deviation of one axis of a measurement of weight 1.
struct Noise {
  double position = 1e-4;  ///< [m]
  double rotation = 1e-4;  ///< [rad]
};

/// [m] or [rad]; lower bound of the estimated noise, which exact data would give as zero.
inline constexpr double kLeastNoise = 1e-9;

/// Residuals in units of their noise, in this order: positions (touches about their centroids, or
/// in pairs; distances from planes; tracked positions), rotations, known distances and points,
/// priors of the free parameters, linear constraints.
///
/// Known positions are compared with the centroids of the touches, whose noise is included, so that
/// the sum of squares equals the likelihood with the points as explicit unknowns.
class ArmResiduals final : public ResidualModel {
 public:
  ArmResiduals(const ArmParameters& parameters, const Measurement& measurement, Criterion criterion,
               bool pair_weights, int num_threads);

  const std::vector<int>& free() const { return free_; }
  void set_free(std::vector<int> free) { free_ = std::move(free); }
  void set_linear_constraints(std::vector<LinearConstraint> rows) { linear_ = std::move(rows); }
  const std::vector<LinearConstraint>& linear_constraints() const { return linear_; }
  void set_use_priors(bool use) { use_priors_ = use; }
  void set_criterion(Criterion criterion, bool pair_weights);

  /// Factors on the weights of the measurement, (N,).
  void set_observation_weights(std::vector<double> observation_weights) {
    observation_weights_ = std::move(observation_weights);
  }
  const std::vector<double>& observation_weights() const { return observation_weights_; }
  double weight(Index row) const { return m_.weights[row] * observation_weights_[row]; }
  /// By a factor of no more than selection::kExcludedWeight: with 0, a point whose touches are all
  /// excluded would have no centroid.
  bool is_excluded(Index row) const;
  /// Rows of a position that measure something: one of a touch of a plane.
  int axes(Index row) const { return !m_.tracked && m_.plane[row] >= 0 ? 1 : 3; }
  /// Position and orientation rows that are not excluded, less those that free points use up.
  Eigen::Array2d free_rows() const;

  /// Whitens errors of position rows that are larger along one direction than another, in addition
  /// to their weights. Centroid criterion only.
  struct RowWhitening {
    std::vector<Eigen::Matrix3d> factors;  ///< (N,) symmetric
    /// Tracked poses that have an error in common, beyond those that `factors` whiten.
    struct SharedError {
      std::vector<int> poses;
      Eigen::Matrix3d covariance;  ///< of the whitened rows
    };
    std::vector<SharedError> shared;
  };
  using Whitening = std::shared_ptr<const RowWhitening>;  ///< null: none
  void set_row_whitening(Whitening whitening) { row_whitening_ = std::move(whitening); }
  const Whitening& row_whitening() const { return row_whitening_; }
  /// Factor of a position row without errors in common [1/m].
  Eigen::Matrix3d row_factor(Index row) const;
  /// (3, N) errors [m] of whitened position rows, (3 N,).
  Eigen::Matrix3Xd errors_of(const Eigen::VectorXd& whitened) const;
  /// (3 N, k) derivatives of whitened position rows by sources that no two poses share, from those
  /// of rows that are not.
  Eigen::MatrixXd whitened(const Eigen::MatrixXd& loads) const;
  /// (N,) covariance of the error of each position row [m²].
  std::vector<Eigen::Matrix3d> error_covariances() const;

  /// Also updates the noise of known distances and points that is due to the centroids at `x`.
  void set_noise(const Noise& noise, const Eigen::VectorXd& x);
  const Noise& noise() const { return noise_; }
  /// Every measured row in units of `unit` [m] and [rad], known distances and points too.
  void set_equal_noise(double unit);

  /// Joint values to use instead of the measured ones.
  void set_joints(const RowMatrix& q);

  Index rows() const override;
  Index columns() const override { return static_cast<Index>(free_.size()); }
  /// Rows of measurements only; they come first.
  Index data_rows() const { return position_rows() + rotation_rows() + known_rows(); }
  Index position_rows() const;
  Index rotation_rows() const { return m_.has_rotation() ? 3 * m_.rows() : 0; }
  Index known_rows() const;

  void evaluate(const double* y, double* residuals, double* jacobian) const override;
  Eigen::MatrixXd normal_equations(const double* y) const override;
  double cost(const double* y) const override;

  /// (rows, columns) at the values `x` of all parameters.
  Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const;
  /// The rows of priors and constraints alone, which do not depend on the parameters.
  Eigen::MatrixXd linear_jacobian() const;

  /// Values of all parameters for the scaled free ones `y`.
  Eigen::VectorXd values(const Eigen::VectorXd& y) const;
  Eigen::VectorXd scaled(const Eigen::VectorXd& x) const;

  /// Unweighted position residuals (3, N) [m]: tip minus centroid, or minus the measured position;
  /// of a touch of a plane along its normal.
  Eigen::Matrix3Xd deviations(const Eigen::VectorXd& x) const;
  /// Unweighted rotation residuals (3, N) [rad], of tracked poses.
  Eigen::Matrix3Xd rotation_deviations(const Eigen::VectorXd& x) const;
  /// The touched points (3, n): weighted means of their touches, in the world.
  Eigen::Matrix3Xd centroids(const Eigen::VectorXd& x) const;

  const Measurement& measurement() const { return m_; }
  int num_threads() const { return num_threads_; }
  const ArmParameters& arm_parameters() const { return parameters_; }

 private:
  static constexpr std::size_t kPosesPerChunk = 256;

  Eigen::Matrix3Xd tips(const Eigen::VectorXd& x) const;
  /// A position row and its derivatives (null: none), `stride` from column to column.
  void whiten(Index row, double* error, double* jacobian, Index stride) const;
  bool has_shared_errors() const { return row_whitening_ && !row_whitening_->shared.empty(); }
  /// Of the poses in a set those that are not excluded.
  std::vector<int> sharing(const RowWhitening::SharedError& error) const;
  /// Multiplies the means of sets with errors in common, and their excluded poses, by (1 + n
  /// covariance) to `power`: by -1/2 whitens, by 1/2 undoes it. `rows`: (3 N, columns).
  void scale_means(Eigen::Ref<Eigen::MatrixXd> rows, double power) const;
  /// Of an error of a position row [1 / noise²].
  Eigen::Matrix3d precision(Index row) const;
  /// (points,) of their centroids.
  std::vector<Eigen::Matrix3d> centroid_precisions() const;
  Eigen::Matrix3Xd centroids_of(const Eigen::Ref<const Eigen::Matrix3Xd>& tips) const;
  /// Output of a range of poses; null where not wanted.
  struct TipRows {
    double* tips = nullptr;      ///< (3, n)
    double* jacobian = nullptr;  ///< (3 n, columns), `stride` from column to column
    double* rotations = nullptr;
    double* rotation_jacobian = nullptr;
    Index stride = 0;
  };
  void fill_tips(const ChainDerivatives& chain, const TipRows& out) const;
  void fill_tips(const ChainDerivatives& chain, Index begin, Index end, const TipRows& out) const;
  void compare_tracked(Index begin, Index end, const TipRows& out) const;
  template <class Body>
  void for_each_tracked(const double* y, bool derive, const Body& body) const;

  struct Evaluation;
  void find_centers(Evaluation& evaluation) const;
  void compare_with_centers(Evaluation& evaluation) const;
  void compare_pairs(Evaluation& evaluation) const;
  void compare_planes(const ChainDerivatives& chain, Evaluation& evaluation) const;
  void known_residuals(const Eigen::Matrix3Xd& centers, Eigen::VectorXd& residuals,
                       Eigen::MatrixXd& by_center) const;
  void compare_known(Evaluation& evaluation) const;
  Eigen::VectorXd scales() const;
  Eigen::MatrixXd linear_rows_at(const double* y) const;

  const ArmParameters& parameters_;
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
  std::shared_ptr<const Joints> joints_;  ///< shared by copies
  std::vector<int> free_;
  std::vector<LinearConstraint> linear_;
  bool use_priors_ = true;
  std::vector<double> observation_weights_;
  Whitening row_whitening_;
  Noise noise_;
  Eigen::MatrixXd whitening_;  ///< of the known rows
};

inline constexpr double kMedianOfNorm = 1.5381722544550522;  ///< of a normal 3-vector of unit std

/// Standard deviation of a measured row per axis [m] from the median of the `distances` of the rows
/// from their expected positions, each times the root of its weight: robust to outliers.
double median_noise(const ArmResiduals& system, const Eigen::VectorXd& distances);

}  // namespace bathyal

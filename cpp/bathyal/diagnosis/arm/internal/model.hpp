// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "bathyal/diagnosis/arm/internal/contexts.hpp"
#include "bathyal/diagnosis/arm/internal/lack_of_fit.hpp"
#include "bathyal/effects/effect.hpp"
#include "bathyal/identify/fit/arm_fit.hpp"
#include "bathyal/identify/fit/calibration_problem.hpp"
#include "bathyal/identify/fit/calibration_search.hpp"
#include "bathyal/selection/model.hpp"

namespace bathyal::diagnosis {

/// Whether it has an order, and that is a whole number.
bool has_whole_order(const EffectVariant& variant);

/// An arm with its touches or tracked poses, and the effects that may be present. Arm, measurement
/// and options must outlive it.
class ArmModel final : public selection::Model {
 public:
  using Effects = std::vector<std::shared_ptr<const Effect>>;

  ArmModel(const Arm& arm, const Measurement& measurement, const Covariates& covariates,
           const IdentifyOptions& options, const Effects& effects);
  ArmModel(const Arm& arm, const Measurement& measurement, const Covariates& covariates,
           IdentifyOptions&& options, const Effects& effects) = delete;
  /// The same with a subset of the rows of `whole` and with its terms, for a shortlist; without
  /// lack-of-fit terms and variance components. `whole` must outlive it.
  ArmModel(const ArmModel& whole, const std::vector<int>& rows);
  ArmModel(const ArmModel&) = delete;
  ArmModel& operator=(const ArmModel&) = delete;

  const selection::Observations& observations() const override { return observations_; }
  const std::vector<selection::Term>& terms() const override { return terms_; }
  const std::vector<std::vector<int>>& scans() const override { return scans_; }
  const std::vector<selection::VarianceComponent>& variance_components() const override {
    return variance_components_;
  }
  std::vector<int> refine(int term) override;
  /// Takes over the terms that the search in a subset has added and refined.
  void take_terms(const ArmModel& subset);
  std::vector<Eigen::MatrixXd> columns(std::span<const int> terms) const override;
  const selection::Linearization& linearization() const override { return linearization_; }
  const std::vector<Eigen::MatrixXd>& contexts() const override { return contexts_.coordinates; }
  /// The base's axes, the tool's axes, the line from the instrument, each joint.
  std::vector<Eigen::MatrixXd> directions() const override;
  const Dependence& context(int index) const { return contexts_.dependence[index]; }
  void fit(const std::vector<int>& terms) override;
  std::shared_ptr<const Checkpoint> save() const override;
  void restore(const Checkpoint& checkpoint) override;
  void set_observation_weights(const Eigen::VectorXd& weights) override;
  void set_variance_ratios(const Eigen::VectorXd& ratios) override;
  Eigen::MatrixXd whitened(const Eigen::MatrixXd& loads) const override;
  double noise() const override { return problem_.system->noise().position; }

  const ArmFit& geometry() const { return fit_; }
  bool is_tracked() const { return m_.tracked; }
  /// Joint values of touches are the estimated, consistent ones.
  const EffectData& data() const { return data_; }
  /// Null for lack-of-fit terms.
  const Effect* effect(int term) const { return sources_[term].effect.get(); }
  const EffectVariant& variant(int term) const { return sources_[term].variant; }
  /// \pre the term is a lack-of-fit term
  const LackOfFitTerm& lack_of_fit_term(int term) const {
    return lack_of_fit_terms_[sources_[term].lack_of_fit];
  }
  /// Warnings that no effect explains: another arm, another scale, poses too alike.
  const std::vector<std::string>& geometry_warnings() const { return geometry_warnings_; }
  /// Warnings on terms with too many parameters for these data.
  const std::vector<std::string>& untried() const { return untried_; }
  /// The active effects, with their values.
  std::vector<FoundEffect> found() const;
  /// Covariance of all values of the active effects, in their units and order, then of the orders
  /// that were fitted, in theirs; and the residual degrees of freedom.
  Eigen::MatrixXd covariance() const;
  double dof() const;
  /// The rigid part of the estimate, base and tool set.
  Arm arm() const;
  /// With all bases, tools and planes.
  ArmState state() const { return state_at(problem_.parameters, x_); }
  /// Of recorded poses: effects are evaluated at the recorded joint values.
  Eigen::Matrix3Xd deviations() const;
  /// (3, N) position rows, in units of their noise, as distances [m].
  Eigen::Matrix3Xd in_metres(const Eigen::VectorXd& rows) const;
  /// Standard deviation of a row of weight 1 per axis, averaged over rows and axes [m].
  double mean_noise() const;
  /// Unit of a mean square over whitened rows [m]: the precise ones count most.
  double mean_unit() const;
  /// `deviations` of the last fit without effects.
  const Eigen::Matrix3Xd& deviations_before() const { return before_; }

 private:
  ArmModel(const Arm& arm, const Measurement& measurement, std::unique_ptr<const Measurement>&& own,
           const IdentifyOptions& options);
  ArmModel(const ArmModel& whole, const std::vector<int>& rows,
           std::unique_ptr<const Measurement>&& own);
  struct Source {
    std::shared_ptr<const Effect> effect;
    EffectVariant variant;
    int lack_of_fit = -1;
  };
  struct ArmCheckpoint;
  struct ActingVariant {
    EffectVariant variant;
    std::vector<std::vector<Perturbation>> perturbations;
  };
  /// d rows / d parameters, (M, k), and the scale of an ordinary change of each.
  struct ParameterColumns {
    Eigen::MatrixXd columns;
    Eigen::VectorXd scale;
  };
  using Family = std::pair<std::string, int>;  ///< an effect in a joint: one prior scale
  Family family_of(int term) const { return {terms_[term].effect, terms_[term].joint}; }
  void free_observable_directions();
  void find_largest(const Effect& effect, const std::vector<EffectVariant>& variants);
  void silence(const Effect& effect, const EffectVariant& variant,
               std::vector<std::vector<Perturbation>>& perturbations) const;
  void fit_at_settings(const std::vector<int>& terms);
  void activate(const std::vector<int>& terms);
  bool update_orders();
  std::map<Family, std::vector<Index>> large_families() const;
  bool learn_prior_scales(const Eigen::VectorXd& x);
  Eigen::MatrixXd data_normal_equations(const Eigen::VectorXd& x,
                                        const Eigen::VectorXd& weight) const;
  /// Evaluates the effects, which depend on the geometry (torques, bending links), at the arm of
  /// `x`, as a user of the model does. \return rms change of the rows [noise]
  double evaluate_effects_at(const Eigen::VectorXd& x);
  bool effects_changed() const;
  Arm arm_at(const Eigen::VectorXd& x) const;
  void gather_data(const Covariates& covariates);
  void gather_observations();
  void gather_terms(const Effects& effects);
  void gather_variance_components();
  Eigen::MatrixXd joint_loads() const;
  void gather_range_noise();
  void gather_scatter(const Eigen::MatrixXd& by_joint);
  bool is_too_wide(const EffectVariant& variant);
  std::vector<std::vector<Perturbation>> perturbations_of(int term) const;
  std::vector<std::vector<Perturbation>> perturbations_of(const Effect& effect,
                                                          const EffectVariant& variant) const;
  std::vector<std::vector<Perturbation>> perturbations_in_record(
      const Effect& effect, const EffectVariant& variant) const;
  void find_record_effects();
  double prior_std(int term, std::size_t parameter, double scale) const;
  std::vector<ParameterColumns> columns_of(std::vector<ActingVariant> acting) const;
  Eigen::MatrixXd setting_derivatives() const;
  LeastSquaresOptions fit_options() const;
  Eigen::MatrixXd derivatives(const Eigen::VectorXd& x) const;
  Eigen::MatrixXd admissible_changes() const;
  void linearize_at(const Eigen::VectorXd& x);
  bool update_noise();
  /// (N,) of the model, in the world.
  std::vector<Vec3> tips() const;
  /// (N,) their distances from the instrument.
  Eigen::VectorXd ranges() const;
  /// (3, N) the same in the base frame. (A field over measured positions would fit their errors.)
  Eigen::Matrix3Xd tips_from_base() const;

  const Arm& nominal_;
  std::unique_ptr<const Measurement> own_;  ///< of a subset
  const Measurement& m_;
  CalibrationProblem problem_;
  Observability observability_;
  CalibrationResult start_;
  ArmFit fit_;
  Arm effects_arm_;  ///< at which effects are evaluated: that of `data_` and `record_`
  EffectData data_;
  // Of a subset of another model's rows:
  std::optional<EffectData> record_;  ///< all rows
  std::vector<int> rows_;
  std::set<const Effect*> needs_record_;
  std::vector<LackOfFitTerm> lack_of_fit_terms_;
  Contexts contexts_;
  selection::Observations observations_;
  std::vector<selection::Term> terms_;
  std::vector<Source> sources_;
  std::vector<std::vector<int>> scans_;
  std::map<int, std::pair<int, int>> neighbours_;  ///< of terms of a scan: below and above, or -1
  std::vector<selection::VarianceComponent> variance_components_;
  std::vector<std::string> geometry_warnings_;
  std::vector<std::string> untried_;
  std::size_t geometry_ = 0;    ///< number of parameters that are not effects'
  std::vector<int> base_free_;  ///< of them, those that are fitted
  Eigen::MatrixXd observable_;  ///< (free, k) orthonormal: directions that data or priors determine
  /// Of effects without a plausible size: the norm of the largest perturbation, by unit.
  std::map<const Effect*, std::map<std::string, double>> largest_;
  std::vector<int> active_;                ///< active set of the last `fit`
  std::map<Family, double> prior_scales_;  ///< of large families, estimated by the evidence
  Eigen::VectorXd x_;                      ///< all parameters, effects' last
  RowMatrix exact_;  ///< consistent joint values, at which derivatives are taken
  selection::Linearization linearization_;
  Eigen::MatrixXd effect_jacobian_;  ///< (M, k) d modelled / d effects' values
  Eigen::Matrix3Xd before_;
};

}  // namespace bathyal::diagnosis

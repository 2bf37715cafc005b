// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "bathyal/diagnosis/arm/internal/lack_of_fit.hpp"
#include "bathyal/effects/effect.hpp"
#include "bathyal/identify/fit/arm_fit.hpp"
#include "bathyal/identify/fit/calibration_problem.hpp"
#include "bathyal/identify/fit/calibration_search.hpp"
#include "bathyal/selection/model.hpp"

namespace bathyal::diagnosis {

/// An arm beside touches or tracked poses, with the effects that may be in them. For use inside the
/// room. Arm, measurement and options must outlive it.
class ArmModel final : public selection::Model {
 public:
  using Effects = std::vector<std::shared_ptr<const Effect>>;

  ArmModel(const Arm& arm, const Measurement& measurement, const Covariates& covariates,
           const IdentifyOptions& options, const Effects& effects);
  /// The same beside some rows of `whole`, with the same forms, for a quick look; it has no probes
  /// and no forms of noise. `whole` must outlive it.
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
  /// Those that a look at some rows has made and moved.
  void take_terms(const ArmModel& some);
  std::vector<Eigen::MatrixXd> columns(std::span<const int> terms) const override;
  const selection::Linearization& linearization() const override { return linearization_; }
  void fit(const std::vector<int>& terms) override;
  std::shared_ptr<const Checkpoint> save() const override;
  void restore(const Checkpoint& checkpoint) override;
  void set_observation_weights(const Eigen::VectorXd& weights) override;
  void set_variance_ratios(const Eigen::VectorXd& ratios) override;
  double noise() const override { return problem_.system->noise().position; }

  const ArmFit& geometry() const { return fit_; }
  bool is_tracked() const { return m_.tracked; }
  /// Poses of touches are those of exact ones.
  const EffectData& data() const { return data_; }
  /// Probes have none.
  const Effect* effect(int term) const { return sources_[term].effect.get(); }
  const EffectVariant& variant(int term) const { return sources_[term].variant; }
  /// Sentences on what no effect answers: another machine, another size, poses too alike.
  const std::vector<std::string>& geometry_warnings() const { return geometry_warnings_; }
  /// Sentences on forms that have too many numbers for these data.
  const std::vector<std::string>& untried() const { return untried_; }
  /// Effects of the last `settle`, with their values.
  std::vector<FoundEffect> found() const;
  /// Covariance of all values of the last `settle`'s effects, in their units and order, and the
  /// degrees of freedom of the noise.
  Eigen::MatrixXd covariance() const;
  double dof() const;
  /// The rigid part where the model stands, base and tool set.
  Arm arm() const;
  /// All bases, tools and planes too.
  ArmState state() const { return state_at(problem_.parameters, x_); }
  /// Of recorded poses: what effects do is evaluated at the joint values that were recorded.
  Eigen::Matrix3Xd deviations() const;
  /// (3, N) position rows, in units of their noise, as distances [m].
  Eigen::Matrix3Xd in_metres(const Eigen::VectorXd& rows) const;
  /// Standard deviation of a row of weight 1 per axis, in mean over rows and axes [m].
  double mean_noise() const;
  /// One unit of a mean square over rows in units of their noise [m]: the exact ones count most.
  double mean_unit() const;
  /// The same where the subject last stood without effects.
  const Eigen::Matrix3Xd& deviations_before() const { return before_; }

 private:
  ArmModel(const Arm& arm, const Measurement& measurement, std::unique_ptr<const Measurement>&& own,
           const IdentifyOptions& options);
  ArmModel(const ArmModel& whole, const std::vector<int>& rows,
           std::unique_ptr<const Measurement>&& some);
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
  /// What parameters do to the rows, (M, k) per unit of each, and an ordinary change of each.
  struct ParameterColumns {
    Eigen::MatrixXd columns;
    Eigen::VectorXd scale;
  };
  using Family = std::pair<std::string, int>;  ///< an effect in a joint: sizes are learned together
  Family family_of(int term) const { return {terms_[term].effect, terms_[term].joint}; }
  void free_observable_directions();
  void fit_at_settings(const std::vector<int>& terms);
  void activate(const std::vector<int>& terms);
  bool update_orders();
  std::map<Family, std::vector<Index>> large_families() const;
  bool learn_prior_scales(const Eigen::VectorXd& x);
  Eigen::MatrixXd data_normal_equations(const Eigen::VectorXd& x,
                                        const Eigen::VectorXd& weight) const;
  bool is_excluded(Index row) const;
  /// Rows of positions and of orientations that are not left out, less what points take.
  Eigen::Array2d free_rows() const;
  /// Effects follow the geometry (torques, links that bend): what they do is evaluated anew at the
  /// arm of `x`, as whoever uses the model does.
  /// \return rms of how far that moves the rows [noise]
  double evaluate_effects_at(const Eigen::VectorXd& x);
  bool effects_changed() const;
  Arm arm_at(const Eigen::VectorXd& x) const;
  void gather_data(const Covariates& covariates);
  void gather_observations();
  void gather_terms(const Effects& effects);
  void gather_variance_components();
  bool is_too_wide(const EffectVariant& variant);
  std::vector<std::vector<Perturbation>> perturbations_of(int term) const;
  std::vector<std::vector<Perturbation>> perturbations_of(const Effect& effect,
                                                          const EffectVariant& variant) const;
  std::vector<std::vector<Perturbation>> perturbations_in_record(
      const Effect& effect, const EffectVariant& variant) const;
  void find_record_effects();
  double plausible(int term, std::size_t parameter, double scale) const;
  std::vector<ParameterColumns> columns_of(std::vector<ActingVariant> acting) const;
  Eigen::MatrixXd setting_derivatives() const;
  Eigen::VectorXd minimize(Eigen::VectorXd x) const;
  Eigen::VectorXd remove_scale_bias(Eigen::VectorXd x);
  Eigen::VectorXd damped_step(const Eigen::MatrixXd& square, double damping) const;
  Eigen::MatrixXd derivatives(const Eigen::VectorXd& x) const;
  Eigen::MatrixXd admissible_changes() const;
  void linearize_at(const Eigen::VectorXd& x);
  bool update_noise();
  /// (N,) by the model, world.
  std::vector<Vec3> tips() const;
  /// (3, N) of them. (A field over what was measured would explain its errors by itself.)
  Eigen::Matrix3Xd tips_from_base() const;

  const Arm& nominal_;
  std::unique_ptr<const Measurement> own_;  ///< of a subject beside some rows of another's
  const Measurement& m_;
  CalibrationProblem problem_;
  Observability observability_;
  CalibrationResult start_;
  ArmFit fit_;
  Arm effects_arm_;  ///< at which effects are evaluated: that of `data_` and `record_`
  EffectData data_;
  // Of a subject beside some rows of another's:
  std::optional<EffectData> record_;  ///< all of them
  std::vector<int> rows_;
  std::set<const Effect*> needs_record_;
  std::vector<LackOfFitTerm> lack_of_fit_terms_;
  selection::Observations observations_;
  std::vector<selection::Term> terms_;
  std::vector<Source> sources_;
  std::vector<std::vector<int>> scans_;
  std::map<int, std::pair<int, int>> neighbours_;  ///< of forms of a scan: below and above, or -1
  std::vector<selection::VarianceComponent> variance_components_;
  std::vector<std::string> geometry_warnings_;
  std::vector<std::string> untried_;
  std::size_t geometry_ = 0;    ///< columns that are not effects'
  std::vector<int> base_free_;  ///< of them, those that are fitted
  Eigen::MatrixXd observable_;  ///< (free, k) orthonormal: changes of them that anything holds
  std::vector<int> active_;     ///< forms of the last `settle`
  std::map<Family, double> prior_scales_;  ///< what is plausible of large ones, learned
  Eigen::VectorXd x_;                      ///< of all columns, effects' last
  RowMatrix exact_;  ///< joints at which derivatives are taken: of exact touches
  selection::Linearization linearization_;
  Eigen::MatrixXd effect_jacobian_;  ///< (M, k) d modelled / d effects' values, beside it
  Eigen::Matrix3Xd before_;
};

}  // namespace bathyal::diagnosis

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

namespace bathyal {

/// An arm beside touches or tracked poses, with the effects that may be in them. For use inside the
/// room. Arm, measurement and options must outlive it.
class ArmSubject final : public Subject {
 public:
  using Effects = std::vector<std::shared_ptr<const Effect>>;

  ArmSubject(const Arm& arm, const Measurement& measurement, const Covariates& covariates,
             const IdentifyOptions& options, const Effects& effects);
  /// The same beside some rows of `whole`, with the same forms, for a quick look; it has no probes
  /// and no forms of noise. `whole` must outlive it.
  ArmSubject(const ArmSubject& whole, const std::vector<int>& rows);
  ArmSubject(const ArmSubject&) = delete;
  ArmSubject& operator=(const ArmSubject&) = delete;

  const Units& units() const override { return units_; }
  const std::vector<Form>& forms() const override { return forms_; }
  const std::vector<std::vector<int>>& scans() const override { return scans_; }
  const std::vector<NoiseForm>& noise_forms() const override { return noise_forms_; }
  std::vector<int> finer(int form) override;
  /// Those that a look at some rows has made and moved.
  void take_forms(const ArmSubject& some);
  std::vector<Eigen::MatrixXd> columns(std::span<const int> forms) const override;
  const Linearization& linearization() const override { return linearization_; }
  void settle(const std::vector<int>& forms) override;
  std::shared_ptr<const Place> place() const override;
  void return_to(const Place& place) override;
  void set_trust(const Eigen::VectorXd& trust) override;
  void set_noise_forms(const Eigen::VectorXd& ratios) override;
  double noise() const override { return problem_.system->noise().position; }

  const ArmFit& geometry() const { return fit_; }
  bool is_tracked() const { return m_.tracked; }
  /// Poses of touches are those of exact ones.
  const EffectData& data() const { return data_; }
  /// Probes have none.
  const Effect* effect(int form) const { return sources_[form].effect.get(); }
  const EffectVariant& variant(int form) const { return sources_[form].variant; }
  /// Sentences on what no effect answers: another machine, another size, poses too alike.
  const std::vector<std::string>& geometry_doubts() const { return geometry_doubts_; }
  /// Sentences on forms that have too many numbers for these data.
  const std::vector<std::string>& untried() const { return untried_; }
  /// Effects of the last `settle`, with their values.
  std::vector<FoundEffect> found() const;
  /// Covariance of all values of the last `settle`'s effects, in their units and order, and the
  /// degrees of freedom of the noise.
  Eigen::MatrixXd covariance() const;
  double freedom() const;
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
  const Eigen::Matrix3Xd& bare_deviations() const { return bare_; }

 private:
  ArmSubject(const Arm& arm, const Measurement& measurement,
             std::unique_ptr<const Measurement>&& own, const IdentifyOptions& options);
  ArmSubject(const ArmSubject& whole, const std::vector<int>& rows,
             std::unique_ptr<const Measurement>&& some);
  struct Source {
    std::shared_ptr<const Effect> effect;
    EffectVariant variant;
    int probe = -1;
  };
  struct ArmPlace;
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
  Family family_of(int form) const { return {forms_[form].effect, forms_[form].joint}; }
  void free_what_is_seen();
  void fit(const std::vector<int>& forms);
  void stand_with(const std::vector<int>& forms);
  bool move_orders();
  std::map<Family, std::vector<Index>> large_families() const;
  bool learn_sizes(const Eigen::VectorXd& x);
  Eigen::MatrixXd told_by_data(const Eigen::VectorXd& x, const Eigen::VectorXd& weight) const;
  bool is_left_out(Index row) const;
  /// Rows of positions and of orientations that are not left out, less what points take.
  Eigen::Array2d free_rows() const;
  /// Effects follow the geometry (torques, links that bend): what they do is evaluated anew at the
  /// arm of `x`, as whoever uses the model does.
  /// \return rms of how far that moves the rows [noise]
  double evaluate_effects_at(const Eigen::VectorXd& x);
  bool effects_changed() const;
  Arm arm_at(const Eigen::VectorXd& x) const;
  void gather_data(const Covariates& covariates);
  void gather_units();
  void gather_forms(const Effects& effects);
  void gather_noise_forms();
  bool is_too_wide(const EffectVariant& variant);
  std::vector<std::vector<Perturbation>> perturbations_of(int form) const;
  std::vector<std::vector<Perturbation>> perturbations_of(const Effect& effect,
                                                          const EffectVariant& variant) const;
  std::vector<std::vector<Perturbation>> perturbations_in_record(
      const Effect& effect, const EffectVariant& variant) const;
  void find_those_that_need_the_record();
  double plausible(int form, std::size_t parameter, double scale) const;
  std::vector<ParameterColumns> columns_of(std::vector<ActingVariant> acting) const;
  Eigen::MatrixXd by_scanned() const;
  Eigen::VectorXd nearest_minimum(Eigen::VectorXd x) const;
  Eigen::VectorXd without_size_draw(Eigen::VectorXd x);
  Eigen::VectorXd step_of(const Eigen::MatrixXd& square, double damping) const;
  Eigen::MatrixXd derivatives(const Eigen::VectorXd& x) const;
  Eigen::MatrixXd moves() const;
  void stand_at(const Eigen::VectorXd& x);
  bool update_noise();
  /// (N,) by the model, world.
  std::vector<Vec3> tips() const;
  /// (3, N) of them. (A field over what was measured would explain its errors by itself.)
  Eigen::Matrix3Xd tips_from_base() const;

  const Arm& nominal_;
  std::unique_ptr<const Measurement> own_;  ///< of a subject beside some rows of another's
  const Measurement& m_;
  CalibrationProblem problem_;
  Observability seen_;
  CalibrationResult start_;
  ArmFit fit_;
  Arm effects_arm_;  ///< at which effects are evaluated: that of `data_` and `record_`
  EffectData data_;
  // Of a subject beside some rows of another's:
  std::optional<EffectData> record_;  ///< all of them
  std::vector<int> rows_;
  std::set<const Effect*> needs_record_;
  std::vector<Probe> probes_;
  Units units_;
  std::vector<Form> forms_;
  std::vector<Source> sources_;
  std::vector<std::vector<int>> scans_;
  std::map<int, std::pair<int, int>> neighbours_;  ///< of forms of a scan: below and above, or -1
  std::vector<NoiseForm> noise_forms_;
  std::vector<std::string> geometry_doubts_;
  std::vector<std::string> untried_;
  std::size_t geometry_ = 0;        ///< columns that are not effects'
  std::vector<int> base_free_;      ///< of them, those that are fitted
  Eigen::MatrixXd held_;            ///< (free, k) orthonormal: changes of them that anything holds
  std::vector<int> standing_;       ///< forms of the last `settle`
  std::map<Family, double> sizes_;  ///< what is plausible of large ones, learned
  Eigen::VectorXd x_;               ///< of all columns, effects' last
  RowMatrix exact_;                 ///< joints at which derivatives are taken: of exact touches
  Linearization linearization_;
  Eigen::MatrixXd by_standing_;  ///< (M, k) d modelled / d effects' values, beside it
  Eigen::Matrix3Xd bare_;
};

}  // namespace bathyal

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bathyal/selection/folds.hpp"
#include "bathyal/selection/lack_of_fit.hpp"
#include "bathyal/selection/model.hpp"
#include "bathyal/selection/outlier_test.hpp"
#include "bathyal/selection/term_selection.hpp"
#include "bathyal/selection/working_point.hpp"

namespace bathyal {

/// Called with the share of the work that is done, 0 … 1, and what comes next; throws to stop.
using Progress = std::function<void(double done, const std::string& stage)>;

struct ExaminationOptions {
  int num_threads = 0;
  int blocks = 10;  ///< that are held out in turn
};

/// A form that was chosen.
struct Chosen {
  int form = 0;
  double explained = 0.0;  ///< sum of squares that goes without it
  double f = 0.0;          ///< Wald's statistic per column
  double width = 0.0;      ///< columns
  double p = 1.0;          ///< by Fisher's F, times the trials
  double size = 0.0;       ///< root mean square of what it does beside all else, per row [noise]
  double held_out_without = 0.0;  ///< mean square per row foretold by the others [noise²]
  double held_out_with = 0.0;
};

struct RivalForm {
  int form = 0;     ///< chosen
  int instead = 0;  ///< form
  double odds = 0.0;
};

/// Findings of one subject: which forms explain what its base model does not.
struct Examination {
  bool held_out = false;  ///< there was enough to hold out
  Blocks blocks;
  std::vector<Chosen> names;
  std::vector<Chosen> probes;     ///< structure beside the names
  std::vector<RivalForm> rivals;  ///< likeliest first, by name
  std::vector<Dependence> shown;  ///< of the base model alone, likeliest first
  std::vector<int> odd;           ///< units left out
  double base_noise = 0.0;        ///< one unit of `shown` [m]
  std::vector<NoiseFit> noise;    ///< noise forms that were named
  double base_squares = 0.0;      ///< beside the base model, before anything was named
  double removed = 0.0;           ///< by the names, noise taken out
  double left_over = 0.0;         ///< by the probes, noise taken out
  double freedom = 0.0;           ///< of what remains
  double detectable = 0.0;        ///< size per row that would have been found [noise]
  Eigen::VectorXd error_before;   ///< (M,) held out, base model alone [noise]
  Eigen::VectorXd error_after;    ///< (M,) with the names
  double luck = 1.0;              ///< probability that the gain is
};

/// Shows, names and measures; leaves the subject standing at what it named. The search goes on from
/// what a look at some of the units has found, where there was one.
Examination examine(Subject& subject, const ExaminationOptions& options, const Progress& progress,
                    const FirstLook& look = {});

/// Forms that explain what the base model of `subject` leaves, before any proof. What is done is
/// told as the first part of an examination of the whole.
FirstLook find_forms(Subject& subject, int num_threads, const Progress& progress);

}  // namespace bathyal

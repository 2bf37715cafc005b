// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/identify_options.hpp"

#include "bathyal/base/check.hpp"

namespace bathyal {

void IdentifyOptions::check() const {
  check_range("nearly_parallel", nearly_parallel, 0.0, 0.5);
  LeastSquaresOptions{.max_iterations = max_iterations}.check();
  if (length_prior) check_positive("length_prior", *length_prior);
  if (angle_prior) check_positive("angle_prior", *angle_prior);
  for (const auto& [name, std] : priors) check_positive("priors " + name, std);
  check_positive("size_prior", size_prior);
  if (noise) check_positive("noise", *noise);
  if (rotation_noise) check_positive("rotation_noise", *rotation_noise);
  if (loss_width) check_positive("loss_width", *loss_width);
  if (prune_sigma) check_positive("prune_sigma", *prune_sigma);
}

}  // namespace bathyal

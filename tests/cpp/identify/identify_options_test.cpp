// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/identify_options.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace bathyal {
namespace {

TEST(IdentifyOptions, DefaultsAreValidAndEachBadNumberIsRefused) {
  EXPECT_NO_THROW(IdentifyOptions{}.check());
  for (const IdentifyOptions& bad :
       {IdentifyOptions{.nearly_parallel = 0.6}, IdentifyOptions{.max_iterations = 0},
        IdentifyOptions{.length_prior = 0.0}, IdentifyOptions{.angle_prior = -1.0},
        IdentifyOptions{.priors = {{"a_1", 0.0}}}, IdentifyOptions{.size_prior = 0.0},
        IdentifyOptions{.noise = 0.0}, IdentifyOptions{.rotation_noise = 0.0},
        IdentifyOptions{.loss_width = 0.0}, IdentifyOptions{.prune_sigma = 0.0}}) {
    EXPECT_THROW(bad.check(), std::invalid_argument);
  }
}

}  // namespace
}  // namespace bathyal

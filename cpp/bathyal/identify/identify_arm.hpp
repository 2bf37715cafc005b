// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/effects/measurements.hpp"
#include "bathyal/identify/fit/arm_fit.hpp"
#include "bathyal/identify/identify_options.hpp"

namespace bathyal {

class CorrectedArm;

/// Estimates the geometry of an arm (Yukhimets, Gubankov 2023).
///
/// Unknown are the row of each moving joint (Hayati and Mirmirani's beta in place of d where the
/// next axis is nearly parallel), the tool and, for tracked poses, the base. Redundant parameters,
/// which base and tool can represent, are fixed at nominal (`Status::kGauge`). Touches of one point
/// need only agree; a shrinking arm would make them agree, so that their sum of squares does not
/// determine the scale of the arm: known distances or points or a prismatic joint do, or a prior on
/// the lengths, and `scale_source` reports which. Scatter is recorded in joint values, and a
/// smaller arm maps it to a smaller one: least squares underestimates the scale by (degrees of
/// freedom) · (relative std of the scale)². An observed scale is corrected for this bias by steps
/// along the derivatives of consistent touches, which leave the sum slightly above its minimum.
/// Where a prior determines the scale, the sum alone is minimised, as in the paper, and a loose
/// prior lets the arm shrink.
///
/// Unobservable directions stay at nominal. Noise is estimated from the residuals with 3 Σ(m_i - 1)
/// - rank degrees of freedom and sets the weight of known lengths and priors relative to the
/// touches. Rank and standard deviations are those of consistent touches: each pose is first moved
/// by the least joint motion that brings its tip onto its point, since scatter would otherwise
/// count as information on the scale.
///
/// \throw std::invalid_argument for invalid data or options, or another number of joints.
ArmFit identify_arm(const Arm& arm, const Touches& touches, const IdentifyOptions& options = {});
ArmFit identify_arm(const Arm& arm, const Tracked& tracked, const IdentifyOptions& options = {});

/// The same for an arm with effects: they are fixed at their values, each in the rows where it
/// applies (CorrectedArm::effect_uses, by the covariates of the data), while the geometry is
/// estimated again. Their values are reported as fixed parameters. The arm of the fit is the rigid
/// part alone.
/// \throw std::invalid_argument also for covariates as CorrectedArm::forward
ArmFit identify_arm(const CorrectedArm& model, const Touches& touches,
                    const IdentifyOptions& options = {});
ArmFit identify_arm(const CorrectedArm& model, const Tracked& tracked,
                    const IdentifyOptions& options = {});

}  // namespace bathyal

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Docstrings of diagnosis.cpp.

namespace bathyal::python {

inline constexpr const char* kEstimateDoc =
    R"(A number with its 95 % confidence interval; float() gives the number.)";

inline constexpr const char* kNamedEffectDoc = R"(A cause that was found, with its evidence.)";

inline constexpr const char* kStructureDoc =
    R"(A lack-of-fit test: a dependence of the residuals, significant or not.)";

inline constexpr const char* kKindDoc =
    R"(What the residuals depend on: "position" of the tip, its "range" from the instrument,
"joints" (one, two or all), "time", "order" of the rows (where no times are recorded),
"approach" (the direction of a joint's last move), "session" or "covariate"; "none" where nothing was found.)";

inline constexpr const char* kDiagnosisDoc =
    R"(Errors of an arm's model, by its measurements; see `diagnose`.)";

inline constexpr const char* kDiagnoseDoc =
    R"(Find what the best rigid model of an arm gets wrong, name the cause, measure the gain.

The arm's geometry is identified first. Effects of the library are selected to explain its
residuals, alone and in growing sets, fitted jointly with the geometry; sets are compared by their
likelihood less a complexity penalty, and each effect must improve the prediction of held-out data.
Structure that nothing in the library explains is reported as such, without a name.

Parameters
----------
arm : Arm
    Nominal; its masses, where they are given, make loads of gravity known.
data : Touches or Tracked
    With any of the covariates `temperature` (N,) [°C], `time` (N,) [s], `payload` (N,) [kg at the
    tool centre point], `direction` (N, n) -1, 0 or 1, `gravity` (N, 3) [m/s², base frame] and
    `session` (N,); others are tested for structure. One that is missing (nan) in some rows is
    not used, and a warning says so. Rows that duplicate another to the last digit count once.
effects : list of Effect, optional
    What may be selected; `bathyal.effects.list()` unless given.
parametrization : {"hayati", "dh"}
    Of the geometry, as in `identify_arm`.
fixed : list of str
    Names of geometric parameters to hold at nominal.
length_prior : float, optional
    The maker's tolerance: standard deviation of every a and d about nominal [m], as of
    `identify_arm`. None: no prior.
blocks : int
    Number of folds of the cross-validation, 3 to 50.
groups : (N,) array of int or str, optional
    The group of each row, 2 groups or more: a placement of the arm, a day, a region. Whole groups
    are then held out in turn instead of `blocks`, in which effects must prove themselves and the
    held-out errors are measured. More than 50 groups are joined to 50 folds. A base or tool that
    only one group has cannot be predicted from others: it stays as fitted to all rows.
nested : int
    Folds of a nested cross-validation, 2 to 50 (of `groups`, where given, as many as there are), or
    0. The whole diagnosis is made anew without each: names, orders and sizes. `held_out.nested` has
    the errors. It takes as long as so many diagnoses. Of tracked poses only.
rival_odds : float
    Odds of an alternative against the best explanation from which the verdict is "ambiguous".
leftover : float
    Unexplained structure, as a share of the variance that the effects explain, from which the
    verdict is "unknown" and the effects are partial.
num_next_poses : int
    How many poses to propose where the verdict is "ambiguous".
progress : callable, optional
    Called with (share done, what comes next), often within a stage; what it raises ends the run.
num_threads : int
    0 = all; the same bytes for any number.

Returns
-------
Diagnosis

Raises
------
ValueError
    For bad data, covariates or options, another number of joints, an effect given twice, one of
    the user's own that gives another shape, numbers that are not finite, or others when asked again.
bathyal.Error
    For an effect of the user's own that raises.

Examples
--------
>>> import numpy as np
>>> import bathyal
>>> arm = bathyal.arms.ur10()
>>> random = np.random.default_rng(1)
>>> q = random.uniform(-1.5, 1.5, (150, 6))
>>> wrong = q.copy()
>>> wrong[:, 1] += 1e-3 * np.cos(2.0 * q[:, 1])  # an eccentric encoder
>>> seen = arm.forward(wrong)[:, :3, 3] + random.normal(0.0, 1e-4, (150, 3))
>>> report = bathyal.diagnose(arm, bathyal.Tracked(q, seen))
>>> report
Diagnosis(named, joint_harmonic[1])
>>> round(float(report.effects[0].parameters["order"]))
2
)";

}  // namespace bathyal::python

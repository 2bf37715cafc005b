// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "bathyal/geometry/point_cloud.hpp"

namespace bathyal {

struct FindSheetsOptions {
  /// Vertical distance from which two sheets count [m]; 0 takes the larger of 6 × noise and
  /// 1 × spacing, both measured from the cloud.
  double min_separation = 0.0;
  /// Soundings that a place needs on each of its two sheets, 5 or more. Fewer are spikes.
  int min_points = 12;
  int num_threads = 0;  ///< 0 = all

  void check() const;
};

/// One connected place where the cloud has two or more sheets.
struct SheetPatch {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< bounding box of its soundings [m]
  double area = 0.0;                             ///< in plan, to the size of a cell [m²]
  double separation = 0.0;                       ///< median vertical distance of its sheets [m]
  Index point_count = 0;                         ///< soundings on the upper and the lower sheet
};

/// Where a cloud has several sheets over one (x, y), and by what measure.
struct SheetReport {
  std::vector<SheetPatch> patches;  ///< largest area first; none where the cloud is a height field
  PointMatrix cells;                ///< (K, 3) cells of the patches: centre x, y and the height
                                    ///< half-way between the two sheets [m]
  std::vector<double> separation;   ///< (K,) vertical distance of the two sheets there [m]
  double cell_size = 0.0;           ///< side of a cell [m]
  double covered_area = 0.0;        ///< of all cells that hold a sounding [m²]
  double sheet_area = 0.0;          ///< of `cells` [m²]
  double spacing = 0.0;             ///< √(covered area / soundings) [m]
  double noise = 0.0;               ///< median rms of soundings about their local plane [m]
  double min_separation = 0.0;      ///< the one used [m]

  bool single_valued() const { return patches.empty(); }
  double share() const { return covered_area > 0.0 ? sheet_area / covered_area : 0.0; }
};

/// Finds where a cloud is not a height field: overhangs, arches, undersides, and survey passes that
/// disagree in height by more than their noise.
///
/// The plan is cut into square cells of about 1.5 spacings. A cell lies under two sheets when the
/// soundings of its 3 × 3 neighbourhood split into two groups, five or more in each, such that
///  1. each group lies on a plane of its own, and the planes are apart, at those soundings, by
///     `min_separation` and by four times the rms about them: noise, however strong, fails this;
///  2. the groups are interleaved in plan: a fifth of each lies inside the convex hull of the
///     other. Where a height field jumps (a wall, a boulder's flank, a ledge seen only from above)
///     high soundings lie to one side of the low ones and not among them, however steep.
/// Touching cells form a patch. It is kept when three of them pass at five times the rms and a
/// third of each group, and when it has `min_points` on each sheet.
///
/// Relief finer than the spacing cannot be distinguished from sheets and counts as such where it
/// meets both conditions. A vertical wall with soundings all the way up is not two sheets. Two
/// passes over the same ground count when the step between them passes condition 1. Sheets are
/// missed where soundings lie four times closer along scan lines than across, among spikes in one
/// sounding of five (clean the cloud first), and within a spacing or two of the rim where they
/// join.
///
/// Fewer than 2 × min_points points, or all in one place: no sheets. The same report for any
/// number of threads.
/// \throw std::invalid_argument for points that are not finite or above 1e75.
SheetReport find_sheets(PointView points, const FindSheetsOptions& options = {});

/// One sentence for people: where and how much, or that there is one sheet.
std::string describe(const SheetReport& report);

}  // namespace bathyal

// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/registration.hpp"

#include <pcl/console/print.h>
#include <pcl/point_types.h>
#include <pcl/registration/icp.h>

#include <string>

#include "bathyal/base/error.hpp"
#include "bathyal/geometry/point_cloud.hpp"

namespace bathyal {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/// About the centroid, where float32 keeps its digits.
Cloud::Ptr to_pcl(std::string_view name, PointView points) {
  if (points.rows() < 3) throw_argument(name, "three rows or more", std::to_string(points.rows()));
  check_points_finite(name, points);
  const Eigen::RowVector3d origin = points.row(0);
  const Eigen::RowVector3d centre = origin + (points.rowwise() - origin).colwise().mean();
  Cloud::Ptr cloud(new Cloud);
  for (Index i = 0; i < points.rows(); ++i) {
    const Eigen::RowVector3f p = (points.row(i) - centre).cast<float>();
    cloud->push_back({p.x(), p.y(), p.z()});
  }
  return cloud;
}

/// PCL prints its warnings; errors are thrown here.
class QuietPcl {
 public:
  QuietPcl() { pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS); }
  ~QuietPcl() { pcl::console::setVerbosityLevel(before_); }
  QuietPcl(const QuietPcl&) = delete;
  QuietPcl& operator=(const QuietPcl&) = delete;

 private:
  pcl::console::VERBOSITY_LEVEL before_ = pcl::console::getVerbosityLevel();
};

void check_none_shared(const std::vector<Index>& pairs, Index positions) {
  std::vector<Index> owner(static_cast<std::size_t>(positions), -1);
  for (Index i = 0; i < static_cast<Index>(pairs.size()); ++i) {
    Index& previous = owner[pairs[i]];
    if (previous >= 0) {
      throw Error("the iterative closest point algorithm leaves predictions " +
                  std::to_string(previous) + " and " + std::to_string(i) +
                  " nearest to the same position, row " + std::to_string(pairs[i]) +
                  ": the clouds lie too far apart to be paired by it");
    }
    previous = i;
  }
}

}  // namespace

void IcpOptions::check() const {
  if (max_iterations < 1) {
    throw_argument("max_iterations", "1 or more", std::to_string(max_iterations));
  }
}

std::vector<Index> pair_by_icp(PointView predicted, PointView positions,
                               const IcpOptions& options) {
  options.check();
  const Cloud::Ptr source = to_pcl("predicted", predicted);
  const Cloud::Ptr target = to_pcl("positions", positions);
  if (target->size() < source->size()) {
    throw_argument("positions", "as many rows as there are predictions, or more",
                   std::to_string(target->size()) + " for " + std::to_string(source->size()));
  }
  const QuietPcl quiet;
  pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> icp;
  icp.setInputSource(source);
  icp.setInputTarget(target);
  icp.setMaximumIterations(options.max_iterations);
  icp.setTransformationEpsilon(1e-12);
  Cloud aligned;
  icp.align(aligned);
  if (!icp.hasConverged()) {
    throw Error("the iterative closest point algorithm did not converge within " +
                std::to_string(options.max_iterations) + " iterations");
  }
  std::vector<Index> pairs;
  pcl::Indices nearest(1);
  std::vector<float> squared(1);
  for (const pcl::PointXYZ& point : aligned) {
    icp.getSearchMethodTarget()->nearestKSearch(point, 1, nearest, squared);
    pairs.push_back(nearest[0]);
  }
  check_none_shared(pairs, positions.rows());
  return pairs;
}

}  // namespace bathyal

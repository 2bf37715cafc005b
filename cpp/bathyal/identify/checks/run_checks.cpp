// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/checks/run_checks.hpp"

#include "bathyal/identify/checks/internal/checks.hpp"
#include "bathyal/identify/checks/internal/outliers.hpp"
#include "bathyal/identify/checks/internal/residual_structure.hpp"

namespace bathyal {

std::vector<std::string> examine(const Measurement& measurement, const ArmSystem& system,
                                 const Arm& nominal, ArmFit& fit) {
  const OutlierSearch search = find_outliers(system, fit.values);
  const JointStructure structure =
      search.hopeless ? JointStructure{} : find_structure(system, search.x, search.trust);
  fit.outliers = search.outliers;
  fit.structure_p = structure.p;
  const Case seen{measurement, system, nominal, fit, structure, search};
  fit.warnings = find_doubts(seen);
  return find_gross_doubts(seen);
}

}  // namespace bathyal

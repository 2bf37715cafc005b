// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/checks/run_checks.hpp"

#include "bathyal/identify/checks/internal/checks.hpp"
#include "bathyal/identify/checks/internal/outliers.hpp"
#include "bathyal/identify/checks/internal/residual_structure.hpp"

namespace bathyal {

using namespace identify;

std::vector<std::string> run_checks(const Measurement& measurement, const ArmResiduals& system,
                                    const Arm& nominal, ArmFit& fit) {
  const OutlierSearch search = find_outliers(system, fit.values);
  const ResidualStructure structure =
      search.no_consensus ? ResidualStructure{}
                          : test_residual_structure(system, search.x, search.observation_weights);
  fit.outliers = search.outliers;
  fit.structure_p = structure.p;
  const CheckContext context{measurement, system, nominal, fit, structure, search};
  fit.warnings = all_warnings(context);
  return gross_warnings(context);
}

}  // namespace bathyal

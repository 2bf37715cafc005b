// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/mission/run.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "bathyal/base/check.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/mission/internal/run_parts.hpp"
#include "bathyal/mission/internal/saved_run.hpp"

namespace bathyal {

std::string_view status_name(RunStatus status) {
  constexpr std::array<std::string_view, 6> kNames{"running", "done",    "failed",
                                                   "aborted", "timeout", "stopped"};
  return kNames[static_cast<std::size_t>(status)];
}

MissionRun::MissionRun(std::shared_ptr<const MissionPlan> plan, std::uint64_t seed,
                       MissionSink* sink) {
  plan->check();
  parts_ = std::make_unique<Parts>(std::move(plan), seed, sink);
}

MissionRun::~MissionRun() = default;

bool MissionRun::step(const LiveInputs& inputs) {
  const double at = time();
  try {
    return parts_->step(inputs);
  } catch (const std::invalid_argument& error) {  // a plan and inputs that were right: it runs away
    std::string text("the motion runs away at ");
    throw Error(text.append(to_text(at)).append(" s: ").append(error.what()));
  }
}
double MissionRun::time() const { return parts_->time(); }
const MissionPlan& MissionRun::plan() const { return *parts_->plan; }
const MissionState& MissionRun::state() const { return parts_->state; }
VehicleState MissionRun::estimated() const { return parts_->estimated(); }
const std::vector<std::string>& MissionRun::signals() const { return parts_->names; }

std::vector<ArrivedReading> MissionRun::arrived() const {
  std::vector<PendingReading> pending = parts_->state.pending;
  const std::size_t count = sort_arrived(pending, time());
  std::vector<ArrivedReading> found;
  for (std::size_t i = 0; i < count; ++i) {
    const auto row = static_cast<std::size_t>(pending[i].device);
    found.push_back({parts_->plan->sensors[row].name, pending[i].reading});
  }
  return found;
}

std::map<std::string, double> MissionRun::metrics() const {
  const MissionState& s = parts_->state;
  const double ticks = static_cast<double>(std::max<std::int64_t>(1, s.number));
  std::map<std::string, double> all{
      {"duration", time()},
      {"distance", s.sums.distance},
      {"deepest", s.sums.deepest},
      {"least_altitude", s.sums.least_altitude},
      {"energy_wh", s.sums.energy / 3600.0},
      {"battery", s.vehicle.battery.charge},
      {"position_rms", std::sqrt(s.sums.squared_error / ticks)},
      {"position_worst", s.sums.largest_error},
      {"samples", s.arm.samples},
  };
  return all;
}

std::string MissionRun::save() const {
  return saved_run(parts_->state, parts_->fingerprint(), parts_->seed);
}

void MissionRun::load(const std::string& bytes) {
  parts_->state = loaded_run(bytes, parts_->state, parts_->fingerprint(), parts_->seed);
  parts_->renew_system();
}

}  // namespace bathyal

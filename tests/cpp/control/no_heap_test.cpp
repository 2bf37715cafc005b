// SPDX-License-Identifier: BSD-3-Clause
// Stepping a vehicle, allocating thrusts and holding a pose make no object on the heap (what Eigen
// takes by malloc is not counted here).
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "bathyal/control/allocation.hpp"
#include "bathyal/control/pose_hold.hpp"
#include "bathyal/vehicle/device_presets.hpp"

namespace {

std::atomic<long> requests{0};

void* counted(std::size_t size) {
  ++requests;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace bathyal {
namespace {

TEST(Heap, IsCounted) {
  const long before = requests;
  const std::vector<double> some(10, 1.0);
  EXPECT_EQ(requests - before, some.empty() ? 0 : 1);
}

TEST(Heap, IsNotAskedInALoop) {
  for (const bool benchmark : {false, true}) {
    VehicleSystemOptions options = bluerov2_heavy_system(benchmark);
    options.tether.emplace();
    options.tether->length = 30.0;
    options.tether->anchor = Vec3(0.0, 0.0, 20.0);
    options.tether->weight = 0.1;
    options.fins = remus100_system().fins;
    options.drop_weights.emplace_back();
    const VehicleSystem rov(options);
    const Allocation allocation(rov.thrusters());
    const PoseHold hold(rov.vehicle(), {});
    VehicleSystemState state = rov.rest();
    VehicleCommands commands{std::vector<double>(8, 0.0), {0.1, 0.0}, {}};
    PoseHoldState memory;
    AllocationResult result;
    const std::vector<int> failed{2};
    allocation.allocate(Vec6::Zero(), 16.0, failed, result);  // its vectors get their size
    const long before = requests;
    for (int k = 0; k < 50; ++k) {
      const Vec6 wrench = hold.step(memory, state.motion, {}, Vec3::Zero(), 0.05);
      allocation.allocate(wrench, rov.supply(state, commands).voltage, failed, result);
      commands.thrusters = result.command;
      rov.step(state, commands, Flow{Vec3(0.3, 0.1, 0.0), Vec3::Zero()}, 0.01);
    }
    EXPECT_EQ(requests - before, 0) << benchmark;
  }
}

}  // namespace
}  // namespace bathyal
